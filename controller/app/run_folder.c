#include "run_folder.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "episode_table.h"
#include "folder_lock.h"
#include "recording_thin.h"

enum { LARGEST_FILE = LEARNED_LARGEST };

static const char checkpoint_folder[] = "checkpoint", table_name[] = "episodes.csv",
                  recording_name[] = "messages.lcmlog", policy_name[] = "policy.lcm";

static bool make_folder(const char *path, char error[ERROR_LENGTH]) {
    struct stat there;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &there) == 0 && S_ISDIR(there.st_mode))) {
        return true;
    }
    return files_fail(error, path);
}

static bool exists(const char *path) {
    return access(path, F_OK) == 0;
}

static bool begin_table(run_folder *folder, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    return files_join(name, folder->path, table_name, error) && episode_table_create(&folder->episodes, name, error);
}

static bool begin_recording(run_folder *folder, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    return files_join(name, folder->path, recording_name, error) && recording_create(&folder->recording, name, error);
}

/* Takes the folder for this controller. */
static bool enter(run_folder *folder, const char *path, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    memset(folder, 0, sizeof *folder);
    folder->lock = -1;
    if (!files_join(name, path, checkpoint_folder, error) || !make_folder(path, error) ||
        !folder_lock_take(&folder->lock, path, error)) {
        return false;
    }
    snprintf(folder->path, sizeof folder->path, "%s", path);
    return make_folder(name, error);
}

bool run_folder_create(run_folder *folder, const char *path, char error[ERROR_LENGTH]) {
    if (path == NULL) {
        memset(folder, 0, sizeof *folder);
        folder->lock = -1;
        return true;
    }
    return enter(folder, path, error) && begin_table(folder, error) && begin_recording(folder, error);
}

/* Number of the newest checkpoint/episode_NNNNNN.lcm before that of `before`; 0 if there is none, -1 on failure. */
static long newest_checkpoint(const char *folder, long before, char error[ERROR_LENGTH]) {
    DIR *entries = opendir(folder);
    if (entries == NULL) {
        return errno == ENOENT ? 0 : (long)files_fail(error, folder) - 1;
    }
    long newest = 0;
    for (const struct dirent *entry; (entry = readdir(entries)) != NULL;) {
        long number = 0;
        char name[40];
        if (sscanf(entry->d_name, "episode_%9ld", &number) != 1) {
            continue;
        }
        snprintf(name, sizeof name, "episode_%06ld.lcm", number);
        if (strcmp(entry->d_name, name) == 0 && number > newest && number < before) {
            newest = number;
        }
    }
    closedir(entries);
    return newest;
}

/* Reads and checks checkpoint/episode_NNNNNN.lcm of that number. */
static bool read_checkpoint(const char *folder, long number, learned *l, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    char base[48];
    unsigned char bytes[LARGEST_FILE];
    size_t size;
    snprintf(base, sizeof base, "%s/episode_%06ld.lcm", checkpoint_folder, number);
    if (!files_join(name, folder, base, error) || !files_read(name, bytes, sizeof bytes, &size, error)) {
        return false;
    }
    const message_verdict verdict = learned_decode_checkpoint(bytes, size, l);
    if (verdict != MESSAGE_GOOD) {
        return fail_with(error, "%.200s: %s", name, message_verdict_text(verdict));
    }
    return learned_episode(l) == number || fail_with(error, "%.200s: is of another episode", name);
}

/* Where table and recording end that have `episodes` finished episodes. A recording that somebody took away is missed
 * by nothing here: another one begins. */
static bool find_place(const char *folder, int32_t episodes, run_folder_place *place, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    *place = (run_folder_place){.episodes = episodes};
    if (!files_join(name, folder, table_name, error) || !episode_table_find(name, episodes, &place->table, error) ||
        !files_join(name, folder, recording_name, error)) {
        return false;
    }
    return !exists(name) || recording_find(name, episodes, &place->recording, error);
}

/* A run without a checkpoint begins anew, unless what lies there is no run, or has come so far that it had one. */
static bool find_beginning(const char *folder, int32_t reset_every, run_folder_place *place, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    char none[ERROR_LENGTH];
    int64_t end;
    if (files_join(name, folder, table_name, error) && episode_table_find(name, reset_every + 1, &end, none)) {
        return fail_with(error, "%.200s: has more than %" PRId32 " episodes, but the checkpoints are gone", folder,
                         reset_every);
    }
    *place = (run_folder_place){.episodes = 0};
    return (exists(folder) || files_fail(error, folder)) && files_join(name, folder, table_name, error) &&
           (!exists(name) || episode_table_find(name, 0, &place->table, error));
}

bool run_folder_find(const char *path, int64_t settings_hash, int32_t reset_every, run_folder_place *place, learned *l,
                     char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    if (!files_join(name, path, checkpoint_folder, error)) {
        return false;
    }
    long number = newest_checkpoint(name, LH_LAST_EPISODE, error);
    if (number == 0) {
        return find_beginning(path, reset_every, place, error);
    }
    while (number > 0) {
        char why[ERROR_LENGTH] = "";
        if (read_checkpoint(path, number, l, why)) {
            if (learned_settings_hash(l) != settings_hash) {
                return fail_with(
                    error, "%.200s: was made with other settings or another robot; it cannot be gone on with", path);
            }
            if (find_place(path, (int32_t)number, place, why)) {
                return true;
            }
        }
        fprintf(stderr, "%s; the checkpoint after episode %ld is stepped over\n", why, number);
        number = newest_checkpoint(name, number, error);
    }
    return fail_with(error, "%.200s: holds no checkpoint that is good", name);
}

