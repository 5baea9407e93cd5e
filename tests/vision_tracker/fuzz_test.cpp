// Spoilt messages of every kind at the tracker's door: it must live, say nothing that breaks a rule, and then measure a throw.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include "messaging/image_channel.h"
#include "messaging/receiver.h"
#include "tests/vision_tracker/messages.h"
#include "vision_tracker/node.h"

namespace fastball::vision_tracker {
namespace {

using Bytes = std::vector<uint8_t>;

/// Takes bytes as the network does, and keeps what the node says.
class BytesEndpoint : public messaging::Endpoint {
 public:
  void say(const std::string& channel, const Bytes& bytes) {
    messaging::Receiver& receiver = receivers_.at(channel);
    const std::shared_ptr<void> message = receiver.type().make();
    const auto size = static_cast<int>(bytes.size());
    if (receiver.type().decode(message.get(), bytes.data(), size) != size)
      receiver.refuse("does not decode");
    else if (const auto broken = receiver.type().fault(message.get()))
      receiver.refuse(*broken);
    else
      receiver.deliver(message.get());
  }
  int drain() override { return 0; }
  const std::map<std::string, messaging::ReceiveCounts>& counts() const override { return counts_; }
  int64_t unsent() const override { return unsent_; }

  std::vector<landing_t> landings;

 protected:
  bool publishErased(const char* channel,
                     std::size_t max_bytes,
                     const void* message,
                     const messaging::MessageType& type) override {
    if (const auto why = messaging::refusal(channel, max_bytes, message, type)) {
      ++unsent_;
      ADD_FAILURE() << *why;
      return false;
    }
    if (std::string(channel) == messaging::kLanding.name)
      landings.push_back(*static_cast<const landing_t*>(message));
    return true;
  }
  void subscribeErased(const char* channel,
                       bool one_sender,
                       const messaging::MessageType& type,
                       std::function<void(const void*)> handler) override {
    receivers_.try_emplace(channel, channel, one_sender, type, counts_[channel])
        .first->second.addHandler(std::move(handler));
  }

 private:
  std::map<std::string, messaging::ReceiveCounts> counts_;
  std::map<std::string, messaging::Receiver> receivers_;
  int64_t unsent_ = 0;
};

template <class T>
Bytes encoded(const T& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

class Fuzz : public ::testing::TestWithParam<unsigned> {
 protected:
  Fuzz() : random_(GetParam()) {
    messaging::ProcessOptions options;
    options.config = ::fastball::testing::experimentPath();
    node_ = makeNode(endpoint_, clock_, options);
    sim_bullet::CameraRigOptions rig = sim_bullet::readCameraRig(options.config);
    rig.workers = 2;
    rig_ = std::make_unique<sim_bullet::CameraRig>(rig, experiment_.arm, experiment_.hand,
                                                   experiment_.ball.radius);
    images_ = bench::renderThrow(*rig_, experiment_, made_, 1);
  }

  std::size_t below(std::size_t limit) { return random_() % limit; }
  double oddNumber() {
    const double kOdd[] = {0.0,   -1.0,   1e-308,
                           1e308, -1e308, std::nan(""),
                           1e6,   -0.5,   std::numeric_limits<double>::infinity(),
                           1.0,   2.0,    1e3};
    return kOdd[below(std::size(kOdd))];
  }
  int64_t oddInteger() {
    const int64_t kOdd[] = {0, -1, 1, INT64_MAX, INT64_MIN, INT32_MAX, 1LL << 59, 60000, 8192};
    return kOdd[below(std::size(kOdd))];
  }

  /// What goes wrong on the way.
  Bytes spoilt(Bytes bytes) {
    switch (below(4)) {
      case 0:
        bytes.resize(below(bytes.size()));
        break;
      case 1:
        for (std::size_t i = below(8) + 1; i > 0; --i)
          bytes[below(bytes.size())] = static_cast<uint8_t>(random_());
        break;
      case 2:  // most fields stand at the front
        bytes[below(std::min<std::size_t>(bytes.size(), 120))] ^=
            static_cast<uint8_t>(1U << below(8));
        break;
      default:
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())), below(20),
                     static_cast<uint8_t>(random_()));
    }
    return bytes;
  }

  void sayRequest(bool good, int64_t id) {
    plan_request_t m = ::fastball::testing::requestMessage(experiment_, id);
    if (!good && below(2) == 0) {
      m.p_WTarget[below(3)] = oddNumber();
      m.n_WTarget[below(3)] = oddNumber();
      m.request_id = oddInteger();
    }
    const Bytes bytes = encoded(m);
    endpoint_.say("PLAN_REQUEST", good || below(2) == 0 ? bytes : spoilt(bytes));
  }

