#include "limphome/controller.h"

#include <string.h>

#include "limphome/task/action.h"
#include "limphome/base/elementary.h"

#define LARGEST_EPISODE 1000000000 /* where counting stops */

/* What a state tells, beside the inputs. */
typedef struct situation {
    lh_pose2 pose;
    float tilt;   /* [rad] */
    float margin; /* S_NE of (11) [m] */
} situation;

lh_config lh_config_default(void) {
    return (lh_config){
        .seed = 1,
        .learn = true,
        .greedy = false,
        .crawler_speed = 0.3f,
        .joint_speed = 0.3f,
        .temperature_floor = 0.01f,
        .support_tolerance = 0.03f,
        .learner = lh_learner_config_default(),
        .reward = lh_reward_config_default(),
        .episode = lh_episode_config_default(),
    };
}

lh_error lh_config_validate(const lh_config *config) {
    if (!lh_within(config->crawler_speed, LH_SPEED_MIN, LH_SPEED_MAX) ||
        !lh_within(config->joint_speed, LH_SPEED_MIN, LH_SPEED_MAX)) {
        return LH_ERROR_SPEED;
    }
    if (!lh_within(config->temperature_floor, LH_TEMPERATURE_FLOOR_MIN, LH_TEMPERATURE_FLOOR_MAX) ||
        !lh_within(config->support_tolerance, LH_SUPPORT_TOLERANCE_MIN, LH_SUPPORT_TOLERANCE_MAX)) {
        return LH_ERROR_LIMIT;
    }
    lh_error error = lh_learner_config_validate(&config->learner);
    if (error == LH_OK) {
        error = lh_reward_config_validate(&config->reward);
    }
    if (error == LH_OK) {
        error = lh_episode_config_validate(&config->episode);
    }
    return error;
}

static lh_error validate_controlled(const lh_controlled *controlled, const lh_robot *robot) {
    if (controlled->count < 1 || controlled->count > robot->num_actuators ||
        lh_action_count(controlled->count) > LH_MAX_ACTIONS) {
        return LH_ERROR_ACTUATORS;
    }
    int32_t previous = -1;
    for (int32_t k = 0; k < controlled->count; ++k) {
        if (controlled->index[k] <= previous || controlled->index[k] >= robot->num_actuators) {
            return LH_ERROR_ACTUATORS;
        }
        previous = controlled->index[k];
    }
    return LH_OK;
}

lh_error lh_controller_init(lh_controller *controller, const lh_config *config, const lh_robot *robot,
                            const lh_controlled *controlled) {
    lh_error error = lh_robot_validate(robot);
    if (error == LH_OK) {
        error = validate_controlled(controlled, robot);
    }
    if (error != LH_OK) {
        return error;
    }
    int32_t num_states = controlled->count + 2;
    lh_config complete = *config;
    complete.learner.network.inputs = num_states + controlled->count;
    error = lh_config_validate(&complete);
    if (error != LH_OK) {
        return error;
    }
    memset(controller, 0, sizeof *controller); /* not by a literal, which would lie on the stack */
    controller->config = complete;
    controller->robot = *robot;
    controller->controlled = *controlled;
    controller->episode.number = 1;
    return lh_learner_init(&controller->learner, &complete.learner, num_states, controlled->count, complete.seed);
}

lh_error lh_controller_restore(lh_controller *controller, const lh_network *network, const uint32_t random_state[4],
                               int32_t episode) {
    if (episode < 1 || episode > LARGEST_EPISODE) {
        return LH_ERROR_EPISODE;
    }
    lh_error error = lh_network_validate(network, &controller->config.learner.network);
    if (error != LH_OK) {
        return error;
    }
    error = lh_random_restore(&controller->learner.random, random_state);
    if (error != LH_OK) {
        return error;
    }
    controller->learner.network = *network;
    controller->episode.number = episode;
    lh_controller_begin(controller);
    return LH_OK;
}

void lh_controller_begin(lh_controller *controller) {
    controller->acting = false;
}

static situation assess(const lh_controller *controller, const lh_state *state) {
    lh_quat attitude = lh_quat_normalise(state->orientation);
    lh_posture posture;
    lh_kinematics_posture(&controller->robot, attitude, state->actuator_position, controller->config.support_tolerance,
                          &posture);
    //@ split posture.num_carrying; // for Frama-C: so many are set
    lh_vec3 carrying[LH_MAX_SUPPORTS];
    for (int32_t i = 0; i < posture.num_carrying; ++i) {
        carrying[i] = posture.supports[posture.carrying[i]];
    }
    return (situation){
        .pose = {state->position[0], state->position[1], lh_quat_heading(attitude)},
        .tilt = lh_quat_tilt(attitude),
        .margin = lh_stability_margin(carrying, posture.num_carrying, posture.centre_of_mass),
    };
}

static float temperature_of(const lh_controller *controller) {
    float temperature = controller->config.temperature_floor;
    lh_boltzmann_temperature(controller->episode.number, controller->config.temperature_floor, &temperature);
    return temperature;
}

