#include "sim_bullet/config.h"

namespace fastball::sim_bullet {
namespace {

StopSettings readStop(config::Section section) {
  StopSettings stop;
  stop.stiffness = section.number("stiffness", {0, 1e6});
  stop.damping = section.number("damping", {0, 1e4});
  section.finish();
  return stop;
}

TactileSettings readTactile(config::Section section) {
  TactileSettings tactile;
  tactile.noise = section.number("noise", {0, 1});
  tactile.delay = section.number("delay", {0, 0.02});
  tactile.resolution = section.number("resolution", {0, 1});
  section.finish();
  return tactile;
}

CurtainSettings readCurtain(config::Section section) {
  CurtainSettings curtain;
  curtain.noise = section.number("noise", {0, 1});
  section.finish();
  return curtain;
}

NetSettings readNet(config::Section section) {
  NetSettings net;
  net.tube_radius = section.number("tube_radius", {1e-3, 0.05});
  net.ring_stiffness = section.number("ring_stiffness", {1, 1e6});
  net.ring_damping = section.number("ring_damping", {0, 1e4});
  net.friction = section.number("friction", {0, 10});
  net.bag_depth = section.number("bag_depth", {0.1, 5});
  net.bag_time = section.number("bag_time", {1e-3, 10});
  net.bag_stiffness = section.number("bag_stiffness", {1, 1e4});
  section.finish();
  return net;
}

FloorSettings readFloor(config::Section section) {
  FloorSettings floor;
  floor.height = section.number("height", {-100, 0});
  floor.friction = section.number("friction", {0, 10});
  floor.restitution = section.number("restitution", {0, 1});
  section.finish();
  return floor;
}

}  // namespace

SimulationSettings loadSimulationSettings(const std::string& experiment_path) {
  config::Section section = config::processSection(experiment_path, "simulation");
  SimulationSettings settings;
  settings.substeps = section.integer("substeps", 1, 1000);
  settings.watchdog = section.number("watchdog", {1e-3, 1});
  settings.brake_damping = section.vector("brake_damping", 4, {0, 1e3});
  settings.arm_stop = readStop(section.section("arm_stop"));
  settings.wrist_stop = readStop(section.section("wrist_stop"));
  settings.finger_stop = readStop(section.section("finger_stop"));
  settings.spread_limit = section.number("spread_limit", {0, 3.2});
  settings.flexion_limit = section.number("flexion_limit", {0, 3.2});
  settings.open_clearance = section.number("open_clearance", {0, 0.1});
  settings.feeder_release = section.number("feeder_release", {0, 100});
  settings.feeder_frequency = section.number("feeder_frequency", {10, 2000});
  settings.tactile = readTactile(section.section("tactile"));
  settings.light_curtain = readCurtain(section.section("light_curtain"));
  settings.net = readNet(section.section("net"));
  settings.floor = readFloor(section.section("floor"));
  section.finish();
  return settings;
}

}  // namespace fastball::sim_bullet
