/* Runs the cases of one test program; returns what main returns. */
#ifndef LIMPHOME_TEST_SUITE_H
#define LIMPHOME_TEST_SUITE_H

#include <check.h>

static inline int run_suite(const char *name, TCase *cases) {
    Suite *suite = suite_create(name);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}

#endif
