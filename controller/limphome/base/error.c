#include "limphome/base/error.h"

const char *lh_error_text(lh_error error) {
    switch (error) {
        case LH_OK:
            return "No error";
        case LH_ERROR_UNITS:
            return "The number of basis functions is outside the capacity of the network";
        case LH_ERROR_INPUTS:
            return "The number of inputs is outside the capacity of the network";
        case LH_ERROR_RATE:
            return "A learning rate or the discount rate is out of range";
        case LH_ERROR_INITIAL:
            return "An initial weight or width is out of range";
        case LH_ERROR_LIMIT:
            return "A width floor, weight limit, temperature floor or support tolerance is out of range";
        case LH_ERROR_REWARD:
            return "A reward coefficient is out of range";
        case LH_ERROR_EPISODE:
            return "An episode number or an episode setting is out of range";
        case LH_ERROR_PATH:
            return "The kind of path is unknown, or its waypoints are too many or out of range";
        case LH_ERROR_SPEED:
            return "A speed of the action levels is out of range";
        case LH_ERROR_ACTUATORS:
            return "The actuators, or the choice of those controlled, are inconsistent or beyond the capacity";
        case LH_ERROR_ROBOT:
            return "The links, supports or masses of the robot are inconsistent";
        case LH_ERROR_STATE:
            return "The state of the robot is not finite, out of range or of another size";
        case LH_ERROR_NETWORK:
            return "The network has other dimensions than configured or values out of range";
        case LH_ERROR_RANDOM_STATE:
            return "The state of the random number generator is all zero";
        case LH_ERROR_LEARNER:
            return "The kind of learner is unknown or another than what was saved";
        case LH_ERROR_PLANNER:
            return "A setting of the planner is out of range, or a planner does not fit the robot it is for";
        case LH_ERROR_MONITOR:
            return "A limit or the period of the monitor is out of range";
        case LH_ERROR_COUNT:
            break;
    }
    return "Unknown error";
}
