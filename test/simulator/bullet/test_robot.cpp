#include "bullet/robot.h"

#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

Eigen::Isometry3d frame_of(const urdf::Pose &pose) {
    const urdf::Rotation &r = pose.rotation;
    return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
           Eigen::Quaterniond(r.w, r.x, r.y, r.z);
}

// Sum of mass times centre over a link and all that hangs on it.
Eigen::Vector4d moments(const urdf::Link &link, const Eigen::Isometry3d &frame,
                        const std::map<std::string, double> &q) {
    const Eigen::Vector3d centre = (frame * frame_of(link.inertial->origin)).translation();
    Eigen::Vector4d sum;
    sum << link.inertial->mass * centre, link.inertial->mass;
    for (const urdf::JointSharedPtr &joint : link.child_joints) {
        const auto angle = q.find(joint->name);
        const Eigen::Vector3d axis(joint->axis.x, joint->axis.y, joint->axis.z);
        const Eigen::Isometry3d child = frame * frame_of(joint->parent_to_joint_origin_transform) *
                                        Eigen::AngleAxisd(angle == q.end() ? 0 : angle->second, axis);
        for (const urdf::LinkSharedPtr &next : link.child_links) {
            if (next->name == joint->child_link_name) {
                sum += moments(*next, child, q);
            }
        }
    }
    return sum;
}

TEST(Robot, CentreOfMassIsThatOfTheUrdf) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.2}, 3);
    world.robot().update_frames();
    const robot_state_t s = state(world);
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(robot_file());
    const Eigen::Vector4d sum = moments(*model->getRoot(), world.robot().pose(),
                                        {{"swing", s.actuator_position[swing]},
                                         {"boom", s.actuator_position[boom]},
                                         {"arm", s.actuator_position[arm]}});
    const Eigen::Vector3d expected = sum.head<3>() / sum[3];
    EXPECT_LT((Eigen::Vector3d(truth(world).centre_of_mass) - expected).norm(), 1e-9);
    EXPECT_NEAR(sum[3], world.robot().model().mass(), 1e-9);
}

TEST(Robot, CentreOfMassVelocityIsItsDerivative) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.2}, 1.5);
    world.robot().update_frames();
    const Eigen::Vector3d before = world.robot().centre_of_mass();
    const Eigen::Vector3d velocity = world.robot().centre_of_mass_velocity();
    world.step();
    world.robot().update_frames();
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
    const GeneralMatrix mass = mass_matrix(robot.multibody());
    RobotModel point = model;
    point.bodies[0].inertia.setIdentity();
    Robot other(point, {0.7, 0.7, 0});
    other.set_pose(pose);
    // the base's own inertia is what differs, up to the point of reference that both share
    const Eigen::Matrix3d difference = (mass - mass_matrix(other.multibody())).topLeftCorner<3, 3>();
    EXPECT_LT((difference - (model.bodies[0].inertia - Eigen::Matrix3d::Identity())).norm(), 1e-9);
}

}  // namespace
}  // namespace limphome
