#include "ending.h"

#include <stdio.h>

ending ending_close(run *r, bool complete) {
    if (!run_close(r, complete)) {
        fprintf(stderr, "%s\n", r->error);
        return r->gave_up ? ENDING_GAVE_UP : ENDING_WENT_WRONG;
    }
    if (!complete) {
        fprintf(stderr, "stopped after episode %d\n", r->finished);
        return ENDING_STOPPED;
    }
    return ENDING_DONE;
}
