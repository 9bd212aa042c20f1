#include "model/robot_model.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "laboratory.h"

namespace limphome {
namespace {

TEST(RobotModel, IsThePapersRobot) {
    const RobotModel model = laboratory::paper_robot();
    ASSERT_EQ(model.actuators.size(), 5u);
    ASSERT_EQ(model.bodies.size(), 6u);
    EXPECT_EQ(model.name, "crawler");
    EXPECT_EQ(model.actuators[3].name, "boom");
    EXPECT_EQ(model.actuators[0].upper, std::numeric_limits<double>::infinity());
    EXPECT_EQ(model.actuators[3].lower, -0.6);
    EXPECT_EQ(model.actuators[4].home, -1.5);
    EXPECT_EQ(model.actuators[2].effort, 3000);
    EXPECT_EQ(model.actuators[1].speed, 5);
    EXPECT_EQ(model.bodies[5].parent, 4);
    EXPECT_EQ(model.bodies[5].joint.translation(), Eigen::Vector3d(1.1, 0, 0));
    EXPECT_EQ(model.bodies[5].axis, Eigen::Vector3d(0, -1, 0));
    EXPECT_NEAR(model.bodies[5].centre.x(), 0.4, 1e-15);
    EXPECT_NEAR(model.mass(), 498 + 1 + 1 + 350 + 60 + 35, 1e-9);
    EXPECT_EQ(model.crawlers[1].width, 0.30);
}

TEST(RobotModel, HasItsShapes) {
    const RobotModel model = laboratory::paper_robot();
    ASSERT_EQ(model.bodies[3].shapes.size(), 1u);
    EXPECT_EQ(model.bodies[3].shapes[0].kind, ROBOT_BOX);
    EXPECT_EQ(model.bodies[3].shapes[0].half_size, Eigen::Vector3d(0.5, 0.4, 0.43));
    EXPECT_EQ(model.bodies[3].shapes[0].pose.translation(), Eigen::Vector3d(-0.1, 0, 0.43));
    ASSERT_EQ(model.bodies[5].shapes.size(), 2u);  // the tip first
    EXPECT_EQ(model.bodies[5].shapes[0].half_size.x(), 0.08);
    EXPECT_TRUE(model.may_meet[0][5]);
    EXPECT_FALSE(model.may_meet[4][5]);
}

TEST(RobotModel, TurnedFramesAreTurned) {
    robot_description robot = {};
    robot.num_bodies = 1;
    robot.bodies[0].joint = {{1, 2, 3}, {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}};
    const double inertia[3][3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    std::copy(&inertia[0][0], &inertia[0][0] + 9, &robot.bodies[0].inertia[0][0]);
    const RobotModel model = make_model(robot);
    EXPECT_LT((model.bodies[0].joint * Eigen::Vector3d::UnitX() - Eigen::Vector3d(1, 3, 3)).norm(), 1e-15);
    EXPECT_EQ(model.bodies[0].inertia(0, 2), 3);
    EXPECT_EQ(model.bodies[0].inertia(2, 0), 7);
}

// All of it is as it should be, but nothing can be computed with it.
TEST(RobotModel, RobotThatCannotBeSimulatedIsRefusedByTheWorld) {
    RobotModel model = laboratory::paper_robot();
    model.bodies[3].mass = 1e200;
    try {
        const World world(model, laboratory::left_locked());
        FAIL() << "was accepted";
    } catch (const std::runtime_error &error) {
        EXPECT_NE(std::string(error.what()).find("robot crawler"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace limphome
