#include "plant/arming.h"

#include <sys/random.h>

#include <cerrno>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace limphome {

int64_t random_number() {
    int64_t number = 0;
    while (number == 0) {
        if (getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number) && errno != EINTR) {
            throw std::runtime_error("no random numbers from the system: " + std::generic_category().message(errno));
        }
    }
    return number;
}

Arming::Arming(bool needed, double operator_timeout)
    : needed_(needed),
      operator_timeout_(operator_timeout),
      armed_(!needed),
      reason_(needed ? status_t::NOT_YET_ARMED : status_t::NONE),
      challenge_(random_number()),
      challenged_at_(-std::numeric_limits<double>::infinity()),
      disarmed_at_(-std::numeric_limits<double>::infinity()) {}

void Arming::renew_challenge(double now) {
    challenge_ = random_number();
    challenged_at_ = now;
}

Arming::Verdict Arming::hear(const arm_request_t &request, bool controlled, double now) {
    if (request.action == arm_request_t::DISARM) {
        disarm(status_t::BY_OPERATOR, now);
        return Verdict::taken;
    }
    if (request.action != arm_request_t::ARM && request.action != arm_request_t::KEEP) {
        return Verdict::malformed;
    }
    if (request.challenge != challenge_) {
        return Verdict::challenge_failed;
    }
    if (!needed_) {
        return Verdict::taken;
    }
    if (request.action == arm_request_t::KEEP && (!armed_ || request.sender != operator_)) {
        return Verdict::other_sender;
    }
    renew_challenge(now);
    if (!controlled) {
        disarm(status_t::CONTROLLER_SILENT, now);
        reason_ = status_t::CONTROLLER_SILENT;
        return Verdict::taken;
    }
    operator_ = request.sender;
    operator_heard_ = now;
    armed_ = true;
    reason_ = status_t::NONE;
    return Verdict::taken;
}

void Arming::disarm(int8_t reason, double now) {
    if (needed_ && armed_) {
        armed_ = false;
        reason_ = reason;
        disarmed_at_ = now;
        renew_challenge(now);
    }
}

void Arming::pass(double now) {
    if (armed_ && now - operator_heard_ > operator_timeout_) {
        disarm(status_t::OPERATOR_SILENT, now);
    }
    if (needed_ && now - challenged_at_ > operator_timeout_) {
        renew_challenge(now);
    }
}

void Arming::excuse(double seconds) {
    operator_heard_ += seconds;
}

}  // namespace limphome
