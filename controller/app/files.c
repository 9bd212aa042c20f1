#include "files.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

bool files_fail(char error[ERROR_LENGTH], const char *path) {
    const int reason = errno;
    return fail_with(error, "%.200s: %s", path, strerror(reason));
}

bool files_join(char path[FILES_PATH_LENGTH], const char *folder, const char *name, char error[ERROR_LENGTH]) {
    const int length = snprintf(path, FILES_PATH_LENGTH, "%s/%s", folder, name);
    return length < FILES_PATH_LENGTH || fail_with(error, "%.200s: the path is too long", folder);
}

/* A signal may come while the disk is waited for. */
static bool sync_descriptor(int descriptor) {
    int result;
    do {
        result = fsync(descriptor);
    } while (result != 0 && errno == EINTR);
    return result == 0;
}

bool files_sync(FILE *file, const char *path, char error[ERROR_LENGTH]) {
    return (fflush(file) == 0 && sync_descriptor(fileno(file))) || files_fail(error, path);
}

bool files_cut(FILE *file, const char *path, int64_t end, char error[ERROR_LENGTH]) {
    return (fflush(file) == 0 && ftruncate(fileno(file), (off_t)end) == 0 && fseeko(file, 0, SEEK_END) == 0 &&
            sync_descriptor(fileno(file))) ||
           files_fail(error, path);
}

/* Brings the names in the folder of `path` to the disk, where its file system can do that. */
static bool sync_folder_of(const char *path) {
    char folder[FILES_PATH_LENGTH + 8];
    snprintf(folder, sizeof folder, "%s", path);
    char *slash = strrchr(folder, '/');
    if (slash != NULL) {
        slash[slash == folder] = '\0';
    }
    const int descriptor = open(slash == NULL ? "." : folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    const bool good = sync_descriptor(descriptor) || errno == EINVAL;
    close(descriptor);
    return good;
}

bool files_put_in_place(const char *fresh, const char *path, char error[ERROR_LENGTH]) {
    return (rename(fresh, path) == 0 && sync_folder_of(path)) || files_fail(error, path);
}

bool files_replace(const char *path, const void *data, size_t size, char error[ERROR_LENGTH]) {
    char fresh[FILES_PATH_LENGTH + 8];
    snprintf(fresh, sizeof fresh, "%s.new", path);
    FILE *file = fopen(fresh, "wb");
    if (file == NULL) {
        return files_fail(error, fresh);
    }
    const bool written = fwrite(data, 1, size, file) == size || files_fail(error, path);
    const bool synced = written && files_sync(file, path, error);
    const bool closed = fclose(file) == 0 || files_fail(error, path);
    if (synced && closed && files_put_in_place(fresh, path, error)) {
        return true;
    }
    remove(fresh);
    return false;
}

bool files_read(const char *path, unsigned char *bytes, size_t capacity, size_t *size, char error[ERROR_LENGTH]) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return files_fail(error, path);
    }
    *size = fread(bytes, 1, capacity, file);
    const bool good = !ferror(file) || files_fail(error, path);
    fclose(file);
    return good;
}
