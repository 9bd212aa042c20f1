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

/* Sets one key; on failure writes `place: [section] name = value: why` to `error`. */
static int set_key(settings *s, const char *place, const char *section, const char *name, const char *value,
                   char *error) {
    char allowed[SETTINGS_RANGE_LENGTH];
    const settings_key *key = settings_key_find(section, name);
    if (key == NULL) {
        list_known(section, allowed, sizeof allowed);
        snprintf(error, SETTINGS_ERROR_LENGTH, "%s: [%.40s] %.40s: unknown key; %s", place, section, name, allowed);
        return -1;
    }
    if (!settings_key_parse(key, s, value)) {
        settings_key_range(key, allowed);
        snprintf(error, SETTINGS_ERROR_LENGTH, "%s: [%s] %s = %.60s: not allowed; %s is %s", place, section, name,
                 value, name, allowed);
        return -1;
    }
    return 0;
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
    snprintf(reading->error, SETTINGS_ERROR_LENGTH, "%.200s:%d: %s", reading->path, reading->line, why);
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

/* Reads a line for inih, without its end, which is \n, \r\n or \r, and without blanks before it, which inih would take
 * for the sign of a value that goes on. */
static char *read_line(char *line, int size, void *stream) {
    struct reading *reading = stream;
    if (reading->failed_at != 0) {
        return NULL;
    }
    int c = getc(reading->file);
    if (c == EOF) {
        return NULL;
    }
    reading->line++;
    int length = 0;
    for (; c != EOF && c != '\n' && c != '\r'; c = getc(reading->file)) {
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
    if (c == '\r') {
        c = getc(reading->file);
        if (c != '\n') {
            ungetc(c, reading->file);
        }
    }
    if (goes_on_after_section(line)) {
        return refuse_line(reading, "[section] must stand on a line of its own");
    }
    return line;
}

static int handle_pair(void *user, const char *section, const char *name, const char *value) {
    struct reading *reading = user;
    if (reading->failed_at != 0) {
        return 1;
    }
    char place[256];
    snprintf(place, sizeof place, "%.200s:%d", reading->path, reading->line);
    const settings_key *key = settings_key_find(section, name);
    if (key != NULL && reading->set_at[key - settings_keys] != 0) {
        snprintf(reading->error, SETTINGS_ERROR_LENGTH, "%s: [%s] %s: already set at line %d", place, section, name,
                 reading->set_at[key - settings_keys]);
        reading->failed_at = reading->line;
        return 1;
    }
    if (set_key(reading->s, place, section, name, value, reading->error) != 0) {
        reading->failed_at = reading->line;
        return 1;
    }
    reading->set_at[key - settings_keys] = reading->line;
    return 1;
}

int settings_read(settings *s, const char *path, char error[SETTINGS_ERROR_LENGTH]) {
    settings read = *s; /* nothing is taken over unless all of it is good */
    struct reading reading = {.s = &read, .path = path, .error = error, .file = fopen(path, "r")};
    if (reading.file == NULL) {
        snprintf(error, SETTINGS_ERROR_LENGTH, "%.200s: cannot be opened: %s", path, strerror(errno));
        return -1;
    }
    const int first_bad = ini_parse_stream(read_line, &reading, handle_pair, &reading);
    const bool broken = ferror(reading.file) != 0;
    fclose(reading.file);
    if (broken || first_bad < 0) {
        snprintf(error, SETTINGS_ERROR_LENGTH, "%.200s: cannot be read", path);
        return -1;
    }
    /* inih goes on after a line it cannot read: tell of whichever error comes first. */
    if (first_bad > 0 && !(reading.failed_at != 0 && reading.failed_at <= first_bad)) {
        snprintf(error, SETTINGS_ERROR_LENGTH, "%.200s:%d: neither [section], key = value, nor comment", path,
                 first_bad);
        return -1;
    }
    if (reading.failed_at != 0) {
        return -1;
    }
    *s = read;
    return 0;
}

int settings_set(settings *s, const char *assignment, char error[SETTINGS_ERROR_LENGTH]) {
    char section[64];
    char name[64];
    const char *dot = strchr(assignment, '.');
    const char *equals = strchr(assignment, '=');
    if (dot == NULL || equals == NULL || dot > equals || (size_t)(dot - assignment) >= sizeof section ||
        (size_t)(equals - dot - 1) >= sizeof name) {
        snprintf(error, SETTINGS_ERROR_LENGTH, "--set %.100s: must be section.key=value", assignment);
        return -1;
    }
    snprintf(section, sizeof section, "%.*s", (int)(dot - assignment), assignment);
    snprintf(name, sizeof name, "%.*s", (int)(equals - dot - 1), dot + 1);
    char place[160];
    snprintf(place, sizeof place, "--set %.120s", assignment);
    return set_key(s, place, section, name, equals + 1, error);
}
