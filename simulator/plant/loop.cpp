#include "plant/loop.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace limphome {

namespace {

constexpr double ramp_time = 0.5;         // from the last obeyed speed to rest [s]
constexpr int most_faults = 10;           // in a row
constexpr double real_time_slice = 0.01;  // the clock is followed this finely [s]
constexpr double at_rest[max_actuators] = {};

}  // namespace

Loop::Loop(Machine &machine, Link &link, const settings &s)
    : machine_(machine), link_(link), settings_(s), started_(monotonic_now()) {
    if (s.simulator.pace == SETTINGS_LOCKSTEP && !machine.can_pause()) {
        throw std::runtime_error(
            "[simulator] pace = lockstep: the time of this machine does not wait for commands; "
            "it needs pace = real_time");
    }
}

// Nobody commands a machine any more whose loop has ended. What is told is what went wrong first.
bool Loop::run(const volatile std::sig_atomic_t *stop) {
    try {
        const bool sound = follow(stop);
        machine_.command(at_rest);
        return sound;
    } catch (...) {
        try {
            machine_.command(at_rest);
        } catch (...) {
        }
        throw;
    }
}

bool Loop::follow(const volatile std::sig_atomic_t *stop) {
    const bool lockstep = settings_.simulator.pace == SETTINGS_LOCKSTEP;
    begin();
    while (*stop == 0) {
        if (link_.reset_requested()) {
            faults_in_a_row_ = session_decisions_ > 0 ? 0 : faults_in_a_row_;
            episode_ = link_.requested_episode();
            restart();
        } else if (lockstep ? advance_lockstep() : advance_real_time()) {
            decisions_++;
            session_decisions_++;
            if (!machine_.diverged()) {
                publish();
            } else if (!recover()) {
                return false;
            }
        }
        report_each_second();
    }
    report(status_t::FINISHED);
    return true;
}

void Loop::restart() {
    machine_.command(at_rest);
    machine_.reset(episode_);
    link_.begin_session();
    session_decisions_ = 0;
    begin();
}

// The state that diverged is not published. The report tells the controller that the session is over.
bool Loop::recover() {
    std::fprintf(stderr, "the machine diverged in decision %" PRId64 " of its session and is reset\n",
                 session_decisions_);
    faults_++;
    faults_in_a_row_++;
    report(status_t::FAULT);
    if (faults_in_a_row_ >= most_faults) {
        std::fprintf(stderr, "it did so in %d sessions in a row; giving up\n", faults_in_a_row_);
        return false;
    }
    restart();
    return true;
}

void Loop::begin() {
    obeyed_ = velocity_command_t{};
    obeyed_at_ = clock_ = monotonic_now();
    machine_.command(obeyed_.velocity);
    publish();
}

void Loop::publish() {
    robot_state_t state{};
    machine_.sense(state);
    for (int a = 0; a < machine_.num_actuators(); a++) {
        state.actuator_health[a] = static_cast<int8_t>(machine_.health(a));
    }
    link_.send_state(state);
    ground_truth_t truth{};
    if (machine_.truth(truth)) {
        link_.send_truth(truth);
    }
}

bool Loop::advance_lockstep() {
    link_.wait(settings_.link.resend_s);
    const auto command = link_.take_command();
    if (!command) {
        if (!link_.reset_requested()) {
            link_.resend_state_if_due();
        }
        return false;
    }
    machine_.command(command->velocity);
    machine_.advance(settings_.episode.decision_period_s);
    return true;
}

void Loop::obey() {
    const double now = monotonic_now();
    if (const auto command = link_.take_command()) {
        obeyed_ = *command;
        obeyed_at_ = now;
    }
    const double too_old = now - obeyed_at_ - settings_.link.command_timeout_s;
    const double share = std::clamp(1 - too_old / ramp_time, 0.0, 1.0);
    late_ += share < 1 ? 1 : 0;
    double velocity[max_actuators];
    std::transform(obeyed_.velocity, obeyed_.velocity + max_actuators, velocity,
                   [share](double v) { return v * share; });
    machine_.command(velocity);
}

bool Loop::advance_real_time() {
    const double period = settings_.episode.decision_period_s;
    const long slices = std::max(1L, std::lround(period / real_time_slice));
    const double slice = period / static_cast<double>(slices);
    for (long done = 1; done <= slices; done++) {
        obey();
        machine_.advance(slice);
        double ahead;
        do {  // a machine that does not keep up hears its controller all the same
            ahead = clock_ + static_cast<double>(done) * slice - monotonic_now();
            link_.wait(std::max(ahead, 0.0));
        } while (ahead > 0);
        if (link_.reset_requested()) {
            return false;
        }
    }
    clock_ = std::max(clock_ + period, monotonic_now() - period);  // after a long stall, do not hurry to catch up
    return true;
}

void Loop::report(int8_t condition) {
    status_t status = link_.counts();
    const double now = monotonic_now();
    status.utime = std::llround(now * 1e6);
    status.process = status_t::PLANT;
    status.condition = condition;
    status.session = link_.session();
    status.seq = link_.seq();
    status.wall_time = now - started_;
    status.wait_time = link_.wait_time();
    status.simulated_time = machine_.simulated_time();
    status.decisions = decisions_;
    status.late = late_;
    status.saturated = machine_.saturated();
    status.faults = faults_;
    link_.send_status(status);
}

void Loop::report_each_second() {
    if (monotonic_now() >= report_due_) {
        report(decisions_ == 0 ? status_t::WAITING : status_t::RUNNING);
        report_due_ = monotonic_now() + 1;
    }
}

}  // namespace limphome
