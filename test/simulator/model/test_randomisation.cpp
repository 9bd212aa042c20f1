#include "model/randomisation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

settings varied(double friction, double mass, double torque) {
    settings s = left_locked();
    s.randomisation.friction = friction;
    s.randomisation.mass = mass;
    s.randomisation.torque = torque;
    return s;
}

TEST(Randomisation, StaysWithinItsRangesAndUsesThem) {
    const RobotModel nominal = paper_robot();
    double least[3] = {9, 9, 9}, most[3] = {0, 0, 0};
    for (int episode = 1; episode <= 300; episode++) {
        RobotModel model = nominal;
        settings s = varied(0.5, 0.2, 0.1);
        randomise(model, s, episode);
        const double shares[3] = {s.simulator.friction_crawler / 0.7, model.bodies[3].mass / nominal.bodies[3].mass,
                                  model.actuators[4].effort / nominal.actuators[4].effort};
        EXPECT_NEAR(model.bodies[3].inertia(1, 1) / nominal.bodies[3].inertia(1, 1), shares[1], 1e-12);
        for (int i = 0; i < 3; i++) {
            least[i] = std::min(least[i], shares[i]);
            most[i] = std::max(most[i], shares[i]);
        }
    }
    const double range[3] = {0.5, 0.2, 0.1};
    for (int i = 0; i < 3; i++) {
        EXPECT_GE(least[i], 1 - range[i]);
        EXPECT_LT(least[i], 1 - 0.9 * range[i]);
        EXPECT_LE(most[i], 1 + range[i]);
        EXPECT_GT(most[i], 1 + 0.9 * range[i]);
    }
}

TEST(Randomisation, ChangesNothingUnlessAskedFor) {
    RobotModel model = paper_robot();
    settings s = left_locked();
    randomise(model, s, 7);
    EXPECT_EQ(s.simulator.friction_crawler, 0.7);
    EXPECT_EQ(model.bodies[3].mass, paper_robot().bodies[3].mass);
    EXPECT_EQ(model.actuators[0].effort, 1000);
}

double end_of_run(World &world, int64_t episode) {
    world.reset(episode);
    run(world, {0, 0.3, 0.3, -0.3, 0}, 3);
    return heading(world);
}

TEST(Randomisation, IsTheSameForTheSameEpisodeOnly) {
    World one(paper_robot(), varied(0.3, 0.3, 0.3)), two(paper_robot(), varied(0.3, 0.3, 0.3));
    end_of_run(one, 1);
    const double second = end_of_run(one, 2);
    EXPECT_EQ(end_of_run(two, 2), second);
    EXPECT_NE(end_of_run(two, 3), second);
    EXPECT_EQ(end_of_run(two, 2), second);
}

settings put_anywhere() {
    settings s = left_locked();
    s.randomisation.position_m = 2;
    s.randomisation.heading_rad = 0.3;
    s.randomisation.joint_rad = 0.2;
    return s;
}

TEST(Start, IsWithinItsRangesAndUsesThem) {
    const RobotModel nominal = paper_robot();
    double most[4] = {0, 0, 0, 0};
    for (int episode = 1; episode <= 300; episode++) {
        RobotModel model = nominal;
        const Start start = draw_start(model, put_anywhere(), episode);
        const double offsets[4] = {start.x, start.y, start.heading - M_PI / 2,
                                   model.actuators[3].home - nominal.actuators[3].home};
        for (int i = 0; i < 4; i++) {
            most[i] = std::max(most[i], std::abs(offsets[i]));
        }
        EXPECT_EQ(model.actuators[0].home, nominal.actuators[0].home);  // a crawler has no angle to begin with
    }
    const double range[4] = {2, 2, 0.3, 0.2};
    for (int i = 0; i < 4; i++) {
        EXPECT_LE(most[i], range[i]);
        EXPECT_GT(most[i], 0.9 * range[i]);
    }
}

TEST(Start, KeepsJointsWithinTheirStops) {
    settings s = left_locked();
    s.randomisation.joint_rad = 3;
    for (int episode = 1; episode <= 100; episode++) {
        RobotModel model = paper_robot();
        draw_start(model, s, episode);
        for (std::size_t a = 2; a < model.actuators.size(); a++) {
            EXPECT_GE(model.actuators[a].home, model.actuators[a].lower);
            EXPECT_LE(model.actuators[a].home, model.actuators[a].upper);
        }
    }
}

TEST(Start, PutsTheRobotThereAtRestOnAnyGround) {
    settings rough = put_anywhere(), uphill = put_anywhere();
    rough.ground.rough_amplitude_m = 0.08;
    uphill.ground.incline_along_rad = 0.2;
    for (const settings &s : {put_anywhere(), rough, uphill}) {
        World world(paper_robot(), s);
        for (int episode = 1; episode <= 3; episode++) {
            RobotModel model = paper_robot();
            const Start start = draw_start(model, s, episode);
            world.reset(episode);
            EXPECT_NEAR(position(world).x(), start.x, 1e-9);
            EXPECT_NEAR(position(world).y(), start.y, 1e-9);
            EXPECT_NEAR(heading(world), start.heading, 1e-9);
            EXPECT_EQ(world.robot().multibody().getJointPos(3), model.actuators[3].home);
            run(world, {}, 0.5);
            EXPECT_NEAR(position(world).x(), start.x, 0.01);
            EXPECT_NEAR(position(world).y(), start.y, 0.01);
        }
    }
}

}  // namespace
}  // namespace limphome
