/* A recorded run as one file: configuration and robot, then the state of each decision. Structs are written as they
 * are: host and board agree on sizes, order of bytes and IEEE 754; `header_size` tells if not. */
#ifndef LIMPHOME_EMBEDDED_RECORDING_H
#define LIMPHOME_EMBEDDED_RECORDING_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/controller.h"

#define RECORDING_FILE "recording.bin"

typedef struct recording_header {
    uint32_t header_size;
    uint32_t state_size;
    int32_t decisions;
    lh_config config;
    lh_robot robot;
    lh_controlled controlled;
} recording_header;

/* One decision, all that tells it from another; without padding, so that files of it can be compared. */
typedef struct recorded_decision {
    int32_t episode, step, learned, action;
    float inputs[LH_MAX_INPUTS];
    float q, q_max, probability, temperature;
    float td_error, reward_motion, reward_goal, reward_stability, reward_tumble;
    float stability_margin, goal_distance, lateral_error, heading_error;
} recorded_decision;

/* Opens the recording of *decisions decisions and sets up the controller that it is of. The file, or negative after
 * saying what is wrong. */
int recording_open(lh_controller *controller, int32_t *decisions);

/* The next of as many states. */
bool recording_next(int file, lh_state *state);

#endif
