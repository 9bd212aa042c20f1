// The robot touches itself: it stops where it does, as hard as its drives are, and nothing changes where it does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet/mass_matrix.h"
#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

bool between_bodies(const Contact &contact) {
    return contact.other != Touch::ground;
}

long self_contacts(const World &world) {
    return std::count_if(world.contacts().begin(), world.contacts().end(), between_bodies);
}

double deepest(const World &world) {
    double depth = 0;
    for (const Contact &contact : world.contacts()) {
        depth = between_bodies(contact) ? std::max(depth, contact.depth) : depth;
    }
    return depth;
}

// Of the ground on the robot, or of its bodies on each other.
Eigen::Vector3d force(const World &world, bool of_bodies) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Contact &contact : world.contacts()) {
        if (between_bodies(contact) == of_bodies) {
            sum += contact.frame * contact.impulse / world.time_step();
        }
    }
    return sum;
}

double kinetic_energy(const World &world) {
    return world.robot().kinetic_energy();
}

// The arm folded and swung over the left crawler, then lowered with all the boom has.
void press_arm_on_left_crawler(World &world) {
    run(world, {0, 0, 0.2, 0, -0.3}, 3);
    ASSERT_EQ(self_contacts(world), 0);
    run(world, {0, 0, 0, -0.3, 0}, 4);
}

TEST(SelfContact, ArmOnCrawlerStopsThereAtItsTorqueLimit) {
    World world(paper_robot(), left_locked());
    press_arm_on_left_crawler(world);
    ASSERT_GT(self_contacts(world), 0);
    const double before = state(world).actuator_position[boom];
    EXPECT_GT(before, -0.3);  // without contact it would be at -0.6
    run(world, {0, 0, 0, -0.3, 0}, 5);
    EXPECT_NEAR(state(world).actuator_position[boom], before, 1e-3);
    EXPECT_NEAR(world.drives()[boom].effort(), -6000, 1e-6);
    EXPECT_LT(kinetic_energy(world), 1e-8);
    EXPECT_LT(deepest(world), 2e-3);
    // lifted off again it is free
    run(world, {0, 0, 0, 0.3, 0}, 1);
    EXPECT_EQ(self_contacts(world), 0);
    EXPECT_GT(state(world).actuator_position[boom], before + 0.25);
}

// Forces between bodies are no forces on the robot.
TEST(SelfContact, CarriesNothing) {
    World world(paper_robot(), left_locked());
    const ground_truth_t before = truth(world);
    press_arm_on_left_crawler(world);
    run(world, {}, 2);
    EXPECT_GT(force(world, true).z(), 1000);
    EXPECT_NEAR(force(world, false).z(), world.robot().model().mass() * standard_gravity, 1);
    for (const Contact &contact : world.contacts()) {
        if (between_bodies(contact)) {
            EXPECT_EQ(contact.jacobian.topRows<base_dofs>().norm(), 0);
        }
    }
    const ground_truth_t t = truth(world);
    int told = 0;
    for (int i = 0; i < t.num_contacts; i++) {
        told += t.contact_with[i] != ground_truth_t::GROUND;
    }
    EXPECT_EQ(told, self_contacts(world));
    EXPECT_EQ(t.num_support, before.num_support);
}

// The boom, without its drive, strikes the crawler with the arm, where there is no gravity and nothing else to touch:
// it takes energy and never gives any back.
TEST(SelfContact, OnlyTakesEnergy) {
    settings s = with_failure(SETTINGS_FAILED_JOINT + 1, SETTINGS_FREE);
    for (const double friction : {0.0, 0.3, 1.0}) {
        s.simulator.friction_body = friction;
        World world(paper_robot(), s);
        world.set_gravity({0, 0, 0});
        world.robot().multibody().setJointPos(swing, 0.6);
        world.robot().multibody().setJointPos(boom, 0.3);
        world.robot().multibody().setJointPos(arm, -2.4);
        world.robot().set_pose(Eigen::Translation3d(0, 0, 1) * world.robot().pose());
        world.robot().multibody().setJointVel(boom, -1);
        run(world, {}, world.time_step());
        double before = kinetic_energy(world);
        const double all = before;
        double rise = 0;
        long touching = 0;
        for (int i = 0; i < 1000; i++) {
            run(world, {}, world.time_step());
            const double now = kinetic_energy(world);
            rise = std::max(rise, now - before);
            before = now;
            touching += self_contacts(world) > 0;
        }
        EXPECT_GT(touching, 1);
        EXPECT_LT(before, 0.9 * all);
        EXPECT_LT(rise, 2e-3 * all);  // what the spring gives back
    }
}

// In reverse the belt's front end runs upwards and pulls at the tip that is pressed on it, which pulls at the belt:
// with the robot off the ground, nothing else asks anything of the sprocket.
TEST(SelfContact, BeltPullsAtWhatLiesOnIt) {
    World world(paper_robot(), sound());
    press_arm_on_left_crawler(world);
    world.set_gravity({0, 0, 0});
    world.robot().set_pose(Eigen::Translation3d(0, 0, 1) * world.robot().pose());
    run(world, {-0.3, -0.3, 0, -0.3}, 1);
    ASSERT_EQ(world.contacts().size(), 1u);
    const Contact &contact = world.contacts()[0];
    ASSERT_EQ(world.robot().shapes()[static_cast<std::size_t>(contact.shape)].part, arm);
    ASSERT_EQ(world.robot().shapes()[static_cast<std::size_t>(contact.other)].part, left);
    const double pressure = contact.impulse[0] / world.time_step();
    const Eigen::Vector3d pull = contact.frame.rightCols<2>() * contact.impulse.tail<2>() / world.time_step();
    EXPECT_GT(pressure, 5000);
    EXPECT_GT(pull.z(), 0.2 * pressure);
    EXPECT_NEAR(pull.norm(), 0.3 * pressure, 1e-6 * pressure);
    EXPECT_NEAR(world.drives()[left].effort(), -0.18 * pull.norm(), 1e-3 * pull.norm());
    EXPECT_NEAR(world.drives()[right].effort(), 0, 0.1);
}

// What may meet and does not changes nothing, bit by bit.
TEST(SelfContact, IsNothingWhereNothingTouches) {
    RobotModel alone = paper_robot();
    std::fill_n(&alone.may_meet[0][0], sizeof alone.may_meet, false);
    World with(paper_robot(), left_locked()), without(alone, left_locked());
    const Rates motions[] = {
        {0, 0.3, 0.3, -0.15, 0}, {0, 0.3, 0, -0.3, 0}, {0, 0.3, -0.3, -0.1, 0.1}, {0, -0.3, 0, 0.3, 0}};
    for (const Rates &rates : motions) {
        for (int i = 0; i < 300; i++) {
            run(with, rates, with.time_step());
            run(without, rates, without.time_step());
            ASSERT_EQ(self_contacts(with), 0);
        }
        const robot_state_t a = state(with), b = state(without);
        EXPECT_TRUE(std::equal(std::begin(a.position), std::end(a.position), b.position));
        EXPECT_TRUE(std::equal(std::begin(a.orientation), std::end(a.orientation), b.orientation));
        EXPECT_TRUE(std::equal(std::begin(a.actuator_effort), std::end(a.actuator_effort), b.actuator_effort));
    }
}

}  // namespace
}  // namespace limphome
