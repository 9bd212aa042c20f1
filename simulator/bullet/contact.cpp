#include "bullet/contact.h"

#include <algorithm>

#include "bullet/crawler.h"

namespace limphome {
namespace {

// A tenth of the ground's deflection: drives at their limit press bodies together by less than a millimetre or so.
constexpr double firmness_of_bodies = 10;

using JacobianColumns = Eigen::Matrix<double, max_dofs, 3>;

// One of the two surfaces that touch.
struct Surface {
    const ContactShape &shape;
    Eigen::Vector3d along;  // direction of its belt; 0 if it has none, or lies on its side
};

// `normal` points into it.
Surface surface_of(const Robot &robot, const ContactShape &shape, const Eigen::Vector3d &normal) {
    return {shape, shape.on_crawler ? belt_direction(robot, shape.part, normal) : Eigen::Vector3d(0, 0, 0)};
}

// Tangents: along and across a belt, so that drives act on one of them only; else any.
Eigen::Matrix3d contact_frame(const Eigen::Vector3d &normal, const Eigen::Vector3d &along) {
    Eigen::Matrix3d frame;
    frame.col(0) = normal;
    frame.col(1) = along.isZero() ? normal.unitOrthogonal() : along;
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

// Likewise of a surface.
JacobianColumns surface_jacobian(const Robot &robot, const Surface &surface, const Contact &contact) {
    const int part = surface.shape.part;
    JacobianColumns jacobian = body_jacobian(robot.bodies(), surface.shape.on_crawler ? 0 : part + 1, contact);
    if (surface.shape.on_crawler) {
        jacobian.row(base_dofs + part) += belt_velocity(robot, part, surface.along, contact.frame).transpose();
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
    const Surface own = surface_of(robot, robot.shapes()[static_cast<std::size_t>(touch.shape)], touch.normal);
    contact.shape = touch.shape;
    contact.other = touch.other;
    contact.point = touch.point;
    contact.depth = touch.depth;
    if (touch.other == Touch::ground) {
        contact.frame = contact_frame(touch.normal, own.along);
        contact.jacobian = surface_jacobian(robot, own, contact);
        contact.friction = own.shape.friction * ground.friction(touch.point);
        contact.firmness = 1;
        return;
    }
    const Surface other = surface_of(robot, robot.shapes()[static_cast<std::size_t>(touch.other)], -touch.normal);
    contact.frame = contact_frame(touch.normal, own.along.isZero() ? -other.along : own.along);
    contact.jacobian = surface_jacobian(robot, own, contact) - surface_jacobian(robot, other, contact);
    contact.friction = std::min(own.shape.friction, other.shape.friction);
    contact.firmness = firmness_of_bodies;
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
