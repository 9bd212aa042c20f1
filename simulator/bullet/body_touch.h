// Where bodies of the robot touch each other.
#pragma once

#include <robot_solid.h>

#include <vector>

#include "bullet/robot.h"
#include "bullet/touch.h"

namespace limphome {

// Keeps for each pair of solids how far the joints may turn before they can touch, and looks again only then: what it
// finds is the same as if it looked every time.
class BodyTouches {
   public:
    explicit BodyTouches(const Robot &robot);

    // Appends the touches of bodies that reach into each other, always in the same order.
    void find(const Robot &robot, std::vector<Touch> &touches);

   private:
    struct Pair {
        std::size_t first, second;  // indices into Robot::solids()
        double due = 0;             // `turned_` from which on they may touch [m]
    };

    double way(const Robot &robot);
    void look(const Robot &robot, Pair &pair, std::vector<Touch> &touches) const;

    std::vector<Pair> pairs_;
    std::vector<double> reach_;   // per actuator: farthest that what it carries can be from its axis [m]
    std::vector<double> angles_;  // of the joints when last looked at [rad]
    double gone_ = 0;             // way that anything can have gone against anything else since the beginning [m]
    double due_ = 0;              // least of the pairs' [m]
};

}  // namespace limphome
