/* Frames of the robot's links, from joint angles. Inline, so that they take no stack of their own where it is deepest.
 */
#ifndef LIMPHOME_FRAME_H
#define LIMPHOME_FRAME_H

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a link is and how it is turned. */
typedef struct lh_frame {
    lh_vec3 origin;
    lh_quat rotation;
} lh_frame;

/* A point of the frame, where the frame is seen from. */
static inline lh_vec3 lh_frame_point(const lh_frame *frame, lh_vec3 point) {
    return lh_vec3_add(frame->origin, lh_quat_rotate(frame->rotation, point));
}

/* That of `link`, given that of its parent. */
static inline lh_frame lh_frame_of_child(const lh_frame *parent, const lh_link *link, const float *joint_angle) {
    lh_frame child;
    child.origin = lh_frame_point(parent, link->origin);
    child.rotation = lh_quat_multiply(parent->rotation, link->rotation);
    if (link->actuator >= 0) {
        lh_quat turn = lh_quat_about(link->axis, joint_angle[link->actuator]);
        child.rotation = lh_quat_multiply(child.rotation, turn);
    }
    /* against the growth of rounding along the chain */
    child.rotation = lh_quat_normalise(child.rotation);
    return child;
}

/* The frames of all links, frames[robot->num_links], with the body's origin and `attitude`. */
static inline void lh_frames_of_links(const lh_robot *robot, lh_quat attitude, const float *joint_angle,
                                      lh_frame *frames) {
    const lh_vec3 origin = {0.0f, 0.0f, 0.0f};
    int32_t i; /* declared here for callers in older C */
    frames[0].origin = origin;
    frames[0].rotation = attitude;
    for (i = 1; i < robot->num_links; i++) {
        const lh_link *link = &robot->links[i];
        frames[i] = lh_frame_of_child(&frames[link->parent], link, joint_angle);
    }
}

#ifdef __cplusplus
}
#endif
#endif
