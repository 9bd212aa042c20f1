#include "run_folder.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "messages.h"

enum { LARGEST_FILE = 16384, LINE_LENGTH = 512 };

static const char csv_header[] =
    "episode,outcome,steps,duration_s,reward,reward_motion,reward_goal,reward_stability,reward_tumble,lateral_error_m,"
    "heading_change_rad,temperature\n";

/* Says why `path` failed; always false. */
static bool complain(const char *path, const char *what) {
    fprintf(stderr, "%s: %s\n", path, what);
    return false;
}

static bool join(char path[RUN_FOLDER_PATH_LENGTH], const char *folder, const char *name) {
    const int length = snprintf(path, RUN_FOLDER_PATH_LENGTH, "%s/%s", folder, name);
    return length < RUN_FOLDER_PATH_LENGTH || complain(folder, "the path is too long");
}

static bool make_folder(const char *path) {
    return mkdir(path, 0777) == 0 || errno == EEXIST || complain(path, strerror(errno));
}

/* Writes beside the file and then renames, so that a reader or a crash never meets half of it. */
static bool replace_file(const char *path, const void *data, size_t size) {
    char fresh[RUN_FOLDER_PATH_LENGTH + 8];
    snprintf(fresh, sizeof fresh, "%s.new", path);
    FILE *file = fopen(fresh, "wb");
    if (file == NULL) {
        return complain(fresh, strerror(errno));
    }
    bool good = fwrite(data, 1, size, file) == size && fflush(file) == 0 && fsync(fileno(file)) == 0;
    good = fclose(file) == 0 && good;
    good = good && rename(fresh, path) == 0;
    return good || complain(path, strerror(errno));
}

/* Reads a whole small file; its length, or -1. */
static long read_file(const char *path, unsigned char bytes[LARGEST_FILE]) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        complain(path, strerror(errno));
        return -1;
    }
    const size_t size = fread(bytes, 1, LARGEST_FILE, file);
    const bool good = !ferror(file);
    fclose(file);
    if (!good) {
        complain(path, "cannot be read");
        return -1;
    }
    return (long)size;
}

bool run_folder_create(run_folder *folder, const char *path) {
    memset(folder, 0, sizeof *folder);
    if (path == NULL) {
        return true;
    }
    char name[RUN_FOLDER_PATH_LENGTH];
    snprintf(folder->path, sizeof folder->path, "%s", path);
    if (!join(name, path, "checkpoint") || !make_folder(path) || !make_folder(name) ||
        !join(name, path, "episodes.csv")) {
        return false;
    }
    folder->episodes = fopen(name, "wx");
    if (folder->episodes == NULL) {
        return complain(name, errno == EEXIST ? "there is a run in this folder already; --resume goes on with it"
                                              : strerror(errno));
    }
    return fputs(csv_header, folder->episodes) >= 0 && fflush(folder->episodes) == 0;
}

/* Number of the newest checkpoint/episode_NNNNNN.lcm, or -1. */
static long newest_checkpoint(const char *folder) {
    DIR *entries = opendir(folder);
    if (entries == NULL) {
        complain(folder, strerror(errno));
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
        complain(folder, "holds no checkpoint to go on from");
    }
    return newest;
}

/* Copies header and rows of episodes 1 to `episodes` into a new file that replaces the old one. */
static bool cut_episodes(const char *path, int32_t episodes) {
    char fresh[RUN_FOLDER_PATH_LENGTH + 8];
    snprintf(fresh, sizeof fresh, "%s.new", path);
    FILE *old = fopen(path, "r");
    if (old == NULL) {
        return complain(path, strerror(errno));
    }
    FILE *cut = fopen(fresh, "w");
    if (cut == NULL) {
        fclose(old);
        return complain(fresh, strerror(errno));
    }
    char line[LINE_LENGTH];
    int32_t rows = -1;
    bool good = true;
    while (good && rows < episodes && fgets(line, sizeof line, old) != NULL) {
        good = strchr(line, '\n') != NULL && (rows >= 0 || strcmp(line, csv_header) == 0) && fputs(line, cut) >= 0;
        rows++;
    }
    fclose(old);
    good = fclose(cut) == 0 && good && rows == episodes;
    return good ? rename(fresh, path) == 0 || complain(path, strerror(errno))
                : complain(path, "does not hold the rows of all episodes up to the checkpoint");
}

