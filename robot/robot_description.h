/* The robot as its file describes it, once read and checked: rigid bodies, actuators, crawlers, what may touch, and
 * what it can stand on. Both programs build on this and on nothing else of the file, so to both it is the same robot.
 *
 * Links that do not move against each other are merged: there is one body for the base and one per actuator. Body 0 is
 * the base; actuator a moves body a + 1. The frame of the base is the body frame of the messages, found from the
 * crawlers wherever the file has its base frame: x forward, y left, z up, origin on the ground midway between the
 * crawlers. The frame of any other body is that of the link its joint moves.
 *
 * Lengths in m, angles in rad, masses in kg, torques in N m. All numbers are finite. Quaternions are (w, x, y, z). */
#ifndef LIMPHOME_ROBOT_DESCRIPTION_H
#define LIMPHOME_ROBOT_DESCRIPTION_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    ROBOT_CRAWLERS = 2,      /* left, right */
    ROBOT_MAX_ACTUATORS = 8, /* as in the messages */
    ROBOT_MAX_BODIES = ROBOT_MAX_ACTUATORS + 1,
    ROBOT_MAX_SHAPES = 64,
    ROBOT_MAX_SUPPORTS = 12,
    ROBOT_NAME_LENGTH = 64, /* with the zero at the end */
};

typedef struct robot_pose {
    double position[3];
    double rotation[4]; /* unit */
} robot_pose;

typedef struct robot_body {
    char name[ROBOT_NAME_LENGTH]; /* of the link that its joint moves; of the root link */
    int parent;                   /* body it hangs on, less than its own index; -1: base */
    robot_pose joint;             /* its frame in the parent's at joint angle 0 */
    double axis[3];               /* of its joint in its frame, unit; positive turning of a sprocket drives forward */
    double mass;                  /* above 0 */
    double centre[3];             /* of mass, in its frame */
    double inertia[3][3];         /* about the centre of mass, axes of its frame [kg m^2] */
} robot_body;

typedef struct robot_actuator {
    char name[ROBOT_NAME_LENGTH]; /* of the joint */
    double lower, upper;          /* joint: least and largest angle, lower below upper; crawler: both 0, not used */
    double effort;                /* largest torque, above 0 */
    double speed;                 /* largest rate, above 0 [rad/s] */
    double home;                  /* angle of the initial pose, within the limits; crawler: 0 */
} robot_actuator;

/* Belt of `radius` round both ends, rigid with the base; its sprocket is actuator 0, left, or 1, right. It stands on
 * z = 0. */
typedef struct robot_crawler {
    double centre[3]; /* in the frame of the base */
    double axis[3];   /* of the sprocket, in the frame of the base, unit, to the left */
    double length;    /* over all, at least 2 radius */
    double width;     /* above 0 */
    double radius;    /* above 0, belt included */
} robot_crawler;

typedef enum robot_shape_kind { ROBOT_SPHERE, ROBOT_BOX, ROBOT_CYLINDER } robot_shape_kind;

/* A part of a body that may touch the ground and, where `may_meet` says so, other bodies. Belts are none of these. */
typedef struct robot_shape {
    char name[ROBOT_NAME_LENGTH]; /* of its link */
    int body;
    robot_shape_kind kind;
    robot_pose pose;     /* its middle, in the frame of the body; a cylinder is round z */
    double half_size[3]; /* box: along x, y, z; sphere: the radius, thrice; cylinder: radius, radius, half length */
} robot_shape;

/* A point on which the robot can stand, with a ball of `radius`, 0 or more, round it. */
typedef struct robot_support {
    int body;
    double point[3]; /* in the frame of the body */
    double radius;
} robot_support;

typedef struct robot_description {
    char name[ROBOT_NAME_LENGTH];
    int num_actuators; /* crawlers left, right, then at least one arm joint, from root to tip */
    int num_bodies;    /* num_actuators + 1 */
    int num_shapes;
    int num_supports; /* tips first, as in the file; then those listed or, where none is, the ends of the belts' outer
                         edges: front left, rear left, rear right, front right */
    int num_tips;     /* the first of the shapes are the tips' balls, at the first of the supports */
    robot_body bodies[ROBOT_MAX_BODIES];
    robot_actuator actuators[ROBOT_MAX_ACTUATORS];
    robot_crawler crawlers[ROBOT_CRAWLERS];
    robot_shape shapes[ROBOT_MAX_SHAPES];
    robot_support supports[ROBOT_MAX_SUPPORTS];

    /* Contact between bodies: symmetric, false on the diagonal, between a body and the one it hangs on, for sprockets,
     * and for pairs that the file excepts. The belts belong to the base. */
    bool may_meet[ROBOT_MAX_BODIES][ROBOT_MAX_BODIES];

    uint64_t hash; /* of the file's bytes (FNV-1a) */
} robot_description;

#ifdef __cplusplus
}
#endif
#endif
