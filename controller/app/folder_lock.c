#include "folder_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

#include "files.h"

enum { CONTROLLER_BYTE = 1 };

bool folder_lock_take(int *lock, const char *folder, char error[ERROR_LENGTH]) {
    char path[FILES_PATH_LENGTH];
    if (!files_join(path, folder, "lock", error)) {
        return false;
    }
    *lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (*lock < 0) {
        return files_fail(error, path);
    }
    struct flock wanted = {.l_type = F_WRLCK, .l_whence = SEEK_SET, .l_start = CONTROLLER_BYTE, .l_len = 1};
    if (fcntl(*lock, F_SETLK, &wanted) == 0) {
        return true;
    }
    if (errno != EAGAIN && errno != EACCES) {
        files_fail(error, path);
    } else if (fcntl(*lock, F_GETLK, &wanted) == 0 && wanted.l_type != F_UNLCK) {
        fail_with(error, "%.200s: process %ld works in this folder", folder, (long)wanted.l_pid);
    } else {
        fail_with(error, "%.200s: another process works in this folder", folder);
    }
    close(*lock);
    *lock = -1;
    return false;
}
