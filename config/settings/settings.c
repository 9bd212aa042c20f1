#include "settings.h"

#include <errno.h>
#include <ini.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum kind { REAL, WHOLE, CHOICE };

struct key {
    const char *section;
    const char *name;
    enum kind kind;
    size_t offset; /* of the field in struct settings: double for REAL, int64_t else */
    double low;
    double high;
    double standard;     /* default; for CHOICE the index of the word */
    const char *choices; /* CHOICE: words separated by one space, in the order of the enum */
    bool decides;        /* part of settings_hash */
    const char *meaning;
};

#define AT(section, name) offsetof(settings, section.name)
#define REAL_KEY(s, n, low, high, standard, meaning) \
    { #s, #n, REAL, AT(s, n), low, high, standard, NULL, true, meaning }
#define WHOLE_KEY(s, n, low, high, standard, meaning) \
    { #s, #n, WHOLE, AT(s, n), low, high, standard, NULL, true, meaning }
#define CHOICE_KEY(s, n, words, standard, meaning) \
    { #s, #n, CHOICE, AT(s, n), 0, 0, standard, words, true, meaning }

#define FAILURE_KEYS(s, standard)                                                                              \
    CHOICE_KEY(s, actuator, "left_crawler right_crawler none joint_1 joint_2 joint_3 joint_4 joint_5 joint_6", \
               standard, "what fails; arm joints are numbered from root to tip"),                              \
        CHOICE_KEY(s, mode, "locked free weak slipping", SETTINGS_LOCKED,                                      \
                   "how it fails; slipping: the drive works, but the belt has lost its friction"),             \
        REAL_KEY(s, weak_factor, 0, 1, 0.3, "torque limit left to a weak drive, as a share of the rated one"), \
        REAL_KEY(s, slip_factor, 0, 1, 0.05, "friction left to a slipping crawler, as a share"),               \
        REAL_KEY(s, at_s, 0, 1e6, 0, "time since the reset at which it fails [s]")
#define SENSOR_KEY(q, error, most, meaning) \
    { "sensors", #q "_" #error, REAL, AT(sensors, q.error), 0, most, 0, NULL, true, meaning }
#define SENSOR_KEYS(q, unit, most)                                                                            \
    SENSOR_KEY(q, noise, most, "standard deviation of the noise " unit),                                      \
        SENSOR_KEY(q, bias, most, "largest constant error " unit "; each value draws its own at each reset"), \
        SENSOR_KEY(q, quantum, most, "readings are rounded to multiples of it " unit "; 0: not"),             \
        SENSOR_KEY(q, delay_s, 5, "age of what is read [s]; a whole number of time steps")

static const struct key keys[] = {
    WHOLE_KEY(learning, seed, 0, 2147483647, 1, "seed of every random number"),
    {"learning", "episodes", WHOLE, AT(learning, episodes), 1, 1000000, 2500, NULL, false, "episodes to train for"},
    REAL_KEY(learning, learning_rate, 0, 1, 0.1, "alpha of (2)"),
    REAL_KEY(learning, discount_rate, 0, 1, 0.9, "gamma of (1)"),

    WHOLE_KEY(rbf, units, 1, 64, 50, "basis functions of (13)"),
    REAL_KEY(rbf, rate_weight, 0, 10, 0.1, "alpha_w of (19)"),
    REAL_KEY(rbf, rate_width, 0, 10, 0.01, "alpha_sigma of (20)"),
    REAL_KEY(rbf, rate_centre, 0, 10, 0.1, "alpha_mu of (21)"),
    REAL_KEY(rbf, initial_weight, -100, 100, 0, "w_j at the start"),
    REAL_KEY(rbf, initial_width, 0.05, 100, 1, "sigma_j at the start"),
    REAL_KEY(rbf, width_floor, 0.01, 1, 0.05, "least sigma_j; keeps (14) and (20) finite"),
    REAL_KEY(rbf, weight_limit, 1, 1e6, 1e4, "largest magnitude of w_j"),
    CHOICE_KEY(rbf, gradient, "printed exact", SETTINGS_GRADIENT_PRINTED,
               "printed: (19)-(21) as they stand; exact: the derivative of (15), which has alpha for alpha^2 and a "
               "factor 2 in (20)(21)"),

    REAL_KEY(exploration, temperature_floor, 1e-4, 10, 0.01, "least T of (4)"),

    REAL_KEY(action, crawler_speed, 0.01, 2, 0.3, "belt speed of the forward and reverse levels [m/s], Table 1"),
    REAL_KEY(action, joint_speed, 0.01, 2, 0.3, "rate of the forward and reverse levels [rad/s], Table 1"),

    REAL_KEY(reward, forward, 0, 1000, 8, "eta of (8) [1/m]"),
    REAL_KEY(reward, sideways, 0, 1000, 2, "lambda of (8) [1/m]"),
    REAL_KEY(reward, turn, 0, 1000, 10, "tau of (8) [1/rad]"),
    CHOICE_KEY(reward, turn_of, "heading_change heading_error", SETTINGS_TURN_CHANGE,
               "phi of (8): change of heading over the step, or heading against the direction of the episode"),
    REAL_KEY(reward, goal, 0, 1000, 10, "zeta of (9)"),
    REAL_KEY(reward, stability, 0, 1000, 1, "rho of (12)"),
    REAL_KEY(reward, tumble, -1000, 0, -10, "added to the step in which the robot tumbles"),

    REAL_KEY(episode, decision_period_s, 0.01, 10, 0.5, "time between decisions [s]; a whole number of time steps"),
    REAL_KEY(episode, goal_distance_m, 0.1, 100, 2, "b, distance to the goal line [m]"),
    WHOLE_KEY(episode, step_limit, 1, 100000, 200, "decisions before an episode is given up"),
    REAL_KEY(episode, tumble_tilt_rad, 0.1, 3, 1.0471975511965976, "tilt that counts as tumbled [rad]"),
    WHOLE_KEY(episode, reset_every, 1, 1000000, 50,
              "episodes between returns to the initial pose, where a checkpoint is taken"),

    FAILURE_KEYS(failure, SETTINGS_FAILED_LEFT),
    FAILURE_KEYS(second_failure, SETTINGS_FAILED_NONE),

    REAL_KEY(simulator, time_step_s, 1e-4, 0.02, 0.005, "time step [s]"),
    WHOLE_KEY(simulator, solver_iterations, 1, 1000, 20, "iterations of the contact solver per time step"),
    {"simulator", "pace", CHOICE, AT(simulator, pace), 0, 0, SETTINGS_LOCKSTEP, "lockstep real_time", false,
     "lockstep: wait for each command; real_time: do not wait"},
    REAL_KEY(simulator, friction_crawler, 0, 2, 0.7, "Coulomb friction of crawlers on the ground"),
    REAL_KEY(simulator, friction_arm, 0, 2, 0.7, "Coulomb friction of arm and body on the ground"),

    WHOLE_KEY(ground, seed, 0, 2147483647, 1, "seed of rough ground and patches: the same seed, the same ground"),
    REAL_KEY(ground, incline_along_rad, -1, 1, 0, "uphill ahead of the start [rad]"),
    REAL_KEY(ground, incline_across_rad, -1, 1, 0, "uphill to the right of the start [rad]"),
    REAL_KEY(ground, rough_amplitude_m, 0, 1, 0, "rough ground: most above or below the mean [m]; 0: smooth"),
    REAL_KEY(ground, rough_wavelength_m, 0.4, 100, 1, "rough ground: length of the shortest bumps [m]"),
    REAL_KEY(ground, step_height_m, 0, 2, 0, "steps up and down, across the way: height [m]; 0: none"),
    REAL_KEY(ground, step_spacing_m, 0.5, 100, 3, "steps: from one to the next [m]; the robot starts midway"),
    REAL_KEY(ground, patch_share, 0, 1, 0, "share of the ground that is loose; 0: none"),
    REAL_KEY(ground, patch_size_m, 0.1, 100, 0.5, "loose ground: side of a patch [m]"),
    REAL_KEY(ground, patch_friction, 0, 1, 0.3, "loose ground: friction, as a share of that elsewhere"),

    SENSOR_KEYS(attitude, "of roll, pitch and heading [rad]", 1),
    SENSOR_KEYS(position, "of each coordinate [m]", 10),
    SENSOR_KEYS(joint, "of arm joints [rad]", 1),
    SENSOR_KEYS(torque, "of all drives [N m]", 10000),

    REAL_KEY(randomisation, friction, 0, 0.9, 0, "drawn at each reset: friction is within this share of its setting"),
    REAL_KEY(randomisation, mass, 0, 0.9, 0,
             "drawn at each reset: each body's mass is within this share of the URDF's"),
    REAL_KEY(randomisation, torque, 0, 0.9, 0,
             "drawn at each reset: each drive's torque limit is within this share of the URDF's"),

    REAL_KEY(drive, proportional, 0, 1000, 60, "PID velocity drives: proportional gain [1/s]"),
    REAL_KEY(drive, integral, 0, 100000, 100, "PID velocity drives: integral gain [1/s^2]"),
    REAL_KEY(drive, derivative, 0, 1, 0, "PID velocity drives: derivative gain [-]"),

    {"link", "resend_s", REAL, AT(link, resend_s), 0.001, 1, 0.005, NULL, false,
     "what is unanswered is sent again after this [s]"},
    {"link", "command_timeout_s", REAL, AT(link, command_timeout_s), 0.01, 10, 1, NULL, false,
     "real time: age at which a command is no longer obeyed [s]"},
    {"link", "sender_timeout_s", REAL, AT(link, sender_timeout_s), 0.1, 60, 2, NULL, false,
     "silence after which the plant obeys another sender [s]"},
};
enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

static double *real_field(settings *s, const struct key *key) {
    return (double *)(void *)((char *)s + key->offset);
}

static int64_t *whole_field(settings *s, const struct key *key) {
    return (int64_t *)(void *)((char *)s + key->offset);
}

settings settings_default(void) {
    settings s;
    memset(&s, 0, sizeof s);
    for (size_t i = 0; i < KEY_COUNT; i++) {
        if (keys[i].kind == REAL) {
            *real_field(&s, &keys[i]) = keys[i].standard;
        } else {
            *whole_field(&s, &keys[i]) = (int64_t)keys[i].standard;
        }
    }
    return s;
}

/* Copies word `index` of a list separated by spaces into `word`; false past the end. */
static bool choice_word(const char *choices, int64_t index, char *word, size_t size) {
    const char *begin = choices;
    for (; index > 0; index--) {
        begin = strchr(begin, ' ');
        if (begin == NULL) {
            return false;
        }
        begin++;
    }
    snprintf(word, size, "%.*s", (int)strcspn(begin, " "), begin);
    return true;
}

static void print_range(const struct key *key, char *text, size_t size) {
    if (key->kind == CHOICE) {
        snprintf(text, size, "one of: %s", key->choices);
    } else {
        snprintf(text, size, "%s from %.10g to %.10g", key->kind == WHOLE ? "a whole number" : "a number", key->low,
                 key->high);
    }
}

/* Parses `value` for `key` into `s`; false if it is not of the key's kind or outside its range. */
static bool assign(settings *s, const struct key *key, const char *value) {
    if (key->kind == CHOICE) {
        char word[64];
        for (int64_t i = 0; choice_word(key->choices, i, word, sizeof word); i++) {
            if (strcmp(word, value) == 0) {
                *whole_field(s, key) = i;
                return true;
            }
        }
        return false;
    }
    char *end = NULL;
    errno = 0;
    if (key->kind == WHOLE) {
        const long long whole = strtoll(value, &end, 10);
        if (end == value || *end != '\0' || errno != 0 || (double)whole < key->low || (double)whole > key->high) {
            return false;
        }
        *whole_field(s, key) = whole;
        return true;
    }
    const double real = strtod(value, &end);
    if (end == value || *end != '\0' || !(real >= key->low && real <= key->high)) {
        return false;
    }
    *real_field(s, key) = real;
    return true;
}

static const struct key *find_key(const char *section, const char *name) {
    for (size_t i = 0; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].section, section) == 0 && strcmp(keys[i].name, name) == 0) {
            return &keys[i];
        }
    }
    return NULL;
}

/* Lists the keys of `section`, or the sections when there is no such section, for the error about an unknown key. */
static void list_known(const char *section, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "keys of [%s]:", section);
    bool found = false;
    for (size_t i = 0; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].section, section) == 0 && used < size) {
            used += (size_t)snprintf(text + used, size - used, " %s", keys[i].name);
            found = true;
        }
    }
    if (found) {
        return;
    }
    used = (size_t)snprintf(text, size, "sections:");
    for (size_t i = 0; i < KEY_COUNT && used < size; i++) {
        if (i == 0 || strcmp(keys[i].section, keys[i - 1].section) != 0) {
            used += (size_t)snprintf(text + used, size - used, " %s", keys[i].section);
        }
    }
}

