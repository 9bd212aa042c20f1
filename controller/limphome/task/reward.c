#include "limphome/task/reward.h"

#include "limphome/base/elementary.h"

lh_reward_config lh_reward_config_default(void) {
    return (lh_reward_config){
        .forward = 8.0f,
        .sideways = 2.0f,
        .turn = 10.0f,
        .heading_error = false,
        .goal = 10.0f,
        .stability = 1.0f,
        .tumble = -10.0f,
    };
}

lh_error lh_reward_config_validate(const lh_reward_config *config) {
    bool good = lh_within(config->forward, 0.0f, LH_REWARD_MAX) && lh_within(config->sideways, 0.0f, LH_REWARD_MAX) &&
                lh_within(config->turn, 0.0f, LH_REWARD_MAX) && lh_within(config->goal, 0.0f, LH_REWARD_MAX) &&
                lh_within(config->stability, 0.0f, LH_REWARD_MAX) && lh_within(config->tumble, -LH_REWARD_MAX, 0.0f);
    return good ? LH_OK : LH_ERROR_REWARD;
}

float lh_reward_motion(const lh_reward_config *config, const lh_pose2 *before, const lh_pose2 *after, float direction) {
    float px = after->x - before->x;
    float py = after->y - before->y;
    float ex = lh_cos(before->heading);
    float ey = lh_sin(before->heading);
    float d1 = ex * px + ey * py;
    float d2 = ex * py - ey * px;
    float phi = lh_wrap_angle(after->heading - (config->heading_error ? direction : before->heading));
    return config->forward * d1 - config->sideways * lh_magnitude(d2) - config->turn * lh_magnitude(phi);
}

float lh_reward_goal(const lh_reward_config *config, float lateral_error) {
    return config->goal * lh_exp(-lh_magnitude(lateral_error));
}

float lh_reward_stability(const lh_reward_config *config, float margin) {
    return -config->stability * lh_exp(-(margin < LH_LEAST_MARGIN ? LH_LEAST_MARGIN : margin));
}

float lh_reward_total(const lh_reward *reward) {
    return reward->motion + reward->goal + reward->stability + reward->tumble;
}
