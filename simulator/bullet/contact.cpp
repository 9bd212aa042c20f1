#include "bullet/contact.h"

#include "bullet/convert.h"
#include "bullet/crawler.h"

namespace limphome {
namespace {

// Tangents: along and across the belt on a crawler, so that drives act on one of them only; else any.
Eigen::Matrix3d contact_frame(const Robot &robot, const ContactShape &shape, const Eigen::Vector3d &normal) {
    Eigen::Matrix3d frame;
    Eigen::Vector3d along = shape.on_crawler ? belt_direction(robot, shape.part, normal) : normal.unitOrthogonal();
    if (along.isZero()) {  // lying on its side
        along = normal.unitOrthogonal();
    }
    frame.col(0) = normal;
    frame.col(1) = along.normalized();
    frame.col(2) = normal.cross(frame.col(1));
    return frame;
}

// Velocity of a point fixed to `link` along the columns of the contact's frame.
void fill_jacobian(const btMultiBody &multibody, int link, Contact &contact) {
    const Eigen::Vector3d arm = contact.point - to_eigen(multibody.getBasePos());
    contact.jacobian.setZero();
    for (int column = 0; column < 3; column++) {
        contact.jacobian.col(column).head<3>() = arm.cross(contact.frame.col(column));
        contact.jacobian.col(column).segment<3>(3) = contact.frame.col(column);
    }
    for (int joint = link; joint >= 0; joint = multibody.getParent(joint)) {
        const JointAxis axis = joint_axis(multibody, joint);
        contact.jacobian.row(base_dofs + joint) =
            axis.direction.cross(contact.point - axis.pivot).transpose() * contact.frame;
    }
}

// The impulse a contact begins with: what its shape bore in the step before, turned into the new frame.
Eigen::Vector3d initial_impulse(const Contact &contact, const std::vector<Contact> &previous) {
    for (const Contact &old : previous) {
        if (old.shape == contact.shape && old.frame.col(0).dot(contact.frame.col(0)) > 0.9) {
            return contact.frame.transpose() * (old.frame * old.impulse);
        }
    }
    return Eigen::Vector3d::Zero();
}

void make_contact(const Robot &robot, const Ground &ground, const Touch &touch, Contact &contact) {
    const ContactShape &shape = robot.shapes()[static_cast<std::size_t>(touch.shape)];
    contact.shape = touch.shape;
    contact.point = touch.point;
    contact.frame = contact_frame(robot, shape, touch.normal);
    contact.depth = touch.depth;
    contact.friction = shape.friction * ground.friction(touch.point);
    fill_jacobian(robot.multibody(), shape.on_crawler ? -1 : shape.part, contact);
    if (shape.on_crawler) {
        contact.jacobian.row(base_dofs + shape.part) += belt_velocity(robot, shape.part, contact.frame).transpose();
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
