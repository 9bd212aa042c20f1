// Solids against Bullet's own search for the distance of convex shapes (GJK, EPA), which shares nothing with ours.
#include <gtest/gtest.h>
#include <robot_solid.h>

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "bullet/convert.h"
#include "bullet/meeting.h"

namespace limphome {
namespace {

enum Kind { sphere = ROBOT_SPHERE, box = ROBOT_BOX, cylinder = ROBOT_CYLINDER };

// A shape of ours and the same as Bullet's.
struct Twin {
    robot_shape shape{};
    std::unique_ptr<btConvexShape> convex;
    btTransform frame;

    robot_solid solid() const { return robot_solid_of_shape(&shape); }
};

Twin make_twin(Kind kind, const Eigen::Vector3d &half, const Eigen::Isometry3d &pose) {
    Twin twin;
    twin.shape.kind = static_cast<robot_shape_kind>(kind);
    const Eigen::Quaterniond q(pose.linear());
    twin.shape.pose = {{pose(0, 3), pose(1, 3), pose(2, 3)}, {q.w(), q.x(), q.y(), q.z()}};
    Eigen::Map<Eigen::Vector3d>(twin.shape.half_size) = kind == sphere ? Eigen::Vector3d::Constant(half.x())
                                                        : kind == box  ? half
                                                                       : Eigen::Vector3d(half.x(), half.x(), half.z());
    if (kind == sphere) {
        twin.convex = std::make_unique<btSphereShape>(half.x());
    } else if (kind == box) {
        twin.convex = std::make_unique<btBoxShape>(to_bullet(half));
    } else {
        twin.convex = std::make_unique<btCylinderShapeZ>(btVector3(half.x(), half.x(), half.z()));
    }
    if (kind != sphere) {
        twin.convex->setMargin(0);
    }
    twin.frame = to_bullet(pose);
    return twin;
}

class Chance {
   public:
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Eigen::Vector3d vector(double low, double high) {
        return {uniform(low, high), uniform(low, high), uniform(low, high)};
    }
    Eigen::Isometry3d pose(double away) {
        Eigen::Isometry3d result(Eigen::Translation3d(vector(-away, away)));
        result.rotate(
            Eigen::Quaterniond(Eigen::Vector4d::NullaryExpr([this] { return gauss_(engine_); })).normalized());
        return result;
    }

