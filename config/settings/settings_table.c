#include "settings_table.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "limphome/limphome.h" /* ranges that the library checks */

/* clang-format off */
#define CHOICES(name) static const char *const name##_words[] = {
#define WORD(enumerator, word) word,
#define END_CHOICES(name) \
    NULL};                \
    enum { name##_last = sizeof name##_words / sizeof name##_words[0] - 2 };
#include "choices.def"

#define DECIDES true
#define NEUTRAL false
#define NUMBER(kind, section, name, field, low, high, standard, hash, meaning) \
    {section, name, kind, offsetof(settings, field), (double)(low), (double)(high), standard, NULL, hash, meaning},

const settings_key settings_keys[SETTINGS_KEY_COUNT] = {
#define REAL(section, name, low, high, standard, hash, meaning) \
    NUMBER(SETTINGS_KIND_REAL, #section, #name, section.name, low, high, standard, hash, meaning)
#define WHOLE(section, name, low, high, standard, hash, meaning) \
    NUMBER(SETTINGS_KIND_WHOLE, #section, #name, section.name, low, high, standard, hash, meaning)
#define CHOICE(section, name, words, standard, hash, meaning)                                            \
    {#section, #name, SETTINGS_KIND_CHOICE, offsetof(settings, section.name), 0, words##_last, standard, \
     words##_words, hash, meaning},
#define SENSOR_REAL(quantity, name, low, high, standard, hash, meaning)                          \
    NUMBER(SETTINGS_KIND_REAL, "sensors", #quantity "_" #name, sensors.quantity.name, low, high, \
           standard, hash, meaning)
#define PATH(section, name, hash, meaning)                                                                             \
    {#section, #name, SETTINGS_KIND_PATH, offsetof(settings, section.name), SETTINGS_ROLLING, SETTINGS_WAYPOINTS, \
     SETTINGS_ROLLING, NULL, hash, meaning},
#include "keys.def"
};
/* clang-format on */

static double *real_field(settings *s, const settings_key *key) {
    return (double *)(void *)((char *)s + key->offset);
}

static int64_t *whole_field(settings *s, const settings_key *key) {
    return (int64_t *)(void *)((char *)s + key->offset);
}

static settings_path *path_field(settings *s, const settings_key *key) {
    return (settings_path *)(void *)((char *)s + key->offset);
}

/* Sets the field of `key` to a value of its kind; of a PATH, which begins with it, the kind of path. */
static void assign(const settings_key *key, settings *s, double value) {
    if (key->kind == SETTINGS_KIND_REAL) {
        *real_field(s, key) = value;
    } else {
        *whole_field(s, key) = (int64_t)value;
    }
}

settings settings_default(void) {
    settings s;
    memset(&s, 0, sizeof s);
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        assign(&settings_keys[i], &s, settings_keys[i].standard);
    }
    return s;
}

const settings_key *settings_key_find(const char *section, const char *name) {
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        if (strcmp(settings_keys[i].section, section) == 0 && strcmp(settings_keys[i].name, name) == 0) {
            return &settings_keys[i];
        }
    }
    return NULL;
}

bool settings_key_begins_section(const settings_key *key) {
    return key == settings_keys || strcmp(key[0].section, key[-1].section) != 0;
}

double settings_key_number(const settings_key *key, const settings *s) {
    settings copy = *s;
    return key->kind == SETTINGS_KIND_REAL ? *real_field(&copy, key) : (double)*whole_field(&copy, key);
}

/* An end of the range of a REAL as it is meant and printed: the library's 0.1f stands for 0.1, which is below it in
 * double precision. Rounding keeps order, so what is within these ends is within the library's when it gets there. */
static double meant(const settings_key *key, double end) {
    if (key->kind != SETTINGS_KIND_REAL) {
        return end;
    }
    char text[SETTINGS_VALUE_LENGTH];
    snprintf(text, sizeof text, "%.*g", FLT_DIG, end);
    return strtod(text, NULL);
}

static bool is_within(const settings_key *key, double value) {
    return value >= meant(key, key->low) && value <= meant(key, key->high);
}

bool settings_key_in_range(const settings_key *key, const settings *s) {
    if (key->kind == SETTINGS_KIND_PATH) {
        settings copy = *s;
        return settings_path_is_valid(path_field(&copy, key));
    }
    return is_within(key, settings_key_number(key, s));
}

static bool parse_word(const settings_key *key, const char *text, double *value) {
    for (size_t i = 0; key->words[i] != NULL; i++) {
        if (strcmp(key->words[i], text) == 0) {
            *value = (double)i;
            return true;
        }
    }
    return false;
}

static bool parse_number(const settings_key *key, const char *text, double *value) {
    char *end = NULL;
    errno = 0;
    if (key->kind == SETTINGS_KIND_REAL) {
        *value = strtod(text, &end);
        return end != text && *end == '\0'; /* too large or small for a double: refused by the range, or as good as 0 */
    }
    *value = (double)strtoll(text, &end, 10);
    return end != text && *end == '\0' && errno == 0;
}

bool settings_key_parse(const settings_key *key, settings *s, const char *text) {
    if (key->kind == SETTINGS_KIND_PATH) {
        return settings_path_parse(path_field(s, key), text);
    }
    double value;
    const bool read =
        key->kind == SETTINGS_KIND_CHOICE ? parse_word(key, text, &value) : parse_number(key, text, &value);
    if (!read || !is_within(key, value)) {
        return false;
    }
    assign(key, s, value);
    return true;
}

/* In as few digits as give the value back, so 0.1 and not 0.10000000000000001. */
static void print_real(double value, char *text, size_t size) {
    snprintf(text, size, "%.10g", value);
    if (strtod(text, NULL) != value) {
        snprintf(text, size, "%.17g", value);
    }
}

void settings_key_value(const settings_key *key, const settings *s, char text[SETTINGS_VALUE_LENGTH]) {
    const double value = settings_key_number(key, s);
    switch (key->kind) {
        case SETTINGS_KIND_REAL:
            print_real(value, text, SETTINGS_VALUE_LENGTH);
            break;
        case SETTINGS_KIND_WHOLE:
            snprintf(text, SETTINGS_VALUE_LENGTH, "%.0f", value);
            break;
        case SETTINGS_KIND_CHOICE:
            snprintf(text, SETTINGS_VALUE_LENGTH, "%s", is_within(key, value) ? key->words[(size_t)value] : "?");
            break;
        case SETTINGS_KIND_PATH: {
            settings copy = *s;
            settings_path_print(path_field(&copy, key), text, SETTINGS_VALUE_LENGTH);
            break;
        }
    }
}

void settings_key_range(const settings_key *key, char text[SETTINGS_RANGE_LENGTH]) {
    if (key->kind == SETTINGS_KIND_PATH) {
        settings_path_range(text, SETTINGS_RANGE_LENGTH);
        return;
    }
    if (key->kind != SETTINGS_KIND_CHOICE) {
        snprintf(text, SETTINGS_RANGE_LENGTH, "%s from %.10g to %.10g",
                 key->kind == SETTINGS_KIND_WHOLE ? "a whole number" : "a number", meant(key, key->low),
                 meant(key, key->high));
        return;
    }
    size_t used = (size_t)snprintf(text, SETTINGS_RANGE_LENGTH, "one of:");
    for (size_t i = 0; key->words[i] != NULL && used < SETTINGS_RANGE_LENGTH; i++) {
        used += (size_t)snprintf(text + used, SETTINGS_RANGE_LENGTH - used, " %s", key->words[i]);
    }
}
