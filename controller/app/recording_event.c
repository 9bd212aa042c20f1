#include "recording_event.h"

#include <string.h>

/* The header: sync word, number, time [us], length of channel and of data, all big-endian; then come those two. */
enum { AT_NUMBER = 4, AT_TIME = 12, AT_CHANNEL_LENGTH = 20, AT_DATA_LENGTH = 24 };
static const uint32_t sync_word = 0xEDA1DA01;

static uint32_t read_word(const unsigned char *bytes) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static int64_t read_long(const unsigned char *bytes) {
    return (int64_t)((uint64_t)read_word(bytes) << 32 | read_word(bytes + 4));
}

bool recording_event_read(FILE *file, recording_event *e) {
    if (fread(e->header, 1, RECORDING_HEADER, file) != RECORDING_HEADER || read_word(e->header) != sync_word) {
        return false;
    }
    const uint32_t channel = read_word(e->header + AT_CHANNEL_LENGTH), size = read_word(e->header + AT_DATA_LENGTH);
    if (channel >= RECORDING_CHANNEL_LENGTH || size > sizeof e->data ||
        fread(e->channel, 1, channel, file) != channel || fread(e->data, 1, size, file) != size) {
        return false;
    }
    e->channel[channel] = '\0';
    e->size = (int)size;
    e->number = read_long(e->header + AT_NUMBER);
    e->time = read_long(e->header + AT_TIME);
    e->bytes = (int64_t)RECORDING_HEADER + channel + size;
    return true;
}

bool recording_event_write(FILE *file, const recording_event *e) {
    const size_t channel = strlen(e->channel), size = (size_t)e->size;
    return fwrite(e->header, 1, RECORDING_HEADER, file) == RECORDING_HEADER &&
           fwrite(e->channel, 1, channel, file) == channel && fwrite(e->data, 1, size, file) == size;
}
