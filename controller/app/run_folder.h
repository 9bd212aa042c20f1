/* The run folder: episodes.csv, policy.lcm and checkpoint/. Files are replaced whole or not at all. */
#ifndef LIMPHOME_APP_RUN_FOLDER_H
#define LIMPHOME_APP_RUN_FOLDER_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "limphome/controller.h"
#include "limphome_checkpoint_t.h"
#include "limphome_policy_t.h"

enum { RUN_FOLDER_PATH_LENGTH = 512 };

typedef struct run_folder {
    char path[RUN_FOLDER_PATH_LENGTH]; /* "" if nothing is to be written */
    FILE *episodes;                    /* episodes.csv */
} run_folder;

/* All of these print the reason on stderr when they return false. */

/* Makes the folder `path` (NULL: nothing is written, all calls succeed) and its checkpoint/, and starts episodes.csv.
 * A folder that already holds an episodes.csv is refused. */
bool run_folder_create(run_folder *folder, const char *path);

/* Goes on with an existing folder: finds the newest checkpoint and cuts episodes.csv back to its episodes. */
bool run_folder_resume(run_folder *folder, const char *path, limphome_checkpoint_t *checkpoint);

/* Adds a row to episodes.csv and flushes it. */
bool run_folder_episode(run_folder *folder, const lh_summary *summary, double decision_period);

/* Writes policy.lcm. */
bool run_folder_policy(const run_folder *folder, const limphome_policy_t *policy);

/* Writes checkpoint/episode_NNNNNN.lcm after the episodes it has learned from. */
bool run_folder_checkpoint(const run_folder *folder, const limphome_checkpoint_t *checkpoint);

/* Closes episodes.csv; false if it is not complete. */
bool run_folder_close(run_folder *folder);

/* Reads a policy file written by run_folder_policy. */
bool run_folder_read_policy(const char *path, limphome_policy_t *policy);

/* Word for an outcome, as in episodes.csv. */
const char *run_folder_outcome(lh_outcome outcome);

#endif
