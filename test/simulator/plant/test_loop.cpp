// The loop and the link with a machine of a few lines, and a controller of a few lines on the same bus (memq://, which
// stays in this process). This program links neither Bullet nor Eigen.
#include "plant/loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "limphome_channels.h"

namespace limphome {
namespace {

using Rates = std::array<double, max_actuators>;
const Rates rest{};

// Three actuators that do at once what they are told.
class Toy : public Machine {
   public:
    int num_actuators() const override { return 3; }
    void reset(int64_t episode) override {
        EXPECT_EQ(commands.back(), rest);
        episodes.push_back(episode);
        place = {};
    }
    void command(const double velocity[max_actuators]) override {
        Rates rates;
        std::copy(velocity, velocity + max_actuators, rates.begin());
        commands.push_back(rates);
    }
    void sense(robot_state_t &state) override {
        state.utime = 17;
        state.num_actuators = 3;
        std::copy(place.begin(), place.end(), state.actuator_position);
    }
    Health health(int actuator) const override { return actuator == 0 ? Health::failed : Health::obeys; }

    Rates place{};
    std::vector<Rates> commands;
    std::vector<int64_t> episodes;
};

// Its time is its own.
class SimulatedToy : public Toy {
   public:
    void advance(double seconds) override {
        periods.push_back(seconds);
        for (std::size_t a = 0; a < place.size(); a++) {
            place[a] += seconds * commands.back()[a];
        }
    }
    bool can_pause() const override { return true; }
    double simulated_time() const override { return 11; }
    int64_t saturated() const override { return 13; }
    bool truth(ground_truth_t &truth) const override {
        truth.stability_margin = 0.25;
        return true;
    }

    std::vector<double> periods;
};

settings lockstep() {
    settings s = settings_default();
    s.simulator.pace = SETTINGS_LOCKSTEP;
    return s;
}

settings real_time() {
    settings s = settings_default();
    s.simulator.pace = SETTINGS_REAL_TIME;
    s.episode.decision_period_s = 0.02;
    s.link.command_timeout_s = 0.05;
    return s;
}

// Hears all that a plant says, and asks for a reset of each session that began by itself; what it answers in those that
// it has asked for is up to the test.
class Controller {
   public:
    explicit Controller(Link &link) : bus_(link.bus()) {
        bus_.subscribe(LIMPHOME_CHANNEL_STATE, &Controller::hear_state, this);
        bus_.subscribe(LIMPHOME_CHANNEL_TRUTH, &Controller::hear_truth, this);
        bus_.subscribe(LIMPHOME_CHANNEL_STATUS, &Controller::hear_status, this);
    }

    void command(const robot_state_t &state, const Rates &rates) {
        velocity_command_t command{};
        command.session = state.session;
        command.seq = state.seq;
        command.sender = sender;
        command.num_actuators = state.num_actuators;
        std::copy(rates.begin(), rates.end(), command.velocity);
        bus_.publish(LIMPHOME_CHANNEL_COMMAND, &command);
    }
    void ask_for_reset(const robot_state_t &state, int32_t episode) {
        reset_request_t request{};
        request.session = state.session;
        request.seq = state.seq;
        request.sender = sender;
        request.nonce = ++nonce_;
        request.episode = episode;
        bus_.publish(LIMPHOME_CHANNEL_RESET, &request);
    }

    // Arms the plant, or keeps it armed.
    void arm(const robot_state_t &state) {
        arm_request_t request{};
        request.sender = operator_sender;
        request.challenge = state.challenge;
        request.action = state.armed == 1 ? arm_request_t::KEEP : arm_request_t::ARM;
        bus_.publish(LIMPHOME_CHANNEL_ARM, &request);
    }

    static constexpr int64_t sender = 1;
    static constexpr int64_t operator_sender = 2;
    std::function<void(const robot_state_t &)> answer;
    std::vector<robot_state_t> states;  // of sessions that were asked for
    std::vector<ground_truth_t> truths;
    std::vector<status_t> statuses;

   private:
    void hear_state(const lcm::ReceiveBuffer *, const std::string &, const robot_state_t *state) {
        if (state->reset_sender != sender) {
            ask_for_reset(*state, 0);
            return;
        }
        states.push_back(*state);
        answer(*state);
    }
    void hear_truth(const lcm::ReceiveBuffer *, const std::string &, const ground_truth_t *truth) {
        truths.push_back(*truth);
    }
    void hear_status(const lcm::ReceiveBuffer *, const std::string &, const status_t *status) {
        statuses.push_back(*status);
    }

    Bus &bus_;
    int64_t nonce_ = 0;
};

// A plant with its controller.
struct Plant {
    Plant(Machine &machine, const settings &s)
        : link("memq://", s, machine.num_actuators()), loop(machine, link, s), controller(link) {}

    bool run() {
        const bool sound = loop.run(&stop);
        link.wait(0);  // hears the last words
        return sound;
    }

    Link link;
    Loop loop;
    Controller controller;
    volatile std::sig_atomic_t stop = 0;
};

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
