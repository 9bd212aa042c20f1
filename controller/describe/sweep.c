#include "sweep.h"

#include <stdbool.h>

#include "robot_description.h"

#define MOST_POSTURES 20000
#define MOST_STEPS 25 /* of a joint, both ends counted */

static int power(int base, int exponent) {
    int result = 1;
    for (int i = 0; i < exponent; i++) {
        result *= base;
    }
    return result;
}

/* Steps of each of so many joints. */
static int steps_of(int joints) {
    int steps = MOST_STEPS;
    while (steps > 2 && power(steps, joints) > MOST_POSTURES) {
        steps--;
    }
    return steps;
}

/* Counts up with the joints as digits; false after the last posture. */
static bool count_up(const lh_robot *robot, int steps, int *digit) {
    for (int j = ROBOT_CRAWLERS; j < robot->num_actuators; j++) {
        if (++digit[j] < steps) {
            return true;
        }
        digit[j] = 0;
    }
    return false;
}

void sweep(const lh_robot *robot, void (*visit)(void *what, const float *angle), void *what) {
    const int steps = steps_of(robot->num_actuators - ROBOT_CRAWLERS);
    int digit[ROBOT_MAX_ACTUATORS] = {0};
    do {
        float angle[ROBOT_MAX_ACTUATORS] = {0.0f};
        for (int j = ROBOT_CRAWLERS; j < robot->num_actuators; j++) {
            const lh_actuator *a = &robot->actuators[j];
            angle[j] = a->low + (a->high - a->low) * (float)digit[j] / (float)(steps - 1);
        }
        visit(what, angle);
    } while (count_up(robot, steps, digit));
}
