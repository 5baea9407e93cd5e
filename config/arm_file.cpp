#include "config/arm_file.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

namespace fastball::config {

namespace {

constexpr double kPi = 3.14159265358979323846;

void readKinematics(Section& file, model::ArmParameters* arm) {
  std::vector<Section> rows = file.sections("dh");
  if (rows.size() != model::kArmJoints) {
    throw file.error("dh",
                     fmt::format("has {} rows, must have {}", rows.size(), model::kArmJoints));
  }
  for (int i = 0; i < model::kArmJoints; ++i) {
    arm->dh[i] = {rows[i].number("a", {-10, 10}), rows[i].number("alpha", {-kPi, kPi}),
                  rows[i].number("d", {-10, 10})};
    rows[i].finish();
  }
  arm->tool_plate_distance = file.number("tool_plate_distance", {0, 10});
}

void readLinks(Section& file, model::ArmParameters* arm) {
  const std::vector<Section> links = file.sections("links");
  if (links.size() != model::kArmJoints) {
    throw file.error("links",
                     fmt::format("has {} links, must have {}", links.size(), model::kArmJoints));
  }
  for (int i = 0; i < model::kArmJoints; ++i) {
    arm->links[i] = readBody(links[i]);
  }
}

void readStops(Section& file, model::ArmParameters* arm) {
  arm->q_min = file.vector("q_min", model::kArmJoints, {-10, 10});
  arm->q_max = file.vector("q_max", model::kArmJoints, {-10, 10});
  arm->position_margin = file.number("position_margin", {0, 1});
  for (int i = 0; i < model::kArmJoints; ++i) {
    if (arm->q_max[i] - arm->q_min[i] <= 2 * arm->position_margin) {
      throw file.error(
          "q_max", fmt::format("joint {} has no room: its stops are {} and {}, with a margin of {}",
                               i + 1, arm->q_min[i], arm->q_max[i], arm->position_margin));
    }
  }
}

Eigen::Matrix3d readInertia(Section& section, const std::string& key) {
  Section part = section.section(key);
  Eigen::Matrix3d inertia;
  const auto product = [&](const char* name) { return part.has(name) ? part.number(name) : 0.0; };
  const double xy = product("xy");
  const double xz = product("xz");
  const double yz = product("yz");
  inertia << part.number("xx", kPositive), xy, xz, xy, part.number("yy", kPositive), yz, xz, yz,
      part.number("zz", kPositive);
  part.finish();
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (principal[0] <= 0 || principal[0] + principal[1] < principal[2]) {
    throw section.error(key,
                        fmt::format("has the principal moments {}, {}, {}, which no rigid body has",
                                    principal[0], principal[1], principal[2]));
  }
  return inertia;
}

}  // namespace

model::RigidBody readBody(Section section) {
  model::RigidBody body;
  section.ignore("name");
  section.ignore("source");
  body.mass = section.number("mass", kPositive);
  body.p_BCom = section.vector("com", 3, {-10, 10});
  body.I_BCom = readInertia(section, "inertia");
  section.finish();
  return body;
}

model::ArmParameters readArm(Section profile) {
  model::ArmParameters arm;
  arm.profile = profile.text("profile");
  arm.qd_max = profile.vector("velocity_max", model::kArmJoints, kPositive);
  Section file = profile.file("mechanics");
  profile.finish();

  readKinematics(file, &arm);
  readLinks(file, &arm);
  readStops(file, &arm);
  arm.drive_inertia = file.vector("drive_inertia", model::kArmJoints, kNonNegative);
  arm.tau_max = file.vector("torque_max", model::kArmJoints, kPositive);
  arm.differential = file.boolean("differential");
  arm.viscous_friction = file.vector("viscous_friction", model::kArmJoints, kNonNegative);
  arm.coulomb_friction = file.vector("coulomb_friction", model::kArmJoints, kNonNegative);
  arm.gravity = file.number("gravity", {0, 30});
  file.finish();
  return arm;
}

}  // namespace fastball::config
