#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include "platform.h"

void platform_say(const char *text) {
    fputs(text, stderr);
}

int platform_open(const char *name, bool write) {
    return write ? open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666) : open(name, O_RDONLY);
}

bool platform_read(int file, void *to, uint32_t size) {
    return read(file, to, size) == (ssize_t)size;
}

bool platform_write(int file, const void *from, uint32_t size) {
    return write(file, from, size) == (ssize_t)size;
}
