/* What keeps a run from going on, if anything does: told in LIMPHOME_STATUS, in a line on stderr when it begins, and,
 * if it lasts, by the exit code. */
#ifndef LIMPHOME_APP_TROUBLE_H
#define LIMPHOME_APP_TROUBLE_H

#include "fail.h"
#include "notice.h"
#include "plant_link.h"
#include "settings.h"

enum { TROUBLE_KINDS = 7 }; /* constants of status_t from NONE to FLOODED */

typedef struct trouble {
    double timeout;   /* without a state to decide on before anything is said [s] */
    double give_up;   /* before the run is given up [s]; 0: never */
    int8_t reason;    /* a constant of status_t */
    double useful;    /* when a state was decided on, or a plant that is not armed was answered [s] */
    double looked;    /* when we last looked [s] */
    int64_t overruns; /* at that time */
    double flooded;   /* when there was the last one [s] */
    notice notices[TROUBLE_KINDS];
} trouble;

void trouble_init(trouble *t, const settings *s, double now);

/* A state of a plant that is armed, or is not, was dealt with at `now` [s]. */
void trouble_useful(trouble *t, bool armed, double now);

/* Looks at the link at `now` [s]; call often. Returns for how long nobody looked beyond what is usual [s]: the process
 * was stopped, and what it has not heard says nothing. */
double trouble_look(trouble *t, const plant_link *l, double now);

/* The condition of status_t that the reason makes of `condition`. */
int8_t trouble_condition(const trouble *t, int8_t condition);

/* Whether to go on; false, with the reason in `error`, if there is no use. */
bool trouble_bears(const trouble *t, double now, char error[ERROR_LENGTH]);

#endif
