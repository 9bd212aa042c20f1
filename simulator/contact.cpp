#include "contact.h"

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>

#include "convert.h"
#include "crawler.h"

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
        contact.jacobian.row(6 + joint) = axis.direction.cross(contact.point - axis.pivot).transpose() * contact.frame;
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

Contact make_contact(const Robot &robot, const btMultiBodyLinkCollider &collider, int child,
                     const btManifoldPoint &found, const Eigen::Vector3d &normal) {
    Contact contact;
    contact.shape = collider.getUserIndex() + child;
    const ContactShape &shape = robot.shapes()[static_cast<std::size_t>(contact.shape)];
    contact.point = 0.5 * to_eigen(found.getPositionWorldOnA() + found.getPositionWorldOnB());
    contact.frame = contact_frame(robot, shape, normal);
    contact.depth = -found.getDistance();
    contact.friction = shape.friction;
    fill_jacobian(robot.multibody(), collider.m_link, contact);
    if (shape.on_crawler) {
        add_belt(robot, shape.part, contact);
    }
    return contact;
}

}  // namespace

std::vector<Contact> collect_contacts(const Robot &robot, btDispatcher &dispatcher,
                                      const std::vector<Contact> &previous) {
    std::vector<Contact> contacts;
    contacts.reserve(robot.shapes().size());
    const auto add = [&](const Contact &contact) {
        const auto place = std::upper_bound(contacts.begin(), contacts.end(), contact,
                                            [](const Contact &a, const Contact &b) { return a.shape < b.shape; });
        contacts.insert(place, contact)->impulse = initial_impulse(contact, previous);
    };
    for (int m = 0; m < dispatcher.getNumManifolds(); m++) {
        const btPersistentManifold &manifold = *dispatcher.getManifoldByIndexInternal(m);
        const auto *first = btMultiBodyLinkCollider::upcast(manifold.getBody0());
        const auto *second = btMultiBodyLinkCollider::upcast(manifold.getBody1());
        for (int i = 0; i < manifold.getNumContacts(); i++) {
            const btManifoldPoint &point = manifold.getContactPoint(i);
            const Eigen::Vector3d normal = to_eigen(point.m_normalWorldOnB);  // from body 1 into body 0
            add(first != nullptr ? make_contact(robot, *first, point.m_index0, point, normal)
                                 : make_contact(robot, *second, point.m_index1, point, -normal));
        }
    }
    return contacts;
}

}  // namespace limphome
