#include "bullet/crawler.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

constexpr double belt_speed = 0.3;

// The turning rate at which the power lost to friction, sum of mu N |slip| over the points of contact, is least among
// all planar motions (vx, vy, yaw rate) of the body: what a robot without inertia does. Points and loads are the true
// ones. The sum is convex; it is minimised by iterated weighted least squares.
double quasi_static_turning_rate(const World &world, double left_speed, double right_speed) {
    const Eigen::Isometry3d to_body = world.robot().pose().inverse();
    const ground_truth_t t = truth(world);
    Eigen::Vector3d motion(0, 0, 0);
    for (int iteration = 0; iteration < 2000; iteration++) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
        for (int i = 0; i < t.num_contacts; i++) {
            const Eigen::Vector3d p = to_body * Eigen::Vector3d(t.contact_point[i]);
            Eigen::Matrix<double, 2, 3> slip;
            slip << 1, 0, -p.y(), 0, 1, p.x();
            const Eigen::Vector2d belt(t.contact_part[i] == left ? left_speed : right_speed, 0);
            const double weight = t.contact_force[i][2] / std::max((slip * motion - belt).norm(), 1e-9);
            normal += weight * slip.transpose() * slip;
            rhs += weight * slip.transpose() * belt;
        }
        motion = normal.ldlt().solve(rhs);
    }
    return motion.z();
}

class LockedCrawler : public testing::TestWithParam<double> {};

TEST_P(LockedCrawler, TurnsAsFrictionDemands) {
    settings s = left_locked();
    s.simulator.friction_crawler = GetParam();
    RobotModel model = paper_robot();
    model.actuators[right].effort = 1e5;  // enough for any friction
    World world(model, s);
    run(world, {0, belt_speed}, 2);
    const double rate = turning_rate(world, {0, belt_speed}, 4);
    EXPECT_NEAR(rate, quasi_static_turning_rate(world, 0, belt_speed), 0.005 * rate);

    s.simulator.time_step_s /= 2;
    World finer(model, s);
    run(finer, {0, belt_speed}, 2);
    EXPECT_NEAR(turning_rate(finer, {0, belt_speed}, 4), rate, 0.002 * rate);
}
INSTANTIATE_TEST_SUITE_P(Friction, LockedCrawler, testing::Values(0.2, 0.5, 0.7, 1.0));

TEST(Crawler, TurnsAsFrictionDemandsWithFewIterations) {
    settings s = left_locked();
    s.simulator.solver_iterations = 5;
    World world(paper_robot(), s);
    run(world, {0, belt_speed}, 2);
    const double rate = turning_rate(world, {0, belt_speed}, 4);
    EXPECT_NEAR(rate, quasi_static_turning_rate(world, 0, belt_speed), 0.01 * rate);
}

TEST(Crawler, CounterRotationTurnsAsFrictionDemands) {
    World world(paper_robot(), sound());
    run(world, {-belt_speed, belt_speed}, 1);
    const double rate = turning_rate(world, {-belt_speed, belt_speed}, 1);
    EXPECT_NEAR(rate, quasi_static_turning_rate(world, -belt_speed, belt_speed), 0.01 * rate);
}

TEST(Crawler, FrictionOpposesTheSlip) {
    World world(paper_robot(), left_locked());
    run(world, {0, belt_speed}, 3);
    const btMultiBody &base = world.robot().multibody();
    const Eigen::Vector3d origin(base.getBasePos()), velocity(base.getBaseVel()), spin(base.getBaseOmega());
    const Eigen::Vector3d forward = world.robot().pose().linear().col(0);
    const ground_truth_t t = truth(world);
    ASSERT_EQ(t.num_contacts, 8);
    for (int i = 0; i < t.num_contacts; i++) {
        const Eigen::Vector3d point(t.contact_point[i]), force(t.contact_force[i]);
        const double belt = world.robot().actuator_velocity(t.contact_part[i]);
        const Eigen::Vector2d slip = (velocity + spin.cross(point - origin) - belt * forward).head<2>();
        const Eigen::Vector2d friction = force.head<2>();
        ASSERT_GT(slip.norm(), 0.01);
        EXPECT_NEAR(friction.norm(), 0.7 * force.z(), 1e-3 * force.z());
        EXPECT_LT((friction.normalized() + slip.normalized()).norm(), 0.01);
    }
}

