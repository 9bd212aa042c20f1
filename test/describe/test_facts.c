/* A robot whose facts can be worked out by hand: a base that stands on a rectangle, and a lever about one joint at the
 * height of its centre of mass. */
#include <math.h>
#include <string.h>

#include "facts.h"
#include "suite.h"

#define BASE 90.0          /* [kg] */
#define LEVER 10.0         /* [kg] */
#define AHEAD 0.6          /* supports at +-AHEAD, +-ASIDE [m] */
#define ASIDE 0.4          /* [m] */
#define HEIGHT 0.5         /* of centre of mass and joint [m] */
#define LONG 2.1           /* of the lever, its own centre of mass in its middle [m] */
#define NEAR_THE_EDGE 5e-4 /* where a margin in single precision is 0: of its square [rad] */
#define EFFORT 1000.0      /* [N m] */

/* The lever's joint is at x = `joint_x` and turns about y: positive angles lower it. */
static void make(double joint_x, double effort, robot_description *d, lh_robot *r) {
    memset(d, 0, sizeof *d);
    memset(r, 0, sizeof *r);
    d->num_actuators = r->num_actuators = 3;
    d->num_bodies = r->num_links = 4;
    d->num_supports = r->num_supports = 5;
    d->num_tips = 1;
    d->bodies[0].mass = BASE;
    d->bodies[3].mass = LEVER;
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        d->crawlers[i] = (robot_crawler){.length = 1.4, .width = 0.2, .radius = 0.1};
        r->actuators[i] = (lh_actuator){LH_CRAWLER, 0, 0, 100};
        r->links[1 + i] = (lh_link){.parent = 0, .actuator = -1, .rotation = {1, 0, 0, 0}, .axis = {0, 1, 0}};
    }
    r->actuators[2] = (lh_actuator){LH_JOINT, -1.0f, 1.0f, (float)effort};
    r->links[0] = (lh_link){.parent = -1, .actuator = -1, .mass = BASE, .centre = {0, 0, HEIGHT}};
    r->links[3] = (lh_link){.parent = 0,
                            .actuator = 2,
                            .origin = {(float)joint_x, 0, HEIGHT},
                            .rotation = {1, 0, 0, 0},
                            .axis = {0, 1, 0},
                            .mass = LEVER,
                            .centre = {LONG / 2, 0, 0}};
    r->supports[0] = (lh_support){3, {LONG, 0, 0}, 0};
    for (int i = 0; i < 4; i++) {
        r->supports[1 + i] = (lh_support){0, {(i < 2 ? 1 : -1) * (float)AHEAD, (i % 2 ? 1 : -1) * (float)ASIDE, 0}, 0};
    }
}

static robot_facts facts_of(double joint_x, double effort) {
    robot_description d;
    lh_robot r;
    robot_facts facts;
    make(joint_x, effort, &d, &r);
    ck_assert_int_eq(lh_robot_validate(&r), LH_OK);
    facts_find(&d, &r, &facts);
    return facts;
}

START_TEST(stands_and_tumbles_by_its_centre_of_mass) {
    const robot_facts f = facts_of(-LONG / 2, EFFORT); /* the lever in balance: centre of mass at (0, 0, HEIGHT) */
    ck_assert_double_eq_tol(f.mass, BASE + LEVER, 1e-9);
    ck_assert(f.home.rests && !f.home.braced);
    ck_assert_double_eq_tol(f.home.centre_of_mass[0], 0, 1e-6);
    ck_assert_double_eq_tol(f.home.centre_of_mass[2], HEIGHT, 1e-6);
    /* about the nearest edge, (10): sqrt(ASIDE^2 + HEIGHT^2) - HEIGHT */
    ck_assert_double_eq_tol(f.home.margin, hypot(ASIDE, HEIGHT) - HEIGHT, 1e-5);
    ck_assert_double_eq_tol(f.tilt[FACTS_FORWARD], atan(AHEAD / HEIGHT), NEAR_THE_EDGE);
    ck_assert_double_eq_tol(f.tilt[FACTS_BACKWARD], atan(AHEAD / HEIGHT), NEAR_THE_EDGE);
    ck_assert_double_eq_tol(f.tilt[FACTS_LEFT], atan(ASIDE / HEIGHT), NEAR_THE_EDGE);
    ck_assert_double_eq_tol(f.tilt[FACTS_RIGHT], atan(ASIDE / HEIGHT), NEAR_THE_EDGE);
    ck_assert_double_eq_tol(f.ground_pressure, (BASE + LEVER) * FACTS_GRAVITY / (2 * 0.2 * 1.2), 1e-6);
}
END_TEST

