/* The controller's half of the link: states in, commands and reset requests out.
 *
 * Each state is judged as it comes in, so that nothing that is not ours ever takes the place of what is. At most one is
 * waiting to be decided upon; all else that a state asks for, such as the same answer again, is done by the link. */
#ifndef LIMPHOME_APP_PLANT_LINK_H
#define LIMPHOME_APP_PLANT_LINK_H

#include "age.h"
#include "bus.h"
#include "fail.h"
#include "operator.h"
#include "session.h"
#include "settings.h"

typedef struct plant_link {
    bus bus;
    session_tracker session;
    age_tracker age;
    operator_lease hand;
    double command_timeout; /* age at which a state of a plant in real time is not acted on any more [s] */

    bool fresh; /* `newest` waits to be decided upon */
    limphome_robot_state_t newest;
    bool begins;                         /* `newest` is the first of its session that we decide upon */
    int64_t decided;                     /* seq of the newest state decided upon */
    bool unanswered;                     /* the newest state decided upon was heard again */
    bool asks;                           /* a reset has to be asked for */
    limphome_velocity_command_t command; /* answer to the newest state decided upon */
    int64_t requested;                   /* nonce of the newest request sent */
    double denied_due;                   /* a plant that obeys another is not asked before then [s] */

    /* when something of the kind was heard last [s]; 0: never */
    double heard;   /* from a plant at all */
    double denied;  /* from a plant that obeys another */
    double invalid; /* that is no state to decide upon */
    double paced;   /* from our plant, that a person holds it up */
} plant_link;

/* Joins the bus at `url` and records in `log`. False, with the reason in `error` and nothing left open, on failure. The
 * link must not be moved afterwards. */
bool plant_link_open(plant_link *l, const char *url, const settings *s, recording *log, char error[ERROR_LENGTH]);

/* Waits at most `timeout` [s] for messages. False if the bus is broken. */
bool plant_link_wait(plant_link *l, double timeout);

/* Why a session is asked for that no episode asks for; told once, before plant_link_answer asks for it. */
session_break plant_link_broken(plant_link *l);

/* Sees to all that was heard and needs no decision; a reset that is asked for is of `episode`. */
void plant_link_answer(plant_link *l, int32_t episode);

/* A state to be decided upon. */
typedef struct plant_state {
    limphome_robot_state_t state;
    bool begins; /* first of a session */
    bool gap;    /* something else than the command that we gave last leads to it */
} plant_state;

/* Hands it out; false if there is none. It must be answered by one of the next two, or be the last. */
bool plant_link_take(plant_link *l, plant_state *taken);

/* Answers it with velocities [m/s, rad/s], one for each actuator. */
void plant_link_command(plant_link *l, const limphome_robot_state_t *state, const float *velocity);

/* Answers it by asking for a reset, before `episode`. */
void plant_link_reset(plant_link *l, int32_t episode);

#endif