/* Sets one key; on failure writes `place: [section] name = value: why` to `error`. */
static int set_key(settings *s, const char *place, const char *section, const char *name, const char *value,
                   char *error) {
    char allowed[320];
    const struct key *key = find_key(section, name);
    if (key == NULL) {
        list_known(section, allowed, sizeof allowed);
        snprintf(error, SETTINGS_ERROR_LENGTH, "%s: [%.40s] %.40s: unknown key; %s", place, section, name, allowed);
        return -1;
    }
    if (!assign(s, key, value)) {
        print_range(key, allowed, sizeof allowed);
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
    bool too_long;         /* the newest line did not fit inih's buffer */
    int set_at[KEY_COUNT]; /* line that set the key, 0 for none */
    int failed_at;         /* line of the first error, 0 for none */
    char *error;
};

static char *read_line(char *buffer, int size, void *stream) {
    struct reading *reading = stream;
    char *line = fgets(buffer, size, reading->file);
    if (line != NULL) {
        reading->line++;
        reading->too_long = strchr(line, '\n') == NULL && !feof(reading->file);
    }
    if (reading->too_long && reading->failed_at == 0) {
        reading->failed_at = reading->line;
        snprintf(reading->error, SETTINGS_ERROR_LENGTH, "%.200s:%d: line too long; at most %d characters",
                 reading->path, reading->line, size - 2);
    }
    return reading->failed_at != 0 ? NULL : line;
}

static int handle_pair(void *user, const char *section, const char *name, const char *value) {
    struct reading *reading = user;
    if (reading->failed_at != 0) {
        return 1;
    }
    char place[256];
    snprintf(place, sizeof place, "%.200s:%d", reading->path, reading->line);
    const struct key *key = find_key(section, name);
    if (key != NULL && reading->set_at[key - keys] != 0) {
        snprintf(reading->error, SETTINGS_ERROR_LENGTH, "%s: [%s] %s: already set at line %d", place, section, name,
                 reading->set_at[key - keys]);
        reading->failed_at = reading->line;
        return 1;
    }
    if (set_key(reading->s, place, section, name, value, reading->error) != 0) {
        reading->failed_at = reading->line;
        return 1;
    }
    reading->set_at[key - keys] = reading->line;
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

/* Whether `time` of that key is a whole number of time steps; if not, says so. */
static bool whole_steps(const settings *s, const char *key, double time, char *error) {
    const double steps = time / s->simulator.time_step_s;
    if (fabs(steps - round(steps)) <= 1e-6 * steps) {
        return true;
    }
    snprintf(error, SETTINGS_ERROR_LENGTH, "%s = %.10g: must be a whole number of [simulator] time_step_s = %.10g", key,
             time, s->simulator.time_step_s);
    return false;
}

static bool possible_failures(const settings *s, char *error) {
    const settings_failure *first = &s->failure, *second = &s->second_failure;
    if (first->actuator == second->actuator && first->actuator != SETTINGS_FAILED_NONE) {
        snprintf(error, SETTINGS_ERROR_LENGTH, "[second_failure] actuator: is that of [failure]; one fails once");
        return false;
    }
    for (int i = 0; i < 2; i++) {
        const settings_failure *failure = i == 0 ? first : second;
        if (failure->actuator >= SETTINGS_FAILED_JOINT && failure->mode == SETTINGS_SLIPPING) {
            snprintf(error, SETTINGS_ERROR_LENGTH, "[%s] mode = slipping: is for crawlers only",
                     i == 0 ? "failure" : "second_failure");
            return false;
        }
    }
    return true;
}

int settings_check(const settings *s, char error[SETTINGS_ERROR_LENGTH]) {
    const bool good = whole_steps(s, "[episode] decision_period_s", s->episode.decision_period_s, error) &&
                      whole_steps(s, "[sensors] attitude_delay_s", s->sensors.attitude.delay_s, error) &&
                      whole_steps(s, "[sensors] position_delay_s", s->sensors.position.delay_s, error) &&
                      whole_steps(s, "[sensors] joint_delay_s", s->sensors.joint.delay_s, error) &&
                      whole_steps(s, "[sensors] torque_delay_s", s->sensors.torque.delay_s, error) &&
                      possible_failures(s, error);
    return good ? 0 : -1;
}

static void print_value(const settings *s, const struct key *key, char *text, size_t size) {
    settings copy = *s;
    if (key->kind == REAL) {
        snprintf(text, size, "%.17g", *real_field(&copy, key));
        double shorter = 0;
        char brief[40];
        snprintf(brief, sizeof brief, "%.10g", *real_field(&copy, key));
        shorter = strtod(brief, NULL);
        if (shorter == *real_field(&copy, key)) { /* prefer 0.1 to 0.10000000000000001 */
            snprintf(text, size, "%s", brief);
        }
    } else if (key->kind == WHOLE) {
        snprintf(text, size, "%lld", (long long)*whole_field(&copy, key));
    } else {
        choice_word(key->choices, *whole_field(&copy, key), text, size);
    }
}

void settings_write(const settings *s, FILE *out) {
    for (size_t i = 0; i < KEY_COUNT; i++) {
        if (i == 0 || strcmp(keys[i].section, keys[i - 1].section) != 0) {
            fprintf(out, "%s[%s]\n", i == 0 ? "" : "\n", keys[i].section);
        }
        char value[64] = "";
        print_value(s, &keys[i], value, sizeof value);
        fprintf(out, "%s = %s\n", keys[i].name, value);
    }
}

void settings_describe(FILE *out) {
    const settings standard = settings_default();
    fprintf(
        out,
        "# Configuration\n\nThe keys of an experiment's INI file, as both programs read it; "
        "`limphome-controller --help-settings` prints this page.\nA key that is not set has its default, which is the "
        "paper's where the paper gives one. Comments begin with `;`.\n\n");
    for (size_t i = 0; i < KEY_COUNT; i++) {
        if (i == 0 || strcmp(keys[i].section, keys[i - 1].section) != 0) {
            fprintf(out, "%s## [%s]\n\n| key | default | allowed | meaning |\n|---|---|---|---|\n", i == 0 ? "" : "\n",
                    keys[i].section);
        }
        char value[64] = "";
        char allowed[320];
        print_value(&standard, &keys[i], value, sizeof value);
        print_range(&keys[i], allowed, sizeof allowed);
        fprintf(out, "| `%s` | %s | %s | %s |\n", keys[i].name, value, allowed, keys[i].meaning);
    }
}

static uint64_t fnv1a(uint64_t hash, const char *text) {
    for (; *text != '\0'; text++) {
        hash = (hash ^ (unsigned char)*text) * 1099511628211u;
    }
    return hash;
}

uint64_t settings_hash(const settings *s) {
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < KEY_COUNT; i++) {
        if (keys[i].decides) {
            char value[64] = "";
            print_value(s, &keys[i], value, sizeof value);
            hash = fnv1a(fnv1a(fnv1a(hash, keys[i].section), keys[i].name), value);
        }
    }
    return hash;
}
