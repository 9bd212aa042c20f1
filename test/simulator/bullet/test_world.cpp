#include "bullet/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "bullet/trajectory.h"
#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

TEST(World, StartsAtTheOriginFacingY) {
    const World world(paper_robot(), left_locked());
    EXPECT_EQ(world.time(), 0);
    EXPECT_NEAR(position(world).x(), 0, 1e-12);
    EXPECT_NEAR(position(world).y(), 0, 1e-12);
    EXPECT_NEAR(position(world).z(), 0, 0.002);  // sunk into the ground by the static deflection
    EXPECT_NEAR(heading(world), M_PI / 2, 1e-9);
    const robot_state_t s = state(world);
    ASSERT_EQ(s.num_actuators, 5);
    EXPECT_DOUBLE_EQ(s.actuator_position[boom], 0.6);
    EXPECT_DOUBLE_EQ(s.actuator_position[arm], -1.5);
    EXPECT_NEAR(s.actuator_position[left], 0, 1e-12);
}

TEST(World, DoesNotJumpAtTheStart) {
    World world(paper_robot(), left_locked());
    const Eigen::Vector3d start = position(world);
    for (int i = 0; i < 100; i++) {
        world.step();
        EXPECT_LT((position(world) - start).norm(), 1e-6);
        EXPECT_LT(std::abs(state(world).actuator_velocity[boom]), 1e-6);
    }
}

TEST(World, RestsWithoutDriftForAMinute) {
    World world(paper_robot(), left_locked());
    const Eigen::Isometry3d start = world.robot().pose();
    run(world, {}, 60);
    EXPECT_LT((world.robot().pose().translation() - start.translation()).norm(), 1e-5);
    EXPECT_NEAR(heading(world), M_PI / 2, 1e-5);
    EXPECT_NEAR(state(world).actuator_position[boom], 0.6, 1e-6);
    EXPECT_NEAR(state(world).actuator_position[arm], -1.5, 1e-6);
    EXPECT_NEAR(world.time(), 60, 1e-9);
}

TEST(World, FallsAtG) {
    World world(paper_robot(), left_locked());
    Eigen::Isometry3d pose = world.robot().pose();
    pose.translation().z() += 3;
    world.robot().set_pose(pose);
    const double height = world.robot().centre_of_mass().z();
    const double fall = 0.7;
    run(world, {}, fall);
    EXPECT_NEAR(world.robot().centre_of_mass_velocity().z(), -9.81 * fall, 1e-9);
    // velocities are exact, and the robot moves at those of the end of each step
    EXPECT_NEAR(height - world.robot().centre_of_mass().z(), 0.5 * 9.81 * fall * (fall + world.time_step()), 1e-9);
    EXPECT_EQ(truth(world).num_contacts, 0);
    run(world, {}, 3);  // and lands, to stand again
    EXPECT_NEAR(position(world).z(), pose.translation().z() - 3, 1e-4);
    EXPECT_LT(world.robot().centre_of_mass_velocity().norm(), 1e-4);
}

TEST(World, BothCrawlersDriveStraightAtTheWantedSpeed) {
    World world(paper_robot(), sound());
    run(world, {0.3, 0.3}, 10);
    // a few hundredths of a second are lost in getting up to speed
    EXPECT_NEAR(position(world).y(), 3.0, 0.03);
    EXPECT_NEAR(position(world).x(), 0, 1e-3);
    EXPECT_NEAR(heading(world), M_PI / 2, 1e-3);
    EXPECT_NEAR(state(world).actuator_position[left], position(world).y(), 0.005);  // hardly any slip
    run(world, {-0.3, -0.3}, 10);
    EXPECT_NEAR(position(world).y(), 0, 0.03);
}

// About a point on the midline, a little ahead of the middle as the arm shifts the load.
TEST(World, CounterRotationTurnsOnTheSpot) {
    double turned[2];
    for (int i = 0; i < 2; i++) {
        const double speed = i == 0 ? 0.3 : -0.3;
        World world(paper_robot(), sound());
        double travelled = 0;
        for (int step = 0; step < 300; step++) {
            const Eigen::Vector3d before = position(world);
            run(world, {-speed, speed}, 0.02);
            travelled += world.robot().pose().linear().col(0).dot(position(world) - before);
        }
        turned[i] = heading(world) - M_PI / 2;
        EXPECT_NEAR(travelled, 0, 0.005);
        EXPECT_LT(position(world).head<2>().norm(), 0.2);
    }
    EXPECT_GT(turned[0], 1);  // to the left
    EXPECT_NEAR(turned[1], -turned[0], 0.001);
}

TEST(World, ArmPressedDownLiftsTheSide) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0, 0.3, 0, 0}, 5);
    EXPECT_NEAR(roll(world), 0, 0.002);
    run(world, {0, 0, 0, -0.3, 0}, 4);
    run(world, {}, 1);
    EXPECT_GT(roll(world), 0.1);
    const ground_truth_t t = truth(world);
    double left_load = 0, tip_load = 0;
    for (int i = 0; i < t.num_contacts; i++) {
        left_load += t.contact_part[i] == left ? t.contact_force[i][2] : 0;
        tip_load += t.contact_part[i] == arm ? t.contact_force[i][2] : 0;
    }
    EXPECT_EQ(left_load, 0);
    EXPECT_GT(tip_load, 1000);
    run(world, {}, 10);  // and holds
    EXPECT_GT(roll(world), 0.1);
}

