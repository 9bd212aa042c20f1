// The simulated world: a robot on level ground, obeying commands.
#pragma once

#include <settings.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "contact.h"
#include "drive.h"
#include "robot.h"

namespace limphome {

class Scene;

class World {
   public:
    // The robot stands at the origin, facing +y, at rest, its arm at its home angles.
    World(const RobotModel &model, const settings &configuration);
    ~World();

    // Back to the state after construction, bit by bit; gravity too.
    void reset();

    // Wanted rates, Table 1: belt speed of the crawlers [m/s], then rates of the arm joints [rad/s].
    void command(const double velocity[max_actuators]);
    // One decision period.
    void advance();
    // One time step.
    void step();

    int num_actuators() const { return static_cast<int>(model_.actuators.size()); }
    double time() const;                              // since construction or reset [s]
    bool finite() const;                              // false once any state is infinite or not a number
    int64_t saturated() const { return saturated_; }  // drives at their torque limit so far, per time step and actuator

    // Gravity that is not vertical stands for a slope [m/s^2].
    void set_gravity(const Eigen::Vector3d &gravity);

    double time_step() const { return settings_.simulator.time_step_s; }
    Robot &robot();
    const Robot &robot() const;
    const std::vector<Drive> &drives() const;
    // Of the last time step; their impulses divided by its length are forces.
    const std::vector<Contact> &contacts() const;

   private:
    RobotModel model_;
    settings settings_;
    int steps_per_period_;
    std::unique_ptr<Scene> scene_;
    int64_t steps_ = 0;      // since construction or reset
    int64_t saturated_ = 0;  // over all sessions
};

}  // namespace limphome
