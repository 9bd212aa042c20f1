// Contacts of the robot with the ground and of its bodies with each other, as the solver sees them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bullet/mass_matrix.h"
#include "bullet/robot.h"
#include "bullet/touch.h"

namespace limphome {

struct Contact {
    int shape;                // index into Robot::shapes()
    int other;                // as in Touch
    Eigen::Vector3d point;    // in the middle of the time step [m]
    Eigen::Matrix3d frame;    // columns: normal from the other into the shape, two tangents
    double depth;             // of penetration at its beginning; below 0: gap [m]
    double friction;          // Coulomb coefficient
    double firmness;          // how much stiffer than the ground it is
    Eigen::Vector3d impulse;  // of the other on the shape along the columns of frame [N s]
    // Velocity of the shape's surface against the other's, along the columns of frame, per unit of each velocity.
    Eigen::Matrix<double, max_dofs, 3> jacobian;
};

// Ground under load: a spring and a damper at every point of contact. Without them the load on the many points of a
// crawler would not be determined, and with it neither would friction.
struct GroundStiffness {
    double stiffness;  // [N/m]
    double damping;    // [N s/m]
};

// Fills `contacts`, one per touch in their order. Impulses start from those of the same shapes in `previous`.
void make_contacts(const Robot &robot, const Ground &ground, const std::vector<Touch> &touches,
                   const std::vector<Contact> &previous, std::vector<Contact> &contacts);

}  // namespace limphome
