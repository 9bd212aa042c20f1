// Where the robot touches the ground, or is about to.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include <Eigen/Core>
#include <vector>

#include "bullet/robot.h"
#include "model/ground.h"

namespace limphome {

struct Touch {
    int shape;               // index into Robot::shapes()
    Eigen::Vector3d point;   // halfway between the shape and the ground [m]
    Eigen::Vector3d normal;  // from the ground into the robot
    double depth;            // of penetration; below 0: gap [m]
};

// Both fill `touches` ordered by shape, so that nothing depends on the order in which they were found; memory that it
// has is used again.

// Those that Bullet has found between the robot and a plane.
void plane_touches(const btDispatcher &dispatcher, std::vector<Touch> &touches);

// Those on any other ground, piece by piece of it. Balls touch in one point, edges of belts where their rounded ends
// are nearest to the ground and wherever it bulges towards the flat run between them.
void ground_touches(const Robot &robot, const Ground &ground, std::vector<Touch> &touches);

}  // namespace limphome
