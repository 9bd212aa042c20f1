#include "plant/link.h"

#include <limphome_channels.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "plant/capacity.h"

namespace limphome {

double monotonic_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

namespace {

constexpr int crawlers = 2;         // the first actuators
constexpr int most_messages = 128;  // handled at once: some 0.3 ms

// Of the system call that has just failed.
std::string reason() {
    return std::generic_category().message(errno);
}

template <typename Message>
bool decode_exactly(const lcm::ReceiveBuffer *buffer, Message &message) {
    const int size = static_cast<int>(buffer->data_size);
    return message.decode(buffer->data, 0, size) == size;
}

// The controller computes in single precision: what it takes for the speed of [action].
double as_commanded(double speed) {
    return static_cast<double>(static_cast<float>(speed));
}

}  // namespace

Link::Link(const std::string &url, const settings &s, int num_actuators)
    : lcm_(url),
      lockstep_(s.simulator.pace == SETTINGS_LOCKSTEP),
      resend_(s.link.resend_s),
      sender_timeout_(s.link.sender_timeout_s),
      command_timeout_(s.link.command_timeout_s),
      crawler_speed_(as_commanded(s.action.crawler_speed)),
      joint_speed_(as_commanded(s.action.joint_speed)),
      num_actuators_(num_actuators),
      owner_heard_(-std::numeric_limits<double>::infinity()),
      arming_(!lockstep_, s.link.operator_timeout_s),
      pace_(lockstep_) {
    lcm_.subscribe(LIMPHOME_CHANNEL_COMMAND, &Link::receive_command, this);
    lcm_.subscribe(LIMPHOME_CHANNEL_RESET, &Link::receive_reset, this);
    lcm_.subscribe(LIMPHOME_CHANNEL_ARM, &Link::receive_arm, this);
    lcm_.subscribe(LIMPHOME_CHANNEL_PACE, &Link::receive_pace, this);
    begin_session(std::nullopt);
}

void Link::begin_session(const std::optional<reset_request_t> &request) {
    session_ = random_number();
    session_sender_ = request ? request->sender : 0;
    session_nonce_ = request ? request->nonce : 0;
    next_seq_ = 0;
    answered_ = -1;
    sent_.clear();
    command_.reset();
    request_.reset();
}

void Link::send_state(robot_state_t state) {
    state.session = session_;
    state.seq = next_seq_++;
    state.reset_sender = session_sender_;
    state.reset_nonce = session_nonce_;
    state.lockstep = lockstep_ ? 1 : 0;
    state.armed = arming_.armed() ? 1 : 0;
    state.challenge = arming_.challenge();
    state_ = state;
    publish_state();
    sent_.push_back({state_.seq, state_sent_, arming_.armed()});
    while (lockstep_ ? sent_.size() > 1 : sent_.front().at < state_sent_ - command_timeout_) {
        sent_.pop_front();
    }
}

void Link::publish_state() {
    state_sent_ = monotonic_now();
    state_.sent = std::llround(state_sent_ * 1e6);
    lcm_.publish(LIMPHOME_CHANNEL_STATE, &state_);
}

void Link::repeat_state(double interval) {
    if (monotonic_now() - state_sent_ >= interval) {
        counts_.resent++;
        publish_state();
    }
}

void Link::resend_state_if_due() {
    repeat_state(resend_);
}

void Link::show_life() {
    repeat_state(sender_timeout_ / 4);
}

void Link::send_truth(ground_truth_t truth) {
    truth.session = state_.session;
    truth.seq = state_.seq;
    truth.utime = state_.utime;
    lcm_.publish(LIMPHOME_CHANNEL_TRUTH, &truth);
}

void Link::send_pose(pose_t pose) {
    pose.session = pose.truth.session = state_.session;
    pose.seq = pose.truth.seq = state_.seq;
    pose.truth.utime = pose.utime;
    pose.pace = pace_.told();
    lcm_.publish(LIMPHOME_CHANNEL_POSE, &pose);
}

void Link::send_status(status_t status) {
    lcm_.publish(LIMPHOME_CHANNEL_STATUS, &status);
}

void Link::wait(double timeout) {
    const double begin = monotonic_now();
    int ready = lcm_.wait(static_cast<int>(std::ceil(timeout * 1000)));
    wait_time_ += monotonic_now() - begin;
    for (int handled = 0; ready > 0 && handled < most_messages; handled++) {
        if (lcm_.handle() != 0) {
            throw std::runtime_error("the bus is broken: a message that is there cannot be read");
        }
        ready = lcm_.wait(0);
    }
    counts_.overruns += ready > 0 ? 1 : 0;
    if (ready < 0) {
        throw std::runtime_error("the bus is broken: " + reason());
    }
}

bool Link::is_sound(const lcm::ReceiveBuffer *buffer, velocity_command_t &command) {
    if (!decode_exactly(buffer, command) || command.num_actuators != num_actuators_) {
        counts_.rejected_malformed++;
        return false;
    }
    const bool finite =
        std::all_of(command.velocity, command.velocity + num_actuators_, [](double v) { return std::isfinite(v); });
    counts_.rejected_non_finite += finite ? 0 : 1;
    return finite;
}

// Of this session, and from its owner.
bool Link::is_ours(const velocity_command_t &command) {
    if (command.session != session_ || command.seq > state_.seq || command.seq < 0) {
        counts_.rejected_session++;
        return false;
    }
    const bool owner = owned() && command.sender == session_sender_;
    counts_.rejected_sender += owner ? 0 : 1;
    return owner;
}

// The state that a command may answer at `now`: in lockstep the one that is waited upon; null: none, it is past.
const Link::Sent *Link::answered_state(int64_t seq, double now) const {
    const int64_t place = seq - sent_.front().seq;  // they have successive numbers, up to the newest
    if (place < 0) {
        return nullptr;
    }
    const Sent &state = sent_[static_cast<std::size_t>(place)];
    return lockstep_ || now - state.at <= command_timeout_ ? &state : nullptr;
}

// A robot that is commanded by mistake goes no faster than it was set up to.
void Link::limit(velocity_command_t &command) {
    bool limited = false;
    for (int a = 0; a < num_actuators_; a++) {
        const double most = a < crawlers ? crawler_speed_ : joint_speed_;
        const double within = std::clamp(command.velocity[a], -most, most);
        limited = limited || within != command.velocity[a];
        command.velocity[a] = within;
    }
    counts_.limited += limited ? 1 : 0;
}

void Link::receive_command(const lcm::ReceiveBuffer *buffer, const std::string &) {
    velocity_command_t command{};
    counts_.received++;
    if (!is_sound(buffer, command) || !is_ours(command)) {
        return;
    }
    const double now = monotonic_now();
    const Sent *state = answered_state(command.seq, now);
    if (state == nullptr) {
        (lockstep_ ? counts_.duplicates : counts_.late)++;
        return;
    }
    owner_heard_ = now;
    if (command.seq <= answered_ || (command_ && command.seq <= command_->command.seq)) {
        counts_.duplicates++;
        return;
    }
    if (!state->armed) {  // a sign of life, no more
        return;
    }
    limit(command);
    command_ = TimedCommand{command, state->at};
}

void Link::receive_reset(const lcm::ReceiveBuffer *buffer, const std::string &) {
    reset_request_t request{};
    counts_.received++;
    if (!decode_exactly(buffer, request) || request.sender == 0 || request.nonce == 0) {
        counts_.rejected_malformed++;
        return;
    }
    if (request.session != session_) {
        counts_.rejected_session++;
        return;
    }
    const double now = monotonic_now();
    if (request.sender != owner_) {
        if (!owner_is_silent(now)) {
            counts_.rejected_sender++;
            return;
        }
        arming_.disarm(status_t::CONTROLLER_SILENT, now);
        owner_ = request.sender;
    }
    owner_heard_ = now;
    request_ = request;
}

void Link::receive_arm(const lcm::ReceiveBuffer *buffer, const std::string &) {
    arm_request_t request{};
    counts_.received++;
    if (!decode_exactly(buffer, request)) {
        counts_.rejected_malformed++;
        return;
    }
    const double now = monotonic_now();
    switch (arming_.hear(request, owned() && !owner_is_silent(now), now)) {
        case Arming::Verdict::taken:
            break;
        case Arming::Verdict::malformed:
            counts_.rejected_malformed++;
            break;
        case Arming::Verdict::challenge_failed:
            counts_.rejected_challenge++;
            break;
        case Arming::Verdict::other_sender:
            counts_.rejected_sender++;
            break;
    }
}

// Nobody needs leave for it: only a simulation can be held up, and what happens in it stays the same.
void Link::receive_pace(const lcm::ReceiveBuffer *buffer, const std::string &) {
    pace_t request{};
    counts_.received++;
    const bool decoded = decode_exactly(buffer, request);
    const auto verdict = decoded ? pace_.hear(request, monotonic_now()) : Pace::Verdict::malformed;
    counts_.rejected_malformed += verdict == Pace::Verdict::malformed ? 1 : 0;
    counts_.rejected_non_finite += verdict == Pace::Verdict::non_finite ? 1 : 0;
}

void Link::pass() {
    const double now = monotonic_now();
    arming_.pass(now);
    if (owner_is_silent(now)) {
        arming_.disarm(status_t::CONTROLLER_SILENT, now);
    }
}

void Link::excuse(double seconds) {
    arming_.excuse(seconds);
    owner_heard_ += seconds;
}

std::optional<TimedCommand> Link::take_command() {
    std::optional<TimedCommand> command;
    command.swap(command_);
    if (command) {
        answered_ = command->command.seq;
    }
    return command;
}

std::optional<reset_request_t> Link::take_reset() {
    std::optional<reset_request_t> request;
    request.swap(request_);
    return request;
}

}  // namespace limphome
