#include "launch/run_config.h"

#include "config/experiment.h"

namespace fastball::launch {

namespace {

AimSettings readAdaptive(config::Section section) {
  AimSettings aim;
  aim.drag = section.number("drag", {0, 1});
  aim.velocity = section.number("velocity", {0, 2});
  aim.place = section.number("place", {0, 0.5});
  aim.drift = section.number("drift", {0, 0.9});
  aim.scatter = section.number("scatter", {1e-3, 0.5});
  aim.gate = section.number("gate", {1, 20});
  section.finish();
  return aim;
}

}  // namespace

RunConfig loadRunConfig(const std::string& experiment_path) {
  config::Section section = config::processSection(experiment_path, "run");
  RunConfig run;
  run.strategy = section.choice("strategy", kStrategies);
  run.settle = section.number("settle", {0.05, 5.0});
  run.scene_period = section.number("scene_period", {1.0, 3600.0});
  run.camera_lead = section.number("camera_lead", {0.0, 5.0});
  run.camera_tail = section.number("camera_tail", {0.0, 5.0});
  run.scene_tail = section.number("scene_tail", {0.0, 5.0});
  run.repeat_interval = section.number("repeat_interval", {0.01, 10.0});
  run.answer_timeout = section.number("answer_timeout", {0.1, 3600.0});
  run.start_timeout = section.number("start_timeout", {0.1, 3600.0});
  run.listen_time = section.number("listen_time", {0.0, 60.0});
  run.stop_grace = section.number("stop_grace", {0.0, 60.0});
  run.adaptive = readAdaptive(section.section("adaptive"));
  section.finish();
  return run;
}

}  // namespace fastball::launch
