#include "run_folder.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_FILE = LEARNED_LARGEST, LINE_LENGTH = 512 };

static const char csv_header[] =
    "episode,outcome,steps,duration_s,reward,reward_motion,reward_goal,reward_stability,reward_tumble,lateral_error_m,"
    "heading_change_rad,temperature\n";

/* What a call of the system has left in errno. */
static bool fail_by_system(char error[ERROR_LENGTH], const char *path) {
    return fail_with(error, "%.200s: %s", path, strerror(errno));
}

static bool join(char path[RUN_FOLDER_PATH_LENGTH], const char *folder, const char *name, char error[ERROR_LENGTH]) {
    const int length = snprintf(path, RUN_FOLDER_PATH_LENGTH, "%s/%s", folder, name);
    return length < RUN_FOLDER_PATH_LENGTH || fail_with(error, "%.200s: the path is too long", folder);
}

static bool make_folder(const char *path, char error[ERROR_LENGTH]) {
    return mkdir(path, 0777) == 0 || errno == EEXIST || fail_by_system(error, path);
}

/* Gives a file that was written beside `path` its name, so that a reader or a crash never meets half of it; nothing is
 * left of one that could not be `written`. */
static bool put_in_place(const char *fresh, const char *path, bool written, char error[ERROR_LENGTH]) {
    if (written && rename(fresh, path) == 0) {
        return true;
    }
    fail_by_system(error, path);
    remove(fresh);
    return false;
}

static bool replace_file(const char *path, const void *data, size_t size, char error[ERROR_LENGTH]) {
    char fresh[RUN_FOLDER_PATH_LENGTH + 8];
    snprintf(fresh, sizeof fresh, "%s.new", path);
    FILE *file = fopen(fresh, "wb");
    if (file == NULL) {
        return fail_by_system(error, fresh);
    }
    const bool good = fwrite(data, 1, size, file) == size && fflush(file) == 0 && fsync(fileno(file)) == 0;
    return put_in_place(fresh, path, fclose(file) == 0 && good, error);
}

/* Reads a whole small file; its length, or -1. */
static long read_file(const char *path, unsigned char bytes[LARGEST_FILE], char error[ERROR_LENGTH]) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        fail_by_system(error, path);
        return -1;
    }
    const size_t size = fread(bytes, 1, LARGEST_FILE, file);
    const bool good = !ferror(file);
    fclose(file);
    if (!good) {
        fail_with(error, "%.200s: cannot be read", path);
        return -1;
    }
    return (long)size;
}

bool run_folder_create(run_folder *folder, const char *path, char error[ERROR_LENGTH]) {
    memset(folder, 0, sizeof *folder);
    if (path == NULL) {
        return true;
    }
    char name[RUN_FOLDER_PATH_LENGTH];
    snprintf(folder->path, sizeof folder->path, "%s", path);
    if (!join(name, path, "checkpoint", error) || !make_folder(path, error) || !make_folder(name, error) ||
        !join(name, path, "episodes.csv", error)) {
        return false;
    }
    folder->episodes = fopen(name, "wx");
    if (folder->episodes == NULL) {
        return errno == EEXIST
                   ? fail_with(error, "%.200s: there is a run in this folder already; --resume goes on with it", name)
                   : fail_by_system(error, name);
    }
    if (fputs(csv_header, folder->episodes) < 0 || fflush(folder->episodes) != 0) {
        fail_by_system(error, name);
        fclose(folder->episodes);
        folder->episodes = NULL;
        return false;
    }
    return true;
}

/* Number of the newest checkpoint/episode_NNNNNN.lcm, or -1. */
static long newest_checkpoint(const char *folder, char error[ERROR_LENGTH]) {
    DIR *entries = opendir(folder);
    if (entries == NULL) {
        fail_by_system(error, folder);
        return -1;
    }
    long newest = -1;
    for (const struct dirent *entry; (entry = readdir(entries)) != NULL;) {
        long number = 0;
        char rest[8] = "";
        if (sscanf(entry->d_name, "episode_%ld%7s", &number, rest) == 2 && strcmp(rest, ".lcm") == 0 &&
            number > newest) {
            newest = number;
        }
    }
    closedir(entries);
    if (newest < 0) {
        fail_with(error, "%.200s: holds no checkpoint to go on from", folder);
    }
    return newest;
}

/* Copies header and rows of episodes 1 to `episodes` into a new file that replaces the old one. */
static bool cut_episodes(const char *path, int32_t episodes, char error[ERROR_LENGTH]) {
    char fresh[RUN_FOLDER_PATH_LENGTH + 8];
    snprintf(fresh, sizeof fresh, "%s.new", path);
    FILE *old = fopen(path, "r");
    if (old == NULL) {
        return fail_by_system(error, path);
    }
    FILE *cut = fopen(fresh, "w");
    if (cut == NULL) {
        fclose(old);
        return fail_by_system(error, fresh);
    }
    char line[LINE_LENGTH];
    int32_t rows = -1;
    bool whole = true, written = true;
    while (whole && written && rows < episodes) {
        whole = fgets(line, sizeof line, old) != NULL && strchr(line, '\n') != NULL &&
                (rows >= 0 || strcmp(line, csv_header) == 0);
        written = !whole || fputs(line, cut) >= 0;
        rows++;
    }
    fclose(old);
    written = fclose(cut) == 0 && written;
    if (!whole) {
        remove(fresh);
        return fail_with(error, "%.200s: does not hold the rows of all episodes up to the checkpoint", path);
    }
    return put_in_place(fresh, path, written, error);
}

