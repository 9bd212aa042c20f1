#include "bullet/grip.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

// A point at (x, y, z) of a body of unit mass and inertia about the origin.
Grip grip_at(double x, double y, double z, double limit) {
    Grip grip{0, Eigen::Matrix<double, max_dofs, 2>::Zero(), limit, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    const Eigen::Vector3d point(x, y, z);
    for (int axis = 0; axis < 2; axis++) {
        grip.response.col(axis).head<3>() = point.cross(Eigen::Vector3d::Unit(axis));
        grip.response.col(axis)[3 + axis] = 1;
    }
    return grip;
}

// Four corners on level ground, the front ones with twice the load.
std::vector<Grip> four_corners() {
    return {grip_at(1, 1, -1, 2), grip_at(1, -1, -1, 2), grip_at(-1, 1, -1, 1), grip_at(-1, -1, -1, 1)};
}

GeneralVector effect(const std::vector<Grip> &grips) {
    GeneralVector sum = GeneralVector::Zero();
    for (const Grip &grip : grips) {
        sum += grip.response * grip.impulse;
    }
    return sum;
}

double cost(const std::vector<Grip> &grips) {
    double sum = 0;
    for (const Grip &grip : grips) {
        sum += grip.impulse.squaredNorm() / grip.limit;
    }
    return sum;
}

TEST(Grip, BeltsThatPullAgainstEachOtherLetGo) {
    std::vector<Grip> grips = four_corners();
    for (Grip &grip : grips) {
        grip.impulse = Eigen::Vector2d(grip.response(2, 0) > 0 ? 0.5 : -0.5, 0);  // right side forward, left side back
    }
    const double yaw = effect(grips)[2];
    grips[0].impulse.y() -= yaw / 4;  // what keeps it from turning
    grips[1].impulse.y() -= yaw / 4;
    grips[2].impulse.y() += yaw / 4;
    grips[3].impulse.y() += yaw / 4;
    ASSERT_LT(effect(grips).norm(), 1e-12);
    share_grip<base_dofs>(grips);
    for (const Grip &grip : grips) {
        EXPECT_LT(grip.impulse.norm(), 1e-12);
    }
}

TEST(Grip, SharesByLoad) {
    std::vector<Grip> grips = four_corners();
    grips[0].impulse.x() = grips[1].impulse.x() = 1.5;
    share_grip<base_dofs>(grips);
    for (const Grip &grip : grips) {
        EXPECT_NEAR(grip.impulse.x(), 3.0 * grip.limit / 6, 1e-9);
        EXPECT_NEAR(grip.impulse.y(), 0, 1e-9);
    }
}

TEST(Grip, KeepsTheEffectAndCostsLeast) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 100; trial++) {
        std::vector<Grip> grips;
        for (int i = 0; i < 8; i++) {
            grips.push_back(grip_at(any(generator), any(generator), any(generator), 2));
            grips.back().impulse = Eigen::Vector2d(any(generator), any(generator));
        }
        const GeneralVector before = effect(grips);
        share_grip<base_dofs>(grips);
        EXPECT_LT((effect(grips) - before).norm(), 1e-5);

        Eigen::Matrix<double, base_dofs, 16> responses;
        for (std::size_t i = 0; i < grips.size(); i++) {
            responses.middleCols<2>(2 * static_cast<Eigen::Index>(i)) = grips[i].response.topRows<base_dofs>();
        }
        const Eigen::MatrixXd without_effect = Eigen::FullPivLU<Eigen::MatrixXd>(responses).kernel();
        for (Eigen::Index k = 0; k < without_effect.cols(); k++) {
            for (const double size : {0.1, -0.1}) {
                std::vector<Grip> other = grips;
                for (std::size_t i = 0; i < grips.size(); i++) {
                    other[i].impulse +=
                        size * without_effect.col(k).normalized().segment<2>(2 * static_cast<Eigen::Index>(i));
                }
                EXPECT_GT(cost(other), cost(grips));
            }
        }
    }
}

// Far out the weak point is well placed to keep the body from turning, and takes what it can.
TEST(Grip, NoneGoesBeyondItsLimit) {
    std::vector<Grip> grips = {grip_at(0, 0.1, -1, 10), grip_at(0, -0.1, -1, 10), grip_at(0, 5, -1, 0.1)};
    grips[0].impulse = Eigen::Vector2d(9.9, 0);
    grips[1].impulse = Eigen::Vector2d(-9.9, 0);
    const GeneralVector before = effect(grips);
    share_grip<base_dofs>(grips);
    EXPECT_LT((effect(grips) - before).norm(), 1e-4);
    for (const Grip &grip : grips) {
        const bool weak = grip.limit < 1;
        EXPECT_NEAR(grip.impulse.norm(), weak ? 0.1 : 7.4, weak ? 1e-12 : 0.051);
    }
}

TEST(Grip, OfWhatCannotMoveIsNone) {
    Grip grip = grip_at(0, 0, 0, 1);
    grip.response.setZero();
    grip.impulse = Eigen::Vector2d(0.5, -0.5);
    std::vector<Grip> grips{grip, grip};
    share_grip<max_dofs>(grips);
    EXPECT_EQ(grips[0].impulse.norm(), 0);
    EXPECT_EQ(grips[1].impulse.norm(), 0);
    std::vector<Grip> none;
    share_grip<max_dofs>(none);
}

// In the world: torques of drives whose belts do not slip.
TEST(Grip, DrivesBearNothingWhereNothingResists) {
    World world(paper_robot(), sound());
    for (const double speed : {0.3, -0.3, 0.0}) {
        run(world, {speed, speed}, 5);
        EXPECT_NEAR(state(world).actuator_effort[left], 0, 0.01);
        EXPECT_NEAR(state(world).actuator_effort[right], 0, 0.01);
    }
    run(world, {-0.3, 0.3}, 2);
    run(world, {}, 6);  // until its integral part has let go of the belts
    EXPECT_NEAR(state(world).actuator_effort[left], 0, 0.01);
    EXPECT_NEAR(state(world).actuator_effort[right], 0, 0.01);
}

TEST(Grip, DrivesShareASlope) {
    for (const settings &s : {sound(), left_locked()}) {
        World world(paper_robot(), s);
        world.set_gravity(downhill(-15 * degree));
        run(world, {}, 5);
        const double half = 0.5 * paper_robot().mass() * 9.81 * std::sin(15 * degree) * 0.18;
        EXPECT_NEAR(state(world).actuator_effort[left], half, 1e-3 * half);
        EXPECT_NEAR(state(world).actuator_effort[right], half, 1e-3 * half);
    }
}

}  // namespace
}  // namespace limphome
