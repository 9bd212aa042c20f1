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
    const btMultiBody &multibody = world.robot().multibody();
    GeneralVector velocity = GeneralVector::Zero();
    const int dofs = base_dofs + multibody.getNumDofs();
    velocity.head(dofs) = Eigen::Map<const Eigen::VectorXd>(multibody.getVelocityVector(), dofs);
    return 0.5 * velocity.dot(mass_matrix(multibody) * velocity);
}

double energy(const World &world) {
    return kinetic_energy(world) +
           world.robot().model().mass() * standard_gravity * world.robot().centre_of_mass().z();
}

// The arm folded and swung over the left crawler, then lowered with all the boom has.
void press_arm_on_left_crawler(World &world) {
    run(world, {0, 0, 0.3, 0, -0.3}, 4);
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
    std::printf("depth %g count %ld force %g ke %g\n", deepest(world), self_contacts(world), force(world, true).z(), kinetic_energy(world));
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

// Boom and arm fall on the crawler without drives: it takes their energy, and never gives any back.
TEST(SelfContact, OnlyTakesEnergy) {
    settings s = with_failure(SETTINGS_FAILED_JOINT + 1, SETTINGS_FREE);
    s.second_failure.actuator = SETTINGS_FAILED_JOINT + 2;
    s.second_failure.mode = SETTINGS_FREE;
    for (const double friction : {0.0, 0.3, 1.0}) {
        s.simulator.friction_body = friction;
        World world(paper_robot(), s);
        world.robot().multibody().setJointPos(swing, 0.8);
        world.robot().multibody().setJointPos(boom, 0.4);
        world.robot().multibody().setJointPos(arm, -2.3);
        world.robot().update_frames();
        double before = energy(world);
        const double all = before;
        double rise = 0;
        long touching = 0;
        for (int i = 0; i < 1000; i++) {
            run(world, {}, world.time_step());
            rise = std::max(rise, energy(world) - before);
            before = energy(world);
            touching += self_contacts(world) > 0;
        }
        std::printf("mu %g rise %g fell %g touching %ld ke %g depth %g\n", friction, rise, all - before, touching, kinetic_energy(world), deepest(world));
        EXPECT_GT(touching, 100);
        EXPECT_GT(all - before, 100);
        EXPECT_LT(rise, 0.1);
    }
}

// The run of a belt that is turned towards a part pulls it along, and is held back by as much: with the robot off the
// ground, nothing else asks anything of the sprocket.
TEST(SelfContact, BeltPullsAlong) {
    for (const double rate : {0.3, -0.3}) {
        World world(paper_robot(), sound());
        press_arm_on_left_crawler(world);
        world.set_gravity({0, 0, 0});
        world.robot().set_pose(Eigen::Translation3d(0, 0, 1) * world.robot().pose());
        run(world, {rate, rate, 0, -0.3}, 1);
        double along = 0, normal = 0;
        for (const Contact &contact : world.contacts()) {
            ASSERT_TRUE(between_bodies(contact));
            std::printf("%d %d n %g %g %g f %g %g %g\n", contact.shape, contact.other, contact.frame(0,0), contact.frame(1,0), contact.frame(2,0), contact.impulse[0]/.005, contact.impulse[1]/.005, contact.impulse[2]/.005);
            along += contact.impulse[1] / world.time_step();
            normal += contact.impulse[0] / world.time_step();
        }
        ASSERT_GT(normal, 100);
        std::printf("along %g normal %g effort %g %g\n", along, normal, world.drives()[left].effort(), world.drives()[right].effort());
        EXPECT_NEAR(along, std::copysign(0.3 * normal, rate), 1e-3 * normal);
        EXPECT_NEAR(world.drives()[left].effort(), 0.18 * along, 1e-6 * normal);
    }
}

}  // namespace
}  // namespace limphome
