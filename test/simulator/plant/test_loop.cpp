// The loop and the link with a machine of a few lines (toy.h). This program links neither Bullet nor Eigen.
#include "plant/loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "toy.h"

namespace limphome {
namespace {

TEST(Loop, InLockstepEachCommandLastsOneDecisionPeriod) {
    SimulatedToy toy;
    Plant plant(toy, lockstep());
    plant.controller.answer = [&plant](const robot_state_t &state) {
        plant.controller.command(state, {0.1, 0.2, 0.1 * static_cast<double>(state.seq)});
        plant.stop = state.seq == 3;
    };
    EXPECT_TRUE(plant.run());
    ASSERT_GE(plant.controller.states.size(), 4U);
    for (std::size_t i = 0; i < 4; i++) {
        const robot_state_t &state = plant.controller.states[i];
        EXPECT_EQ(state.seq, i);
        EXPECT_EQ(state.session, plant.controller.states[0].session);
        EXPECT_EQ(state.lockstep, 1);
        EXPECT_EQ(state.utime, 17);
        EXPECT_EQ(state.actuator_health[0], 1);
        EXPECT_EQ(state.actuator_health[1], 0);
        EXPECT_DOUBLE_EQ(state.actuator_position[0], 0.05 * static_cast<double>(i));
    }
    EXPECT_DOUBLE_EQ(plant.controller.states[3].actuator_position[2], 0.5 * (0.1 + 0.2));
    EXPECT_GE(toy.periods.size(), 3U);
    EXPECT_TRUE(std::all_of(toy.periods.begin(), toy.periods.end(), [](double period) { return period == 0.5; }));
    EXPECT_EQ(toy.commands.front(), rest);
    EXPECT_EQ(toy.commands.back(), rest);
    EXPECT_EQ(toy.episodes, std::vector<int64_t>{0});
}

TEST(Loop, TellsWhatOnlyASimulatorKnows) {
    SimulatedToy toy;
    Plant plant(toy, lockstep());
    plant.controller.answer = [&plant](const robot_state_t &) { plant.stop = 1; };
    plant.run();
    ASSERT_EQ(plant.controller.truths.size(), 2U);  // the session that began by itself has one as well
    EXPECT_EQ(plant.controller.truths[1].stability_margin, 0.25);
    EXPECT_EQ(plant.controller.truths[1].session, plant.controller.states[0].session);
    EXPECT_EQ(plant.controller.truths[1].utime, 17);
    ASSERT_FALSE(plant.controller.statuses.empty());
    EXPECT_EQ(plant.controller.statuses.back().condition, status_t::FINISHED);
    EXPECT_EQ(plant.controller.statuses.back().simulated_time, 11);
    EXPECT_EQ(plant.controller.statuses.back().saturated, 13);
}

TEST(Loop, ResetsTheMachineInANewSession) {
    SimulatedToy toy;
    Plant plant(toy, lockstep());
    plant.controller.answer = [&](const robot_state_t &state) {
        if (toy.episodes.size() == 2) {
            plant.stop = 1;
        } else if (state.seq == 1) {
            plant.controller.ask_for_reset(state, 7);
        } else {
            plant.controller.command(state, {0.1, 0.1, 0.1});
        }
    };
    EXPECT_TRUE(plant.run());
    EXPECT_EQ(toy.episodes, (std::vector<int64_t>{0, 7}));
    ASSERT_EQ(plant.controller.states.size(), 3U);
    EXPECT_GT(plant.controller.states[1].actuator_position[0], 0);
    EXPECT_NE(plant.controller.states[2].session, plant.controller.states[1].session);
    EXPECT_EQ(plant.controller.states[2].seq, 0);
    EXPECT_EQ(plant.controller.states[2].actuator_position[0], 0);
}

// Does so whenever it has been told to move.
class DivergingToy : public SimulatedToy {
   public:
    bool diverged() const override { return place != rest; }
};

TEST(Loop, ReportsAMachineThatDivergesAndGivesUpInTheEnd) {
    DivergingToy toy;
    Plant plant(toy, lockstep());
    plant.controller.answer = [&plant](const robot_state_t &state) { plant.controller.command(state, {0.1}); };
    EXPECT_FALSE(plant.run());
    EXPECT_EQ(plant.controller.states.size(), 10U);
    for (const robot_state_t &state : plant.controller.states) {
        EXPECT_EQ(state.seq, 0);
        EXPECT_EQ(state.actuator_position[0], 0);
    }
    const auto faults = std::count_if(plant.controller.statuses.begin(), plant.controller.statuses.end(),
                                      [](const status_t &status) { return status.condition == status_t::FAULT; });
    EXPECT_EQ(faults, 10);
    EXPECT_EQ(plant.controller.statuses.back().faults, 10);
    EXPECT_EQ(toy.episodes, std::vector<int64_t>(19, 0));  // as the controller asked, and after each fault but the last
    EXPECT_EQ(toy.commands.back(), rest);
}

TEST(Loop, RefusesLockstepWithAMachineThatCannotPause) {
    Toy toy;
    Link link("memq://", lockstep(), toy.num_actuators());
    try {
        Loop(toy, link, lockstep());
        FAIL() << "was not refused";
    } catch (const std::runtime_error &error) {
        EXPECT_NE(std::string(error.what()).find("pace = lockstep"), std::string::npos) << error.what();
    }
}

// A command is obeyed as it is, then too old: down to rest, and never up again.
TEST(Loop, InRealTimeASilentControllerLetsTheMachineComeToRest) {
    class Moving : public Toy {
       public:
        explicit Moving(volatile std::sig_atomic_t *stop) : stop_(stop) {}
        void command(const double velocity[max_actuators]) override {
            Toy::command(velocity);
            moved_ = moved_ || velocity[0] > 0;
            *stop_ = moved_ && velocity[0] == 0 ? 1 : 0;
        }

       private:
        volatile std::sig_atomic_t *stop_;
        bool moved_ = false;
    };
    volatile std::sig_atomic_t at_rest = 0;
    Moving toy(&at_rest);
    bool answered = false;
    Plant plant(toy, real_time());
    plant.controller.answer = [&](const robot_state_t &state) {
        EXPECT_EQ(state.lockstep, 0);
        plant.controller.arm(state);
        if (state.armed == 1 && !answered) {
            plant.controller.command(state, {0.25, -0.2, 0.1});
            answered = true;
        }
        plant.stop = at_rest;
    };
    EXPECT_TRUE(plant.run());
    const auto fastest = std::max_element(toy.commands.begin(), toy.commands.end());
    EXPECT_EQ(*fastest, (Rates{0.25, -0.2, 0.1}));
    EXPECT_TRUE(std::is_sorted(fastest, toy.commands.end(), std::greater<>()));
    EXPECT_EQ(toy.commands.back(), rest);
    EXPECT_EQ(plant.controller.states.back().held, 1);
    EXPECT_EQ(plant.controller.statuses.back().simulated_time, 0);
    EXPECT_TRUE(plant.controller.truths.empty());
}

TEST(Loop, InRealTimeAMachineThatDoesNotKeepUpObeysAllTheSame) {
    class Slow : public Toy {
       public:
        explicit Slow(volatile std::sig_atomic_t *stop) : stop_(stop) {}
        void advance(double seconds) override {
            std::this_thread::sleep_for(std::chrono::duration<double>(2 * seconds));
            *stop_ = ++slices_ >= 30 ? 1 : 0;
        }

       private:
        volatile std::sig_atomic_t *stop_;
        int slices_ = 0;
    };
    volatile std::sig_atomic_t over = 0;
    Slow toy(&over);
    settings s = real_time();
    s.link.command_timeout_s = 10;
    Plant plant(toy, s);
    plant.controller.answer = [&plant](const robot_state_t &state) {
        plant.controller.arm(state);
        plant.controller.command(state, {0.2});
    };
    EXPECT_TRUE(plant.loop.run(&over));
    EXPECT_NE(std::find(toy.commands.begin(), toy.commands.end(), Rates{0.2}), toy.commands.end());
}

// Once it has moved, its readings cannot be trusted until it is reset.
class FailingToy : public Toy {
   public:
    void reset(int64_t episode) override {
        Toy::reset(episode);
        failed_ = false;
    }
    void command(const double velocity[max_actuators]) override {
        Toy::command(velocity);
        failed_ = failed_ || velocity[0] > 0;
    }
    bool diverged() const override { return failed_; }

