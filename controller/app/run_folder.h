/* The run folder: episodes.csv, policy.lcm and checkpoint/. Files are replaced whole or not at all. */
#ifndef LIMPHOME_APP_RUN_FOLDER_H
#define LIMPHOME_APP_RUN_FOLDER_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "fail.h"
#include "learned.h"
#include "limphome_episode_t.h"

enum { RUN_FOLDER_PATH_LENGTH = 512 };

typedef struct run_folder {
    char path[RUN_FOLDER_PATH_LENGTH]; /* "" if nothing is to be written */
    FILE *episodes;                    /* episodes.csv */
} run_folder;

/* All of these return false with the reason in `error`. */

/* Makes the folder `path` (NULL: nothing is written, all calls succeed) and its checkpoint/, and starts episodes.csv.
 * A folder that already holds an episodes.csv is refused. */
bool run_folder_create(run_folder *folder, const char *path, char error[ERROR_LENGTH]);

/* Goes on with an existing folder: finds the newest checkpoint, which must be of `settings_hash`, and cuts episodes.csv
 * back to its episodes. */
bool run_folder_resume(run_folder *folder, const char *path, int64_t settings_hash, learned *l,
                       char error[ERROR_LENGTH]);

/* Adds a row to episodes.csv and flushes it. */
bool run_folder_episode(run_folder *folder, const limphome_episode_t *episode, char error[ERROR_LENGTH]);

/* Writes policy.lcm. */
bool run_folder_policy(const run_folder *folder, const learned *l, char error[ERROR_LENGTH]);

/* Writes checkpoint/episode_NNNNNN.lcm after the episodes it has learned from. */
bool run_folder_checkpoint(const run_folder *folder, const learned *l, char error[ERROR_LENGTH]);

/* Closes episodes.csv; false if it is not complete. */
bool run_folder_close(run_folder *folder, char error[ERROR_LENGTH]);

/* Reads a policy file written by run_folder_policy. */
bool run_folder_read_policy(const char *path, learned *l, char error[ERROR_LENGTH]);

#endif
