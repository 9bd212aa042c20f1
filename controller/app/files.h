/* Files that survive a fault at any moment: replaced whole or not at all, on the disk once it says so. All of these
 * return false with file and reason in `error`. */
#ifndef LIMPHOME_APP_FILES_H
#define LIMPHOME_APP_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "fail.h"

enum { FILES_PATH_LENGTH = 512 };

/* FOLDER/NAME. */
bool files_join(char path[FILES_PATH_LENGTH], const char *folder, const char *name, char error[ERROR_LENGTH]);

/* The reason is what a call of the system has left in errno. Always false. */
bool files_fail(char error[ERROR_LENGTH], const char *path);

/* Gives the file `fresh`, which is on the disk, the name of the file `path`. */
bool files_put_in_place(const char *fresh, const char *path, char error[ERROR_LENGTH]);

/* Puts `size` bytes in the place of the file `path`: written beside it, brought to the disk, renamed. A reader or a
 * crash meets the old file or the new one. */
bool files_replace(const char *path, const void *data, size_t size, char error[ERROR_LENGTH]);

/* Reads a file of at most `capacity` bytes; of a larger one the beginning. */
bool files_read(const char *path, unsigned char *bytes, size_t capacity, size_t *size, char error[ERROR_LENGTH]);

/* Brings what was written to the disk. */
bool files_sync(FILE *file, const char *path, char error[ERROR_LENGTH]);

/* Cuts a file that is open for appending to its first `end` bytes. */
bool files_cut(FILE *file, const char *path, int64_t end, char error[ERROR_LENGTH]);

#endif
