#include "bullet/truth.h"

#include <gtest/gtest.h>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

TEST(Truth, ContactForcesCarryTheWeight) {
    World world(paper_robot(), left_locked());
    const double weight = 9.81 * world.robot().model().mass();
    for (int phase = 0; phase < 2; phase++) {
        const ground_truth_t t = truth(world);
        EXPECT_EQ(t.num_contacts, 8);
        double load = 0;
        for (int i = 0; i < t.num_contacts; i++) {
            load += t.contact_force[i][2];
            EXPECT_NEAR(t.contact_normal[i][2], 1, 1e-12);
            EXPECT_NEAR(t.contact_point[i][2], 0, 0.002);
        }
        EXPECT_NEAR(load, weight, 1e-4 * weight);
        run(world, {0, 0.3}, 3);  // and the same while turning
    }
}

TEST(Truth, LoadsBalanceAboutTheCentreOfMass) {
    const World world(paper_robot(), left_locked());
    const ground_truth_t t = truth(world);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (int i = 0; i < t.num_contacts; i++) {
        moment += (Eigen::Vector3d(t.contact_point[i]) - Eigen::Vector3d(t.centre_of_mass))
                      .cross(Eigen::Vector3d(t.contact_force[i]));
    }
    EXPECT_LT(moment.norm(), 0.5);  // of 9 kN
}

TEST(Truth, StandsOnTheEndsOfItsCrawlers) {
    const World world(paper_robot(), left_locked());
    const ground_truth_t t = truth(world);
    ASSERT_EQ(t.num_support, 4);
    for (int i = 0; i < 4; i++) {
        EXPECT_NEAR(std::abs(t.support[i][0]), 0.625, 1e-3);
        EXPECT_NEAR(std::abs(t.support[i][1]), 0.62, 1e-3);
    }
    // nearest edge: ahead, towards which the arm shifts the centre of mass
    const double ahead = 0.62 - t.centre_of_mass[1], height = t.centre_of_mass[2];
    EXPECT_NEAR(t.stability_margin, std::hypot(ahead, height) - height, 1e-3);
    EXPECT_GT(t.stability_margin, 0.1);
}

TEST(Truth, PressedArmCarriesWithItsTip) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0, 0.3, -0.15, 0}, 5);
    run(world, {0, 0, 0, -0.3, 0}, 2);
    run(world, {}, 1);
    const ground_truth_t t = truth(world);
    int tips = 0;
    for (int i = 0; i < t.num_contacts; i++) {
        tips += t.contact_part[i] == arm;
    }
    EXPECT_EQ(tips, 1);
    EXPECT_EQ(t.num_support, 3);
    EXPECT_GT(t.stability_margin, 0);
}

TEST(Truth, KeepsTheStampsOfTheMessage) {
    const World world(paper_robot(), left_locked());
    ground_truth_t t{};
    t.utime = 1;
    t.session = 2;
    t.seq = 3;
    world.truth(t);
    EXPECT_EQ(t.utime, 1);
    EXPECT_EQ(t.session, 2);
    EXPECT_EQ(t.seq, 3);
}

std::vector<Eigen::Vector3d> square(double half) {
    return {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
}

TEST(StabilityMargin, IsTheRiseOverTheNearestEdge) {
    EXPECT_NEAR(stability_margin(square(1), {0, 0, 0.75}), 1.25 - 0.75, 1e-12);  // 3-4-5 triangle
    EXPECT_NEAR(stability_margin(square(1), {0.25, 0, 1}), 1.25 - 1, 1e-12);     // the nearer edge
}

TEST(StabilityMargin, IsNegativeOutside) {
    EXPECT_NEAR(stability_margin(square(1), {1.75, 0, 1}), -(1.25 - 1), 1e-12);
    EXPECT_LE(stability_margin({{-1, 0, 0}, {1, 0, 0}}, {0, 0.75, 1}), -0.25 + 1e-12);
    EXPECT_LE(stability_margin({{0, 0, 0}}, {0, 0.75, 1}), 0);
    EXPECT_LE(stability_margin({}, {0, 0.75, 1}), 0);
}

// An edge that climbs by the angle a lowers the top of the circle about it: R cos(a) - (height of the centre over the
// edge, cos(a) times its distance in the vertical plane of the edge).
TEST(StabilityMargin, OfAnInclinedEdge) {
    const double a = 0.3;
    const Eigen::AngleAxisd tilt(a, Eigen::Vector3d::UnitX());
    std::vector<Eigen::Vector3d> polygon = square(1);
    for (Eigen::Vector3d &p : polygon) {
        p = tilt * p;
    }
    // in the tilted frame: distance 0.5 from the edge x = 1 and height 1 over it
    const double expected = std::hypot(0.5, 1) * std::cos(a) - 1 * std::cos(a);
    EXPECT_NEAR(stability_margin(polygon, tilt * Eigen::Vector3d(0.5, 0, 1)), expected, 1e-12);
}

TEST(SupportPolygon, IsTheHullCounterClockwise) {
    std::vector<Eigen::Vector3d> points = square(1);
    points.push_back({0, 0, 0});
    points.push_back({0.5, 1, 0});  // on an edge
    points.push_back({1, 1, 0});    // twice
    std::swap(points[0], points[2]);
    const std::vector<Eigen::Vector3d> hull = support_polygon(points);
    ASSERT_EQ(hull.size(), 4u);
    double area = 0;
    for (std::size_t i = 0; i < 4; i++) {
        const Eigen::Vector3d &a = hull[i], &b = hull[(i + 1) % 4];
        area += 0.5 * (a.x() * b.y() - b.x() * a.y());
    }
    EXPECT_NEAR(area, 4, 1e-12);
}

}  // namespace
}  // namespace limphome
