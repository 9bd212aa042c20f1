// Touches on uneven ground against a search that leaves nothing out.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "bullet/touch.h"
#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;
// Further inside a raised strip it is not the same side of it that is the nearest all over.
constexpr double deepest = 0.025;  // [m]
// Distances over rough ground are so to first order, and so is what is too far to be looked at.
constexpr double widest_gap = 0.015;  // [m]

using Curve = std::function<Eigen::Vector3d(double)>;

// The points of a curve that are nearer to a piece of the ground than those beside them, between 0 and 1: each where
// the derivative of the distance, with the ground's normal, changes its sign from one sample to the next.
void search(const Ground &ground, int piece, int shape, const Curve &curve, int samples, std::vector<Touch> &touches) {
    const auto slope = [&](double t) {
        constexpr double h = 1e-4;
        const Eigen::Vector3d rate = (curve(t - 2 * h) - 8 * curve(t - h) + 8 * curve(t + h) - curve(t + 2 * h)) / 12;
        return ground.clearance(curve(t), piece).normal.dot(rate);
    };
    for (int i = 1; i < samples; i++) {
        double low = (i - 1.0) / (samples - 1), high = static_cast<double>(i) / (samples - 1);
        if (slope(low) >= 0 || slope(high) < 0) {
            continue;
        }
        for (int half = 0; half < 60; half++) {
            const double middle = 0.5 * (low + high);
            (slope(middle) < 0 ? low : high) = middle;
        }
        const Clearance found = ground.clearance(curve(high), piece);
        if (found.distance < touch_reach) {
            touches.push_back(
                {shape, curve(high) - 0.5 * found.distance * found.normal, found.normal, -found.distance});
        }
    }
}

void search_rims(const Robot &robot, const Ground &ground, int piece, std::vector<Touch> &touches) {
    for (std::size_t i = 0; i < robot.rims().size(); i++) {
        const Rim &rim = robot.rims()[i];
        const int shape = static_cast<int>(i);
        const Eigen::Vector3d centre = robot.pose() * rim.centre, axis = robot.pose().linear() * rim.axis;
        const Eigen::Vector3d normal = ground.clearance(centre, piece).normal;
        const Eigen::Vector3d start = rim.radius * (axis.dot(normal) * axis - normal).normalized();
        const Curve circle = [&](double t) {
            const double angle = 1.5 * M_PI * (t - 0.5);
            return Eigen::Vector3d(centre + std::cos(angle) * start + std::sin(angle) * axis.cross(start));
        };
        search(ground, piece, shape, circle, 13, touches);
        if (rim.next_on_edge >= 0) {
            const Rim &next = robot.rims()[static_cast<std::size_t>(rim.next_on_edge)];
            const Eigen::Vector3d run = robot.pose() * next.centre - centre;
            const Eigen::Vector3d begin = centre + rim.radius * axis.cross(run).normalized();
            const Curve line = [&](double t) { return Eigen::Vector3d(begin + t * run); };
            search(ground, piece, shape, line, 7, touches);
        }
    }
}

void search_balls(const Robot &robot, const Ground &ground, int piece, std::vector<Touch> &touches) {
    for (const BodyBalls &own : robot.balls()) {
        int shape = own.first_shape;
        for (const Ball &ball : own.balls) {
            const Eigen::Vector3d centre = robot.bodies()[static_cast<std::size_t>(own.body)].point(ball.centre);
            const Clearance found = ground.clearance(centre, piece);
            const double distance = found.distance - ball.radius;
            if (distance < touch_reach) {
                const Eigen::Vector3d point = centre - (ball.radius + 0.5 * distance) * found.normal;
                touches.push_back({shape, point, found.normal, -distance});
            }
            shape++;
        }
    }
}

// Robots here and there on the ground, tilted along it or any way.
void compare(const settings &s, bool tumbled) {
    SCOPED_TRACE(s.ground.incline_along_rad + 10 * s.ground.rough_amplitude_m + 100 * s.ground.step_height_m);
    const Ground ground(s);
    Robot robot(paper_robot(), {0.7, 0.7, 0.7});
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> any(-1, 1);
    std::size_t count = 0;
    for (int trial = 0; trial < 300; trial++) {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        const Eigen::Vector3d turn(any(generator), any(generator), any(generator));
        const double tilt = tumbled ? M_PI : 0.2;
        pose.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ground.incline()) *
                        Eigen::AngleAxisd(tilt * turn.norm(), turn.normalized()) *
                        Eigen::AngleAxisd(M_PI * any(generator), Eigen::Vector3d::UnitZ()).toRotationMatrix();
        const double x = 10 * any(generator), y = 10 * any(generator);
        pose.translation() << x, y, ground.height(x, y) + (tumbled ? 0.3 : 0.02) * any(generator);
        robot.set_pose(pose);

        std::vector<Touch> searched, expected, found;
        for (int piece = 0; piece < ground.pieces(); piece++) {
            search_rims(robot, ground, piece, searched);
            search_balls(robot, ground, piece, searched);
        }
        const auto by_shape = [](const Touch &a, const Touch &b) { return a.shape < b.shape; };
        for (const Touch &touch : searched) {
            expected.insert(std::upper_bound(expected.begin(), expected.end(), touch, by_shape), touch);
        }
        ground_touches(robot, ground, found);
        for (std::vector<Touch> *touches : {&expected, &found}) {
            const auto beyond = [](const Touch &touch) { return touch.depth > deepest || touch.depth < -widest_gap; };
            touches->erase(std::remove_if(touches->begin(), touches->end(), beyond), touches->end());
        }
        ASSERT_EQ(found.size(), expected.size()) << trial;
        for (std::size_t i = 0; i < found.size(); i++) {
            EXPECT_EQ(found[i].shape, expected[i].shape);
            EXPECT_LT((found[i].point - expected[i].point).norm(), 1e-8) << trial;
            EXPECT_LT((found[i].normal - expected[i].normal).norm(), 1e-7) << trial;
            EXPECT_NEAR(found[i].depth, expected[i].depth, 1e-9) << trial;
        }
        count += found.size();
    }
    EXPECT_GT(count, 150U);
}

settings ground_of(double incline, double amplitude, double step) {
    settings s = settings_default();
    s.ground.incline_along_rad = incline;
    s.ground.incline_across_rad = 0.5 * incline;
    s.ground.rough_amplitude_m = amplitude;
    s.ground.step_height_m = step;
    return s;
}

TEST(GroundTouch, IsThatOfAnExhaustiveSearch) {
    compare(ground_of(0.2, 0, 0), false);
    compare(ground_of(0, 0.08, 0), false);
    compare(ground_of(0, 0.3, 0), false);  // bends too much for one lowest point
    compare(ground_of(0, 0, 0.1), false);
    compare(ground_of(0.2, 0.05, 0.1), false);
}

TEST(GroundTouch, IsThatOfAnExhaustiveSearchAfterATumble) {
    compare(ground_of(0.2, 0, 0), true);
    compare(ground_of(0, 0.08, 0), true);
    compare(ground_of(0.2, 0.05, 0.1), true);
}

}  // namespace
}  // namespace limphome
