/* The plant in one thread with the controller: the simulator's world, link and loop, which goes on whenever the
 * controller waits. */
#ifndef LIMPHOME_PAIR_PLANT_H
#define LIMPHOME_PAIR_PLANT_H

#include <robot_description.h>
#include <settings.h>
#include <signal.h>
#include <stdbool.h>
#include <udpm.h>

#ifdef __cplusplus
extern "C" {
#endif

/* URL of a bus that is its owner's alone, until two of them are joined. */
#define PLANT_OWN_QUEUE "memq://"

typedef struct plant plant;

/* NULL, having said why on stderr, where robot and settings do not make a plant in lockstep. */
plant *plant_open(const robot_description *robot, const settings *s);

/* Makes `controller`, opened at PLANT_OWN_QUEUE, the other half of the plant's bus, and begins. The plant goes on from
 * udpm_wait of the controller, until *stop is not 0; it sets that itself where it fails, having said why on stderr. */
void plant_begin(plant *p, udpm *controller, volatile sig_atomic_t *stop);

/* To be called after the controller has closed its half. Whether the plant has not failed. */
bool plant_close(plant *p);

#ifdef __cplusplus
}
#endif
#endif
