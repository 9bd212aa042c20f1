/* An experiment: states in, decisions out, until all episodes are done or it is stopped. */
#ifndef LIMPHOME_APP_EXPERIMENT_H
#define LIMPHOME_APP_EXPERIMENT_H

#include <signal.h>
#include <stdbool.h>

#include "bus.h"
#include "command_line.h"
#include "limphome/controller.h"
#include "limphome_checkpoint_t.h"
#include "limphome_velocity_command_t.h"
#include "run_folder.h"
#include "session.h"
#include "urdf.h"

typedef struct experiment {
    settings settings;
    urdf_robot robot;
    lh_config config;
    int64_t hash; /* of settings and robot: what a resumed run must share */
    run_folder folder;
    bus bus;
    session_tracker session;

    /* how the learner begins, once the first state has told which actuators obey */
    bool evaluating; /* drive with `policy`, without learning */
    bool resuming;   /* go on from `checkpoint` */
    limphome_policy_t policy;
    limphome_checkpoint_t checkpoint;

    bool learner_ready;
    lh_controller controller;
    limphome_velocity_command_t command; /* answer to the newest state, to be repeated when asked again */
    bool reset_sent;                     /* a reset request for the present session is out */

    int32_t finished; /* episodes */
    int64_t decisions;
    int64_t utime;    /* plant time of the newest state decided on [us] */
    int64_t stale;    /* messages of past states or other sessions */
    int64_t repeated; /* states heard again */
    double started;   /* monotonic [s] */
    double status_at; /* next status is due [s] */
    bool failed;      /* something could not be written or makes no sense; the reason has been printed */
} experiment;

/* Reads robot, policy or checkpoint, makes the run folder and joins the bus. False, with the reason on stderr, if
 * anything is wrong; then nothing is left open. */
bool experiment_open(experiment *e, const command_line *line);

/* Runs until all episodes are done (true), or something fails or *stop becomes non-zero (false). */
bool experiment_run(experiment *e, const volatile sig_atomic_t *stop);

/* Writes policy and, if the run is complete, the last checkpoint; closes everything. False if a file is not complete.
 */
bool experiment_close(experiment *e, bool complete);

#endif
