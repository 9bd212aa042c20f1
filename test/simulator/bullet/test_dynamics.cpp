// Bias forces against Bullet's articulated-body algorithm, which shares nothing with ours, and against what a robot in
// free flight keeps; touches on level ground against the search on any ground.
#include <gtest/gtest.h>

#include <random>

#include "bullet/bias_force.h"
#include "bullet/convert.h"
#include "bullet/level_touch.h"
#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

const Eigen::Vector3d no_gravity(0, 0, 0), some_gravity(1, 2, -9.81);

std::vector<RobotModel> models() {
    RobotModel skew = paper_robot();  // no axis of inertia along one of the frame's
    skew.bodies[0].inertia << 75, 5, -8, 5, 110, 6, -8, 6, 165;
    skew.bodies[4].inertia << 8, 1, 2, 1, 9, -1, 2, -1, 7;
    return {paper_robot(), skew, read_robot(CONFIG_DIR "/two_arm.urdf")};
}

Robot make_robot(const RobotModel &model) {
    return Robot(model, {0.7, 0.7, 0});
}

double uniform(std::mt19937 &generator, double most) {
    return std::uniform_real_distribution<double>(-most, most)(generator);
}

Eigen::Vector3d random_vector(std::mt19937 &generator, double most) {
    return {uniform(generator, most), uniform(generator, most), uniform(generator, most)};
}

// Any pose, angles and rates.
void toss(Robot &robot, std::mt19937 &generator) {
    Eigen::Isometry3d pose(Eigen::Translation3d(random_vector(generator, 1)));
    pose.rotate(Eigen::AngleAxisd(uniform(generator, M_PI), random_vector(generator, 1).normalized()));
    robot.set_pose(pose);
    btMultiBody &multibody = robot.multibody();
    multibody.setBaseOmega(to_bullet(random_vector(generator, 2)));
    multibody.setBaseVel(to_bullet(random_vector(generator, 2)));
    for (int joint = 0; joint < multibody.getNumLinks(); joint++) {
        multibody.setJointPos(joint, uniform(generator, M_PI));
        multibody.setJointVel(joint, uniform(generator, 2));
    }
}

int dofs(const Robot &robot) {
    return base_dofs + robot.multibody().getNumDofs();
}

GeneralVector free_acceleration(const Robot &robot, const Eigen::Vector3d &gravity) {
    const int n = dofs(robot);
    GeneralVector acceleration = GeneralVector::Zero();
    acceleration.head(n) = mass_matrix(robot.bodies())
                               .topLeftCorner(n, n)
                               .ldlt()
                               .solve(-bias_force(robot.bodies(), robot.velocity(), gravity).head(n));
    return acceleration;
}

// From what its velocities become in a second.
GeneralVector acceleration_of_bullet(Robot &robot, const Eigen::Vector3d &gravity) {
    const GeneralVector before = robot.velocity();
    btMultiBody &multibody = robot.multibody();
    multibody.clearForcesAndTorques();
    multibody.addBaseForce(to_bullet(Eigen::Vector3d(multibody.getBaseMass() * gravity)));
    for (int link = 0; link < multibody.getNumLinks(); link++) {
        multibody.addLinkForce(link, to_bullet(Eigen::Vector3d(multibody.getLinkMass(link) * gravity)));
    }
    btAlignedObjectArray<btScalar> numbers;
    btAlignedObjectArray<btVector3> vectors;
    btAlignedObjectArray<btMatrix3x3> matrices;
    multibody.computeAccelerationsArticulatedBodyAlgorithmMultiDof(1, numbers, vectors, matrices, false, false, false);
    return robot.velocity() - before;
}

TEST(Dynamics, AccelerationsAreThoseOfBullet) {
    std::mt19937 generator(1);
    for (const RobotModel &model : models()) {
        Robot robot = make_robot(model);
        for (int i = 0; i < 100; i++) {
            toss(robot, generator);
            const GeneralVector ours = free_acceleration(robot, some_gravity);
            const GeneralVector theirs = acceleration_of_bullet(robot, some_gravity);
            EXPECT_LT((ours - theirs).norm(), 1e-9 * theirs.norm()) << model.name << " " << i;
        }
    }
}

