#include "model/drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace limphome {
namespace {

constexpr double effort_window = 0.02;  // [s]

}  // namespace

Drive::Drive(const Actuator &actuator, const PidGains &gains, double time_step)
    : gains_(gains),
      time_step_(time_step),
      torque_limit_(actuator.effort),
      speed_limit_(actuator.speed),
      lower_(actuator.lower),
      upper_(actuator.upper),
      torques_(static_cast<std::size_t>(std::max(1.0, std::round(effort_window / time_step))), 0.0) {}

void Drive::fail(DriveCondition condition, double left) {
    condition_ = condition;
    switch (condition) {
        case DriveCondition::sound:
        case DriveCondition::slipping:
            break;
        case DriveCondition::weak:
            torque_limit_ *= left;
            break;
        case DriveCondition::locked:
            give_out(std::numeric_limits<double>::infinity());
            break;
        case DriveCondition::free:
            give_out(0);
            break;
    }
}

void Drive::give_out(double torque_limit) {
    obeys_ = false;
    torque_limit_ = torque_limit;
    command_ = integral_ = 0;
    held_ = true;
}

void Drive::command(double rate) {
    if (obeys_) {
        command_ = std::clamp(rate, -speed_limit_, speed_limit_);
    }
}

// a = Kp e + Ki int(e) + Kd de/dt, taken at the end of the step so that every gain is stable with every time step:
// e = command - rate - a dt there. The derivative is that of the rate alone, so that a step of the command gives no
// kick.
JointConstraint Drive::begin_step(double angle, double rate) {
    const double dt = time_step_;
    JointConstraint constraint{0, torque_limit_ * dt, (lower_ - angle) / dt, (upper_ - angle) / dt, held_, 0};
    if (condition_ == DriveCondition::locked) {
        return constraint;
    }
    const double error = command_ - rate;
    const double acceleration = (gains_.proportional * error + gains_.integral * (integral_ + error * dt)) /
                                (1 + gains_.derivative + gains_.proportional * dt + gains_.integral * dt * dt);
    constraint.target = std::clamp(rate + acceleration * dt, constraint.lowest, constraint.highest);
    return constraint;
}

void Drive::end_step(const JointConstraint &constraint, double rate) {
    // A joint that rests on its stop needs no torque.
    const bool at_lower = constraint.target <= constraint.lowest, at_upper = constraint.target >= constraint.highest;
    const double applied =
        std::clamp(constraint.impulse, at_upper ? 0 : -constraint.limit, at_lower ? 0 : constraint.limit);
    newest_ = (newest_ + 1) % torques_.size();
    torques_[newest_] = applied / time_step_;
    held_ = constraint.held;

    const bool at_stop = at_lower || at_upper;
    saturated_ = !at_stop && constraint.limit > 0 && std::abs(constraint.impulse) >= constraint.limit;
    if (at_stop) {
        integral_ = 0;
    } else if (!saturated_) {  // against windup
        integral_ += (command_ - rate) * time_step_;
    }
}

Health Drive::health() const {
    switch (condition_) {
        case DriveCondition::sound:
            return Health::obeys;
        case DriveCondition::weak:
            return Health::weak;
        case DriveCondition::locked:
        case DriveCondition::free:
        case DriveCondition::slipping:
            return Health::failed;
    }
    throw std::logic_error("condition of a drive that is not known");
}

double Drive::effort() const {
    return std::accumulate(torques_.begin(), torques_.end(), 0.0) / static_cast<double>(torques_.size());
}

}  // namespace limphome
