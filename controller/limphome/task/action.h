/* Joint actions: one level (0 reverse, 1 still, 2 forward; Table 1) for each of n controlled actuators,
 * numbered 0 to 3^n - 1 with actuator k as digit k of the number in base 3, the lowest first. */
#ifndef LIMPHOME_ACTION_H
#define LIMPHOME_ACTION_H

#include <stdint.h>

#include "limphome/base/capacity.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_STILL 1 /* the level that does nothing */

/* Range of the speed of the forward and reverse levels. */
#define LH_SPEED_MIN 0.01f /* [m/s or rad/s] */
#define LH_SPEED_MAX 2.0f  /* [m/s or rad/s] */

/* 3^n; n is 0 to LH_MAX_ACTUATORS. */
int32_t lh_action_count(int32_t n);

/* Levels [n] of joint action `index`, which is 0 to 3^n - 1. */
void lh_action_levels(int32_t index, int32_t n, int8_t *levels);

/* The inverse of lh_action_levels. */
int32_t lh_action_index(const int8_t *levels, int32_t n);

/* A level as a network input: 0, 0.5 or 1. */
float lh_action_input(int8_t level);

/* The levels of joint action `index` as network inputs [n]. */
void lh_action_inputs(int32_t index, int32_t n, float *inputs);

/* A level as a velocity [m/s or rad/s]: -speed, 0 or speed. */
float lh_action_velocity(int8_t level, float speed);

#ifdef __cplusplus
}
#endif
#endif
