#include "limphome/learning/motion_model.h"

#include "limphome/base/random.h"
#include "test.h"

/* Too large for some stacks. */
static lh_motion_model model;
static lh_motion_model other;
static lh_motion_sums sums[LH_PLANNED_ACTIONS];

enum { ACTIONS = 5, JOINTS = 3 };

/* So chosen that multiples of width / 512 are exact. */
static const float low[JOINTS] = {-2.0f, -1.0f, 0.0f};
static const float width[JOINTS] = {0.5f, 0.25f, 1.0f};
#define PRIOR_WEIGHT 1.0f
#define MOTION_UNIT (1.0f / 16384.0f)

static void init_usual(void) {
    memset(&model, 0x5a, sizeof model);
    lh_motion_model_init(&model, ACTIONS, JOINTS, low, width, PRIOR_WEIGHT);
}

/* `x` kernel widths above the least angles. */
static void posture_at(const double *x, float *angle) {
    for (int32_t k = 0; k < JOINTS; k++) {
        angle[k] = low[k] + width[k] * (float)x[k];
    }
}

static void insert_at(double x, int32_t action, float forward, int32_t now) {
    const double place[JOINTS] = {x, 0.0, 0.0};
    float angle[JOINTS];
    posture_at(place, angle);
    lh_motion_model_insert(&model, action, angle, &(lh_motion){.forward = forward}, now);
}

static lh_motion corrected_at(double x, int32_t action, lh_motion expected) {
    const double place[JOINTS] = {x, 0.0, 0.0};
    float angle[JOINTS];
    posture_at(place, angle);
    lh_motion_model_gather(&model, angle, sums);
    lh_motion_model_correct(&model, &sums[action], &expected);
    return expected;
}

/* --- prediction --- */

START_TEST(what_is_not_known_is_as_expected) {
    init_usual();
    insert_at(3.0, 1, 0.5f, 1); /* too far away */
    insert_at(0.0, 2, 0.5f, 2); /* of another action */
    const lh_motion motion = corrected_at(0.0, 1, (lh_motion){0.1f, 0.2f, 0.3f, 1.0f});
    ck_assert_float_eq(sums[1].wide_weight, 0.0f);
    ck_assert_float_eq(sums[1].narrow_weight, 0.0f);
    ck_assert(motion.forward == 0.1f && motion.sideways == 0.2f && motion.turn == 0.3f && motion.moved == 1.0f);
}
END_TEST

/* Measured once, just here: 1 of 1.1 by the narrow kernel, the rest by the wide one, halved by the prior. */
START_TEST(one_measurement_by_hand) {
    init_usual();
    insert_at(0.0, 1, 0.25f, 1);
    const lh_motion motion = corrected_at(0.0, 1, (lh_motion){0.0f, 0.0f, 0.0f, 1.0f});
    ck_assert_float_eq(sums[1].narrow_weight, 1.0f);
    expect_near(motion.forward, (0.1 * 0.125 + 0.25) / 1.1, 1e-6);
    ck_assert_float_eq(motion.sideways, 0.0f);
    ck_assert_float_eq(motion.moved, 1.0f);
    /* 1.5 widths away by the wide kernel alone, with weight (1 - 1.5^2 / 4)^2 */
    const double weight = pow(1.0 - 1.5 * 1.5 / 4.0, 2.0);
    expect_near(corrected_at(1.5, 1, (lh_motion){0.0f, 0.0f, 0.0f, 1.0f}).forward, weight * 0.25 / (1.0 + weight),
                1e-5);
}
END_TEST

/* A measurement as the reference keeps it. */
typedef struct sample {
    double x[JOINTS]; /* [widths] */
    double part[LH_MOTION_PARTS];
    int32_t action;
} sample;

enum { SAMPLES = 300 };
static sample samples[SAMPLES];

static double whole_units(lh_random *random, double range, double unit) {
    return floor(range * lh_random_uniform(random) / unit) * unit;
}

