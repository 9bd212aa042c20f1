/* Who is in charge of the robot: the learner, or a person who has taken it by hand. Without any I/O.
 *
 * Whoever has taken it keeps it against others for as long as he keeps it up: by a TAKE that echoes a state of no more
 * than the timeout ago and was sent after all of his that were obeyed, at least once in that time. So neither a
 * recording that is played back nor a copy on the way takes the robot, keeps it or gives it away. When he falls silent
 * a robot in real time is nobody's and stands still: it does not begin to drive by itself because a laptop has died. In
 * lockstep, where nothing can come to harm and a training run must not wait for a window that was closed, the learner
 * goes on. */
#ifndef LIMPHOME_APP_OPERATOR_H
#define LIMPHOME_APP_OPERATOR_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome_operate_t.h"

typedef enum operator_verdict {
    OPERATOR_OBEYED,
    OPERATOR_MALFORMED, /* another number of actuators than the robot's */
    OPERATOR_STALE,     /* echoes another session, a state of too long ago, or one that has not come */
    OPERATOR_DENIED,    /* another has the robot */
    OPERATOR_REPEATED,  /* not sent after the newest of its sender that was obeyed */
} operator_verdict;

/* The newest state of our session; none: session 0 and num_actuators 0. */
typedef struct operator_place {
    int64_t session;
    int64_t seq;
    int32_t num_actuators;
    bool lockstep;
} operator_place;

typedef struct operator_lease {
    double timeout;            /* silence by which the robot is lost [s] */
    int64_t longest_ago;       /* states by which an echo may be behind */
    int8_t in_charge;          /* a constant of decision_t */
    limphome_operate_t newest; /* that was obeyed */
    double heard;              /* when that was [s] */
} operator_lease;

/* The learner is in charge. `timeout` and `period`, between two states in real time [s]. */
void operator_init(operator_lease *lease, double timeout, double period);

/* A good message came at `now` [s, monotonic]. */
operator_verdict operator_hear(operator_lease *lease, const limphome_operate_t *message, const operator_place *place,
                               double now);

/* Who is in charge at `now` [s]; a constant of decision_t. */
int8_t operator_in_charge(operator_lease *lease, bool lockstep, double now);

/* What he who is in charge wants of each actuator: -1, 0 or 1; all 0 while that is nobody. */
const int8_t *operator_directions(const operator_lease *lease);

/* Sender of who has the robot by hand, or 0. */
int64_t operator_sender(const operator_lease *lease);

#endif
