#include "plant/pace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <limphome/pose_t.hpp>

namespace limphome {

namespace {

constexpr double slowest = 0.01, fastest = 100;  // plant time to wall time
constexpr double most_behind = 0.1;              // that is made up for after a stall [s]

bool is_pace(double pace) {
    return pace == pose_t::PACE_FREE || (pace >= slowest && pace <= fastest);
}

}  // namespace

const double Pace::as_fast_as_it_can = pose_t::PACE_FREE;

Pace::Pace(bool possible) : possible_(possible), pace_(as_fast_as_it_can) {}

Pace::Verdict Pace::hear(const pace_t &request, double now) {
    if (request.action < pace_t::RUN || request.action > pace_t::KEEP) {
        return Verdict::malformed;
    }
    if (request.action == pace_t::RUN && !is_pace(request.pace)) {
        return std::isfinite(request.pace) ? Verdict::malformed : Verdict::non_finite;
    }
    if (!possible_) {
        unheeded_ = unheeded_ || request.action != pace_t::KEEP;
        return Verdict::taken;
    }
    heard_ = now;
    switch (request.action) {
        case pace_t::RUN:
            run(request.pace, now);
            break;
        case pace_t::PAUSE:
            paused_ = true;
            stepping_ = false;
            break;
        case pace_t::STEP:
            stepping_ = paused_;
            break;
        case pace_t::RESET:
            reset_ = true;
            break;
        default:
            break;
    }
    return Verdict::taken;
}

void Pace::run(double pace, double now) {
    pace_ = pace;
    paused_ = stepping_ = false;
    due_ = now;
}

void Pace::pass(double now) {
    if (!free() && now - heard_ >= silence) {
        run(as_fast_as_it_can, now);
    }
}

double Pace::told() const {
    return paused() ? 0 : possible_ ? pace_ : 1;
}

double Pace::ahead(double now) const {
    if (paused()) {
        return std::numeric_limits<double>::infinity();
    }
    return pace_ == as_fast_as_it_can ? 0 : due_ - now;
}

void Pace::go(double seconds, double now) {
    if (pace_ != as_fast_as_it_can) {
        due_ = std::max(due_, now - most_behind) + seconds / pace_;
    }
}

bool Pace::take_reset() {
    const bool asked = reset_;
    reset_ = false;
    return asked;
}

}  // namespace limphome
