#include "model/drive.h"

#include <gtest/gtest.h>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

class Step : public testing::TestWithParam<int> {};

TEST_P(Step, IsFollowedWithinATenthOfASecond) {
    World world(paper_robot(), sound());
    Rates rates{};
    const double wanted = GetParam() == arm ? -0.3 : 0.3;  // away from the stop
    rates[static_cast<std::size_t>(GetParam())] = wanted;
    run(world, rates, 0.1);
    EXPECT_NEAR(state(world).actuator_velocity[GetParam()] / wanted, 1, 0.03);
    run(world, rates, 1);
    EXPECT_NEAR(state(world).actuator_velocity[GetParam()] / wanted, 1, 0.01);
    run(world, {}, 0.1);
    EXPECT_NEAR(state(world).actuator_velocity[GetParam()], 0, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Actuator, Step, testing::Values(left, right, swing, boom, arm));

TEST(Drive, IsIndependentOfTheTimeStep) {
    double travel[2];
    for (int i = 0; i < 2; i++) {
        settings s = left_locked();
        s.simulator.time_step_s = i == 0 ? 0.005 : 0.001;
        World world(paper_robot(), s);
        run(world, {0, 0, 0.3}, 0.5);
        travel[i] = state(world).actuator_position[swing];
    }
    EXPECT_NEAR(travel[0], travel[1], 0.001);
}

TEST(Drive, ArmHoldsAgainstGravity) {
    World world(paper_robot(), left_locked());
    run(world, {}, 10);
    const robot_state_t s = state(world);
    EXPECT_NEAR(s.actuator_position[boom], 0.6, 1e-6);
    EXPECT_NEAR(s.actuator_position[arm], -1.5, 1e-6);
    // moments of boom (60 kg at 0.55 m) and arm (35 kg at 0.4 m beyond 1.1 m) about the boom's joint
    const double moment = 9.81 * (60 * 0.55 * std::cos(0.6) + 35 * (1.1 * std::cos(0.6) + 0.4 * std::cos(-0.9)));
    EXPECT_NEAR(s.actuator_effort[boom], moment, 0.5);
    EXPECT_NEAR(s.actuator_effort[arm], 9.81 * 35 * 0.4 * std::cos(-0.9), 0.5);
}

TEST(Drive, StallsAtItsTorqueLimitAndNotAbove) {
    RobotModel model = paper_robot();
    model.actuators[right].effort = 300;  // dragging the locked side takes more than 400
    World world(model, left_locked());
    const int64_t before = world.saturated();
    world.command(Rates{0, 0.3}.data());
    for (int i = 0; i < 600; i++) {
        world.step();
        EXPECT_LE(std::abs(state(world).actuator_effort[right]), 300 + 1e-9);
    }
    EXPECT_NEAR(state(world).actuator_effort[right], 300, 1e-9);
    EXPECT_NEAR(state(world).actuator_velocity[right], 0, 1e-3);
    EXPECT_NEAR(heading(world), M_PI / 2, 0.01);
    EXPECT_GE(world.saturated() - before, 550);
    run(world, {}, 0.3);  // what was not reached has not piled up
    EXPECT_NEAR(state(world).actuator_velocity[right], 0, 1e-3);
    EXPECT_LT(std::abs(state(world).actuator_effort[right]), 300);
}

TEST(Drive, OverloadedArmSinksAtItsTorqueLimit) {
    RobotModel model = paper_robot();
    World world(model, left_locked());
    model.actuators[boom].effort = 400;  // of 664 that holding takes
    World weak(model, left_locked());
    run(weak, {}, 0.3);
    EXPECT_LT(state(weak).actuator_position[boom], 0.55);
    EXPECT_NEAR(state(weak).actuator_effort[boom], 400, 1e-9);
}

class Stop : public testing::TestWithParam<int> {};

TEST_P(Stop, HoldsUnderFullCommandAndLetsGoAtOnce) {
    RobotModel model = paper_robot();
    const auto joint = static_cast<std::size_t>(GetParam());
    const double far = joint == arm ? 0.0 : joint == boom ? 1.2 : 2.6;
    World world(model, left_locked());
    Rates rates{};
    rates[joint] = 0.9;
    world.command(rates.data());
    for (int i = 0; i < 1000; i++) {
        world.step();
        ASSERT_LE(state(world).actuator_position[joint], far + 1e-9);
    }
    EXPECT_NEAR(state(world).actuator_position[joint], far, 1e-9);
    EXPECT_NEAR(state(world).actuator_velocity[joint], 0, 1e-9);
    rates[joint] = -0.3;
    run(world, rates, 0.5);
    EXPECT_NEAR(state(world).actuator_position[joint], far - 0.15, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Joint, Stop, testing::Values(swing, boom, arm));

TEST(Drive, StopHoldsALoadThatTheDriveCannot) {
    RobotModel model = paper_robot();
    model.actuators[boom].effort = 10;
    World world(model, left_locked());
    for (int i = 0; i < 1000; i++) {
        world.step();
        ASSERT_GE(state(world).actuator_position[boom], -0.6 - 1e-6);
    }
    EXPECT_LE(std::abs(state(world).actuator_effort[boom]), 10 + 1e-9);
}

TEST(Drive, FailedCrawlersDoNotObey) {
    World locked(paper_robot(), left_locked());
    run(locked, {0.3, 0}, 2);
    EXPECT_NEAR(position(locked).norm(), 0, 0.002);
    World free(paper_robot(), left_free());
    run(free, {0.3, 0}, 2);
    EXPECT_NEAR(state(free).actuator_position[left], 0, 1e-3);
}

TEST(Drive, WeakCrawlerHasItsShareOfTorque) {
    World world(paper_robot(), with_failure(SETTINGS_FAILED_LEFT, SETTINGS_WEAK));
    world.command(Rates{-0.3, 0.3}.data());  // turning takes more than the weak one has
    for (int i = 0; i < 400; i++) {
        world.step();
        EXPECT_LE(std::abs(state(world).actuator_effort[left]), 300 + 1e-9);
    }
    EXPECT_NEAR(state(world).actuator_effort[left], -300, 1e-6);
    EXPECT_EQ(world.health(left), Health::weak);
    EXPECT_EQ(world.health(right), Health::obeys);
}

TEST(Drive, EffortIsTheMeanOfTwentyMilliseconds) {
    const Actuator actuator{"a", -1, 1, 100, 10, 0};
    Drive drive(actuator, {60, 100, 0}, 0.005);
    for (const double torque : {1000.0, 10.0, 20.0, 30.0, 40.0}) {
        JointConstraint constraint = drive.begin_step(0, 0);
        constraint.impulse = torque * 0.005;
        drive.end_step(constraint, 0);
    }
    EXPECT_NEAR(drive.effort(), 25, 1e-9);
}

TEST(Drive, SpeedIsLimitedToThatOfTheJoint) {
    World world(paper_robot(), sound());
    run(world, {0, 0, 50}, 1);  // swing: 1 rad/s
    EXPECT_NEAR(state(world).actuator_velocity[swing], 1, 0.03);
}

}  // namespace
}  // namespace limphome
