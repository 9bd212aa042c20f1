#include "settings_path.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "config_path.h"
#include "limphome/limphome.h" /* ranges that the library checks */

enum { MOST_WAYPOINTS = LH_MAX_WAYPOINTS < SETTINGS_MAX_WAYPOINTS ? LH_MAX_WAYPOINTS : SETTINGS_MAX_WAYPOINTS };

static const double farthest = (double)LH_WAYPOINT_MAX; /* [m] */
static const char blanks[] = " \t";

void settings_path_range(char *text, size_t size) {
    snprintf(
        text, size,
        "rolling, ahead, to X Y[, X Y ...] (up to %d waypoints, coordinates from %.10g to %.10g [m]) or waypoints FILE",
        (int)MOST_WAYPOINTS, -farthest, farthest);
}

bool settings_path_is_valid(const settings_path *path) {
    if (path->kind == SETTINGS_ROLLING || path->kind == SETTINGS_AHEAD) {
        return true;
    }
    bool good = path->kind == SETTINGS_WAYPOINTS && path->count >= 1 && path->count <= MOST_WAYPOINTS;
    for (int64_t i = 0; good && i < path->count; i++) {
        good = fabs(path->x[i]) <= farthest && fabs(path->y[i]) <= farthest;
    }
    return good;
}

/* A coordinate at the beginning of *text, to the millimetre, which bounds the length of what is printed; *text is moved
 * behind it. */
static bool parse_coordinate(const char **text, double *value) {
    char *end = NULL;
    const double read = strtod(*text, &end);
    if (end == *text || !(fabs(read) <= farthest)) {
        return false;
    }
    *value = round(read * 1000) / 1000 + 0.0; /* no -0 */
    *text = end;
    return true;
}

/* "X Y" at the beginning of *text with blanks around; *text is moved behind them. */
static bool parse_waypoint(const char **text, double *x, double *y) {
    if (!parse_coordinate(text, x) || strchr(blanks, **text) == NULL || !parse_coordinate(text, y)) {
        return false;
    }
    *text += strspn(*text, blanks);
    return true;
}

static bool parse_waypoints(settings_path *path, const char *text) {
    for (bool more = true; more; text++) {
        if (path->count == MOST_WAYPOINTS || !parse_waypoint(&text, &path->x[path->count], &path->y[path->count])) {
            return false;
        }
        path->count++;
        more = *text == ',';
    }
    return text[-1] == '\0';
}

bool settings_path_parse(settings_path *path, const char *text) {
    settings_path read;
    memset(&read, 0, sizeof read); /* so that equal paths have equal bytes */
    bool good = true;
    if (strcmp(text, "rolling") == 0) {
        read.kind = SETTINGS_ROLLING;
    } else if (strcmp(text, "ahead") == 0) {
        read.kind = SETTINGS_AHEAD;
    } else {
        read.kind = SETTINGS_WAYPOINTS;
        good = strncmp(text, "to ", 3) == 0 && parse_waypoints(&read, text + 3);
    }
    if (good) {
        *path = read;
    }
    return good;
}

void settings_path_print(const settings_path *path, char *text, size_t size) {
    if (!settings_path_is_valid(path)) {
        snprintf(text, size, "?");
        return;
    }
    if (path->kind != SETTINGS_WAYPOINTS) {
        snprintf(text, size, "%s", path->kind == SETTINGS_ROLLING ? "rolling" : "ahead");
        return;
    }
    size_t used = 0;
    for (int64_t i = 0; i < path->count && used < size; i++) {
        used +=
            (size_t)snprintf(text + used, size - used, "%s %.10g %.10g", i == 0 ? "to" : ",", path->x[i], path->y[i]);
    }
}

const char *settings_path_file(const char *text) {
    static const char word[] = "waypoints";
    const size_t length = sizeof word - 1;
    if (strncmp(text, word, length) != 0 || strchr(blanks, text[length]) == NULL || text[length] == '\0') {
        return NULL;
    }
    text += length;
    return text + strspn(text, blanks);
}

/* Takes the \n or \r\n off a line. False if it has none without being the last, or a \r elsewhere. */
static bool end_line(char *line, bool last) {
    char *end = line + strcspn(line, "\r\n");
    const bool ends = strcmp(end, "\n") == 0 || strcmp(end, "\r\n") == 0 || (last && *end == '\0');
    *end = '\0';
    return ends;
}

/* Takes one line of a file of waypoints, which may be empty. */
static bool take_line(settings_path *path, char *line, const char *place, char *error) {
    line[strcspn(line, ";#")] = '\0';
    const char *rest = line + strspn(line, blanks);
    if (*rest == '\0') {
        return true;
    }
    if (path->count == MOST_WAYPOINTS) {
        return fail_with(error, "%s: too many; at most %d waypoints", place, (int)MOST_WAYPOINTS);
    }
    if (!parse_waypoint(&rest, &path->x[path->count], &path->y[path->count]) || *rest != '\0') {
        return fail_with(error, "%s: %.40s: not allowed; a waypoint is X Y, two numbers from %.10g to %.10g [m]", place,
                         line, -farthest, farthest);
    }
    path->count++;
    return true;
}

bool settings_path_read(const char *file, char text[SETTINGS_PATH_LENGTH], char error[ERROR_LENGTH]) {
    char own[CONFIG_PATH_LENGTH];
    FILE *in = fopen(config_path_find(file, own), "r");
    if (in == NULL) {
        return fail_with(error, "%.120s: cannot be opened: %s", file, strerror(errno));
    }
    settings_path path = {.kind = SETTINGS_WAYPOINTS};
    char line[128];
    bool good = true;
    for (int number = 1; good && fgets(line, sizeof line, in) != NULL; number++) {
        char place[160];
        snprintf(place, sizeof place, "%.120s:%d", file, number);
        good = end_line(line, feof(in) != 0)
                   ? take_line(&path, line, place, error)
                   : fail_with(error, "%s: line too long, or no text that ends in \\n or \\r\\n", place);
    }
    const bool broken = ferror(in) != 0;
    fclose(in);
    if (!good || broken) {
        return good ? fail_with(error, "%.120s: cannot be read", file) : false;
    }
    if (path.count == 0) {
        return fail_with(error, "%.120s: holds no waypoint; one is a line X Y [m]", file);
    }
    settings_path_print(&path, text, SETTINGS_PATH_LENGTH);
    return true;
}
