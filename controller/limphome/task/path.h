/* The path: the straight lines that episodes follow, one after the other.
 *
 * Rolling, the paper's: each episode has a line of its own, from where the robot is, along where it faces, so errors
 * add up from episode to episode. Any other path lies fixed in the world, and an episode's line is the leg of it that
 * the robot is on: ahead, one leg without an end, from where the robot was put, along where it faced; waypoints, a leg
 * from there to the first of them and one from each to the next.
 *
 * A waypoint counts as passed once the robot is beyond the line across the leg at its end, however far beside; corners
 * are not cut. With the last the path is over. */
#ifndef LIMPHOME_PATH_H
#define LIMPHOME_PATH_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/base/capacity.h"
#include "limphome/base/error.h"
#include "limphome/task/reward.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_WAYPOINT_MAX 1000.0f /* largest magnitude of a coordinate [m] */

typedef enum lh_path_kind { LH_PATH_ROLLING = 0, LH_PATH_AHEAD = 1, LH_PATH_WAYPOINTS = 2 } lh_path_kind;

/* A point on the ground, in the world frame [m]. */
typedef struct lh_point2 {
    float x, y;
} lh_point2;

typedef struct lh_path_config {
    lh_path_kind kind;                    /* paper: LH_PATH_ROLLING */
    int32_t num_waypoints;                /* of LH_PATH_WAYPOINTS, 1 to LH_MAX_WAYPOINTS */
    lh_point2 waypoint[LH_MAX_WAYPOINTS]; /* [num_waypoints], each coordinate within +-LH_WAYPOINT_MAX */
} lh_path_config;

/* The leg the robot is on. */
typedef struct lh_path {
    lh_pose2 leg; /* where it begins, and its direction */
    float length; /* [m]; without an end: FLT_MAX */
    int32_t next; /* the waypoint at its end, counted from 0 */
} lh_path;

/* Rolling. */
lh_path_config lh_path_config_default(void);

/* LH_OK or LH_ERROR_PATH. */
lh_error lh_path_config_validate(const lh_path_config *config);

/* The first leg begins at `pose`. A rolling path does so for each episode, any other where the robot has been put into
 * its initial pose. */
void lh_path_begin(lh_path *path, const lh_path_config *config, const lh_pose2 *pose);

/* For a robot that stands somewhere along the path and is not carried back to its beginning, such as after a restart:
 * enters the leg nearest to `pose`, the later one where two are equally near, so that no waypoint is driven back to
 * that has been passed. The path then begins where the world frame does, at its origin and facing +y; a rolling one
 * begins at `pose`, and so does one that `pose` has passed altogether. */
void lh_path_resume(lh_path *path, const lh_path_config *config, const lh_pose2 *pose);

/* Goes over to the leg after the last waypoint that `pose` has passed, but not beyond the last leg. */
void lh_path_advance(lh_path *path, const lh_path_config *config, const lh_pose2 *pose);

/* Whether `pose` has passed the last waypoint; never where there are none. */
bool lh_path_over(const lh_path *path, const lh_path_config *config, const lh_pose2 *pose);

/* Where the goal line of an episode that begins at `pose` lies along the leg, from the leg's beginning: `distance`
 * further on, or at the leg's end if that is nearer [m]. */
float lh_path_goal(const lh_path *path, const lh_pose2 *pose, float distance);

/* Straight to the waypoint at the leg's end; 0 where there is none [m]. */
float lh_path_waypoint_distance(const lh_path *path, const lh_path_config *config, const lh_pose2 *pose);

/* Where `pose` is, seen from the beginning of `line` and along its direction: how far on, and how far beside, positive
 * to the left [m]. */
float lh_line_along(const lh_pose2 *line, const lh_pose2 *pose);
float lh_line_lateral(const lh_pose2 *line, const lh_pose2 *pose);

#ifdef __cplusplus
}
#endif
#endif
