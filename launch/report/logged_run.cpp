#include "launch/report/logged_run.h"

#include <cmath>
#include <filesystem>
#include <future>
#include <stdexcept>
#include <tuple>

#include "launch/log_endpoint.h"

namespace fastball::launch {
namespace {

/// Hears what a report needs of a run beside the throws' own records.
class Listener {
 public:
  Listener(messaging::Endpoint& log, LoggedRun& run) : run_(run), judge_(log) {
    using namespace messaging;
    recordThrows(log, records_);
    log.subscribe<heartbeat_t>(kHeartbeat, [this](const heartbeat_t& m) { take(m); });
    log.subscribe<ball_observation_t>(kBallObservation, [this](const auto& m) {
      run_.throws[m.request_id].observations.push_back(m);
    });
    log.subscribe<camera_info_t>(kCameraInfo,
                                 [this](const auto& m) { run_.cameras[m.channel] = m; });
    log.subscribe<estop_t>(kEstop, [this](const auto& m) { run_.stops.push_back(m.reason); });
    log.subscribe<controller_status_t>(kControllerStatus, [this](const auto& m) {
      std::string& brake = run_.throws[m.scene_id].brake;
      if (m.phase == arm_command_t::BRAKE && brake.empty())
        brake = "the arm " + m.message;
    });
    log.subscribe<sim_truth_t>(kSimTruth, [this](const sim_truth_t& m) {
      if (m.event == sim_truth_t::SAMPLE)
        run_.throws[m.scene_id].flight.push_back(m);
    });
  }

  /// After the log's last message.
  void finish() {
    for (auto& [number, record] : records_)
      run_.throws[number].record = std::move(record);
    run_.throws.erase(0);  // what was said between the throws
    for (auto& [number, thrown] : run_.throws)
      thrown.truth = judge_.of(number);
  }

 private:
  void take(const heartbeat_t& m) {
    const auto [place, is_new] =
        places_.try_emplace(std::make_tuple(m.host, m.name, m.pid), run_.processes.size());
    if (is_new)
      run_.processes.emplace_back();
    run_.processes[place->second].heartbeats.push_back(m);
  }

  LoggedRun& run_;
  Judge judge_;
  std::map<int64_t, ThrowRecord> records_;
  std::map<std::tuple<std::string, std::string, int32_t>, std::size_t> places_;
};

bool holdsNothing(const std::string& path) {
  logger::LogReader reader(path);
  logger::LogEntry entry;
  return !reader.next(entry);
}

}  // namespace

LoggedRun readRun(const std::string& log_path) {
  LoggedRun run;
  run.path = log_path;
  run.record = logger::readRunRecord(log_path);
  if (holdsNothing(log_path))
    return run;
  auto summary = std::async(std::launch::async, [&] {
    const messaging::TypeLibrary types;
    return logger::summarise(log_path, types);
  });
  LogEndpoint log;
  Listener listener(log, run);
  log.play(log_path);
  listener.finish();
  run.summary = summary.get();
  return run;
}

model::Target targetOf(const LoggedThrow& thrown, const config::Experiment& experiment) {
  model::Target target = experiment.target;
  const auto take = [&target](const auto& message) {
    target.p_WTarget = Eigen::Map<const Eigen::Vector3d>(message.p_WTarget);
    target.n_WTarget = Eigen::Map<const Eigen::Vector3d>(message.n_WTarget);
    target.radius = message.target_radius;
  };
  if (thrown.record.request)
    take(*thrown.record.request);
  else if (thrown.record.scene)
    take(*thrown.record.scene);
  return target;
}

JudgedThrow judgedThrow(int64_t number,
                        const LoggedThrow& thrown,
                        const config::Experiment& experiment) {
  const ThrowRecord& record = thrown.record;
  Throw seen;
  seen.number = static_cast<int>(number);
  seen.scene_id = number;
  seen.note = thrown.brake;
  if (record.plan) {
    seen.plan_ms = record.plan->plan_ms;
    seen.planned_speed = Eigen::Map<const Eigen::Vector3d>(record.plan->v_WBall_release).norm();
  }
  if (record.scene)
    seen.duration = record.scene->duration;
  if (thrown.isMeasured()) {
    const landing_t& landing = *record.landing;
    seen.measured = true;
    seen.landing = {landing.landing[0], landing.landing[1]};
    seen.landing_sigma = {std::sqrt(landing.cov_landing[0]), std::sqrt(landing.cov_landing[2])};
  } else {
    const std::string why = record.landing ? record.landing->message : "no LANDING";
    seen.note += (seen.note.empty() ? "" : "; ") + why;
  }
  const double radius = targetOf(thrown, experiment).radius;
  JudgedThrow judged = judge(seen, thrown.truth, radius);
  if (!thrown.hasTruth())
    judged.hit = seen.measured && seen.landing.norm() < radius;
  return judged;
}

bool isDecided(const LoggedThrow& thrown) {
  if (thrown.hasTruth())
    return thrown.truth.landing || thrown.truth.finished;
  return thrown.record.landing.has_value();
}

std::optional<Eigen::Vector2d> decidingLanding(const LoggedThrow& thrown) {
  if (thrown.hasTruth())
    return thrown.truth.landing;
  if (!thrown.isMeasured())
    return {};
  return Eigen::Vector2d(thrown.record.landing->landing[0], thrown.record.landing->landing[1]);
}

bool isClean(const LoggedThrow& thrown, const config::Experiment& experiment) {
  const auto landing = decidingLanding(thrown);
  return landing && landing->norm() + experiment.ball.radius < targetOf(thrown, experiment).radius;
}

}  // namespace fastball::launch
