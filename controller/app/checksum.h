/* The checksum of what was learned: CRC-32 (zlib's) of all bytes before it, in the last four bytes of an encoded
 * message whose last field is `int32_t crc32`. It tells of bits that a disk or a link has turned. */
#ifndef LIMPHOME_APP_CHECKSUM_H
#define LIMPHOME_APP_CHECKSUM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Writes it into the last four of `size` bytes and returns it as the field has it; 0 for an encoder's error, which is a
 * `size` below 4. */
int32_t checksum_seal(unsigned char *bytes, int size);

/* Whether the last four bytes are that of the others. */
bool checksum_holds(const unsigned char *bytes, size_t size);

#endif