  void sayInfo(bool good, std::size_t camera) {
    camera_info_t m = ::fastball::testing::infoMessage(rig_->cameras()[camera]);
    if (!good && below(2) == 0) {
      double* const kFields[] = {&m.K[below(9)],    &m.D[below(5)], &m.R_CW[below(9)],
                                 &m.p_CW[below(3)], &m.rate,        &m.exposure};
      *kFields[below(std::size(kFields))] = oddNumber();
      if (below(4) == 0)
        m.width = static_cast<int32_t>(oddInteger());
    }
    const Bytes bytes = encoded(m);
    endpoint_.say("CAMERA_INFO", good || below(2) == 0 ? bytes : spoilt(bytes));
  }

  void sayImage(bool good, const sim_bullet::RenderedImage& image) {
    image_t m = ::fastball::testing::imageMessage(image);
    if (!good && below(2) == 0) {
      switch (below(4)) {
        case 0:
          m.utime = oddInteger();
          break;
        case 1:
          m.width = m.row_stride = static_cast<int32_t>(oddInteger());
          break;
        case 2:
          m.pixelformat =
              static_cast<int32_t>(below(2) == 0 ? oddInteger() : int64_t{image_t::GRAY});
          break;
        default:  // the JPEG itself
          m.data = spoilt(m.data);
          m.size = static_cast<int32_t>(m.data.size());
      }
    }
    const Bytes bytes = encoded(m);
    endpoint_.say(rig_->cameras()[static_cast<std::size_t>(image.camera)].channel,
                  good || below(2) == 0 ? bytes : spoilt(bytes));
  }

  config::Experiment experiment_ = config::loadExperiment(::fastball::testing::experimentPath());
  bench::SyntheticThrow made_ = bench::makeThrow(experiment_, 1);
  std::unique_ptr<sim_bullet::CameraRig> rig_;
  std::vector<sim_bullet::RenderedImage> images_;
  std::mt19937 random_;
  messaging::ManualClock clock_;
  BytesEndpoint endpoint_;
  std::unique_ptr<messaging::Node> node_;
};

TEST_P(Fuzz, IsOutlived) {
  std::size_t next = 0;
  for (int i = 0; i < 500; ++i) {
    switch (below(20)) {
      case 0:
        sayRequest(below(2) == 0, i + 1);
        break;
      case 1:
      case 2:
        sayInfo(below(2) == 0, below(2));
        break;
      default:
        sayImage(below(4) != 0, images_[next++ % images_.size()]);
    }
    clock_.advanceUs(static_cast<int64_t>(below(50'000)));
    if (below(100) == 0)
      clock_.advanceUs(10'000'000);
    node_->step();
    EXPECT_FALSE(node_->state().state.empty());
  }
  int64_t refused = 0;
  for (const auto& [channel, counts] : endpoint_.counts())
    refused += counts.invalid;
  EXPECT_GT(refused, 30);
  for (const landing_t& landing : endpoint_.landings)
    EXPECT_TRUE(landing.measured == 1 || !landing.message.empty());
  // And then all is well again.
  endpoint_.landings.clear();
  sayInfo(true, 0);
  sayInfo(true, 1);
  sayRequest(true, 1'000'000);
  for (const sim_bullet::RenderedImage& image : images_) {
    sayImage(true, image);
    node_->step();
  }
  ASSERT_FALSE(endpoint_.landings.empty());
  const landing_t& landing = endpoint_.landings.back();
  EXPECT_EQ(landing.request_id, 1'000'000);
  ASSERT_EQ(landing.measured, 1) << landing.message;
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(landing.landing[i], made_.landing.landing[i], 3e-3);
  EXPECT_EQ(endpoint_.unsent(), 0);
}

TEST_P(Fuzz, PixelFormatsThatAreNoneAreCountedAndSaid) {
  sayInfo(true, 0);
  sayInfo(true, 1);
  sayRequest(true, 1);
  for (int i = 0; i < 20; ++i) {
    image_t m = ::fastball::testing::imageMessage(images_[static_cast<std::size_t>(i)]);
    m.pixelformat = 861030210;  // BGR
    endpoint_.say("CAMERA_LEFT", encoded(m));
    node_->step();
  }
  clock_.advanceUs(node_->wakeUs() - clock_.monotonicUs());
  node_->step();
  ASSERT_EQ(endpoint_.landings.size(), 1u);
  EXPECT_EQ(endpoint_.landings[0].measured, 0);
  EXPECT_EQ(endpoint_.landings[0].message,
            "not measured: no image came; 20 images could not be used, the first: an image message "
            "was cut off, or of a pixel format other than GRAY and MJPEG");
}

INSTANTIATE_TEST_SUITE_P(Seeds, Fuzz, ::testing::Values(1U, 2U));

}  // namespace
}  // namespace fastball::vision_tracker
