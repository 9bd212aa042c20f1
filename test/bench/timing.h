/* What the programs that measure time have in common. */
#ifndef LIMPHOME_BENCH_TIMING_H
#define LIMPHOME_BENCH_TIMING_H

#include <stdlib.h>
#include <time.h>

/* [s] */
static inline double timing_now(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int timing_ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts them. */
static inline double timing_median(double *seconds, size_t count) {
    qsort(seconds, count, sizeof *seconds, timing_ascending);
    return seconds[count / 2];
}

#endif
