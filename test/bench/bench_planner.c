/* Times one decision of the planner in several ways, interleaved, and prints a line for each as bench_decision.c does:
 * name, median processor time per decision [s], share of the decisions that took the action the library takes. */
#include <stdio.h>
#include <stdlib.h>

#include "crawler.h"
#include "planner.h"
#include "timing.h"

enum { ROUNDS = 5, WARMING_UP = 3000 };

#define PERIOD 0.5f

static lh_planner planner;
static const course_of_decisions *given;

static void begin(const course_of_decisions *course) {
    given = course;
    planner = course->planner;
}

static int32_t decide(int32_t k) {
    lh_choice choice;
    lh_planner_step(&planner, &given->observed[k], true, false, &choice);
    return planner.action;
}

static const planner_method library_method = {begin, decide};

/* Joints turn as told; the robot drives ahead and veers to its failed crawler's side, less so the more its arm bears on
 * the ground. */
static void move(lh_state *state, const lh_robot *robot, const float *velocity) {
    for (int32_t k = 2; k < robot->num_actuators; k++) {
        const float angle = state->actuator_position[k] + PERIOD * velocity[k];
        const lh_actuator *joint = &robot->actuators[k];
        state->actuator_position[k] = angle < joint->low ? joint->low : angle > joint->high ? joint->high : angle;
    }
    const float advance = PERIOD * velocity[1];
    const float heading = lh_quat_heading(state->orientation) + 0.2f * advance * state->actuator_position[3];
    state->position[0] += advance * -heading;
    state->position[1] += advance;
    state->orientation = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, heading);
}

static lh_controller controller;

static void step(lh_state *state, const lh_robot *robot, lh_decision *decision) {
    if (lh_controller_step(&controller, state, decision) != LH_OK || decision->observed.reset) {
        abort();
    }
    move(state, robot, decision->velocity);
}

/* Lets a planner measure for long, and then keeps what it sees. */
static void record(course_of_decisions *course) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_config config = lh_config_default();
    config.learner.kind = LH_PLANNER;
    config.learner.planner.random_share = 0.2f;
    config.task.episode.goal_distance = 100.0f;
    config.task.episode.step_limit = LH_STEP_LIMIT_MAX;
    config.task.episode.reset_every = LH_RESET_EVERY_MAX;
    if (lh_controller_init(&controller, &config, &robot, &controlled) != LH_OK) {
        abort();
    }
    lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
    lh_decision decision;
    for (int32_t k = 0; k < WARMING_UP; k++) {
        step(&state, &robot, &decision);
    }
    lh_planner *learner = &controller.learner.as.planner;
    learner->config.random_share = 0.0f;
    learner->stalled = 0;
    course->planner = *learner;
    for (int32_t k = 0; k < OBSERVATIONS; k++) {
        step(&state, &robot, &decision);
        course->observed[k] = decision.observed;
        course->observed[k].goal_distance = 100.0f - (float)k; /* so that chance never decides */
    }
    begin(course);
    for (int32_t k = 0; k < OBSERVATIONS; k++) {
        course->executed[k] = decide(k);
    }
}

static int32_t actions[OBSERVATIONS];

static double seconds_per_decision(const planner_method *m, const course_of_decisions *course) {
    m->begin(course);
    const double start = timing_now(CLOCK_PROCESS_CPUTIME_ID);
    for (int32_t k = 0; k < OBSERVATIONS; k++) {
        actions[k] = m->decide(k);
    }
    return (timing_now(CLOCK_PROCESS_CPUTIME_ID) - start) / OBSERVATIONS;
}

int main(void) {
    static course_of_decisions course;
    record(&course);
    const struct {
        const char *title;
        const planner_method *method;
    } runs[] = {{"limphome", &library_method},
                {"plain_single", &plain_planner_float_method},
                {"plain_double", &plain_planner_double_method}};
    enum { RUNS = sizeof runs / sizeof *runs };
    static double seconds[RUNS][ROUNDS];
    static int32_t expected[OBSERVATIONS], same[RUNS];
    for (int round = 0; round < ROUNDS; round++) {
        for (int r = 0; r < RUNS; r++) {
            seconds[r][round] = seconds_per_decision(runs[r].method, &course);
            same[r] = 0;
            for (int32_t k = 0; k < OBSERVATIONS; k++) {
                expected[k] = r == 0 ? actions[k] : expected[k];
                same[r] += actions[k] == expected[k];
            }
        }
    }
    for (int r = 0; r < RUNS; r++) {
        printf("%s %.4g %.3f\n", runs[r].title, timing_median(seconds[r], ROUNDS), (double)same[r] / OBSERVATIONS);
    }
    return EXIT_SUCCESS;
}
