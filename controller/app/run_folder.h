/* The run folder: episodes.csv, messages.lcmlog, policy.lcm and checkpoint/. It belongs to one controller at a time.
 * Files of what was learned are replaced whole or not at all; table and recording are cut, when a run is gone on with,
 * to what the checkpoint has learned from, so that all agree. */
#ifndef LIMPHOME_APP_RUN_FOLDER_H
#define LIMPHOME_APP_RUN_FOLDER_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "fail.h"
#include "files.h"
#include "learned.h"
#include "limphome_episode_t.h"
#include "recording.h"

typedef struct run_folder {
    char path[FILES_PATH_LENGTH]; /* "" if nothing is to be written */
    int lock;                     /* that of folder_lock.h */
    FILE *episodes;               /* episodes.csv */
    recording recording;          /* messages.lcmlog */
    bool thinned;                 /* it was told that the recording was thinned */
} run_folder;

/* A moment in a run: what the table and the recording held then. */
typedef struct run_folder_place {
    int32_t episodes;          /* finished */
    int64_t table;             /* bytes of episodes.csv */
    recording_place recording; /* where messages.lcmlog ended */
} run_folder_place;

/* All that return bool do so with the reason in `error`. */

/* Makes the folder `path` (NULL: nothing is written, all calls succeed) and its checkpoint/, and starts the table and
 * the recording. A folder that already holds a run is refused. */
bool run_folder_create(run_folder *folder, const char *path, char error[ERROR_LENGTH]);

/* Finds the newest checkpoint that is sound and whose episodes table and recording hold; each newer one is told of on
 * stderr. It must be of `settings_hash`. A run that was ended before its first has place->episodes 0 and *l unchanged:
 * it begins anew. Writes nothing. */
bool run_folder_find(const char *path, int64_t settings_hash, int32_t reset_every, run_folder_place *place, learned *l,
                     char error[ERROR_LENGTH]);

/* Goes on with an existing folder from a place that was found in it. */
bool run_folder_resume(run_folder *folder, const char *path, const run_folder_place *place, char error[ERROR_LENGTH]);

/* Thins the recording where it has become longer than `limit_mb` [MB], and says so on stderr the first time. Places
 * taken before are not good any more. */
bool run_folder_thin(run_folder *folder, int64_t limit_mb, char error[ERROR_LENGTH]);

/* What table and recording hold now, after `episodes` finished ones. */
run_folder_place run_folder_here(const run_folder *folder, int32_t episodes);

/* Cuts table and recording back to an earlier place. */
bool run_folder_cut(run_folder *folder, const run_folder_place *place, char error[ERROR_LENGTH]);

/* Adds a row to episodes.csv and hands it to the system. */
bool run_folder_episode(run_folder *folder, const limphome_episode_t *episode, char error[ERROR_LENGTH]);

/* Writes policy.lcm. */
bool run_folder_policy(const run_folder *folder, const learned *l, char error[ERROR_LENGTH]);

/* Writes checkpoint/episode_NNNNNN.lcm after the episodes it has learned from; what table and recording hold comes
 * first. */
bool run_folder_checkpoint(run_folder *folder, const learned *l, char error[ERROR_LENGTH]);

/* Closes table and recording; false if one is not complete. */
bool run_folder_close(run_folder *folder, char error[ERROR_LENGTH]);

/* Reads a policy file written by run_folder_policy. */
bool run_folder_read_policy(const char *path, learned *l, char error[ERROR_LENGTH]);

#endif
