#include "plant/link.h"

#include <limphome_channels.h>

#include <poll.h>
#include <sys/random.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace limphome {

double monotonic_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

namespace {

// Of the system call that has just failed.
std::string reason() {
    return std::generic_category().message(errno);
}

// Sessions only have to differ from one another, across processes too; nothing that is simulated depends on them.
int64_t random_session() {
    int64_t session = 0;
    if (getrandom(&session, sizeof session, 0) != static_cast<ssize_t>(sizeof session)) {
        throw std::runtime_error("no random numbers from the system: " + reason());
    }
    return session;
}

template <typename Message>
bool decode_exactly(const lcm::ReceiveBuffer *buffer, Message &message) {
    const int size = static_cast<int>(buffer->data_size);
    return message.decode(buffer->data, 0, size) == size;
}

}  // namespace

Link::Link(const std::string &url, const settings &s, int num_actuators)
    : lcm_(url),
      lockstep_(s.simulator.pace == SETTINGS_LOCKSTEP),
      resend_(s.link.resend_s),
      sender_timeout_(s.link.sender_timeout_s),
      num_actuators_(num_actuators),
      sender_heard_(-std::numeric_limits<double>::infinity()) {
    lcm_.subscribe(LIMPHOME_CHANNEL_COMMAND, &Link::receive_command, this);
    lcm_.subscribe(LIMPHOME_CHANNEL_RESET, &Link::receive_reset, this);
    begin_session();
}

void Link::begin_session() {
    session_ = random_session();
    next_seq_ = 0;
    answered_ = -1;
    command_.reset();
    reset_requested_ = false;
}

void Link::send_state(robot_state_t state) {
    state.session = session_;
    state.seq = next_seq_++;
    state.lockstep = lockstep_ ? 1 : 0;
    state_ = state;
    state_sent_ = monotonic_now();
    lcm_.publish(LIMPHOME_CHANNEL_STATE, &state_);
}

void Link::resend_state_if_due() {
    if (monotonic_now() - state_sent_ < resend_) {
        return;
    }
    state_sent_ = monotonic_now();
    counts_.resent++;
    lcm_.publish(LIMPHOME_CHANNEL_STATE, &state_);
}

void Link::send_truth(ground_truth_t truth) {
    truth.session = state_.session;
    truth.seq = state_.seq;
    truth.utime = state_.utime;
    lcm_.publish(LIMPHOME_CHANNEL_TRUTH, &truth);
}

void Link::send_status(status_t status) {
    lcm_.publish(LIMPHOME_CHANNEL_STATUS, &status);
}

void Link::wait(double timeout) {
    const double begin = monotonic_now();
    pollfd bus{lcm_.getFileno(), POLLIN, 0};
    int ready = poll(&bus, 1, static_cast<int>(std::ceil(timeout * 1000)));
    wait_time_ += monotonic_now() - begin;
    for (; ready > 0; ready = poll(&bus, 1, 0)) {
        if (lcm_.handle() != 0) {
            throw std::runtime_error("the bus is broken: a message that is there cannot be read");
        }
    }
    if (ready < 0 && errno != EINTR) {
        throw std::runtime_error("the bus is broken: " + reason());
    }
}

// One sender is obeyed until it has been silent for a while; then the next one that speaks is.
bool Link::accept_sender(int64_t sender) {
    const double now = monotonic_now();
    if (sender != sender_ && now - sender_heard_ < sender_timeout_) {
        counts_.rejected_sender++;
        return false;
    }
    sender_ = sender;
    sender_heard_ = now;
    return true;
}

void Link::receive_command(const lcm::ReceiveBuffer *buffer, const std::string &) {
    velocity_command_t command{};
    counts_.received++;
    if (!decode_exactly(buffer, command) || command.num_actuators != num_actuators_) {
        counts_.rejected_malformed++;
        return;
    }
    if (!std::all_of(command.velocity, command.velocity + num_actuators_, [](double v) { return std::isfinite(v); })) {
        counts_.rejected_non_finite++;
        return;
    }
    if (command.session != session_ || command.seq > state_.seq) {
        counts_.rejected_session++;
        return;
    }
    if (!accept_sender(command.sender)) {
        return;
    }
    // In lockstep only the state that is waited upon can be answered; in real time an answer may come late, once.
    if ((lockstep_ && command.seq != state_.seq) || command.seq <= answered_) {
        counts_.duplicates++;
        return;
    }
    command_ = command;
}

void Link::receive_reset(const lcm::ReceiveBuffer *buffer, const std::string &) {
    reset_request_t request{};
    counts_.received++;
    if (!decode_exactly(buffer, request)) {
        counts_.rejected_malformed++;
        return;
    }
    if (request.session != session_) {
        counts_.rejected_session++;
        return;
    }
    if (accept_sender(request.sender)) {
        reset_requested_ = true;
        requested_episode_ = request.episode;
    }
}

std::optional<velocity_command_t> Link::take_command() {
    std::optional<velocity_command_t> command;
    command.swap(command_);
    if (command) {
        answered_ = command->seq;
    }
    return command;
}

}  // namespace limphome
