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
constexpr int flood = 40;                 // overruns in a second that make one: 5,000 messages
constexpr double at_rest[max_actuators] = {};

const char *words(int8_t reason) {
    switch (reason) {
        case status_t::NOT_YET_ARMED:
            return "nobody has armed it yet";
        case status_t::CONTROLLER_SILENT:
            return "the controller is silent";
        case status_t::OPERATOR_SILENT:
            return "the operator is silent";
        case status_t::MACHINE_FAILED:
            return "the machine has failed";
        case status_t::BY_OPERATOR:
            return "the operator has said so";
        default:
            return "";
    }
}

}  // namespace

Loop::Loop(Machine &machine, Link &link, const settings &s)
    : machine_(machine),
      link_(link),
      poses_(machine, link),
      settings_(s),
      started_(monotonic_now()),
      pace_(link.pace().told()) {
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
    start(stop);
    while (*stop == 0) {
        if (!pass()) {
            return false;
        }
    }
    end();
    return true;
}

void Loop::start(const volatile std::sig_atomic_t *stop) {
    stop_ = stop;
    begin();
}

bool Loop::pass() {
    if (link_.pace().take_reset()) {
        begin_anew();
    } else if (const auto request = link_.take_reset()) {
        faults_in_a_row_ = session_decisions_ > 0 ? 0 : faults_in_a_row_;
        episode_ = request->episode;
        restart(request);
    } else if (settings_.simulator.pace == SETTINGS_LOCKSTEP ? advance_lockstep() : advance_real_time()) {
        decisions_++;
        session_decisions_++;
        if (!machine_.diverged()) {
            publish();
        } else if (!recover()) {
            return false;
        }
    }
    tell();
    return true;
}

void Loop::end() {
    report(status_t::FINISHED, status_t::NONE);
}

void Loop::restart(const std::optional<reset_request_t> &request) {
    machine_.command(at_rest);
    if (machine_.can_be_carried_back() || !request) {
        const double begun = monotonic_now();
        machine_.reset(episode_);
        link_.excuse(monotonic_now() - begun);
    }
    link_.begin_session(request);
    session_decisions_ = 0;
    begin();
}

// The state that diverged is not published. The report tells the controller that the session is over.
bool Loop::recover() {
    const double now = monotonic_now();
    notice_print(&divergences_, now, "the machine diverged in decision %" PRId64 " of its session and is reset",
                 session_decisions_);
    faults_++;
    faults_in_a_row_++;
    link_.arming().disarm(status_t::MACHINE_FAILED, now);
    report(status_t::FAULT, status_t::MACHINE_FAILED);
    if (faults_in_a_row_ >= most_faults) {
        std::fprintf(stderr, "it did so in %d sessions in a row; giving up\n", faults_in_a_row_);
        return false;
    }
    restart(std::nullopt);
    return true;
}

// The report tells the controller that the session is over.
void Loop::begin_anew() {
    report(status_t::WAITING, status_t::BEGUN_ANEW);
    restart(std::nullopt);
}

void Loop::begin() {
    clock_ = monotonic_now();
    obeyed_ = {{}, clock_};
    held_ = false;
    machine_.command(at_rest);
    publish();
}

void Loop::publish() {
    robot_state_t state{};
    machine_.sense(state);
    for (int a = 0; a < machine_.num_actuators(); a++) {
        state.actuator_health[a] = static_cast<int8_t>(machine_.health(a));
    }
    state.reset = machine_.can_be_carried_back() ? robot_state_t::TO_INITIAL_POSE : robot_state_t::WHERE_IT_IS;
    state.held = held_ ? 1 : 0;
    link_.send_state(state);
    link_.pace().arrive();
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
    machine_.command(command->command.velocity);
    bool whole = true;
    machine_.advance_asking(settings_.episode.decision_period_s,
                            [this, &whole](double seconds) { return whole = may_step(seconds); });
    return whole;
}

bool Loop::broken_off() const {
    return *stop_ != 0 || link_.reset_requested() || link_.pace().reset_requested();
}

bool Loop::may_step(double seconds) {
    Pace &pace = link_.pace();
    if (pace.free()) {
        return true;
    }
    double now = tell();
    for (; pace.ahead(now) > 0 && !broken_off(); now = tell()) {
        link_.wait(std::min(pace.ahead(now), poses_.due() - now));
        link_.show_life();
    }
    pace.go(seconds, now);
    return !broken_off();
}

