#include "messaging/command_guard.h"

#include <endian.h>
#include <fmt/format.h>
#include <sodium.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace fastball::messaging {
namespace {

constexpr double kSeconds = 1e-6;

/// Writes and reads the trailer from its front.
class Place {
 public:
  explicit Place(uint8_t* at) : at_(at) {}
  void put(const void* data, std::size_t size) {
    std::memcpy(at_, data, size);
    at_ += size;
  }
  void put64(uint64_t value) {
    const uint64_t bytes = htobe64(value);
    put(&bytes, sizeof bytes);
  }
  void put32(uint32_t value) {
    const uint32_t bytes = htobe32(value);
    put(&bytes, sizeof bytes);
  }
  uint8_t* at() const { return at_; }

 private:
  uint8_t* at_;
};

uint64_t get64(const uint8_t* at) {
  uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  return be64toh(bytes);
}

CommandSender senderIn(const uint8_t* trailer) {
  CommandSender sender;
  sender.session = get64(trailer + 8);
  sender.counter = get64(trailer + 16);
  sender.utime = static_cast<int64_t>(get64(trailer + 24));
  uint32_t pid = 0;
  std::memcpy(&pid, trailer + 32, sizeof pid);
  sender.pid = static_cast<int32_t>(be32toh(pid));
  std::memcpy(sender.name.data(), trailer + 36, kTrailerNameBytes);
  std::memcpy(sender.host.data(), trailer + 36 + kTrailerNameBytes, kTrailerHostBytes);
  return sender;
}

/// Anyone can write anything into a trailer.
template <std::size_t kBytes>
std::string printable(const std::array<char, kBytes>& text) {
  std::string words(text.data());
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return words;
}

std::string wordsOn(const CommandSender& sender) {
  return fmt::format("{} (process {} on {})", printable(sender.name), sender.pid,
                     printable(sender.host));
}

}  // namespace

CommandSigner::CommandSigner(std::shared_ptr<const CommandKey> key, std::string_view name)
    : key_(std::move(key)) {
  randombytes_buf(&sender_.session, sizeof sender_.session);
  sender_.pid = getpid();
  name.copy(sender_.name.data(), kTrailerNameBytes);
  gethostname(sender_.host.data(), kTrailerHostBytes);
}

void CommandSigner::sign(std::string_view channel, void* message, std::size_t size, int64_t utime) {
  Place place(static_cast<uint8_t*>(message) + size);
  place.put(kTrailerMark.data(), kTrailerMark.size());
  place.put64(sender_.session);
  place.put64(++sender_.counter);
  place.put64(static_cast<uint64_t>(utime));
  place.put32(static_cast<uint32_t>(sender_.pid));
  place.put(sender_.name.data(), kTrailerNameBytes);
  place.put(sender_.host.data(), kTrailerHostBytes);
  key_->tag(channel, message, size + kTrailerBytes - kTagBytes, place.at());
}

CommandGuard::Fault CommandGuard::check(const void* data, std::size_t size, int64_t utime) {
  arrived_ = utime;
  if (!hasTrailer(data, size))
    return fault_ = Fault::kUntagged;
  const auto* bytes = static_cast<const uint8_t*>(data);
  sender_ = senderIn(bytes + size - kTrailerBytes);
  const std::size_t tagged = size - kTagBytes;
  if (!key_->isTag(channel_, data, tagged, bytes + tagged))
    return fault_ = Fault::kWrongTag;
  return fault_ = checkSession();
}

CommandGuard::Fault CommandGuard::checkSession() {
  const auto known = std::find_if(sessions_.begin(), sessions_.end(), [this](const Session& s) {
    return s.counter > 0 && s.id == sender_.session;
  });
  if (known != sessions_.end()) {
    heard_ = known->counter;
    if (sender_.counter <= known->counter)
      return Fault::kRepeated;
    known->counter = sender_.counter;
    known->utime = sender_.utime;
    return Fault::kNone;
  }
  const bool of_now = sender_.utime >= arrived_ - kMostApartUs &&
                      sender_.utime <= arrived_ + kMostApartUs &&
                      sender_.utime > forgotten_utime_ && sender_.counter > 0;
  if (!of_now)
    return Fault::kOtherTime;
  roomForOne() = {sender_.session, sender_.counter, sender_.utime};
  return Fault::kNone;
}

/// Where all places are taken, the session that was silent for longest makes room; what it said must not come in as new.
CommandGuard::Session& CommandGuard::roomForOne() {
  Session& oldest =
      *std::min_element(sessions_.begin(), sessions_.end(), [](const Session& a, const Session& b) {
        return (a.counter > 0 ? a.utime : INT64_MIN) < (b.counter > 0 ? b.utime : INT64_MIN);
      });
  if (oldest.counter > 0)
    forgotten_utime_ = std::max(forgotten_utime_, oldest.utime);
  return oldest;
}

std::string CommandGuard::sender() const {
  return fault_ == Fault::kNone ? wordsOn(sender_) : "";
}

std::string CommandGuard::words() const {
  switch (fault_) {
    case Fault::kNone:
      break;
    case Fault::kUntagged:
      return "has no tag: its sender has no --key, and LCM does not tell who that is";
    case Fault::kWrongTag:
      return fmt::format(
          "has a wrong tag: it claims to come from {}, which has another key, or it is forged",
          wordsOn(sender_));
    case Fault::kRepeated:
      return fmt::format("of {} has number {} after number {}: replayed, doubled or overtaken",
                         wordsOn(sender_), sender_.counter, heard_);
    case Fault::kOtherTime:
      return fmt::format(
          "of {} was sent {:.3f} s from now by its sender's clock, above {} s: a recording, or "
          "clocks "
          "that differ",
          wordsOn(sender_),
          kSeconds * (static_cast<double>(sender_.utime) - static_cast<double>(arrived_)),
          kMostApartUs / 1'000'000);
  }
  return "";
}

}  // namespace fastball::messaging
