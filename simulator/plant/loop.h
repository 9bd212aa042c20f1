// The plant's loop: takes a machine through sessions and decision periods, in lockstep with the controller or in real
// time. It knows nothing of the machine but what machine.h says.
#pragma once

#include <notice.h>
#include <settings.h>

#include <csignal>
#include <optional>

#include "plant/link.h"
#include "plant/machine.h"
#include "plant/poses.h"

namespace limphome {

class Loop {
   public:
    // Throws std::runtime_error if the settings ask for lockstep and the machine cannot pause.
    Loop(Machine &machine, Link &link, const settings &s);

    // Runs until *stop is not 0. A machine that diverges is reported and reset, in a new session. False if that happens
    // again and again.
    bool run(const volatile std::sig_atomic_t *stop);

    // The same by and by, for who has something else to do between: start() once, then pass() until *stop is not 0, or
    // it is false, then end().
    void start(const volatile std::sig_atomic_t *stop);
    bool pass();
    void end();

   private:
    bool follow(const volatile std::sig_atomic_t *stop);
    void begin();  // a session: publishes the state the machine is in, at rest
    void restart(const std::optional<reset_request_t> &request);  // new session, from the initial pose if it can be
    bool recover();           // from a machine that diverged; false if there is no use
    void begin_anew();        // as a person at a viewer wants it
    void publish();           // state and truth
    bool advance_lockstep();  // waits for the command that answers the newest state, then one decision period
    bool may_step(
        double seconds);       // holds a time step up as long as a person at a viewer wants; false: do none any more
    bool broken_off() const;   // whether the decision period is to end before its end
    bool advance_real_time();  // follows the clock to the end of the decision period, obeying commands as they come
    void obey();               // takes over a fresh command, or ramps to rest: it is too old, the plant not armed
    double share_obeyed(double now);
    void heed_arming();  // tells of a change, forgets commands of before
    void report(int8_t condition, int8_t reason);
    double tell();  // status each second, pose more often, when due; the time [s, monotonic]
    void report_each_second(double now);

    Machine &machine_;
    Link &link_;
    Poses poses_;
    const settings settings_;
    const volatile std::sig_atomic_t *stop_ = nullptr;  // run()'s
    const double started_;
    double pace_;       // as tell() found it last
    double clock_ = 0;  // real time: when the present decision period began [s, monotonic]
    TimedCommand obeyed_{};
    bool held_ = false;               // in this decision period something else than the command for it was obeyed
    bool armed_ = false;              // when heed_arming() looked last
    int8_t reason_ = status_t::NONE;  // why not; likewise
    double report_due_ = 0;           // [s, monotonic]
    int64_t overruns_ = 0;            // at the last report
    int64_t decisions_ = 0;
    int32_t episode_ = 0;  // that began with the newest session
    int64_t faults_ = 0;
    notice divergences_{};
    notice armings_{}, disarmings_{};
    notice floods_{};
    bool told_unheeded_ = false;     // that it cannot be paused
    int faults_in_a_row_ = 0;        // sessions that ended by a fault, but for those in which nothing was done
    int64_t session_decisions_ = 0;  // in this session
};

}  // namespace limphome
