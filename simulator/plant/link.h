// The plant's half of the link: states out, commands, reset, arm and pace requests in, each checked, counted and, where
// it belongs to a past session, to another sender or to a state that is too old, dropped.
//
// A session is owned by the sender that asked for it, and obeys nobody else; one that began by itself, when the plant
// started or after a fault, obeys nobody. So a controller asks for a reset before it is obeyed. Who owned a session
// last asks first: another's request is taken only once that one has been silent for [link] sender_timeout_s.
#pragma once

#include <settings.h>

#include <deque>
#include <limphome/arm_request_t.hpp>
#include <limphome/ground_truth_t.hpp>
#include <limphome/pose_t.hpp>
#include <limphome/reset_request_t.hpp>
#include <limphome/robot_state_t.hpp>
#include <limphome/status_t.hpp>
#include <limphome/velocity_command_t.hpp>
#include <optional>
#include <string>

#include "plant/arming.h"
#include "plant/bus.h"
#include "plant/pace.h"

namespace limphome {

// Monotonic clock [s].
double monotonic_now();

// A command to be obeyed, and when the state that it answers was sent [s, monotonic]: its age counts from there.
struct TimedCommand {
    velocity_command_t command;
    double born;
};

class Link {
   public:
    // Joins the bus; throws std::runtime_error if it cannot. An empty url means LCM's default.
    Link(const std::string &url, const settings &s, int num_actuators);

    // Begins a new session, which `request` has asked for, or which nobody has: forgets what was received, numbers
    // states from 0 again.
    void begin_session(const std::optional<reset_request_t> &request);

    // Puts a new state on the bus, filling in all that is about the link.
    void send_state(robot_state_t state);
    // Puts the newest state on the bus again if it has been unanswered for the resend interval. Not at every message
    // that does not answer it: a late repetition would then breed repetitions for ever.
    void resend_state_if_due();
    // The same four times within the sender's timeout, answered or not, while a decision period is held up: its owner,
    // which answers again, hears that the plant lives, and the plant that its owner does.
    void show_life();
    void send_truth(ground_truth_t truth);
    void send_pose(pose_t pose);
    void send_status(status_t status);

    // Waits at most `timeout` [s] and takes in the messages that are there, but only so many at once that the caller
    // gets on under a flood. Throws std::runtime_error if the bus breaks.
    void wait(double timeout);

    // The newest command, once, that may be obeyed: of the session's owner, for the newest state in lockstep, for one
    // that is not too old and told the plant to be armed in real time.
    std::optional<TimedCommand> take_command();
    // Whether a reset of this session was asked for by who may.
    bool reset_requested() const { return request_.has_value(); }
    // That request, once.
    std::optional<reset_request_t> take_reset();

    // Whether the plant may move. Call pass() often: there silence disarms.
    Arming &arming() { return arming_; }
    void pass();
    // The plant has heard nobody for so long [s], nor could it have.
    void excuse(double seconds);

    // How fast time is to go, in lockstep.
    Pace &pace() { return pace_; }

    const robot_state_t &newest() const { return state_; }  // state sent
    int64_t session() const { return state_.session; }
    int64_t seq() const { return state_.seq; }
    // Whether a controller owns the session.
    bool owned() const { return session_sender_ != 0; }
    // The newest state whose command was handed out; -1: none of this session.
    int64_t answered() const { return answered_; }
    const status_t &counts() const { return counts_; }
    double wait_time() const { return wait_time_; }
    // For what else the program has to say or hear.
    Bus &bus() { return lcm_; }

   private:
    // What is remembered of a state: a command that answers it is judged by that.
    struct Sent {
        int64_t seq;
        double at;  // [s, monotonic]
        bool armed;
    };

    void publish_state();
    void repeat_state(double interval);
    void receive_command(const lcm::ReceiveBuffer *buffer, const std::string &channel);
    void receive_reset(const lcm::ReceiveBuffer *buffer, const std::string &channel);
    void receive_arm(const lcm::ReceiveBuffer *buffer, const std::string &channel);
    void receive_pace(const lcm::ReceiveBuffer *buffer, const std::string &channel);
    bool is_sound(const lcm::ReceiveBuffer *buffer, velocity_command_t &command);
    bool is_ours(const velocity_command_t &command);
    const Sent *answered_state(int64_t seq, double now) const;
    bool owner_is_silent(double now) const { return now - owner_heard_ >= sender_timeout_; }
    void limit(velocity_command_t &command);

    Bus lcm_;
    const bool lockstep_;
    const double resend_;           // [s]
    const double sender_timeout_;   // [s]
    const double command_timeout_;  // [s]
    const double crawler_speed_;    // as the controller rounds it [m/s]
    const double joint_speed_;      // as the controller rounds it [rad/s]
    const int num_actuators_;

    robot_state_t state_{};  // newest state sent
    double state_sent_ = 0;  // when [s, monotonic]
    std::deque<Sent> sent_;  // of this session, from the oldest that a command may answer
    int64_t next_seq_ = 0;
    int64_t session_ = 0;
    int64_t session_sender_ = 0;  // who owns the session; 0: nobody
    int64_t session_nonce_ = 0;
    int64_t owner_ = 0;  // who owned one last; 0: nobody yet
    double owner_heard_;
    std::optional<TimedCommand> command_;
    int64_t answered_ = -1;
    std::optional<reset_request_t> request_;
    Arming arming_;
    Pace pace_;
    status_t counts_{};
    double wait_time_ = 0;
};

}  // namespace limphome
