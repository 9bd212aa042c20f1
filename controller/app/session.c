#include "session.h"

enum { MISPLACED_PROVE = 3 };  /* states */
static const double slack = 3; /* states that may come sooner than by the clock */

/* splitmix64; 0 stands for no nonce. */
static int64_t draw_nonce(session_tracker *t) {
    uint64_t z = 0;
    while (z == 0) {
        z = t->random += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
    }
    return (int64_t)z;
}

void session_init(session_tracker *tracker, int64_t sender, uint64_t seed, double timeout, double period) {
    *tracker = (session_tracker){.timeout = timeout, .period = period, .sender = sender, .random = seed};
}

static void begin_asking(session_tracker *t, double now) {
    t->asking = true;
    t->nonce = draw_nonce(t);
    t->asked = now;
    t->misplaced = 0;
}

void session_reset(session_tracker *tracker, double now) {
    begin_asking(tracker, now);
}

static void remember(session_tracker *t, int64_t session) {
    t->past[t->past_count % SESSIONS_REMEMBERED] = session;
    t->past_count++;
}

static bool is_past(const session_tracker *t, int64_t session) {
    const unsigned count = t->past_count < SESSIONS_REMEMBERED ? t->past_count : SESSIONS_REMEMBERED;
    for (unsigned i = 0; i < count; i++) {
        if (t->past[i] == session) {
            return true;
        }
    }
    return false;
}

void session_over(session_tracker *tracker, int64_t session, session_break why) {
    if (tracker->known && session == tracker->session) {
        tracker->over = why;
    }
}

void session_paused(session_tracker *tracker, double seconds) {
    tracker->heard += seconds;
}

static bool is_silent(const session_tracker *t, double now) {
    return now - t->heard >= t->timeout;
}

/* Whether the plant can have come to `seq` by `now`, having been at `from` at `since`. */
static bool can_be_there(const session_tracker *t, int64_t seq, int64_t from, double since, double now) {
    return (double)(seq - from) <= (now - since) / t->period + slack;
}

static session_verdict place(session_tracker *t, int64_t seq, double now, session_verdict verdict) {
    t->seq = seq;
    t->heard = t->placed = now;
    t->misplaced = 0;
    return verdict;
}

/* Whether enough was heard that is not as it should be, and nothing that is, to do something about it. */
static bool is_proven(session_tracker *t, double now) {
    t->misplaced++;
    return t->misplaced >= MISPLACED_PROVE && is_silent(t, now);
}

/* A state of a session of ours that is not where it should be. Once it may be a late copy or an invention; time and
 * again, and never the right one between, it proves that the plant is somewhere else than we are. */
static session_verdict misplaced(session_tracker *t, const session_label *label, double now) {
    if (!is_proven(t, now)) {
        return label->seq < t->seq ? SESSION_OLD : SESSION_AHEAD;
    }
    begin_asking(t, now);
    t->session = label->session;
    t->broken = SESSION_MISPLACED;
    return place(t, label->seq, now, SESSION_RESET);
}

/* The answer to our request. */
static session_verdict take_up(session_tracker *t, const session_label *label, double now) {
    const bool possible =
        label->seq >= 0 && (label->lockstep ? label->seq == 0 : can_be_there(t, label->seq, 0, t->asked, now));
    if (!possible) {
        return misplaced(t, label, now);
    }
    remember(t, t->session);
    t->session = label->session;
    t->asking = false;
    t->over = SESSION_UNBROKEN;
    return place(t, label->seq, now, SESSION_NEW);
}

bool session_is_anothers(const session_tracker *t, const session_label *label) {
    return label->sender != 0 && label->sender != t->sender;
}

/* Asks for a reset of the session that was heard. */
static session_verdict ask(session_tracker *t, const session_label *label, double now) {
    t->session = label->session;
    return place(t, label->seq, now, session_is_anothers(t, label) ? SESSION_DENIED : SESSION_RESET);
}

static session_break cause(const session_tracker *t, const session_label *label) {
    if (t->over != SESSION_UNBROKEN) {
        return t->over;
    }
    return session_is_anothers(t, label) ? SESSION_TAKEN : SESSION_ENDED;
}

/* A session that we have not asked for: the plant was restarted, or obeys another. */
static session_verdict judge_other(session_tracker *t, const session_label *label, double now) {
    const bool follows = t->over != SESSION_UNBROKEN && label->sender == 0; /* the plant's next session is nobody's */
    if (t->known && !follows && !is_silent(t, now)) {
        return SESSION_OTHER;
    }
    if (t->known && !t->asking) {
        t->broken = cause(t, label);
    }
    if (!t->asking) {
        begin_asking(t, now);
    }
    t->known = true;
    t->over = SESSION_UNBROKEN;
    return ask(t, label, now);
}

/* In lockstep the plant waits for us, so only the next number can follow; in real time some may be lost. */
static session_verdict judge_ours(session_tracker *t, const session_label *label, double now) {
    if (label->nonce != t->nonce || label->sender != t->sender) {
        return SESSION_OTHER;
    }
    if (label->seq == t->seq) {
        return place(t, label->seq, now, SESSION_REPEATED);
    }
    t->over = SESSION_UNBROKEN; /* it lives, whatever was told of it */
    const bool next = label->seq > t->seq && (label->lockstep ? label->seq == t->seq + 1
                                                              : can_be_there(t, label->seq, t->seq, t->placed, now));
    return next ? place(t, label->seq, now, SESSION_NEW) : misplaced(t, label, now);
}

session_verdict session_judge(session_tracker *tracker, const session_label *label, double now) {
    if (is_past(tracker, label->session) && !is_proven(tracker, now)) {
        return SESSION_OLD; /* a late copy */
    }
    if (!tracker->known || label->session != tracker->session) {
        const bool answers = tracker->asking && label->sender == tracker->sender && label->nonce == tracker->nonce;
        return answers ? take_up(tracker, label, now) : judge_other(tracker, label, now);
    }
    return tracker->asking ? ask(tracker, label, now) : judge_ours(tracker, label, now);
}
