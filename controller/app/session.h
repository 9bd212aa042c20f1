/* Which state to answer, and how: the controller's half of the lockstep protocol, without any I/O.
 *
 * A session is one life of the plant between two resets; within it states are numbered from 0. The controller answers
 * each state once with a new command and any repetition of it with the same one. */
#ifndef LIMPHOME_APP_SESSION_H
#define LIMPHOME_APP_SESSION_H

#include <stdbool.h>
#include <stdint.h>

typedef enum session_verdict {
    SESSION_NEW,      /* decide, and answer with a new command */
    SESSION_REPEATED, /* answered before: send the same command again */
    SESSION_OLD,      /* of a number that is past, or ahead of its turn: drop */
    SESSION_OTHER,    /* of a session that is not ours: drop */
    SESSION_RESET,    /* ask for a reset (again): the plant is not in its initial pose yet */
} session_verdict;

typedef struct session_tracker {
    double timeout; /* silence of our session after which another one is taken up [s] */
    bool known;     /* a plant has been heard */
    bool resetting; /* a reset of `session` has been asked for */
    bool over;      /* `session` has ended, as the plant has told */
    bool restarted; /* the newest session began without our asking; cleared by the caller */
    int64_t session;
    int64_t seq;  /* newest answered */
    double heard; /* when our session was last heard [s] */
} session_tracker;

/* Nothing is known; the first plant heard is asked for a reset. */
void session_init(session_tracker *tracker, double timeout);

/* What to do about state (session, seq), heard at `now` [s, monotonic]. */
session_verdict session_judge(session_tracker *tracker, int64_t session, int64_t seq, bool lockstep, double now);

/* The plant must go back to its initial pose: states of the present session are now answered by SESSION_RESET. */
void session_reset(session_tracker *tracker);

/* The plant has told that `session` ended without our asking: the next one is taken up without waiting for silence. */
void session_over(session_tracker *tracker, int64_t session);

#endif
