/* How the time of a decision grows. Prints a line for each point: curve, x, median processor time per decision [s].
 *   units      of Q-learning, with 81 actions
 *   actions    of Q-learning, with 50 units
 *   samples    of a planner, with the paper's robot: measurements it has kept
 *   postures   of a planner: those for which it plans
 *   sweep      of a planner over x postures, before its first decision
 * Built with larger capacities than the library has by default. */
#include <stdio.h>
#include <stdlib.h>

#include "crawler.h"
#include "limphome/task/action.h"
#include "timing.h"

enum { ROUNDS = 5, DECISIONS = 200 };

#define PERIOD 0.5f

static void print(const char *curve, int32_t x, double *seconds) {
    printf("%s %d %.4g\n", curve, x, timing_median(seconds, ROUNDS));
}

static void need(lh_error error) {
    if (error != LH_OK) {
        fprintf(stderr, "refused: %s\n", lh_error_text(error));
        exit(1);
    }
}

/* --- Q-learning --- */

static double q_learning_seconds(int32_t units, int32_t actuators) {
    static lh_q_learning learner;
    lh_q_learning_config config = lh_q_learning_config_default();
    const int32_t states = actuators + 2;
    config.network.units = units;
    config.network.inputs = states + actuators;
    need(lh_q_learning_init(&learner, &config, states, actuators, 1));
    const float at[LH_MAX_STATE_INPUTS] = {0.5f, 0.3f, 0.7f, 0.4f};
    const int32_t count = 1 + 200000 / (units * lh_action_count(actuators) / 27 + units);
    const double begin = timing_now(CLOCK_PROCESS_CPUTIME_ID);
    for (int32_t k = 0; k < count; k++) {
        const float q_max = lh_q_learning_evaluate(&learner, at);
        lh_choice choice;
        lh_q_learning_choose(&learner, 0.5f, false, &choice);
        lh_q_learning_learn(&learner, at, choice.action, 1.0f, q_max, false);
    }
    return (timing_now(CLOCK_PROCESS_CPUTIME_ID) - begin) / count;
}

static void q_learning(const char *curve, int32_t x, int32_t units, int32_t actuators) {
    double seconds[ROUNDS];
    q_learning_seconds(units, actuators); /* warms up */
    for (int i = 0; i < ROUNDS; i++) {
        seconds[i] = q_learning_seconds(units, actuators);
    }
    print(curve, x, seconds);
}

/* --- planner --- */

static lh_controller controller;
static lh_state state;

static void begin(float joint_range) {
    lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    for (int32_t k = 2; k < robot.num_actuators; k++) {
        robot.actuators[k].low *= joint_range;
        robot.actuators[k].high *= joint_range;
    }
    lh_config config = lh_config_default();
    config.learner.kind = LH_PLANNER;
    config.learner.planner.sweeps = 1;
    config.learner.planner.random_share = 0.5f; /* so that it measures all round */
    config.task.episode.goal_distance = LH_GOAL_DISTANCE_MAX;
    config.task.episode.step_limit = LH_STEP_LIMIT_MAX;
    need(lh_controller_init(&controller, &config, &robot, &controlled));
    state = crawler_state(0.0f, 0.0f, 0.0f);
    state.actuator_position[3] *= joint_range;
    state.actuator_position[4] *= joint_range;
}

/* Joints turn as they are told, and what the robot does is much the same each time. */
static double planner_seconds(int32_t decisions) {
    const lh_robot *robot = &controller.task.robot;
    double spent = 0.0;
    for (int32_t i = 0; i < decisions; i++) {
        lh_decision decision;
        const double start = timing_now(CLOCK_PROCESS_CPUTIME_ID);
        need(lh_controller_step(&controller, &state, &decision));
        spent += timing_now(CLOCK_PROCESS_CPUTIME_ID) - start;
        for (int32_t k = 2; k < robot->num_actuators; k++) {
            const float angle = state.actuator_position[k] + PERIOD * decision.velocity[k];
            const lh_actuator *joint = &robot->actuators[k];
            state.actuator_position[k] = angle < joint->low ? joint->low : angle > joint->high ? joint->high : angle;
        }
        state.position[1] += 0.01f;
    }
    return spent / decisions;
}

static void planner(const char *curve, int32_t x) {
    double seconds[ROUNDS];
    for (int i = 0; i < ROUNDS; i++) {
        seconds[i] = planner_seconds(DECISIONS);
    }
    print(curve, x, seconds);
}

static void over_samples(void) {
    const int32_t steps[] = {0, 240, 480, 960, 1920, 3840};
    begin(1.0f);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        const lh_motion_model *model = &controller.learner.as.planner.learned.model;
        for (int32_t tries = 0; model->num_samples < steps[i] && tries < 400; tries++) {
            planner_seconds(DECISIONS);
        }
        const int32_t reached = model->num_samples;
        planner("samples", reached);
    }
}

static void over_postures(void) {
    const float ranges[] = {0.3f, 0.5f, 0.7f, 1.0f, 1.2f};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const double start = timing_now(CLOCK_PROCESS_CPUTIME_ID);
        begin(ranges[i]);
        double sweep[ROUNDS] = {timing_now(CLOCK_PROCESS_CPUTIME_ID) - start};
        for (int k = 1; k < ROUNDS; k++) {
            sweep[k] = sweep[0];
        }
        const int32_t postures = controller.learner.as.planner.learned.values.num_nodes;
        print("sweep", postures, sweep);
        planner("postures", postures);
    }
}

int main(void) {
    const int32_t units[] = {8, 16, 32, 50, 64, 128, 256};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        q_learning("units", units[i], units[i], 4);
    }
    for (int32_t actuators = 1; actuators <= LH_MAX_ACTUATORS; actuators++) {
        q_learning("actions", lh_action_count(actuators), 50, actuators);
    }
    over_samples();
    over_postures();
    return 0;
}
