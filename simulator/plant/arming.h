// Whether a plant in real time may move: by leave of an operator, who has to keep it up.
//
// Leave is given by answering a challenge, a random number that every state carries and that is drawn anew once it was
// used and every so often. So what was said once, a recording that is played back or a message that is late, says
// nothing a second time.
#pragma once

#include <cstdint>
#include <limphome/arm_request_t.hpp>
#include <limphome/status_t.hpp>

namespace limphome {

// From the system, never 0. Nothing that is simulated depends on it. Throws std::runtime_error if there is none.
int64_t random_number();

class Arming {
   public:
    // `needed`: false in lockstep, where the plant is armed for ever. Silence of the operator for `operator_timeout`
    // [s] disarms.
    Arming(bool needed, double operator_timeout);

    bool armed() const { return armed_; }
    int64_t challenge() const { return challenge_; }
    // Why it is not armed, a constant of status_t; NONE while it is.
    int8_t reason() const { return reason_; }
    // When it was disarmed last [s, monotonic].
    double disarmed_at() const { return disarmed_at_; }

    enum class Verdict { taken, malformed, challenge_failed, other_sender };
    // A request at `now` [s, monotonic]. Nobody can arm a plant that has no controller (`controlled`).
    Verdict hear(const arm_request_t &request, bool controlled, double now);

    // Disarms for a reason, a constant of status_t; the first one stands.
    void disarm(int8_t reason, double now);
    // Time goes on: disarms if the operator has been silent, draws a challenge anew that nobody has answered.
    void pass(double now);
    // The plant has heard nobody for so long [s], nor could it have.
    void excuse(double seconds);

   private:
    void renew_challenge(double now);

    bool needed_;
    double operator_timeout_;
    bool armed_;
    int8_t reason_;
    int64_t challenge_;
    double challenged_at_;
    double disarmed_at_;
    int64_t operator_ = 0;  // who armed it
    double operator_heard_ = 0;
};

}  // namespace limphome
