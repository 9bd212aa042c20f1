/* What every test program shares: each defines suite(), which runner.c runs. */
#ifndef LIMPHOME_TEST_H
#define LIMPHOME_TEST_H

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

Suite *suite(void);

/* Fails also for NaN. */
#define expect_near(actual, expected, tolerance) ck_assert_double_eq_tol((actual), (expected), (tolerance))

#define COUNT(array) ((int32_t)(sizeof(array) / sizeof *(array)))

#endif
