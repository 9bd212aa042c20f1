/* Robots made by edits of config/crawler.urdf. */
#ifndef LIMPHOME_TEST_EDITED_H
#define LIMPHOME_TEST_EDITED_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "robot_file.h"
#include "suite.h"

enum { EDITED_LENGTH = 65536 };

struct edited {
    char path[64], text[EDITED_LENGTH];
    robot_description robot;
    robot_report report;
    bool good;
};

/* To be edited by edited_replace and then read. */
static inline void edited_begin(struct edited *e) {
    memset(e, 0, sizeof *e);
    FILE *file = fopen(CONFIG_DIR "/crawler.urdf", "r");
    ck_assert_ptr_nonnull(file);
    e->text[fread(e->text, 1, sizeof e->text - 1, file)] = '\0';
    fclose(file);
}

/* The first `from` gives way to `to`. */
static inline void edited_replace(struct edited *e, const char *from, const char *to) {
    char *at = strstr(e->text, from);
    ck_assert_msg(at != NULL, "the robot file no longer holds %s", from);
    const size_t rest = strlen(at + strlen(from)) + 1;
    ck_assert_uint_lt(strlen(e->text) + strlen(to), sizeof e->text);
    memmove(at + strlen(to), at + strlen(from), rest);
    for (const char *c = to; *c != '\0'; c++) {
        *at++ = *c;
    }
}

/* Also checks what holds of every reading: a report of one line a remark, each with the file; a refused robot is not
 * touched. To be ended by edited_end. */
static inline void edited_read(struct edited *e) {
    strcpy(e->path, "/tmp/limphome_edited_XXXXXX");
    const int fd = mkstemp(e->path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, e->text, strlen(e->text)), (ssize_t)strlen(e->text));
    close(fd);
    memset(&e->robot, 7, sizeof e->robot);
    static unsigned char before[sizeof e->robot];
    memset(before, 7, sizeof before);
    e->good = robot_file_read(e->path, NULL, &e->robot, &e->report);
    unlink(e->path);
    ck_assert_int_eq(e->good, e->report.num_faults == 0);
    if (!e->good) {
        ck_assert_mem_eq(&e->robot, before, sizeof before);
    }
    for (int i = 0; i < e->report.num_faults; i++) {
        ck_assert_int_eq(strncmp(e->report.faults[i], e->path, strlen(e->path)), 0);
        ck_assert_ptr_null(strchr(e->report.faults[i], '\n'));
    }
}

static inline void edited_end(struct edited *e) {
    robot_report_free(&e->report);
}

/* Whether one of the lines holds the words. */
static inline bool edited_says(char *const *lines, int count, const char *words) {
    for (int i = 0; i < count; i++) {
        if (strstr(lines[i], words) != NULL) {
            return true;
        }
    }
    return false;
}

static inline void edited_expect_fault(const struct edited *e, const char *words) {
    ck_assert_msg(!e->good, "was accepted, but lacks \"%s\"", words);
    ck_assert_msg(edited_says(e->report.faults, e->report.num_faults, words), "\"%s\" lacks \"%s\"",
                  e->report.faults[0], words);
}

static inline void edited_expect_good(const struct edited *e) {
    ck_assert_msg(e->good, "%s", e->good ? "" : e->report.faults[0]);
}

static inline void edited_expect_notice(const struct edited *e, const char *words) {
    edited_expect_good(e);
    ck_assert_msg(edited_says(e->report.notices, e->report.num_notices, words), "%d notices, none with \"%s\"",
                  e->report.num_notices, words);
}

#endif