/* Rewards (8), (9), (12) and the penalty for tumbling, of the step that led here. */
static lh_reward rewards_of_step(const lh_controller *controller, const situation *now, lh_outcome outcome) {
    const lh_reward_config *config = &controller->config.reward;
    const lh_episode *episode = &controller->episode;
    lh_reward reward = {
        .motion = lh_reward_motion(config, &controller->pose, &now->pose, episode->start.heading),
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

/* The target of (1) is taken from the network as it is before it learns. The time limit is no property of the task,
 * so it does not end the bootstrap. */
static void learn_from_step(lh_controller *controller, const float *states, lh_outcome outcome, lh_decision *decision) {
    bool terminal = outcome == LH_OUTCOME_GOAL || outcome == LH_OUTCOME_TUMBLE;
    float next_q_max = terminal ? 0.0f : lh_learner_evaluate(&controller->learner, states);
    decision->td_error = lh_learner_learn(&controller->learner, controller->inputs, controller->action,
                                          lh_reward_total(&decision->reward), next_q_max, terminal);
    decision->learned = true;
}

static void add_reward(lh_reward *total, const lh_reward *reward) {
    total->motion += reward->motion;
    total->goal += reward->goal;
    total->stability += reward->stability;
    total->tumble += reward->tumble;
}

static lh_summary summarise(const lh_controller *controller, const lh_pose2 *end, lh_outcome outcome) {
    const lh_episode *episode = &controller->episode;
    return (lh_summary){
        .number = episode->number,
        .outcome = outcome,
        .steps = episode->steps,
        .total = episode->total,
        .lateral_error = lh_episode_lateral(episode, end),
        .heading_change = lh_wrap_angle(end->heading - episode->start.heading),
        .temperature = temperature_of(controller),
        .start = episode->start,
        .goal_distance = controller->config.episode.goal_distance,
    };
}

/* The action under way has led to `now`: reward, learn, sum up. Returns how that ends the episode, if it does. */
static lh_outcome finish_step(lh_controller *controller, const situation *now, lh_decision *decision) {
    lh_episode *episode = &controller->episode;
    ++episode->steps;
    lh_outcome outcome = lh_episode_outcome(episode, &controller->config.episode, &now->pose, now->tilt);
    decision->stepped = true;
    decision->reward = rewards_of_step(controller, now, outcome);
    controller->clamped.margins += now->margin < LH_LEAST_MARGIN;
    add_reward(&episode->total, &decision->reward);
    if (controller->config.learn) {
        learn_from_step(controller, decision->inputs, outcome, decision);
    }
    if (outcome != LH_OUTCOME_NONE) {
        decision->ended = true;
        decision->summary = summarise(controller, &now->pose, outcome);
    }
    return outcome;
}

static void describe(const lh_controller *controller, const situation *now, lh_decision *decision) {
    const lh_episode *episode = &controller->episode;
    decision->episode = episode->number;
    decision->step = episode->steps;
    decision->stability_margin = now->margin;
    decision->goal_distance = lh_episode_distance(episode, &controller->config.episode, &now->pose);
    decision->lateral_error = lh_episode_lateral(episode, &now->pose);
    decision->num_inputs = controller->controlled.count + 2;
}

/* Evaluates anew, as the network may have learned since the target was taken. */
static void choose(lh_controller *controller, const situation *now, lh_decision *decision) {
    const lh_controlled *controlled = &controller->controlled;
    decision->temperature = temperature_of(controller);
    controller->clamped.temperatures += decision->temperature == controller->config.temperature_floor;
    lh_learner_evaluate(&controller->learner, decision->inputs);
    decision->choice = lh_learner_choose(&controller->learner, decision->temperature, controller->config.greedy);

    for (int32_t i = 0; i < decision->num_inputs; ++i) {
        controller->inputs[i] = decision->inputs[i];
    }
    controller->action = decision->choice.action;
    controller->pose = now->pose;
    controller->acting = true;

    int8_t levels[LH_MAX_ACTUATORS];
    lh_action_levels(decision->choice.action, controlled->count, levels);
    for (int32_t k = 0; k < controlled->count; ++k) {
        int32_t index = controlled->index[k];
        bool is_joint = controller->robot.actuators[index].kind == LH_JOINT;
        float speed = is_joint ? controller->config.joint_speed : controller->config.crawler_speed;
        decision->velocity[index] = lh_action_velocity(levels[k], speed);
        decision->inputs[decision->num_inputs++] = lh_action_input(levels[k]);
    }
}

static int32_t number_after(const lh_episode *episode) {
    return episode->number < LARGEST_EPISODE ? episode->number + 1 : LARGEST_EPISODE;
}

lh_error lh_controller_step(lh_controller *controller, const lh_state *state, lh_decision *decision) {
    lh_error error = lh_state_validate(state, &controller->robot);
    if (error != LH_OK) {
        return error;
    }
    *decision = (lh_decision){.stepped = false};
    situation now = assess(controller, state);
    controller->clamped.inputs +=
        (uint64_t)lh_observation(&controller->robot, &controller->controlled, state, decision->inputs);

    lh_episode *episode = &controller->episode;
    lh_outcome outcome = LH_OUTCOME_NONE;
    if (controller->acting) {
        outcome = finish_step(controller, &now, decision);
    } else {
        lh_episode_begin(episode, episode->number, &now.pose);
    }
    if (outcome != LH_OUTCOME_NONE) {
        bool tumbled = outcome == LH_OUTCOME_TUMBLE;
        decision->reset = tumbled || episode->number % controller->config.episode.reset_every == 0;
    }
    if (decision->reset) {
        describe(controller, &now, decision);
        lh_episode_begin(episode, number_after(episode), &now.pose); /* once more when the robot is in its pose */
        controller->acting = false;
        return LH_OK;
    }
    if (outcome != LH_OUTCOME_NONE) {
        lh_episode_begin(episode, number_after(episode), &now.pose);
    }
    describe(controller, &now, decision);
    choose(controller, &now, decision);
    return LH_OK;
}