/* Samples all over four widths each way, no two of an action so near that they would be one. */
static void fill(lh_random *random) {
    init_usual();
    int32_t count = 0;
    while (count < SAMPLES) {
        sample s = {.action = count % ACTIONS};
        bool apart = true;
        for (int32_t k = 0; k < JOINTS; k++) {
            s.x[k] = whole_units(random, 4.0, 1.0 / 512.0);
        }
        for (int32_t i = 0; i < count; i++) {
            const double *x = samples[i].x;
            const double d = pow(x[0] - s.x[0], 2.0) + pow(x[1] - s.x[1], 2.0) + pow(x[2] - s.x[2], 2.0);
            apart = apart && (samples[i].action != s.action || d > 0.1);
        }
        if (!apart) {
            continue;
        }
        for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
            s.part[k] = whole_units(random, 2.0, MOTION_UNIT) - 1.0;
        }
        float angle[JOINTS];
        posture_at(s.x, angle);
        const lh_motion motion = {(float)s.part[0], (float)s.part[1], (float)s.part[2], (float)s.part[3]};
        lh_motion_model_insert(&model, s.action, angle, &motion, count);
        samples[count++] = s;
    }
    ck_assert_int_eq(model.num_samples, SAMPLES);
}

START_TEST(kernel_sums_against_plain_loops) {
    lh_random random;
    lh_random_init(&random, 1);
    fill(&random);
    for (int32_t i = 0; i < 40; i++) {
        double x[JOINTS];
        for (int32_t k = 0; k < JOINTS; k++) {
            x[k] = whole_units(&random, 4.0, 1.0 / 512.0);
        }
        float angle[JOINTS];
        posture_at(x, angle);
        lh_motion_model_gather(&model, angle, sums);
        for (int32_t a = 0; a < ACTIONS; a++) {
            double wide = 0.0;
            double narrow = 0.0;
            double wide_part[LH_MOTION_PARTS] = {0.0};
            double narrow_part[LH_MOTION_PARTS] = {0.0};
            for (int32_t j = a; j < SAMPLES; j += ACTIONS) {
                double square = 0.0;
                for (int32_t k = 0; k < JOINTS; k++) {
                    square += pow(x[k] - samples[j].x[k], 2.0);
                }
                const double of_wide = square < 4.0 ? pow(1.0 - square / 4.0, 2.0) : 0.0;
                const double of_narrow = square < 1.0 ? pow(1.0 - square, 2.0) : 0.0;
                wide += of_wide;
                narrow += of_narrow;
                for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
                    wide_part[k] += of_wide * samples[j].part[k];
                    narrow_part[k] += of_narrow * samples[j].part[k];
                }
            }
            expect_near(sums[a].wide_weight, wide, 1e-5 * (1.0 + wide));
            expect_near(sums[a].narrow_weight, narrow, 1e-5 * (1.0 + narrow));
            lh_motion motion = {0.5f, -0.5f, 0.25f, 1.0f};
            lh_motion_model_correct(&model, &sums[a], &motion);
            const double expected[LH_MOTION_PARTS] = {0.5, -0.5, 0.25, 1.0};
            const float corrected[LH_MOTION_PARTS] = {motion.forward, motion.sideways, motion.turn, motion.moved};
            for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
                const double coarse = wide_part[k] / (PRIOR_WEIGHT + wide);
                const double fine = (0.1 * coarse + narrow_part[k]) / (0.1 + narrow);
                expect_near(corrected[k], expected[k] + fine, 1e-5);
            }
        }
    }
}
END_TEST

/* Without joints all that counts is the action. */
START_TEST(a_robot_without_an_arm_has_one_posture) {
    lh_motion_model_init(&model, ACTIONS, 0, NULL, NULL, PRIOR_WEIGHT);
    for (int32_t i = 0; i < 3; i++) {
        lh_motion_model_insert(&model, 2, NULL, &(lh_motion){.turn = 0.5f}, i);
    }
    ck_assert_int_eq(model.num_samples, 1);
    ck_assert_int_eq(model.count[0], 3);
    lh_motion_model_gather(&model, NULL, sums);
    ck_assert_float_eq(sums[2].narrow_weight, 3.0f);
}
END_TEST

/* --- samples --- */

