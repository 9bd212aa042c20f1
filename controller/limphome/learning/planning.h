/* Planning: what lh_planner does between decisions with what it knows. Not part of the interface. */
#ifndef LIMPHOME_PLANNING_H
#define LIMPHOME_PLANNING_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/learning/planner.h"

/* Where the robot is against its line. */
typedef struct lh_course {
    float heading; /* error [rad] */
    float lateral; /* error [m] */
} lh_course;

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

/* An action taken where the arm is, and where it leads. */
typedef struct lh_option {
    int32_t action;                 /* of planner->planned */
    float reward;                   /* for the step itself */
    float value;                    /* with all that follows */
    lh_twist expected;              /* by mechanics alone */
    lh_course course;               /* then */
    float angle[LH_PLANNED_JOINTS]; /* then [rad] */
} lh_option;

/* The posture looked at is angle[planned.num_joints]. False if the action is not allowed there. */
bool lh_planning_consider(const lh_planner *planner, const float *angle, lh_course course, int32_t action,
                          lh_option *option);

/* The one that promises most, by a search of two steps. The posture looked at is angle[planned.num_joints], and after
 * the call another. */
lh_option lh_planning_choose(lh_planner *planner, const float *angle, lh_course course);

#endif
