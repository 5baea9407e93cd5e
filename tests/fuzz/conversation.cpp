#include "tests/fuzz/conversation.h"

#include <algorithm>
#include <map>

namespace fastball::fuzz {
namespace {

constexpr std::size_t kHeaderBytes = 4;
constexpr std::size_t kLongestMessage = 0xffff;

}  // namespace

int64_t pauseUs(uint8_t pause) {
  return int64_t{pause} * pause * 100;
}

const std::vector<std::string>& allChannels() {
  static const std::vector<std::string> channels = {
      "ARM_COMMAND", "ARM_STATE",   "BALL_OBSERVATION", "BALL_TRACK",
      "CAMERA_INFO", "CAMERA_LEFT", "CAMERA_RIGHT",     "CONTROLLER_STATUS",
      "ESTOP",       "GRIP",        "HAND_COMMAND",     "HAND_STATE",
      "HEARTBEAT",   "LANDING",     "LOGGER_STATUS",    "PLAN_REQUEST",
      "RELEASE",     "SCENE",       "SIM_TRUTH",        "SWING_PLAN",
      "THROW_START"};
  return channels;
}

const std::vector<std::string>& channelsOf(const std::string& target) {
  static const std::map<std::string, std::vector<std::string>> heard = {
      {"planner", {"PLAN_REQUEST"}},
      {"controller", {"ARM_STATE", "ESTOP", "GRIP", "SWING_PLAN", "THROW_START"}},
      {"hand_server", {"ARM_STATE", "ESTOP", "HAND_STATE", "SWING_PLAN", "THROW_START"}},
      {"sim_bullet", {"ARM_COMMAND", "BALL_OBSERVATION", "HAND_COMMAND", "HEARTBEAT", "SCENE"}},
      {"vision_tracker", {"CAMERA_INFO", "CAMERA_LEFT", "CAMERA_RIGHT", "PLAN_REQUEST", "SCENE"}},
      {"experiment",
       {"ARM_STATE", "BALL_OBSERVATION", "BALL_TRACK", "CONTROLLER_STATUS", "HAND_STATE",
        "HEARTBEAT", "LANDING", "PLAN_REQUEST", "RELEASE", "SCENE", "SIM_TRUTH", "SWING_PLAN",
        "THROW_START"}},
      {"logger", allChannels()},
      {"spy", allChannels()}};
  return heard.at(target);
}

std::vector<Said> parse(const uint8_t* data, std::size_t size) {
  std::vector<Said> conversation;
  while (size >= kHeaderBytes) {
    const std::string& channel = allChannels()[data[0] % allChannels().size()];
    const uint8_t pause = data[1];
    const std::size_t length = std::size_t{data[2]} << 8 | data[3];
    data += kHeaderBytes;
    size -= kHeaderBytes;
    const std::size_t bytes = std::min(length, size);
    conversation.push_back({channel, pause, Bytes(data, data + bytes)});
    data += bytes;
    size -= bytes;
  }
  return conversation;
}

Bytes serialise(const std::vector<Said>& conversation) {
  Bytes bytes;
  for (const Said& said : conversation) {
    const auto place = std::find(allChannels().begin(), allChannels().end(), said.channel);
    const std::size_t length = std::min(said.message.size(), kLongestMessage);
    bytes.insert(bytes.end(), {static_cast<uint8_t>(place - allChannels().begin()), said.pause,
                               static_cast<uint8_t>(length >> 8), static_cast<uint8_t>(length)});
    bytes.insert(bytes.end(), said.message.begin(),
                 said.message.begin() + static_cast<std::ptrdiff_t>(length));
  }
  return bytes;
}

}  // namespace fastball::fuzz
