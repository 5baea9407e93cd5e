#pragma once

#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "launch/view/figure.h"
#include "launch/view/kept.h"
#include "launch/view/time_axis.h"
#include "launch/view/viewed_throw.h"
#include "messaging/channels.h"

namespace fastball::view {

/// Where each value stands in a Sample.
enum SampleValue {
  kSpeed = 0,                                 ///< [rad/s], four joints
  kTorque = kSpeed + model::kArmJoints,       ///< [N m]
  kAngle = kTorque + model::kArmJoints,       ///< [rad]
  kNormal = kAngle + model::kArmJoints,       ///< [N], three fingers
  kTangential = kNormal + model::kFingers,    ///< [N], magnitude
  kArmPhase = kTangential + model::kFingers,  ///< of arm_command_t
  kHandPhase = kArmPhase + 1,                 ///< of hand_command_t
  kPoints = kHandPhase + 1,                   ///< [m], of FigurePoint, x y z each
  kSampleValues = kPoints + 3 * kFigurePoints
};

// In all of these t [s] is on the time axis (TimeAxis).

/// Arm and hand at one time; what was not heard is not a number.
struct Sample {
  double t = 0;
  std::array<float, kSampleValues> values;
};

struct Heard {
  double t = 0;
  int64_t utime = 0;  ///< [us], received
  heartbeat_t heartbeat;
};

struct Picture {
  double t = 0;
  std::shared_ptr<const image_t> image;  ///< null where it stays in a log
  int64_t log_offset = -1;               ///< [bytes], of its record
};

struct TrackPoint {
  double t = 0;
  int64_t number = 0;    ///< of the throw
  Eigen::Vector3d p_W;   ///< [m], of the ball
  bool measured = true;  ///< false: before the first fit, by that fit run backwards
};

/// How much a timeline remembers.
struct TimelineLimits {
  std::size_t samples = 120'000;  ///< two minutes at 1 kHz
  std::size_t heartbeats = 5'000;
  std::size_t track_points = 50'000;
  std::size_t throws = 1'000;
  std::size_t pictures = 100'000;                ///< of one camera
  std::size_t picture_bytes = 64 * 1024 * 1024;  ///< of one camera
  int keep_every = 1;                            ///< of the samples
};

/// What the messages of an experiment have told, in the order of its time axis: all that viewers
/// see. Messages come in by take(); what does not decode or breaks its rule is counted. SIM_TRUTH
/// is not among what it knows: nobody but the judge hears that.
class Timeline {
 public:
  /// `floor` [m]: as of Figure.
  Timeline(const config::Experiment& experiment, double floor, TimelineLimits limits = {});
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// An encoded message, received at `utime` [us since 1970]. `log_offset`: of its record [bytes]
  /// where it comes from a log, which keeps its images.
  void take(const std::string& channel,
            const void* data,
            std::size_t size,
            int64_t utime,
            int64_t log_offset = -1);
  /// A regular expression for the channels that it knows.
  std::string channels() const;

  /// [s], of the newest message.
  double now() const { return axis_.now(); }
  const Kept<Sample>& samples() const { return samples_; }
  const Kept<Heard>& heartbeats() const { return heartbeats_; }
  const Kept<TrackPoint>& track() const { return track_; }
  const std::deque<ViewedThrow>& throws() const { return throws_; }
  const std::map<std::string, Kept<Picture>>& pictures() const { return pictures_; }
  /// Of the newest change of a throw.
  int64_t serial() const { return serial_; }
  /// The log that the experiment's logger writes, or empty.
  const std::string& recordedIn() const { return recorded_in_; }
  const Figure& figure() const { return figure_; }

  struct Count {
    int64_t taken = 0;
    int64_t invalid = 0;
    int64_t newest_utime = 0;  ///< [us], received
  };
  const std::map<std::string, Count>& counts() const { return counts_; }
  int64_t taken(const std::string& channel) const;

 private:
  using Hear = std::function<bool(const void* data, std::size_t size)>;
  template <class T>
  void know(const messaging::Channel<T>& channel, void (Timeline::*member)(const T&));

  void hear(const arm_state_t& state);
  void hear(const hand_state_t& state);
  void hear(const arm_command_t& command) { arm_phase_ = command.phase; }
  void hear(const hand_command_t& command) { hand_phase_ = command.phase; }
  void hear(const controller_status_t& status);
  void hear(const estop_t& estop);
  void hear(const plan_request_t& request);
  void hear(const swing_plan_t& plan);
  void hear(const throw_start_t& start);
  void hear(const release_t& release);
  void hear(const ball_track_t& track);
  void hear(const landing_t& landing);
  void hear(const heartbeat_t& heartbeat);
  void hear(const logger_status_t& status) { recorded_in_ = status.path; }
  bool hearImage(const std::string& channel, const void* data, std::size_t size);

  /// Makes room for a state of `utime` in the sample that is being made. @return false if it has been said before.
  bool beginSample(int64_t scene_id, int64_t utime);
  void endSample();
  ViewedThrow& newThrow(int64_t id);
  /// The newest throw of this number in messages; makes one where none has been heard of.
  ViewedThrow& throwOf(int64_t id);
  void changed(ViewedThrow& viewed) { viewed.serial = ++serial_; }
  void note(ViewedThrow& viewed, const std::string& sentence);
  double timeOf(const ViewedThrow& viewed, int64_t utime) const;
  void addPathToFirstFit(const ViewedThrow& viewed, const ball_track_t& first);

  const config::Experiment experiment_;
  const Figure figure_;
  const TimelineLimits limits_;
  std::map<std::string, Hear> hearers_;
  std::map<std::string, Count> counts_;
  TimeAxis axis_;
  int64_t utime_ = 0;        // of the message being taken
  int64_t log_offset_ = -1;  // likewise

  struct Unfinished {
    double t = 0;
    int64_t utime = std::numeric_limits<int64_t>::min();
    std::optional<arm_state_t> arm;
    std::optional<hand_state_t> hand;
  } unfinished_;
  std::optional<hand_state_t> last_hand_;
  int64_t unfinished_count_ = 0;
  float arm_phase_, hand_phase_;

  Kept<Sample> samples_;
  Kept<Heard> heartbeats_;
  Kept<TrackPoint> track_;
  std::deque<ViewedThrow> throws_;
  int64_t throw_count_ = 0;
  std::map<std::string, Kept<Picture>> pictures_;
  std::map<std::string, std::size_t> picture_bytes_;
  int64_t serial_ = 0;
  std::string recorded_in_;
};

}  // namespace fastball::view
