/* The bus: LCM in and out, with every message checked on entry and counted, and all that is taken or sent recorded. */
#ifndef LIMPHOME_APP_BUS_H
#define LIMPHOME_APP_BUS_H

#include <stdbool.h>
#include <stdint.h>

#include "fail.h"
#include "learned.h"
#include "limphome_decision_t.h"
#include "limphome_episode_t.h"
#include "limphome_operate_t.h"
#include "limphome_reset_request_t.h"
#include "limphome_robot_state_t.h"
#include "limphome_status_t.h"
#include "limphome_velocity_command_t.h"
#include "recording.h"
#include "udpm.h"

/* Who is told of each good message as it comes in, to keep what is of use; what is kept is dealt with after bus_wait.
 */
typedef struct bus_listener {
    void (*state)(void *user, const limphome_robot_state_t *state);
    void (*status)(void *user, const limphome_status_t *status);    /* of the plant */
    bool (*operate)(void *user, const limphome_operate_t *message); /* whether it is obeyed, and so recorded */
    void *user;
} bus_listener;

/* What of a kind that comes from others is recorded in a second: a flood must not fill the disk. */
typedef struct bus_share {
    double second; /* when the present one began [s] */
    int recorded;  /* in it */
} bus_share;

/* Overruns in a second that make a flood: 5,000 messages. */
enum { BUS_FLOOD = 40 };

/* Owns the bus from bus_open to bus_close. */
typedef struct bus {
    udpm lcm;
    recording *recording; /* the caller's; told of all that is taken or sent */
    int64_t sender;       /* random per life */

    bus_listener listener;
    limphome_status_t counts; /* the counters of LIMPHOME_STATUS that are counted here and by the listener */
    double wait_time;         /* spent in bus_wait [s] */
    bus_share statuses;       /* of the plant */
    bus_share operates;
} bus;

/* Joins the bus at `url` (NULL: LCM's default) and records in `log`. False, with the reason in `error` and nothing left
 * open, on failure. */
bool bus_open(bus *b, const char *url, bus_listener listener, recording *log, char error[ERROR_LENGTH]);

/* Leaves the bus. */
void bus_close(bus *b);

/* Waits at most `timeout` [s], rounded up to milliseconds, for messages and takes in those that are there, but only so
 * many at once that the caller gets on under a flood. False if the bus is broken. */
bool bus_wait(bus *b, double timeout);

/* Adds a state that is acted upon to the log. */
void bus_record_state(bus *b, const limphome_robot_state_t *state);

/* Each publishes and records. A command or reset that `repeats` an earlier one is counted as resent and not recorded.
 */
void bus_send_command(bus *b, const limphome_velocity_command_t *command, bool repeats);
void bus_send_reset(bus *b, const limphome_reset_request_t *request, bool repeats);
void bus_send_decision(bus *b, const limphome_decision_t *decision);
void bus_send_episode(bus *b, const limphome_episode_t *episode);
void bus_send_policy(bus *b, const learned *l);
void bus_send_status(bus *b, const limphome_status_t *status);

/* Random, not 0. False, with the reason in `error`, if the system has none. */
bool bus_draw(int64_t *number, char error[ERROR_LENGTH]);

/* Monotonic clock [s], and the same in whole microseconds as messages carry it. */
double bus_now(void);
int64_t bus_now_us(void);

#endif
