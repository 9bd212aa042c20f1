/* The value of a key that is a path, as text: "rolling", "ahead", "to X Y" with further waypoints after commas, or
 * "waypoints FILE", which stands for "to" with the waypoints of the file. */
#ifndef LIMPHOME_SETTINGS_PATH_H
#define LIMPHOME_SETTINGS_PATH_H

#include <stddef.h>

#include "settings.h"

/* Room for the longest path as text. A line of an INI file, for which inih has 198 characters, holds it with its key.
 */
enum { SETTINGS_PATH_LENGTH = 192 };

/* What is allowed. */
void settings_path_range(char *text, size_t size);

/* Whether the library takes `path`. */
bool settings_path_is_valid(const settings_path *path);

/* Takes `text`, other than "waypoints FILE". False, and nothing changed, if it is not allowed. */
bool settings_path_parse(settings_path *path, const char *text);

/* As text that settings_path_parse takes. */
void settings_path_print(const settings_path *path, char *text, size_t size);

/* FILE where `text` is "waypoints FILE", else NULL. */
const char *settings_path_file(const char *text);

/* Reads a file of waypoints, one "X Y" a line; ; and # begin a comment. Writes them as settings_path_parse takes them.
 * False and a text with file, line and what is allowed if it is refused. */
bool settings_path_read(const char *file, char text[SETTINGS_PATH_LENGTH], char error[ERROR_LENGTH]);

#endif
