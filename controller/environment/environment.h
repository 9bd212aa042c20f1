/* The task on a plant for learners in other languages: what the controller is to its own learners, with a learner
 * outside. Actions go in; inputs, rewards and outcomes come out, by the library's task and the controller's half of the
 * link. Flat, so that it can be loaded from anywhere; instances are independent, each for one thread at a time.
 *
 *     environment *e = environment_open(config, robot, url, false, error);
 *     environment_reset(e, 1);
 *     for (;;) {
 *         while (environment_wait(e, 0.1, inputs, values) == ENVIRONMENT_WAITING) {}
 *         after an episode's end: environment_next(e, ...), or environment_reset(e, its number and 1) if that says so
 *         environment_act(e, action);
 *     } */
#ifndef LIMPHOME_ENVIRONMENT_H
#define LIMPHOME_ENVIRONMENT_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default) /* what whoever loads the library finds in it */

typedef struct environment environment;

enum { ENVIRONMENT_ERROR_LENGTH = 512 };

/* What a wait has come to. */
enum environment_result {
    ENVIRONMENT_FAILED = -1, /* environment_error tells why */
    ENVIRONMENT_WAITING,     /* no new state yet */
    ENVIRONMENT_GOES_ON,     /* a state: the first after a reset, or that to which the action led */
    ENVIRONMENT_GOAL,        /* likewise, and there the episode ended */
    ENVIRONMENT_TUMBLE,
    ENVIRONMENT_TIMEOUT,
    ENVIRONMENT_FAULT /* the plant has put the robot back on its own, as after a divergence: the episode ended
                         somewhere before, and nothing is known of the action */
};

/* Reads the settings and the robot, as --config and --robot of the programs name them, and joins the bus at `url`
 * (udpm.h). With `line`, inputs tell where the robot is on its line, too. NULL, with the reason in `error`, on failure.
 */
environment *environment_open(const char *config, const char *robot, const char *url, bool line,
                              char error[ENVIRONMENT_ERROR_LENGTH]);
void environment_close(environment *e);

/* Names of the values that a state tells, in their order, separated by commas; those of decision_t and episode_t mean
 * what they mean there. */
const char *environment_value_names(void);

/* How many inputs and joint actions there are: 0 before the first state, which tells which actuators obey. */
int32_t environment_num_inputs(const environment *e);
int32_t environment_num_actions(const environment *e);

/* Asks for the robot to be put into its initial pose; there `episode` begins, 1 to LH_LAST_EPISODE. */
void environment_reset(environment *e, int32_t episode);

/* Answers the newest state by joint action `action`, 0 to environment_num_actions - 1. */
void environment_act(environment *e, int32_t action);

/* Waits at most `timeout` [s] for the state that the last of these two leads to: one of environment_result. Fills
 * `inputs`, in [0, 1]: those of the task (observation.h); with `line` also the distance to the goal line over that of
 * the configuration, and lateral and heading error over +- the same and +- pi. Where the episode has ended both tell of
 * it, not of the next. */
int environment_wait(environment *e, double timeout, float *inputs, double *values);

/* The first state of the episode after one that has ended, where the robot stands: false, and nothing filled, if it has
 * to be put back instead. */
bool environment_next(const environment *e, float *inputs, double *values);

/* Why a call failed. */
const char *environment_error(const environment *e);

#pragma GCC visibility pop
#endif
