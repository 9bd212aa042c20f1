// The robot with two arms: the same code, another URDF.
#include <gtest/gtest.h>

#include <string>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

enum { left_boom = 3, left_arm, right_boom, right_arm };

RobotModel two_arm_robot() {
    return read_robot(CONFIG_DIR "/two_arm.urdf");
}

TEST(TwoArm, HasSevenActuatorsAndTwoTips) {
    const RobotModel model = two_arm_robot();
    ASSERT_EQ(model.actuators.size(), 7u);
    EXPECT_EQ(model.actuators[right_arm].name, "right_arm");
    EXPECT_EQ(model.bodies[1 + right_boom].parent, 1 + swing);
    EXPECT_EQ(model.bodies[1 + left_arm].shapes.size(), 2u);
    EXPECT_EQ(model.bodies[1 + right_arm].shapes.size(), 2u);
    EXPECT_NEAR(model.mass(), 498 + 2 + 350 + 2 * (45 + 25), 1e-9);
}

TEST(TwoArm, RestsAndDrivesStraight) {
    World world(two_arm_robot(), sound());
    run(world, {}, 5);
    EXPECT_LT(position(world).head<2>().norm(), 1e-4);
    run(world, {0.3, 0.3}, 5);
    EXPECT_NEAR(position(world).y(), 1.5, 0.03);
    EXPECT_NEAR(position(world).x(), 0, 1e-3);
}

// Both tips bear load: the front of the robot rises, and by the symmetry of the robot neither side does.
TEST(TwoArm, BothArmsPressedDownLiftTheFront) {
    World world(two_arm_robot(), sound());
    run(world, {0, 0, 0, -0.3, 0, -0.3, 0}, 3.5);
    run(world, {}, 1);
    double load[2] = {0, 0};
    const ground_truth_t t = truth(world);
    for (int i = 0; i < t.num_contacts; i++) {
        load[0] += t.contact_part[i] == left_arm ? t.contact_force[i][2] : 0;
        load[1] += t.contact_part[i] == right_arm ? t.contact_force[i][2] : 0;
    }
    EXPECT_GT(load[0], 500);
    EXPECT_NEAR(load[0], load[1], 0.05 * load[0]);
    EXPECT_GT(world.robot().pose().linear()(2, 0), 0.05);
    EXPECT_NEAR(roll(world), 0, 0.005);
}

TEST(TwoArm, OneArmPressedDownLiftsItsSide) {
    settings s = left_locked();
    World world(two_arm_robot(), s);
    run(world, {0, 0, 0.3}, 5);
    run(world, {0, 0, 0, -0.3}, 4);
    EXPECT_GT(roll(world), 0.05);
    EXPECT_FALSE(world.diverged());
}

TEST(TwoArm, LastJointMayFail) {
    World world(two_arm_robot(), with_failure(SETTINGS_FAILED_JOINT + 4, SETTINGS_LOCKED));
    run(world, {0, 0, 0, 0, -0.3, 0, -0.3}, 1);
    EXPECT_NEAR(state(world).actuator_position[left_arm], -1.8, 0.02);
    EXPECT_NEAR(state(world).actuator_position[right_arm], -1.5, 1e-9);
    EXPECT_EQ(world.health(right_arm), Health::failed);
}

}  // namespace
}  // namespace limphome
