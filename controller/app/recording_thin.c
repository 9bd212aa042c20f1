#include "recording_thin.h"

#include <stdio.h>
#include <string.h>

#include "limphome_channels.h"
#include "recording_event.h"

/* Copies what is kept of `from`, which has `size` bytes. */
static bool copy_kept(FILE *from, FILE *to, int64_t size, int64_t limit) {
    const int64_t head = limit / 8, tail = size - limit / 2;
    int64_t at = 0;
    for (recording_event e; at < size && recording_event_read(from, &e); at += e.bytes) {
        const bool kept = at < head || at >= tail || strcmp(e.channel, LIMPHOME_CHANNEL_EPISODE) == 0;
        if (kept && !recording_event_write(to, &e)) {
            return false;
        }
    }
    return at == size;
}

/* Writes what is kept beside the file. */
static bool write_kept(const char *path, const char *fresh, int64_t limit, recording_place end,
                       char error[ERROR_LENGTH]) {
    FILE *from = fopen(path, "rb");
    if (from == NULL) {
        return files_fail(error, path);
    }
    FILE *to = fopen(fresh, "wb");
    bool good = to != NULL && copy_kept(from, to, end.bytes, limit);
    good = (good && files_sync(to, fresh, error)) || files_fail(error, fresh);
    fclose(from);
    return (to == NULL || fclose(to) == 0) && good;
}

bool recording_thin(recording *r, int64_t limit, bool *thinned, char error[ERROR_LENGTH]) {
    const recording_place end = recording_end(r);
    *thinned = false;
    r->longest = r->longest < limit ? limit : r->longest;
    if (end.bytes <= r->longest || r->error[0] != '\0') {
        return true;
    }
    char fresh[FILES_PATH_LENGTH + 8];
    snprintf(fresh, sizeof fresh, "%s.new", r->path);
    if (!recording_flush(r, error) || !write_kept(r->path, fresh, limit, end, error) ||
        !recording_replace(r, fresh, error)) {
        remove(fresh);
        return false;
    }
    r->longest = 2 * recording_end(r).bytes > limit ? 2 * recording_end(r).bytes : limit;
    *thinned = true;
    return true;
}
