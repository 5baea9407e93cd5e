// Key files, tags, and who is let in.
#include "messaging/command_key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <numeric>
#include <sstream>
#include <vector>

#include "messaging/command_guard.h"
#include "messaging/message_type.h"
#include "tests/config/temporary_folder.h"
#include "tests/messaging/examples.h"

namespace fastball::messaging {
namespace {

using examples::example;
using Fault = CommandGuard::Fault;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int64_t kNow = 1'800'000'000'000'000;  // [us since 1970]

std::shared_ptr<const CommandKey> keyOfByte(uint8_t first) {
  std::array<uint8_t, CommandKey::kBytes> bytes{};
  std::iota(bytes.begin(), bytes.end(), first);
  return std::make_shared<const CommandKey>(bytes);
}

class KeyFile : public ::testing::Test {
 protected:
  /// What read() says of a file of that text and mode.
  std::string fault(const std::string& text, mode_t mode = 0600) {
    const std::string path = folder_.write("some.key", text);
    chmod(path.c_str(), mode);
    try {
      CommandKey::read(path);
      return "";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(path));
      return error.what();
    }
  }
  config::TemporaryFolder folder_;
  const std::string hex_ = "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f";
};

TEST_F(KeyFile, IsMadeForItsOwnerAndNeverOverwritten) {
  const std::string path = folder_.path().string() + "/new.key";
  const CommandKey key = CommandKey::make(path);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0600U);
  EXPECT_EQ(CommandKey::read(path).id(), key.id());
  EXPECT_THROW(CommandKey::make(path), std::invalid_argument);
  EXPECT_EQ(CommandKey::read(path).id(), key.id());
  EXPECT_NE(CommandKey::make(path + "2").id(), key.id());
  EXPECT_THROW(CommandKey::make(folder_.path().string() + "/no/such/folder"), std::runtime_error);
}

TEST_F(KeyFile, IsHexadecimalOrBase64) {
  const std::string path = folder_.write("hex.key", "\n" + hex_ + "  \r\n");
  chmod(path.c_str(), 0600);
  EXPECT_EQ(CommandKey::read(path).id(), keyOfByte(0)->id());
  const std::string base64 =
      folder_.write("base64.key", "AAECAwQFBgcICQoLDA0ODxAREhMUFRYXGBkaGxwdHh8=\n");
  chmod(base64.c_str(), 0400);
  EXPECT_EQ(CommandKey::read(base64).id(), keyOfByte(0)->id());
}

TEST_F(KeyFile, ThatOthersCanGetAtIsRefused) {
  for (const mode_t mode : {0640U, 0604U, 0644U, 0660U, 0601U, 0777U})
    EXPECT_THAT(fault(hex_, mode), HasSubstr("chmod 600")) << std::oct << mode;
  EXPECT_EQ(fault(hex_, 0600), "");
}

TEST_F(KeyFile, ThatHoldsNoKeyIsRefused) {
  for (const std::string& text :
       {std::string(), hex_.substr(2), hex_ + "00", hex_ + " x", std::string("no key"),
        std::string(CommandKey::kBytes, '\x07'), hex_ + std::string(5000, ' ') + 'x'})
    EXPECT_THAT(fault(text), HasSubstr("holds no key")) << text;
  EXPECT_THROW(CommandKey::read(folder_.path().string() + "/none"), std::invalid_argument);
  EXPECT_THROW(CommandKey::read(folder_.path().string()), std::invalid_argument);
}

/// A sender of ARM_COMMANDs and who lets them in.
class Guarded : public ::testing::Test {
 protected:
  using Bytes = std::vector<uint8_t>;
  static Bytes message() {
    const auto command = example<arm_command_t>();
    Bytes bytes(static_cast<std::size_t>(command.getEncodedSize()));
    command.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  }
  static Bytes signedBy(CommandSigner& signer, int64_t utime = kNow) {
    Bytes bytes = message();
    const std::size_t size = bytes.size();
    bytes.resize(size + kTrailerBytes);
    signer.sign("ARM_COMMAND", bytes.data(), size, utime);
    return bytes;
  }
  Fault check(const Bytes& bytes, int64_t utime = kNow) {
    return guard_.check(bytes.data(), bytes.size(), utime);
  }

