#include "limphome/learning/posture_values.h"

#include "limphome/base/random.h"
#include "test.h"

static lh_posture_values values;
static lh_posture_values other;

static const float low[LH_PLANNED_JOINTS] = {-2.6f, -0.6f, -2.4f};
static const float high[LH_PLANNED_JOINTS] = {2.6f, 1.2f, 0.0f};

static void init_usual(void) {
    memset(&values, 0x5a, sizeof values);
    lh_posture_values_init(&values, 3, low, high, 0.3f);
}

static void draw_posture(lh_random *random, float *angle) {
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        angle[k] = low[k] + (high[k] - low[k]) * lh_random_uniform(random);
    }
}

/* --- the lattice --- */

START_TEST(nodes_span_the_ranges) {
    init_usual();
    const int32_t count[] = {18, 7, 9};
    for (int32_t k = 0; k < 3; k++) {
        ck_assert_int_eq(values.count[k], count[k]);
        expect_near(values.low[k] + (float)(count[k] - 1) * values.spacing[k], high[k], 1e-5);
    }
    ck_assert_int_eq(values.num_nodes, 1134); /* 18 x 7 x 9 */
    for (int32_t node = 0; node < values.num_nodes; node++) {
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            ck_assert_int_eq(values.value[node][k], 0);
        }
        ck_assert_int_eq(values.cost[node], 0);
    }
}
END_TEST

START_TEST(every_node_has_angles_of_its_own) {
    init_usual();
    for (int32_t node = 0; node < values.num_nodes; node++) {
        float angle[LH_PLANNED_JOINTS];
        lh_posture_angles(&values, node, angle);
        const int32_t place[] = {node / 63, node / 9 % 7, node % 9};
        for (int32_t k = 0; k < 3; k++) {
            expect_near(angle[k], low[k] + place[k] * (double)values.spacing[k], 1e-5);
        }
        lh_cell cell;
        lh_posture_cell(&values, angle, &cell);
        ck_assert_int_eq(lh_posture_nearest(&cell), node);
    }
}
END_TEST

START_TEST(wide_ranges_widen_the_lattice) {
    const float lowest[] = {-100.0f, -100.0f, -100.0f};
    const float highest[] = {100.0f, 100.0f, 100.0f};
    for (int32_t joints = 1; joints <= LH_PLANNED_JOINTS; joints++) {
        lh_posture_values_init(&values, joints, lowest, highest, 0.0002f);
        int32_t nodes = 1;
        for (int32_t k = 0; k < joints; k++) {
            ck_assert_int_gt(values.count[k], 1);
            expect_near(values.spacing[k], 200.0 / (values.count[k] - 1), 1e-4);
            nodes *= values.count[k];
        }
        ck_assert_int_eq(values.num_nodes, nodes);
        ck_assert_int_le(nodes, LH_MAX_POSTURES);
        ck_assert_int_gt(nodes, LH_MAX_POSTURES / 2);
    }
}
END_TEST

START_TEST(no_joint_is_one_node) {
    lh_posture_values_init(&values, 0, NULL, NULL, 0.3f);
    ck_assert_int_eq(values.num_nodes, 1);
    ck_assert_int_eq(lh_posture_neighbour(&values, 0, NULL), 0);
    lh_posture_set_cost(&values, 0, 0.5f);
    lh_cell cell;
    lh_posture_cell(&values, NULL, &cell);
    ck_assert_int_eq(lh_posture_nearest(&cell), 0);
    expect_near(lh_posture_cost(&values, &cell), 0.5, 1e-6);
}
END_TEST

START_TEST(a_narrow_joint_has_one_place) {
    const float narrow_high[] = {2.6f, -0.5f, 0.0f};
    lh_posture_values_init(&values, 3, low, narrow_high, 0.3f);
    ck_assert_int_eq(values.count[1], 1);
    ck_assert_int_eq(values.num_nodes, 162); /* 18 x 9 */
    const float angle[] = {0.0f, -0.55f, -1.0f};
    lh_cell cell;
    lh_posture_cell(&values, angle, &cell);
    double sum = 0.0;
    for (int32_t c = 0; c < LH_CORNERS; c++) {
        ck_assert_int_lt(cell.node[c], values.num_nodes);
        sum += cell.weight[c];
    }
    expect_near(sum, 1.0, 1e-6);
    const int8_t up[] = {1, 2, 1};
    ck_assert_int_eq(lh_posture_neighbour(&values, 0, up), LH_NO_NODE);
}
END_TEST

