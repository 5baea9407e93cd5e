#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "messaging/clock.h"
#include "messaging/endpoint.h"

namespace fastball::messaging {

/// Where processes are on several machines nobody is told that one of them has died or that a cable is cut. There every process
/// says HEARTBEAT this many times within the silence limit, and listens to the others'.
inline constexpr int kBeatsWithinLimit = 5;

/// A process that fell silent or came back.
struct PeerNews {
  std::vector<std::string> names;
  bool is_silent = true;
  std::string sentence;
};

/// Notices, within a limit, that processes heard before have fallen silent, and that they are heard again. Silence counts only
/// while this process itself runs on schedule: a late look at the clock adds one beat at most, so a machine that is too busy to
/// run this process does not make it take the others for dead. Not counted are processes that have said their last words (state
/// "ended" or "failed"), and a planner while it plans, for it says that it is at it and then nothing until it is done.
class PeerWatch {
 public:
  /// @param own_name of this process, whose own HEARTBEAT is no news
  /// @param limit [s], of wall time
  PeerWatch(Endpoint& endpoint, const Clock& clock, std::string own_name, double limit);
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

  /// To be called after every drain, and by wakeUs(). @return what is new, each thing once.
  std::vector<PeerNews> update();
  /// "nothing has been heard of robot (controller, sim_bullet) for 0.49 s (silence_limit 0.5 s)", on all who are
  /// silent now, as of when it was noticed; empty: nobody is.
  const std::string& silence() const { return silence_; }
  /// Monotonic time [us] of the next look.
  int64_t wakeUs() const { return looked_us_ + look_us_; }

 private:
  struct Peer {
    std::string state;
    int64_t heard_us = 0;    ///< monotonic
    int64_t counted_us = 0;  ///< monotonic, up to which silence_us is counted
    int64_t silence_us = 0;
    bool is_silent = false;
    bool is_back = false;  ///< was silent, and was heard since the last look
  };
  using Key = std::pair<std::string, std::string>;  ///< host, name

  void hear(const heartbeat_t& message);
  void count(int64_t now_us);
  bool isOverdue(const Peer& peer) const;
  std::string describe() const;

  const Clock& clock_;
  std::string own_name_;
  int64_t limit_us_, beat_us_, look_us_;
  int64_t looked_us_;
  std::map<Key, Peer> peers_;
  bool is_forgotten_ = false;  ///< some peer was since the last look
  std::string silence_;
};

}  // namespace fastball::messaging
