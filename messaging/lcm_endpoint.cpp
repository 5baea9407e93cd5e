#include "messaging/lcm_endpoint.h"

#include <fmt/format.h>
#include <lcm/lcm.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "messaging/clock.h"
#include "messaging/command_guard.h"
#include "messaging/multicast_check.h"
#include "messaging/receiver.h"
#include "messaging/refusals.h"

namespace fastball::messaging {
namespace {

constexpr const char* kReceiveBuffer = "recv_buf_size=4194304";

/// What the subscriptions of an endpoint with a key tell it.
struct Entrance {
  Refusals refusals;
  const CommandGuard* passed = nullptr;  ///< who let in the message that is being handled
};

/// LCM's face of one subscription to a typed channel.
class TypedSubscription {
 public:
  /// `key`: null for none. What it keeps out is told in `entrance`, under `channel`.
  TypedSubscription(Receiver receiver,
                    const std::string& channel,
                    const std::shared_ptr<const CommandKey>& key,
                    Entrance& entrance)
      : receiver_(std::move(receiver)),
        message_(receiver_.type().make()),
        is_command_(isCommandChannel(channel)),
        entrance_(entrance) {
    if (key && is_command_)
      guard_.emplace(key, channel);
  }
  Receiver& receiver() { return receiver_; }

  void onMessage(const lcm_recv_buf_t& buffer, const char* channel) {
    // No exception may pass through LCM's C code: its next handle() would abort the process.
    try {
      if (guard_ && !passes(buffer, channel))
        return;
      const MessageType& type = receiver_.type();
      const auto size = static_cast<int>(is_command_ ? withoutTrailer(buffer.data, buffer.data_size)
                                                     : buffer.data_size);
      if (type.decode(message_.get(), buffer.data, size) != size) {
        receiver_.refuse(fmt::format("{}: {} bytes do not decode to its type", channel, size));
      } else if (const auto broken = type.fault(message_.get())) {
        receiver_.refuse(*broken);
      } else {
        entrance_.passed = guard_ ? &*guard_ : nullptr;
        receiver_.deliver(message_.get());
        entrance_.passed = nullptr;
      }
    } catch (const std::exception& error) {
      receiver_.refuse(fmt::format("{}: {}", channel, error.what()));
    }
  }

 private:
  bool passes(const lcm_recv_buf_t& buffer, const char* channel) {
    if (guard_->check(buffer.data, buffer.data_size, buffer.recv_utime) ==
        CommandGuard::Fault::kNone)
      return true;
    receiver_.refuseSilently();
    if (worthALine(++kept_out_))
      entrance_.refusals.tell(channel, kept_out_, guard_->words());
    return false;
  }

  Receiver receiver_;
  std::shared_ptr<void> message_;
  bool is_command_;
  std::optional<CommandGuard> guard_;
  int64_t kept_out_ = 0;
  Entrance& entrance_;
};

/// LCM's face of one subscription to undecoded channels.
class RawSubscription {
 public:
  explicit RawSubscription(LcmEndpoint::RawHandler handler) : handler_(std::move(handler)) {}