START_TEST(a_lever_out_in_front_brings_the_front_down_sooner) {
    const robot_facts f = facts_of(0, EFFORT);
    const double ahead = LEVER * LONG / 2 / (BASE + LEVER); /* of the centre of mass */
    ck_assert_double_eq_tol(f.tilt[FACTS_FORWARD], atan((AHEAD - ahead) / HEIGHT), NEAR_THE_EDGE);
    ck_assert_double_eq_tol(f.tilt[FACTS_BACKWARD], atan((AHEAD + ahead) / HEIGHT), NEAR_THE_EDGE);
    ck_assert_double_eq_tol(f.tilt[FACTS_LEFT], atan(ASIDE / HEIGHT), NEAR_THE_EDGE);
}
END_TEST

START_TEST(a_strong_joint_lifts_until_the_robot_tumbles) {
    const robot_facts f = facts_of(0, 1e6);
    /* about the front edge: BASE * AHEAD = LEVER * (LONG / 2 - AHEAD) + lift * (LONG - AHEAD) */
    ck_assert_int_eq(f.tips[0].home.lift_bound, FACTS_TUMBLES);
    ck_assert_double_eq_tol(f.tips[0].home.lift, (BASE * AHEAD - LEVER * (LONG / 2 - AHEAD)) / (LONG - AHEAD), 0.05);
}
END_TEST

START_TEST(a_weak_joint_gives_way_first) {
    const double effort = 200;
    const robot_facts f = facts_of(0, effort);
    const double own = LEVER * FACTS_GRAVITY * LONG / 2;
    ck_assert_int_eq(f.tips[0].home.lift_bound, 2);
    ck_assert_double_eq_tol(f.tips[0].home.lift, (effort - own) / (LONG * FACTS_GRAVITY), 2e-3);
    /* its weight helps it to press */
    ck_assert_int_eq(f.tips[0].home.press_bound, 2);
    ck_assert_double_eq_tol(f.tips[0].home.press, (effort + own) / LONG, 2e-2);
}
END_TEST

START_TEST(an_arm_that_cannot_hold_itself_lifts_less_than_nothing) {
    ck_assert_double_lt(facts_of(0, 50).tips[0].home.lift, 0);
}
END_TEST

START_TEST(the_sweep_finds_reach_and_ground) {
    const robot_facts f = facts_of(0, EFFORT);
    ck_assert_int_eq(f.num_postures, 25);
    ck_assert_double_eq_tol(f.tips[0].reach, LONG, 1e-5); /* straight ahead, angle 0 */
    ck_assert_double_eq_tol(f.tips[0].low, HEIGHT - LONG * sin(1), 1e-5);
    ck_assert_double_eq_tol(f.tips[0].high, HEIGHT + LONG * sin(1), 1e-5);
    /* the tip is below the ground from asin(HEIGHT / LONG) = 0.24 on; steps are 1/12 rad */
    ck_assert_int_eq(f.num_braced, 10);
    ck_assert_int_eq(f.num_nowhere, 0);
    ck_assert(f.least.rests && !f.least.braced);
    ck_assert_double_le(f.least.margin, f.home.margin);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("facts");
    tcase_add_test(cases, stands_and_tumbles_by_its_centre_of_mass);
    tcase_add_test(cases, a_lever_out_in_front_brings_the_front_down_sooner);
    tcase_add_test(cases, a_strong_joint_lifts_until_the_robot_tumbles);
    tcase_add_test(cases, a_weak_joint_gives_way_first);
    tcase_add_test(cases, an_arm_that_cannot_hold_itself_lifts_less_than_nothing);
    tcase_add_test(cases, the_sweep_finds_reach_and_ground);
    return run_suite("facts", cases);
}