TEST(World, IsTheSameInTwoWorlds) {
    World one(paper_robot(), left_locked());
    const auto spacing = std::make_unique<std::array<char, 12345>>();  // other addresses for the second
    World two(paper_robot(), left_locked());
    EXPECT_EQ(trajectory(one), trajectory(two));
}

TEST(World, ResetForgetsAllHistory) {
    World fresh(paper_robot(), left_locked());
    World used(paper_robot(), left_locked());
    const std::string expected = trajectory(fresh);
    trajectory(used);
    used.set_gravity(downhill(10 * degree));
    run(used, {0, -0.3, -0.3, 0.3, 0.3}, 7.3);
    used.reset(0);
    EXPECT_EQ(used.time(), 0);
    EXPECT_EQ(trajectory(used), expected);
    fresh.reset(0);
    EXPECT_EQ(trajectory(fresh), expected);
}

std::string output_of(const char *command) {
    std::string text;
    FILE *pipe = popen(command, "r");
    char buffer[4096];
    while (pipe != nullptr && std::fgets(buffer, sizeof buffer, pipe) != nullptr) {
        text += buffer;
    }
    EXPECT_EQ(pclose(pipe), 0);
    return text;
}

TEST(World, IsTheSameInAnotherProcess) {
    World world(paper_robot(), left_locked());
    const std::string here = trajectory(world);
    EXPECT_EQ(output_of(TRAJECTORY_PROGRAM), here);
    EXPECT_EQ(output_of("PADDING=xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx " TRAJECTORY_PROGRAM), here);
}

// Whoever holds the world up between its time steps, and looks at it there, changes nothing that its sensors tell.
TEST(World, IsTheSameLookedAt) {
    settings noisy = left_locked();
    noisy.sensors.joint.noise = 0.01;
    World alone(paper_robot(), noisy), watched(paper_robot(), noisy);
    const double command[max_actuators] = {0, 0.3, 0.2, -0.2, 0.3};
    int looks = 0;
    const auto look = [&](double seconds) {
        robot_state_t exact{};
        ground_truth_t truth{};
        EXPECT_EQ(seconds, watched.time_step());
        EXPECT_TRUE(watched.exact(exact) && watched.truth(truth));
        EXPECT_EQ(exact.utime, std::llround(watched.time() * 1e6));
        EXPECT_EQ(exact.actuator_position[boom], state(watched).actuator_position[boom]);
        looks++;
        return true;
    };
    for (int decision = 0; decision < 4; decision++) {
        alone.command(command);
        alone.advance(decision_period);
        watched.command(command);
        watched.advance_asking(decision_period, look);
        robot_state_t read{}, read_watched{};
        alone.sense(read);
        watched.sense(read_watched);
        EXPECT_EQ(read.utime, read_watched.utime);
        for (int a = 0; a < read.num_actuators; a++) {
            EXPECT_EQ(read.actuator_position[a], read_watched.actuator_position[a]) << a;
            EXPECT_EQ(read.actuator_effort[a], read_watched.actuator_effort[a]) << a;
        }
        EXPECT_NE(read.actuator_position[boom], state(alone).actuator_position[boom]);
    }
    EXPECT_EQ(looks, 4 * std::lround(decision_period / watched.time_step()));
}

TEST(World, StopsWhereItIsToldTo) {
    World world(paper_robot(), left_locked());
    int steps = 0;
    world.advance_asking(decision_period, [&steps](double) { return steps++ < 7; });
    EXPECT_NEAR(world.time(), 7 * world.time_step(), 1e-12);
    EXPECT_EQ(steps, 8);
}

// A world that diverges stops at once, and a reset makes it sound again.
TEST(World, TellsWhenItDiverges) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    World world(paper_robot(), left_locked());
    const auto expect_divergence = [&world] {
        EXPECT_FALSE(world.diverged());
        world.advance(decision_period);
        EXPECT_TRUE(world.diverged());
        EXPECT_LT(world.time(), 0.5);
        world.reset(0);
    };
    world.robot().multibody().setJointVel(boom, nan);
    expect_divergence();
    world.robot().multibody().setJointPos(swing, nan);
    expect_divergence();
    world.robot().multibody().setBaseVel(btVector3(0, 0, 1e12));
    expect_divergence();
    world.set_gravity({0, 0, -1e300});
    expect_divergence();
    World fresh(paper_robot(), left_locked());
    EXPECT_EQ(trajectory(world), trajectory(fresh));
}

// Forces of the middle of a step make even twice the default step good for a millimetre.
TEST(World, HalvingTheTimeStepChangesLittle) {
    Eigen::Vector3d end[2];
    double heading_at_end[2];
    for (int i = 0; i < 2; i++) {
        settings s = left_locked();
        s.simulator.time_step_s = i == 0 ? 0.01 : 0.005;
        World world(paper_robot(), s);
        run(world, {0, 0, 0.3, -0.15, 0}, 5);
        run(world, {0, 0, 0, -0.3, 0}, 2);
        run(world, {0, 0.3, -0.3, 0, 0}, 4);
        end[i] = position(world);
        heading_at_end[i] = heading(world);
    }
    EXPECT_GT((end[0]).norm(), 0.4);
    EXPECT_LT((end[0] - end[1]).norm(), 0.001);
    EXPECT_NEAR(heading_at_end[0], heading_at_end[1], 0.001);
}

}  // namespace
}  // namespace limphome
