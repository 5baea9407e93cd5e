#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "logger/log_edit.h"
#include "messaging/lcm_endpoint.h"

namespace fastball::launch {

struct ReplayOptions {
  logger::LogPart part;                      ///< what of the log is said
  double speed = 1;                          ///< times real time
  std::map<std::string, std::string> names;  ///< channels that are said under another name
  bool commands = false;                     ///< also channels that make a robot move
  bool paused = false;                       ///< begins paused
};

/// What the user of a replay sees and does meanwhile.
class ReplayConsole {
 public:
  virtual ~ReplayConsole() = default;
  /// Waits for input until `until_us` [us] of steadyUs() at the latest, and may return earlier.
  virtual void wait(int64_t until_us) = 0;
  virtual bool paused() = 0;
  virtual bool stopped() = 0;
  /// `time` [s] in the log from its first message, `share` of the file that has been read.
  virtual void show(double time, double share, int64_t said) = 0;
};

/// Says the messages of a log again, at their recorded intervals divided by the speed; a pause moves all that
/// follows. Channels that make a robot move (ARM_COMMAND, HAND_COMMAND, THROW_START, SCENE, ESTOP) are passed over
/// unless asked for; what counts is the name under which a message would be said.
/// @return how many messages were said.
/// @throw std::invalid_argument if the log cannot be read or holds no message, or an expression
///   does not parse.
int64_t replayLog(const std::string& log_path,
                  const ReplayOptions& options,
                  messaging::LcmEndpoint& endpoint,
                  ReplayConsole& console);

/// Steady time [us], origin arbitrary.
int64_t steadyUs();

}  // namespace fastball::launch
