#include "bullet/robot.h"

#include <Eigen/Eigenvalues>
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
      multibody_(static_cast<int>(model.actuators.size()), model.bodies[0].mass,
                 principal_inertia(model.bodies[0], principal_[0]), false, false) {
    build_links();
    add_crawlers(frictions.crawler);
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
void Robot::add_crawler_edges(btCompoundShape &compound, int crawler, double friction) {
    const Crawler &c = model_.crawlers[static_cast<std::size_t>(crawler)];
    const Eigen::Vector3d forward = c.axis.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Quaterniond upright = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), c.axis);
    for (const double end : {0.5, -0.5}) {
        for (const double side : {0.5, -0.5}) {
            const Eigen::Vector3d centre =
                c.centre + end * (c.length - 2 * c.radius) * forward + side * c.width * c.axis;
            auto circle = std::make_unique<btCylinderShape>(btVector3(c.radius, 0, c.radius));
            circle->setMargin(0);
            const Eigen::Isometry3d pose = Eigen::Translation3d(centre) * upright;
            compound.addChildShape(to_bullet(principal_[0].inverse() * pose), circle.get());
            geometry_.push_back(std::move(circle));
            const int front = end > 0 ? -1 : static_cast<int>(rims_.size()) - 2;
            rims_.push_back({centre, c.axis, c.radius, front});
            shapes_.push_back({crawler, true, friction});
        }
    }
}

btMultiBodyLinkCollider &Robot::add_collider(int body, std::unique_ptr<btCompoundShape> compound, int first_shape) {
    auto collider = std::make_unique<btMultiBodyLinkCollider>(&multibody_, body - 1);
    collider->setCollisionShape(compound.get());
    collider->setUserIndex(first_shape);
    geometry_.push_back(std::move(compound));
    colliders_.push_back(std::move(collider));
    return *colliders_.back();
}

void Robot::add_crawlers(double friction) {
    auto compound = std::make_unique<btCompoundShape>();
    for (int crawler = 0; crawler < num_crawlers; crawler++) {
        add_crawler_edges(*compound, crawler, friction);
    }
    multibody_.setBaseCollider(&add_collider(0, std::move(compound), 0));
}

void Robot::add_balls(int body, double friction) {
    const auto index = static_cast<std::size_t>(body);
    auto compound = std::make_unique<btCompoundShape>();
    const int first_shape = static_cast<int>(shapes_.size());
    for (const Ball &ball : balls_of(model_.bodies[index])) {
        auto sphere = std::make_unique<btSphereShape>(ball.radius);
        const Eigen::Isometry3d pose(Eigen::Translation3d(ball.centre));
        compound->addChildShape(to_bullet(principal_[index].inverse() * pose), sphere.get());
        geometry_.push_back(std::move(sphere));
        balls_.push_back({principal_[index].inverse() * ball.centre, ball.radius});
        shapes_.push_back({body - 1, false, friction});
    }
    if (compound->getNumChildShapes() == 0) {
        return;
    }
    btMultiBodyLinkCollider &collider = add_collider(body, std::move(compound), first_shape);
    if (body == 0) {
        hull_ = &collider;
    } else {
        multibody_.getLink(body - 1).m_collider = &collider;
    }
}

void Robot::place_hull() {
    if (hull_ != nullptr) {
        hull_->setWorldTransform(multibody_.getBaseCollider()->getWorldTransform());
    }
}

Ball Robot::ball(int shape) const {
    const Ball &own = balls_[static_cast<std::size_t>(shape) - rims_.size()];
    const int part = shapes_[static_cast<std::size_t>(shape)].part;
    const btTransform frame =
        part < 0 ? multibody_.getBaseWorldTransform() : multibody_.getLink(part).m_cachedWorldTransform;
    return {to_eigen(frame * to_bullet(own.centre)), own.radius};
}

void Robot::scale_friction(int crawler, double share) {
    for (ContactShape &shape : shapes_) {
        shape.friction *= shape.on_crawler && shape.part == crawler ? share : 1;
    }
}

Eigen::Isometry3d Robot::body_frame(int body) const {
    const btTransform link =
        body == 0 ? multibody_.getBaseWorldTransform() : multibody_.getLink(body - 1).m_cachedWorldTransform;
    const Eigen::Isometry3d frame = Eigen::Translation3d(to_eigen(link.getOrigin())) * to_eigen(link.getRotation());
    return frame * principal_[static_cast<std::size_t>(body)].inverse();
}

void Robot::set_pose(const Eigen::Isometry3d &pose) {
    multibody_.setBaseWorldTransform(to_bullet(pose * principal_[0]));
    update_frames();
}

void Robot::update_frames() {
    multibody_.forwardKinematics(scratch_rotations_, scratch_origins_);
    multibody_.updateCollisionObjectWorldTransforms(scratch_rotations_, scratch_origins_);
    place_hull();
}

// Link frames of Bullet lie at the centres of mass.
Eigen::Vector3d Robot::centre_of_mass() const {
    Eigen::Vector3d moment = model_.bodies[0].mass * to_eigen(multibody_.getBasePos());
    for (int link = 0; link < multibody_.getNumLinks(); link++) {
        moment += multibody_.getLinkMass(link) * to_eigen(multibody_.localPosToWorld(link, btVector3(0, 0, 0)));
    }
    return moment / model_.mass();
}

Eigen::Vector3d Robot::centre_of_mass_velocity() const {
    const int count = multibody_.getNumLinks() + 1;
    std::vector<btVector3> angular(static_cast<std::size_t>(count)), linear(static_cast<std::size_t>(count));
    multibody_.compTreeLinkVelocities(angular.data(), linear.data());
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    for (int body = 0; body < count; body++) {
        const auto i = static_cast<std::size_t>(body);
        momentum += model_.bodies[i].mass * to_eigen(multibody_.localDirToWorld(body - 1, linear[i]));
    }
    return momentum / model_.mass();
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
