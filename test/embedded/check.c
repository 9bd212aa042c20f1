#include "check.h"

#include <setjmp.h>

#include "platform.h"

enum { MAX_TESTS = 64 };

struct Suite {
    const char *name;
    int count;
    int failed;
    struct {
        const char *name;
        void (*run)(void);
    } tests[MAX_TESTS];
};

static Suite only;
static jmp_buf end_of_test;

Suite *suite_create(const char *name) {
    only.name = name;
    return &only;
}

TCase *tcase_create(const char *name) {
    (void)name;
    return &only;
}

void suite_add_tcase(Suite *suite, TCase *tcase) {
    (void)suite;
    (void)tcase;
}

void check_add_test(TCase *tcase, const char *name, void (*test)(void)) {
    if (tcase->count == MAX_TESTS) {
        platform_say("no room for another test\n");
        tcase->failed++;
        return;
    }
    tcase->tests[tcase->count].name = name;
    tcase->tests[tcase->count++].run = test;
}

SRunner *srunner_create(Suite *suite) {
    return suite;
}

void srunner_set_fork_status(SRunner *runner, int status) {
    (void)runner;
    (void)status;
}

void check_that(bool good, const char *claim, const char *file, const char *line) {
    if (!good) {
        const char *const texts[] = {file, ":", line, ": not so: ", claim, "\n"};
        for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
            platform_say(texts[i]);
        }
        longjmp(end_of_test, 1);
    }
}

static bool passes(void (*test)(void)) {
    if (setjmp(end_of_test) != 0) {
        return false;
    }
    test();
    return true;
}

void srunner_run_all(SRunner *runner, int verbosity) {
    (void)verbosity;
    for (int i = 0; i < runner->count; i++) {
        const bool passed = passes(runner->tests[i].run);
        runner->failed += !passed;
        platform_say(passed ? "passed " : "FAILED ");
        platform_say(runner->tests[i].name);
        platform_say("\n");
    }
}

int srunner_ntests_run(SRunner *runner) {
    return runner->count;
}

int srunner_ntests_failed(SRunner *runner) {
    return runner->failed;
}

void srunner_free(SRunner *runner) {
    (void)runner;
}
