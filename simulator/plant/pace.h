// How fast the time of a plant goes that can pause, as a person at a viewer wants it: LIMPHOME_PACE.
//
// Only how long a time step is held up follows from it, never what happens in one: the machine comes to the same
// states, bit by bit. Whoever holds a plant up keeps it up. Once no viewer is heard any more the plant goes on as fast
// as it can, so that a lid that was closed stops no run.
#pragma once

#include <limphome/pace_t.hpp>

namespace limphome {

class Pace {
   public:
    // `possible`: false where time does not wait; then nothing is heeded.
    explicit Pace(bool possible);

    enum class Verdict { taken, malformed, non_finite };
    // A request at `now` [s, monotonic].
    Verdict hear(const pace_t &request, double now);
    // Time goes on: nobody looks any more once nobody has said so for `silence`.
    void pass(double now);
    static constexpr double silence = 5;  // [s]

    // Not held up at all.
    bool free() const { return !paused_ && pace_ == as_fast_as_it_can; }
    // Stands still; not while it goes on for a decision.
    bool paused() const { return paused_ && !stepping_; }
    // As pose_t.pace tells it.
    double told() const;

    // For how long the next time step is held up at `now` [s], infinity while paused; it may be done at 0 and below.
    double ahead(double now) const;
    // A time step of so long [s] is done at `now`.
    void go(double seconds, double now);
    // The next state has come: one decision is over.
    void arrive() { stepping_ = false; }

    // Whether something was asked for that is not possible.
    bool unheeded() const { return unheeded_; }
    // Whether a new session was asked for.
    bool reset_requested() const { return reset_; }
    // The same, once.
    bool take_reset();

   private:
    static const double as_fast_as_it_can;

    void run(double pace, double now);

    bool possible_;
    bool paused_ = false;
    bool stepping_ = false;  // paused, but for the decision under way
    bool reset_ = false;
    bool unheeded_ = false;
    double pace_;       // plant time to wall time
    double due_ = 0;    // when the next time step may be done [s, monotonic]
    double heard_ = 0;  // [s, monotonic]
};

}  // namespace limphome
