#include "limphome/learning/planning.h"

#include "crawler.h"
#include "limphome/task/action.h"
#include "test.h"

/* Too large for some stacks. */
static lh_planner planner;
static lh_planner other;

enum { RIGHT = 1, SWING, BOOM, ARM };

static const lh_controlled crawler_and_boom = {.count = 2, .index = {RIGHT, BOOM}};

/* Before any sweep. */
static void init_for(const lh_robot *robot, const lh_controlled *controlled, float discount_rate, bool mechanics) {
    const lh_task_config task_config = lh_task_config_default();
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, &task_config, robot, controlled), LH_OK);
    lh_planner_config config = lh_planner_config_default();
    config.discount_rate = discount_rate;
    config.mechanics = mechanics;
    config.sweeps = 0;
    ck_assert_int_eq(lh_planner_init(&planner, &config, &task, 1), LH_OK);
    const lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
    memcpy(planner.joint_angle, state.actuator_position, sizeof planner.joint_angle);
}

static void init(const lh_controlled *controlled, float discount_rate, bool mechanics) {
    const lh_robot robot = crawler_robot();
    init_for(&robot, controlled, discount_rate, mechanics);
}

static void init_usual(void) {
    const lh_controlled controlled = crawler_controlled();
    init(&controlled, 0.99f, true);
}

/* --- reference: the planning reward of planner.h in double precision --- */

static double penalty(double steering) {
    const double x = fabs(steering);
    return 1.5 * (x < 0.1 ? x * x / 0.1 : 2.0 * x - 0.1);
}

static double margin_at(const float *angle) {
    float joint_angle[LH_MAX_ACTUATORS];
    memcpy(joint_angle, planner.joint_angle, sizeof joint_angle);
    lh_planned_set_angles(&planner.planned, angle, joint_angle);
    lh_rest rest;
    lh_rest_find(&planner.robot, joint_angle, planner.up, &rest);
    return rest.margin;
}

/* S_safe is in proportion to the robot, 2 cm for that of the paper, which is 1.25 m wide. */
static double safe_margin(void) {
    return 0.02 * 2.0 * planner.robot.supports[0].point.y / 1.25;
}

static double cost_at(const float *angle) {
    const double margin = margin_at(angle);
    return exp(-margin) + 3.0 * fmin(3.0, fmax(0.0, 1.0 - margin / safe_margin()));
}

/* Along the line and across the robot; the errors after it. */
static double reward_of(const lh_motion *motion, double *heading, double *lateral) {
    const double midway = *heading + 0.5 * motion->turn;
    const double along = motion->forward * cos(midway) - motion->sideways * sin(midway);
    *lateral += motion->forward * sin(midway) + motion->sideways * cos(midway);
    *heading += motion->turn;
    return 8.0 * along - 2.0 * fabs(motion->sideways) - penalty(*heading + 0.7 * *lateral);
}

static lh_motion predicted(const lh_planner *p, int32_t action) {
    const lh_twist *t = &p->outlook.expected[action];
    lh_motion motion = {t->forward, t->sideways, t->turn, 1.0f};
    lh_motion_model_correct(&p->learned.model, &p->outlook.sums[action], &motion);
    return motion;
}

START_TEST(steering_error_is_of_heading_and_place) {
    expect_near(lh_course_steering((lh_course){0.1f, -0.2f}), 0.1 - 0.7 * 0.2, 1e-7);
}
END_TEST

/* --- costs and expectations --- */

static void expect_costs_of_margins(void) {
    int32_t unsafe = 0;
    for (int32_t node = 0; node < planner.learned.values.num_nodes; node += 7) {
        float angle[LH_PLANNED_JOINTS];
        lh_posture_angles(&planner.learned.values, node, angle);
        expect_near(lh_posture_node_cost(&planner.learned.values, node), cost_at(angle), 0.6 / 1024);
        unsafe += margin_at(angle) < safe_margin();
    }
    ck_assert_int_gt(unsafe, 0);
}

START_TEST(nodes_cost_what_their_margin_says) {
    init_usual();
    expect_costs_of_margins();
    const lh_robot large = crawler_robot();
    const lh_robot small = scaled_robot(&large, 0.1f);
    const lh_controlled controlled = crawler_controlled();
    init_for(&small, &controlled, 0.99f, true);
    expect_costs_of_margins();
}
END_TEST

/* On a wall, say. */
START_TEST(a_posture_without_rest_costs_most) {
    init_usual();
    planner.up = (lh_vec3){0.0f, 0.995f, 0.0998749f};
    lh_planning_assess(&planner);
    for (int32_t node = 0; node < planner.learned.values.num_nodes; node += 7) {
        expect_near(lh_posture_node_cost(&planner.learned.values, node), exp(1.0) + 9.0, 1e-3);
    }
}
END_TEST

