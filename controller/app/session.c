#include "session.h"

void session_init(session_tracker *tracker, double timeout) {
    *tracker = (session_tracker){.timeout = timeout};
}

void session_reset(session_tracker *tracker) {
    tracker->resetting = true;
}

void session_over(session_tracker *tracker, int64_t session) {
    tracker->over = tracker->over || (tracker->known && session == tracker->session);
}

/* A session we have not heard of. It is the answer to our reset, or the plant was restarted. */
static session_verdict judge_other(session_tracker *tracker, int64_t session, int64_t seq, bool lockstep, double now) {
    if (tracker->resetting && (seq == 0 || !lockstep)) {
        tracker->session = session;
        tracker->seq = seq;
        tracker->heard = now;
        tracker->resetting = tracker->over = false;
        return SESSION_NEW;
    }
    if (!tracker->over && now - tracker->heard < tracker->timeout) {
        return SESSION_OTHER;
    }
    tracker->session = session; /* ours is over or silent: take up this one, from a reset on */
    tracker->heard = now;
    tracker->over = false;
    tracker->resetting = true;
    tracker->restarted = true;
    return SESSION_RESET;
}

session_verdict session_judge(session_tracker *tracker, int64_t session, int64_t seq, bool lockstep, double now) {
    if (!tracker->known) {
        *tracker = (session_tracker){
            .timeout = tracker->timeout, .known = true, .resetting = true, .session = session, .heard = now};
        return SESSION_RESET;
    }
    if (session != tracker->session) {
        return judge_other(tracker, session, seq, lockstep, now);
    }
    tracker->heard = now;
    if (tracker->resetting) {
        return SESSION_RESET;
    }
    if (seq == tracker->seq) {
        return SESSION_REPEATED;
    }
    /* In lockstep the plant waits for us, so only the next number can follow; in real time some may be lost. */
    if (seq < tracker->seq || (lockstep && seq != tracker->seq + 1)) {
        return SESSION_OLD;
    }
    tracker->seq = seq;
    return SESSION_NEW;
}
