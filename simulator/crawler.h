// Belts: how the turning of a sprocket shows in the contacts of its crawler.
#pragma once

#include "contact.h"

namespace limphome {

// Unit vector along the ground in which the robot travels when the belt runs forward without slip; 0 for a crawler that
// lies on its side, whose belt moves nothing.
Eigen::Vector3d belt_direction(const Robot &robot, int crawler, const Eigen::Vector3d &normal);

// Adds the sprocket's column to the rows of a contact of a crawler. The surface that touches the ground is the belt; it
// runs backwards against the body at radius * sprocket rate. By the same column the friction on the belt turns the
// sprocket, so that a locked, free, weak or stalled drive needs no case of its own.
void add_belt(const Robot &robot, int crawler, Contact &contact);

}  // namespace limphome
