// The robot on ground that is not level.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

settings incline(double along, double across) {
    settings s = sound();
    s.ground.incline_along_rad = along;
    s.ground.incline_across_rad = across;
    return s;
}
settings steps(double height) {
    settings s = sound();
    s.ground.step_height_m = height;
    s.ground.step_spacing_m = 4;
    return s;
}
settings rough(double amplitude, double wavelength) {
    settings s = sound();
    s.ground.rough_amplitude_m = amplitude;
    s.ground.rough_wavelength_m = wavelength;
    return s;
}

double drift(const settings &s, double seconds) {
    World world(paper_robot(), s);
    const Eigen::Vector3d start = position(world);
    run(world, {}, seconds);
    return (position(world) - start).norm();
}

TEST(Terrain, ChangesWithItsEpisode) {
    settings s = sound();
    s.change.at_episode = 60;
    s.change.friction = 0.5;
    World world(paper_robot(), s);
    const auto friction = [&world](int64_t episode) {
        world.reset(episode);
        run(world, {}, 0.1);
        return world.contacts().at(0).friction;
    };
    EXPECT_DOUBLE_EQ(friction(59), s.simulator.friction_crawler);
    EXPECT_DOUBLE_EQ(friction(60), 0.5 * s.simulator.friction_crawler);
    EXPECT_DOUBLE_EQ(friction(61), 0.5 * s.simulator.friction_crawler);
}

// Contacts on an incline that is hardly one against those that Bullet finds on the plane.
TEST(Terrain, ContactsAreThoseOfThePlane) {
    World plane(paper_robot(), left_locked());
    settings s = left_locked();
    s.ground.incline_along_rad = 1e-9;
    World own(paper_robot(), s);
    for (const Rates &rates : {Rates{0, 0.3, 0.3, -0.3, 0}, Rates{0, 0.3, 0, -0.3, 0}, Rates{0, 0.3, -0.3, 0, 0.3}}) {
        run(plane, rates, 3);
        run(own, rates, 3);
        ASSERT_EQ(own.contacts().size(), plane.contacts().size());
        for (std::size_t i = 0; i < own.contacts().size(); i++) {
            EXPECT_EQ(own.contacts()[i].shape, plane.contacts()[i].shape);
            EXPECT_LT((own.contacts()[i].point - plane.contacts()[i].point).norm(), 2e-4);
            EXPECT_NEAR(own.contacts()[i].depth, plane.contacts()[i].depth, 1e-5);
        }
        EXPECT_LT((position(own) - position(plane)).norm(), 2e-4);
        EXPECT_NEAR(heading(own), heading(plane), 2e-4);
    }
}

// Friction 0.7 holds up to 35 degrees.
TEST(Terrain, BrakedRobotHoldsBelowTheAngleOfFrictionAndSlidesAbove) {
    settings along = incline(33 * degree, 0), across = incline(0, 33 * degree);
    for (settings *s : {&along, &across}) {
        s->failure.actuator = SETTINGS_FAILED_LEFT;
        s->second_failure.actuator = SETTINGS_FAILED_RIGHT;
        EXPECT_LT(drift(*s, 5), 0.005);
        s->ground.incline_along_rad *= 37.0 / 33;
        s->ground.incline_across_rad *= 37.0 / 33;
        const double distance = 0.5 * 9.81 * (std::sin(37 * degree) - 0.7 * std::cos(37 * degree)) * 4;
        EXPECT_NEAR(drift(*s, 2), distance, 0.03 * distance);
    }
}

TEST(Terrain, RobotStandsAlongTheInclineAtTheOrigin) {
    const World world(paper_robot(), incline(15 * degree, 10 * degree));
    EXPECT_LT(position(world).norm(), 0.003);
    EXPECT_LT((world.robot().pose().linear().col(2) - world.ground().incline()).norm(), 0.002);
    EXPECT_NEAR(heading(world), M_PI / 2, 1e-6);
}

TEST(Terrain, RobotDrivesUpAnIncline) {
    World world(paper_robot(), incline(20 * degree, 0));
    run(world, {0.3, 0.3}, 5);
    EXPECT_NEAR(position(world).y(), 1.5 * std::cos(20 * degree), 0.03);
    EXPECT_NEAR(position(world).z(), 1.5 * std::sin(20 * degree), 0.02);
    // m g sin(angle) at the radius of the sprockets
    const robot_state_t s = state(world);
    const double torque = world.robot().model().mass() * 9.81 * std::sin(20 * degree) * 0.18;
    EXPECT_NEAR(s.actuator_effort[left] + s.actuator_effort[right], torque, 0.01 * torque);
}

TEST(Terrain, StepOfTenCentimetresIsClimbed) {
    World world(paper_robot(), steps(0.1));
    double steepest = 0;
    for (int i = 0; i < 240; i++) {
        run(world, {0.3, 0.3}, 0.05);
        ASSERT_FALSE(world.diverged());
        ASSERT_LT(world.robot().centre_of_mass_velocity().norm(), 1.5);
        steepest = std::max(steepest, world.robot().pose().linear()(2, 0));
    }
    EXPECT_GT(position(world).y(), 2.8);  // all of it is on top
    EXPECT_NEAR(position(world).z(), 0.1, 0.005);
    EXPECT_NEAR(position(world).x(), 0, 0.05);
    EXPECT_GT(steepest, 0.06);
}

