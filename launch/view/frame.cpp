#include "launch/view/frame.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "messaging/version.h"

namespace fastball::view {
namespace {

using nlohmann::json;

constexpr std::size_t kAlignment = 8;
/// In one frame, likewise.
constexpr int64_t kFrameThings = 5'000;

json numbers(const model::Vector4& v) {
  return {v[0], v[1], v[2], v[3]};
}

/// What of `kept` comes after `next`, which is moved to its end: [from, to).
template <class T>
std::pair<int64_t, int64_t> newOf(const Kept<T>& kept, int64_t& next, int64_t most) {
  const int64_t from = std::max(next, kept.first());
  const int64_t to = std::min(kept.end(), from + most);
  next = to;
  return {from, to};
}

json heartbeatJson(const Heard& heard, int64_t wall_us) {
  const heartbeat_t& said = heard.heartbeat;
  return {{"t", heard.t},
          {"age", 1e-6 * static_cast<double>(wall_us - heard.utime)},
          {"name", said.name},
          {"host", said.host},
          {"pid", said.pid},
          {"version", said.version},
          {"state", said.state},
          {"detail", said.detail},
          {"lost", said.lost},
          {"invalid", said.invalid},
          {"meanUs", said.loop_mean_us},
          {"maxUs", said.loop_max_us}};
}

json newPictures(const Timeline& timeline, Cursor& cursor) {
  json all = json::object();
  for (const auto& [channel, kept] : timeline.pictures()) {
    const auto [from, to] = newOf(kept, cursor.pictures[channel], kFrameThings);
    cursor.whole = cursor.whole && to == kept.end();
    if (from == to)
      continue;
    json times = json::array();
    for (int64_t i = from; i < to; ++i)
      times.push_back(kept.at(i)->t);
    all[channel] = {{"from", from}, {"kept", kept.first()}, {"t", std::move(times)}};
  }
  return all;
}

json newTrack(const Timeline& timeline, Cursor& cursor) {
  const auto [from, to] = newOf(timeline.track(), cursor.track, kFrameThings);
  cursor.whole = cursor.whole && to == timeline.track().end();
  json points = json::array();
  for (int64_t i = from; i < to; ++i) {
    const TrackPoint& point = *timeline.track().at(i);
    points.push_back({point.number, point.t, point.p_W.x(), point.p_W.y(), point.p_W.z(),
                      point.measured ? 1 : 0});
  }
  return points;
}

json newHeartbeats(const Timeline& timeline, Cursor& cursor, int64_t wall_us) {
  const auto [from, to] = newOf(timeline.heartbeats(), cursor.heartbeat, kFrameThings);
  cursor.whole = cursor.whole && to == timeline.heartbeats().end();
  json all = json::array();
  for (int64_t i = from; i < to; ++i)
    all.push_back(heartbeatJson(*timeline.heartbeats().at(i), wall_us));
  return all;
}

json newThrows(const Timeline& timeline, Cursor& cursor) {
  json changed = json::array();
  for (const ViewedThrow& viewed : timeline.throws()) {
    if (viewed.serial > cursor.throw_serial)
      changed.push_back(toJson(viewed));
  }
  cursor.throw_serial = timeline.serial();
  return changed;
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

}  // namespace

std::string text(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

json hello(const Timeline& timeline, const config::Experiment& experiment, double floor) {
  json parts = json::array();
  for (const FigurePart& part : timeline.figure().parts())
    parts.push_back(
        {{"from", part.from}, {"to", part.to}, {"radius", part.radius}, {"hand", part.hand}});
  json rest = json::array();
  for (const Eigen::Vector3f& p : timeline.figure().points(experiment.q_rest, {}))
    rest.push_back(toJson(p.cast<double>()));
  return {{"version", messaging::version()},
          {"rest", rest},
          {"layout",
           {{"speed", kSpeed},
            {"torque", kTorque},
            {"angle", kAngle},
            {"normal", kNormal},
            {"tangential", kTangential},
            {"armPhase", kArmPhase},
            {"handPhase", kHandPhase},
            {"points", kPoints},
            {"values", kSampleValues}}},
          {"parts", parts},
          {"heldBall", kHeldBall},
          {"ballRadius", experiment.ball.radius},
          {"arm", experiment.arm.profile},
          {"speedLimits", numbers(experiment.arm.qd_max)},
          {"torqueLimits", numbers(experiment.arm.tau_max)},
          {"target", toJson(experiment.target)},
          {"floor", floor}};
}

std::string nextFrame(const Timeline& timeline, Cursor& cursor, const json& more, int64_t wall_us) {
  cursor.whole = true;
  const int64_t asked = cursor.sample;
  const auto [from, to] = newOf(timeline.samples(), cursor.sample, kFrameSamples);
  cursor.whole = to == timeline.samples().end();
  json header = {{"samples", to - from}};
  bool any = to > from;
  const auto add = [&header, &any](const char* name, json things) {
    if (things.empty())
      return;
    header[name] = std::move(things);
    any = true;
  };
  if (asked < from && asked > 0)
    header["skipped"] = from - asked;
  add("heartbeats", newHeartbeats(timeline, cursor, wall_us));
  add("track", newTrack(timeline, cursor));
  add("throws", newThrows(timeline, cursor));
  add("pictures", newPictures(timeline, cursor));
  if (!any && more.is_null())
    return "";
  header["now"] = timeline.now();
  header["whole"] = cursor.whole;
  if (!more.is_null())
    header.update(more);
  std::string words = text(header);
  words.append((kAlignment - (words.size() + sizeof(uint32_t)) % kAlignment) % kAlignment, ' ');
  const auto length = static_cast<uint32_t>(words.size());
  std::string bytes;
  bytes.reserve(sizeof(length) + words.size() +
                static_cast<std::size_t>(to - from) * sizeof(Sample));
  append(bytes, &length, sizeof(length));
  bytes += words;
  for (int64_t i = from; i < to; ++i)
    append(bytes, &timeline.samples().at(i)->t, sizeof(double));
  for (int64_t i = from; i < to; ++i) {
    const auto& values = timeline.samples().at(i)->values;
    append(bytes, values.data(), sizeof(values));
  }
  return bytes;
}

}  // namespace fastball::view
