#include "recording.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "learned.h"
#include "limphome_channels.h"
#include "limphome_episode_t.h"
#include "recording_event.h"

static bool is_of_learned(const recording_event *e) {
    return strcmp(e->channel, LIMPHOME_CHANNEL_POLICY) == 0 || strcmp(e->channel, LIMPHOME_CHANNEL_PLANNER) == 0;
}

/* The episode whose end, or what was learned up to it, the event tells of; -1 for another event. */
static int32_t episode_told(const recording_event *e) {
    learned policy;
    limphome_episode_t episode;
    if (strcmp(e->channel, LIMPHOME_CHANNEL_EPISODE) == 0) {
        return limphome_episode_t_decode(e->data, 0, e->size, &episode) == e->size ? episode.episode : -1;
    }
    if (is_of_learned(e)) {
        return learned_decode_policy(e->data, (size_t)e->size, &policy) == MESSAGE_GOOD ? learned_episode(&policy) : -1;
    }
    return -1;
}

bool recording_find(const char *path, int32_t episodes, recording_place *end, char error[ERROR_LENGTH]) {
    recording_event e;
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return files_fail(error, path);
    }
    bool found = false, told = false;
    recording_place at = {0, 0, 0};
    while (!told && recording_event_read(file, &e)) {
        at.bytes += e.bytes;
        at.events = e.number + 1;
        at.time = e.time;
        if (episode_told(&e) == episodes) {
            *end = at;
            found = true;
            told = is_of_learned(&e); /* again by a run that was interrupted afterwards */
        }
    }
    fclose(file);
    return found ||
           fail_with(error, "%.200s: is whole up to byte %" PRId64 " only, without the end of episode %" PRId32, path,
                     at.bytes, episodes);
}

static bool open_log(recording *r, const char *path, const char *mode, char error[ERROR_LENGTH]) {
    *r = (recording){.log = lcm_eventlog_create(path, mode)};
    snprintf(r->path, sizeof r->path, "%s", path);
    return r->log != NULL || files_fail(error, path);
}

bool recording_create(recording *r, const char *path, char error[ERROR_LENGTH]) {
    return open_log(r, path, "w", error);
}

bool recording_go_on(recording *r, const char *path, recording_place end, char error[ERROR_LENGTH]) {
    return open_log(r, path, "a", error) && recording_cut(r, end, error);
}

void recording_at(recording *r, int64_t utime) {
    const int64_t clock = utime > 0 ? utime : 0;
    const int64_t passed = r->follows && clock > r->clock ? clock - r->clock : 0;
    r->time = passed < INT64_MAX - r->time ? r->time + passed : INT64_MAX;
    r->clock = clock;
    r->follows = true;
}

void recording_add(recording *r, const char *channel, void *data, int size) {
    if (r->log == NULL || r->error[0] != '\0') {
        return;
    }
    char name[RECORDING_CHANNEL_LENGTH];
    snprintf(name, sizeof name, "%s", channel);
    lcm_eventlog_event_t e = {
        .timestamp = r->time,
        .channellen = (int32_t)strlen(name),
        .datalen = size,
        .channel = name,
        .data = data,
    };
    if (lcm_eventlog_write_event(r->log, &e) != 0) {
        files_fail(r->error, r->path);
    }
}

recording_place recording_end(const recording *r) {
    return r->log == NULL ? (recording_place){0, 0, 0}
                          : (recording_place){(int64_t)ftello(r->log->f), r->log->eventcount, r->time};
}

bool recording_cut(recording *r, recording_place end, char error[ERROR_LENGTH]) {
    if (r->log == NULL) {
        return true;
    }
    r->log->eventcount = end.events;
    r->time = end.time;
    r->follows = false;
    return files_cut(r->log->f, r->path, end.bytes, error);
}

bool recording_replace(recording *r, const char *fresh, char error[ERROR_LENGTH]) {
    const int64_t events = r->log->eventcount;
    if (!files_put_in_place(fresh, r->path, error)) {
        return false;
    }
    lcm_eventlog_destroy(r->log);
    r->log = lcm_eventlog_create(r->path, "a");
    if (r->log == NULL) {
        return files_fail(error, r->path);
    }
    r->log->eventcount = events;
    return fseeko(r->log->f, 0, SEEK_END) == 0 || files_fail(error, r->path);
}

bool recording_good(const recording *r, char error[ERROR_LENGTH]) {
    return r->error[0] == '\0' || fail_with(error, "%s", r->error);
}

bool recording_flush(recording *r, char error[ERROR_LENGTH]) {
    if (r->error[0] == '\0' && r->log != NULL && fflush(r->log->f) != 0) {
        files_fail(r->error, r->path);
    }
    return recording_good(r, error);
}

bool recording_close(recording *r, char error[ERROR_LENGTH]) {
    if (r->log == NULL) {
        return true;
    }
    const bool good = recording_flush(r, error) && files_sync(r->log->f, r->path, error);
    lcm_eventlog_destroy(r->log);
    r->log = NULL;
    return good;
}
