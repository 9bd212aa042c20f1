/* What the network sees: state values of the controlled actuators (Table 1), roll and pitch, each brought to [0, 1].
 * Crawler: torque over its limit; joint: angle over its range; roll and pitch: over +-pi/2. */
#ifndef LIMPHOME_OBSERVATION_H
#define LIMPHOME_OBSERVATION_H

#include <stdint.h>

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the sensors tell at one decision. */
typedef struct lh_state {
    float position[3];                         /* body origin in the world frame [m] */
    lh_quat orientation;                       /* body to world; scaled to unit length on entry */
    int32_t num_actuators;                     /* equal to the robot's */
    float actuator_position[LH_MAX_ACTUATORS]; /* joint angle [rad]; crawlers: not read */
    float actuator_effort[LH_MAX_ACTUATORS];   /* crawler torque about the sprocket [N*m]; joints: not read */
    int8_t actuator_failed[LH_MAX_ACTUATORS];  /* not 0: does not obey; read by the monitor alone */
} lh_state;

/* Which actuators are controlled: ascending indices into the robot's actuators. */
typedef struct lh_controlled {
    int32_t count; /* 1 to LH_MAX_ACTUATORS */
    int32_t index[LH_MAX_ACTUATORS];
} lh_controlled;

/* (value - low) / (high - low), limited to [0, 1]. *clamped is raised by one if the limit acted. */
float lh_observation_scale(float value, float low, float high, int32_t *clamped);

/* Range of the state value of an actuator: -limit to limit for a crawler, its joint range for a joint. */
void lh_observation_range(const lh_actuator *actuator, float *low, float *high);

/* Fills inputs[controlled->count + 2]; returns how many values were limited to their range. `state` must be valid;
 * `attitude` is its orientation, of unit length. */
int32_t lh_observation(const lh_robot *robot, const lh_controlled *controlled, const lh_state *state, lh_quat attitude,
                       float *inputs);

/* LH_OK, or LH_ERROR_STATE for NaN, infinity, |position| over 1e6 m, a joint angle over LH_ANGLE_LIMIT, a quaternion
 * whose length is not within 0.9 to 1.1, or a number of actuators other than the robot's. */
lh_error lh_state_validate(const lh_state *state, const lh_robot *robot);

#ifdef __cplusplus
}
#endif
#endif
