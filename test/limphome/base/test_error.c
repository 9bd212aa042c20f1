#include "limphome/base/error.h"

#include "test.h"

START_TEST(every_error_has_a_text_of_its_own) {
    for (int a = LH_OK; a < LH_ERROR_COUNT; a++) {
        const char *text = lh_error_text((lh_error)a);
        ck_assert_ptr_nonnull(text);
        ck_assert_uint_gt(strlen(text), 5);
        ck_assert_int_ne(text[strlen(text) - 1], '.');
        ck_assert_str_ne(text, "Unknown error");
        for (int b = LH_OK; b < a; b++) {
            ck_assert_str_ne(text, lh_error_text((lh_error)b));
        }
    }
}
END_TEST

START_TEST(unknown_values_have_a_text) {
    ck_assert_str_eq(lh_error_text(LH_ERROR_COUNT), "Unknown error");
    ck_assert_str_eq(lh_error_text((lh_error)1000), "Unknown error");
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("error");
    TCase *t = tcase_create("text");
    tcase_add_test(t, every_error_has_a_text_of_its_own);
    tcase_add_test(t, unknown_values_have_a_text);
    suite_add_tcase(s, t);
    return s;
}
