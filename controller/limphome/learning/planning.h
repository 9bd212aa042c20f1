/* Planning: what lh_planner does between decisions with what it knows. Not part of the interface. */
#ifndef LIMPHOME_PLANNING_H
#define LIMPHOME_PLANNING_H

#include <stdint.h>

#include "limphome/learning/planner.h"

/* Steering error: planner.h [rad]. */
float lh_course_steering(lh_course course);

/* Costs of all nodes, on ground with the vertical planner->up, other joints as in planner->joint_angle. */
void lh_planning_assess(lh_planner *planner);

/* What planner->outlook is to tell: the posture angle[planned.num_joints]. */
void lh_planning_look(lh_planner *planner, const float *angle);

/* One step of value iteration at `node`: its values become the best that an action promises there. */
void lh_planning_back_up(lh_planner *planner, int32_t node);

/* The same at `count` nodes, one after the other from where it was left the last time. */
void lh_planning_back_up_in_turn(lh_planner *planner, int32_t count);

/* What comes of an action in the posture looked at, which is angle[planned.num_joints]. */
void lh_planning_consider(const lh_planner *planner, const float *angle, lh_course course, int32_t action,
                          lh_option *option);

/* The one that promises most of those that are allowed, by a search of two steps; to stand still where none is. The
 * posture looked at is angle[planned.num_joints], and after the call another. `caution` is the reward withheld from
 * actions that were never tried there. */
lh_option lh_planning_choose(lh_planner *planner, const float *angle, lh_course course, float caution);

#endif