/* Reads and checks checkpoint/episode_NNNNNN.lcm of that number. */
static bool read_checkpoint(const char *folder, long number, int64_t settings_hash, learned *l,
                            char error[ERROR_LENGTH]) {
    char name[RUN_FOLDER_PATH_LENGTH];
    char base[48];
    unsigned char bytes[LARGEST_FILE];
    snprintf(base, sizeof base, "checkpoint/episode_%06ld.lcm", number);
    const long size = join(name, folder, base, error) ? read_file(name, bytes, error) : -1;
    if (size < 0) {
        return false;
    }
    const message_verdict verdict = learned_decode_checkpoint(bytes, (size_t)size, l);
    if (verdict != MESSAGE_GOOD) {
        return fail_with(error, "%.200s: %s", name, message_verdict_text(verdict));
    }
    if (learned_settings_hash(l) != settings_hash) {
        return fail_with(error, "%.200s: was made with other settings or another robot; it cannot be gone on with",
                         folder);
    }
    return learned_episode(l) == number || fail_with(error, "%.200s: is of another episode", name);
}

bool run_folder_resume(run_folder *folder, const char *path, int64_t settings_hash, learned *l,
                       char error[ERROR_LENGTH]) {
    memset(folder, 0, sizeof *folder);
    snprintf(folder->path, sizeof folder->path, "%s", path);
    char name[RUN_FOLDER_PATH_LENGTH];
    long number = -1;
    if (!join(name, path, "checkpoint", error) || (number = newest_checkpoint(name, error)) < 0 ||
        !read_checkpoint(path, number, settings_hash, l, error) || !join(name, path, "episodes.csv", error) ||
        !cut_episodes(name, learned_episode(l), error)) {
        return false;
    }
    folder->episodes = fopen(name, "a");
    return folder->episodes != NULL || fail_by_system(error, name);
}

static const char *outcome_word(int8_t outcome) {
    switch (outcome) {
        case LIMPHOME_EPISODE_T_GOAL:
            return "goal";
        case LIMPHOME_EPISODE_T_TUMBLE:
            return "tumble";
        case LIMPHOME_EPISODE_T_TIMEOUT:
            return "timeout";
        default: /* of a number from outside */
            return "none";
    }
}

bool run_folder_episode(run_folder *folder, const limphome_episode_t *e, char error[ERROR_LENGTH]) {
    if (folder->episodes == NULL) {
        return true;
    }
    fprintf(folder->episodes, "%d,%s,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", e->episode,
            outcome_word(e->outcome), e->steps, e->duration, e->reward, e->reward_motion, e->reward_goal,
            e->reward_stability, e->reward_tumble, e->lateral_error, e->heading_change, e->temperature);
    return fflush(folder->episodes) == 0 || fail_by_system(error, "episodes.csv");
}

static bool write_encoded(const char *folder, const char *name, const unsigned char *bytes, int size,
                          char error[ERROR_LENGTH]) {
    char path[RUN_FOLDER_PATH_LENGTH];
    return join(path, folder, name, error) &&
           (size > 0 || fail_with(error, "%.200s: does not fit %d bytes", path, LARGEST_FILE)) &&
           replace_file(path, bytes, (size_t)size, error);
}

bool run_folder_policy(const run_folder *folder, const learned *l, char error[ERROR_LENGTH]) {
    unsigned char bytes[LARGEST_FILE];
    return folder->path[0] == '\0' ||
           write_encoded(folder->path, "policy.lcm", bytes, learned_encode_policy(l, bytes, sizeof bytes), error);
}

bool run_folder_checkpoint(const run_folder *folder, const learned *l, char error[ERROR_LENGTH]) {
    char name[40];
    unsigned char bytes[LARGEST_FILE];
    snprintf(name, sizeof name, "checkpoint/episode_%06d.lcm", learned_episode(l));
    return folder->path[0] == '\0' ||
           write_encoded(folder->path, name, bytes, learned_encode_checkpoint(l, bytes, sizeof bytes), error);
}

bool run_folder_close(run_folder *folder, char error[ERROR_LENGTH]) {
    const bool good = folder->episodes == NULL || fclose(folder->episodes) == 0;
    folder->episodes = NULL;
    return good || fail_by_system(error, "episodes.csv");
}

bool run_folder_read_policy(const char *path, learned *l, char error[ERROR_LENGTH]) {
    unsigned char bytes[LARGEST_FILE];
    const long size = read_file(path, bytes, error);
    if (size < 0) {
        return false;
    }
    const message_verdict verdict = learned_decode_policy(bytes, (size_t)size, l);
    return verdict == MESSAGE_GOOD || fail_with(error, "%.200s: %s", path, message_verdict_text(verdict));
}
