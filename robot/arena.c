#include "arena.h"

#include <stdalign.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 65536 };

struct arena_block {
    struct arena_block *older;
    size_t used, size;
    alignas(max_align_t) unsigned char bytes[];
};

void *arena_take(struct arena *arena, size_t count, size_t size) {
    const size_t unit = alignof(max_align_t);
    const size_t wanted = (count * size + unit - 1) / unit * unit;
    struct arena_block *block = arena->newest;
    if (block == NULL || block->size - block->used < wanted) {
        const size_t room = wanted > BLOCK ? wanted : BLOCK;
        block = calloc(1, sizeof *block + room);
        if (block == NULL) {
            fprintf(stderr, "out of memory\n");
            abort();
        }
        block->older = arena->newest;
        block->size = room;
        arena->newest = block;
    }
    void *taken = &block->bytes[block->used];
    block->used += wanted;
    return taken;
}

char *arena_copy(struct arena *arena, const char *text) {
    const size_t size = strlen(text) + 1;
    return memcpy(arena_take(arena, size, 1), text, size);
}

void arena_free(struct arena *arena) {
    while (arena->newest != NULL) {
        struct arena_block *older = arena->newest->older;
        free(arena->newest);
        arena->newest = older;
    }
}
