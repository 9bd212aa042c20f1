// A time step of a robot on its ground.
#pragma once

#include <vector>

#include "bullet/body_touch.h"
#include "bullet/contact.h"
#include "bullet/robot.h"
#include "bullet/solver.h"
#include "model/drive.h"
#include "model/ground.h"

namespace limphome {

class Dynamics {
   public:
    // Both must outlive it.
    Dynamics(Robot &robot, const Ground &ground, const Solver &solver);

    // Finds velocities at the end of the step, then moves the robot at them.
    void step(double time_step);

    Eigen::Vector3d gravity{0, 0, -standard_gravity};  // [m/s^2]
    std::vector<JointConstraint> joints;               // one per actuator
    std::vector<Contact> contacts;                     // of the last step

   private:
    void find_contacts();

    Robot &robot_;
    const Ground &ground_;
    Solver solver_;
    BodyTouches body_touches_;
    std::vector<Touch> touches_;     // of the last step
    std::vector<Contact> previous_;  // contacts of the step before
};

}  // namespace limphome
