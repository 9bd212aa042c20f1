/* The platform of a board: start of a C program, and semihosting. No stdio, whose printf needs malloc. */
#include <string.h>

#include "platform.h"

/* Semihosting operations (Arm's "Semihosting for AArch32 and AArch64"). */
enum { SYS_OPEN = 0x01, SYS_WRITE0 = 0x04, SYS_WRITE = 0x05, SYS_READ = 0x06, SYS_EXIT = 0x18 };
enum { STOPPED_RUN_TIME_ERROR = 0x20023, STOPPED_APPLICATION_EXIT = 0x20026 };

static intptr_t semihost(intptr_t operation, intptr_t argument) {
    register intptr_t r0 __asm__("r0") = operation;
    register intptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void platform_say(const char *text) {
    semihost(SYS_WRITE0, (intptr_t)text);
}

int platform_open(const char *name, bool write) {
    enum { READ_BINARY = 1, WRITE_BINARY = 5 };
    const intptr_t block[] = {(intptr_t)name, write ? WRITE_BINARY : READ_BINARY, (intptr_t)strlen(name)};
    return (int)semihost(SYS_OPEN, (intptr_t)block);
}

/* Both operations return the number of bytes that were not transferred. */
static bool transfer(intptr_t operation, int file, const void *memory, uint32_t size) {
    const intptr_t block[] = {file, (intptr_t)memory, (intptr_t)size};
    return semihost(operation, (intptr_t)block) == 0;
}

bool platform_read(int file, void *to, uint32_t size) {
    return transfer(SYS_READ, file, to, size);
}

bool platform_write(int file, const void *from, uint32_t size) {
    return transfer(SYS_WRITE, file, from, size);
}

static _Noreturn void leave(intptr_t reason) {
    for (;;) {
        semihost(SYS_EXIT, reason);
    }
}

_Noreturn void stopped_by_fault(void);
_Noreturn void stopped_by_fault(void) {
    platform_say("stopped by a fault\n");
    leave(STOPPED_RUN_TIME_ERROR);
}

int main(void);

/* What the linker script tells. */
extern char data_begin[], data_end[], bss_begin[], bss_end[];
extern const char data_image[];

/* Called by reset with the FPU on. */
_Noreturn void start(void);
_Noreturn void start(void) {
    memcpy(data_begin, data_image, (size_t)(data_end - data_begin));
    memset(bss_begin, 0, (size_t)(bss_end - bss_begin));
    leave(main() == 0 ? STOPPED_APPLICATION_EXIT : STOPPED_RUN_TIME_ERROR);
}
