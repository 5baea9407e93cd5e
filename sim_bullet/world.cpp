#include "sim_bullet/world.h"

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <vector>

#include "sim_bullet/bullet_eigen.h"

namespace fastball::sim_bullet {
namespace {

using Eigen::Vector3d;

/// Straight pieces of the ring; with 48 the chord is 0.3 mm off the circle at 0.1 m.
constexpr int kRingPieces = 48;
constexpr double kPi = 3.14159265358979323846;

/// Bullet's world with the arm's drive inertia put in between the accelerations and the positions of a step.
class DriveInertiaWorld : public btMultiBodyDynamicsWorld {
 public:
  DriveInertiaWorld(ArmHand& arm_hand,
                    btDispatcher* dispatcher,
                    btBroadphaseInterface* broadphase,
                    btMultiBodyConstraintSolver* solver,
                    btCollisionConfiguration* configuration)
      : btMultiBodyDynamicsWorld(dispatcher, broadphase, solver, configuration),
        arm_hand_(arm_hand) {}

  void solveExternalForces(btContactSolverInfo& info) override {
    const Eigen::Vector4d qd_before = arm_hand_.qd().arm;
    btMultiBodyDynamicsWorld::solveExternalForces(info);
    arm_hand_.addDriveInertia(qd_before, info.m_timeStep);
  }
  /// The links have no colliders whose places Bullet would have to foresee or keep.
  void predictUnconstraintMotion(btScalar dt) override {
    btDiscreteDynamicsWorld::predictUnconstraintMotion(dt);
  }
  void integrateTransforms(btScalar dt) override {
    btDiscreteDynamicsWorld::integrateTransforms(dt);
    arm_hand_.body().stepPositionsMultiDof(dt);
  }

 private:
  ArmHand& arm_hand_;
};

/// A torus about `target`, its tube outside the inner radius.
void addRing(const model::Target& target,
             double tube_radius,
             btCompoundShape* ring,
             std::vector<std::unique_ptr<btCollisionShape>>* pieces) {
  const double radius = target.radius + tube_radius;
  const double length = 2 * radius * std::sin(kPi / kRingPieces);
  pieces->push_back(std::make_unique<btCapsuleShape>(tube_radius, length));
  for (int i = 0; i < kRingPieces; ++i) {
    const double angle = 2 * kPi * (i + 0.5) / kRingPieces;
    const Vector3d outwards =
        std::cos(angle) * target.rightAxis() + std::sin(angle) * target.upAxis();
    const Vector3d along =
        -std::sin(angle) * target.rightAxis() + std::cos(angle) * target.upAxis();
    Eigen::Matrix3d R;  // a capsule's axis is its y
    R << outwards, along, outwards.cross(along);
    const Vector3d p = target.p_WTarget + radius * std::cos(kPi / kRingPieces) * outwards;
    ring->addChildShape(btTransform(toBullet(R), toBullet(p)), pieces->back().get());
  }
}

}  // namespace

struct World::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  DriveInertiaWorld world;
  btSphereShape ball_shape;
  btCompoundShape ring_shape;
  std::vector<std::unique_ptr<btCollisionShape>> ring_pieces;
  btStaticPlaneShape floor_shape;
  btRigidBody ball, ring, floor;
  btMultiBody* arm_hand;

  Bullet(ArmHand& links, const model::BallParameters& parameters, double floor_height)
      : world(links, &dispatcher, &broadphase, &solver, &configuration),
        ball_shape(parameters.radius),
        floor_shape(btVector3(0, 0, 1), floor_height),
        ball(parameters.mass, nullptr, &ball_shape, btVector3(1, 1, 1) * parameters.inertia()),
        ring(0, nullptr, &ring_shape),
        floor(0, nullptr, &floor_shape),
        arm_hand(&links.body()) {}
  ~Bullet() {
    world.removeRigidBody(&floor);
    world.removeRigidBody(&ring);
    world.removeRigidBody(&ball);
    world.removeMultiBody(arm_hand);
  }
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;
};

World::World(ArmHand& arm_hand,
             const model::BallParameters& ball,
             const model::Target& target,
             const NetSettings& net,
             const FloorSettings& floor,
             double gravity)
    : bullet_(std::make_unique<Bullet>(arm_hand, ball, floor.height)) {
  Bullet& b = *bullet_;
  b.world.setGravity(btVector3(0, 0, -gravity));
  addRing(target, net.tube_radius, &b.ring_shape, &b.ring_pieces);
  b.ring.setContactStiffnessAndDamping(net.ring_stiffness, net.ring_damping);
  b.ball.setActivationState(DISABLE_DEACTIVATION);
  b.ball.setDamping(0, 0);
  // Bullet multiplies the friction and the restitution of the two bodies.
  b.ball.setFriction(1);
  b.ball.setRestitution(1);
  b.ring.setFriction(net.friction);
  b.ring.setRestitution(0);
  b.floor.setFriction(floor.friction);
  b.floor.setRestitution(floor.restitution);
  // The order decides the order of Bullet's sums: it never changes, so that a scene repeats bit for bit.
  b.world.addMultiBody(b.arm_hand);
  b.world.addRigidBody(&b.ball);
  b.world.addRigidBody(&b.ring);
  b.world.addRigidBody(&b.floor);
}

World::~World() = default;

void World::setBall(const BallMotion& motion) {
  btRigidBody& ball = bullet_->ball;
  const btTransform X_WBall(toBullet(motion.R_WBall), toBullet(motion.p_WBall));
  ball.setWorldTransform(X_WBall);
  ball.setInterpolationWorldTransform(X_WBall);
  ball.setLinearVelocity(toBullet(motion.v_WBall));
  ball.setAngularVelocity(toBullet(motion.w_WBall));
}

BallMotion World::ball() const {
  const btRigidBody& ball = bullet_->ball;
  return {toEigen(ball.getWorldTransform().getOrigin()),
          toEigen(ball.getWorldTransform().getBasis()), toEigen(ball.getLinearVelocity()),
          toEigen(ball.getAngularVelocity())};
}

void World::addBallForce(const Vector3d& f_W, const Vector3d& m_W) {
  bullet_->ball.applyCentralForce(toBullet(f_W));
  bullet_->ball.applyTorque(toBullet(m_W));
}

void World::step(double dt) {
  bullet_->world.stepSimulation(dt, 0);
  readContacts();
}

void World::readContacts() {
  touches_ring_ = touches_floor_ = false;
  btDispatcher& dispatcher = bullet_->dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    bool touches = false;
    for (int k = 0; k < manifold.getNumContacts(); ++k)
      touches = touches || manifold.getContactPoint(k).getAppliedImpulse() > 0;
    const auto concerns = [&](const btRigidBody& body) {
      return manifold.getBody0() == &body || manifold.getBody1() == &body;
    };
    touches_ring_ = touches_ring_ || (touches && concerns(bullet_->ring));
    touches_floor_ = touches_floor_ || (touches && concerns(bullet_->floor));
  }
}

}  // namespace fastball::sim_bullet
