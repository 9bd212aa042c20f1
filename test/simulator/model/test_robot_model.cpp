#include "model/robot_model.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
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

// Each link as eight points that have its mass, centre and inertia, carried along by Eigen's frames; then the moments
// of all points together, about their common centre.
struct Points {
    std::vector<Eigen::Vector3d> at;
    double mass = 0;  // of each

    // A box of even density has its points at 1/sqrt(3) of its half size.
    Points(double total, const Eigen::Vector3d &half, const Eigen::Isometry3d &frame) : mass(total / 8) {
        for (int corner = 0; corner < 8; corner++) {
            const Eigen::Vector3d sign(2 * (corner & 1) - 1, 2 * (corner >> 1 & 1) - 1, 2 * (corner >> 2) - 1);
            at.emplace_back(frame * (sign.cwiseProduct(half) / std::sqrt(3.0)));
        }
    }
};

Eigen::Isometry3d frame_of(const Eigen::Vector3d &xyz, const Eigen::Vector3d &rpy) {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    return Eigen::Translation3d(xyz) * AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
           AngleAxisd(rpy.x(), Vector3d::UnitX());
}

std::string text_of(const Eigen::Vector3d &v) {
    std::ostringstream text;
    text << v.x() << ' ' << v.y() << ' ' << v.z();
    return text.str();
}

// A link and its joint, the inertia that of a box.
std::string link_text(const std::string &name, const std::string &parent, double mass, const Eigen::Vector3d &half,
                      const Eigen::Vector3d *joint, const Eigen::Vector3d *inertial) {
    const Eigen::Vector3d squares = half.cwiseProduct(half) * mass / 3;
    std::ostringstream text;
    text.precision(17);
    text << "<link name='" << name << "'><inertial><origin xyz='" << text_of(inertial[0]) << "' rpy='"
         << text_of(inertial[1]) << "'/><mass value='" << mass << "'/><inertia ixx='" << squares.y() + squares.z()
         << "' iyy='" << squares.x() + squares.z() << "' izz='" << squares.x() + squares.y()
         << "' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='" << name << "' type='fixed'><parent link='"
         << parent << "'/><child link='" << name << "'/><origin xyz='" << text_of(joint[0]) << "' rpy='"
         << text_of(joint[1]) << "'/></joint>";
    return text.str();
}

TEST(RobotModel, MergedBodiesHaveTheMomentsOfTheirLinks) {
    const Eigen::Vector3d half[3] = {{0.1, 0.2, 0.3}, {0.3, 0.1, 0.05}, {0.02, 0.4, 0.1}};
    const Eigen::Vector3d joint[3][2] = {
        {{0.2, -0.1, 0.5}, {0.3, -0.7, 1.1}}, {{-0.3, 0.2, 0.1}, {1.3, 0.4, -2}}, {{0.1, 0.1, 0.4}, {-0.2, 0.9, 0.6}}};
    const Eigen::Vector3d inertial[3][2] = {
        {{0.05, 0, 0.1}, {0.5, 0.2, -0.4}}, {{0, 0.1, 0}, {-1, 0.3, 0.8}}, {{0.1, 0.2, -0.1}, {0.7, -0.6, 2.5}}};
    const double mass[3] = {20, 30, 5};
    // two on the arm one after the other, the third beside the first
    std::string links;
    std::vector<Points> points;
    const Eigen::Isometry3d first = frame_of(joint[0][0], joint[0][1]);
    for (int i = 0; i < 3; i++) {
        const std::string parent = i == 1 ? "part0" : "arm";
        links += link_text("part" + std::to_string(i), parent, mass[i], half[i], joint[i], inertial[i]);
        const Eigen::Isometry3d frame =
            (i == 1 ? first : Eigen::Isometry3d::Identity()) * frame_of(joint[i][0], joint[i][1]);
        points.emplace_back(mass[i], half[i], frame * frame_of(inertial[i][0], inertial[i][1]));
    }
    std::ifstream file(laboratory::robot_file());
    std::string text{std::istreambuf_iterator<char>(file), {}};
    text.insert(text.find("<limphome>"), links);
    const std::string path = testing::TempDir() + "limphome_merged.urdf";
    std::ofstream(path) << text;
    const Body merged = laboratory::read_robot(path).bodies[5];
    std::remove(path.c_str());

    // the arm's own link: its inertia is that of a point with this added
    Eigen::Matrix3d inertia = Eigen::Vector3d(0.15, 1.9, 1.9).asDiagonal();
    points.emplace_back(35, Eigen::Vector3d::Zero(), Eigen::Isometry3d(Eigen::Translation3d(0.4, 0, 0)));
    double total = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Points &p : points) {
        for (const Eigen::Vector3d &at : p.at) {
            total += p.mass;
            centre += p.mass * at;
        }
    }
    centre /= total;
    for (const Points &p : points) {
        for (const Eigen::Vector3d &at : p.at) {
            const Eigen::Vector3d r = at - centre;
            inertia += p.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
        }
    }
    EXPECT_NEAR(merged.mass, total, 1e-9);
    EXPECT_LT((merged.centre - centre).norm(), 1e-12);
    EXPECT_LT((merged.inertia - inertia).norm(), 1e-10);
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
