/* Takes decisions with a simple robot that moves as it is told, learning all the while, and prints for each kind of
 * learner a hash of every decision and of what was learned. Builds of the library with other flags or capacities
 * must print the same. Usage: decisions [OF_Q_LEARNING OF_A_PLANNER], how many; 0: that learner is left out. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "crawler.h"
#include "limphome/controller.h"

#define PERIOD 0.5f

static lh_controller controller;

/* FNV-1a. */
static uint64_t hash(uint64_t so_far, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) {
        so_far = (so_far ^ bytes[i]) * 1099511628211u;
    }
    return so_far;
}

/* What is in use of it, so that capacities do not matter. */
static uint64_t hash_network(uint64_t so_far, const lh_network *network) {
    const size_t size = (size_t)network->units * sizeof(float);
    so_far = hash(so_far, network->weight, size);
    so_far = hash(so_far, network->width, size);
    for (int32_t i = 0; i < network->inputs; i++) {
        so_far = hash(so_far, network->centre[i], size);
    }
    return so_far;
}

/* Joints turn as told within their range; the robot drives ahead and veers to the failed crawler's side, less so the
 * more its arm bears on the ground. */
static void move(lh_state *state, const lh_robot *robot, const lh_decision *decision, lh_random *random) {
    for (int32_t k = 2; k < robot->num_actuators; k++) {
        const lh_actuator *joint = &robot->actuators[k];
        float angle = state->actuator_position[k] + PERIOD * decision->velocity[k];
        angle = angle < joint->low ? joint->low : angle;
        state->actuator_position[k] = angle > joint->high ? joint->high : angle;
    }
    float advance = PERIOD * decision->velocity[1];
    float heading = lh_quat_heading(state->orientation) + 0.2f * advance * state->actuator_position[3];
    float tilt = 0.2f * (lh_random_uniform(random) - 0.5f);
    state->position[0] += advance * -heading;
    state->position[1] += advance;
    state->orientation = lh_quat_multiply(lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, heading),
                                          lh_quat_about((lh_vec3){1.0f, 0.0f, 0.0f}, tilt));
    state->actuator_effort[1] = 2000.0f * (lh_random_uniform(random) - 0.5f);
}

static uint64_t hash_planner(uint64_t so_far, const lh_planner_learned *learned) {
    const lh_motion_model *model = &learned->model;
    const size_t count = (size_t)model->num_samples;
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        so_far = hash(so_far, model->posture[k], count * sizeof model->posture[k][0]);
    }
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        so_far = hash(so_far, model->motion[k], count * sizeof model->motion[k][0]);
    }
    so_far = hash(so_far, model->action, count * sizeof model->action[0]);
    so_far = hash(so_far, model->updated, count * sizeof model->updated[0]);
    const size_t nodes = (size_t)learned->values.num_nodes;
    so_far = hash(so_far, learned->values.value, nodes * sizeof learned->values.value[0]);
    so_far = hash(so_far, learned->values.cost, nodes * sizeof learned->values.cost[0]);
    return hash(hash(so_far, &learned->ground, sizeof learned->ground), &learned->random, sizeof learned->random);
}

static uint64_t hash_learned(uint64_t so_far) {
    switch (controller.learner.kind) {
        case LH_Q_LEARNING: {
            const lh_q_learning *learner = &controller.learner.as.q_learning;
            return hash(hash_network(so_far, &learner->network), &learner->random, sizeof learner->random);
        }
        case LH_PLANNER:
            return hash_planner(so_far, &controller.learner.as.planner.learned);
    }
    return so_far;
}

/* Takes so many decisions and prints their hash; false if one is refused. */
static bool decide(const char *name, const lh_config *config, int32_t decisions) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    if (lh_controller_init(&controller, config, &robot, &controlled) != LH_OK) {
        return false;
    }
    lh_random random;
    lh_random_init(&random, 2);
    lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
    uint64_t result = 14695981039346656037u;
    for (int32_t k = 0; k < decisions; k++) {
        lh_decision decision;
        if (lh_controller_step(&controller, &state, &decision) != LH_OK) {
            return false;
        }
        const lh_choice *c = &decision.choice;
        const float chosen[] = {c->td_error, c->q, c->q_max, c->probability, c->temperature};
        result = hash(result, &c->action, sizeof c->action);
        result = hash(result, chosen, sizeof chosen);
        result = hash(result, &decision.observed.stability_margin, sizeof decision.observed.stability_margin);
        if (decision.observed.reset) {
            state = crawler_state(0.0f, 0.0f, 0.0f);
        } else {
            move(&state, &robot, &decision, &random);
        }
    }
    result = hash_learned(result);
    printf("%s %016" PRIx64 " after %" PRId32 " episodes\n", name, result, controller.task.episode.number);
    return true;
}

int main(int argc, char **argv) {
    const int32_t of_q_learning = argc == 3 ? atoi(argv[1]) : 10000;
    const int32_t of_planner = argc == 3 ? atoi(argv[2]) : 1000;
    lh_config config = lh_config_default();
    config.learner.q_learning.network.initial_weight = 0.1f;
    config.learner.q_learning.network.exact_gradient = true;
    config.task.episode.goal_distance = 0.5f;
    const bool good = of_q_learning == 0 || decide("q_learning", &config, of_q_learning);
    config.learner.kind = LH_PLANNER;
    config.learner.planner.sweeps = 1;
    config.learner.planner.random_share = 0.1f;
    return good && (of_planner == 0 || decide("planner", &config, of_planner)) ? 0 : 1;
}