/* Whatever is saved of the work: opposite actions, and joints that do not matter. */
START_TEST(every_action_is_expected_to_do_what_mechanics_says) {
    const float postures[][LH_PLANNED_JOINTS] = {{0.0f, 0.6f, -1.0f}, {1.3f, -0.5f, -0.9f}};
    const lh_vec3 ups[] = {{0.0f, 0.0f, 1.0f}, {0.17364818f, 0.0f, 0.98480775f}};
    init_usual();
    for (int32_t i = 0; i < 4; i++) {
        planner.up = ups[i / 2];
        const float *angle = postures[i % 2];
        lh_planning_look(&planner, angle);
        ck_assert_int_eq(planner.outlook.rest.braced, i % 2 == 1);
        float joint_angle[LH_MAX_ACTUATORS] = {0.0f, 0.0f, angle[0], angle[1], angle[2]};
        lh_footing footing;
        lh_footing_find(&planner.robot, joint_angle, &planner.outlook.rest, planner.up, planner.planned.travel, 0.7f,
                        &footing);
        for (int32_t a = 0; a < 81; a++) {
            int8_t levels[4];
            lh_action_levels(a, 4, levels);
            float share[LH_MAX_ACTUATORS] = {0.0f};
            for (int32_t k = 0; k < 4; k++) {
                share[1 + k] = (float)(levels[k] - 1);
            }
            const lh_twist expected = lh_quasi_static_motion(&footing, 5, share);
            const lh_twist *t = &planner.outlook.expected[a];
            expect_near(t->forward, expected.forward, 1e-6);
            expect_near(t->sideways, expected.sideways, 1e-6);
            expect_near(t->turn, expected.turn, 1e-6);
        }
    }
}
END_TEST

START_TEST(without_mechanics_nothing_is_expected) {
    const lh_controlled controlled = crawler_controlled();
    init(&controlled, 0.99f, false);
    lh_planning_look(&planner, (const float[]){1.3f, -0.5f, -0.9f});
    for (int32_t a = 0; a < 81; a++) {
        ck_assert_float_eq(planner.outlook.expected[a].forward, 0.0f);
        ck_assert_float_eq(planner.outlook.expected[a].turn, 0.0f);
    }
}
END_TEST

/* --- value iteration --- */

/* What the crawler and the boom are told to do, measured at a few angles of the boom, with all kinds of outcomes: the
 * boom jams when it is lowered at -0.3 rad. */
static void measure(void) {
    for (int32_t i = 0; i < 4; i++) {
        const float boom = -0.6f + 0.5f * (float)i;
        for (int32_t a = 0; a < 9; a++) {
            const float drive = (float)(a % 3 - 1);
            const int32_t row = a / 3;
            const float lift = (float)(row - 1);
            const lh_motion motion = {.forward = 0.1f * drive - 0.02f * lift,
                                      .sideways = 0.01f * drive * (float)i,
                                      .turn = 0.06f * drive * (boom - 0.2f) + 0.03f * lift,
                                      .moved = i == 1 && lift < 0.0f ? -1.0f : 0.0f};
            lh_motion_model_insert(&planner.learned.model, a, &boom, &motion, 9 * i + a);
        }
    }
}

enum { NODES = 7 };

/* Values between columns, and those of the outermost beyond. */
static double interpolated(const double *value, double steering) {
    if (steering <= lh_posture_steering(0)) {
        return value[0];
    }
    for (int32_t k = 1; k < LH_STEERINGS; k++) {
        const double low = lh_posture_steering(k - 1);
        const double high = lh_posture_steering(k);
        if (steering <= high) {
            return value[k - 1] + (steering - low) / (high - low) * (value[k] - value[k - 1]);
        }
    }
    return value[LH_STEERINGS - 1];
}

/* The best of all actions for two decisions each, from one node with steering error `before`. */
static double best_value(double value[NODES][LH_STEERINGS], int32_t node, double before, double discount) {
    double best = -1e9;
    for (int32_t a = 0; a < 9; a++) {
        const int32_t next = node + a / 3 - 1;
        if (a == 4 || next < 0 || next >= NODES) {
            continue;
        }
        const lh_motion motion = predicted(&planner, a);
        const int32_t then = motion.moved < 0.6f ? node : next;
        float angle;
        lh_posture_angles(&planner.learned.values, then, &angle);
        double heading = before;
        double lateral = 0.0;
        const double first = reward_of(&motion, &heading, &lateral);
        const double after = heading + 0.7 * lateral;
        const double later = 2.0 * after - before; /* once more the same, but for the steering error it leads to */
        const double second = first + penalty(after) - penalty(later);
        const double worth = first + discount * second - (1.0 + discount) * cost_at(&angle) +
                             discount * discount * interpolated(value[then], later);
        best = fmax(best, worth);
    }
    return best;
}

