#include "bullet/meeting.h"

#include <algorithm>
#include <cmath>

namespace limphome {
namespace {

using Eigen::Vector3d;
using Axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;  // one a row

constexpr double same_point = 1e-6;       // [m]
constexpr double in_disc = M_SQRT1_2;     // half side over radius of the square in a disc
constexpr double farthest_point = 0.005;  // points with a wider gap do not carry [m]

// Corners of a face, or of what is left of it by cutting away; each cut adds one at most.
struct Polygon {
    int count = 0;
    std::array<Vector3d, 8> corners;

    void add(const Vector3d &corner) {
        const auto *const end = corners.data() + count;
        const bool known = std::any_of(
            static_cast<const Vector3d *>(corners.data()), end,
            [&corner](const Vector3d &other) { return (other - corner).squaredNorm() < same_point * same_point; });
        if (!known && count < static_cast<int>(corners.size())) {
            corners[static_cast<std::size_t>(count++)] = corner;
        }
    }
};

Vector3d centre_of(const robot_solid &solid) {
    return Vector3d(solid.centre);
}

Vector3d axis_of(const robot_solid &solid, int axis) {
    return Vector3d(solid.axes[axis]);
}

double half_width(const robot_solid &solid, const Vector3d &direction) {
    return robot_solid_half_width(&solid, direction.data());
}

// From a point of the box to the surface, in that direction.
Vector3d rounding(const robot_solid &solid, const Vector3d &direction) {
    if (!solid.disc) {
        return solid.radius * direction;
    }
    const Vector3d across = direction - direction.dot(axis_of(solid, 2)) * axis_of(solid, 2);
    return across.squaredNorm() > same_point ? solid.radius * across.normalized() : Vector3d(Vector3d::Zero());
}

// Half the length along axis `along` of the face across axis `face`.
double half_face(const robot_solid &solid, int face, int along) {
    return solid.half[along] + (solid.disc && face == 2 ? in_disc * solid.radius : 0);
}

// The point of the box that is farthest in that direction, in the middle of what is equally far along `free`.
Vector3d farthest(const robot_solid &solid, const Vector3d &direction, int free) {
    Vector3d point = centre_of(solid);
    for (int i = 0; i < 3; i++) {
        if (i != free) {
            point += std::copysign(solid.half[i], direction.dot(axis_of(solid, i))) * axis_of(solid, i);
        }
    }
    return point;
}

// The face that looks most into that direction; of what is rounded that way, what is left of it where it touches.
Polygon face_towards(const robot_solid &solid, const Vector3d &direction) {
    const Vector3d along = Axes(solid.axes[0]) * direction;
    Eigen::Index most = 0;
    along.cwiseAbs().maxCoeff(&most);
    const int face = static_cast<int>(most), u = (face + 1) % 3, v = (face + 2) % 3;
    Vector3d middle = centre_of(solid) + std::copysign(solid.half[face], along[face]) * axis_of(solid, face);
    if (!(solid.disc && face == 2)) {
        middle += rounding(solid, direction);
    }
    const Vector3d side_u = half_face(solid, face, u) * axis_of(solid, u);
    const Vector3d side_v = half_face(solid, face, v) * axis_of(solid, v);
    Polygon polygon;
    polygon.add(middle + side_u + side_v);
    polygon.add(middle - side_u + side_v);
    polygon.add(middle - side_u - side_v);
    polygon.add(middle + side_u - side_v);
    return polygon;
}

// What of the polygon lies on the inner side of a plane (Sutherland and Hodgman 1974).
Polygon cut(const Polygon &polygon, const Vector3d &outwards, double limit) {
    Polygon result;
    for (int i = 0; i < polygon.count; i++) {
        const Vector3d &here = polygon.corners[static_cast<std::size_t>(i)];
        const Vector3d &next = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
        const double over = outwards.dot(here) - limit, next_over = outwards.dot(next) - limit;
        if (over <= 0) {
            result.add(here);
        }
        if ((over < 0 && next_over > 0) || (over > 0 && next_over < 0)) {
            result.add(here + over / (over - next_over) * (next - here));
        }
    }
    return result;
}

// What of `other` lies over a face of `solid`. `outwards` is the face's normal.
void meet_face(const robot_solid &solid, int face, const Vector3d &outwards, const robot_solid &other,
               Meeting &meeting) {
    const double height = outwards.dot(centre_of(solid)) + half_width(solid, outwards);
    Polygon polygon = face_towards(other, -outwards);
    for (const int along : {(face + 1) % 3, (face + 2) % 3}) {
        const double half = half_face(solid, face, along) + 0.1 * same_point;
        const Vector3d side = axis_of(solid, along);
        const double middle = side.dot(centre_of(solid));
        polygon = cut(polygon, side, middle + half);
        polygon = cut(polygon, -side, half - middle);
    }
    if (polygon.count == 0) {  // it touches beside the square in a disc
        polygon.add(farthest(other, -outwards, -1) + rounding(other, -outwards));
    }
    for (int i = 0; i < polygon.count; i++) {
        const Vector3d &corner = polygon.corners[static_cast<std::size_t>(i)];
        const double depth = height - outwards.dot(corner);
        if (depth > -farthest_point) {
            meeting.points[static_cast<std::size_t>(meeting.count++)] = {corner + 0.5 * depth * outwards, depth};
        }
    }
}

// Halfway between the points where two edges are nearest to each other.
Vector3d between_edges(const robot_solid &a, const robot_solid &b, const robot_gap &gap, const Vector3d &normal) {
    const Vector3d p = farthest(a, -normal, gap.axis_a) + rounding(a, -normal), u = axis_of(a, gap.axis_a);
    const Vector3d q = farthest(b, normal, gap.axis_b) + rounding(b, normal), v = axis_of(b, gap.axis_b);
    const Vector3d apart = q - p;
    const double cosine = u.dot(v), sine2 = 1 - cosine * cosine;
    const double s = (apart.dot(u) - cosine * apart.dot(v)) / sine2;
    const double t = (cosine * apart.dot(u) - apart.dot(v)) / sine2;
    const double most_s = a.half[gap.axis_a], most_t = b.half[gap.axis_b];
    return 0.5 * (p + std::clamp(s, -most_s, most_s) * u + q + std::clamp(t, -most_t, most_t) * v);
}

// Moves a point of the solid to where it ends in that direction.
Vector3d on_surface(const robot_solid &solid, const Vector3d &direction, const Vector3d &point) {
    return point + (half_width(solid, direction) - direction.dot(point - centre_of(solid))) * direction;
}

}  // namespace

Meeting meet(const robot_solid &a, const robot_solid &b, const robot_gap &gap) {
    Meeting meeting;
    meeting.normal = Vector3d(gap.normal);
    switch (gap.meeting) {
        case ROBOT_FACE_OF_A:
            meet_face(a, gap.axis_a, -meeting.normal, b, meeting);
            break;
        case ROBOT_FACE_OF_B:
            meet_face(b, gap.axis_b, meeting.normal, a, meeting);
            break;
        case ROBOT_EDGES:
            meeting.points[0] = {between_edges(a, b, gap, meeting.normal), -gap.distance};
            meeting.count = 1;
            break;
        case ROBOT_POINTS:
            meeting.points[0] = {0.5 * (on_surface(a, -meeting.normal, Vector3d(gap.near_a)) +
                                        on_surface(b, meeting.normal, Vector3d(gap.near_b))),
                                 -gap.distance};
            meeting.count = 1;
            break;
    }
    return meeting;
}

}  // namespace limphome
