#include "bullet/robot.h"

#include <gtest/gtest.h>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

// The masses of config/crawler.urdf once more, by hand: each link's mass with its centre in the frame of its joint.
Eigen::Vector4d moment(double mass, const Eigen::Isometry3d &frame, const Eigen::Vector3d &centre) {
    Eigen::Vector4d m;
    m << mass * (frame * centre), mass;
    return m;
}

// Sum of mass times centre, and of masses.
Eigen::Vector4d moments_by_hand(const Eigen::Isometry3d &base, double swing_angle, double boom_angle,
                                double arm_angle) {
    using Eigen::AngleAxisd, Eigen::Translation3d, Eigen::Vector3d;
    const Vector3d raising(0, -1, 0);
    const Eigen::Isometry3d upper_body = base * Translation3d(0, 0, 0.50) * AngleAxisd(swing_angle, Vector3d::UnitZ());
    const Eigen::Isometry3d boom_link = upper_body * Translation3d(0.40, 0, 0.30) * AngleAxisd(boom_angle, raising);
    const Eigen::Isometry3d arm_link = boom_link * Translation3d(1.10, 0, 0) * AngleAxisd(arm_angle, raising);
    return moment(498, base, {0, 0, 0.30}) + moment(1, base, {-0.62, 0.475, 0.18}) +
           moment(1, base, {-0.62, -0.475, 0.18}) + moment(350, upper_body, {-0.10, 0, 0.35}) +
           moment(60, boom_link, {0.55, 0, 0}) + moment(35, arm_link, {0.40, 0, 0});
}

TEST(Robot, CentreOfMassIsThatOfTheFile) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.2}, 3);
    const robot_state_t s = state(world);
    const double *q = s.actuator_position;
    const Eigen::Vector4d sum = moments_by_hand(world.robot().pose(), q[swing], q[boom], q[arm]);
    const Eigen::Vector3d expected = sum.head<3>() / sum[3];
    EXPECT_LT((Eigen::Vector3d(truth(world).centre_of_mass) - expected).norm(), 1e-9);
    EXPECT_NEAR(sum[3], world.robot().model().mass(), 1e-9);
}

TEST(Robot, CentreOfMassVelocityIsItsDerivative) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.2}, 1.5);
    const Eigen::Vector3d before = world.robot().centre_of_mass();
    const Eigen::Vector3d velocity = world.robot().centre_of_mass_velocity();
    world.step();
    const Eigen::Vector3d difference = (world.robot().centre_of_mass() - before) / world.time_step();
    EXPECT_GT(velocity.norm(), 0.05);
    EXPECT_LT((velocity - difference).norm(), 0.005);
}

TEST(Robot, PoseIsThatOfTheBaseLink) {
    Robot robot(paper_robot(), {0.7, 0.7, 0});
    Eigen::Isometry3d pose(Eigen::Translation3d(1, 2, 3));
    pose.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
    robot.set_pose(pose);
    EXPECT_LT((robot.pose().matrix() - pose.matrix()).norm(), 1e-12);
}

// A free body that turns keeps its angular momentum: inertia off the principal axes is handled.
TEST(Robot, SkewInertiaIsKept) {
    RobotModel model = paper_robot();
    model.bodies[0].inertia << 75, 5, -8, 5, 110, 6, -8, 6, 165;
    Robot robot(model, {0.7, 0.7, 0});
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    robot.set_pose(pose);
    const GeneralMatrix mass = mass_matrix(robot.bodies());
    RobotModel point = model;
    point.bodies[0].inertia.setIdentity();
    Robot other(point, {0.7, 0.7, 0});
    other.set_pose(pose);
    // the base's own inertia is what differs, up to the point of reference that both share
    const Eigen::Matrix3d difference = (mass - mass_matrix(other.bodies())).topLeftCorner<3, 3>();
    EXPECT_LT((difference - (model.bodies[0].inertia - Eigen::Matrix3d::Identity())).norm(), 1e-9);
}

}  // namespace
}  // namespace limphome
