// The pace by itself, and a plant that is held up: a loop with a machine that counts its time steps (memq://).
#include "plant/pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <limphome/pose_t.hpp>

namespace limphome {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double free_pace = -1;  // pose_t.PACE_FREE

pace_t request(int8_t action, double pace = 0) {
    pace_t message{};
    message.action = action;
    message.pace = pace;
    return message;
}

// A pace to which everything so far was said at time 0.
struct Paced {
    Pace pace{true};
    Pace::Verdict say(int8_t action, double value = 0, double now = 0) {
        return pace.hear(request(action, value), now);
    }
};

TEST(Pace, IsFreeUntilSomebodySaysOtherwise) {
    Paced plant;
    EXPECT_TRUE(plant.pace.free());
    EXPECT_EQ(plant.pace.ahead(17), 0);
    EXPECT_EQ(plant.pace.told(), free_pace);
    EXPECT_EQ(pose_t::PACE_FREE, free_pace);
}

TEST(Pace, HoldsTimeStepsToTheClock) {
    Paced plant;
    plant.say(pace_t::RUN, 0.5, 10);
    EXPECT_FALSE(plant.pace.free());
    EXPECT_EQ(plant.pace.told(), 0.5);
    EXPECT_EQ(plant.pace.ahead(10), 0);
    plant.pace.go(0.005, 10);
    EXPECT_NEAR(plant.pace.ahead(10), 0.01, 1e-9);
    plant.pace.go(0.005, 10.015);  // 5 ms late, which is made up for
    EXPECT_NEAR(plant.pace.ahead(10.015), 0.005, 1e-9);
}

TEST(Pace, DoesNotHurryAfterAStall) {
    Paced plant;
    plant.say(pace_t::RUN, 1, 10);
    plant.pace.go(0.005, 14);
    double made_up = 0;
    while (plant.pace.ahead(14) <= 0) {
        plant.pace.go(0.005, 14);
        made_up += 0.005;
    }
    EXPECT_NEAR(made_up, 0.1, 0.006);
}

TEST(Pace, AStepLastsUntilTheNextState) {
    Paced plant;
    plant.say(pace_t::PAUSE);
    EXPECT_TRUE(plant.pace.paused());
    EXPECT_EQ(plant.pace.ahead(1), infinity);
    EXPECT_EQ(plant.pace.told(), 0);
    plant.say(pace_t::STEP);
    EXPECT_FALSE(plant.pace.paused());
    EXPECT_EQ(plant.pace.ahead(1), 0);
    plant.say(pace_t::STEP);  // is under way
    plant.pace.arrive();
    EXPECT_TRUE(plant.pace.paused());
    EXPECT_EQ(plant.pace.ahead(1), infinity);
}

TEST(Pace, AStepGoesAtThePaceOfBefore) {
    Paced plant;
    plant.say(pace_t::RUN, 2);
    plant.say(pace_t::PAUSE);
    plant.say(pace_t::STEP);
    EXPECT_EQ(plant.pace.told(), 2);
    plant.pace.go(0.1, 0);
    EXPECT_DOUBLE_EQ(plant.pace.ahead(0), 0.05);
    plant.say(pace_t::PAUSE);  // breaks it off
    EXPECT_TRUE(plant.pace.paused());
}

TEST(Pace, AStepOfWhatIsNotPausedIsNone) {
    Paced plant;
    plant.say(pace_t::STEP);
    plant.say(pace_t::PAUSE);
    EXPECT_TRUE(plant.pace.paused());
}

TEST(Pace, AResetIsTakenOnce) {
    Paced plant;
    EXPECT_FALSE(plant.pace.reset_requested());
    plant.say(pace_t::PAUSE);
    plant.say(pace_t::RESET);
    EXPECT_TRUE(plant.pace.reset_requested());
    EXPECT_TRUE(plant.pace.take_reset());
    EXPECT_FALSE(plant.pace.take_reset());
    EXPECT_TRUE(plant.pace.paused());
}

TEST(Pace, GoesOnOnceNobodyLooksAnyMore) {
    for (const int8_t held : {pace_t::PAUSE, pace_t::RUN}) {
        Paced plant;
        plant.say(held, 0.01, 10);
        plant.pace.pass(14.9);
        EXPECT_FALSE(plant.pace.free());
        plant.say(pace_t::KEEP, 0, 14.9);
        plant.pace.pass(19.8);
        EXPECT_FALSE(plant.pace.free());
        plant.pace.pass(19.95);
        EXPECT_TRUE(plant.pace.free());
        EXPECT_EQ(plant.pace.ahead(19.95), 0);
    }
}

TEST(Pace, RefusesWhatIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Paced plant;
    for (const double bad : {nan, infinity, -infinity}) {
        EXPECT_EQ(plant.say(pace_t::RUN, bad), Pace::Verdict::non_finite) << bad;
    }
    for (const double bad : {0.0, -0.5, -2.0, 0.009, 100.1, 1e300}) {
        EXPECT_EQ(plant.say(pace_t::RUN, bad), Pace::Verdict::malformed) << bad;
    }
    for (const int8_t bad : {int8_t{-1}, int8_t{5}, int8_t{127}}) {
        EXPECT_EQ(plant.say(bad, 1), Pace::Verdict::malformed) << int{bad};
    }
    EXPECT_TRUE(plant.pace.free());
    for (const double good : {0.01, 1.0, 100.0, free_pace}) {
        EXPECT_EQ(plant.say(pace_t::RUN, good), Pace::Verdict::taken) << good;
        EXPECT_EQ(plant.pace.told(), good);
    }
    EXPECT_EQ(plant.say(pace_t::PAUSE, nan), Pace::Verdict::taken);  // of which only RUN makes use
}

// What is refused is no sign of life either.
TEST(Pace, WhatIsRefusedKeepsNothingUp) {
    Paced plant;
    plant.say(pace_t::PAUSE, 0, 10);
    plant.say(pace_t::RUN, 0, 14);
    plant.say(17, 0, 14);
    plant.pace.pass(15);
    EXPECT_TRUE(plant.pace.free());
}

TEST(Pace, ThatOfAClockCannotBeChanged) {
    Pace pace(false);
    EXPECT_EQ(pace.told(), 1);
    pace.hear(request(pace_t::KEEP), 0);
    EXPECT_FALSE(pace.unheeded());
    for (const int8_t action : {pace_t::PAUSE, pace_t::STEP, pace_t::RESET}) {
        pace.hear(request(action), 0);
    }
    pace.hear(request(pace_t::RUN, 0.5), 0);
    EXPECT_TRUE(pace.unheeded());
    EXPECT_TRUE(pace.free());
    EXPECT_FALSE(pace.take_reset());
    EXPECT_EQ(pace.told(), 1);
}

}  // namespace
}  // namespace limphome
