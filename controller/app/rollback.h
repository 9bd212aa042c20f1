/* Back to where the plant was last put back to its initial pose. A plant that is started anew begins there, and what a
 * simulator draws follows from seed and episode; so a learner that is rolled back to that moment ends as if nothing had
 * happened. */
#ifndef LIMPHOME_APP_ROLLBACK_H
#define LIMPHOME_APP_ROLLBACK_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/controller.h"
#include "run_folder.h"

typedef struct rollback {
    lh_controller controller;
    run_folder_place place;
} rollback;

/* Keeps what is known where the plant is about to be put back, after `episodes` finished ones. */
void rollback_keep(rollback *kept, const lh_controller *controller, int32_t episodes, const run_folder *folder);

/* Takes controller, table and recording back there; the finished episodes are kept->place.episodes again. False, with
 * the reason in `error`, if a file cannot be cut. */
bool rollback_return(const rollback *kept, lh_controller *controller, run_folder *folder, char error[ERROR_LENGTH]);

#endif
