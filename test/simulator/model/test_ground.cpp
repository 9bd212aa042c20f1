#include "model/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "laboratory.h"

namespace limphome {
namespace {

settings rough(double amplitude, double wavelength, int64_t seed = 1) {
    settings s = settings_default();
    s.ground.rough_amplitude_m = amplitude;
    s.ground.rough_wavelength_m = wavelength;
    s.ground.seed = seed;
    return s;
}

settings steps(double height) {
    settings s = settings_default();
    s.ground.step_height_m = height;
    s.ground.step_spacing_m = 3;
    return s;
}

TEST(Ground, IsLevelUnlessAskedFor) {
    const Ground ground(settings_default());
    EXPECT_TRUE(ground.level());
    EXPECT_EQ(ground.friction({1, 2, 0}), 1);
    EXPECT_FALSE(Ground(rough(0.1, 1)).level());
    EXPECT_FALSE(Ground(steps(0.1)).level());
}

TEST(Ground, InclineRisesAsItsAnglesSay) {
    settings s = settings_default();
    s.ground.incline_along_rad = 0.3;
    s.ground.incline_across_rad = -0.2;
    const Ground ground(s);
    EXPECT_NEAR(ground.height(0, 2), 2 * std::tan(0.3), 1e-8);
    EXPECT_NEAR(ground.height(1, 0), -std::tan(0.2), 1e-8);
    const Clearance c = ground.clearance({1, 2, 5});
    EXPECT_NEAR(c.distance, (5 - 2 * std::tan(0.3) + std::tan(0.2)) * ground.incline().z(), 1e-12);
    EXPECT_LT((c.normal - ground.incline()).norm(), 1e-12);
}

TEST(Ground, RoughHeightsAndNormalsBelongTogether) {
    const Ground ground(rough(0.1, 1));
    double lowest = 1, highest = -1;
    for (int i = 0; i < 2000; i++) {
        const double x = 0.37 * i - 300, y = 0.211 * i - 50, h = 1e-5;
        const double z = ground.height(x, y);
        lowest = std::min(lowest, z);
        highest = std::max(highest, z);
        const Eigen::Vector3d along_x(2 * h, 0, ground.height(x + h, y) - ground.height(x - h, y));
        const Eigen::Vector3d along_y(0, 2 * h, ground.height(x, y + h) - ground.height(x, y - h));
        const Clearance c = ground.clearance({x, y, z});
        ASSERT_NEAR(c.distance, 0, 1e-8);
        ASSERT_LT((c.normal - along_x.cross(along_y).normalized()).norm(), 1e-3);
    }
    EXPECT_GE(lowest, -0.1);
    EXPECT_LE(highest, 0.1);
    EXPECT_GT(highest - lowest, 0.1);  // and not much smoother than asked for
}

TEST(Ground, IsTheSameFromTheSameSeed) {
    const Ground one(rough(0.1, 1, 7)), same(rough(0.1, 1, 7)), other(rough(0.1, 1, 8));
    settings s = rough(0.1, 1, 7);
    s.learning.seed = 99;
    const Ground learner(s);
    double difference = 0;
    for (int i = 0; i < 100; i++) {
        EXPECT_EQ(one.height(0.3 * i, i), same.height(0.3 * i, i));
        EXPECT_EQ(one.height(0.3 * i, i), learner.height(0.3 * i, i));
        difference = std::max(difference, std::abs(one.height(0.3 * i, i) - other.height(0.3 * i, i)));
    }
    EXPECT_GT(difference, 0.03);
}

TEST(Ground, RoughGroundIsUniformAtTheNodesAndNeighboursAreIndependent) {
    const Lattice lattice(12345, -1, 1, 0.5);
    constexpr int side = 300;
    constexpr double count = 1.0 * side * side;
    double mean = 0, square = 0, beside = 0, above = 0, across = 0;
    std::array<int, 10> tenths{};
    for (int i = -side / 2; i < side / 2; i++) {
        for (int j = -side / 2; j < side / 2; j++) {
            const auto node = [&](int column, int row) { return lattice.cell(0.5 * column + 0.25, 0.5 * row + 0.25); };
            const double value = node(i, j);
            mean += value / count;
            square += value * value / count;
            beside += value * node(i + 1, j) / count;
            above += value * node(i, j + 1) / count;
            across += value * node(i + 1, j - 1) / count;
            tenths.at(static_cast<std::size_t>(5 + std::floor(5 * value)))++;
        }
    }
    const double error = 1 / std::sqrt(count);
    EXPECT_NEAR(mean, 0, 4 * error / std::sqrt(3));
    EXPECT_NEAR(square, 1.0 / 3, 4 * error * std::sqrt(4.0 / 45));
    for (const double correlation : {beside, above, across}) {
        EXPECT_NEAR(correlation, 0, 4 * error / 3);
    }
    for (const int number : tenths) {
        EXPECT_NEAR(number, 0.1 * count, 4 * std::sqrt(0.09 * count));
    }
}

// For every distance up to 200 m along, across and both, the heights there have nothing to do with those here.
TEST(Ground, RoughGroundDoesNotRepeatItself) {
    const Ground ground(rough(0.1, 1));
    constexpr int points = 400;  // a node apart and more
    const auto height = [&ground](int i, const Eigen::Vector2d &away) {
        const int row = i / 20, column = i % 20;
        return ground.height(away.x() + 0.7 * column, away.y() + 0.7 * row);
    };
    const auto correlation = [&](const Eigen::Vector2d &away) {
        double here = 0, there = 0, both = 0;
        for (int i = 0; i < points; i++) {
            const double a = height(i, {0, 0}), b = height(i, away);
            here += a * a;
            there += b * b;
            both += a * b;
        }
        return both / std::sqrt(here * there);
    };
    EXPECT_GT(correlation({0, 0.05}), 0.9);
    for (int step = 32; step <= 400; step++) {  // half a metre each, as the nodes
        for (const Eigen::Vector2d &direction : {Eigen::Vector2d(0.5, 0), {0, 0.5}, {0.5, 0.5}, {0.5, -0.5}}) {
            ASSERT_LT(std::abs(correlation(step * direction)), 0.5) << step << " nodes";
        }
    }
}

// What is kept of the nodes for speed must not show.
TEST(Ground, IsTheSameInWhateverOrderItIsLookedAt) {
    const Ground ground(rough(0.1, 1)), backwards(rough(0.1, 1));
    std::vector<double> heights;
    heights.reserve(500);
    for (int i = 0; i < 500; i++) {
        heights.push_back(ground.height(0.61 * (i % 40), -4.0 * (i % 7)));
    }
    for (int i = 499; i >= 0; --i) {
        EXPECT_EQ(backwards.height(0.61 * (i % 40), -4.0 * (i % 7)), heights[static_cast<std::size_t>(i)]);
    }
}

TEST(Ground, StepsGoUpAndDown) {
    const Ground ground(steps(0.2));
    EXPECT_NEAR(ground.height(5, 0), 0, 1e-8);
    EXPECT_NEAR(ground.height(5, 1.49), 0, 1e-8);
    EXPECT_NEAR(ground.height(5, 1.54), 0.2, 1e-8);
    EXPECT_NEAR(ground.height(5, 4.46), 0.2, 1e-8);
    EXPECT_NEAR(ground.height(5, 4.51), 0, 1e-8);
    EXPECT_NEAR(ground.height(5, -1.54), 0.2, 1e-8);
}

TEST(Ground, StepsHaveRisersAndRoundedEdges) {
    const Ground ground(steps(0.2));
    const Clearance riser = ground.clearance({0, 1.4, 0.12});
    EXPECT_NEAR(riser.distance, 0.1, 1e-12);
    EXPECT_LT((riser.normal - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
    const Clearance floor = ground.clearance({0, 1.3, 0.12});
    EXPECT_NEAR(floor.distance, 0.12, 1e-12);
    EXPECT_LT((floor.normal - Eigen::Vector3d(0, 0, 1)).norm(), 1e-12);
    const Clearance edge = ground.clearance({0, 1.5, 0.2});  // where the sharp edge would be
    EXPECT_NEAR(edge.distance, 0.03 * (std::sqrt(2) - 1), 1e-12);
    EXPECT_LT((edge.normal - Eigen::Vector3d(0, -1, 1).normalized()).norm(), 1e-12);
    const Clearance beyond = ground.clearance({0, -1.4, 0.12});  // the step behind faces the other way
    EXPECT_LT((beyond.normal - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);
}

TEST(Ground, DistanceIsToTheNearestPointOfStepsOnAnIncline) {
    settings s = steps(0.2);
    s.ground.incline_along_rad = 0.3;
    const Ground ground(s);
    const Clearance c = ground.clearance({0, 1.4, 1.4 * std::tan(0.3) + 0.12});
    EXPECT_NEAR(c.normal.dot(ground.incline()), 0, 1e-12);  // the riser stands upright on the incline
    EXPECT_NEAR(c.distance, 0.1 / std::cos(0.3), 1e-12);
}

TEST(Ground, PatchesTakeTheirShare) {
    settings s = settings_default();
    s.ground.patch_share = 0.3;
    s.ground.patch_friction = 0.2;
    const Ground ground(s);
    EXPECT_TRUE(ground.level());
    int loose = 0;
    for (int i = 0; i < 64; i++) {
        for (int j = 0; j < 64; j++) {
            const Eigen::Vector3d point(0.5 * i + 0.1, 0.5 * j + 0.4, 0);
            const double friction = ground.friction(point);
            ASSERT_TRUE(friction == 1 || friction == 0.2);
            ASSERT_EQ(friction, ground.friction(point + Eigen::Vector3d(0.3, -0.3, 0)));  // same patch
            loose += friction < 1;
        }
    }
    EXPECT_NEAR(loose / 4096.0, 0.3, 4 * std::sqrt(0.3 * 0.7 / 4096));
}

}  // namespace
}  // namespace limphome