START_TEST(near_measurements_of_an_action_become_one) {
    init_usual();
    insert_at(1.0, 1, 0.1f, 1);
    insert_at(1.25, 1, 0.3f, 2); /* moves it halfway */
    ck_assert_int_eq(model.num_samples, 1);
    ck_assert_int_eq(model.count[0], 2);
    ck_assert_int_eq(model.updated[0], 2);
    ck_assert_int_eq(model.posture[0][0], 512 + 64);
    expect_near(model.motion[0][0] * MOTION_UNIT, 0.2, 1e-4);
    insert_at(1.125, 2, 0.3f, 3); /* of another action */
    ck_assert_int_eq(model.num_samples, 2);
    insert_at(1.125 + 0.31, 1, 0.3f, 4); /* just too far */
    ck_assert_int_eq(model.num_samples, 3);
    insert_at(1.125 + 0.2, 1, 0.3f, 5); /* nearer to the third, 0.11 against 0.2 */
    ck_assert_int_eq(model.num_samples, 3);
    ck_assert_int_eq(model.count[0], 2);
    ck_assert_int_eq(model.count[2], 2);
}
END_TEST

START_TEST(measurements_are_rounded_to_the_nearest_unit) {
    const double units[] = {0.45, 0.55, -0.45, -0.55, 3.4, -3.6};
    const int32_t expected[] = {0, 1, 0, -1, 3, -4};
    init_usual();
    for (int32_t i = 0; i < COUNT(units); i++) {
        insert_at(2.0 * i, 1, (float)(units[i] / 16384.0), i);
        ck_assert_int_eq(model.motion[0][i], expected[i]);
    }
}
END_TEST

START_TEST(a_sample_does_not_stiffen) {
    init_usual();
    for (int32_t i = 0; i < 100; i++) {
        insert_at(0.0, 1, 0.0f, i);
    }
    ck_assert_int_eq(model.count[0], LH_SAMPLE_COUNT_MAX);
    insert_at(0.0, 1, 0.9f, 100);
    expect_near(model.motion[0][0] * MOTION_UNIT, 0.1, 1e-4);
    ck_assert_int_eq(model.count[0], LH_SAMPLE_COUNT_MAX);
}
END_TEST

START_TEST(the_one_updated_longest_ago_gives_way) {
    init_usual();
    for (int32_t i = 0; i < LH_MAX_SAMPLES; i++) {
        const int32_t row = i / 32;
        const double x[JOINTS] = {i % 32, row, 0.0};
        float angle[JOINTS];
        posture_at(x, angle);
        lh_motion_model_insert(&model, i % ACTIONS, angle, &(lh_motion){.forward = 0.0f}, i);
    }
    ck_assert_int_eq(model.num_samples, LH_MAX_SAMPLES);
    insert_at(0.0, 0, 0.0f, LH_MAX_SAMPLES); /* 0 is updated, so that 1 is the oldest */
    ck_assert_int_eq(model.updated[0], LH_MAX_SAMPLES);
    insert_at(60.0, 4, 0.5f, LH_MAX_SAMPLES + 1);
    ck_assert_int_eq(model.num_samples, LH_MAX_SAMPLES);
    ck_assert_int_eq(model.action[1], 4);
    ck_assert_int_eq(model.count[1], 1);
    ck_assert_int_eq(model.updated[1], LH_MAX_SAMPLES + 1);
    ck_assert_int_eq(model.posture[0][1], 30720); /* 60 widths */
    ck_assert_int_eq(model.posture[1][1], 0);
    expect_near(model.motion[0][1] * MOTION_UNIT, 0.5, 1e-4);
}
END_TEST

START_TEST(measurements_out_of_range_are_limited) {
    init_usual();
    const float beyond[2][JOINTS] = {{-100.0f, -100.0f, -100.0f}, {100.0f, 100.0f, 100.0f}};
    for (int32_t i = 0; i < 2; i++) {
        const float sign = i == 0 ? -1.0f : 1.0f;
        const lh_motion motion = {sign * 1e6f, sign * 2.0f, sign * 3.0f, sign};
        lh_motion_model_insert(&model, i, beyond[i], &motion, i);
        for (int32_t k = 0; k < 3; k++) {
            expect_near(model.motion[k][i] * MOTION_UNIT, (double)sign * 1.99, 1e-4);
        }
        expect_near(model.motion[3][i] * MOTION_UNIT, sign, 1e-4);
    }
    for (int32_t k = 0; k < JOINTS; k++) {
        ck_assert_int_eq(model.posture[k][0], -512);
        ck_assert_int_le(model.posture[k][1], 32000);
    }
    ck_assert_int_eq(model.posture[1][1], 32000); /* 101 rad are more widths than there are */
    /* and between the two ends no distance is too large */
    lh_motion_model_gather(&model, beyond[0], sums);
    ck_assert_float_eq(sums[0].narrow_weight, 1.0f);
    ck_assert_float_eq(sums[1].wide_weight, 0.0f);
}
END_TEST

