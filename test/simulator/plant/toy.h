// A machine of a few lines, and a controller of a few lines on the bus of its plant (memq://, which stays in this
// process).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "limphome_channels.h"
#include "plant/loop.h"

namespace limphome {

using Rates = std::array<double, max_actuators>;
inline const Rates rest{};

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

inline settings lockstep() {
    settings s = settings_default();
    s.simulator.pace = SETTINGS_LOCKSTEP;
    return s;
}

inline settings real_time() {
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

}  // namespace limphome
