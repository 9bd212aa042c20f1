// A plant with a person at a viewer: what it shows, and how it is held up. The machine is one of a few lines (toy.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <limphome/pace_t.hpp>
#include <limphome/pose_t.hpp>
#include <map>
#include <string>
#include <vector>

#include "limphome_channels.h"
#include "toy.h"

namespace limphome {
namespace {

// Ten time steps make a decision period; it senses wrongly, but knows better.
class SteppingToy : public SimulatedToy {
   public:
    static constexpr int steps_of_a_period = 10;

    void reset(int64_t episode) override {
        SimulatedToy::reset(episode);
        steps = 0;
    }
    void advance_asking(double seconds, const std::function<bool(double)> &may_step) override {
        for (int i = 0; i < steps_of_a_period && may_step(seconds / steps_of_a_period); i++) {
            advance(seconds / steps_of_a_period);
            steps++;
        }
    }
    void sense(robot_state_t &state) override {
        exact(state);
        state.position[0] = 4;
        sensed++;
    }
    bool exact(robot_state_t &state) const override {
        state.utime = steps;
        state.num_actuators = 3;
        state.position[0] = 3;
        return true;
    }

    int64_t steps = 0;  // since the last reset
    int sensed = 0;
};

// Sees the poses of a plant, and tells it how fast to go; what it does at each is up to the test.
class Viewer {
   public:
    explicit Viewer(Link &link) : bus_(link.bus()) { bus_.subscribe(LIMPHOME_CHANNEL_POSE, &Viewer::see, this); }

    void say(int8_t action, double pace = 0) {
        pace_t message{};
        message.action = action;
        message.pace = pace;
        bus_.publish(LIMPHOME_CHANNEL_PACE, &message);
    }

    std::function<void(const pose_t &)> at_each = [](const pose_t &) {};
    std::vector<pose_t> poses;

   private:
    void see(const lcm::ReceiveBuffer *, const std::string &, const pose_t *pose) {
        poses.push_back(*pose);
        at_each(*pose);
    }

    Bus &bus_;
};

struct Watched : Plant {
    Watched(Machine &machine, const settings &s) : Plant(machine, s), viewer(link) {
        controller.answer = [this](const robot_state_t &state) { controller.command(state, {0.1}); };
    }

