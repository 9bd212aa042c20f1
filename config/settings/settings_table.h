/* The keys of keys.def as a table, for what reads, checks and prints settings. */
#ifndef LIMPHOME_SETTINGS_TABLE_H
#define LIMPHOME_SETTINGS_TABLE_H

#include <stdbool.h>

#include "settings.h"
#include "settings_path.h"

/* clang-format off */
/* Place of each key in settings_keys: KEY_rbf_units for [rbf] units. */
enum {
#define REAL(section, name, ...) KEY_##section##_##name,
#define WHOLE(section, name, ...) KEY_##section##_##name,
#define CHOICE(section, name, ...) KEY_##section##_##name,
#define SENSOR_REAL(quantity, name, ...) KEY_sensors_##quantity##_##name,
#define PATH(section, name, ...) KEY_##section##_##name,
#include "keys.def"
    SETTINGS_KEY_COUNT
};
/* clang-format on */

enum settings_kind { SETTINGS_KIND_REAL, SETTINGS_KIND_WHOLE, SETTINGS_KIND_CHOICE, SETTINGS_KIND_PATH };

typedef struct settings_key {
    const char *section;
    const char *name;
    enum settings_kind kind;
    size_t offset;    /* of the field in struct settings: double for REAL, settings_path for PATH, else int64_t */
    double low, high; /* range, ends included; of a CHOICE or PATH its enumerators */
    double standard;  /* default; of a CHOICE or PATH its enumerator */
    const char *const *words; /* of a CHOICE, in the order of its enumerators and then NULL; else NULL */
    bool decides;             /* part of settings_hash */
    const char *meaning;
} settings_key;

extern const settings_key settings_keys[SETTINGS_KEY_COUNT];

/* Room for any value, and for any range, as text. */
enum { SETTINGS_VALUE_LENGTH = SETTINGS_PATH_LENGTH, SETTINGS_RANGE_LENGTH = 320 };

/* The key, or NULL. */
const settings_key *settings_key_find(const char *section, const char *name);

/* Whether a section begins with this key. */
bool settings_key_begins_section(const settings_key *key);

/* The value of `key`; of a CHOICE or PATH its enumerator. */
double settings_key_number(const settings_key *key, const settings *s);

/* Whether the value of `key` is within its range. */
bool settings_key_in_range(const settings_key *key, const settings *s);

/* Takes `text` as the value of `key`. False, and nothing changed, if it is not of the key's kind or out of its range.
 */
bool settings_key_parse(const settings_key *key, settings *s, const char *text);

/* The value of `key` in as few digits as give it back. */
void settings_key_value(const settings_key *key, const settings *s, char text[SETTINGS_VALUE_LENGTH]);

/* What is allowed, such as "a number from 0 to 1". */
void settings_key_range(const settings_key *key, char text[SETTINGS_RANGE_LENGTH]);

#endif
