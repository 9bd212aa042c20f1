// The simulated world as a machine: a robot on the ground in Bullet, obeying commands.
#pragma once

#include <settings.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "bullet/contact.h"
#include "bullet/robot.h"
#include "model/drive.h"
#include "model/failure.h"
#include "model/ground.h"
#include "model/sensor_errors.h"
#include "plant/machine.h"

namespace limphome {

class Scene;

class World final : public Machine {
   public:
    // The robot stands at the origin, facing +y, at rest, its arm at its home angles, as far as [randomisation] draws
    // nothing else. Throws std::runtime_error if what is to fail is not part of the robot, or the robot cannot be
    // simulated.
    World(const RobotModel &model, const settings &configuration);
    ~World() override;

    int num_actuators() const override { return static_cast<int>(model_.actuators.size()); }
    // Back to the state after construction, bit by bit; gravity too. What is drawn at random is that of `episode`.
    void reset(int64_t episode) override;
    // Rates of Table 1.
    void command(const double velocity[max_actuators]) override;
    // With errors.
    void sense(robot_state_t &state) override;
    bool exact(robot_state_t &state) const override;
    Health health(int actuator) const override;
    // Whole time steps; what is over is left for the next time.
    void advance(double seconds) override;
    void advance_asking(double seconds, const std::function<bool(double)> &may_step) override;
    bool can_pause() const override { return true; }
    bool can_be_carried_back() const override { return settings_.simulator.reset == SETTINGS_INITIAL_POSE; }
    // No step is done any more, until the next reset.
    bool diverged() const override { return diverged_; }
    bool truth(ground_truth_t &truth) const override;
    double simulated_time() const override;
    int64_t saturated() const override { return saturated_; }

    // One time step.
    void step();
    double time_step() const { return settings_.simulator.time_step_s; }
    double time() const;  // since construction or reset [s]

    // Gravity that is not vertical stands for a slope [m/s^2].
    void set_gravity(const Eigen::Vector3d &gravity);

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
    std::unique_ptr<Scene> scene_;
    SensorErrors sensor_errors_;
    int64_t episode_ = 0;        // of the last reset
    int64_t steps_ = 0;          // since construction or reset
    int64_t earlier_steps_ = 0;  // in the sessions before
    double steps_due_ = 0;       // asked for and not done, -0.5 to 0.5
    int64_t saturated_ = 0;      // over all sessions
    bool diverged_ = false;
};

}  // namespace limphome