// It runs round its ends at radius * sprocket rate and touches the ground along a circle's tangent, whatever the tilt.
TEST(Crawler, TiltedBeltKeepsItsSpeed) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0, 0.3}, 5.2);
    run(world, {0, 0, 0, -0.3}, 4);
    ASSERT_GT(roll(world), 0.3);
    int touching = 0;
    for (const Contact &contact : world.contacts()) {
        if (world.robot().shapes()[static_cast<std::size_t>(contact.shape)].part == right && contact.impulse[0] > 0) {
            EXPECT_NEAR(contact.jacobian.row(6 + right).norm(), 0.18, 1e-12);
            touching++;
        }
    }
    EXPECT_EQ(touching, 2);
}

TEST(Crawler, TorqueIsWhatTheGroundDoesToTheBelt) {
    World world(paper_robot(), left_locked());
    run(world, {0, belt_speed}, 5);
    const ground_truth_t t = truth(world);
    const Eigen::Vector3d forward = world.robot().pose().linear().col(0);
    double force[2] = {0, 0};
    for (int i = 0; i < t.num_contacts; i++) {
        force[t.contact_part[i]] += forward.dot(Eigen::Vector3d(t.contact_force[i]));
    }
    const robot_state_t s = state(world);
    EXPECT_GT(s.actuator_effort[right], 100);
    EXPECT_NEAR(s.actuator_effort[right], 0.18 * force[right], 2);
    EXPECT_NEAR(s.actuator_effort[left], 0.18 * force[left], 2);
}

TEST(Crawler, FreeOneRollsAndTurnsTheRobotLess) {
    World locked(paper_robot(), left_locked());
    run(locked, {0, belt_speed}, 5);
    World rolling(paper_robot(), left_free());
    run(rolling, {0, belt_speed}, 5);
    EXPECT_NEAR(state(locked).actuator_position[left], 0, 1e-9);
    EXPECT_GT(state(rolling).actuator_position[left], 0.3);  // carried along
    EXPECT_LT(heading(rolling), heading(locked) - 0.1);
    EXPECT_NEAR(state(rolling).actuator_effort[left], 0, 1e-9);
    EXPECT_EQ(rolling.health(left), Health::failed);
    EXPECT_EQ(locked.health(left), Health::failed);
}

TEST(Crawler, LockedRobotHoldsOnASlope) {
    World world(paper_robot(), left_locked());
    world.set_gravity(downhill(20 * degree));
    run(world, {}, 1);  // settles on the springs of the ground
    const Eigen::Vector3d start = position(world);
    run(world, {}, 20);
    EXPECT_LT((position(world) - start).norm(), 1e-4);
}

TEST(Crawler, FreeRobotRollsDownASlope) {
    RobotModel model = paper_robot();
    model.actuators[right].effort = 1e-6;  // the right crawler is as good as free too
    World world(model, left_free());
    world.set_gravity(downhill(20 * degree));
    run(world, {}, 2);
    // both sprockets (4 kg m^2 each at 0.18 m) have to be turned
    const double acceleration = 9.81 * std::sin(20 * degree) * model.mass() / (model.mass() + 2 * 4 / (0.18 * 0.18));
    EXPECT_NEAR(world.robot().centre_of_mass_velocity().y(), acceleration * 2, 0.005 * acceleration * 2);
    EXPECT_NEAR(position(world).y(), 0.5 * acceleration * 4, 0.01 * 0.5 * acceleration * 4);
    EXPECT_NEAR(state(world).actuator_position[left], position(world).y(), 0.01);  // without slip
}

TEST(Crawler, LockedRobotSlidesDownASteepSlopeAsCoulombSays) {
    RobotModel model = paper_robot();
    model.actuators[right].effort = 1e6;
    World world(model, left_locked());
    world.set_gravity(downhill(40 * degree));
    run(world, {}, 0.5);
    const double speed = world.robot().centre_of_mass_velocity().y();
    run(world, {}, 1);
    const double acceleration = 9.81 * (std::sin(40 * degree) - 0.7 * std::cos(40 * degree));
    EXPECT_NEAR(world.robot().centre_of_mass_velocity().y() - speed, acceleration, 0.002 * acceleration);
}

// Uphill faster than friction can accelerate: traction is mu N and no more.
TEST(Crawler, TractionEndsAtTheLimitOfFriction) {
    settings s = sound();
    s.simulator.friction_crawler = 0.1;
    World world(paper_robot(), s);
    run(world, {0.9, 0.9}, 0.1);
    const double speed = world.robot().centre_of_mass_velocity().y();
    EXPECT_GT(state(world).actuator_velocity[left], 0.5);  // spinning
    run(world, {0.9, 0.9}, 0.4);
    EXPECT_NEAR(world.robot().centre_of_mass_velocity().y() - speed, 0.1 * 9.81 * 0.4, 0.002);
}

}  // namespace
}  // namespace limphome
