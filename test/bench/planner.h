/* One decision of the planner, computed in several ways: what a step did is taken in, ten postures are backed up, and
 * the best of all actions is sought two steps ahead (planner.h). All ways begin with the same measurements and values,
 * and see the same robot. */
#ifndef LIMPHOME_BENCH_PLANNER_H
#define LIMPHOME_BENCH_PLANNER_H

#include "limphome/learning/planner.h"

enum { OBSERVATIONS = 64 };

typedef struct course_of_decisions {
    lh_planner planner; /* as it begins */
    lh_observed observed[OBSERVATIONS];
    int32_t executed[OBSERVATIONS]; /* by the library; the other ways are told */
} course_of_decisions;

/* A way to decide. `begin` takes over how it begins; `decide` makes decision k < OBSERVATIONS, counted from 0, and
 * returns its action of lh_planner.planned. */
typedef struct planner_method {
    void (*begin)(const course_of_decisions *course);
    int32_t (*decide)(int32_t k);
} planner_method;

extern const planner_method plain_planner_float_method;
extern const planner_method plain_planner_double_method;

#endif
