/* An event of a recording, as LCM writes it. */
#ifndef LIMPHOME_APP_RECORDING_EVENT_H
#define LIMPHOME_APP_RECORDING_EVENT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "learned.h"

enum { RECORDING_CHANNEL_LENGTH = 64, RECORDING_HEADER = 28 };

typedef struct recording_event {
    int64_t number;
    int64_t time;  /* [us] */
    int64_t bytes; /* of all of it */
    char channel[RECORDING_CHANNEL_LENGTH];
    int size;
    unsigned char data[LEARNED_LARGEST];
    unsigned char header[RECORDING_HEADER]; /* as it stands in the file */
} recording_event;

/* Reads the next one. False at the end of the file and where what follows is not a whole event. */
bool recording_event_read(FILE *file, recording_event *e);

/* Writes it as it was read. */
bool recording_event_write(FILE *file, const recording_event *e);

#endif
