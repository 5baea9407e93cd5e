#include "bench/mujoco_peer.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/timing.h"
#include "sim_bullet/link_tree.h"

namespace fastball::bench {
namespace {

using sim_bullet::kJoints;
using sim_bullet::LinkSpec;

constexpr double kStep = 1e-4;       // [s]
constexpr int kSettleSteps = 2000;   // in which the ball finds its balance in MuJoCo's contacts
constexpr double kLeastMass = 1e-4;  // [kg], MuJoCo moves nothing lighter
constexpr double kDropped = 0.05;    // [m], further than the fingers let a held ball go
constexpr const char* kFileName = "scene.xml";

struct Deleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

std::string words(const Eigen::Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string inertial(const model::RigidBody& body) {
  const double mass = std::max(body.mass, kLeastMass);
  Eigen::Matrix3d I = body.I_BCom;
  if (body.mass < kLeastMass)
    I = mass * 1e-4 * Eigen::Matrix3d::Identity();
  return fmt::format(
      "<inertial pos='{}' mass='{:.17g}' fullinertia='{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
      "{:.17g}'/>",
      words(body.p_BCom), mass, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
}

class SceneWriter {
 public:
  explicit SceneWriter(const config::Experiment& experiment)
      : experiment_(experiment), tree_(sim_bullet::linkTree(experiment.arm, experiment.hand)) {}

  std::string xml() const {
    return fmt::format(
               "<mujoco><compiler angle='radian' balanceinertia='true'/>"
               "<option timestep='{}' gravity='0 0 {}' solver='Newton' cone='elliptic'/>"
               "<worldbody>",
               kStep, -experiment_.arm.gravity) +
           links(-1) + ball() + "</worldbody></mujoco>";
  }

 private:
  std::string links(int parent) const {
    std::string text;
    for (int i = 0; i < kJoints; ++i) {
      if (tree_[i].parent == parent)
        text += link(i);
    }
    return text;
  }

  std::string link(int i) const {
    const LinkSpec& link = tree_[i];
    const Eigen::Quaterniond q(link.X_PF.linear());
    const double armature =
        i < model::kArmJoints ? experiment_.arm.drive_inertia[i] : link.drive_inertia;
    return fmt::format(
               "<body pos='{}' quat='{:.17g} {:.17g} {:.17g} {:.17g}'>"
               "<joint pos='{}' axis='{}' armature='{:.17g}'/>",
               words(link.X_PF.translation()), q.w(), q.x(), q.y(), q.z(), words(link.p_FAxis),
               words(link.axis_F), armature) +
           inertial(link.body) + phalanx(i) + links(i) + "</body>";
  }

  std::string phalanx(int i) const {
    const model::HandParameters& hand = experiment_.hand;
    for (const model::Finger finger : {model::kFingerA, model::kThumb, model::kFingerB}) {
      const int proximal = model::kArmJoints + model::Hand::proximalJoint(finger);
      if (i != proximal && i != proximal + 1)
        continue;
      return fmt::format(
          "<geom type='capsule' fromto='0 0 0 0 0 {:.17g}' size='{:.17g}' mass='0' contype='1' "
          "conaffinity='2' {}/>",
          i == proximal ? hand.proximal_length : hand.distal_length, hand.finger_radius, contact());
    }
    return {};
  }

  std::string ball() const {
    return fmt::format(
        "<body><freejoint/><geom type='sphere' size='{:.17g}' mass='{:.17g}' contype='2' "
        "conaffinity='1' {}/></body>",
        experiment_.ball.radius, experiment_.ball.mass, contact());
  }

  /// Soft as a contact of its kind can be with 20 steps to its time constant.
  std::string contact() const {
    return fmt::format("friction='{:.17g}' condim='3' solref='0.002 1'", experiment_.ball.friction);
  }

  const config::Experiment& experiment_;
  sim_bullet::LinkTree tree_;
};

class MujocoScene {
 public:
  explicit MujocoScene(const HeldBall& held)
      : held_(held),
        arm_(held.experiment().arm, held.experiment().hand.payload),
        servo_(held.experiment().hand, {}, kStep) {
    const std::string xml = SceneWriter(held.experiment()).xml();
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), kFileName, static_cast<int>(xml.size()));
    const int file = mj_findFileVFS(files.get(), kFileName);
    std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[file]));
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(kFileName, files.get(), error.data(), error.size()));
    mj_deleteVFS(files.get());
    if (!model_)
      throw std::runtime_error(fmt::format("MuJoCo does not take the scene: {}", error.data()));
    data_.reset(mj_makeData(model_.get()));
    const sim_bullet::RobotState& state = held.scene().state();
    Eigen::Map<Eigen::VectorXd> qpos(data_->qpos, model_->nq);
    const sim_bullet::BallMotion ball = held.scene().ball();
    const Eigen::Quaterniond R(ball.R_WBall);
    qpos << state.q.arm, state.q.hand, ball.p_WBall, R.w(), R.x(), R.y(), R.z();
  }

  void step() {
    const Eigen::Map<const Eigen::VectorXd> q(data_->qpos, model_->nq), qd(data_->qvel, model_->nv);
    const Eigen::Vector4d q_arm = q.head<4>(), qd_arm = qd.head<4>();
    const model::HandVector q_hand = q.segment<model::kHandJoints>(4),
                            qd_hand = qd.segment<model::kHandJoints>(4);
    Eigen::Map<Eigen::VectorXd> tau(data_->qfrc_applied, model_->nv);
    tau.head<4>() = arm_.clipTorque(arm_.gravityTorque(q_arm) -
                                    held_.settings().brake_damping.cwiseProduct(qd_arm)) -
                    arm_.frictionTorque(qd_arm);
    tau.segment<model::kHandJoints>(4) = servo_.step(held_.command(), q_hand, qd_hand);
    mj_step(model_.get(), data_.get());
  }

  int contacts() const { return data_->ncon; }
  Eigen::Vector3d p_WBall() const { return Eigen::Vector3d::Map(data_->qpos + kJoints); }

 private:
  const HeldBall& held_;
  model::Arm arm_;
  sim_bullet::HandServo servo_;
  std::unique_ptr<mjModel, Deleter> model_;
  std::unique_ptr<mjData, Deleter> data_;
};

}  // namespace

double mujocoSecondsPerStep(const HeldBall& held) {
  MujocoScene scene(held);
  for (int i = 0; i < kSettleSteps; ++i)
    scene.step();
  const double seconds = cpuSecondsPerCall("sim.mujoco_ratio", [&] { scene.step(); });
  const double way = (scene.p_WBall() - held.scene().ball().p_WBall).norm();
  if (scene.contacts() < model::kFingers || !(way < kDropped)) {
    throw std::runtime_error(fmt::format(
        "MuJoCo does not hold the ball: {} contacts, moved by {:.3f} m", scene.contacts(), way));
  }
  return seconds;
}

}  // namespace fastball::bench
