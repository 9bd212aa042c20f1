/* The robot as the controller knows it: actuators, links with masses, points it can stand on.
 * Body frame: x forward, y left, z up, origin on the ground midway between the crawlers; it is the frame of link 0. */
#ifndef LIMPHOME_ROBOT_H
#define LIMPHOME_ROBOT_H

#include <stdint.h>

#include "limphome/base/capacity.h"
#include "limphome/base/error.h"
#include "limphome/base/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Largest magnitudes that make sense, so that no sum can overflow. */
#define LH_ANGLE_LIMIT 100.0f   /* of a joint [rad] */
#define LH_LENGTH_LIMIT 1000.0f /* of a coordinate or radius [m] */
#define LH_MASS_LIMIT 1e6f      /* of a link [kg] */
#define LH_EFFORT_LIMIT 1e9f    /* of an actuator's effort_limit [N*m] */
#define LH_LEAST_MASS 1e-6f     /* of the robot [kg], so that its reciprocal is finite */

typedef enum lh_actuator_kind { LH_CRAWLER = 0, LH_JOINT = 1 } lh_actuator_kind;

typedef struct lh_actuator {
    lh_actuator_kind kind;
    float low;          /* joint: least angle [rad]; crawler: unused, 0 */
    float high;         /* joint: largest angle, above low [rad]; crawler: unused, 0 */
    float effort_limit; /* largest torque, above 0 [N*m] */
} lh_actuator;

/* Of link 0, parent and actuator are -1, and origin, rotation and axis are not read. */
typedef struct lh_link {
    int32_t parent;   /* link it hangs on, less than its own index; -1 for link 0 only */
    int32_t actuator; /* joint that turns it about `axis`; -1: fixed to the parent (so are sprockets: turning them
                         moves no mass) */
    lh_vec3 origin;   /* of the link's frame in the parent's frame [m] */
    lh_quat rotation; /* of the link's frame in the parent's frame at joint angle 0 */
    lh_vec3 axis;     /* of the joint in the link's frame, unit length */
    float mass;       /* 0 or more [kg] */
    lh_vec3 centre;   /* centre of mass in the link's frame [m] */
} lh_link;

typedef struct lh_support {
    int32_t link;
    lh_vec3 point; /* in the link's frame [m] */
    float radius;  /* of a ball round it, 0 for a point [m]; it stands on the ball's lowest point */
} lh_support;

typedef struct lh_robot {
    int32_t num_actuators;                   /* 1 to LH_MAX_ACTUATORS */
    int32_t num_links;                       /* 1 to LH_MAX_LINKS */
    int32_t num_supports;                    /* 3 to LH_MAX_SUPPORTS */
    lh_actuator actuators[LH_MAX_ACTUATORS]; /* [num_actuators], crawlers first */
    lh_link links[LH_MAX_LINKS];             /* [num_links], each after its parent */
    lh_support supports[LH_MAX_SUPPORTS];    /* [num_supports] */
} lh_robot;

/* LH_OK, or LH_ERROR_ACTUATORS or LH_ERROR_ROBOT where a rule above is broken or a magnitude above its limit; the total
 * mass must be LH_LEAST_MASS or more. */
lh_error lh_robot_validate(const lh_robot *robot);

/* How many times as large as the paper's robot, LH_SCALE_MIN to LH_SCALE_MAX: how far the supports of its base are from
 * its middle, forward or sideways, over 0.625 m. What counts as small or near is so against the robot, not in metres.
 */
float lh_robot_scale(const lh_robot *robot);

#define LH_SCALE_MIN 0.001f
#define LH_SCALE_MAX 1000.0f

#ifdef __cplusplus
}
#endif
#endif
