/* messages.lcmlog: an LCM event log of what a run takes and sends. It ends where its writer ended, in the middle of an
 * event if that was killed or the disk was full; going on begins by cutting it to what belongs to the episodes that are
 * kept. */
#ifndef LIMPHOME_APP_RECORDING_H
#define LIMPHOME_APP_RECORDING_H

#include <lcm/eventlog.h>
#include <stdbool.h>
#include <stdint.h>

#include "fail.h"
#include "files.h"

typedef struct recording {
    lcm_eventlog_t *log; /* NULL: nothing is recorded */
    char path[FILES_PATH_LENGTH];
    char error[ERROR_LENGTH]; /* why an event could not be written; "" while all were */
    int64_t time;             /* of the events that are added now (recording_at) [us] */
    int64_t clock;            /* of the plant then [us] */
    bool follows;             /* the clock of before is the same plant's */
    int64_t longest;          /* size above which it is thinned the next time (recording_thin.h) [bytes] */
} recording;

/* A place between two events. */
typedef struct recording_place {
    int64_t bytes;  /* before it */
    int64_t events; /* number of the next one */
    int64_t time;   /* of the one before [us] */
} recording_place;

/* All that return bool do so with the reason in `error`. */

/* Begins a new file; one that is there is lost. */
bool recording_create(recording *r, const char *path, char error[ERROR_LENGTH]);

/* Where that ends which belongs to the first `episodes` episodes: behind the first message of what was learned up to
 * there, or behind that of the episode's end where there is none. False if an event before is not whole, or there is
 * neither. */
bool recording_find(const char *path, int32_t episodes, recording_place *end, char error[ERROR_LENGTH]);

/* Opens a file to add to what it holds before `end`. */
bool recording_go_on(recording *r, const char *path, recording_place end, char error[ERROR_LENGTH]);

/* The plant's clock tells `utime` [us]: log time is plant time, so that a recording plays back as fast as it happened,
 * however fast it was computed. It begins at 0 and goes on by what the plant's clock does; never back, where that
 * begins anew with a session or a plant, nor by what passed between two runs that go on in one file. */
void recording_at(recording *r, int64_t utime);

/* Adds a message, under that time. */
void recording_add(recording *r, const char *channel, void *data, int size);

/* Where the next event comes to lie. */
recording_place recording_end(const recording *r);

/* Drops what lies behind `end`. */
bool recording_cut(recording *r, recording_place end, char error[ERROR_LENGTH]);

/* Goes on in the file `fresh`, which takes the place and the name of the present one and holds all or a part of it. */
bool recording_replace(recording *r, const char *fresh, char error[ERROR_LENGTH]);

/* False if an event could not be written so far. */
bool recording_good(const recording *r, char error[ERROR_LENGTH]);

/* Hands all events to the system. False if that fails, or an event could not be written before. */
bool recording_flush(recording *r, char error[ERROR_LENGTH]);

/* Brings it to the disk and closes it. */
bool recording_close(recording *r, char error[ERROR_LENGTH]);

#endif
