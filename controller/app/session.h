/* Which state to answer, and how: the controller's half of the protocol, without any I/O.
 *
 * A session is one life of the plant between two resets; within it states are numbered from 0. It is ours if its states
 * echo our sender and the nonce of our request; a late copy of an older one has an older nonce. The controller answers
 * each state of its session once with a new command and any repetition of it with the same one. */
#ifndef LIMPHOME_APP_SESSION_H
#define LIMPHOME_APP_SESSION_H

#include <stdbool.h>
#include <stdint.h>

typedef enum session_verdict {
    SESSION_NEW,      /* decide, and answer with a new command */
    SESSION_REPEATED, /* answered before: send the same command again */
    SESSION_OLD,      /* of a number or a session of ours that is past: drop */
    SESSION_AHEAD,    /* further ahead than the plant can be: drop */
    SESSION_OTHER,    /* of a session that is not ours: drop */
    SESSION_RESET,    /* ask for a reset (again) */
    SESSION_DENIED,   /* ask for one now and then: the plant obeys another, until that one falls silent */
} session_verdict;

/* What a state tells of its session. */
typedef struct session_label {
    int64_t session;
    int64_t seq;
    int64_t sender; /* whose request began it; 0: nobody's */
    int64_t nonce;  /* of that request */
    bool lockstep;
} session_label;

/* Why a session is asked for that no episode asks for. */
typedef enum session_break {
    SESSION_UNBROKEN,
    SESSION_FAULTED,  /* the plant has told that it ended by a fault */
    SESSION_ENDED,    /* it has told that it begins anew, or is silent in it while another is heard, of nobody */
    SESSION_TAKEN,    /* likewise, of another controller */
    SESSION_MISPLACED /* the plant is at another state than we are: something else was obeyed */
} session_break;

enum { SESSIONS_REMEMBERED = 32 };

typedef struct session_tracker {
    double timeout;  /* silence after which another session is taken up [s] */
    double period;   /* between two states in real time [s] */
    int64_t sender;  /* ours */
    uint64_t random; /* state of the generator of nonces */

    bool known;                        /* a plant has been heard */
    bool asking;                       /* a reset of `session` has been asked for */
    session_break over;                /* `session` has ended, as the plant has told, and why */
    session_break broken;              /* why; cleared by the caller */
    int64_t session;                   /* ours; while asking, the one to be reset */
    int64_t seq;                       /* newest answered of ours; while asking, newest heard */
    int64_t nonce;                     /* of the request that began ours, or of the one under way */
    double heard;                      /* when it was last heard, where it should be [s] */
    double placed;                     /* the same by the clock alone, whether we listened or not [s] */
    double asked;                      /* when the request under way was begun [s] */
    int misplaced;                     /* states since then that were not where they should be */
    int64_t past[SESSIONS_REMEMBERED]; /* sessions known to be over */
    unsigned past_count;               /* so far; the newest ones are remembered */
} session_tracker;

/* Nothing is known; the first plant heard is asked for a reset. `seed` is of the nonces, which only have to differ. */
void session_init(session_tracker *tracker, int64_t sender, uint64_t seed, double timeout, double period);

/* What to do about a state heard at `now` [s, monotonic]. */
session_verdict session_judge(session_tracker *tracker, const session_label *label, double now);

/* Whether a state is of a session that another sender has asked for. */
bool session_is_anothers(const session_tracker *tracker, const session_label *label);

/* The plant must begin anew: states of the present session are now answered by SESSION_RESET. */
void session_reset(session_tracker *tracker, double now);

/* The plant has told that `session` ended without our asking: the next one is taken up without waiting for silence. */
void session_over(session_tracker *tracker, int64_t session, session_break why);

/* We have not listened for so long [s]: that was no silence of the plant's. */
void session_paused(session_tracker *tracker, double seconds);

#endif