START_TEST(neighbours_are_one_step_away) {
    init_usual();
    for (int32_t node = 0; node < values.num_nodes; node++) {
        const int32_t place[] = {node / 63, node / 9 % 7, node % 9};
        for (int32_t a = 0; a < 27; a++) {
            const int8_t level[] = {(int8_t)(a % 3), (int8_t)(a / 3 % 3), (int8_t)(a / 9)};
            int32_t next[3];
            bool inside = true;
            for (int32_t k = 0; k < 3; k++) {
                next[k] = place[k] + level[k] - 1;
                inside = inside && next[k] >= 0 && next[k] < values.count[k];
            }
            const int32_t expected = inside ? (next[0] * 7 + next[1]) * 9 + next[2] : LH_NO_NODE;
            ck_assert_int_eq(lh_posture_neighbour(&values, node, level), expected);
        }
    }
}
END_TEST

/* --- interpolation --- */

/* Linear in each angle, so that interpolation is exact. */
static double multilinear(const float *angle) {
    const double a = angle[0];
    const double b = angle[1];
    const double c = angle[2];
    return 1.0 + 0.5 * a - 0.7 * b + 0.3 * c + 0.4 * a * b - 0.2 * b * c + 0.6 * a * c - 0.5 * a * b * c;
}

/* Of the steering error, too: linear between columns. */
static double bent(double steering) {
    return 1.0 - 2.0 * fabs(steering);
}

static void fill_multilinear(void) {
    init_usual();
    for (int32_t node = 0; node < values.num_nodes; node++) {
        float angle[LH_PLANNED_JOINTS];
        lh_posture_angles(&values, node, angle);
        lh_posture_set_cost(&values, node, (float)multilinear(angle));
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            const double value = 10.0 * multilinear(angle) * bent(lh_posture_steering(k));
            lh_posture_set_value(&values, node, k, (float)value);
        }
    }
}

/* But for rounding to 1/1024 and 1/256. */
START_TEST(multilinear_functions_are_interpolated_exactly) {
    fill_multilinear();
    lh_random random;
    lh_random_init(&random, 1);
    for (int32_t i = 0; i < 500; i++) {
        float angle[LH_PLANNED_JOINTS];
        draw_posture(&random, angle);
        lh_cell cell;
        lh_posture_cell(&values, angle, &cell);
        expect_near(lh_posture_cost(&values, &cell), multilinear(angle), 0.5 / 1024 + 1e-5);
        const float steering = -0.87f + 1.74f * lh_random_uniform(&random);
        expect_near(lh_posture_value(&values, &cell, steering), 10.0 * multilinear(angle) * bent(steering),
                    0.5 / 256 + 1e-4);
    }
}
END_TEST

START_TEST(beyond_the_lattice_its_edge_counts) {
    fill_multilinear();
    const float beyond[] = {-50.0f, 50.0f, -1.2f};
    const float edge[] = {-2.6f, 1.2f, -1.2f};
    lh_cell cell;
    lh_posture_cell(&values, beyond, &cell);
    expect_near(lh_posture_cost(&values, &cell), multilinear(edge), 0.5 / 1024 + 1e-5);
    const double outermost = 10.0 * multilinear(edge) * bent(0.8726646);
    expect_near(lh_posture_value(&values, &cell, 3.0f), outermost, 0.5 / 256 + 1e-4);
    expect_near(lh_posture_value(&values, &cell, -3.0f), outermost, 0.5 / 256 + 1e-4);
}
END_TEST

START_TEST(weights_are_shares_of_nodes_around) {
    init_usual();
    lh_random random;
    lh_random_init(&random, 2);
    for (int32_t i = 0; i < 300; i++) {
        float angle[LH_PLANNED_JOINTS];
        draw_posture(&random, angle);
        lh_cell cell;
        lh_posture_cell(&values, angle, &cell);
        double sum = 0.0;
        double mean[3] = {0.0};
        int32_t closest = 0;
        for (int32_t c = 0; c < LH_CORNERS; c++) {
            ck_assert_int_ge(cell.node[c], 0);
            ck_assert_int_lt(cell.node[c], values.num_nodes);
            ck_assert_float_ge(cell.weight[c], 0.0f);
            float corner[LH_PLANNED_JOINTS];
            lh_posture_angles(&values, cell.node[c], corner);
            bool is_nearest = true;
            sum += cell.weight[c];
            for (int32_t k = 0; k < 3; k++) {
                mean[k] += (double)cell.weight[c] * corner[k];
                is_nearest = is_nearest && fabsf(corner[k] - angle[k]) < 0.5f * values.spacing[k];
            }
            closest = is_nearest ? cell.node[c] : closest;
        }
        expect_near(sum, 1.0, 1e-6);
        for (int32_t k = 0; k < 3; k++) {
            expect_near(mean[k], angle[k], 1e-5);
        }
        ck_assert_int_eq(lh_posture_nearest(&cell), closest);
    }
}
END_TEST

