#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "launch/spy/arrival_window.h"
#include "launch/spy/message_layout.h"
#include "messaging/type_library.h"

namespace fastball::launch {

/// What is known of one channel at one moment.
struct ChannelReport {
  std::string channel;
  std::string type;         ///< name, or what is known of it
  int64_t count = 0;        ///< messages heard
  int64_t undecodable = 0;  ///< of them, of no known type or not exactly one message of their type
  std::optional<int64_t> lost;   ///< by gaps in `seq`; none where no sender can be followed by it
  double rate = 0;               ///< [Hz], of the last two seconds, as the two below
  double bandwidth = 0;          ///< [bytes/s]
  std::optional<double> jitter;  ///< [s], standard deviation of the gaps; none below two of them
  double age = 0;                ///< [s] since the newest message
};

/// Counts the messages of all channels, and keeps the newest of each. Any bytes are safe. It decodes no more of a message than it
/// must to count it; the members are read when they are asked for.
class Traffic {
 public:
  /// `types` must live as long, and get no more types.
  explicit Traffic(const messaging::TypeLibrary& types) : types_(types) {}

  /// `utime`: time of arrival [us since 1970]. Beyond kMaxChannels channels, the messages of new ones are only counted in unlisted().
  void take(const std::string& channel, const void* data, std::size_t size, int64_t utime);
  static constexpr std::size_t kMaxChannels = 4096;

  /// All channels, by name. `now` [us since 1970].
  std::vector<ChannelReport> report(int64_t now) const;
  /// The members of the newest message of a channel that decodes; empty where there is none. They look into this
  /// object: no longer than until the next take().
  std::vector<messaging::MessageField> newestFields(const std::string& channel) const;
  int64_t unlisted() const { return unlisted_; }

 private:
  struct Channel {
    int64_t count = 0;
    int64_t undecodable = 0;
    std::optional<int64_t> lost;
    int64_t last_utime = 0;
    ArrivalWindow window;
    std::string type = "none";
    const messaging::TypeLibrary::Type* decoded_type = nullptr;
    std::vector<char> newest;  ///< of the messages that decode
    bool has_many_senders = false;
    std::map<std::string, int64_t> last_seq;  ///< by sender
  };
  struct KnownType {
    const messaging::TypeLibrary::Type* type = nullptr;
    MessageLayout layout;
  };
  const KnownType* known(const void* data, std::size_t size);
  bool decodes(const MessageLayout& layout, const void* data, std::size_t size) const;
  std::optional<std::string> sender(const Channel& channel,
                                    const void* data,
                                    std::size_t size) const;
  void countGap(Channel& channel, int64_t seq, const std::string& sender);
  void nameUndecodable(Channel& channel,
                       const KnownType* type,
                       const void* data,
                       std::size_t size) const;

  const messaging::TypeLibrary& types_;
  std::map<std::string, Channel> channels_;
  std::unordered_map<const messaging::TypeLibrary::Type*, KnownType> known_;
  int64_t unlisted_ = 0;
};

}  // namespace fastball::launch