START_TEST(value_iteration_on_a_small_task) {
    const double discount = 0.7;
    init(&crawler_and_boom, (float)discount, false);
    ck_assert_int_eq(planner.learned.values.num_nodes, NODES);
    measure();
    lh_planning_back_up_in_turn(&planner, 40 * NODES);
    ck_assert_int_eq(planner.learned.turn, 0);

    static double value[NODES][LH_STEERINGS];
    for (int32_t sweep = 0; sweep < 40; sweep++) {
        for (int32_t node = 0; node < NODES; node++) {
            float angle;
            lh_posture_angles(&planner.learned.values, node, &angle);
            lh_planning_look(&planner, &angle);
            double best[LH_STEERINGS];
            for (int32_t k = 0; k < LH_STEERINGS; k++) {
                best[k] = best_value(value, node, lh_posture_steering(k), discount);
            }
            memcpy(value[node], best, sizeof best);
        }
    }
    for (int32_t node = 0; node < NODES; node++) {
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            /* values are kept in 1/256, costs in 1/1024, and rounding adds up by discount^2 */
            expect_near(planner.learned.values.value[node][k] / 256.0, value[node][k], 0.006);
        }
    }
}
END_TEST

START_TEST(nodes_are_backed_up_in_turn) {
    init(&crawler_and_boom, 0.7f, true);
    other = planner;
    lh_planning_back_up_in_turn(&planner, 5);
    ck_assert_int_eq(planner.learned.turn, 5);
    lh_planning_back_up_in_turn(&planner, 5);
    ck_assert_int_eq(planner.learned.turn, 3);
    for (int32_t i = 0; i < 10; i++) {
        lh_planning_back_up(&other, i % NODES);
    }
    ck_assert_mem_eq(&planner.learned.values, &other.learned.values, sizeof other.learned.values);
}
END_TEST

/* Where no action leads to another node there is nothing to be had. */
START_TEST(a_node_without_a_way_out_is_worth_least) {
    const lh_controlled controlled = {.count = 1, .index = {BOOM}};
    lh_robot robot = crawler_robot();
    robot.actuators[BOOM].high = -0.55f;
    const lh_task_config task_config = lh_task_config_default();
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, &task_config, &robot, &controlled), LH_OK);
    lh_planner_config config = lh_planner_config_default();
    config.sweeps = 1;
    ck_assert_int_eq(lh_planner_init(&planner, &config, &task, 1), LH_OK);
    ck_assert_int_eq(planner.learned.values.num_nodes, 1);
    ck_assert_int_eq(planner.learned.values.value[0][4], -32767);
    /* nor is there an action to take: the joint is near both of its limits */
    const float angle = -0.575f;
    lh_planning_look(&planner, &angle);
    const lh_option chosen = lh_planning_choose(&planner, &angle, (lh_course){0.0f, 0.0f}, 0.0f);
    ck_assert_int_eq(chosen.action, lh_planned_still(&planner.planned));
    ck_assert_float_eq(chosen.angle[0], angle);
}
END_TEST

/* --- choice --- */

static const float posture[LH_PLANNED_JOINTS] = {1.1f, -0.35f, -0.9f};
static const lh_course course = {0.15f, -0.1f};

START_TEST(an_option_is_worth_its_reward_and_what_follows) {
    init_usual();
    lh_planning_back_up_in_turn(&planner, planner.learned.values.num_nodes);
    lh_planning_look(&planner, posture);
    const lh_posture_values *values = &planner.learned.values;
    for (int32_t a = 0; a < 81; a++) {
        lh_option option;
        lh_planning_consider(&planner, posture, course, a, &option);
        const lh_motion motion = predicted(&planner, a);
        double heading = course.heading;
        double lateral = course.lateral;
        const double reward = reward_of(&motion, &heading, &lateral);
        ck_assert_int_eq(option.action, a);
        expect_near(option.course.heading, heading, 1e-6);
        expect_near(option.course.lateral, lateral, 5e-4); /* the planner takes half a turn to be small */
        for (int32_t k = 0; k < 3; k++) {
            expect_near(option.angle[k], posture[k] + 0.15f * (float)(planner.planned.level[a][1 + k] - 1), 1e-6);
        }
        lh_cell cell;
        lh_posture_cell(values, option.angle, &cell);
        expect_near(option.reward, reward - lh_posture_cost(values, &cell), 5e-3);
        const float steering = lh_course_steering(option.course);
        expect_near(option.value, option.reward + 0.99 * lh_posture_value(values, &cell, steering), 1e-4);
        ck_assert_mem_eq(&option.expected, &planner.outlook.expected[a], sizeof option.expected);
    }
}
END_TEST

