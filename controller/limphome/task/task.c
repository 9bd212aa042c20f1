#include "limphome/task/task.h"

#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/body/kinematics.h"
#include "limphome/body/stability.h"
#include "limphome/body/stance.h"
#include "limphome/task/action.h"

/* What a state tells, beside the inputs. */
typedef struct situation {
    lh_pose2 pose;
    float tilt;   /* [rad] */
    float margin; /* S_NE of (11) [m] */
} situation;

lh_task_config lh_task_config_default(void) {
    return (lh_task_config){
        .crawler_speed = 0.3f,
        .joint_speed = 0.3f,
        .reward = lh_reward_config_default(),
        .episode = lh_episode_config_default(),
        .path = lh_path_config_default(),
    };
}

lh_error lh_task_config_validate(const lh_task_config *config) {
    if (!lh_within(config->crawler_speed, LH_SPEED_MIN, LH_SPEED_MAX) ||
        !lh_within(config->joint_speed, LH_SPEED_MIN, LH_SPEED_MAX)) {
        return LH_ERROR_SPEED;
    }
    lh_error error = lh_reward_config_validate(&config->reward);
    if (error == LH_OK) {
        error = lh_episode_config_validate(&config->episode);
    }
    return error == LH_OK ? lh_path_config_validate(&config->path) : error;
}

static lh_error validate_controlled(const lh_controlled *controlled, const lh_robot *robot) {
    if (controlled->count < 1 || controlled->count > robot->num_actuators ||
        lh_action_count(controlled->count) > LH_MAX_ACTIONS) {
        return LH_ERROR_ACTUATORS;
    }
    int32_t previous = -1;
    for (int32_t k = 0; k < controlled->count; k++) {
        if (controlled->index[k] <= previous || controlled->index[k] >= robot->num_actuators) {
            return LH_ERROR_ACTUATORS;
        }
        previous = controlled->index[k];
    }
    return LH_OK;
}

lh_error lh_task_init(lh_task *task, const lh_task_config *config, const lh_robot *robot,
                      const lh_controlled *controlled) {
    lh_error error = lh_robot_validate(robot);
    if (error == LH_OK) {
        error = validate_controlled(controlled, robot);
    }
    if (error == LH_OK) {
        error = lh_task_config_validate(config);
    }
    if (error != LH_OK) {
        return error;
    }
    memset(task, 0, sizeof *task); /* not by a literal, which would lie on the stack */
    task->config = *config;
    task->robot = *robot;
    task->controlled = *controlled;
    task->episode.number = 1;
    return LH_OK;
}

void lh_task_begin(lh_task *task, int32_t episode) {
    task->episode.number = episode;
    task->acting = false;
    task->gap = false;
    task->resuming = false;
}

void lh_task_resume(lh_task *task, int32_t episode) {
    lh_task_begin(task, episode);
    task->resuming = true;
}

void lh_task_gap(lh_task *task) {
    task->gap = true;
}

static situation assess(const lh_task *task, const lh_state *state, lh_quat attitude) {
    lh_posture posture;
    lh_kinematics_posture(&task->robot, attitude, state->actuator_position, &posture);
    lh_stance stance;
    lh_stance_find(&task->robot, &posture, &stance);
    situation now = {
        .pose = {state->position[0], state->position[1], lh_quat_heading(attitude)},
        .tilt = lh_quat_tilt(attitude),
    };
    //@ split stance.count; // for Frama-C: so many are set
    now.margin = lh_stability_margin(stance.points, stance.count, posture.centre_of_mass);
    return now;
}

/* Rewards (8), (9), (12) and the penalty for tumbling, of the step that led here. */
static lh_reward rewards_of_step(const lh_task *task, const situation *now, lh_outcome outcome) {
    const lh_reward_config *config = &task->config.reward;
    const lh_episode *episode = &task->episode;
    lh_reward reward = {
        .motion = lh_reward_motion(config, &task->pose, &now->pose, episode->line.heading),
        .stability = lh_reward_stability(config, now->margin),
    };
    if (outcome == LH_OUTCOME_GOAL) {
        reward.goal = lh_reward_goal(config, lh_episode_lateral(episode, &now->pose));
    }
    if (outcome == LH_OUTCOME_TUMBLE) {
        reward.tumble = config->tumble;
    }
    return reward;
}

static void add_reward(lh_reward *total, const lh_reward *reward) {
    total->motion += reward->motion;
    total->goal += reward->goal;
    total->stability += reward->stability;
    total->tumble += reward->tumble;
}

