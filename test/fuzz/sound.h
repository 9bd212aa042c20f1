/* What must hold after every call of lh_controller_step, whatever it was given. */
#ifndef LIMPHOME_FUZZ_SOUND_H
#define LIMPHOME_FUZZ_SOUND_H

#include "input.h"
#include "limphome/limphome.h"

/* One step: refused with nothing changed, or with a decision that is finite and within its ranges, and a learner
 * that keeps to what its kind does: a network that lh_network_validate accepts, a planner that can be restored. */
void fuzz_step(lh_controller *controller, const lh_state *state);

/* Steps from the state `good` with words overwritten, until the input is used up. */
void fuzz_steps(fuzz_input *in, lh_controller *controller, const lh_state *good);

#endif
