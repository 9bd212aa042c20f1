#include "initialiser.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_LENGTH = 32, LINE_LENGTH = 110 };

static void indent(const initialiser *i) {
    fprintf(i->file, "%*s", 4 * i->depth, "");
}

static void put(initialiser *i, const char *member, const char *text) {
    indent(i);
    if (member != NULL) {
        fprintf(i->file, ".%s = ", member);
    }
    fprintf(i->file, "%s,\n", text);
}

void initialiser_begin(initialiser *i, const char *type, const char *name) {
    fprintf(i->file, "\nstatic const %s %s = {\n", type, name);
    i->depth++;
}

void initialiser_end(initialiser *i) {
    i->depth--;
    fprintf(i->file, "};\n");
}

void initialiser_open(initialiser *i, const char *member) {
    indent(i);
    if (member != NULL) {
        fprintf(i->file, ".%s = ", member);
    }
    fprintf(i->file, "{\n");
    i->depth++;
}

void initialiser_close(initialiser *i) {
    i->depth--;
    indent(i);
    fprintf(i->file, "},\n");
}

/* A short text that is read as the same float; what ends it makes it one. */
static void real_text(float value, char text[NUMBER_LENGTH]) {
    char number[NUMBER_LENGTH - 4] = "";
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(number, sizeof number, "%.*g", digits, (double)value);
        if (strtof(number, NULL) == value) {
            break;
        }
    }
    snprintf(text, NUMBER_LENGTH, "%s%s", number, strpbrk(number, ".e") == NULL ? ".0f" : "f");
}

void initialiser_word(initialiser *i, const char *member, const char *word) {
    put(i, member, word);
}

void initialiser_bool(initialiser *i, const char *member, bool value) {
    put(i, member, value ? "true" : "false");
}

void initialiser_real(initialiser *i, const char *member, float value) {
    char text[NUMBER_LENGTH];
    real_text(value, text);
    put(i, member, text);
}

void initialiser_integer(initialiser *i, const char *member, int64_t value) {
    char text[NUMBER_LENGTH];
    snprintf(text, sizeof text, "%" PRId64, value);
    put(i, member, text);
}

void initialiser_unsigned(initialiser *i, const char *member, uint64_t value) {
    char text[NUMBER_LENGTH];
    snprintf(text, sizeof text, "%" PRIu64 "u", value);
    put(i, member, text);
}

/* Text of the element at an index of an array. */
typedef void element_text(const void *array, size_t index, char text[NUMBER_LENGTH]);

static void real_at(const void *array, size_t index, char text[NUMBER_LENGTH]) {
    real_text(((const float *)array)[index], text);
}

static void int16_at(const void *array, size_t index, char text[NUMBER_LENGTH]) {
    snprintf(text, NUMBER_LENGTH, "%d", ((const int16_t *)array)[index]);
}

static void int32_at(const void *array, size_t index, char text[NUMBER_LENGTH]) {
    snprintf(text, NUMBER_LENGTH, "%" PRId32, ((const int32_t *)array)[index]);
}

static void uint32_at(const void *array, size_t index, char text[NUMBER_LENGTH]) {
    snprintf(text, NUMBER_LENGTH, "%" PRIu32 "u", ((const uint32_t *)array)[index]);
}

/* Elements up to the last whose bytes are not all 0. */
static size_t used(const void *array, size_t count, size_t size) {
    const unsigned char *bytes = array;
    size_t length = count * size;
    while (length > 0 && bytes[length - 1] == 0) {
        length--;
    }
    return (length + size - 1) / size;
}

static void put_array(initialiser *i, const char *member, const void *array, size_t count, size_t size,
                      element_text *text_of) {
    const size_t last = used(array, count, size);
    if (last == 0) {
        put(i, member, "{0}");
        return;
    }
    initialiser_open(i, member);
    int column = LINE_LENGTH;
    for (size_t k = 0; k < last; k++) {
        char text[NUMBER_LENGTH];
        text_of(array, k, text);
        const int length = (int)strlen(text) + 2; /* comma and space */
        if (column + length > LINE_LENGTH) {
            fprintf(i->file, "%s%*s", k > 0 ? "\n" : "", 4 * i->depth, "");
            column = 4 * i->depth;
        } else {
            fputc(' ', i->file);
        }
        fprintf(i->file, "%s,", text);
        column += length;
    }
    fputc('\n', i->file);
    initialiser_close(i);
}

void initialiser_reals(initialiser *i, const char *member, const float *value, size_t count) {
    put_array(i, member, value, count, sizeof *value, real_at);
}

void initialiser_int16s(initialiser *i, const char *member, const int16_t *value, size_t count) {
    put_array(i, member, value, count, sizeof *value, int16_at);
}

void initialiser_int32s(initialiser *i, const char *member, const int32_t *value, size_t count) {
    put_array(i, member, value, count, sizeof *value, int32_at);
}

void initialiser_uint32s(initialiser *i, const char *member, const uint32_t *value, size_t count) {
    put_array(i, member, value, count, sizeof *value, uint32_at);
}
