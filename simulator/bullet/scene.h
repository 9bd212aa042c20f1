// All that has a state in the simulation: robot, drives, contacts and what Bullet keeps. A new one resets the world.
#pragma once

#include <settings.h>

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <vector>

#include "bullet/body_touch.h"
#include "bullet/contact.h"
#include "bullet/robot.h"
#include "bullet/solver.h"
#include "model/drive.h"
#include "model/failure.h"
#include "model/ground.h"
#include "model/randomisation.h"

namespace limphome {

// Bullet's pipeline for a single robot that never sleeps: Bullet finds the contacts, computes the articulated dynamics
// and integrates; drives, stops and contacts are left to Solver.
class Pipeline final : public btMultiBodyDynamicsWorld {
   public:
    Pipeline(btDispatcher *dispatcher, btBroadphaseInterface *broadphase, btMultiBodyConstraintSolver *unused,
             btCollisionConfiguration *configuration, Robot &robot, const Ground &ground, const Solver &solver);

    std::vector<JointConstraint> joints;  // one per actuator
    std::vector<Contact> contacts;        // of the last step

   private:
    void solveConstraints(btContactSolverInfo &info) override;
    // Not needed for one robot.
    void predictUnconstraintMotion(btScalar) override {}
    void createPredictiveContacts(btScalar) override {}
    void calculateSimulationIslands() override {}
    void updateActivationState(btScalar) override {}

    Robot &robot_;
    const Ground &ground_;
    Solver solver_;
    BodyTouches body_touches_;
    std::vector<Touch> touches_;     // of the last step
    std::vector<Contact> previous_;  // contacts of the step before
};

class Scene {
   public:
    // The robot stands on `ground` at `start`, at rest, its arm at its home angles; what fails at time 0 has failed.
    // `ground` must outlive the scene.
    Scene(const RobotModel &model, const settings &configuration, const Ground &ground,
          const std::vector<Failure> &failures, const Start &start);

    void fail(const Failure &failure);
    void set_gravity(const Eigen::Vector3d &gravity);
    void step();

    const std::vector<Contact> &contacts() const { return pipeline_.contacts; }

    Robot robot;
    std::vector<Drive> drives;

   private:
    Eigen::Vector3d at_start(double height) const;
    void place();
    void settle();
    void sink_in(double duration);
    Eigen::Vector3d centre_of_pressure() const;
    void hold_in_place();

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btMultiBodyConstraintSolver unused_solver_;  // Bullet insists on one
    btStaticPlaneShape ground_shape_;
    btCollisionObject plane_;
    const Ground &ground_;
    const Start start_;
    Pipeline pipeline_;
    double time_step_;
};

}  // namespace limphome
