#include "bench/key_rows.h"

#include <memory>
#include <stdexcept>

#include "bench/timing.h"
#include "messaging/clock.h"
#include "messaging/command_guard.h"
#include "messaging/message_type.h"

namespace fastball::bench {
namespace {

constexpr double kMicro = 1e6;

/// An ARM_COMMAND from its fields to its fields, as sender and receiver do it, with or without a key.
class Passage {
 public:
  explicit Passage(bool is_keyed) : is_keyed_(is_keyed) {}
  void run() {
    ++command_.tick;
    auto size = static_cast<std::size_t>(type_.encodedSize(&command_));
    type_.encode(&command_, bytes_.data(), static_cast<int>(size));
    if (is_keyed_) {
      signer_.sign(kChannel, bytes_.data(), size, clock_.wallUs());
      size += messaging::kTrailerBytes;
      if (guard_.check(bytes_.data(), size, clock_.wallUs()) !=
          messaging::CommandGuard::Fault::kNone)
        throw std::logic_error("a signed command was refused");
    }
    size = messaging::withoutTrailer(bytes_.data(), size);
    if (type_.decode(&received_, bytes_.data(), static_cast<int>(size)) < 0 ||
        received_.tick != command_.tick)
      throw std::logic_error("a command was not received as it was sent");
  }

 private:
  static constexpr const char* kChannel = "ARM_COMMAND";
  const messaging::MessageType& type_ = messaging::messageType<arm_command_t>();
  const messaging::SystemClock clock_;
  const std::shared_ptr<const messaging::CommandKey> key_ =
      std::make_shared<const messaging::CommandKey>(
          std::array<uint8_t, messaging::CommandKey::kBytes>{1, 2, 3});
  messaging::CommandSigner signer_{key_, "controller"};
  messaging::CommandGuard guard_{key_, kChannel};
  bool is_keyed_;
  arm_command_t command_{}, received_{};
  std::array<char, messaging::kControlBytes> bytes_{};
};

double secondsPerPassage(const std::string& id, bool is_keyed) {
  Passage passage(is_keyed);
  return cpuSecondsPerCall(id, [&] { passage.run(); });
}

}  // namespace

std::vector<Benchmark> keyBenchmarks() {
  return {{"lcm.key_us", [] {
             return Row{"lcm.key_us",
                        secondsPerPassage("lcm.key_us", true) * kMicro,
                        "us",
                        "the same without a key",
                        secondsPerPassage("lcm.bare_us", false) * kMicro,
                        "ARM_COMMAND encoded, signed, verified, decoded; CPU time of one core"};
           }}};
}

}  // namespace fastball::bench
