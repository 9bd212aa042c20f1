/* The elements of a URDF file as they stand there, in any order: what expat's events are gathered into before urdf.c
 * makes a robot of them. */
#ifndef LIMPHOME_APP_URDF_ELEMENTS_H
#define LIMPHOME_APP_URDF_ELEMENTS_H

#include <expat.h>
#include <stdbool.h>
#include <stdio.h>

#include "urdf.h"

enum { URDF_MAX_JOINTS = LH_MAX_LINKS, URDF_CRAWLERS = 2 };

struct urdf_link {
    char name[URDF_NAME_LENGTH];
    float mass;
    lh_vec3 centre;
};

struct urdf_joint {
    char name[URDF_NAME_LENGTH];
    char parent[URDF_NAME_LENGTH];
    char child[URDF_NAME_LENGTH];
    lh_vec3 origin;
    lh_quat rotation;
    lh_vec3 axis;
    bool limited; /* has low and high, that is, is revolute */
    float low, high, effort;
};

struct urdf_support {
    char link[URDF_NAME_LENGTH];
    lh_vec3 point;
    float radius;
};

struct urdf_reading {
    XML_Parser parser;
    uint64_t hash; /* FNV-1a of the bytes read */
    const char *path;
    char *error;
    bool failed;
    bool extended; /* <limphome> was there */

    /* the element under way */
    int depth; /* 1: child of <robot> */
    bool in_extension;
    struct urdf_link *in_link;
    struct urdf_joint *in_joint;
    bool in_inertial;

    int num_links, num_joints, num_crawlers, num_arm, num_supports;
    struct urdf_link links[LH_MAX_LINKS];
    struct urdf_joint joints[URDF_MAX_JOINTS];
    char crawlers[URDF_CRAWLERS][URDF_NAME_LENGTH];
    char arm[LH_MAX_ACTUATORS][URDF_NAME_LENGTH];
    struct urdf_support supports[LH_MAX_SUPPORTS];
};

/* Reads all elements of `file`; reading->failed and reading->error tell of the first thing wrong. */
void urdf_read_elements(struct urdf_reading *reading, FILE *file);

/* Notes the first error, with file and line; later ones are dropped. */
__attribute__((format(printf, 2, 3))) void urdf_fail(struct urdf_reading *reading, const char *format, ...);

#endif
