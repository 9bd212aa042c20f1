/* How old a state is, told from the plant's clock and ours, which have nothing to do with each other.
 *
 * By how much a state's arrival on our clock is later than its sending on the plant's is known up to what the clocks
 * differ by. The least of that in a session stands for a state that came at once; what is beyond it is age. The first
 * state answers a request of ours and so cannot have been sent before that, which bounds how small it can get: a state
 * from the future is an invention, and must not make all that follow look old. */
#ifndef LIMPHOME_APP_AGE_H
#define LIMPHOME_APP_AGE_H

typedef enum age_verdict {
    AGE_FRESH,
    AGE_STALE,     /* older than the limit */
    AGE_IMPOSSIBLE /* sent later than it can have been */
} age_verdict;

typedef struct age_tracker {
    double least;   /* arrival on our clock less sending on the plant's, of a state that came at once [s] */
    double floor;   /* which cannot be less than this [s] */
    double updated; /* when, on our clock [s]: the clocks drift */
} age_tracker;

/* The first state of a session: sent at `sent` on the plant's clock, it arrived at `now` on ours, where it was asked
 * for at `asked` [s]. */
void age_begin(age_tracker *tracker, double asked, double sent, double now);

/* A further one. */
age_verdict age_judge(age_tracker *tracker, double sent, double now, double limit);

#endif