// Momentum, angular momentum about the origin [N s, N m s]
Eigen::Matrix<double, 6, 1> momentum_about_origin(const Robot &robot) {
    const GeneralVector momentum = mass_matrix(robot.bodies()) * robot.velocity();
    Eigen::Matrix<double, 6, 1> result;
    result << momentum.segment<3>(3),
        momentum.head<3>() + robot.bodies()[0].centre.cross(Eigen::Vector3d(momentum.segment<3>(3)));
    return result;
}

// Rate of what is measured: from a moment before to a moment after.
template <typename Measure>
auto rate(Robot &robot, const GeneralVector &acceleration, const Measure &measure) {
    constexpr double moment = 1e-4;  // [s]
    const GeneralVector velocity = robot.velocity();
    const auto measure_later = [&](double seconds) {
        const GeneralVector mean = velocity + 0.5 * seconds * acceleration;
        robot.move(mean, seconds);
        robot.move(velocity + seconds * acceleration, 0);
        auto measured = measure(robot);
        robot.move(mean, -seconds);
        return measured;
    };
    const auto after = measure_later(moment), before = measure_later(-moment);
    robot.move(velocity, 0);
    return ((after - before) / (2 * moment)).eval();
}

TEST(Dynamics, FreeFlightKeepsMomentumAndEnergy) {
    std::mt19937 generator(2);
    for (const RobotModel &model : models()) {
        Robot robot = make_robot(model);
        for (int i = 0; i < 20; i++) {
            toss(robot, generator);
            const GeneralVector acceleration = free_acceleration(robot, no_gravity);
            const auto momentum = rate(robot, acceleration, momentum_about_origin);
            EXPECT_LT(momentum.norm(), 1e-6 * momentum_about_origin(robot).norm()) << model.name << " " << i;
            const auto power = rate(robot, acceleration, [](const Robot &moving) {
                return Eigen::Matrix<double, 1, 1>(moving.kinetic_energy());
            });
            EXPECT_LT(std::abs(power[0]), 1e-6 * robot.kinetic_energy()) << model.name << " " << i;
        }
    }
}

void expect_same(const std::vector<Touch> &one, const std::vector<Touch> &other) {
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); i++) {
        EXPECT_EQ(one[i].shape, other[i].shape);
        EXPECT_EQ(one[i].other, Touch::ground);
        EXPECT_LT((one[i].point - other[i].point).norm(), 1e-7);
        EXPECT_LT((one[i].normal - other[i].normal).norm(), 1e-12);
        EXPECT_NEAR(one[i].depth, other[i].depth, 1e-12);
    }
}

TEST(Dynamics, LevelGroundIsTouchedAsAnyGroundIs) {
    std::mt19937 generator(3);
    const Ground ground(sound());
    for (const RobotModel &model : models()) {
        Robot robot = make_robot(model);
        std::vector<Touch> level, any;
        std::size_t touching = 0;
        for (int i = 0; i < 200; i++) {
            toss(robot, generator);
            Eigen::Isometry3d pose = robot.pose();
            pose.translation().z() = uniform(generator, 0.5);
            robot.set_pose(pose);
            level_touches(robot, level);
            ground_touches(robot, ground, any);
            expect_same(level, any);
            touching += level.size();
        }
        EXPECT_GT(touching, 1000U);
    }
}

// Where a rim lies flat, any point of it is as good; it must carry.
TEST(Dynamics, RimsThatLieFlatTouch) {
    const RobotModel model = paper_robot();
    Robot robot = make_robot(model);
    Eigen::Isometry3d pose(Eigen::Translation3d(0, 0, 0.5 * 1.25));
    pose.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    robot.set_pose(pose);
    std::vector<Touch> touches;
    level_touches(robot, touches);
    int rims = 0;
    for (const Touch &touch : touches) {
        rims += touch.shape < static_cast<int>(robot.rims().size()) ? 1 : 0;
        EXPECT_TRUE(touch.point.allFinite());
    }
    EXPECT_EQ(rims, 2);
}

}  // namespace
}  // namespace limphome
