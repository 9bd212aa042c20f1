/* What settings_check accepts the library accepts too, whatever the values. */
#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "convert.h"
#include "settings_table.h"

/* xorshift64*, for equal tests everywhere. */
static uint64_t draw(uint64_t *state) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * 2685821657736338717u;
}

static double draw_uniform(uint64_t *state) {
    return (double)(draw(state) >> 11) * 0x1p-53;
}

/* Takes a number as the value of `key`, as a file would give it. False if it is refused. */
static bool take(const settings_key *key, settings *s, double number) {
    char text[SETTINGS_VALUE_LENGTH];
    if (key->kind == SETTINGS_KIND_CHOICE) {
        return settings_key_parse(key, s, key->words[(size_t)number]);
    }
    snprintf(text, sizeof text, "%.17g", number);
    if (key->kind == SETTINGS_KIND_PATH) { /* the number is an enumerator; all waypoints at an end of the range */
        static const char *const values[] = {"rolling", "ahead",
                                             "to 1000 -1000, 1000 1000, -1000 0, 0 0, 0 0, 1 1, 2 2, 3 3"};
        return settings_key_parse(key, s, values[(size_t)number]);
    }
    return settings_key_parse(key, s, text);
}

/* A value of the range: an end of it, near an end, or anywhere. */
static double draw_value(const settings_key *key, uint64_t *state) {
    const double ends[] = {key->low, key->high};
    const double near = ends[draw(state) % 2];
    if (key->kind != SETTINGS_KIND_REAL) {
        return draw(state) % 2 == 0 ? near : round(key->low + (key->high - key->low) * draw_uniform(state));
    }
    switch (draw(state) % 4) {
        case 0:
            return near;
        case 1:
            return nextafter(near, ends[draw(state) % 2]);
        case 2: /* by magnitude: small values are many */
            return key->low + (key->high - key->low) * pow(10, -6 * draw_uniform(state));
        default:
            return key->low + (key->high - key->low) * draw_uniform(state);
    }
}

static bool is_accepted(const settings *s) {
    char error[ERROR_LENGTH] = "";
    if (!settings_check(s, error)) {
        ck_assert_str_ne(error, "");
        return false;
    }
    const lh_config config = convert_config(s);
    const lh_error refused = lh_config_validate(&config);
    if (refused != LH_OK) {
        settings_write(s, stderr);
        ck_abort_msg("settings_check accepts what the library refuses: %s", lh_error_text(refused));
    }
    return true;
}

/* A few keys at a time take values from all over their ranges. */
START_TEST(what_the_check_accepts_the_library_accepts) {
    enum { TRIALS = 20000, MOST_CHANGES = 6 };
    uint64_t state = 1;
    int accepted = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        settings s = settings_default();
        for (uint64_t left = 1 + draw(&state) % MOST_CHANGES; left > 0; left--) {
            const settings_key *key = &settings_keys[draw(&state) % SETTINGS_KEY_COUNT];
            take(key, &s, draw_value(key, &state)); /* where the library's end is no decimal, it may be refused */
        }
        accepted += is_accepted(&s) ? 1 : 0;
    }
    ck_assert_int_gt(accepted, TRIALS / 4);
    ck_assert_int_lt(accepted, TRIALS - TRIALS / 100);
}
END_TEST

/* The ends of each range, as they are printed, are in it, and what is next to them outside is not. */
START_TEST(ranges_end_where_they_say) {
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        const settings_key *key = &settings_keys[i];
        if (key->kind == SETTINGS_KIND_CHOICE || key->kind == SETTINGS_KIND_PATH) {
            continue;
        }
        char text[SETTINGS_RANGE_LENGTH];
        settings_key_range(key, text);
        double low, high;
        ck_assert_int_eq(sscanf(strstr(text, "from"), "from %lf to %lf", &low, &high), 2);
        const bool is_whole = key->kind == SETTINGS_KIND_WHOLE;
        ck_assert_msg((float)low == (float)key->low && (float)high == (float)key->high,
                      "%s: a range of more digits than single precision tells apart", key->name);
        settings s = settings_default();
        ck_assert_msg(take(key, &s, low) && take(key, &s, high), "%s: %s", key->name, text);
        ck_assert(!take(key, &s, is_whole ? low - 1 : nextafter(low, -INFINITY)));
        ck_assert(!take(key, &s, is_whole ? high + 1 : nextafter(high, INFINITY)));
        ck_assert_double_eq(settings_key_number(key, &s), high);
    }
}
END_TEST

/* The ends of the ranges that the library has too, alone and against one that it has not. */
START_TEST(each_end_alone_is_accepted_or_refused_by_a_relation) {
    for (size_t i = 0; i < SETTINGS_KEY_COUNT; i++) {
        for (int end = 0; end < 2; end++) {
            settings s = settings_default();
            take(&settings_keys[i], &s, end == 0 ? settings_keys[i].low : settings_keys[i].high);
            is_accepted(&s);
        }
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("settings and library");
    TCase *all = tcase_create("settings and library");
    tcase_set_timeout(all, 0); /* no test asserts a time */
    tcase_add_test(all, what_the_check_accepts_the_library_accepts);
    tcase_add_test(all, ranges_end_where_they_say);
    tcase_add_test(all, each_end_alone_is_accepted_or_refused_by_a_relation);
    suite_add_tcase(suite, all);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
