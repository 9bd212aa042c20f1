#include "input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void fuzz_take(fuzz_input *in, void *out, size_t size) {
    const size_t present = size < in->size ? size : in->size;
    memset(out, 0, size);
    memcpy(out, in->data, present);
    in->data += present;
    in->size -= present;
}

uint8_t fuzz_byte(fuzz_input *in) {
    uint8_t byte;
    fuzz_take(in, &byte, 1);
    return byte;
}

void fuzz_patch(fuzz_input *in, void *object, size_t size, size_t grain) {
    uint8_t value[4];
    for (int left = fuzz_byte(in); left > 0 && in->size > 0; left--) {
        uint16_t place;
        fuzz_take(in, &place, sizeof place);
        fuzz_take(in, value, sizeof value);
        const size_t places = (size - sizeof value) / grain + 1;
        memcpy((uint8_t *)object + place % places * grain, value, sizeof value);
    }
}

const char *fuzz_file(const uint8_t *data, size_t size) {
    static int file = -1;
    static char path[32];
    if (file < 0) {
        file = memfd_create("input", 0);
        snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    }
    const int written = ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == (ssize_t)size;
    FUZZ_EXPECT(written);
    return path;
}

void fuzz_failed(const char *expectation, const char *file, int line) {
    fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, expectation);
    abort();
}