  std::shared_ptr<const CommandKey> key_ = keyOfByte(7);
  CommandSigner signer_{key_, "controller"};
  CommandGuard guard_{key_, "ARM_COMMAND"};
};

TEST_F(Guarded, CommandsOfWhoHasTheKeyComeIn) {
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(check(signedBy(signer_)), Fault::kNone);
  EXPECT_EQ(guard_.words(), "");
}

TEST_F(Guarded, TheMessageInFrontOfTheTrailerIsAsItWas) {
  const Bytes bytes = signedBy(signer_);
  const Bytes bare = message();
  ASSERT_EQ(withoutTrailer(bytes.data(), bytes.size()), bare.size());
  EXPECT_TRUE(std::equal(bare.begin(), bare.end(), bytes.begin()));
  arm_command_t decoded{};
  EXPECT_EQ(decoded.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(message().size()))
      << "LCM's own decoder";
}

TEST_F(Guarded, EveryChangedByteIsNoticed) {
  const Bytes good = signedBy(signer_);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const uint8_t flip : {0x01, 0x80, 0xff}) {
      Bytes bad = good;
      bad[i] ^= flip;
      const bool is_mark = i >= message().size() && i < message().size() + kTrailerMark.size();
      ASSERT_EQ(check(bad), is_mark ? Fault::kUntagged : Fault::kWrongTag) << i;
    }
  }
  EXPECT_EQ(check(good), Fault::kNone);
}

TEST_F(Guarded, EveryOtherLengthIsNoticed) {
  const Bytes good = signedBy(signer_);
  for (std::size_t n = 0; n < good.size(); ++n) {
    EXPECT_NE(check({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n)}), Fault::kNone);
    EXPECT_NE(check({good.begin() + static_cast<std::ptrdiff_t>(n + 1), good.end()}), Fault::kNone);
  }
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_EQ(check(longer), Fault::kUntagged);
}

TEST_F(Guarded, ABareMessageIsRefused) {
  EXPECT_EQ(check(message()), Fault::kUntagged);
  EXPECT_THAT(guard_.words(), HasSubstr("has no tag"));
}

TEST_F(Guarded, AnotherKeyIsRefusedAndItsOwnerNamed) {
  CommandSigner stranger(keyOfByte(8), "controller\n\x1b[2J");
  EXPECT_EQ(check(signedBy(stranger)), Fault::kWrongTag);
  EXPECT_THAT(guard_.words(), AllOf(HasSubstr("claims to come from controller??[2J (process " +
                                              std::to_string(getpid()) + " on "),
                                    HasSubstr("another key")));
}

TEST_F(Guarded, ATagHoldsOnItsOwnChannelOnly) {
  CommandGuard hand(key_, "HAND_COMMAND");
  const Bytes bytes = signedBy(signer_);
  EXPECT_EQ(hand.check(bytes.data(), bytes.size(), kNow), Fault::kWrongTag);
  // The channel's last letter may not become the message's first byte.
  Bytes shifted = bytes;
  shifted.insert(shifted.begin(), 'D');
  CommandGuard shorter(key_, "ARM_COMMAN");
  EXPECT_EQ(shorter.check(shifted.data(), shifted.size(), kNow), Fault::kWrongTag);
}

TEST_F(Guarded, EachMessageComesInOnceAndInOrder) {
  const Bytes first = signedBy(signer_), second = signedBy(signer_), third = signedBy(signer_),
              fourth = signedBy(signer_);
  EXPECT_EQ(check(first), Fault::kNone);
  EXPECT_EQ(check(first), Fault::kRepeated);
  EXPECT_EQ(check(third), Fault::kNone) << "one may be lost";
  EXPECT_EQ(check(second), Fault::kRepeated);
  EXPECT_THAT(guard_.words(), HasSubstr("has number 2 after number 3"));
  EXPECT_EQ(check(fourth), Fault::kNone);
}