bool run_folder_resume(run_folder *folder, const char *path, limphome_checkpoint_t *checkpoint) {
    memset(folder, 0, sizeof *folder);
    snprintf(folder->path, sizeof folder->path, "%s", path);
    char name[RUN_FOLDER_PATH_LENGTH];
    char base[48];
    long number = -1;
    if (!join(name, path, "checkpoint") || (number = newest_checkpoint(name)) < 0) {
        return false;
    }
    snprintf(base, sizeof base, "checkpoint/episode_%06ld.lcm", number);
    unsigned char bytes[LARGEST_FILE];
    const long size = join(name, path, base) ? read_file(name, bytes) : -1;
    if (size < 0) {
        return false;
    }
    const message_verdict verdict = message_decode_checkpoint(bytes, (size_t)size, checkpoint);
    if (verdict != MESSAGE_GOOD || checkpoint->policy.episode != number) {
        return complain(name, verdict != MESSAGE_GOOD ? message_verdict_text(verdict) : "is of another episode");
    }
    if (!join(name, path, "episodes.csv") || !cut_episodes(name, checkpoint->policy.episode)) {
        return false;
    }
    folder->episodes = fopen(name, "a");
    return folder->episodes != NULL || complain(name, strerror(errno));
}

const char *run_folder_outcome(lh_outcome outcome) {
    switch (outcome) {
        case LH_OUTCOME_GOAL:
            return "goal";
        case LH_OUTCOME_TUMBLE:
            return "tumble";
        case LH_OUTCOME_TIMEOUT:
            return "timeout";
        case LH_OUTCOME_NONE:
        default:
            return "none";
    }
}

bool run_folder_episode(run_folder *folder, const lh_summary *s, double decision_period) {
    if (folder->episodes == NULL) {
        return true;
    }
    fprintf(folder->episodes, "%d,%s,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", s->number,
            run_folder_outcome(s->outcome), s->steps, s->steps * decision_period, (double)lh_reward_total(&s->total),
            (double)s->total.motion, (double)s->total.goal, (double)s->total.stability, (double)s->total.tumble,
            (double)s->lateral_error, (double)s->heading_change, (double)s->temperature);
    return fflush(folder->episodes) == 0 || complain("episodes.csv", strerror(errno));
}

bool run_folder_policy(const run_folder *folder, const limphome_policy_t *policy) {
    char path[RUN_FOLDER_PATH_LENGTH];
    unsigned char bytes[LARGEST_FILE];
    if (folder->path[0] == '\0') {
        return true;
    }
    const int size = limphome_policy_t_encode(bytes, 0, sizeof bytes, policy);
    return size > 0 && join(path, folder->path, "policy.lcm") && replace_file(path, bytes, (size_t)size);
}

bool run_folder_checkpoint(const run_folder *folder, const limphome_checkpoint_t *checkpoint) {
    char path[RUN_FOLDER_PATH_LENGTH];
    char base[40];
    unsigned char bytes[LARGEST_FILE];
    if (folder->path[0] == '\0') {
        return true;
    }
    snprintf(base, sizeof base, "checkpoint/episode_%06d.lcm", checkpoint->policy.episode);
    const int size = limphome_checkpoint_t_encode(bytes, 0, sizeof bytes, checkpoint);
    return size > 0 && join(path, folder->path, base) && replace_file(path, bytes, (size_t)size);
}

bool run_folder_close(run_folder *folder) {
    const bool good = folder->episodes == NULL || fclose(folder->episodes) == 0;
    folder->episodes = NULL;
    return good || complain("episodes.csv", strerror(errno));
}

bool run_folder_read_policy(const char *path, limphome_policy_t *policy) {
    unsigned char bytes[LARGEST_FILE];
    const long size = read_file(path, bytes);
    if (size < 0) {
        return false;
    }
    const message_verdict verdict = message_decode_policy(bytes, (size_t)size, policy);
    return verdict == MESSAGE_GOOD || complain(path, message_verdict_text(verdict));
}
