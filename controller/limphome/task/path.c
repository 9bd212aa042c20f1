#include "limphome/task/path.h"

#include <float.h>

#include "limphome/base/elementary.h"

/* Initial pose of a robot in the world frame. */
static const lh_pose2 home = {0.0f, 0.0f, 0.5f * LH_PI};

lh_path_config lh_path_config_default(void) {
    return (lh_path_config){.kind = LH_PATH_ROLLING};
}

static bool waypoints_are_valid(const lh_path_config *config) {
    bool good = config->num_waypoints >= 1 && config->num_waypoints <= LH_MAX_WAYPOINTS;
    for (int32_t i = 0; good && i < config->num_waypoints; i++) {
        good = lh_within(config->waypoint[i].x, -LH_WAYPOINT_MAX, LH_WAYPOINT_MAX) &&
               lh_within(config->waypoint[i].y, -LH_WAYPOINT_MAX, LH_WAYPOINT_MAX);
    }
    return good;
}

lh_error lh_path_config_validate(const lh_path_config *config) {
    switch (config->kind) {
        case LH_PATH_ROLLING:
        case LH_PATH_AHEAD:
            return LH_OK;
        case LH_PATH_WAYPOINTS:
            return waypoints_are_valid(config) ? LH_OK : LH_ERROR_PATH;
    }
    return LH_ERROR_PATH;
}

static float distance_between(const lh_pose2 *pose, float x, float y) {
    float dx = x - pose->x;
    float dy = y - pose->y;
    return lh_sqrt(dx * dx + dy * dy);
}

/* From the beginning of the leg, which is known, to the next waypoint. One at the same place has no direction: that of
 * before is kept, and the waypoint is passed at once. */
static void head_for_next(lh_path *path, const lh_path_config *config) {
    float x = config->waypoint[path->next].x - path->leg.x;
    float y = config->waypoint[path->next].y - path->leg.y;
    path->length = lh_sqrt(x * x + y * y);
    if (path->length > 0.0f) {
        path->leg.heading = lh_atan2(y, x);
    }
}

void lh_path_begin(lh_path *path, const lh_path_config *config, const lh_pose2 *pose) {
    *path = (lh_path){.leg = *pose, .length = FLT_MAX};
    if (config->kind == LH_PATH_WAYPOINTS) {
        head_for_next(path, config);
    }
}

static void take_next_leg(lh_path *path, const lh_path_config *config) {
    path->leg.x = config->waypoint[path->next].x;
    path->leg.y = config->waypoint[path->next].y;
    path->next++;
    head_for_next(path, config);
}

static bool has_next_leg(const lh_path *path, const lh_path_config *config) {
    return config->kind == LH_PATH_WAYPOINTS && path->next < config->num_waypoints - 1;
}

static bool leg_is_over(const lh_path *path, const lh_pose2 *pose) {
    return lh_line_along(&path->leg, pose) >= path->length;
}

void lh_path_advance(lh_path *path, const lh_path_config *config, const lh_pose2 *pose) {
    while (has_next_leg(path, config) && leg_is_over(path, pose)) {
        take_next_leg(path, config);
    }
}

/* From `pose` to the nearest point of the leg, in full length at either end: equal there for the two legs that meet. */
static float distance_to_leg(const lh_path *path, const lh_path_config *config, const lh_pose2 *pose) {
    if (leg_is_over(path, pose)) {
        return lh_path_waypoint_distance(path, config, pose);
    }
    if (lh_line_along(&path->leg, pose) <= 0.0f) {
        return distance_between(pose, path->leg.x, path->leg.y);
    }
    return lh_magnitude(lh_line_lateral(&path->leg, pose));
}

void lh_path_resume(lh_path *path, const lh_path_config *config, const lh_pose2 *pose) {
    lh_path_begin(path, config, config->kind == LH_PATH_ROLLING ? pose : &home);
    float least = distance_to_leg(path, config, pose);
    lh_path leg = *path;
    while (has_next_leg(&leg, config)) {
        take_next_leg(&leg, config);
        float distance = distance_to_leg(&leg, config, pose);
        if (distance <= least) {
            *path = leg;
            least = distance;
        }
    }
    lh_path_advance(path, config, pose);
    if (lh_path_over(path, config, pose)) {
        lh_path_begin(path, config, pose);
    }
}

bool lh_path_over(const lh_path *path, const lh_path_config *config, const lh_pose2 *pose) {
    return config->kind == LH_PATH_WAYPOINTS && path->next == config->num_waypoints - 1 && leg_is_over(path, pose);
}

float lh_path_goal(const lh_path *path, const lh_pose2 *pose, float distance) {
    float goal = lh_line_along(&path->leg, pose) + distance;
    return goal < path->length ? goal : path->length;
}

float lh_path_waypoint_distance(const lh_path *path, const lh_path_config *config, const lh_pose2 *pose) {
    if (config->kind != LH_PATH_WAYPOINTS) {
        return 0.0f;
    }
    return distance_between(pose, config->waypoint[path->next].x, config->waypoint[path->next].y);
}

float lh_line_along(const lh_pose2 *line, const lh_pose2 *pose) {
    return lh_cos(line->heading) * (pose->x - line->x) + lh_sin(line->heading) * (pose->y - line->y);
}

float lh_line_lateral(const lh_pose2 *line, const lh_pose2 *pose) {
    return lh_cos(line->heading) * (pose->y - line->y) - lh_sin(line->heading) * (pose->x - line->x);
}
