// The robot of a robot_description in Eigen's types, as the rooms of the simulator use it.
#pragma once

#include <robot_description.h>
#include <robot_solid.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "plant/capacity.h"

namespace limphome {

constexpr int num_crawlers = ROBOT_CRAWLERS;  // left, right

// Part of a body that may touch the ground.
struct Shape {
    robot_shape_kind kind;
    Eigen::Isometry3d pose;     // its middle, in the frame of the body
    Eigen::Vector3d half_size;  // as of robot_shape [m]
};

// Part of a body that may touch other bodies where `may_meet` says so: a shape, or the belt of a crawler.
struct Solid {
    int body;
    int crawler;        // whose belt it is; -1: of none
    robot_solid shape;  // in the frame of the body
};

struct Body {
    std::string name;
    int parent = -1;                                          // body it hangs on; -1 for the base
    Eigen::Isometry3d joint = Eigen::Isometry3d::Identity();  // this frame in the parent's at joint angle 0
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();          // of the joint, in this frame
    double mass = 0;                                          // [kg]
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();         // of mass, in this frame [m]
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();        // about the centre of mass, axes of this frame [kg m^2]
    std::vector<Shape> shapes;                                // its tips' balls first
};

struct Actuator {
    std::string name;
    double lower = 0;  // least and largest joint angle [rad]; crawler: infinite
    double upper = 0;
    double effort = 0;  // largest torque of the drive [N m]
    double speed = 0;   // largest rate of the joint [rad/s]
    double home = 0;    // angle in the initial pose [rad]
};

// Belt of `radius` round both ends, rigid with the base; its sprocket is the joint of the actuator of the same index.
struct Crawler {
    Eigen::Vector3d centre;  // in the frame of the base [m]
    Eigen::Vector3d axis;    // of the sprocket, in the frame of the base; positive turning drives forward
    double length;           // over all [m]
    double width;            // [m]
    double radius;           // [m]
};

struct RobotModel {
    std::string name;
    std::vector<Body> bodies;                                // base, then one per actuator; each after its parent
    std::vector<Actuator> actuators;                         // left crawler, right crawler, arm joints from root to tip
    std::vector<Crawler> crawlers;                           // left, right
    std::vector<Solid> solids;                               // shapes in the file's order, then the belts
    bool may_meet[ROBOT_MAX_BODIES][ROBOT_MAX_BODIES] = {};  // as of robot_description

    double mass() const;  // [kg]
};

RobotModel make_model(const robot_description &robot);

}  // namespace limphome