static lh_summary summarise(const lh_task *task, const lh_pose2 *end, lh_outcome outcome) {
    const lh_episode *episode = &task->episode;
    return (lh_summary){
        .number = episode->number,
        .outcome = outcome,
        .steps = episode->steps,
        .total = episode->total,
        .lateral_error = lh_episode_lateral(episode, end),
        .heading_change = lh_wrap_angle(end->heading - episode->start.heading),
        .start = episode->start,
        .line_heading = episode->line.heading,
        .start_lateral_error = lh_episode_lateral(episode, &episode->start),
        .goal_distance = lh_episode_distance(episode, &episode->start),
        .waypoint_distance = lh_path_waypoint_distance(&task->path, &task->config.path, end),
        .arrived = outcome == LH_OUTCOME_GOAL && lh_path_over(&task->path, &task->config.path, end),
    };
}

/* The action under way has led to `now`, or there was a gap: how the episode ends, if it does, and its reward. */
static lh_outcome finish_step(lh_task *task, const situation *now, lh_observed *observed) {
    lh_episode *episode = &task->episode;
    episode->steps++;
    lh_outcome outcome = lh_episode_outcome(episode, &task->config.episode, &now->pose, now->tilt);
    observed->outcome = outcome;
    if (!task->gap) {
        observed->stepped = true;
        observed->reward = rewards_of_step(task, now, outcome);
        task->clamped.margins += now->margin < LH_LEAST_MARGIN;
        add_reward(&episode->total, &observed->reward);
    }
    if (outcome != LH_OUTCOME_NONE) {
        observed->summary = summarise(task, &now->pose, outcome);
    }
    return outcome;
}

static void describe(const lh_task *task, const situation *now, lh_observed *observed) {
    const lh_episode *episode = &task->episode;
    observed->episode = episode->number;
    observed->step = episode->steps;
    observed->pose = now->pose;
    observed->stability_margin = now->margin;
    observed->goal_distance = lh_episode_distance(episode, &now->pose);
    observed->lateral_error = lh_episode_lateral(episode, &now->pose);
    observed->heading_error = lh_wrap_angle(now->pose.heading - episode->line.heading);
    observed->waypoint_distance = lh_path_waypoint_distance(&task->path, &task->config.path, &now->pose);
}

static int32_t number_after(const lh_episode *episode) {
    return episode->number < LH_LAST_EPISODE ? episode->number + 1 : LH_LAST_EPISODE;
}

/* The next episode begins at `pose`, on the path's leg there. */
static void begin_episode(lh_task *task, int32_t number, const lh_pose2 *pose) {
    const lh_path_config *config = &task->config.path;
    lh_path *path = &task->path;
    if (task->resuming) {
        lh_path_resume(path, config, pose);
    } else if (!task->acting || config->kind == LH_PATH_ROLLING) {
        lh_path_begin(path, config, pose);
    }
    lh_path_advance(path, config, pose);
    lh_episode_begin(&task->episode, number, pose, &path->leg,
                     lh_path_goal(path, pose, task->config.episode.goal_distance));
}

lh_error lh_task_observe(lh_task *task, const lh_state *state, lh_observed *observed) {
    lh_error error = lh_state_validate(state, &task->robot);
    if (error != LH_OK) {
        return error;
    }
    *observed = (lh_observed){.num_inputs = task->controlled.count + 2};
    lh_quat attitude = lh_quat_normalise(state->orientation);
    observed->attitude = attitude;
    memcpy(observed->joint_angle, state->actuator_position, sizeof observed->joint_angle);
    situation now = assess(task, state, attitude);
    task->clamped.inputs +=
        (uint64_t)lh_observation(&task->robot, &task->controlled, state, attitude, observed->inputs);

    lh_episode *episode = &task->episode;
    lh_outcome outcome = LH_OUTCOME_NONE;
    if (task->acting) {
        outcome = finish_step(task, &now, observed);
    } else {
        begin_episode(task, episode->number, &now.pose);
    }
    task->gap = false;
    task->resuming = false;
    if (outcome != LH_OUTCOME_NONE) {
        observed->reset = outcome == LH_OUTCOME_TUMBLE || observed->summary.arrived ||
                          episode->number % task->config.episode.reset_every == 0;
    }
    if (observed->reset) {
        describe(task, &now, observed);
        task->acting = false;
        begin_episode(task, number_after(episode), &now.pose); /* once more when the robot is in its pose */
        return LH_OK;
    }
    if (outcome != LH_OUTCOME_NONE) {
        begin_episode(task, number_after(episode), &now.pose);
    }
    describe(task, &now, observed);
    task->pose = now.pose;
    task->acting = true;
    return LH_OK;
}

void lh_task_velocities(const lh_task *task, int32_t action, float *velocity) {
    int8_t levels[LH_MAX_ACTUATORS];
    lh_action_levels(action, task->controlled.count, levels);
    for (int32_t k = 0; k < task->controlled.count; k++) {
        int32_t index = task->controlled.index[k];
        bool is_joint = task->robot.actuators[index].kind == LH_JOINT;
        float speed = is_joint ? task->config.joint_speed : task->config.crawler_speed;
        velocity[index] = lh_action_velocity(levels[k], speed);
    }
}
