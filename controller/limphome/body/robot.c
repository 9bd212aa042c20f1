#include "limphome/body/robot.h"

#include "limphome/base/elementary.h"

#define PAPERS_ROBOT 0.625f /* what is farthest from its middle of that on which it stands [m] */

static bool is_good_actuator(const lh_actuator *actuator) {
    bool is_joint = actuator->kind == LH_JOINT;
    bool good_range = lh_within(actuator->low, -LH_ANGLE_LIMIT, LH_ANGLE_LIMIT) &&
                      lh_within(actuator->high, -LH_ANGLE_LIMIT, LH_ANGLE_LIMIT) && actuator->low < actuator->high;
    return (is_joint ? good_range : actuator->kind == LH_CRAWLER) && actuator->effort_limit > 0.0f &&
           actuator->effort_limit <= LH_EFFORT_LIMIT;
}

static bool is_good_point(lh_vec3 v) {
    return lh_within(v.x, -LH_LENGTH_LIMIT, LH_LENGTH_LIMIT) && lh_within(v.y, -LH_LENGTH_LIMIT, LH_LENGTH_LIMIT) &&
           lh_within(v.z, -LH_LENGTH_LIMIT, LH_LENGTH_LIMIT);
}

static bool is_unit(float square) {
    return lh_within(square, 0.999f, 1.001f);
}

/* The joint and the parent of link `index`. */
static bool is_good_joint(const lh_robot *robot, int32_t index) {
    const lh_link *link = &robot->links[index];
    if (index == 0) {
        return link->parent == -1 && link->actuator == -1;
    }
    if (link->parent < 0 || link->parent >= index || !is_good_point(link->origin)) {
        return false;
    }
    const lh_quat *q = &link->rotation;
    if (!is_unit(q->w * q->w + q->x * q->x + q->y * q->y + q->z * q->z)) {
        return false;
    }
    return link->actuator == -1 ||
           (link->actuator >= 0 && link->actuator < robot->num_actuators &&
            robot->actuators[link->actuator].kind == LH_JOINT && is_unit(lh_vec3_dot(link->axis, link->axis)));
}

static bool is_good_support(const lh_robot *robot, const lh_support *support) {
    return support->link >= 0 && support->link < robot->num_links && is_good_point(support->point) &&
           lh_within(support->radius, 0.0f, LH_LENGTH_LIMIT);
}

static lh_error validate_actuators(const lh_robot *robot) {
    if (robot->num_actuators < 1 || robot->num_actuators > LH_MAX_ACTUATORS) {
        return LH_ERROR_ACTUATORS;
    }
    for (int32_t k = 0; k < robot->num_actuators; k++) {
        bool after_joint = k > 0 && robot->actuators[k - 1].kind == LH_JOINT;
        if (!is_good_actuator(&robot->actuators[k]) || (after_joint && robot->actuators[k].kind == LH_CRAWLER)) {
            return LH_ERROR_ACTUATORS;
        }
    }
    return LH_OK;
}

lh_error lh_robot_validate(const lh_robot *robot) {
    lh_error error = validate_actuators(robot);
    if (error != LH_OK) {
        return error;
    }
    if (robot->num_links < 1 || robot->num_links > LH_MAX_LINKS || robot->num_supports < 3 ||
        robot->num_supports > LH_MAX_SUPPORTS) {
        return LH_ERROR_ROBOT;
    }
    float mass = 0.0f;
    for (int32_t i = 0; i < robot->num_links; i++) {
        const lh_link *link = &robot->links[i];
        if (!is_good_joint(robot, i) || !lh_within(link->mass, 0.0f, LH_MASS_LIMIT) || !is_good_point(link->centre)) {
            return LH_ERROR_ROBOT;
        }
        mass += link->mass;
    }
    for (int32_t i = 0; i < robot->num_supports; i++) {
        if (!is_good_support(robot, &robot->supports[i])) {
            return LH_ERROR_ROBOT;
        }
    }
    return mass >= LH_LEAST_MASS ? LH_OK : LH_ERROR_ROBOT;
}

float lh_robot_scale(const lh_robot *robot) {
    float farthest = 0.0f;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        if (robot->supports[i].link == 0) {
            float x = lh_magnitude(robot->supports[i].point.x);
            float y = lh_magnitude(robot->supports[i].point.y);
            farthest = x > farthest ? x : farthest;
            farthest = y > farthest ? y : farthest;
        }
    }
    return lh_clip(farthest / PAPERS_ROBOT, LH_SCALE_MIN, LH_SCALE_MAX);
}