// What was commanded before says nothing of how to move from now on.
void Loop::heed_arming() {
    const Arming &arming = link_.arming();
    if (arming.armed() && !armed_) {
        obeyed_ = {{}, monotonic_now()};
    }
    if (arming.armed() != armed_ || arming.reason() != reason_) {
        armed_ = arming.armed();
        reason_ = arming.reason();
        if (armed_) {
            notice_print(&armings_, monotonic_now(), "armed");
        } else {
            notice_print(&disarmings_, monotonic_now(), "not armed: %s", words(reason_));
        }
    }
}

// 1 while the newest command is fresh and the plant armed, then down to 0.
double Loop::share_obeyed(double now) {
    double overdue = now - obeyed_.born - settings_.link.command_timeout_s;
    if (!link_.arming().armed()) {
        overdue = std::max(overdue, now - link_.arming().disarmed_at());
    }
    return std::clamp(1 - overdue / ramp_time, 0.0, 1.0);
}

void Loop::obey() {
    link_.pass();
    heed_arming();
    const auto command = link_.take_command();
    if (command && armed_) {
        obeyed_ = *command;
    }
    const double share = share_obeyed(monotonic_now());
    held_ = held_ || share < 1;
    double velocity[max_actuators];
    std::transform(obeyed_.command.velocity, obeyed_.command.velocity + max_actuators, velocity,
                   [share](double v) { return v * share; });
    machine_.command(velocity);
}

bool Loop::advance_real_time() {
    const double period = settings_.episode.decision_period_s;
    const long slices = std::max(1L, std::lround(period / real_time_slice));
    const double slice = period / static_cast<double>(slices);
    held_ = false;
    for (long done = 1; done <= slices; done++) {
        obey();
        machine_.advance(slice);
        double ahead;
        do {  // a machine that does not keep up hears its controller all the same
            ahead = clock_ + static_cast<double>(done) * slice - monotonic_now();
            link_.wait(std::max(ahead, 0.0));
        } while (ahead > 0);
        tell();
        if (link_.reset_requested()) {
            return false;
        }
    }
    held_ = held_ || link_.answered() != link_.seq();
    clock_ = std::max(clock_ + period, monotonic_now() - period);  // after a long stall, do not hurry to catch up
    return true;
}

void Loop::report(int8_t condition, int8_t reason) {
    status_t status = link_.counts();
    const double now = monotonic_now();
    status.utime = std::llround(now * 1e6);
    status.process = status_t::PLANT;
    status.condition = condition;
    status.reason = reason;
    status.session = link_.session();
    status.seq = link_.seq();
    status.wall_time = now - started_;
    status.wait_time = link_.wait_time();
    status.simulated_time = machine_.simulated_time();
    status.decisions = decisions_;
    status.saturated = machine_.saturated();
    status.faults = faults_;
    link_.send_status(status);
}

double Loop::tell() {
    const double now = monotonic_now();
    link_.pace().pass(now);
    if (link_.pace().unheeded() && !told_unheeded_) {
        told_unheeded_ = true;
        std::fprintf(
            stderr,
            "what comes by LIMPHOME_PACE is not heeded: a plant in real time can be neither paused nor slowed\n");
    }
    if (link_.pace().told() != pace_) {  // at once, as the controller waits for what comes next
        pace_ = link_.pace().told();
        report_due_ = now;
    }
    poses_.show(now, episode_);
    report_each_second(now);
    return now;
}

void Loop::report_each_second(double now) {
    if (now < report_due_) {
        return;
    }
    report_due_ = now + 1;
    const bool flooded = link_.counts().overruns - overruns_ >= flood;
    overruns_ = link_.counts().overruns;
    if (flooded) {
        notice_print(&floods_, now, "more messages come than can be looked at");
        report(status_t::DEGRADED, status_t::FLOODED);
    } else if (!link_.arming().armed()) {
        report(status_t::WAITING, link_.arming().reason());
    } else if (!link_.owned()) {
        report(status_t::WAITING, status_t::NO_CONTROLLER);
    } else if (!link_.pace().free()) {
        report(link_.pace().paused() ? status_t::WAITING : status_t::RUNNING, status_t::PACED);
    } else {
        report(decisions_ == 0 ? status_t::WAITING : status_t::RUNNING, status_t::NONE);
    }
}

}  // namespace limphome
