/* A fuzzer's bytes, read from the front; past the end all is 0. */
#ifndef LIMPHOME_FUZZ_INPUT_H
#define LIMPHOME_FUZZ_INPUT_H

#include <stddef.h>
#include <stdint.h>

typedef struct fuzz_input {
    const uint8_t *data;
    size_t size;
} fuzz_input;

void fuzz_take(fuzz_input *in, void *out, size_t size);
uint8_t fuzz_byte(fuzz_input *in);

/* Overwrites groups of 4 bytes of object[size], at multiples of `grain` bytes, as often as the input says. From a good
 * object every bit pattern can be reached, and one bad field at a time, which random bytes alone hardly ever give. */
void fuzz_patch(fuzz_input *in, void *object, size_t size, size_t grain);

/* Leaves the input in a file. Returns its path, good until the next call. */
const char *fuzz_file(const uint8_t *data, size_t size);

/* Aborts, which the fuzzer reports with the input, unless `holds`. */
#define FUZZ_EXPECT(holds) ((holds) ? (void)0 : fuzz_failed(#holds, __FILE__, __LINE__))
void fuzz_failed(const char *expectation, const char *file, int line);

/* libFuzzer calls it with one input after the other. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
