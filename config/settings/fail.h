/* How whatever can fail does it: it takes a text of the caller's, returns false, and says there what is wrong. The
 * process prints it in one place, main. */
#ifndef LIMPHOME_FAIL_H
#define LIMPHOME_FAIL_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { ERROR_LENGTH = 512 };

/* Writes the reason, cut to ERROR_LENGTH, unless `error` holds one already: what follows the first is mostly its
 * consequence. So `error` must begin as "". Always false. */
bool fail_with(char error[ERROR_LENGTH], const char *format, ...) __attribute__((format(printf, 2, 3)));

#ifdef __cplusplus
}
#endif
#endif
