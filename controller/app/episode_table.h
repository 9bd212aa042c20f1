/* episodes.csv: a row for each finished episode, numbered from 1. All of these return false with the reason in `error`.
 */
#ifndef LIMPHOME_APP_EPISODE_TABLE_H
#define LIMPHOME_APP_EPISODE_TABLE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "fail.h"
#include "limphome_episode_t.h"

/* Starts the table in a new file, which is left open. */
bool episode_table_create(FILE **file, const char *path, char error[ERROR_LENGTH]);

/* Where the row of episode `episodes` ends [bytes]; the rows up to it must be whole and in order. With 0, the header's
 * end, or 0 where that is not whole. */
bool episode_table_find(const char *path, int32_t episodes, int64_t *end, char error[ERROR_LENGTH]);

/* Opens the table to add to what its first `end` bytes hold. */
bool episode_table_go_on(FILE **file, const char *path, int64_t end, char error[ERROR_LENGTH]);

/* Adds a row and hands it to the system. */
bool episode_table_add(FILE *file, const limphome_episode_t *episode, char error[ERROR_LENGTH]);

#endif
