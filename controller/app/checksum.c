#include "checksum.h"

#include <zlib.h>

enum { LENGTH = 4 };

static uint32_t checksum_of(const unsigned char *bytes, size_t size) {
    return (uint32_t)crc32_z(crc32_z(0, NULL, 0), bytes, size);
}

/* As LCM encodes it: big-endian. */
int32_t checksum_seal(unsigned char *bytes, int size) {
    if (size < LENGTH) {
        return 0;
    }
    const size_t before = (size_t)size - LENGTH;
    const uint32_t sum = checksum_of(bytes, before);
    for (int i = 0; i < LENGTH; i++) {
        bytes[before + (size_t)i] = (unsigned char)(sum >> (24 - 8 * i));
    }
    return (int32_t)sum;
}

bool checksum_holds(const unsigned char *bytes, size_t size) {
    if (size < LENGTH) {
        return false;
    }
    uint32_t told = 0;
    for (size_t i = size - LENGTH; i < size; i++) {
        told = told << 8 | bytes[i];
    }
    return told == checksum_of(bytes, size - LENGTH);
}
