#include "bullet/robot.h"

#include <LinearMath/btTransformUtil.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "bullet/convert.h"

namespace limphome {
namespace {

// Bullet wants the frame of a link at its centre of mass along the principal axes of inertia.
Eigen::Isometry3d principal_frame(const Body &body) {
    Eigen::Isometry3d frame(Eigen::Translation3d(body.centre));
    if (body.inertia.isDiagonal(1e-12)) {
        return frame;  // leave the axes where they are
    }
    Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvectors();
    if (axes.determinant() < 0) {
        axes.col(2) *= -1;
    }
    frame.linear() = axes;
    return frame;
}

btVector3 principal_inertia(const Body &body, const Eigen::Isometry3d &principal) {
    return to_bullet((principal.linear().transpose() * body.inertia * principal.linear()).diagonal().eval());
}

std::vector<Eigen::Isometry3d> principal_frames(const RobotModel &model) {
    std::vector<Eigen::Isometry3d> frames;
    for (const Body &body : model.bodies) {
        frames.push_back(principal_frame(body));
    }
    return frames;
}

// A sphere touches as it is, a box at its corners, a cylinder at points of its rims.
std::vector<Ball> balls_of(const Body &body) {
    constexpr int rim_points = 16;
    std::vector<Ball> balls;
    for (const Shape &shape : body.shapes) {
        if (shape.kind == ROBOT_SPHERE) {
            balls.push_back({shape.pose.translation(), shape.half_size.x()});
            continue;
        }
        const int points = shape.kind == ROBOT_BOX ? 4 : rim_points;
        for (const double end : {-1.0, 1.0}) {
            for (int i = 0; i < points; i++) {
                const double angle = 2 * 3.14159265358979323846 * i / points;
                const Eigen::Vector3d sign = shape.kind == ROBOT_BOX
                                                 ? Eigen::Vector3d(2 * (i & 1) - 1, 2 * (i >> 1) - 1, end)
                                                 : Eigen::Vector3d(std::cos(angle), std::sin(angle), end);
                balls.push_back({shape.pose * sign.cwiseProduct(shape.half_size), 0.0});
            }
        }
    }
    return balls;
}

}  // namespace

Robot::Robot(const RobotModel &model, const Frictions &frictions)
    : model_(model),
      principal_(principal_frames(model)),
      from_principal_(principal_[0].inverse()),
      multibody_(static_cast<int>(model.actuators.size()), model.bodies[0].mass,
                 principal_inertia(model.bodies[0], principal_[0]), false, false),
      bodies_(model.bodies.size()) {
    build_links();
    for (int crawler = 0; crawler < num_crawlers; crawler++) {
        add_crawler_edges(crawler, frictions.crawler);
    }
    for (int body = 0; body < static_cast<int>(model_.bodies.size()); body++) {
        add_balls(body, frictions.arm);
    }
    for (const Solid &solid : model_.solids) {
        const bool on_crawler = solid.crawler >= 0;
        shapes_.push_back({on_crawler ? solid.crawler : solid.body - 1, on_crawler, frictions.body});
    }
}

void Robot::build_links() {
    for (std::size_t i = 1; i < model_.bodies.size(); i++) {
        const Body &body = model_.bodies[i];
        const Eigen::Isometry3d &own = principal_[i];
        const Eigen::Isometry3d &parent = principal_[static_cast<std::size_t>(body.parent)];
        const Eigen::Quaterniond from_parent((own.linear().transpose() * body.joint.linear().transpose()) *
                                             parent.linear());
        const Eigen::Vector3d pivot = parent.inverse() * body.joint.translation();
        const int link = static_cast<int>(i) - 1;
        multibody_.setupRevolute(link, body.mass, principal_inertia(body, own), body.parent - 1, to_bullet(from_parent),
                                 to_bullet((own.linear().transpose() * body.axis).eval()), to_bullet(pivot),
                                 to_bullet((own.linear().transpose() * body.centre).eval()), true);
    }
    multibody_.finalizeMultiDof();
    for (std::size_t a = 0; a < model_.actuators.size(); a++) {
        multibody_.setJointPos(static_cast<int>(a), model_.actuators[a].home);
    }
    // Bullet's defaults damp all motion and cut off high rates; neither is wanted here.
    multibody_.setLinearDamping(0);
    multibody_.setAngularDamping(0);
    multibody_.setMaxCoordinateVelocity(1e10);
}

// A crawler on the ground stands on the edges of its belt. Each end has an inner and an outer edge, a circle; its
// lowest point is where it touches, so a crawler has four points of contact on a plane, and its rounded ends roll on
// it.
void Robot::add_crawler_edges(int crawler, double friction) {
    const Crawler &c = model_.crawlers[static_cast<std::size_t>(crawler)];
    const Eigen::Vector3d forward = c.axis.cross(Eigen::Vector3d::UnitZ()).normalized();
    for (const double end : {0.5, -0.5}) {
        for (const double side : {0.5, -0.5}) {
            const Eigen::Vector3d centre =
                c.centre + end * (c.length - 2 * c.radius) * forward + side * c.width * c.axis;
            const int front = end > 0 ? -1 : static_cast<int>(rims_.size()) - 2;
            rims_.push_back({centre, c.axis, c.radius, front});
            shapes_.push_back({crawler, true, friction});
        }
    }
}

void Robot::add_balls(int body, double friction) {
    BodyBalls own{body, static_cast<int>(shapes_.size()), balls_of(model_.bodies[static_cast<std::size_t>(body)]), 0};
    for (const Ball &ball : own.balls) {
        own.farthest = std::max(own.farthest, ball.centre.norm() + ball.radius);
        shapes_.push_back({body - 1, false, friction});
    }
    if (!own.balls.empty()) {
        balls_.push_back(own);
    }
}

void Robot::scale_friction(int crawler, double share) {
    for (ContactShape &shape : shapes_) {
        shape.friction *= shape.on_crawler && shape.part == crawler ? share : 1;
    }
}

Eigen::Isometry3d Robot::body_frame(int body) const {
    const PlacedBody &placed = bodies()[static_cast<std::size_t>(body)];
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.linear() = placed.axes;
    frame.translation() = placed.origin;
    return frame;
}

void Robot::set_pose(const Eigen::Isometry3d &pose) {
    multibody().setBaseWorldTransform(to_bullet(pose * principal_[0]));
}

const std::vector<PlacedBody> &Robot::bodies() const {
    if (!placed_) {
        look_ahead(0);
    }
    return bodies_;
}

void Robot::look_ahead(double seconds) const {
    btTransform principal;
    btTransformUtil::integrateTransform(multibody_.getBaseWorldTransform(), multibody_.getBaseVel(),
                                        multibody_.getBaseOmega(), seconds, principal);
    Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
    base.linear() = to_eigen(principal.getBasis());
    base.translation() = to_eigen(principal.getOrigin());
    std::array<double, max_actuators> angles{};
    for (int joint = 0; joint < multibody_.getNumLinks(); joint++) {
        angles[static_cast<std::size_t>(joint)] =
            multibody_.getJointPos(joint) + seconds * multibody_.getJointVel(joint);
    }
    place_bodies(model_, base * from_principal_, angles.data(), bodies_);
    placed_ = true;
}

void Robot::move(const GeneralVector &velocity, double seconds) {
    btMultiBody &own = multibody();
    own.setBaseOmega(to_bullet(Eigen::Vector3d(velocity.head<3>())));
    own.setBaseVel(to_bullet(Eigen::Vector3d(velocity.segment<3>(3))));
    for (int joint = 0; joint < own.getNumLinks(); joint++) {
        own.setJointVel(joint, velocity[base_dofs + joint]);
    }
    own.stepPositionsMultiDof(seconds);
}

GeneralVector Robot::velocity() const {
    const int dofs = base_dofs + multibody_.getNumDofs();
    GeneralVector velocity = GeneralVector::Zero();
    velocity.head(dofs) = Eigen::Map<const Eigen::VectorXd>(multibody_.getVelocityVector(), dofs);
    return velocity;
}

Eigen::Vector3d Robot::centre_of_mass() const {
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const PlacedBody &body : bodies()) {
        moment += body.mass * body.centre;
    }
    return moment / model_.mass();
}

// The linear momentum is three of the rows of mass matrix times velocity.
Eigen::Vector3d Robot::centre_of_mass_velocity() const {
    return mass_matrix(bodies()).middleRows<3>(3) * velocity() / model_.mass();
}

double Robot::kinetic_energy() const {
    const GeneralVector rates = velocity();
    return 0.5 * rates.dot(mass_matrix(bodies()) * rates);
}

double Robot::travel_per_radian(int actuator) const {
    const auto a = static_cast<std::size_t>(actuator);
    return a < model_.crawlers.size() ? model_.crawlers[a].radius : 1;
}

double Robot::actuator_position(int actuator) const {
    return travel_per_radian(actuator) * multibody_.getJointPos(actuator);
}

double Robot::actuator_velocity(int actuator) const {
    return travel_per_radian(actuator) * multibody_.getJointVel(actuator);
}

}  // namespace limphome
