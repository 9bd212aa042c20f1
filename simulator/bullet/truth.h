// What only a simulator knows: contact forces, true centre of mass, true support polygon, its stability margin.
#pragma once

#include <Eigen/Core>
#include <limphome/ground_truth_t.hpp>
#include <vector>

#include "bullet/contact.h"
#include "bullet/robot.h"

namespace limphome {

// Fills all fields but utime, session and seq. `contacts` are those of the last time step, of this length [s].
void read_truth(const Robot &robot, const std::vector<Contact> &contacts, double time_step, ground_truth_t &truth);

// Convex hull, seen from above, counter-clockwise; points on its edges are left out.
std::vector<Eigen::Vector3d> support_polygon(std::vector<Eigen::Vector3d> points);

// NE stability margin (10)(11) [m]: the least rise of the centre of mass on the way over an edge of the polygon. Where
// it lies outside, the negative of the least over the edges it is beyond. At most 0 for fewer than 3 points.
double stability_margin(const std::vector<Eigen::Vector3d> &polygon, const Eigen::Vector3d &centre_of_mass);

}  // namespace limphome
