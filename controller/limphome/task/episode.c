#include "limphome/task/episode.h"

#include "limphome/base/elementary.h"

lh_episode_config lh_episode_config_default(void) {
    return (lh_episode_config){
        .goal_distance = 2.0f,
        .step_limit = 2000,
        .tumble_tilt = LH_PI / 3.0f,
        .reset_every = 50,
    };
}

lh_error lh_episode_config_validate(const lh_episode_config *config) {
    bool good = lh_within(config->goal_distance, LH_GOAL_DISTANCE_MIN, LH_GOAL_DISTANCE_MAX) &&
                config->step_limit >= 1 && config->step_limit <= LH_STEP_LIMIT_MAX &&
                lh_within(config->tumble_tilt, LH_TUMBLE_TILT_MIN, LH_TUMBLE_TILT_MAX) && config->reset_every >= 1 &&
                config->reset_every <= LH_RESET_EVERY_MAX;
    return good ? LH_OK : LH_ERROR_EPISODE;
}

void lh_episode_begin(lh_episode *episode, int32_t number, const lh_pose2 *start) {
    *episode = (lh_episode){.number = number, .start = *start};
}

float lh_episode_distance(const lh_episode *episode, const lh_episode_config *config, const lh_pose2 *pose) {
    const lh_pose2 *start = &episode->start;
    float along = lh_cos(start->heading) * (pose->x - start->x) + lh_sin(start->heading) * (pose->y - start->y);
    return config->goal_distance - along;
}

float lh_episode_lateral(const lh_episode *episode, const lh_pose2 *pose) {
    const lh_pose2 *start = &episode->start;
    return lh_cos(start->heading) * (pose->y - start->y) - lh_sin(start->heading) * (pose->x - start->x);
}

lh_outcome lh_episode_outcome(const lh_episode *episode, const lh_episode_config *config, const lh_pose2 *pose,
                              float tilt) {
    if (tilt > config->tumble_tilt) {
        return LH_OUTCOME_TUMBLE;
    }
    if (lh_episode_distance(episode, config, pose) <= 0.0f) {
        return LH_OUTCOME_GOAL;
    }
    return episode->steps >= config->step_limit ? LH_OUTCOME_TIMEOUT : LH_OUTCOME_NONE;
}