/* Adds to what is there, or begins with nothing. */
static bool go_on_with_table(run_folder *folder, int64_t end, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    if (!files_join(name, folder->path, table_name, error)) {
        return false;
    }
    if (end == 0) {
        return (remove(name) == 0 || errno == ENOENT || files_fail(error, name)) && begin_table(folder, error);
    }
    return episode_table_go_on(&folder->episodes, name, end, error);
}

static bool go_on_with_recording(run_folder *folder, recording_place end, char error[ERROR_LENGTH]) {
    char name[FILES_PATH_LENGTH];
    return end.bytes == 0 ? begin_recording(folder, error)
                          : files_join(name, folder->path, recording_name, error) &&
                                recording_go_on(&folder->recording, name, end, error);
}

bool run_folder_resume(run_folder *folder, const char *path, const run_folder_place *place, char error[ERROR_LENGTH]) {
    return enter(folder, path, error) && go_on_with_table(folder, place->table, error) &&
           go_on_with_recording(folder, place->recording, error);
}

bool run_folder_thin(run_folder *folder, int64_t limit_mb, char error[ERROR_LENGTH]) {
    bool thinned;
    if (!recording_thin(&folder->recording, limit_mb * 1000000, &thinned, error)) {
        return false;
    }
    if (thinned && !folder->thinned) {
        fprintf(stderr, "%s has grown to %" PRId64 " MB: of the middle of the run only the episodes' ends stay\n",
                recording_name, limit_mb);
    }
    folder->thinned = folder->thinned || thinned;
    return true;
}

run_folder_place run_folder_here(const run_folder *folder, int32_t episodes) {
    return (run_folder_place){.episodes = episodes,
                              .table = folder->episodes == NULL ? 0 : (int64_t)ftello(folder->episodes),
                              .recording = recording_end(&folder->recording)};
}

bool run_folder_cut(run_folder *folder, const run_folder_place *place, char error[ERROR_LENGTH]) {
    return (folder->episodes == NULL || files_cut(folder->episodes, table_name, place->table, error)) &&
           recording_cut(&folder->recording, place->recording, error);
}

bool run_folder_episode(run_folder *folder, const limphome_episode_t *episode, char error[ERROR_LENGTH]) {
    return folder->episodes == NULL || episode_table_add(folder->episodes, episode, error);
}

static bool write_encoded(const char *folder, const char *name, const unsigned char *bytes, int size,
                          char error[ERROR_LENGTH]) {
    char path[FILES_PATH_LENGTH];
    return files_join(path, folder, name, error) &&
           (size > 0 || fail_with(error, "%.200s: does not fit %d bytes", path, LARGEST_FILE)) &&
           files_replace(path, bytes, (size_t)size, error);
}

bool run_folder_policy(const run_folder *folder, const learned *l, char error[ERROR_LENGTH]) {
    unsigned char bytes[LARGEST_FILE];
    return folder->path[0] == '\0' ||
           write_encoded(folder->path, policy_name, bytes, learned_encode_policy(l, bytes, sizeof bytes), error);
}

bool run_folder_checkpoint(run_folder *folder, const learned *l, char error[ERROR_LENGTH]) {
    char name[40];
    unsigned char bytes[LARGEST_FILE];
    if (folder->path[0] == '\0') {
        return true;
    }
    snprintf(name, sizeof name, "%s/episode_%06" PRId32 ".lcm", checkpoint_folder, learned_episode(l));
    return files_sync(folder->episodes, table_name, error) && recording_flush(&folder->recording, error) &&
           write_encoded(folder->path, name, bytes, learned_encode_checkpoint(l, bytes, sizeof bytes), error);
}

static bool close_table(run_folder *folder, char error[ERROR_LENGTH]) {
    if (folder->episodes == NULL) {
        return true;
    }
    const bool synced = files_sync(folder->episodes, table_name, error);
    const bool closed = fclose(folder->episodes) == 0 || files_fail(error, table_name);
    folder->episodes = NULL;
    return synced && closed;
}

bool run_folder_close(run_folder *folder, char error[ERROR_LENGTH]) {
    const bool whole = close_table(folder, error);
    const bool recorded = recording_close(&folder->recording, error);
    if (folder->lock >= 0) {
        close(folder->lock);
        folder->lock = -1;
    }
    return whole && recorded;
}

bool run_folder_read_policy(const char *path, learned *l, char error[ERROR_LENGTH]) {
    unsigned char bytes[LARGEST_FILE];
    size_t size;
    if (!files_read(path, bytes, sizeof bytes, &size, error)) {
        return false;
    }
    const message_verdict verdict = learned_decode_policy(bytes, size, l);
    return verdict == MESSAGE_GOOD || fail_with(error, "%.200s: %s", path, message_verdict_text(verdict));
}
