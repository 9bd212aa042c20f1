/* Files against a disk that fails: fsync is this program's own. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "files.h"
#include "suite.h"

static char folder[64];
static char path[96];
static char error[ERROR_LENGTH]; /* of the newest failure */

static int interruptions; /* calls of fsync that a signal interrupts, then */
static int failures;      /* calls that fail for good */
static int calls;

int fsync(int descriptor) {
    calls++;
    if (interruptions > 0) {
        interruptions--;
        errno = EINTR;
        return -1;
    }
    if (failures > 0) {
        failures--;
        errno = EIO;
        return -1;
    }
    return (int)syscall(SYS_fsync, descriptor);
}

static void make_folder(void) {
    error[0] = '\0';
    interruptions = failures = calls = 0;
    snprintf(folder, sizeof folder, "/tmp/limphome_files_XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/file", folder);
    ck_assert(files_replace(path, "old", 3, error));
}

static void remove_folder(void) {
    unlink(path);
    ck_assert_int_eq(rmdir(folder), 0); /* nothing else was left in it */
}

static void expect_content(const char *expected) {
    unsigned char bytes[16];
    size_t size = 0;
    error[0] = '\0';
    ck_assert(files_read(path, bytes, sizeof bytes, &size, error));
    ck_assert_int_eq(size, strlen(expected));
    ck_assert_mem_eq(bytes, expected, size);
}

START_TEST(file_and_folder_are_brought_to_the_disk) {
    calls = 0;
    ck_assert(files_replace(path, "new", 3, error));
    ck_assert_int_eq(calls, 2);
    expect_content("new");
}
END_TEST

START_TEST(a_signal_while_the_disk_is_waited_for_does_no_harm) {
    interruptions = 3;
    ck_assert(files_replace(path, "new", 3, error));
    ck_assert_int_eq(interruptions, 0);
    expect_content("new");
}
END_TEST

START_TEST(a_disk_that_fails_is_told_and_the_old_file_stays) {
    failures = 1;
    ck_assert(!files_replace(path, "new", 3, error));
    ck_assert_ptr_nonnull(strstr(error, "file: Input/output error"));
    expect_content("old");
}
END_TEST

START_TEST(a_table_that_cannot_be_brought_to_the_disk_is_told) {
    FILE *file = fopen(path, "a");
    failures = 1;
    ck_assert(!files_sync(file, path, error));
    ck_assert_ptr_nonnull(strstr(error, "Input/output error"));
    fclose(file);
}
END_TEST

START_TEST(a_path_that_is_too_long_is_told) {
    char name[2 * FILES_PATH_LENGTH];
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    char joined[FILES_PATH_LENGTH];
    ck_assert(!files_join(joined, folder, name, error));
    ck_assert_ptr_nonnull(strstr(error, "too long"));
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("files");
    tcase_add_checked_fixture(cases, make_folder, remove_folder);
    tcase_add_test(cases, file_and_folder_are_brought_to_the_disk);
    tcase_add_test(cases, a_signal_while_the_disk_is_waited_for_does_no_harm);
    tcase_add_test(cases, a_disk_that_fails_is_told_and_the_old_file_stays);
    tcase_add_test(cases, a_table_that_cannot_be_brought_to_the_disk_is_told);
    tcase_add_test(cases, a_path_that_is_too_long_is_told);
    return run_suite("files", cases);
}
