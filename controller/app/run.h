/* A run: states in, decisions out, until all episodes are done or it is stopped. */
#ifndef LIMPHOME_APP_RUN_H
#define LIMPHOME_APP_RUN_H

#include <signal.h>
#include <stdbool.h>

#include "command_line.h"
#include "fail.h"
#include "learned.h"
#include "limphome/controller.h"
#include "notice.h"
#include "plant_link.h"
#include "robot_description.h"
#include "rollback.h"
#include "run_folder.h"
#include "trouble.h"

typedef struct run {
    settings settings;
    lh_robot robot;
    lh_config config;
    lh_shapes shapes;
    int64_t hash; /* of settings and robot: what a resumed run must share */
    run_folder folder;
    plant_link link;
    trouble trouble;
    char error[ERROR_LENGTH]; /* why it failed; "" while it has not */
    bool gave_up;             /* it failed as there was nothing to decide on for too long */

    /* how the learner begins, once the first state has told which actuators obey */
    bool evaluating; /* drive with the policy in `learned`, without learning */
    bool resuming;   /* go on from the checkpoint in `learned` */
    learned learned; /* before and, where it is saved, by this run */

    bool learner_ready;
    lh_controller controller;
    rollback kept;  /* where the plant was last put into its initial pose */
    bool restarted; /* the session that is asked for is one that no episode asked for */
    bool gap;       /* the next step is not what the decision before it led to */

    int32_t finished; /* episodes, those of the policy or checkpoint among them */
    int32_t last;     /* episode after which the run is complete */
    int64_t decisions;
    int64_t utime;    /* plant time of the newest state decided on [us] */
    double started;   /* monotonic [s] */
    double status_at; /* next status is due [s] */
    int8_t in_charge; /* as was told last; a constant of decision_t */
    notice invalid;   /* states that the library refuses */
    notice restarts;
    notice handovers;
} run;

/* Reads all that a run of this robot follows from; of a run that is to be gone on with it prints after which episode it
 * would be. False, with the reason in r->error, if anything is wrong. Nothing is written. */
bool run_check(run *r, const command_line *line, const robot_description *robot);

/* Joins the bus, reads policy or checkpoint and makes the run folder. False, with the reason in
 * r->error and nothing left open, if anything is wrong. */
bool run_open(run *r, const command_line *line, const robot_description *robot);

/* Decides until all episodes are done (true), or something fails or *stop becomes non-zero (false). */
bool run_decide(run *r, const volatile sig_atomic_t *stop);

/* Writes policy and, if the run is complete, the last checkpoint; closes everything. False, with the reason in
 * r->error, if anything has failed so far or a file is not complete. */
bool run_close(run *r, bool complete);

#endif
