/* What keeps a run from going on, if anything does: told in LIMPHOME_STATUS, in a line on stderr when it begins, and,
 * if it lasts, by the exit code. */
#ifndef LIMPHOME_APP_TROUBLE_H
#define LIMPHOME_APP_TROUBLE_H

#include "fail.h"
#include "notice.h"
#include "plant_link.h"
#include "settings.h"

enum { TROUBLE_KINDS = 15 }; /* constants of status_t from NONE to PACED; some are the plant's */

typedef struct trouble {
    double timeout;   /* without a state to decide on before anything is said [s] */
    double give_up;   /* before the run is given up [s]; 0: never */
    int8_t reason;    /* a constant of status_t */
    double useful;    /* when a state was decided on or answered by rest [s] */
    double looked;    /* when we last looked [s] */
    int64_t overruns; /* when they were counted last */
    double counted;   /* when that was [s] */
    double flooded;   /* when there was the last one [s] */
    notice notices[TROUBLE_KINDS];
} trouble;

void trouble_init(trouble *t, const settings *s, double now);

/* A state was decided on at `now` [s] (reason NONE), or answered by rest as the plant is NOT_ARMED, the robot TUMBLED
 * or who had it by hand OPERATOR_SILENT: that lasts as long as a person takes. */
void trouble_useful(trouble *t, int8_t reason, double now);

/* Looks at the link at `now` [s]; call often. A plant that a person holds up is waited for. Returns for how long nobody
 * looked beyond what is usual [s]: the process was stopped, and what it has not heard says nothing. */
double trouble_look(trouble *t, const plant_link *l, double now);

/* The condition of status_t that the reason makes of `condition`. */
int8_t trouble_condition(const trouble *t, int8_t condition);

/* Whether to go on; false, with the reason in `error`, if there is no use. */
bool trouble_bears(const trouble *t, double now, char error[ERROR_LENGTH]);

#endif
