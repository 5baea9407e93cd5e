#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "messaging/command_key.h"
#include "messaging/command_trailer.h"

namespace fastball::messaging {

/// A command's sender as its trailer names it.
struct CommandSender {
  uint64_t session = 0;  ///< drawn when it starts
  uint64_t counter = 0;  ///< of its commands
  int64_t utime = 0;     ///< [us since 1970], its wall time
  int32_t pid = 0;
  std::array<char, kTrailerNameBytes + 1> name{};
  std::array<char, kTrailerHostBytes + 1> host{};
};

/// Puts trailers behind the commands of one sender. Allocates nothing after its construction.
class CommandSigner {
 public:
  /// @param name of the sender, cut at kTrailerNameBytes
  CommandSigner(std::shared_ptr<const CommandKey> key, std::string_view name);
  /// Puts a trailer behind the `size` bytes of a message, for which `message` has room (kTrailerBytes). `utime`: wall time
  /// [us since 1970].
  void sign(std::string_view channel, void* message, std::size_t size, int64_t utime);

 private:
  std::shared_ptr<const CommandKey> key_;
  CommandSender sender_;
};

/// Lets in the commands of one channel that come from somebody who has the key, each once and in their order.
///
/// Within a session the counter must grow. A session that was not heard before must begin with a message whose time is this
/// machine's within kMostApartUs: a sender, or a receiver, that is started again goes on at once, and a recording of another day
/// does not. Sessions stand beside each other, so that a second sender does not throw out the first. Allocates nothing.
class CommandGuard {
 public:
  enum class Fault {
    kNone,
    kUntagged,  ///< no trailer
    kWrongTag,  ///< of another key, of another channel, or changed on its way
    kRepeated,  ///< counter not above that of a message heard before: replayed, doubled, or overtaken
    kOtherTime,  ///< a new session of another time
  };
  static constexpr int64_t kMostApartUs = 2'000'000;

  CommandGuard(std::shared_ptr<const CommandKey> key, std::string channel)
      : key_(std::move(key)), channel_(std::move(channel)) {}

  /// `utime`: wall time of the arrival [us since 1970].
  Fault check(const void* data, std::size_t size, int64_t utime);
  /// What was wrong with the message checked last, and whose it was or claims to be: "has a wrong tag: it claims ...".
  std::string words() const;
  /// Who said the message checked last, if it was let in: "controller (process 12 on robot)".
  std::string sender() const;

 private:
  struct Session {
    uint64_t id = 0;  ///< counter 0: free
    uint64_t counter = 0;
    int64_t utime = 0;  ///< of the newest message
  };
  Fault checkSession();
  Session& roomForOne();

  std::shared_ptr<const CommandKey> key_;
  std::string channel_;
  std::array<Session, 16> sessions_{};
  int64_t forgotten_utime_ = INT64_MIN;  ///< newest of the sessions that had to make room
  Fault fault_ = Fault::kNone;
  CommandSender sender_;  ///< of the message checked last
  int64_t arrived_ = 0;   ///< [us since 1970]
  uint64_t heard_ = 0;    ///< counter heard before
};

}  // namespace fastball::messaging
