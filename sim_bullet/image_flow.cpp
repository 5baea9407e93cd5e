#include "sim_bullet/image_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fastball::sim_bullet {
namespace {

constexpr int64_t kRepeatUs = 50000;    // wall time; an answer takes some 2 ms where cores are free
constexpr int64_t kGiveUpUs = 1000000;  // wall time; 20 times said
constexpr std::size_t kMostWaiting = 8;  // of a camera: 33 ms at 240 Hz

messaging::Channel<image_t> imageChannel(const std::string& name) {
  for (const auto& channel : {messaging::kCameraLeft, messaging::kCameraRight}) {
    if (name == channel.name)
      return channel;
  }
  throw std::invalid_argument(fmt::format("camera channel '{}' is none of {} and {}", name,
                                          messaging::kCameraLeft.name,
                                          messaging::kCameraRight.name));
}

}  // namespace

ImageFlow::ImageFlow(messaging::Endpoint& endpoint,
                     const messaging::Clock& clock,
                     const std::vector<std::string>& channels,
                     bool lockstep)
    : clock_(clock), lockstep_(lockstep) {
  for (const std::string& name : channels)
    streams_.push_back({name, {endpoint, imageChannel(name)}, {}});
  if (!lockstep)
    return;
  endpoint.subscribe<heartbeat_t>(messaging::kHeartbeat, [this](const heartbeat_t& m) {
    if (m.name == "vision_tracker")
      tracker_ = m.state != "ended";
  });
  endpoint.subscribe<ball_observation_t>(messaging::kBallObservation,
                                         [this](const ball_observation_t& m) { hear(m); });
}

void ImageFlow::beginScene() {
  for (Stream& stream : streams_) {
    stream.queue.clear();
    stream.under_way = false;
  }
}

void ImageFlow::add(std::size_t camera, image_t message) {
  streams_.at(camera).queue.push_back(std::move(message));
}

void ImageFlow::hear(const ball_observation_t& answer) {
  for (Stream& stream : streams_) {
    if (stream.channel != answer.channel)
      continue;
    stream.heard = true;
    if (!stream.under_way || stream.queue.front().utime != answer.utime)
      continue;
    stream.queue.pop_front();
    stream.under_way = false;
  }
}

void ImageFlow::say() {
  for (Stream& stream : streams_)
    say(stream);
}

void ImageFlow::say(Stream& stream) {
  const int64_t now = clock_.monotonicUs();
  if (stream.under_way && now - stream.first_said_us >= kGiveUpUs)
    stream.heard = false;
  if (!paced(stream)) {
    sayRest(stream);
    return;
  }
  if (stream.queue.empty() || (stream.under_way && now - stream.said_us < kRepeatUs))
    return;
  if (!std::exchange(stream.under_way, true))
    stream.first_said_us = now;
  stream.said_us = now;
  stream.images.publish(stream.queue.front());
}

void ImageFlow::sayRest() {
  for (Stream& stream : streams_)
    sayRest(stream);
}

void ImageFlow::sayRest(Stream& stream) {
  if (std::exchange(stream.under_way, false))
    stream.queue.pop_front();
  for (; !stream.queue.empty(); stream.queue.pop_front())
    stream.images.publish(stream.queue.front());
}

bool ImageFlow::behind() const {
  return std::any_of(streams_.begin(), streams_.end(),
                     [](const Stream& stream) { return stream.queue.size() > kMostWaiting; });
}

bool ImageFlow::empty() const {
  return std::all_of(streams_.begin(), streams_.end(),
                     [](const Stream& stream) { return stream.queue.empty(); });
}

}  // namespace fastball::sim_bullet
