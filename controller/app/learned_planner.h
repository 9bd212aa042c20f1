/* What a planner has learned, between the library and its message. */
#ifndef LIMPHOME_APP_LEARNED_PLANNER_H
#define LIMPHOME_APP_LEARNED_PLANNER_H

#include <stdbool.h>

#include "limphome/controller.h"
#include "limphome_planner_t.h"

/* Fills in all but time and episode of a message that is 0. */
void learned_save_planner(limphome_planner_t *message, const lh_controller *controller);

/* False if it is for other actuators, speeds, joint ranges, another decision period or mechanics than the controller's.
 */
bool learned_restore_planner(const limphome_planner_t *message, const lh_controller *controller,
                             lh_planner_learned *restored);

#endif