/* Plainly: all options sorted by value, and the first of them looked into. Some actions were tried there, once or
 * twice; with caution the others are worth less. */
START_TEST(the_choice_is_that_of_a_plain_search) {
    init_usual();
    lh_planning_back_up_in_turn(&planner, planner.learned.values.num_nodes);
    for (int32_t i = 0; i < 40; i++) {
        const lh_motion motion = {.forward = -0.001f * (float)i};
        lh_motion_model_insert(&planner.learned.model, (7 * i) % 30, posture, &motion, i);
    }
    const int32_t candidates[] = {1, 2, 5, LH_CANDIDATES_MAX};
    for (int32_t i = 0; i < 2 * COUNT(candidates); i++) {
        const float caution = i < COUNT(candidates) ? 0.0f : 0.7f;
        const int32_t most_candidates = candidates[i % COUNT(candidates)];
        planner.config.candidates = most_candidates;
        lh_planning_look(&planner, posture);
        static lh_option options[81];
        int32_t count = 0;
        for (int32_t a = 0; a < 81; a++) {
            if (a != 40) { /* no joint is near a limit */
                const float doubt = caution * 0.1f / (0.1f + planner.outlook.sums[a].narrow_weight);
                lh_planning_consider(&planner, posture, course, a, &options[count]);
                options[count].reward -= doubt;
                options[count].value -= doubt;
                count++;
            }
        }
        int32_t best = -1;
        double most = -1e9;
        for (int32_t k = 0; k < count; k++) {
            int32_t better = 0;
            for (int32_t j = 0; j < count; j++) {
                better += options[j].value > options[k].value || (options[j].value == options[k].value && j < k);
            }
            if (better >= most_candidates) {
                continue;
            }
            double value = options[k].value;
            if (most_candidates > 1) {
                lh_planning_look(&planner, options[k].angle);
                double further = -1e9;
                for (int32_t a = 0; a < 81; a++) {
                    lh_option next;
                    lh_planning_consider(&planner, options[k].angle, options[k].course, a, &next);
                    further = a == 40 ? further : fmax(further, next.value);
                }
                value = options[k].reward + 0.99 * further;
            }
            if (value > most) {
                most = value;
                best = k;
            }
        }
        lh_planning_look(&planner, posture);
        const lh_option chosen = lh_planning_choose(&planner, posture, course, caution);
        ck_assert_int_eq(chosen.action, options[best].action);
        expect_near(chosen.value, most, 1e-4);
        expect_near(chosen.reward, options[best].reward, 1e-6);
    }
}
END_TEST

/* What is not allowed is not looked into either, however good it would be. */
START_TEST(at_a_limit_only_what_is_allowed_is_chosen) {
    init_usual();
    const float at_limits[LH_PLANNED_JOINTS] = {2.6f, -0.6f, 0.0f};
    for (int32_t i = 0; i < 2; i++) {
        planner.config.candidates = i == 0 ? 1 : LH_CANDIDATES_MAX;
        lh_planning_look(&planner, at_limits);
        const lh_option chosen = lh_planning_choose(&planner, at_limits, course, 0.0f);
        ck_assert(lh_planned_allows(&planner.planned, at_limits, chosen.action));
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("planning");
    TCase *t = tcase_create("looking");
    tcase_add_test(t, steering_error_is_of_heading_and_place);
    tcase_add_test(t, nodes_cost_what_their_margin_says);
    tcase_add_test(t, a_posture_without_rest_costs_most);
    tcase_add_test(t, every_action_is_expected_to_do_what_mechanics_says);
    tcase_add_test(t, without_mechanics_nothing_is_expected);
    suite_add_tcase(s, t);
    t = tcase_create("value iteration");
    tcase_add_test(t, value_iteration_on_a_small_task);
    tcase_add_test(t, nodes_are_backed_up_in_turn);
    tcase_add_test(t, a_node_without_a_way_out_is_worth_least);
    suite_add_tcase(s, t);
    t = tcase_create("choice");
    tcase_add_test(t, an_option_is_worth_its_reward_and_what_follows);
    tcase_add_test(t, the_choice_is_that_of_a_plain_search);
    tcase_add_test(t, at_a_limit_only_what_is_allowed_is_chosen);
    suite_add_tcase(s, t);
    return s;
}
