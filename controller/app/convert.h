/* Between the library's structs and what is outside: settings and messages. What was learned: learned.h. */
#ifndef LIMPHOME_APP_CONVERT_H
#define LIMPHOME_APP_CONVERT_H

#include <stdbool.h>

#include "limphome/controller.h"
#include "limphome_decision_t.h"
#include "limphome_episode_t.h"
#include "limphome_robot_state_t.h"
#include "limphome_status_t.h"
#include "settings.h"

/* The library's configuration for an experiment. */
lh_config convert_config(const settings *s);

/* What the sensors tell, in single precision. */
lh_state convert_state(const limphome_robot_state_t *message);

/* Actuators that obey, fully or weakly. */
lh_controlled convert_controlled(const limphome_robot_state_t *message);

/* Telemetry of one decision, taken on `state`, and of an episode that it ended. */
limphome_decision_t convert_decision(const lh_controller *controller, const lh_decision *decision,
                                     const limphome_robot_state_t *state);
limphome_episode_t convert_episode(const lh_controller *controller, const lh_summary *summary,
                                   const limphome_robot_state_t *state, double decision_period);

/* Fills in how often each limit of the controller acted. */
void convert_limits(const lh_controller *controller, limphome_status_t *status);

#endif
