#include "episode_table.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "files.h"

enum { LINE_LENGTH = 512 };

static const char header[] =
    "episode,outcome,steps,duration_s,reward,reward_motion,reward_goal,reward_stability,reward_tumble,lateral_error_m,"
    "heading_change_rad,temperature\n";

bool episode_table_create(FILE **file, const char *path, char error[ERROR_LENGTH]) {
    *file = fopen(path, "wx");
    if (*file == NULL) {
        return errno == EEXIST
                   ? fail_with(error, "%.200s: there is a run in this folder already; --resume goes on with it", path)
                   : files_fail(error, path);
    }
    if (fputs(header, *file) >= 0 && fflush(*file) == 0) {
        return true;
    }
    files_fail(error, path);
    fclose(*file);
    *file = NULL;
    return false;
}

/* Whether `line` is the header (row 0), or a whole row of that episode. */
static bool is_row(const char *line, int32_t row) {
    if (row == 0) {
        return strcmp(line, header) == 0;
    }
    char *end = NULL;
    return strtol(line, &end, 10) == row && *end == ',' && strchr(line, '\n') != NULL;
}

bool episode_table_find(const char *path, int32_t episodes, int64_t *end, char error[ERROR_LENGTH]) {
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return files_fail(error, path);
    }
    char line[LINE_LENGTH] = "";
    int32_t row = 0;
    *end = 0;
    while (row <= episodes && fgets(line, sizeof line, file) != NULL && is_row(line, row)) {
        *end += (int64_t)strlen(line);
        row++;
    }
    fclose(file);
    if (episodes == 0 && strncmp(header, line, strlen(line)) == 0) {
        return true; /* a header that was cut while it was written is as good as none */
    }
    if (row == 0) {
        return fail_with(error, "%.200s:1: is not the header of a run's episodes.csv", path);
    }
    return row > episodes ||
           fail_with(error, "%.200s:%" PRId32 ": holds no whole row of episode %" PRId32, path, row + 1, row);
}

bool episode_table_go_on(FILE **file, const char *path, int64_t end, char error[ERROR_LENGTH]) {
    *file = fopen(path, "a");
    return *file == NULL ? files_fail(error, path) : files_cut(*file, path, end, error);
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

bool episode_table_add(FILE *file, const limphome_episode_t *e, char error[ERROR_LENGTH]) {
    fprintf(file, "%d,%s,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", e->episode, outcome_word(e->outcome),
            e->steps, e->duration, e->reward, e->reward_motion, e->reward_goal, e->reward_stability, e->reward_tumble,
            e->lateral_error, e->heading_change, e->temperature);
    return fflush(file) == 0 || files_fail(error, "episodes.csv");
}
