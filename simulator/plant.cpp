#include "plant.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "truth.h"

namespace limphome {

namespace {

constexpr double kRampSeconds = 0.5;     // from the last obeyed speed to rest
constexpr int kMostFaults = 10;          // in a row
constexpr double kRealTimeSlice = 0.01;  // the clock is followed this finely [s]

}  // namespace

Plant::Plant(World &world, Link &link, const settings &s)
    : world_(world), link_(link), settings_(s), started_(monotonic_now()) {}

bool Plant::run(const volatile std::sig_atomic_t *stop) {
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
            simulated_ += settings_.episode.decision_period_s;
            if (!world_.diverged()) {
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

void Plant::restart() {
    world_.reset(episode_);
    link_.begin_session();
    session_decisions_ = 0;
    begin();
}

// The state that diverged is not published. The report tells the controller that the session is over.
bool Plant::recover() {
    std::fprintf(stderr, "the simulation diverged at %.3f s; the robot is put back to its initial pose\n",
                 world_.time());
    faults_++;
    faults_in_a_row_++;
    report(status_t::FAULT);
    if (faults_in_a_row_ >= kMostFaults) {
        std::fprintf(stderr, "it did so in %d sessions in a row; giving up\n", faults_in_a_row_);
        return false;
    }
    restart();
    return true;
}

void Plant::begin() {
    obeyed_ = velocity_command_t{};
    obeyed_at_ = clock_ = monotonic_now();
    world_.command(obeyed_.velocity);
    publish();
}

void Plant::publish() {
    robot_state_t state{};
    world_.sense(state);
    state.utime = std::llround(world_.time() * 1e6);
    link_.send_state(state);
    ground_truth_t truth{};
    read_truth(world_, truth);
    link_.send_truth(truth);
}

bool Plant::advance_lockstep() {
    link_.wait(settings_.link.resend_s);
    const auto command = link_.take_command();
    if (!command) {
        if (!link_.reset_requested()) {
            link_.resend_state_if_due();
        }
        return false;
    }
    world_.command(command->velocity);
    world_.advance();
    return true;
}

void Plant::obey() {
    const double now = monotonic_now();
    if (const auto command = link_.take_command()) {
        obeyed_ = *command;
        obeyed_at_ = now;
    }
    const double too_old = now - obeyed_at_ - settings_.link.command_timeout_s;
    const double share = std::clamp(1 - too_old / kRampSeconds, 0.0, 1.0);
    late_ += share < 1 ? 1 : 0;
    double velocity[8];
    std::transform(obeyed_.velocity, obeyed_.velocity + 8, velocity, [share](double v) { return v * share; });
    world_.command(velocity);
}

bool Plant::advance_real_time() {
    const double period = settings_.episode.decision_period_s;
    const double step = settings_.simulator.time_step_s;
    const long steps = std::lround(period / step);
    const long slice = std::max(1L, std::lround(kRealTimeSlice / step));
    for (long done = 0; done < steps;) {
        obey();
        for (const long end = std::min(steps, done + slice); done < end; done++) {
            world_.step();
        }
        for (double ahead; (ahead = clock_ + static_cast<double>(done) * step - monotonic_now()) > 0;) {
            link_.wait(ahead);
        }
        if (link_.reset_requested()) {
            return false;
        }
    }
    clock_ = std::max(clock_ + period, monotonic_now() - period);  // after a long stall, do not hurry to catch up
    return true;
}

void Plant::report(int8_t condition) {
    status_t status = link_.counts();
    const double now = monotonic_now();
    status.utime = std::llround(now * 1e6);
    status.process = status_t::PLANT;
    status.condition = condition;
    status.session = link_.session();
    status.seq = link_.seq();
    status.wall_time = now - started_;
    status.wait_time = link_.wait_time();
    status.simulated_time = simulated_;
    status.decisions = decisions_;
    status.late = late_;
    status.saturated = world_.saturated();
    status.faults = faults_;
    link_.send_status(status);
}

void Plant::report_each_second() {
    if (monotonic_now() >= report_due_) {
        report(decisions_ == 0 ? status_t::WAITING : status_t::RUNNING);
        report_due_ = monotonic_now() + 1;
    }
}

}  // namespace limphome
