// The plant's half of the link: states out, commands and reset requests in, each checked, counted and, where it
// belongs to a past session or another sender, dropped.
#pragma once

#include <settings.h>

#include <limphome/ground_truth_t.hpp>
#include <limphome/reset_request_t.hpp>
#include <limphome/robot_state_t.hpp>
#include <limphome/status_t.hpp>
#include <limphome/velocity_command_t.hpp>
#include <optional>
#include <string>

#include "plant/bus.h"

namespace limphome {

// Monotonic clock [s].
double monotonic_now();

class Link {
   public:
    // Joins the bus; throws std::runtime_error if it cannot. An empty url means LCM's default.
    Link(const std::string &url, const settings &s, int num_actuators);

    // Begins a new session: forgets what was received, numbers states from 0 again.
    void begin_session();

    // Puts a new state on the bus, filling in session and seq.
    void send_state(robot_state_t state);
    // Puts the newest state on the bus again if it has been unanswered for the resend interval. Not at every message
    // that does not answer it: a late repetition would then breed repetitions for ever.
    void resend_state_if_due();
    void send_truth(ground_truth_t truth);
    void send_status(status_t status);

    // Waits at most `timeout` [s] and takes in all messages that are there. Throws std::runtime_error if the bus
    // breaks.
    void wait(double timeout);

    // The newest command, once, that may be obeyed: of this session and sender and, in lockstep, for the newest state.
    std::optional<velocity_command_t> take_command();
    // Whether a reset of this session was asked for since the session began.
    bool reset_requested() const { return reset_requested_; }
    // The episode that the newest request was for.
    int32_t requested_episode() const { return requested_episode_; }

    // Of the newest state sent.
    int64_t session() const { return state_.session; }
    int64_t seq() const { return state_.seq; }
    const status_t &counts() const { return counts_; }
    double wait_time() const { return wait_time_; }
    // For what else the program has to say or hear.
    Bus &bus() { return lcm_; }

   private:
    void receive_command(const lcm::ReceiveBuffer *buffer, const std::string &channel);
    void receive_reset(const lcm::ReceiveBuffer *buffer, const std::string &channel);
    bool accept_sender(int64_t sender);

    Bus lcm_;
    const bool lockstep_;
    const double resend_;          // [s]
    const double sender_timeout_;  // [s]
    const int num_actuators_;

    robot_state_t state_{};  // newest state sent
    double state_sent_ = 0;  // when [s, monotonic]
    int64_t next_seq_ = 0;
    int64_t session_ = 0;
    int64_t sender_ = 0;  // the one obeyed
    double sender_heard_;
    std::optional<velocity_command_t> command_;
    int64_t answered_ = -1;  // newest seq whose command was handed out
    bool reset_requested_ = false;
    int32_t requested_episode_ = 0;
    status_t counts_{};
    double wait_time_ = 0;
};

}  // namespace limphome
