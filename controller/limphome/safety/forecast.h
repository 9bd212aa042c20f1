/* Forecast of the stability margin (11): how stable the robot will be in the posture of its arm that an action leads
 * to, at rest on the ground it stands on. */
#ifndef LIMPHOME_FORECAST_H
#define LIMPHOME_FORECAST_H

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_forecast {
    float still;  /* margin where it is [m], LH_NO_REST_MARGIN where it rests nowhere */
    float moving; /* after the action [m] */
} lh_forecast;

/* With angle[robot->num_actuators] [rad] now and next[robot->num_actuators] after the action. The slope of the ground
 * is what the attitude, body to world and of unit length, leaves to be explained. */
lh_forecast lh_forecast_margin(const lh_robot *robot, lh_quat attitude, const float *angle, const float *next);

#ifdef __cplusplus
}
#endif
#endif
