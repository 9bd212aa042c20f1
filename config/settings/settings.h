/* Settings: what an experiment's INI file says, read the same way by both processes.
 *
 * Every key has a type, a range and a default (the paper's, where the paper gives one). keys.def tells them, a line
 * each, and all else is made from these lines: the struct below by taking their names, the rest in settings_table.c.
 * `--help-settings` of either program prints them as a table, which is docs/configuration.md.
 *
 * An unknown key, a key set twice, a bad number or a value out of range is refused with its place, the value and what
 * is allowed.
 */
#ifndef LIMPHOME_SETTINGS_H
#define LIMPHOME_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "fail.h"
#include "key_groups.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
/* An enum settings_NAME for each choice of choices.def. */
#define CHOICES(name) enum settings_##name {
#define WORD(enumerator, word) enumerator,
#define END_CHOICES(name) };
#include "choices.def"

/* Columns of keys.def as fields of a struct; ranges and meanings stand there. */
#define REAL(section, name, ...) double name;
#define WHOLE(section, name, ...) int64_t name;
#define CHOICE(section, name, words, ...) int64_t name; /* an enumerator of settings_WORDS */
#define SENSOR_REAL(quantity, name, ...) double name;
#define PATH(section, name, ...) settings_path name;

/* One actuator that fails: actuator, mode, weak_factor, slip_factor, at_s, at_episode. */
typedef struct settings_failure {
    SETTINGS_FAILURE_KEYS(, )
} settings_failure;

/* Errors of the sensors of one quantity: noise, bias, quantum in its unit, delay_s; all 0: exact. */
typedef struct settings_sensor {
    SETTINGS_SENSOR_KEYS(, , "")
} settings_sensor;

/* A path: its kind and, of SETTINGS_WAYPOINTS, its waypoints in the world frame [m]; what is not used is 0. */
enum { SETTINGS_MAX_WAYPOINTS = 8 };
enum settings_path_kind { SETTINGS_ROLLING, SETTINGS_AHEAD, SETTINGS_WAYPOINTS };
typedef struct settings_path {
    int64_t kind;
    int64_t count;
    double x[SETTINGS_MAX_WAYPOINTS], y[SETTINGS_MAX_WAYPOINTS];
} settings_path;

/* A struct for each section of keys.def, in it a field for each key: s.learning.seed is [learning] seed. The sections
 * failure and second_failure are settings_failure; sensors holds the settings_sensor attitude, position, joint and
 * torque. */
typedef struct settings {
#define SECTION(section) struct {
#define END(section) } section;
#define FAILURE(section, ...) settings_failure section;
#define SENSOR(quantity, ...) settings_sensor quantity;
#include "keys.def"
} settings;
/* clang-format on */

/* The paper's experiment. */
settings settings_default(void);

/* Reads `path` over what `s` holds. False, nothing read and a text with file, line, key and range if it is refused. */
bool settings_read(settings *s, const char *path, char error[ERROR_LENGTH]);

/* Applies one `section.key=value` from the command line. False, nothing changed and a text if it is refused. */
bool settings_set(settings *s, const char *assignment, char error[ERROR_LENGTH]);

/* Checks, once all are known, that every value is in its range and that what holds between two keys does. Settings that
 * pass are accepted by the library, and by the simulator as far as they do not depend on the robot.
 * False and a text with the key, or both keys, and values if not. */
bool settings_check(const settings *s, char error[ERROR_LENGTH]);

/* Writes every key with its value as an INI file that settings_read accepts and that gives the same settings. */
void settings_write(const settings *s, FILE *out);

/* Writes the table of keys with ranges, defaults and meanings, as Markdown. */
void settings_describe(FILE *out);

/* FNV-1a hash of the keys that decide what is learned, as keys.def says. */
uint64_t settings_hash(const settings *s);

#ifdef __cplusplus
}
#endif
#endif
