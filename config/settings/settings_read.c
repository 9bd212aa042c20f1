/* Settings from an INI file and from the command line. */
#include <ctype.h>
#include <errno.h>
#include <ini.h>
#include <string.h>

#include "settings_table.h"

/* Lists the keys of `section`, or the sections when there is no such section, for the error about an unknown key. */
static void list_known(const char *section, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "keys of [%s]:", section);
    bool found = false;
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        if (strcmp(settings_keys[i].section, section) == 0 && used < size) {
            used += (size_t)snprintf(text + used, size - used, " %s", settings_keys[i].name);
            found = true;
        }
    }
    if (found) {
        return;
    }
    used = (size_t)snprintf(text, size, "sections:");
    for (size_t i = 0; i < SETTINGS_KEY_COUNT && used < size; i++) {
        if (settings_key_begins_section(&settings_keys[i])) {
            used += (size_t)snprintf(text + used, size - used, " %s", settings_keys[i].section);
        }
    }
}

/* Sets one key; the text of a failure begins with `place`. */
static bool set_key(settings *s, const char *place, const char *section, const char *name, const char *value,
                    char *error) {
    char allowed[SETTINGS_RANGE_LENGTH];
    const settings_key *key = settings_key_find(section, name);
    if (key == NULL) {
        list_known(section, allowed, sizeof allowed);
        return fail_with(error, "%s: [%.40s] %.40s: unknown key; %s", place, section, name, allowed);
    }
    char waypoints[SETTINGS_PATH_LENGTH];
    const char *file = key->kind == SETTINGS_KIND_PATH ? settings_path_file(value) : NULL;
    if (file != NULL) {
        char why[ERROR_LENGTH] = "";
        if (!settings_path_read(file, waypoints, why)) {
            return fail_with(error, "%s: [%s] %s: %.300s", place, section, name, why);
        }
        value = waypoints;
    }
    if (!settings_key_parse(key, s, value)) {
        settings_key_range(key, allowed);
        return fail_with(error, "%s: [%s] %s = %.60s: not allowed; %s is %s", place, section, name, value, name,
                         allowed);
    }
    return true;
}

/* State of one settings_read, shared by the line reader and the handler that inih calls. */
struct reading {
    settings *s;
    FILE *file;
    const char *path;
    int line;
    int set_at[SETTINGS_KEY_COUNT]; /* line that set the key, 0 for none */
    int failed_at;                  /* line of the first error, 0 for none */
    char *error;
};

/* The newest line is refused. NULL, for the reader to return: no more lines are wanted. */
static char *refuse_line(struct reading *reading, const char *why) {
    reading->failed_at = reading->line;
    fail_with(reading->error, "%.200s:%d: %s", reading->path, reading->line, why);
    return NULL;
}

/* Whether a line that begins with a [section] goes on after it with other than a comment; inih would not look at it. */
static bool goes_on_after_section(const char *line) {
    line += strspn(line, "\xEF\xBB\xBF"); /* a byte order mark */
    const char *end = line[0] == '[' ? strchr(line, ']') : NULL;
    if (end == NULL) {
        return false;
    }
    end++;
    end += strspn(end, " \t");
    return *end != '\0' && *end != ';' && *end != '#';
}

/* The next character of a line, or EOF at its end, which is \n, \r\n, \r or that of the file. */
static int next_in_line(FILE *file) {
    int c = getc(file);
    if (c == '\r') {
        c = getc(file);
        if (c != '\n') {
            ungetc(c, file);
        }
        return EOF;
    }
    return c == '\n' ? EOF : c;
}

static bool at_end(FILE *file) {
    const int c = getc(file);
    ungetc(c, file); /* nothing if it is EOF */
    return c == EOF;
}

/* Reads a line for inih, without its end and the blanks before it: to inih a line that begins with blanks goes on with
 * the value of the one before. */
static char *read_line(char *line, int size, void *stream) {
    struct reading *reading = stream;
    if (reading->failed_at != 0 || at_end(reading->file)) {
        return NULL;
    }
    reading->line++;
    int length = 0;
    for (int c; (c = next_in_line(reading->file)) != EOF;) {
        if (c == '\0') {
            return refuse_line(reading, "a byte of value 0; not a text file in ASCII or UTF-8");
        }
        if (length == 0 && isspace(c)) {
            continue;
        }
        if (length == size - 2) {
            char why[64];
            snprintf(why, sizeof why, "line too long; at most %d characters", size - 2);
            return refuse_line(reading, why);
        }
        line[length++] = (char)c;
    }
    line[length] = '\0';
    if (goes_on_after_section(line)) {
        return refuse_line(reading, "[section] must stand on a line of its own");
    }
    return line;
}

/* Takes over one pair, unless its key has been set before. */
static bool take_pair(struct reading *reading, const char *section, const char *name, const char *value) {
    char place[256];
    snprintf(place, sizeof place, "%.200s:%d", reading->path, reading->line);
    const settings_key *key = settings_key_find(section, name);
    if (key != NULL && reading->set_at[key - settings_keys] != 0) {
        return fail_with(reading->error, "%s: [%s] %s: already set at line %d", place, section, name,
                         reading->set_at[key - settings_keys]);
    }
    if (!set_key(reading->s, place, section, name, value, reading->error)) {
        return false;
    }
    reading->set_at[key - settings_keys] = reading->line;
    return true;
}

static int handle_pair(void *user, const char *section, const char *name, const char *value) {
    struct reading *reading = user;
    if (reading->failed_at == 0 && !take_pair(reading, section, name, value)) {
        reading->failed_at = reading->line;
    }
    return 1;
}

bool settings_read(settings *s, const char *path, char error[ERROR_LENGTH]) {
    settings read = *s; /* nothing is taken over unless all of it is good */
    char refusal[ERROR_LENGTH] = "";
    struct reading reading = {.s = &read, .path = path, .error = refusal, .file = fopen(path, "r")};
    if (reading.file == NULL) {
        return fail_with(error, "%.200s: cannot be opened: %s", path, strerror(errno));
    }
    const int first_bad = ini_parse_stream(read_line, &reading, handle_pair, &reading);
    const bool broken = ferror(reading.file) != 0;
    fclose(reading.file);
    if (broken || first_bad < 0) {
        return fail_with(error, "%.200s: cannot be read", path);
    }
    /* inih goes on after a line it cannot read: tell of whichever error comes first. */
    if (first_bad > 0 && !(reading.failed_at != 0 && reading.failed_at <= first_bad)) {
        return fail_with(error, "%.200s:%d: neither [section], key = value, nor comment", path, first_bad);
    }
    if (reading.failed_at != 0) {
        return fail_with(error, "%s", refusal);
    }
    *s = read;
    return true;
}

bool settings_set(settings *s, const char *assignment, char error[ERROR_LENGTH]) {
    char section[64];
    char name[64];
    const char *dot = strchr(assignment, '.');
    const char *equals = strchr(assignment, '=');
    if (dot == NULL || equals == NULL || dot > equals || (size_t)(dot - assignment) >= sizeof section ||
        (size_t)(equals - dot - 1) >= sizeof name) {
        return fail_with(error, "--set %.100s: must be section.key=value", assignment);
    }
    snprintf(section, sizeof section, "%.*s", (int)(dot - assignment), assignment);
    snprintf(name, sizeof name, "%.*s", (int)(equals - dot - 1), dot + 1);
    char place[160];
    snprintf(place, sizeof place, "--set %.120s", assignment);
    return set_key(s, place, section, name, equals + 1, error);
}
