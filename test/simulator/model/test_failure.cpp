#include "model/failure.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

constexpr int64_t joint(int number) {  // as in the settings, from 1
    return SETTINGS_FAILED_JOINT + number - 1;
}

TEST(Failure, StuckJointHoldsAgainstCommandAndLoad) {
    World world(paper_robot(), with_failure(joint(2), SETTINGS_LOCKED));
    run(world, {0, 0, 0, -0.3, 0}, 3);
    EXPECT_NEAR(state(world).actuator_position[boom], 0.6, 1e-9);
    EXPECT_EQ(world.health(boom), Health::failed);
    EXPECT_EQ(world.health(arm), Health::obeys);
    EXPECT_NEAR(state(world).actuator_effort[boom], 664, 5);  // as much as holding takes
}

TEST(Failure, WeakJointSinks) {
    settings s = with_failure(joint(2), SETTINGS_WEAK);
    s.failure.weak_factor = 0.05;  // 300 N m of the 664 that holding takes
    World world(paper_robot(), s);
    run(world, {}, 0.3);
    EXPECT_LT(state(world).actuator_position[boom], 0.55);
    EXPECT_NEAR(state(world).actuator_effort[boom], 300, 1e-9);
    EXPECT_EQ(world.health(boom), Health::weak);
}

TEST(Failure, SlippingCrawlerRunsButDoesNotPull) {
    settings s = with_failure(SETTINGS_FAILED_RIGHT, SETTINGS_SLIPPING);
    s.failure.slip_factor = 0;
    World world(paper_robot(), s);
    run(world, {0, 0.3}, 5);
    EXPECT_NEAR(state(world).actuator_position[right], 1.5, 0.02);
    EXPECT_LT(position(world).head<2>().norm(), 1e-3);
    EXPECT_EQ(world.health(right), Health::failed);
}

// What is left of its friction is what it pulls with.
TEST(Failure, SlippingCrawlersPullWithTheFrictionLeft) {
    settings s = with_failure(SETTINGS_FAILED_LEFT, SETTINGS_SLIPPING);
    s.second_failure = s.failure;
    s.second_failure.actuator = SETTINGS_FAILED_RIGHT;
    s.failure.slip_factor = s.second_failure.slip_factor = 0.1;
    World world(paper_robot(), s);
    run(world, {0.9, 0.9}, 0.1);
    const double speed = world.robot().centre_of_mass_velocity().y();
    run(world, {0.9, 0.9}, 0.4);
    EXPECT_NEAR(world.robot().centre_of_mass_velocity().y() - speed, 0.07 * 9.81 * 0.4, 0.002);
}

TEST(Failure, BothCrawlersMayFailAtOnce) {
    settings s = left_locked();
    s.second_failure.actuator = SETTINGS_FAILED_RIGHT;
    s.second_failure.mode = SETTINGS_LOCKED;
    World world(paper_robot(), s);
    run(world, {0.3, 0.3}, 5);
    EXPECT_LT(position(world).head<2>().norm(), 1e-3);
    EXPECT_EQ(world.health(left), Health::failed);
    EXPECT_EQ(world.health(right), Health::failed);
}

TEST(Failure, ComesAtItsTime) {
    settings s = left_locked();
    s.failure.at_s = 2;
    World world(paper_robot(), s);
    run(world, {0.3, 0.3}, 2);
    const double travelled = state(world).actuator_position[left];
    EXPECT_NEAR(travelled, 0.6, 0.02);
    EXPECT_EQ(world.health(left), Health::obeys);
    world.step();
    EXPECT_EQ(world.health(left), Health::failed);
    EXPECT_NEAR(state(world).actuator_velocity[left], 0, 1e-9);
    run(world, {0.3, 0.3}, 2);
    EXPECT_NEAR(state(world).actuator_position[left], travelled, 1e-9);
    EXPECT_LT(heading(world), M_PI / 2 + 1);
    EXPECT_GT(heading(world), M_PI / 2 + 0.05);  // now the right one turns it
    world.reset(0);
    EXPECT_EQ(world.health(left), Health::obeys);
}

TEST(Failure, ComesWithItsEpisode) {
    settings s = left_locked();
    s.failure.at_episode = 60;
    World world(paper_robot(), s);
    world.reset(59);
    run(world, {0.3, 0.3}, 1);
    EXPECT_EQ(world.health(left), Health::obeys);
    world.reset(60);
    EXPECT_EQ(world.health(left), Health::obeys);  // so the controller, begun here, counts on it as it did before
    run(world, {}, 0.01);
    EXPECT_EQ(world.health(left), Health::failed);
    world.reset(61);
    run(world, {}, 0.01);
    EXPECT_EQ(world.health(left), Health::failed);
}

TEST(Failure, OfAJointThatTheRobotLacksIsRefused) {
    EXPECT_NO_THROW(World(paper_robot(), with_failure(joint(3), SETTINGS_LOCKED)));
    EXPECT_THROW(World(paper_robot(), with_failure(joint(4), SETTINGS_LOCKED)), std::runtime_error);
}

TEST(Failure, RefusalNamesTheKey) {
    settings s = left_locked();
    s.second_failure.actuator = joint(4);
    try {
        planned_failures(s, paper_robot());
        FAIL() << "was accepted";
    } catch (const std::runtime_error &error) {
        EXPECT_NE(std::string(error.what()).find("[second_failure] actuator = joint_"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace limphome
