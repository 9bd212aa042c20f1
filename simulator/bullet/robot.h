// The robot in Bullet: one multibody, and the shapes with which it can touch the ground and itself.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Geometry>
#include <vector>

#include "bullet/mass_matrix.h"
#include "bullet/placed_body.h"
#include "model/robot_model.h"

namespace limphome {

// Part of a body that may touch the ground. A radius of 0 is a point.
struct Ball {
    Eigen::Vector3d centre;  // [m]
    double radius;           // [m]
};

// All balls of a body.
struct BodyBalls {
    int body;
    int first_shape;  // number of the first of them among the shapes
    std::vector<Ball> balls;
    double farthest;  // that any point of them is from the origin of the body's frame [m]
};

// Something of the robot that touches the ground, in one point, or another of its bodies.
struct ContactShape {
    int part;         // as ground_truth_t.contact_part: actuator whose link (or belt) it belongs to; -1: base
    bool on_crawler;  // the surface moves with the belt of crawler `part`
    double friction;  // Coulomb coefficient on the ground, or on another body
};

// Edge of a belt at one rounded end; rims are the first of the shapes.
struct Rim {
    Eigen::Vector3d centre;  // in the frame of the base [m]
    Eigen::Vector3d axis;    // to the left, in the frame of the base
    double radius;           // [m]
    int next_on_edge;        // at the rear: rim at the front end of the same edge; at the front: -1
};

// Coulomb coefficients.
struct Frictions {
    double crawler, arm;  // on the ground
    double body;          // of a body on another
};

class Robot {
   public:
    Robot(const RobotModel &model, const Frictions &frictions);

    // Holds pose, joint angles and velocities, and integrates them.
    const btMultiBody &multibody() const { return multibody_; }
    btMultiBody &multibody() {
        placed_ = false;  // who asks may move it
        return multibody_;
    }
    const RobotModel &model() const { return model_; }

    // The model's bodies in their order, where they are. All that is told of places below follows from them.
    const std::vector<PlacedBody> &bodies() const;
    // Until the robot moves they are where they will be so much later at the present velocities [s].
    void look_ahead(double seconds) const;

    const std::vector<ContactShape> &shapes() const { return shapes_; }
    // Number of the first shape that touches other bodies, those of model().solids in their order; all before it touch
    // the ground.
    int first_solid() const { return static_cast<int>(shapes_.size() - model_.solids.size()); }
    const std::vector<Rim> &rims() const { return rims_; }
    // Of the bodies that have any, as they lie in the frames of their bodies; they are the shapes after the rims.
    const std::vector<BodyBalls> &balls() const { return balls_; }
    // Leaves this share of the friction to the belt of a crawler.
    void scale_friction(int crawler, double share);

    // Frame of the base link in the world.
    Eigen::Isometry3d pose() const { return body_frame(0); }
    // Frame of a body in the world.
    Eigen::Isometry3d body_frame(int body) const;
    void set_pose(const Eigen::Isometry3d &pose);

    GeneralVector velocity() const;
    // Moves for so long at these velocities, which it then has [s].
    void move(const GeneralVector &velocity, double seconds);

    Eigen::Vector3d centre_of_mass() const;
    Eigen::Vector3d centre_of_mass_velocity() const;
    double kinetic_energy() const;  // [J]

    // Belt travel [m] and speed [m/s] of a crawler, angle [rad] and rate [rad/s] of a joint.
    double actuator_position(int actuator) const;
    double actuator_velocity(int actuator) const;
    // Belt travel per radian of the sprocket [m]; 1 for a joint.
    double travel_per_radian(int actuator) const;

   private:
    void build_links();
    void add_crawler_edges(int crawler, double friction);
    void add_balls(int body, double friction);

    RobotModel model_;
    std::vector<Eigen::Isometry3d> principal_;  // per body: frame of its principal axes at its centre of mass
    Eigen::Isometry3d from_principal_;          // frame of the base in that of its principal axes
    btMultiBody multibody_;
    std::vector<ContactShape> shapes_;
    std::vector<Rim> rims_;
    mutable std::vector<PlacedBody> bodies_;  // found when asked for; not by two threads at once
    mutable bool placed_ = false;             // bodies_ are where they belong
    std::vector<BodyBalls> balls_;
};

}  // namespace limphome
