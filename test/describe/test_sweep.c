#include "sweep.h"

#include <math.h>

#include "robot_description.h"
#include "suite.h"

struct seen {
    const lh_robot *robot;
    int count;
    float least[ROBOT_MAX_ACTUATORS], most[ROBOT_MAX_ACTUATORS];
};

static void visit(void *what, const float *angle) {
    struct seen *s = what;
    for (int i = 0; i < s->robot->num_actuators; i++) {
        s->least[i] = s->count == 0 ? angle[i] : fminf(s->least[i], angle[i]);
        s->most[i] = s->count == 0 ? angle[i] : fmaxf(s->most[i], angle[i]);
    }
    s->count++;
}

/* So many joints, joint j from -j to 2 j. */
static struct seen sweep_of(int joints, lh_robot *robot) {
    *robot = (lh_robot){.num_actuators = ROBOT_CRAWLERS + joints};
    for (int j = 1; j <= joints; j++) {
        robot->actuators[ROBOT_CRAWLERS + j - 1] = (lh_actuator){LH_JOINT, (float)-j, 2.0f * (float)j, 1.0f};
    }
    struct seen seen = {.robot = robot};
    sweep(robot, visit, &seen);
    return seen;
}

START_TEST(both_ends_of_every_joint_are_visited) {
    lh_robot robot;
    const struct seen seen = sweep_of(_i, &robot);
    for (int i = 0; i < robot.num_actuators; i++) {
        ck_assert_float_eq(seen.least[i], robot.actuators[i].low);
        ck_assert_float_eq(seen.most[i], robot.actuators[i].high);
    }
}
END_TEST

START_TEST(postures_are_thousands_at_most) {
    static const int expected[] = {0, 25, 625, 15625, 14641, 16807, 15625};
    lh_robot robot;
    ck_assert_int_eq(sweep_of(_i, &robot).count, expected[_i]);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("sweep");
    tcase_add_loop_test(cases, both_ends_of_every_joint_are_visited, 1, 7);
    tcase_add_loop_test(cases, postures_are_thousands_at_most, 1, 7);
    return run_suite("sweep", cases);
}
