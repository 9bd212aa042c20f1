#include "bullet/truth.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace limphome {
namespace {

constexpr double loaded = 1e-3;   // share of the robot's weight that counts as load on a point of support
constexpr double on_edge = 1e-6;  // twice the area of a triangle that counts as flat [m^2]

// Twice the area of the triangle a, b, c seen from above; above 0 if it turns left.
double turn(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// S_i of (10) for tipping about the line through a and b.
double rise_over_edge(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &centre_of_mass) {
    const Eigen::Vector3d along = (b - a).normalized();
    const Eigen::Vector3d r = centre_of_mass - a;
    const Eigen::Vector3d p = r - along.dot(r) * along;
    return p.norm() * std::sqrt(std::max(0.0, 1 - along.z() * along.z())) - p.z();
}

Eigen::Vector3d force(const Contact &contact, double time_step) {
    return contact.frame * contact.impulse / time_step;
}

// Touching contacts, strongest first where there are more than fit.
std::vector<Contact> touching(const std::vector<Contact> &contacts) {
    std::vector<Contact> strongest;
    std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(strongest),
                 [](const Contact &contact) { return contact.impulse[0] > 0; });
    if (strongest.size() > max_contacts) {
        std::stable_sort(strongest.begin(), strongest.end(),
                         [](const Contact &a, const Contact &b) { return a.impulse.norm() > b.impulse.norm(); });
        strongest.resize(max_contacts);
    }
    return strongest;
}

}  // namespace

// Monotone chain (Andrew 1979). Points less than some micrometres off an edge lie on it.
std::vector<Eigen::Vector3d> support_polygon(std::vector<Eigen::Vector3d> points) {
    std::sort(points.begin(), points.end(), [](const Eigen::Vector3d &a, const Eigen::Vector3d &b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    if (points.size() < 3) {
        return points;
    }
    std::vector<Eigen::Vector3d> hull;
    const auto extend = [&hull](const Eigen::Vector3d &point, std::size_t start) {
        while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= on_edge) {
            hull.pop_back();
        }
        hull.push_back(point);
    };
    for (const Eigen::Vector3d &point : points) {
        extend(point, 0);
    }
    const std::size_t upper = hull.size() - 1;
    for (auto point = points.rbegin() + 1; point != points.rend(); point++) {
        extend(*point, upper);
    }
    hull.pop_back();  // the first point again
    return hull;
}

double stability_margin(const std::vector<Eigen::Vector3d> &polygon, const Eigen::Vector3d &centre_of_mass) {
    if (polygon.size() < 2) {
        return 0;
    }
    double inside = std::numeric_limits<double>::infinity();
    double outside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); i++) {
        const Eigen::Vector3d &a = polygon[i];
        const Eigen::Vector3d &b = polygon[(i + 1) % polygon.size()];
        const double rise = rise_over_edge(a, b, centre_of_mass);
        inside = std::min(inside, rise);
        if (turn(a, b, centre_of_mass) < 0) {
            outside = std::min(outside, rise);
        }
    }
    const bool fell_out = std::isfinite(outside) || polygon.size() < 3;
    return fell_out ? -std::min(outside, inside) : inside;
}

void read_truth(const Robot &robot, const std::vector<Contact> &contacts, double time_step, ground_truth_t &truth) {
    ground_truth_t empty{};
    empty.utime = truth.utime;
    empty.session = truth.session;
    empty.seq = truth.seq;
    truth = empty;
    const Eigen::Vector3d centre = robot.centre_of_mass();
    Eigen::Map<Eigen::Vector3d>(truth.centre_of_mass) = centre;
    Eigen::Map<Eigen::Vector3d>(truth.velocity) = robot.centre_of_mass_velocity();

    std::vector<Eigen::Vector3d> carrying;
    const double least = loaded * robot.model().mass() * standard_gravity;
    for (const Contact &contact : touching(contacts)) {
        const auto i = static_cast<std::size_t>(truth.num_contacts++);
        const auto shape = static_cast<std::size_t>(contact.shape);
        const bool on_ground = contact.other == Touch::ground;
        truth.contact_part[i] = static_cast<int8_t>(robot.shapes()[shape].part);
        truth.contact_with[i] = static_cast<int8_t>(
            on_ground ? ground_truth_t::GROUND : robot.shapes()[static_cast<std::size_t>(contact.other)].part);
        Eigen::Map<Eigen::Vector3d>(truth.contact_point[i]) = contact.point;
        Eigen::Map<Eigen::Vector3d>(truth.contact_normal[i]) = contact.frame.col(0);
        Eigen::Map<Eigen::Vector3d>(truth.contact_force[i]) = force(contact, time_step);
        if (on_ground && contact.impulse[0] > least * time_step) {
            carrying.push_back(contact.point);
        }
    }
    const std::vector<Eigen::Vector3d> polygon = support_polygon(carrying);
    truth.num_support = static_cast<int32_t>(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); i++) {
        Eigen::Map<Eigen::Vector3d>(truth.support[i]) = polygon[i];
    }
    truth.stability_margin = stability_margin(polygon, centre);
}

}  // namespace limphome
