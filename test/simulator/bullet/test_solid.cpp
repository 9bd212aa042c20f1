// Solids against Bullet's own search for the distance of convex shapes (GJK, EPA), which shares nothing with ours.
#include <gtest/gtest.h>
#include <robot_solid.h>

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
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
    Eigen::Map<Eigen::Vector3d>(twin.shape.half_size) =
        kind == sphere ? Eigen::Vector3d::Constant(half.x()) : kind == box ? half : Eigen::Vector3d(half.x(), half.x(), half.z());
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
    Eigen::Vector3d vector(double low, double high) { return {uniform(low, high), uniform(low, high), uniform(low, high)}; }
    Eigen::Isometry3d pose(double away) {
        Eigen::Isometry3d result(Eigen::Translation3d(vector(-away, away)));
        result.rotate(Eigen::Quaterniond(Eigen::Vector4d::NullaryExpr([this] { return gauss_(engine_); })).normalized());
        return result;
    }

   private:
    std::mt19937 engine_{1};
    std::normal_distribution<double> gauss_;
};

double gjk_distance(const Twin &a, const Twin &b) {
    btGjkEpaSolver2::sResults results{};
    if (btGjkEpaSolver2::Distance(a.convex.get(), a.frame, b.convex.get(), b.frame, btVector3(1, 0, 0), results)) {
        return results.distance - a.convex->getMargin() - b.convex->getMargin();
    }
    results = {};
    EXPECT_TRUE(btGjkEpaSolver2::Penetration(a.convex.get(), a.frame, b.convex.get(), b.frame, btVector3(1, 0, 0), results));
    return results.distance;
}

TEST(SolidProbe, Statistics) {
    Chance chance;
    for (int ka = 0; ka < 3; ka++) {
        for (int kb = ka; kb < 3; kb++) {
            double most_over = 0, worst_ratio = 1, worst_depth = 0, ghost = 0; int sep = 0, pen = 0;
            for (int i = 0; i < 3000; i++) {
                const Twin a = make_twin((Kind)ka, chance.vector(0.05, 0.5), chance.pose(0.6));
                const Twin b = make_twin((Kind)kb, chance.vector(0.05, 0.5), chance.pose(0.6));
                const robot_solid sa = a.solid(), sb = b.solid();
                const robot_gap gap = robot_solid_gap(&sa, &sb);
                const double ref = gjk_distance(a, b);
                if (ref > 0) {
                    sep++;
                    most_over = std::max(most_over, gap.distance - ref);
                    if (ref > 1e-3) worst_ratio = std::min(worst_ratio, gap.distance / ref);
                    if (gap.distance < 0) ghost = std::max(ghost, ref);
                } else {
                    pen++;
                    worst_depth = std::max(worst_depth, std::abs(gap.distance - ref));
                }
            }
            std::printf("%d %d: sep %d over %g ratio %g ghost %g; pen %d depth err %g\n", ka, kb, sep, most_over, worst_ratio, ghost, pen, worst_depth);
        }
    }
}

}  // namespace
}  // namespace limphome
