#include "bullet/dynamics.h"

#include "bullet/bias_force.h"
#include "bullet/level_touch.h"

namespace limphome {

Dynamics::Dynamics(Robot &robot, const Ground &ground, const Solver &solver)
    : joints(robot.model().actuators.size()), robot_(robot), ground_(ground), solver_(solver), body_touches_(robot) {
    const std::size_t room = 4 * robot_.shapes().size();  // a shape may touch uneven ground in several points
    touches_.reserve(room);
    contacts.reserve(room);
    previous_.reserve(room);
}

void Dynamics::find_contacts() {
    if (ground_.level()) {
        level_touches(robot_, touches_);
    } else {
        ground_touches(robot_, ground_, touches_);
    }
    body_touches_.find(robot_, touches_);
    contacts.swap(previous_);
    make_contacts(robot_, ground_, touches_, previous_, contacts);
}

// Forces are those of the middle of the step, where the robot is half a step ahead.
void Dynamics::step(double time_step) {
    const double half = 0.5 * time_step;
    const GeneralVector velocity = robot_.velocity();
    robot_.look_ahead(half);
    find_contacts();
    for (Contact &contact : contacts) {
        contact.depth += half * contact.jacobian.col(0).dot(velocity);  // back to the beginning of the step
    }
    const GeneralMatrix mass = mass_matrix(robot_.bodies());
    const GeneralVector momentum =
        mass.lazyProduct(velocity) - time_step * bias_force(robot_.bodies(), velocity, gravity);
    robot_.move(solver_.solve(mass, momentum, joints, contacts, time_step), time_step);
}

}  // namespace limphome