/* --- what was saved --- */

START_TEST(a_sound_model_fits) {
    lh_random random;
    lh_random_init(&random, 2);
    fill(&random);
    other = model;
    lh_motion_model_init(&model, ACTIONS, JOINTS, low, width, PRIOR_WEIGHT);
    ck_assert(lh_motion_model_fits(&other, &model));
    ck_assert(lh_motion_model_fits(&model, &model));
    other.num_samples = LH_MAX_SAMPLES + 1;
    ck_assert(!lh_motion_model_fits(&other, &model));
    other.num_samples = -1;
    ck_assert(!lh_motion_model_fits(&other, &model));
}
END_TEST

START_TEST(one_of_other_actions_or_postures_does_not_fit) {
    init_usual();
    other = model;
    other.num_actions++;
    ck_assert(!lh_motion_model_fits(&other, &model));
    other = model;
    other.num_joints--;
    ck_assert(!lh_motion_model_fits(&other, &model));
    other = model;
    other.prior_weight = NAN;
    ck_assert(!lh_motion_model_fits(&other, &model));
    for (int32_t k = 0; k < JOINTS; k++) {
        other = model;
        other.low[k] += 0.1f;
        ck_assert(!lh_motion_model_fits(&other, &model));
        other = model;
        other.width[k] += 0.1f;
        ck_assert(!lh_motion_model_fits(&other, &model));
    }
}
END_TEST

START_TEST(samples_out_of_range_do_not_fit) {
    init_usual();
    insert_at(0.0, 1, 0.1f, 1);
    insert_at(2.0, 4, 0.1f, 2);
    const int16_t bad_action[] = {-1, ACTIONS};
    const int16_t bad_count[] = {0, LH_SAMPLE_COUNT_MAX + 1};
    const int16_t bad_posture[] = {-513, 32001};
    for (int32_t i = 0; i < 2; i++) {
        other = model;
        other.action[i] = bad_action[i];
        ck_assert(!lh_motion_model_fits(&other, &model));
        other = model;
        other.count[i] = bad_count[i];
        ck_assert(!lh_motion_model_fits(&other, &model));
        for (int32_t k = 0; k < JOINTS; k++) {
            other = model;
            other.posture[k][i] = bad_posture[i];
            ck_assert(!lh_motion_model_fits(&other, &model));
        }
    }
    other = model;
    other.action[LH_MAX_SAMPLES - 1] = ACTIONS; /* not used */
    ck_assert(!lh_motion_model_fits(&other, &model));
    other = model;
    other.posture[0][0] = -512;
    other.posture[0][1] = 32000;
    other.action[0] = 0;
    other.count[0] = LH_SAMPLE_COUNT_MAX;
    ck_assert(lh_motion_model_fits(&other, &model));
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("motion_model");
    TCase *t = tcase_create("prediction");
    tcase_add_test(t, what_is_not_known_is_as_expected);
    tcase_add_test(t, one_measurement_by_hand);
    tcase_add_test(t, kernel_sums_against_plain_loops);
    tcase_add_test(t, a_robot_without_an_arm_has_one_posture);
    suite_add_tcase(s, t);
    t = tcase_create("samples");
    tcase_add_test(t, near_measurements_of_an_action_become_one);
    tcase_add_test(t, measurements_are_rounded_to_the_nearest_unit);
    tcase_add_test(t, a_sample_does_not_stiffen);
    tcase_add_test(t, the_one_updated_longest_ago_gives_way);
    tcase_add_test(t, measurements_out_of_range_are_limited);
    suite_add_tcase(s, t);
    t = tcase_create("saving");
    tcase_add_test(t, a_sound_model_fits);
    tcase_add_test(t, one_of_other_actions_or_postures_does_not_fit);
    tcase_add_test(t, samples_out_of_range_do_not_fit);
    suite_add_tcase(s, t);
    return s;
}