   private:
    std::mt19937 engine_{1};
    std::normal_distribution<double> gauss_;
};

// Of Bullet. Nothing where its search for the depth gives up.
std::optional<double> expected_distance(const Twin &a, const Twin &b) {
    const btConvexShape *first = a.convex.get(), *second = b.convex.get();
    const btVector3 guess(1, 0, 0);
    btGjkEpaSolver2::sResults results{};
    if (btGjkEpaSolver2::Distance(first, a.frame, second, b.frame, guess, results)) {
        return results.distance - first->getMargin() - second->getMargin();
    }
    const bool found = btGjkEpaSolver2::Penetration(first, a.frame, second, b.frame, guess, results);
    return found ? std::optional<double>(results.distance) : std::nullopt;
}

struct Compared {
    double over = 0;                         // by how much ours claims more than there is [m]
    double least_share = 1;                  // of what there is, where it is above 1 mm
    double claimed_touch = 0;                // widest gap that ours takes for a touch [m]
    double depth_error = 0;                  // [m]
    int apart = 0, inside = 0, far_off = 0;  // depths wrong by more than 0.2 mm
};

Compared compare(Kind kind_a, Kind kind_b) {
    Chance chance;
    Compared result;
    for (int i = 0; i < 3000; i++) {
        const Twin a = make_twin(kind_a, chance.vector(0.05, 0.5), chance.pose(0.6));
        const Twin b = make_twin(kind_b, chance.vector(0.05, 0.5), chance.pose(0.6));
        const robot_solid solid_a = a.solid(), solid_b = b.solid();
        const double distance = robot_solid_gap(&solid_a, &solid_b).distance;
        const std::optional<double> found = expected_distance(a, b);
        if (!found) {
            continue;
        }
        const double expected = *found;
        result.over = std::max(result.over, distance - expected);
        if (expected > 0) {
            result.apart++;
            result.least_share =
                expected > 1e-3 ? std::min(result.least_share, distance / expected) : result.least_share;
            result.claimed_touch = distance < 0 ? std::max(result.claimed_touch, expected) : result.claimed_touch;
        } else {
            result.inside++;
            result.far_off += expected - distance > 2e-4;
            result.depth_error = std::max(result.depth_error, expected - distance);
        }
    }
    EXPECT_GT(result.apart, 1000);
    EXPECT_GT(result.inside, 500);
    EXPECT_LT(result.over, 1e-5);  // as far as Bullet's search goes
    return result;
}

TEST(Solid, BallsAreExact) {
    for (const Kind other : {sphere, box}) {
        const Compared c = compare(sphere, other);
        EXPECT_GT(c.least_share, 0.9999);
        EXPECT_EQ(c.claimed_touch, 0);
        EXPECT_LT(c.depth_error, 0.01);  // deep inside, where none but the middle counts
    }
}

TEST(Solid, BoxesAreExactInsideEachOther) {
    const Compared c = compare(box, box);
    EXPECT_EQ(c.claimed_touch, 0);
    EXPECT_LT(c.far_off, 5);  // of more than 1000, where Bullet ends its search early
    EXPECT_GT(c.least_share, 1 / std::sqrt(3.0));
}

TEST(Solid, CylindersTouchWhereTheyDo) {
    for (const Kind other : {sphere, box, cylinder}) {
        const Compared c = compare(cylinder, other);
        EXPECT_LT(c.claimed_touch, 2e-3);  // of up to half a metre
    }
}

robot_solid solid_of(Kind kind, const Eigen::Vector3d &half, const Eigen::Isometry3d &pose) {
    return make_twin(kind, half, pose).solid();
}

Meeting meet_below(const robot_solid &a, const robot_solid &b) {
    const robot_gap gap = robot_solid_gap(&a, &b);
    Meeting meeting = meet(a, b, gap);
    EXPECT_NEAR((meeting.normal - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-6);
    for (int i = 0; i < meeting.count; i++) {
        const MeetingPoint &at = meeting.points[static_cast<std::size_t>(i)];
        EXPECT_NEAR(at.depth, 0.001, 1e-6);
        EXPECT_NEAR(at.point.z(), 0, 1e-6);
    }
    return meeting;
}

// A plate whose upper face is 0.5 mm above 0, of 0.4 by 0.2.
const robot_solid &plate() {
    static const robot_solid solid =
        solid_of(box, {0.2, 0.1, 0.05}, Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.0495)));
    return solid;
}

Eigen::Isometry3d above(double height, const Eigen::Quaterniond &turned = Eigen::Quaterniond::Identity()) {
    return Eigen::Translation3d(0.03, 0.02, height - 0.0005) * turned;
}

const Eigen::AngleAxisd eighth(0.25 * M_PI, Eigen::Vector3d::UnitZ()), quarter(0.5 * M_PI, Eigen::Vector3d::UnitX());

TEST(Meeting, FacesTouchAtTheCornersOfWhatTheyShare) {
    EXPECT_EQ(meet_below(solid_of(box, {0.05, 0.05, 0.1}, above(0.1)), plate()).count, 4);
    EXPECT_EQ(meet_below(solid_of(box, {0.5, 0.5, 0.1}, above(0.1)), plate()).count, 4);
    EXPECT_EQ(meet_below(solid_of(box, {0.12, 0.12, 0.1}, above(0.1, Eigen::Quaterniond(eighth))), plate()).count, 6);
    EXPECT_EQ(meet_below(solid_of(cylinder, {0.05, 0.05, 0.1}, above(0.1)), plate()).count, 4);
}

TEST(Meeting, EdgesAndRollersTouchAlongALine) {
    const Eigen::AngleAxisd tilted(0.25 * M_PI, Eigen::Vector3d::UnitX());
    const double height = 0.05 * std::sqrt(2.0);
    Meeting meeting = meet_below(solid_of(box, {0.08, 0.05, 0.05}, above(height, Eigen::Quaterniond(tilted))), plate());
    ASSERT_GE(meeting.count, 2);
    meeting = meet_below(solid_of(cylinder, {0.05, 0.05, 0.04}, above(0.05, Eigen::Quaterniond(quarter))), plate());
    ASSERT_EQ(meeting.count, 2);
    EXPECT_NEAR(std::abs(meeting.points[0].point.y() - meeting.points[1].point.y()), 0.08, 1e-6);
}

TEST(Meeting, AllElseTouchesInAPoint) {
    Meeting meeting = meet_below(solid_of(sphere, {0.05, 0, 0}, above(0.05)), plate());
    ASSERT_EQ(meeting.count, 1);
    EXPECT_NEAR((meeting.points[0].point - Eigen::Vector3d(0.03, 0.02, 0)).norm(), 0, 1e-6);
    // two roofs, one on its head across the other
    const double height = 0.05 * std::sqrt(2.0);
    const Eigen::AngleAxisd along_x(0.25 * M_PI, Eigen::Vector3d::UnitX()),
        along_y(0.25 * M_PI, Eigen::Vector3d::UnitY());
    const robot_solid lower =
        solid_of(box, {0.3, 0.05, 0.05}, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.0005 - height) * along_x));
    const robot_solid upper = solid_of(box, {0.05, 0.3, 0.05}, above(height, Eigen::Quaterniond(along_y)));
    meeting = meet_below(upper, lower);
    ASSERT_EQ(meeting.count, 1);
    EXPECT_NEAR((meeting.points[0].point - Eigen::Vector3d(0.03, 0, 0)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace limphome
