/* As much of Check's interface as the tests of liblimphome use, without an operating system: the same tests are
 * compiled for a board. */
#ifndef LIMPHOME_EMBEDDED_CHECK_H
#define LIMPHOME_EMBEDDED_CHECK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* One of each is enough for one program, so a test case and a runner are the suite itself. */
typedef struct Suite Suite;
typedef Suite TCase;
typedef Suite SRunner;

enum { CK_NOFORK, CK_NORMAL };

Suite *suite_create(const char *name);
TCase *tcase_create(const char *name);
void suite_add_tcase(Suite *suite, TCase *tcase);
void check_add_test(TCase *tcase, const char *name, void (*test)(void));

SRunner *srunner_create(Suite *suite);
void srunner_set_fork_status(SRunner *runner, int status);
void srunner_run_all(SRunner *runner, int verbosity);
int srunner_ntests_run(SRunner *runner);
int srunner_ntests_failed(SRunner *runner);
void srunner_free(SRunner *runner);

/* Ends the test unless `good`. */
void check_that(bool good, const char *claim, const char *file, const char *line);

#define START_TEST(name) static void name(void)
#define END_TEST
#define tcase_add_test(tcase, name) check_add_test(tcase, #name, name)

#define CHECK_CLAIM_TEXT(x) #x
#define CHECK_CLAIM_LINE(x) CHECK_CLAIM_TEXT(x)
#define CHECK_CLAIM(good, claim) check_that(good, claim, __FILE__, CHECK_CLAIM_LINE(__LINE__))
#define CHECK_CLAIM_AS(type, x, relation, y) CHECK_CLAIM((type)(x)relation(type)(y), #x " " #relation " " #y)

#define ck_assert(good) CHECK_CLAIM(good, #good)
#define ck_assert_int_eq(x, y) CHECK_CLAIM_AS(intmax_t, x, ==, y)
#define ck_assert_int_ne(x, y) CHECK_CLAIM_AS(intmax_t, x, !=, y)
#define ck_assert_int_lt(x, y) CHECK_CLAIM_AS(intmax_t, x, <, y)
#define ck_assert_int_le(x, y) CHECK_CLAIM_AS(intmax_t, x, <=, y)
#define ck_assert_int_gt(x, y) CHECK_CLAIM_AS(intmax_t, x, >, y)
#define ck_assert_int_ge(x, y) CHECK_CLAIM_AS(intmax_t, x, >=, y)
#define ck_assert_uint_eq(x, y) CHECK_CLAIM_AS(uintmax_t, x, ==, y)
#define ck_assert_uint_gt(x, y) CHECK_CLAIM_AS(uintmax_t, x, >, y)
#define ck_assert_float_eq(x, y) CHECK_CLAIM_AS(float, x, ==, y)
#define ck_assert_float_lt(x, y) CHECK_CLAIM_AS(float, x, <, y)
#define ck_assert_float_le(x, y) CHECK_CLAIM_AS(float, x, <=, y)
#define ck_assert_float_gt(x, y) CHECK_CLAIM_AS(float, x, >, y)
#define ck_assert_float_ge(x, y) CHECK_CLAIM_AS(float, x, >=, y)
#define ck_assert_double_lt(x, y) CHECK_CLAIM_AS(double, x, <, y)
#define ck_assert_double_le(x, y) CHECK_CLAIM_AS(double, x, <=, y)
#define ck_assert_double_gt(x, y) CHECK_CLAIM_AS(double, x, >, y)
#define ck_assert_double_ge(x, y) CHECK_CLAIM_AS(double, x, >=, y)
#define ck_assert_double_eq_tol(x, y, tolerance) \
    CHECK_CLAIM(fabs((double)(x) - (double)(y)) < (double)(tolerance), #x " == " #y " +- " #tolerance)
#define ck_assert_mem_eq(x, y, size) CHECK_CLAIM(memcmp(x, y, size) == 0, #x " == " #y)
#define ck_assert_mem_ne(x, y, size) CHECK_CLAIM(memcmp(x, y, size) != 0, #x " != " #y)
#define ck_assert_str_eq(x, y) CHECK_CLAIM(strcmp(x, y) == 0, #x " == " #y)
#define ck_assert_str_ne(x, y) CHECK_CLAIM(strcmp(x, y) != 0, #x " != " #y)
#define ck_assert_ptr_nonnull(x) CHECK_CLAIM((x) != NULL, #x)

#endif