  void onMessage(const lcm_recv_buf_t& buffer, const char* channel) {
    if (failure_)
      return;
    try {
      handler_(channel, buffer.data, buffer.data_size, buffer.recv_utime);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
  void rethrow() {
    if (failure_)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  LcmEndpoint::RawHandler handler_;
  std::exception_ptr failure_;
};

/// What LCM calls: `subscription` is one of the two above.
template <class Subscription>
void onMessage(const lcm_recv_buf_t* buffer, const char* channel, void* subscription) {
  static_cast<Subscription*>(subscription)->onMessage(*buffer, channel);
}

/// @throw std::invalid_argument if the URL does not parse.
/// @throw std::runtime_error if the network does not carry it.
std::unique_ptr<lcm_t, void (*)(lcm_t*)> open(const std::string& url) {
  checkMulticast(url);
  std::unique_ptr<lcm_t, void (*)(lcm_t*)> lcm(lcm_create(url.c_str()), lcm_destroy);
  if (lcm)
    return lcm;
  throw std::invalid_argument(
      fmt::format("LCM cannot open the URL \"{}\"; expected udpm://GROUP:PORT?ttl=N, such as {}",
                  url, kDefaultLcmUrl));
}

}  // namespace

std::string defaultLcmUrl() {
  for (const char* name : {"FASTBALL_LCM_URL", "LCM_DEFAULT_URL"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0')
      return value;
  }
  return kDefaultLcmUrl;
}

std::string withReceiveBuffer(const std::string& url) {
  if (url.rfind("udpm://", 0) != 0 || url.find("recv_buf_size=") != std::string::npos)
    return url;
  return url + (url.find('?') == std::string::npos ? "?" : "&") + kReceiveBuffer;
}

struct LcmEndpoint::Impl {
  Impl(const std::string& its_url,
       std::shared_ptr<const CommandKey> its_key,
       const std::string& name)
      : url(withReceiveBuffer(its_url)),
        lcm(open(url)),
        file_descriptor(lcm_get_fileno(lcm.get())),
        key(std::move(its_key)) {
    if (key)
      signer.emplace(key, name);
    // LCM starts its reader when it is asked for the descriptor; where that fails, lcm_handle() would abort the process.
    if (file_descriptor < 0) {
      throw std::runtime_error(
          fmt::format("LCM cannot receive from {}; what it printed above says why", url));
    }
  }

  template <class Subscription>
  void subscribe(const char* channel_regex, Subscription& subscription) {
    lcm_subscription_t* handle =
        lcm_subscribe(lcm.get(), channel_regex, onMessage<Subscription>, &subscription);
    if (handle == nullptr)
      throw std::invalid_argument(fmt::format("LCM cannot subscribe to {}", channel_regex));
    // 0: unlimited. LCM's default queue of 30 drops the newest in silence.
    lcm_subscription_set_queue_capacity(handle, 0);
  }

  std::string url;
  std::unique_ptr<lcm_t, void (*)(lcm_t*)> lcm;
  void makeRoom(std::size_t bytes) { send_buffer.resize(std::max(send_buffer.size(), bytes)); }
  /// True where a message gets a trailer.
  bool signs(std::string_view channel) const { return signer && isCommandChannel(channel); }
  /// Signs what is in send_buffer and sends it.
  bool publishSigned(LcmEndpoint& endpoint, const std::string& channel, std::size_t size) {
    signer->sign(channel, send_buffer.data(), size, clock.wallUs());
    return endpoint.publishBytes(channel, send_buffer.data(), size + kTrailerBytes);
  }

  int file_descriptor;
  std::shared_ptr<const CommandKey> key;
  std::optional<CommandSigner> signer;
  SystemClock clock;
  Entrance entrance;
  std::map<std::string, ReceiveCounts> counts;
  std::map<std::string, TypedSubscription> typed;
  std::vector<std::unique_ptr<RawSubscription>> raw;
  std::vector<char> send_buffer;
  UnsentCount unsent;
};

LcmEndpoint::LcmEndpoint(const std::string& url,
                         std::shared_ptr<const CommandKey> key,
                         const std::string& name)
    : impl_(std::make_unique<Impl>(url, std::move(key), name)) {}

LcmEndpoint::~LcmEndpoint() = default;

int LcmEndpoint::drain() {
  int handled = 0;
  while (handled < kDrainLimit) {
    const int result = lcm_handle_timeout(impl_->lcm.get(), 0);
    if (result > 0)
      ++handled;
    if (result == 0 || (result < 0 && errno != EINTR))
      break;
  }
  for (const auto& subscription : impl_->raw)
    subscription->rethrow();
  return handled;
}

const std::map<std::string, ReceiveCounts>& LcmEndpoint::counts() const {
  return impl_->counts;
}

int64_t LcmEndpoint::unsent() const {
  return impl_->unsent.value();
}

const std::string& LcmEndpoint::url() const {
  return impl_->url;
}

int LcmEndpoint::fileDescriptor() const {
  return impl_->file_descriptor;
}

bool LcmEndpoint::publishBytes(const std::string& channel, const void* data, std::size_t size) {
  if (lcm_publish(impl_->lcm.get(), channel.c_str(), data, static_cast<unsigned>(size)) == 0)
    return true;
  impl_->unsent.add(fmt::format("{}: the network refused {} bytes", channel, size));
  return false;
}

bool LcmEndpoint::publishRecorded(const std::string& channel, const void* data, std::size_t size) {
  if (!impl_->signs(channel))
    return publishBytes(channel, data, size);
  size = withoutTrailer(data, size);
  impl_->makeRoom(size + kTrailerBytes);
  std::copy_n(static_cast<const char*>(data), size, impl_->send_buffer.data());
  return impl_->publishSigned(*this, channel, size);
}

const std::string& LcmEndpoint::refusals() const {
  return impl_->entrance.refusals.sentence();
}

std::string LcmEndpoint::sender() const {
  return impl_->entrance.passed != nullptr ? impl_->entrance.passed->sender() : "";
}

std::string LcmEndpoint::keyId() const {
  return impl_->key ? impl_->key->id() : "";
}

void LcmEndpoint::subscribeRaw(const std::string& channel_regex, RawHandler handler) {
  impl_->raw.push_back(std::make_unique<RawSubscription>(std::move(handler)));
  impl_->subscribe(channel_regex.c_str(), *impl_->raw.back());
}

bool LcmEndpoint::publishErased(const char* channel,
                                std::size_t max_bytes,
                                const void* message,
                                const MessageType& type) {
  const bool is_signed = impl_->signs(channel);
  const std::size_t trailer = is_signed ? kTrailerBytes : 0;
  if (const auto why = refusal(channel, max_bytes - std::min(max_bytes, trailer), message, type)) {
    impl_->unsent.add(*why);
    return false;
  }
  const int size = type.encodedSize(message);
  impl_->makeRoom(static_cast<std::size_t>(size) + trailer);
  if (type.encode(message, impl_->send_buffer.data(), size) != size) {
    impl_->unsent.add(fmt::format("{}: does not encode", channel));
    return false;
  }
  if (is_signed)
    return impl_->publishSigned(*this, channel, static_cast<std::size_t>(size));
  return publishBytes(channel, impl_->send_buffer.data(), static_cast<std::size_t>(size));
}

void LcmEndpoint::subscribeErased(const char* channel,
                                  bool one_sender,
                                  const MessageType& type,
                                  std::function<void(const void*)> handler) {
  auto entry = impl_->typed.find(channel);
  if (entry == impl_->typed.end()) {
    Receiver receiver(channel, one_sender, type, impl_->counts[channel]);
    entry =
        impl_->typed.try_emplace(channel, std::move(receiver), channel, impl_->key, impl_->entrance)
            .first;
    impl_->subscribe(channel, entry->second);
  }
  entry->second.receiver().addHandler(std::move(handler));
}

}  // namespace fastball::messaging