START_TEST(columns_are_degrees) {
    const double degrees[LH_STEERINGS] = {-50, -20, -8, -3, 0, 3, 8, 20, 50};
    for (int32_t k = 0; k < LH_STEERINGS; k++) {
        const double angle = degrees[k] * M_PI / 180.0;
        expect_near(lh_posture_steering(k), angle, 1e-7);
        expect_near(lh_posture_sine(k), sin(angle), 1e-7);
        expect_near(lh_posture_cosine(k), cos(angle), 1e-7);
    }
}
END_TEST

/* Wherever its search begins, a node's value is that of a cell in which it has all the weight. */
START_TEST(at_a_node_its_value_counts_alone) {
    init_usual();
    lh_random random;
    lh_random_init(&random, 3);
    for (int32_t node = 0; node < values.num_nodes; node += 37) {
        lh_posture_set_cost(&values, node, lh_random_uniform(&random));
        for (int32_t k = 0; k < LH_STEERINGS; k++) {
            lh_posture_set_value(&values, node, k, 20.0f * lh_random_uniform(&random));
        }
        lh_cell cell = {.node = {node, node, node, node, node, node, node, node}, .weight = {1.0f}};
        ck_assert_float_eq(lh_posture_node_cost(&values, node), lh_posture_cost(&values, &cell));
        for (int32_t i = 0; i <= 40; i++) {
            const float steering = -1.0f + 0.05f * (float)i;
            for (int32_t near = 0; near < LH_STEERINGS; near++) {
                ck_assert_float_eq(lh_posture_node_value(&values, node, near, steering),
                                   lh_posture_value(&values, &cell, steering));
            }
        }
        for (int32_t k = 0; k < LH_STEERINGS; k++) { /* just at a column */
            expect_near(lh_posture_node_value(&values, node, 4, lh_posture_steering(k)), values.value[node][k] / 256.0,
                        1e-4);
        }
    }
}
END_TEST

/* --- storage --- */

START_TEST(values_are_rounded_and_saturate) {
    init_usual();
    const struct {
        float value;
        int32_t stored;
    } cases[] = {{0.0f, 0},        {1.0f, 256},       {-1.0f, -256},      {0.00196f, 1},   {-0.00196f, -1},
                 {0.0019f, 0},     {-0.0019f, 0},     {127.9f, 32742},    {128.0f, 32767}, {1e30f, 32767},
                 {-1e30f, -32767}, {INFINITY, 32767}, {-INFINITY, -32767}};
    for (int32_t i = 0; i < COUNT(cases); i++) {
        lh_posture_set_value(&values, 5, 3, cases[i].value);
        ck_assert_int_eq(values.value[5][3], cases[i].stored);
    }
    lh_posture_set_cost(&values, 5, 31.0f);
    ck_assert_int_eq(values.cost[5], 31744); /* 31 */
    lh_posture_set_cost(&values, 5, 33.0f);
    ck_assert_int_eq(values.cost[5], 32767);
}
END_TEST

START_TEST(only_the_same_lattice_fits) {
    init_usual();
    other = values;
    lh_posture_set_value(&other, 3, 3, 5.0f);
    ck_assert(lh_posture_values_fit(&other, &values));
    other.num_joints--;
    ck_assert(!lh_posture_values_fit(&other, &values));
    other = values;
    other.num_nodes--;
    ck_assert(!lh_posture_values_fit(&other, &values));
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        other = values;
        other.count[k]++;
        ck_assert(!lh_posture_values_fit(&other, &values));
        other = values;
        other.low[k] += 0.1f;
        ck_assert(!lh_posture_values_fit(&other, &values));
        other = values;
        other.spacing[k] = NAN;
        ck_assert(!lh_posture_values_fit(&other, &values));
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("posture_values");
    TCase *t = tcase_create("lattice");
    tcase_add_test(t, nodes_span_the_ranges);
    tcase_add_test(t, every_node_has_angles_of_its_own);
    tcase_add_test(t, wide_ranges_widen_the_lattice);
    tcase_add_test(t, no_joint_is_one_node);
    tcase_add_test(t, a_narrow_joint_has_one_place);
    tcase_add_test(t, neighbours_are_one_step_away);
    suite_add_tcase(s, t);
    t = tcase_create("interpolation");
    tcase_add_test(t, multilinear_functions_are_interpolated_exactly);
    tcase_add_test(t, beyond_the_lattice_its_edge_counts);
    tcase_add_test(t, weights_are_shares_of_nodes_around);
    tcase_add_test(t, columns_are_degrees);
    tcase_add_test(t, at_a_node_its_value_counts_alone);
    suite_add_tcase(s, t);
    t = tcase_create("storage");
    tcase_add_test(t, values_are_rounded_and_saturate);
    tcase_add_test(t, only_the_same_lattice_fits);
    suite_add_tcase(s, t);
    return s;
}
