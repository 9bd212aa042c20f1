// The simulated world: a robot on the ground, obeying commands.
#pragma once

#include <settings.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "contact.h"
#include "drive.h"
#include "failure.h"
#include "ground.h"
#include "robot.h"
#include "sensor_errors.h"

namespace limphome {

class Scene;

class World {
   public:
    // The robot stands at the origin, facing +y, at rest, its arm at its home angles. Throws std::runtime_error if what
    // is to fail is not part of the robot, or the robot cannot be simulated.
    World(const RobotModel &model, const settings &configuration);
    ~World();

    // Back to the state after construction, bit by bit; gravity too. What is drawn at each reset depends on `episode`,
    // the one that begins.
    void reset(int64_t episode = 0);

    // Wanted rates, Table 1: belt speed of the crawlers [m/s], then rates of the arm joints [rad/s].
    void command(const double velocity[max_actuators]);
    // One decision period.
    void advance();
    // One time step.
    void step();

    int num_actuators() const { return static_cast<int>(model_.actuators.size()); }
    double time() const;                              // since construction or reset [s]
    bool diverged() const { return diverged_; }       // no step is done any more, until the next reset
    int64_t saturated() const { return saturated_; }  // drives at their torque limit so far, per time step and actuator

    // Reads the sensors, with their errors; utime, session, seq and lockstep are left as they are.
    void sense(robot_state_t &state);

    // Gravity that is not vertical stands for a slope [m/s^2].
    void set_gravity(const Eigen::Vector3d &gravity);

    double time_step() const { return settings_.simulator.time_step_s; }
    Robot &robot();
    const Robot &robot() const;
    const std::vector<Drive> &drives() const;
    const Ground &ground() const { return ground_; }
    // Of the last time step; their impulses divided by its length are forces.
    const std::vector<Contact> &contacts() const;

   private:
    void fail_when_due();
    std::unique_ptr<Scene> make_scene(int64_t episode) const;
    bool plausible() const;

    RobotModel model_;
    settings settings_;
    Ground ground_;
    std::vector<Failure> failures_;
    int steps_per_period_;
    std::unique_ptr<Scene> scene_;
    SensorErrors sensor_errors_;
    int64_t steps_ = 0;      // since construction or reset
    int64_t saturated_ = 0;  // over all sessions
    bool diverged_ = false;
};

}  // namespace limphome
