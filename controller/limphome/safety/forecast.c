#include "limphome/safety/forecast.h"

#include "limphome/base/elementary.h"
#include "limphome/body/rest.h"

#define LEAST_GROUND 0.5f /* z of its normal; steeper ground is taken for a robot that does not rest as it should */

static const lh_vec3 vertical = {0.0f, 0.0f, 1.0f};

/* The vertical in the frame of the ground that the robot rests on, x along its heading: rest.h. */
static lh_vec3 vertical_of_ground(lh_quat attitude, const lh_rest *rest) {
    lh_quat back = lh_quat_about(vertical, -lh_quat_heading(attitude));
    lh_vec3 normal = lh_quat_rotate(back, lh_quat_rotate(attitude, rest->normal));
    return normal.z > LEAST_GROUND ? lh_quat_rotate(lh_rest_upright(normal), vertical) : vertical;
}

lh_forecast lh_forecast_margin(const lh_robot *robot, lh_quat attitude, const float *angle, const float *next) {
    lh_rest rest;
    lh_rest_find(robot, angle, vertical, &rest);
    lh_vec3 up = vertical_of_ground(attitude, &rest);
    lh_forecast forecast;
    lh_rest_find(robot, angle, up, &rest);
    forecast.still = rest.margin;
    lh_rest_find(robot, next, up, &rest);
    forecast.moving = rest.margin;
    return forecast;
}
