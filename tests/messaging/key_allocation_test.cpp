// Signing a command and letting it in, or not, allocates nothing.
#include <gtest/gtest.h>

#include <array>

#include "messaging/command_guard.h"
#include "tests/kit/allocation_count.h"

namespace fastball::messaging {
namespace {

TEST(Allocation, NoneBySigningAndChecking) {
  using Fault = CommandGuard::Fault;
  const auto key = std::make_shared<const CommandKey>(std::array<uint8_t, CommandKey::kBytes>{1});
  CommandSigner signer(key, "controller");
  CommandGuard guard(key, "ARM_COMMAND");
  std::array<char, kControlBytes> message{};
  constexpr std::size_t kSize = 89;
  int accepted = 0, repeated = 0, wrong = 0;
  const long before = test_kit::allocations();
  for (int i = 0; i < 1000; ++i) {
    signer.sign("ARM_COMMAND", message.data(), kSize, i);
    const auto fault = [&] { return guard.check(message.data(), kSize + kTrailerBytes, i); };
    accepted += fault() == Fault::kNone;
    repeated += fault() == Fault::kRepeated;
    message[7] ^= 1;
    wrong += fault() == Fault::kWrongTag;
  }
  EXPECT_EQ(test_kit::allocations() - before, 0);
  EXPECT_EQ(accepted, 1000);
  EXPECT_EQ(repeated, 1000);
  EXPECT_EQ(wrong, 1000);
  EXPECT_FALSE(guard.words().empty());
  EXPECT_GT(test_kit::allocations(), before) << "the counter counts";
}

}  // namespace
}  // namespace fastball::messaging
