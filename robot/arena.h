/* Memory of one reading: taken piece by piece, freed at once. */
#ifndef LIMPHOME_ROBOT_ARENA_H
#define LIMPHOME_ROBOT_ARENA_H

#include <stddef.h>

struct arena_block;

/* Begins as {0}. */
struct arena {
    struct arena_block *newest;
};

/* Zeroed memory for `count` objects of `size`. Ends the process, having said so, where there is none: what a file may
 * ask for is bounded. */
void *arena_take(struct arena *arena, size_t count, size_t size);

/* A copy of `text`. */
char *arena_copy(struct arena *arena, const char *text);

void arena_free(struct arena *arena);

#endif