   private:
    bool failed_ = false;
};

TEST(Loop, InRealTimeAFaultDisarms) {
    FailingToy toy;
    Plant plant(toy, real_time());
    bool was_armed = false;
    plant.controller.answer = [&](const robot_state_t &state) {
        was_armed = was_armed || state.armed == 1;
        if (was_armed && state.armed == 0) {
            plant.stop = 1;
        } else {
            plant.controller.arm(state);
            plant.controller.command(state, {0.2});
        }
    };
    EXPECT_TRUE(plant.run());
    EXPECT_EQ(plant.controller.states.back().armed, 0);
    EXPECT_EQ(plant.link.arming().reason(), status_t::MACHINE_FAILED);
    EXPECT_EQ(plant.controller.statuses.back().faults, 1);
}

// What was commanded before it was disarmed is not gone on with, however soon it is armed again.
TEST(Loop, InRealTimeArmingBeginsAtRest) {
    Toy toy;
    settings s = real_time();
    s.link.command_timeout_s = 10;
    Plant plant(toy, s);
    std::size_t rearmed = 0;
    plant.controller.answer = [&](const robot_state_t &state) {
        const bool moving = toy.commands.back()[0] > 0.1;
        if (moving && rearmed == 0) {
            plant.link.arming().disarm(status_t::BY_OPERATOR, monotonic_now());
            rearmed = toy.commands.size() + 5;
        } else if (rearmed == 0 || state.armed == 0) {
            plant.controller.arm(state);
            if (rearmed == 0) {
                plant.controller.command(state, {0.2});
            }
        }
        plant.stop = rearmed > 0 && toy.commands.size() > rearmed + 20 ? 1 : 0;
    };
    EXPECT_TRUE(plant.run());
    EXPECT_TRUE(plant.link.arming().armed());
    ASSERT_GT(toy.commands.size(), rearmed + 20);
    EXPECT_EQ(toy.commands[rearmed + 20], rest);
}

// Nobody carries it back: only a fault has it made fit again.
TEST(Loop, AMachineThatStaysIsResetAfterAFaultAlone) {
    class Staying : public DivergingToy {
       public:
        bool can_be_carried_back() const override { return false; }
    };
    Staying toy;
    Plant plant(toy, lockstep());
    int sessions = 0;
    plant.controller.answer = [&](const robot_state_t &state) {
        EXPECT_EQ(state.reset, robot_state_t::WHERE_IT_IS);
        if (++sessions < 4) {
            plant.controller.ask_for_reset(state, 5);
        } else {
            EXPECT_EQ(toy.episodes.empty(), sessions == 4);
            plant.controller.command(state, {0.1});
            plant.stop = sessions == 6 ? 1 : 0;
        }
    };
    EXPECT_TRUE(plant.run());
    EXPECT_FALSE(toy.episodes.empty());
}

TEST(Loop, MachineIsAtRestWhateverEndsTheLoop) {
    class Broken : public SimulatedToy {
       public:
        void advance(double) override { throw std::runtime_error("a fuse has blown"); }
    };
    Broken toy;
    Plant plant(toy, lockstep());
    plant.controller.answer = [&plant](const robot_state_t &state) { plant.controller.command(state, {0.2}); };
    EXPECT_THROW(plant.run(), std::runtime_error);
    ASSERT_GE(toy.commands.size(), 3U);
    EXPECT_EQ(toy.commands[toy.commands.size() - 2], Rates{0.2});
    EXPECT_EQ(toy.commands.back(), rest);
}

TEST(Loop, TellsWhatWentWrongFirst) {
    class Unplugged : public SimulatedToy {
       public:
        void advance(double) override {
            unplugged_ = true;
            throw std::runtime_error("the cable is out");
        }
        void command(const double velocity[max_actuators]) override {
            if (unplugged_) {
                throw std::runtime_error("no answer");
            }
            SimulatedToy::command(velocity);
        }

       private:
        bool unplugged_ = false;
    };
    Unplugged toy;
    Plant plant(toy, lockstep());
    plant.controller.answer = [&plant](const robot_state_t &state) { plant.controller.command(state, {0.2}); };
    try {
        plant.run();
        FAIL() << "nothing was told";
    } catch (const std::runtime_error &error) {
        EXPECT_STREQ(error.what(), "the cable is out");
    }
}

}  // namespace
}  // namespace limphome
