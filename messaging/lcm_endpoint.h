#pragma once

#include <memory>
#include <string>

#include "messaging/command_key.h"
#include "messaging/endpoint.h"

namespace fastball::messaging {

inline constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

/// The channel on which LCM talks to itself when it starts.
inline constexpr const char* kSelfTestChannel = "LCM_SELF_TEST";

/// The URL used when none is named: $FASTBALL_LCM_URL, else $LCM_DEFAULT_URL, else kDefaultLcmUrl.
std::string defaultLcmUrl();

/// The URL with recv_buf_size=4194304 added where it names none: with the kernel's default, images
/// are lost.
std::string withReceiveBuffer(const std::string& url);

/// An endpoint over LCM 1.3.1, with that library's traps closed: URL with buffer size, start-up
/// check, unlimited queues, full drain, decode to the last byte, exceptions kept inside handlers.
///
/// With a key, it puts a trailer behind every command that it sends (messaging/command_trailer.h), and refuses and counts as
/// invalid every command that it hears without a right one (messaging/command_guard.h). Without a key, it takes commands with
/// and without a trailer, whatever its tag.
class LcmEndpoint : public Endpoint {
 public:
  /// Takes less than 1 s.
  /// @param key null for none
  /// @param name who says the commands, such as "controller"
  /// @throw std::invalid_argument if the URL does not parse.
  /// @throw std::runtime_error if the network cannot carry it, with one sentence that names the URL
  ///   and how to mend it (no multicast route: the `ip route add` to give).
  explicit LcmEndpoint(const std::string& url,
                       std::shared_ptr<const CommandKey> key = nullptr,
                       const std::string& name = "");
  ~LcmEndpoint() override;

  /// As Endpoint::drain(), but returns after kDrainLimit messages, so that a flood cannot keep the
  /// node from its step.
  int drain() override;
  static constexpr int kDrainLimit = 10000;
  const std::map<std::string, ReceiveCounts>& counts() const override;
  int64_t unsent() const override;
  std::string sender() const override;

  const std::string& url() const;
  /// File descriptor that becomes readable when messages wait.
  int fileDescriptor() const;
  /// Sends bytes as they are, unchecked: for replay and for tests with hostile bytes.
  /// @return false if the network refused them; counted in unsent()
  bool publishBytes(const std::string& channel, const void* data, std::size_t size);
  /// The same, but with this endpoint's key, if it has one, a command gets a trailer of its own, in place of one that it has.
  bool publishRecorded(const std::string& channel, const void* data, std::size_t size);
  /// "refused 4 ARM_COMMANDs; the first has no tag: ...", of each command channel on which the key kept any out; renewed at
  /// the 1st, 2nd, 4th, ... of them; or empty.
  const std::string& refusals() const;
  /// That of the key (CommandKey::id()), or empty.
  std::string keyId() const;
  /// `utime`: receive time [us since 1970].
  using RawHandler = std::function<
      void(const std::string& channel, const void* data, std::size_t size, int64_t utime)>;
  /// Hears every channel whose whole name the expression matches, undecoded: for the logger and
  /// spy. A handler that throws makes drain() throw, and hears no more until then.
  /// @throw std::invalid_argument if the expression does not parse.
  void subscribeRaw(const std::string& channel_regex, RawHandler handler);

 protected:
  bool publishErased(const char* channel,
                     std::size_t max_bytes,
                     const void* message,
                     const MessageType& type) override;
  void subscribeErased(const char* channel,
                       bool one_sender,
                       const MessageType& type,
                       std::function<void(const void*)> handler) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastball::messaging
