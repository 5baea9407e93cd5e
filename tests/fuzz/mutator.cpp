// How one conversation becomes another: most of it stays a message that decodes, so that the handlers behind the checks are met.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tests/fuzz/conversation.h"

extern "C" std::size_t LLVMFuzzerMutate(uint8_t* data, std::size_t size, std::size_t max_size);

namespace fastball::fuzz {
namespace {

constexpr std::size_t kFingerprintBytes = 8;
constexpr std::size_t kMostMessages = 64;
constexpr std::size_t kRoom = 64;  // bytes that one mutation may add to a message

class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  void apply(std::vector<Said>& conversation) {
    if (conversation.empty())
      conversation.push_back({allChannels().front(), 0, Bytes(kFingerprintBytes)});
    const std::size_t at = below(conversation.size());
    Said& said = conversation[at];
    switch (below(10)) {
      case 0:
        if (conversation.size() < kMostMessages)
          conversation.insert(conversation.begin() + static_cast<std::ptrdiff_t>(at), said);
        break;
      case 1:
        std::swap(said, conversation[below(conversation.size())]);
        break;
      case 2:
        if (conversation.size() > 1)
          conversation.erase(conversation.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 3:
        said.pause = static_cast<uint8_t>(below(4) == 0 ? below(256) : below(16));
        break;
      case 4:
        mutateFreely(said.message);
        break;
      case 5:
        said.message.resize(below(said.message.size() + 2));
        break;
      default:
        putOddNumber(said.message);
    }
  }

 private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }

  /// As the fuzzer likes, behind the type's fingerprint.
  void mutateFreely(Bytes& message) {
    if (message.size() <= kFingerprintBytes)
      return;
    const std::size_t size = message.size() - kFingerprintBytes;
    message.resize(message.size() + kRoom);
    message.resize(kFingerprintBytes +
                   LLVMFuzzerMutate(message.data() + kFingerprintBytes, size, size + kRoom));
  }

  double oddReal() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double kOdd[] = {0,    -0.0,  -1,  1,     2,         -0.5,       1e-3,         1e-308,
                           1e12, 1e300, 1e3, -1e18, kInfinity, -kInfinity, std::nan(""), 3.2};
    return kOdd[below(std::size(kOdd))];
  }
  int64_t oddInteger() {
    const int64_t kOdd[] = {0,         -1,        1,    2,    100,       INT32_MAX, INT32_MIN,
                            INT64_MAX, INT64_MIN, 1000, 8192, 1LL << 59, 600'000,   256};
    return kOdd[below(std::size(kOdd))];
  }

  /// One number that a field may begin with, big endian; most fields have eight bytes and stand at the front.
  void putOddNumber(Bytes& message) {
    if (message.size() < 2 * kFingerprintBytes)
      return;
    uint64_t value = 0;
    if (below(2) == 0) {
      const double real = oddReal();
      std::memcpy(&value, &real, sizeof(value));
    } else {
      value = static_cast<uint64_t>(oddInteger());
    }
    std::size_t bytes = std::array<std::size_t, 4>{8, 8, 4, 1}[below(4)];
    const std::size_t places = message.size() - kFingerprintBytes - bytes;
    std::size_t place = below(below(2) == 0 ? std::min<std::size_t>(places, 200) : places);
    if (below(4) != 0)
      place -= place % 8;
    for (std::size_t i = 0; i < bytes; ++i)
      message[kFingerprintBytes + place + i] = static_cast<uint8_t>(value >> (8 * (bytes - 1 - i)));
  }

  std::minstd_rand random_;
};

}  // namespace
}  // namespace fastball::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(uint8_t* data,
                                               std::size_t size,
                                               std::size_t max_size,
                                               unsigned seed) {
  using namespace fastball::fuzz;
  std::vector<Said> conversation = parse(data, size);
  Mutation mutation(seed);
  for (unsigned i = 0; i <= seed % 3; ++i)
    mutation.apply(conversation);
  const Bytes bytes = serialise(conversation);
  const std::size_t kept = std::min(bytes.size(), max_size);
  std::copy_n(bytes.begin(), kept, data);
  return kept;
}
