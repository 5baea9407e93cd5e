#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fastball::sim_bullet {

/// Tells the commands of one sender from those of a second one: another controller, or one of an earlier run. Messages name no
/// sender, but one sender counts on (seq), says the same again about a tick, and never goes back to an older tick.
/// Whoever answers a scene's first state has the scene.
class CommandWatch {
 public:
  explicit CommandWatch(std::string channel) : channel_(std::move(channel)) {}

  void beginScene(int64_t scene_id);
  /// A state of this tick was said, which may be answered once more.
  void stateSaid(int64_t tick);
  /// @return false if the command is not of the sender that has the scene. One that is merely late is accepted.
  /// `sender()`: who it is, as far as that is known.
  template <class Command, class Sender>
  bool accepts(Command command, const Sender& sender) {
    const Stamp stamp{command.scene_id, command.tick, command.seq};
    command.seq = 0;
    words_.resize(static_cast<std::size_t>(command.getEncodedSize()));
    command.encode(words_.data(), 0, static_cast<int>(words_.size()));
    const std::string fault = faultOf(stamp);
    if (fault.empty())
      take(stamp);
    else
      refuse(fault, sender());
    return fault.empty();
  }

  /// Commands refused in this scene, or before the first.
  int64_t refused() const { return refused_; }
  /// "refused 4 ARM_COMMANDs of a second sender; the first, of controller (process 12 on robot),
  /// has seq ...", renewed at the 1st, 2nd, 4th, 8th, ... of them; or empty.
  const std::string& sentence() const { return sentence_; }

 private:
  struct Stamp {
    int64_t scene_id = 0;
    int64_t tick = 0;
    int64_t seq = 0;
  };
  void take(const Stamp& stamp);
  std::string faultOf(const Stamp& stamp) const;
  void refuse(const std::string& fault, const std::string& sender);

  std::string channel_;
  int64_t scene_ = 0;  ///< 0: none yet
  int64_t scene_before_ = 0;
  int64_t newest_tick_ = -1;      ///< said in this scene
  bool any_ = false;              ///< accepted in this scene
  Stamp last_;                    ///< accepted, the one with the largest seq
  std::vector<char> last_words_;  ///< of it, without its seq
  std::vector<char> words_;       ///< of the command in question
  int64_t states_ = 0;            ///< said since
  int64_t refused_ = 0;
  std::string first_fault_;
  std::string sentence_;
};

}  // namespace fastball::sim_bullet
