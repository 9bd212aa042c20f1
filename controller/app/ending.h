/* How a program ends that is a run: limphome-controller, and limphome-pair. */
#ifndef LIMPHOME_APP_ENDING_H
#define LIMPHOME_APP_ENDING_H

#include "run.h"

/* Exit codes. */
typedef enum ending {
    ENDING_DONE = 0,       /* all episodes done, or what was asked for printed */
    ENDING_WENT_WRONG = 1, /* something did on the way */
    ENDING_BAD_INPUT = 2,  /* nothing was started */
    ENDING_GAVE_UP = 3,    /* there was no plant that obeys */
    ENDING_STOPPED = 130   /* by a signal */
} ending;

/* Closes the run, whose run_decide has returned `complete`, and says on stderr what kept it from its end. */
ending ending_close(run *r, bool complete);

#endif