    Viewer viewer;
};

TEST(Watched, APoseIsExactAndOfNow) {
    SteppingToy toy;
    Watched plant(toy, lockstep());
    plant.viewer.at_each = [&plant](const pose_t &pose) { plant.stop = pose.seq > 0 ? 1 : 0; };
    EXPECT_TRUE(plant.run());
    const pose_t &pose = plant.viewer.poses.back();
    EXPECT_EQ(pose.position[0], 3);
    EXPECT_EQ(pose.utime, SteppingToy::steps_of_a_period * pose.seq);
    EXPECT_EQ(pose.session, plant.controller.states.back().session);
    EXPECT_EQ(pose.num_actuators, 3);
    EXPECT_EQ(pose.actuator_health[0], 1);
    EXPECT_EQ(pose.pace, pose_t::PACE_FREE);
    EXPECT_EQ(pose.has_truth, 1);
    EXPECT_EQ(pose.truth.stability_margin, 0.25);
    EXPECT_EQ(pose.truth.session, pose.session);
    EXPECT_EQ(pose.truth.seq, pose.seq);
    EXPECT_EQ(pose.truth.utime, pose.utime);
}

// Who looks draws none of the sensors' errors, and seldom gets more than one pose out of many decisions.
TEST(Watched, PosesCostNoReadingAndAreRare) {
    SteppingToy toy;
    Watched plant(toy, lockstep());
    const double begun = monotonic_now();
    plant.viewer.at_each = [&](const pose_t &) { plant.stop = plant.viewer.poses.size() == 5 ? 1 : 0; };
    EXPECT_TRUE(plant.run());
    EXPECT_GE(monotonic_now() - begun, 4.0 / 30);
    EXPECT_EQ(toy.sensed, plant.controller.states.size() + 1);  // one of nobody's session
    EXPECT_GT(plant.controller.states.size(), plant.viewer.poses.size());
}

// Of a real machine, the newest reading is shown.
TEST(Watched, AMachineThatKnowsNoMoreThanItsSensorsIsShownAsTheyTell) {
    Toy toy;
    Watched plant(toy, real_time());
    plant.viewer.at_each = [&](const pose_t &) { plant.stop = plant.viewer.poses.size() == 4 ? 1 : 0; };
    EXPECT_TRUE(plant.run());
    const pose_t &pose = plant.viewer.poses.back();
    EXPECT_EQ(pose.utime, 17);
    EXPECT_EQ(pose.num_actuators, 3);
    EXPECT_EQ(pose.pace, 1);
    EXPECT_EQ(pose.has_truth, 0);
    EXPECT_GT(pose.seq, 0);
}

TEST(Watched, WhatHasDivergedIsNotShown) {
    class Diverging : public SteppingToy {
       public:
        bool diverged() const override { return place != rest; }
    };
    Diverging toy;
    Watched plant(toy, lockstep());
    EXPECT_FALSE(plant.run());
    for (const pose_t &pose : plant.viewer.poses) {
        EXPECT_EQ(pose.seq, 0);
        EXPECT_EQ(pose.utime, 0);
    }
}

// The viewer's script: what to do at the n-th pose.
using Script = std::map<std::size_t, std::function<void()>>;

void follow(Viewer &viewer, const Script &script) {
    viewer.at_each = [&viewer, script](const pose_t &) {
        const auto act = script.find(viewer.poses.size());
        if (act != script.end()) {
            act->second();
        }
    };
}

TEST(Watched, StandsStillGoesOnForADecisionAndStandsStillAgain) {
    SteppingToy toy;
    Watched plant(toy, lockstep());
    Viewer &viewer = plant.viewer;
    std::vector<int64_t> steps;
    const auto note = [&] { steps.push_back(toy.steps); };
    follow(viewer, {{1, [&] { viewer.say(pace_t::PAUSE); }},
                    {3, note},
                    {5, note},
                    {6, [&] { viewer.say(pace_t::STEP); }},
                    {8, note},
                    {9, [&] { viewer.say(pace_t::RUN, pose_t::PACE_FREE); }},
                    {12, [&] { plant.stop = 1; }}});
    EXPECT_TRUE(plant.run());
    ASSERT_EQ(steps.size(), 3U);
    EXPECT_EQ(steps[1], steps[0]);
    EXPECT_EQ(steps[2], steps[1] + SteppingToy::steps_of_a_period);
    EXPECT_GT(toy.steps, steps[2]);
    EXPECT_EQ(viewer.poses[4].pace, 0);
    EXPECT_EQ(viewer.poses[4].utime, steps[1]);
    EXPECT_EQ(viewer.poses.back().pace, pose_t::PACE_FREE);
}

// Half a second of plant time takes five of the wall's: there is time to stop within it.
TEST(Watched, StandsStillWithinADecisionPeriodAndBothSidesShowThatTheyLive) {
    SteppingToy toy;
    settings s = lockstep();
    s.link.sender_timeout_s = 0.2;
    Watched plant(toy, s);
    Viewer &viewer = plant.viewer;
    std::size_t states = 0;
    int64_t steps = 0, duplicates = 0;
    follow(viewer, {{1, [&] { viewer.say(pace_t::RUN, 0.5); }},
                    {8, [&] { viewer.say(pace_t::PAUSE); }},
                    {10,
                     [&] {
                         steps = toy.steps;
                         states = plant.controller.states.size();
                         duplicates = plant.link.counts().duplicates;
                     }},
                    {25, [&] {
                         EXPECT_EQ(toy.steps, steps);
                         EXPECT_GE(plant.controller.states.size(), states + 5);  // half a second, each 0.05 s
                         EXPECT_GE(plant.link.counts().duplicates, duplicates + 5);
                         EXPECT_EQ(plant.controller.states.back().seq, plant.controller.states[states - 1].seq);
                         plant.stop = 1;
                     }}});
    EXPECT_TRUE(plant.run());
    EXPECT_NE(steps % SteppingToy::steps_of_a_period, 0);
    EXPECT_EQ(plant.controller.statuses.back().condition, status_t::FINISHED);
    const auto held =
        std::count_if(plant.controller.statuses.begin(), plant.controller.statuses.end(), [](const status_t &status) {
            return status.reason == status_t::PACED && status.condition == status_t::WAITING;
        });
    EXPECT_GE(held, 1);  // told at once, not after up to a second
}

TEST(Watched, ANewSessionIsNobodysAndStaysPaused) {
    SteppingToy toy;
    Watched plant(toy, lockstep());
    Viewer &viewer = plant.viewer;
    int64_t session = 0;
    follow(viewer, {{2, [&] { viewer.say(pace_t::PAUSE); }},
                    {4,
                     [&] {
                         session = plant.link.session();
                         viewer.say(pace_t::RESET);
                     }},
                    {8, [&] { plant.stop = 1; }}});
    EXPECT_TRUE(plant.run());
    const auto told = std::find_if(plant.controller.statuses.begin(), plant.controller.statuses.end(),
                                   [](const status_t &status) { return status.reason == status_t::BEGUN_ANEW; });
    ASSERT_NE(told, plant.controller.statuses.end());
    EXPECT_EQ(told->session, session);
    EXPECT_NE(plant.link.session(), session);
    EXPECT_TRUE(plant.link.owned());  // the controller has asked for one of its own
    EXPECT_EQ(plant.link.seq(), 0);
    EXPECT_EQ(toy.steps, 0);
    EXPECT_EQ(viewer.poses.back().pace, 0);
}

// A controller that was started again while the plant stands still is not kept waiting.
TEST(Watched, AnotherTakesThePlantOverWhileItIsPaused) {
    SteppingToy toy;
    settings s = lockstep();
    s.link.sender_timeout_s = 0.1;
    Watched plant(toy, s);
    Viewer &viewer = plant.viewer;
    follow(viewer, {{2, [&] { viewer.say(pace_t::PAUSE); }},
                    {4, [&] { plant.controller.answer = [](const robot_state_t &) {}; }},  // its owner dies
                    {10,
                     [&] {
                         reset_request_t request{};
                         request.session = plant.link.session();
                         request.sender = 77;
                         request.nonce = 1;
                         plant.link.bus().publish(LIMPHOME_CHANNEL_RESET, &request);
                     }},
                    {12, [&] { plant.stop = 1; }}});
    const int64_t sessions_before = static_cast<int64_t>(toy.episodes.size());
    EXPECT_TRUE(plant.run());
    EXPECT_GE(static_cast<int64_t>(toy.episodes.size()), sessions_before + 2);
    EXPECT_EQ(toy.steps, 0);
}

TEST(Watched, RefusesAndCountsWhatIsNoPace) {
    SteppingToy toy;
    Watched plant(toy, lockstep());
    Viewer &viewer = plant.viewer;
    follow(viewer, {{1,
                     [&] {
                         viewer.say(pace_t::RUN, std::numeric_limits<double>::quiet_NaN());
                         viewer.say(pace_t::RUN, 0);
                         viewer.say(17);
                     }},
                    {3, [&] { plant.stop = 1; }}});
    EXPECT_TRUE(plant.run());
    EXPECT_EQ(plant.link.counts().rejected_non_finite, 1);
    EXPECT_EQ(plant.link.counts().rejected_malformed, 2);
    EXPECT_EQ(viewer.poses.back().pace, pose_t::PACE_FREE);
}

TEST(Watched, APlantInRealTimeGoesOn) {
    Toy toy;
    Watched plant(toy, real_time());
    Viewer &viewer = plant.viewer;
    testing::internal::CaptureStderr();
    follow(viewer, {{1, [&] { viewer.say(pace_t::PAUSE); }},
                    {2, [&] { viewer.say(pace_t::RESET); }},
                    {5, [&] { plant.stop = 1; }}});
    EXPECT_TRUE(plant.run());
    const std::string words = testing::internal::GetCapturedStderr();
    EXPECT_NE(words.find("is not heeded"), std::string::npos) << words;
    EXPECT_EQ(words.find("is not heeded"), words.rfind("is not heeded")) << words;
    EXPECT_GT(viewer.poses.back().seq, viewer.poses[1].seq);
}

}  // namespace
}  // namespace limphome
