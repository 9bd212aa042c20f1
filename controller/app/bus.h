/* The bus: LCM in and out, with every message checked on entry and counted, and all that is taken or sent recorded. */
#ifndef LIMPHOME_APP_BUS_H
#define LIMPHOME_APP_BUS_H

#include <stdbool.h>
#include <stdint.h>

#include "fail.h"
#include "learned.h"
#include "limphome_decision_t.h"
#include "limphome_episode_t.h"
#include "limphome_robot_state_t.h"
#include "limphome_status_t.h"
#include "limphome_velocity_command_t.h"
#include "recording.h"
#include "udpm.h"

/* Owns the bus from bus_open to bus_close. */
typedef struct bus {
    udpm lcm;
    recording *recording; /* the caller's; told of all that is taken or sent */
    int64_t sender;       /* random per life */

    bool fresh;                    /* `newest` has not been taken yet */
    limphome_robot_state_t newest; /* newest good state heard */
    bool faulted;                  /* `fault_session` has not been taken yet */
    int64_t fault_session;         /* newest session that the plant told to have ended by a fault */
    limphome_status_t counts;      /* the counters of LIMPHOME_STATUS that are counted here */
    double wait_time;              /* spent in bus_wait [s] */
} bus;

/* Joins the bus at `url` (NULL: LCM's default) and records in `log`. False, with the reason in `error` and nothing left
 * open, on failure. */
bool bus_open(bus *b, const char *url, recording *log, char error[ERROR_LENGTH]);

/* Leaves the bus. */
void bus_close(bus *b);

/* Waits at most `timeout` [s], rounded up to milliseconds, for messages and takes in all that are there. False if the
 * bus is broken. */
bool bus_wait(bus *b, double timeout);

/* Hands out the newest state heard since the last call; false if there is none. */
bool bus_take(bus *b, limphome_robot_state_t *state);

/* Hands out the session that the plant has told to have ended by a fault, once; false if there is none. */
bool bus_take_fault(bus *b, int64_t *session);

/* Adds a state that is acted upon to the log. */
void bus_record_state(bus *b, const limphome_robot_state_t *state);

/* Each publishes and records. A command or reset that `repeats` an earlier one is counted as resent and not recorded.
 */
void bus_send_command(bus *b, const limphome_velocity_command_t *command, bool repeats);
void bus_send_reset(bus *b, int64_t session, int64_t seq, int32_t episode, bool repeats);
void bus_send_decision(bus *b, const limphome_decision_t *decision);
void bus_send_episode(bus *b, const limphome_episode_t *episode);
void bus_send_policy(bus *b, const learned *l);
void bus_send_status(bus *b, const limphome_status_t *status);

/* Monotonic clock [s], and the same in whole microseconds as messages carry it. */
double bus_now(void);
int64_t bus_now_us(void);

#endif
