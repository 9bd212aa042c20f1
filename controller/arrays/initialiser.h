/* Initialisers of C structs as text, to be compiled in: C11, and C++ from 20 on. Floats come back with the same bits.
 */
#ifndef LIMPHOME_ARRAYS_INITIALISER_H
#define LIMPHOME_ARRAYS_INITIALISER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct initialiser {
    FILE *file;
    int depth; /* of braces */
} initialiser;

/* `static const TYPE NAME = {`, and its end. */
void initialiser_begin(initialiser *i, const char *type, const char *name);
void initialiser_end(initialiser *i);

/* Of a member that is a struct, a union or an array of these; NULL: of an element of such an array. */
void initialiser_open(initialiser *i, const char *member);
void initialiser_close(initialiser *i);

void initialiser_word(initialiser *i, const char *member, const char *word); /* an enumerator, say */
void initialiser_bool(initialiser *i, const char *member, bool value);
void initialiser_real(initialiser *i, const char *member, float value);
void initialiser_integer(initialiser *i, const char *member, int64_t value);
void initialiser_unsigned(initialiser *i, const char *member, uint64_t value);

/* Arrays, without the zeros at their ends: what is not told is 0, and where the capacities of whoever compiles it are
 * smaller, only what is used must fit. */
void initialiser_reals(initialiser *i, const char *member, const float *value, size_t count);
void initialiser_int16s(initialiser *i, const char *member, const int16_t *value, size_t count);
void initialiser_int32s(initialiser *i, const char *member, const int32_t *value, size_t count);
void initialiser_uint32s(initialiser *i, const char *member, const uint32_t *value, size_t count);

#endif
