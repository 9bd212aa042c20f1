// Where the robot touches the ground, or is about to.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include <Eigen/Core>
#include <vector>

#include "ground.h"
#include "robot.h"

namespace limphome {

struct Touch {
    int shape;               // index into Robot::shapes()
    Eigen::Vector3d point;   // halfway between the shape and the ground [m]
    Eigen::Vector3d normal;  // from the ground into the robot
    double depth;            // of penetration; below 0: gap [m]
};

// Those that Bullet has found between the robot and a plane.
std::vector<Touch> plane_touches(const btDispatcher &dispatcher);

// Those on any other ground, piece by piece of it. Balls touch in one point, edges of belts where their rounded ends
// are nearest to the ground and wherever it bulges towards the flat run between them.
std::vector<Touch> ground_touches(const Robot &robot, const Ground &ground);

}  // namespace limphome
