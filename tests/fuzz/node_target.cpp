#include "tests/fuzz/node_target.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace fastball::fuzz {
namespace {

/// A node may ask to be stepped again at once, but not for ever.
constexpr int kMostSteps = 1000;

}  // namespace

struct NodeTarget::Life {
  explicit Life(const Make& make)
      : endpoint("memq://"), node(make(endpoint, clock)), heartbeat(endpoint, clock, *node) {}
  messaging::ManualClock clock;
  messaging::LcmEndpoint endpoint;
  std::unique_ptr<messaging::Node> node;
  messaging::Heartbeat heartbeat;
};

NodeTarget::NodeTarget(std::string name, int lifetime, Make make)
    : name_(std::move(name)), lifetime_(lifetime), make_(std::move(make)) {
  // A warning for each broken message is right, and would be most of the work.
  spdlog::set_level(spdlog::level::err);
  renew();
  for (const std::string& channel : channelsOf(name_)) {
    if (name_ != "logger" && life_->endpoint.counts().count(channel) == 0)
      die(fmt::format("{} does not hear {}", name_, channel));
  }
  for (const auto& [channel, counts] : life_->endpoint.counts()) {
    const auto& known = channelsOf(name_);
    if (std::find(known.begin(), known.end(), channel) == known.end())
      die(fmt::format("{} hears {}, which no input says", name_, channel));
  }
}

NodeTarget::~NodeTarget() = default;

void NodeTarget::renew() {
  life_.reset();
  life_ = std::make_unique<Life>(make_);
  age_ = 0;
}

void NodeTarget::step() {
  messaging::Node& node = *life_->node;
  int steps = 0;
  do {
    if (++steps > kMostSteps)
      die(fmt::format("{} wants to be stepped without end", name_));
    node.step();
    life_->heartbeat.update(0);
  } while (!node.finished() && node.wakeUs() <= life_->clock.monotonicUs());
}

void NodeTarget::hear(const uint8_t* data, std::size_t size) {
  if (++age_ > lifetime_)
    renew();
  for (const Said& said : parse(data, size)) {
    life_->endpoint.publishBytes(said.channel, said.message.data(), said.message.size());
    life_->endpoint.drain();
    life_->clock.advanceUs(pauseUs(said.pause));
    step();
    if (life_->node->state().state.empty())
      die(fmt::format("{} has no state", name_));
    if (life_->endpoint.unsent() > 0)
      die(fmt::format("{} says what breaks a rule", name_));
    if (life_->node->finished()) {
      life_->node->shutDown();
      life_->heartbeat.sayLast();
      renew();
    }
  }
}

void die(const std::string& sentence) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  std::abort();
}

std::string experimentPath() {
  return FASTBALL_SOURCE_DIR "/config/experiment.yaml";
}

}  // namespace fastball::fuzz
