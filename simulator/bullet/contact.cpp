#include "bullet/contact.h"

#include <algorithm>

#include "bullet/crawler.h"

namespace limphome {
namespace {

// A tenth of the ground's deflection: drives at their limit press bodies together by less than a millimetre or so.
constexpr double firmness_of_bodies = 10;

using JacobianColumns = Eigen::Matrix<double, max_dofs, 3>;

// Tangents: along and across the belt on a crawler, so that drives act on one of them only; else any.
Eigen::Matrix3d contact_frame(const Robot &robot, const ContactShape &shape, const ContactShape &other,
                              const Eigen::Vector3d &normal) {
    Eigen::Matrix3d frame;
    const ContactShape &belt = shape.on_crawler ? shape : other;
    Eigen::Vector3d along = belt.on_crawler ? belt_direction(robot, belt.part, normal) : normal.unitOrthogonal();
    if (along.isZero()) {  // lying on its side
        along = normal.unitOrthogonal();
    }
    frame.col(0) = normal;
    frame.col(1) = along.normalized();
    frame.col(2) = normal.cross(frame.col(1));
    return frame;
}

// Velocity of a point fixed to a body along the columns of the contact's frame.
JacobianColumns body_jacobian(const std::vector<PlacedBody> &bodies, int body, const Contact &contact) {
    const Eigen::Vector3d arm = contact.point - bodies[0].centre;
    JacobianColumns jacobian = JacobianColumns::Zero();
    for (int column = 0; column < 3; column++) {
        jacobian.col(column).head<3>() = arm.cross(contact.frame.col(column));
        jacobian.col(column).segment<3>(3) = contact.frame.col(column);
    }
    for (auto i = static_cast<std::size_t>(body); i > 0; i = static_cast<std::size_t>(bodies[i].parent)) {
        const Eigen::Vector3d turning = bodies[i].axis.cross(contact.point - bodies[i].origin);
        jacobian.row(joint_dof(i)) = turning.transpose() * contact.frame;
    }
    return jacobian;
}

// Likewise of the surface of `shape`, into which `normal` points.
JacobianColumns surface_jacobian(const Robot &robot, const ContactShape &shape, const Eigen::Vector3d &normal,
                                 const Contact &contact) {
    JacobianColumns jacobian = body_jacobian(robot.bodies(), shape.on_crawler ? 0 : shape.part + 1, contact);
    if (shape.on_crawler) {
        jacobian.row(base_dofs + shape.part) += belt_velocity(robot, shape.part, normal, contact.frame).transpose();
    }
    return jacobian;
}

// The impulse a contact begins with: what its shape bore in the step before, turned into the new frame. Of several
// between the same two bodies it is the nearest.
Eigen::Vector3d initial_impulse(const Contact &contact, const std::vector<Contact> &previous) {
    const Contact *same = nullptr;
    const auto distance = [&contact](const Contact &old) { return (old.point - contact.point).squaredNorm(); };
    for (const Contact &old : previous) {
        const bool alike = old.shape == contact.shape && old.other == contact.other &&
                           old.frame.col(0).dot(contact.frame.col(0)) > 0.9;
        if (alike && (same == nullptr || distance(old) < distance(*same))) {
            same = &old;
        }
    }
    return same != nullptr ? Eigen::Vector3d(contact.frame.transpose() * (same->frame * same->impulse))
                           : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

void make_contact(const Robot &robot, const Ground &ground, const Touch &touch, Contact &contact) {
    static const ContactShape none{-1, false, 0};
    const bool on_ground = touch.other == Touch::ground;
    const ContactShape &shape = robot.shapes()[static_cast<std::size_t>(touch.shape)];
    const ContactShape &other = on_ground ? none : robot.shapes()[static_cast<std::size_t>(touch.other)];
    contact.shape = touch.shape;
    contact.other = touch.other;
    contact.point = touch.point;
    contact.frame = contact_frame(robot, shape, other, touch.normal);
    contact.depth = touch.depth;
    contact.jacobian = surface_jacobian(robot, shape, touch.normal, contact);
    if (on_ground) {
        contact.friction = shape.friction * ground.friction(touch.point);
        contact.firmness = 1;
    } else {
        contact.friction = std::min(shape.friction, other.friction);
        contact.firmness = firmness_of_bodies;
        contact.jacobian -= surface_jacobian(robot, other, -touch.normal, contact);
    }
}

}  // namespace

void make_contacts(const Robot &robot, const Ground &ground, const std::vector<Touch> &touches,
                   const std::vector<Contact> &previous, std::vector<Contact> &contacts) {
    contacts.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); i++) {
        make_contact(robot, ground, touches[i], contacts[i]);
        contacts[i].impulse = initial_impulse(contacts[i], previous);
    }
}

}  // namespace limphome
