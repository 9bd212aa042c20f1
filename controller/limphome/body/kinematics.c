#include "limphome/body/kinematics.h"

lh_vec3 lh_frame_point(const lh_frame *frame, lh_vec3 point) {
    return lh_vec3_add(frame->origin, lh_quat_rotate(frame->rotation, point));
}

/* The frame of `link` in the world, given that of its parent. */
static lh_frame child_frame(const lh_frame *parent, const lh_link *link, const float *joint_angle) {
    lh_frame child = {lh_frame_point(parent, link->origin), lh_quat_multiply(parent->rotation, link->rotation)};
    if (link->actuator >= 0) {
        lh_quat turn = lh_quat_about(link->axis, joint_angle[link->actuator]);
        child.rotation = lh_quat_multiply(child.rotation, turn);
    }
    /* against the growth of rounding along the chain */
    child.rotation = lh_quat_normalise(child.rotation);
    return child;
}

void lh_kinematics_frames(const lh_robot *robot, lh_quat attitude, const float *joint_angle, lh_frame *frames) {
    frames[0] = (lh_frame){.rotation = attitude};
    for (int32_t i = 1; i < robot->num_links; i++) {
        const lh_link *link = &robot->links[i];
        frames[i] = child_frame(&frames[link->parent], link, joint_angle);
    }
}

/* Supports within `tolerance` of the lowest. */
static void find_carrying(const lh_robot *robot, float tolerance, lh_posture *posture) {
    float lowest = posture->supports[0].z;
    for (int32_t i = 1; i < robot->num_supports; i++) {
        lowest = posture->supports[i].z < lowest ? posture->supports[i].z : lowest;
    }
    for (int32_t i = 0; i < robot->num_supports; i++) {
        if (posture->supports[i].z - lowest <= tolerance) {
            posture->carrying[posture->num_carrying++] = i;
        }
    }
}

void lh_kinematics_posture(const lh_robot *robot, lh_quat attitude, const float *joint_angle, float tolerance,
                           lh_posture *posture) {
    *posture = (lh_posture){.num_carrying = 0};
    lh_frame frames[LH_MAX_LINKS];
    lh_kinematics_frames(robot, attitude, joint_angle, frames);
    float mass = 0.0f;
    lh_vec3 moment = {0.0f, 0.0f, 0.0f};
    for (int32_t i = 0; i < robot->num_links; i++) {
        const lh_link *link = &robot->links[i];
        moment = lh_vec3_add(moment, lh_vec3_scale(lh_frame_point(&frames[i], link->centre), link->mass));
        mass += link->mass;
    }
    posture->centre_of_mass = lh_vec3_scale(moment, 1.0f / mass);

    for (int32_t i = 0; i < robot->num_supports; i++) {
        const lh_support *support = &robot->supports[i];
        posture->supports[i] = lh_frame_point(&frames[support->link], support->point);
        posture->supports[i].z -= support->radius;
    }
    find_carrying(robot, tolerance, posture);
}
