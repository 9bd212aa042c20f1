/* Planning: what lh_planner does between decisions with what it knows. Not part of the interface. */
#ifndef LIMPHOME_PLANNING_H
#define LIMPHOME_PLANNING_H

#include <stdint.h>

#include "limphome/learning/planner.h"

/* Where the robot is against its line. */
typedef struct lh_course {
    float heading; /* error [rad] */
    float lateral; /* error [m] */
} lh_course;

/* Heading error + LH_STEERING_GAIN times lateral error. */
float lh_course_steering(lh_course course);

/* Costs of all nodes, on ground with the vertical planner->up, other joints as in planner->joint_angle. */
void lh_planning_assess(lh_planner *planner);

/* What planner->outlook is to tell: the posture angle[planned.num_joints]. */
void lh_planning_look(lh_planner *planner, const float *angle);

/* By mechanics alone, what `action` does in the posture looked at. */
lh_motion lh_planning_expect(const lh_planner *planner, int32_t action);

/* Backs up `previous`, unless LH_NO_NODE, `node`, config.imagined nodes along the way that seems best from there with
 * steering error `steering`, and config.backups nodes in turn. */
void lh_planning_improve(lh_planner *planner, int32_t previous, int32_t node, float steering);

/* The action that promises most at angle[planned.num_joints] and `course`, and its value. `curiosity` is the reward for
 * one that was never tried there. */
int32_t lh_planning_choose(lh_planner *planner, const float *angle, lh_course course, float curiosity, float *value);

#endif
