/* What the programs here need of what they run on: a host, or a board whose debugger offers semihosting. */
#ifndef LIMPHOME_EMBEDDED_PLATFORM_H
#define LIMPHOME_EMBEDDED_PLATFORM_H

#include <stdbool.h>
#include <stdint.h>

/* Shows a text to the person who runs the program. */
void platform_say(const char *text);

/* Opens a file in the working directory of the host, anew if it is to be written. Negative: it cannot be. */
int platform_open(const char *name, bool write);

/* Exactly `size` bytes, or false. */
bool platform_read(int file, void *to, uint32_t size);
bool platform_write(int file, const void *from, uint32_t size);

#endif
