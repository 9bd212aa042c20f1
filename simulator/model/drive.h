// The drive of one actuator: a PID velocity controller in front of a motor of limited torque, and the joint's stops.
//
// The controller asks for an acceleration; the solver finds the torque that gives it, as far as the motor is able to.
#pragma once

#include <vector>

#include "model/robot_model.h"
#include "plant/machine.h"

namespace limphome {

// What holds for the rate of one joint over one time step. With w the rate that all else would give, the drive takes it
// towards `target` by an impulse of at most `limit`, and the stops keep it between `lowest` and `highest`.
struct JointConstraint {
    double target;   // [rad/s]
    double limit;    // [N m s]; infinite for a brake, 0 where nothing drives
    double lowest;   // [rad/s]
    double highest;  // [rad/s]
    bool held;       // guess for the solver: the joint reaches its target
    double impulse;  // of drive and stops together, found by the solver [N m s]
};

struct PidGains {
    double proportional;  // [1/s]
    double integral;      // [1/s^2]
    double derivative;    // [-]
};

// A slipping drive works; it is its belt that has lost its grip.
enum class DriveCondition { sound, weak, locked, free, slipping };

class Drive {
   public:
    Drive(const Actuator &actuator, const PidGains &gains, double time_step);

    // From now on; a weak drive has this share of its torque limit left.
    void fail(DriveCondition condition, double left);
    // Wanted rate [rad/s]; a failed drive does not obey.
    void command(double rate);
    // What the solver has to see to, from angle and rate at the start of a time step.
    JointConstraint begin_step(double angle, double rate);
    // Takes over the solver's result, with the rate at the end of the time step.
    void end_step(const JointConstraint &constraint, double rate);
    // Forgets the control error so far.
    void clear_integral() { integral_ = 0; }

    double effort() const;  // torque, mean over the last 20 ms [N m]
    bool saturated() const { return saturated_; }
    DriveCondition condition() const { return condition_; }
    Health health() const;

   private:
    void give_out(double torque_limit);  // obeys no more: infinite for a brake, 0 for none

    PidGains gains_;
    double time_step_;
    DriveCondition condition_ = DriveCondition::sound;
    bool obeys_ = true;
    double torque_limit_;
    double speed_limit_;
    double lower_, upper_;
    double command_ = 0;
    double integral_ = 0;          // of the control error [rad]
    bool held_ = true;             // at the end of the last step
    bool saturated_ = false;       // in the last step
    std::vector<double> torques_;  // of the last 20 ms, as a ring
    std::size_t newest_ = 0;
};

}  // namespace limphome