TEST_F(Guarded, ARestartedSenderAndASecondOneComeInBesideTheFirst) {
  EXPECT_EQ(check(signedBy(signer_)), Fault::kNone);
  const Bytes old = signedBy(signer_);
  EXPECT_EQ(check(old), Fault::kNone);
  CommandSigner second(key_, "controller");
  EXPECT_EQ(check(signedBy(second)), Fault::kNone);
  EXPECT_EQ(check(signedBy(signer_)), Fault::kNone);
  EXPECT_EQ(check(signedBy(second)), Fault::kNone);
  EXPECT_EQ(check(old), Fault::kRepeated);
}

TEST_F(Guarded, ARestartedReceiverTakesThePresentAndNoRecording) {
  const Bytes recorded = signedBy(signer_, kNow - CommandGuard::kMostApartUs - 1);
  EXPECT_EQ(check(recorded), Fault::kOtherTime);
  EXPECT_THAT(guard_.words(), AllOf(HasSubstr("controller"), HasSubstr("-2.000 s from now")));
  EXPECT_EQ(check(signedBy(signer_, kNow + CommandGuard::kMostApartUs + 1)), Fault::kOtherTime);
  EXPECT_EQ(check(signedBy(signer_, INT64_MIN)), Fault::kOtherTime);
  EXPECT_EQ(check(signedBy(signer_, INT64_MAX)), Fault::kOtherTime);
  EXPECT_EQ(check(signedBy(signer_, kNow - CommandGuard::kMostApartUs)), Fault::kNone);
}

TEST_F(Guarded, AClockThatIsSetInMidSessionStopsNobody) {
  EXPECT_EQ(check(signedBy(signer_)), Fault::kNone);
  EXPECT_EQ(check(signedBy(signer_, kNow - 3'600'000'000)), Fault::kNone);
  EXPECT_EQ(check(signedBy(signer_), kNow + 3'600'000'000), Fault::kNone);
}

TEST_F(Guarded, ManySessionsDoNotLetAForgottenOneInAgain) {
  const Bytes first = signedBy(signer_, kNow);
  EXPECT_EQ(check(first), Fault::kNone);
  for (int i = 1; i <= 100; ++i) {
    CommandSigner another(key_, "controller");
    EXPECT_EQ(check(signedBy(another, kNow + i)), Fault::kNone) << i;
  }
  EXPECT_EQ(check(first), Fault::kOtherTime);
}

TEST(CommandChannels, LeaveRoomForATrailerInOneFrame) {
  auto request = example<plan_request_t>();
  request.strategy.assign(kNameBytes, 's');
  for (const int bytes :
       {example<arm_command_t>().getEncodedSize(), example<hand_command_t>().getEncodedSize(),
        example<throw_start_t>().getEncodedSize(), example<scene_t>().getEncodedSize(),
        request.getEncodedSize()})
    EXPECT_LE(static_cast<std::size_t>(bytes) + kTrailerBytes, kControlBytes);
}

TEST(CommandChannels, AreThoseThatMoveTheRobot) {
  for (const char* channel : {"ARM_COMMAND", "HAND_COMMAND", "SWING_PLAN", "PLAN_REQUEST",
                              "THROW_START", "SCENE", "GRIP"})
    EXPECT_TRUE(isCommandChannel(channel)) << channel;
  for (const char* channel : {"ESTOP", "ARM_STATE", "HAND_STATE", "HEARTBEAT", "RELEASE",
                              "CAMERA_LEFT", "ARM_COMMAND2", "ARM", ""})
    EXPECT_FALSE(isCommandChannel(channel)) << channel;
}

}  // namespace
}  // namespace fastball::messaging