TEST(Terrain, StepOfAMetreStopsTheRobot) {
    World world(paper_robot(), steps(1));
    for (int i = 0; i < 600; i++) {
        run(world, {0.3, 0.3}, 0.05);
        ASSERT_FALSE(world.diverged());
        ASSERT_LT(world.robot().centre_of_mass_velocity().norm(), 5);
        ASSERT_LT(position(world).y(), 2);
    }
}

TEST(Terrain, RobotGoesDownAStepAndTiltsAboutItsEdge) {
    settings s = steps(0.15);
    s.ground.step_spacing_m = 2.2;  // starts low, 1.1 m from the step up
    World world(paper_robot(), s);
    std::vector<double> pitch;
    for (int i = 0; i < 300; i++) {
        run(world, {0.3, 0.3}, 0.05);
        pitch.push_back(-world.robot().pose().linear()(2, 0));
        ASSERT_LT(world.robot().centre_of_mass_velocity().norm(), 2);
    }
    EXPECT_GT(position(world).y(), 3.4);
    // nose down over the edge, but no more than from the edge to the ground
    EXPECT_GT(*std::max_element(pitch.begin(), pitch.end()), 0.08);
    EXPECT_LT(*std::max_element(pitch.begin(), pitch.end()), 0.3);
}

// A ridge between the rounded ends carries the flat run of the belts.
TEST(Terrain, FlatRunOfTheBeltsRestsOnARidge) {
    World world(paper_robot(), steps(0.1));
    run(world, {0.3, 0.3}, 5.5);
    bool carried = false;
    for (int i = 0; i < 60; i++) {
        run(world, {0.3, 0.3}, 0.05);
        const Eigen::Isometry3d to_body = world.robot().pose().inverse();
        for (const Contact &contact : world.contacts()) {
            const double place = (to_body * contact.point).x();
            carried = carried || (std::abs(place) < 0.5 && contact.impulse[0] > 0 && contact.shape < 8);
        }
    }
    EXPECT_TRUE(carried);
}

TEST(Terrain, RoughGroundStaysFiniteUnderRandomActions) {
    for (int seed = 1; seed <= 3; seed++) {
        settings s = rough(0.15, 1);
        s.ground.seed = seed;
        World world(paper_robot(), s);
        EXPECT_LT(position(world).head<2>().norm(), 1e-9);
        std::mt19937 random(static_cast<unsigned>(seed));
        for (int decision = 0; decision < 120; decision++) {
            Rates rates{};
            for (std::size_t a = 0; a < 5; a++) {
                rates[a] = 0.3 * (static_cast<int>(random() % 3) - 1);
            }
            run(world, rates, 0.5);
            ASSERT_FALSE(world.diverged());
            ASSERT_LT(world.robot().centre_of_mass_velocity().norm(), 3);
        }
    }
}

// At rest the contacts bear the weight, and none of them is far inside the ground.
TEST(Terrain, ContactsBearTheWeightOnRoughGround) {
    World world(paper_robot(), rough(0.1, 1));
    run(world, {}, 2);
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (const Contact &contact : world.contacts()) {
        force += contact.frame * contact.impulse / world.time_step();
        EXPECT_LT(contact.depth, 0.01);
        EXPECT_NEAR(world.ground().clearance(contact.point).distance, -0.5 * contact.depth, 1e-3);
    }
    EXPECT_NEAR(force.z(), world.robot().model().mass() * 9.81, 5);
    EXPECT_LT(force.head<2>().norm(), 20);
}

TEST(Terrain, ResetStandsOnTheSameGround) {
    World fresh(paper_robot(), rough(0.15, 1)), used(paper_robot(), rough(0.15, 1));
    run(used, {0.3, 0.2, 0.3, -0.3, 0}, 4);
    used.reset(0);
    run(fresh, {0.2, 0.3}, 1);
    run(used, {0.2, 0.3}, 1);
    EXPECT_EQ(position(used), position(fresh));
}

// Attitude and place at the start are those in which the brakes keep it.
TEST(Terrain, RobotStartsWhereItStays) {
    settings combined = rough(0.08, 1);
    combined.ground.incline_along_rad = 8 * degree;
    combined.ground.step_height_m = 0.1;
    combined.ground.step_spacing_m = 0.6;
    combined.ground.patch_share = 0.2;
    for (settings s : {rough(0.2, 1), combined}) {
        for (int64_t seed = 1; seed <= 20; seed++) {
            s.ground.seed = seed;
            World world(paper_robot(), s);
            const Eigen::Isometry3d start = world.robot().pose();
            run(world, {}, 1);
            const Eigen::Isometry3d end = world.robot().pose();
            EXPECT_LT((end.translation() - start.translation()).norm(), 1e-3) << "seed " << seed;
            EXPECT_LT(Eigen::AngleAxisd(start.linear().transpose() * end.linear()).angle(), 2e-3) << "seed " << seed;
        }
    }
}

TEST(Terrain, LooseGroundGivesLessTraction) {
    settings s = sound();
    s.ground.patch_share = 1;
    s.ground.patch_friction = 0.1;
    World world(paper_robot(), s);
    run(world, {0.9, 0.9}, 0.1);
    const double speed = world.robot().centre_of_mass_velocity().y();
    run(world, {0.9, 0.9}, 0.4);
    EXPECT_NEAR(world.robot().centre_of_mass_velocity().y() - speed, 0.07 * 9.81 * 0.4, 0.002);
}

}  // namespace
}  // namespace limphome
