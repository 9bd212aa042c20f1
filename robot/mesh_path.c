#include "mesh_path.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_LENGTH = 4096, MOST_FOLDERS_ABOVE = 32 };

static bool is_file(const char *path) {
    struct stat found;
    return stat(path, &found) == 0 && S_ISREG(found.st_mode);
}

/* The first of FOLDER/NAME and FOLDER/REST that is a file, REST being NAME without its first folder. */
static bool is_in(const char *folder, const char *name, char path[PATH_LENGTH]) {
    const char *rest = strchr(name, '/');
    if (snprintf(path, PATH_LENGTH, "%s/%s", folder, name) < PATH_LENGTH && is_file(path)) {
        return true;
    }
    return rest != NULL && snprintf(path, PATH_LENGTH, "%s%s", folder, rest) < PATH_LENGTH && is_file(path);
}

static bool is_in_packages(const char *packages, const char *name, char path[PATH_LENGTH]) {
    for (const char *at = packages; at != NULL && *at != '\0';) {
        const size_t length = strcspn(at, ":");
        char folder[PATH_LENGTH];
        if (length > 0 && length < sizeof folder) {
            memcpy(folder, at, length);
            folder[length] = '\0';
            if (is_in(folder, name, path)) {
                return true;
            }
        }
        at += length + (at[length] == ':');
    }
    return false;
}

static bool is_above(const char *folder, const char *name, char path[PATH_LENGTH]) {
    char above[PATH_LENGTH];
    snprintf(above, sizeof above, "%s", folder);
    for (int i = 0; i < MOST_FOLDERS_ABOVE; i++) {
        if (is_in(above, name, path)) {
            return true;
        }
        char *end = strrchr(above, '/');
        if (end == NULL) {
            return false;
        }
        *end = '\0'; /* of the root folder "" is left, which is what goes before a '/' */
    }
    return false;
}

/* What follows `scheme` in a name, or NULL if it does not begin with it. */
static const char *after(const char *name, const char *scheme) {
    const size_t length = strlen(scheme);
    return strncmp(name, scheme, length) == 0 ? name + length : NULL;
}

/* A path of another machine: its end may be found as a package's, the longest first. */
static bool is_tail(const char *folder, const char *packages, const char *name, char path[PATH_LENGTH]) {
    for (const char *slash = strchr(name, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        const char *tail = slash + 1;
        if (strchr(tail, '/') != NULL && (is_in_packages(packages, tail, path) || is_above(folder, tail, path))) {
            return true;
        }
    }
    return false;
}

static bool find(const char *folder, const char *packages, const char *name, const char *copy, char path[PATH_LENGTH]) {
    if (snprintf(path, PATH_LENGTH, "%s/%s", folder, copy) < PATH_LENGTH && is_file(path)) {
        return true;
    }
    const char *in_package = after(name, "package://");
    if (in_package == NULL) {
        in_package = after(name, "model://");
    }
    if (in_package != NULL) {
        return is_in_packages(packages, in_package, path) || is_above(folder, in_package, path);
    }
    const char *plain = after(name, "file://");
    plain = plain == NULL ? name : plain;
    const int length = plain[0] == '/' ? snprintf(path, PATH_LENGTH, "%s", plain)
                                       : snprintf(path, PATH_LENGTH, "%s/%s", folder, plain);
    return (length < PATH_LENGTH && is_file(path)) || is_tail(folder, packages, plain, path);
}

const char *mesh_copy(struct reading *r, const char *name) {
    static const char folder[] = "robot_meshes/", digits[] = "0123456789abcdef";
    char *copy = arena_take(&r->arena, sizeof folder + 3 * strlen(name), 1);
    memcpy(copy, folder, sizeof folder);
    char *end = copy + strlen(folder);
    for (const char *c = name; *c != '\0'; c++) {
        const unsigned char byte = (unsigned char)*c;
        if (isalnum(byte) || byte == '.' || byte == '-') {
            *end++ = *c;
        } else { /* no two names may share a copy */
            *end++ = '_';
            *end++ = digits[byte / 16];
            *end++ = digits[byte % 16];
        }
    }
    return copy;
}

char *mesh_path(struct reading *r, const char *name) {
    char folder[PATH_MAX], path[PATH_LENGTH];
    if (realpath(r->path, folder) == NULL) {
        return NULL;
    }
    *strrchr(folder, '/') = '\0';
    return find(folder, r->packages, name, mesh_copy(r, name), path) ? arena_copy(&r->arena, path) : NULL;
}
