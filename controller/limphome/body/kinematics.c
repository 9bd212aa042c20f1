#include "limphome/body/kinematics.h"

/* A frame: where its origin is and how it is turned. */
typedef struct frame {
    lh_vec3 origin;
    lh_quat rotation;
} frame;

static lh_vec3 in_world(const frame *f, lh_vec3 point) {
    return lh_vec3_add(f->origin, lh_quat_rotate(f->rotation, point));
}

/* The frame of `link` in the world, given that of its parent. */
static frame child_frame(const frame *parent, const lh_link *link, const float *joint_angle) {
    frame child = {in_world(parent, link->origin), lh_quat_multiply(parent->rotation, link->rotation)};
    if (link->actuator >= 0) {
        lh_quat turn = lh_quat_about(link->axis, joint_angle[link->actuator]);
        child.rotation = lh_quat_multiply(child.rotation, turn);
    }
    /* against the growth of rounding along the chain */
    child.rotation = lh_quat_normalise(child.rotation);
    return child;
}

void lh_kinematics_posture(const lh_robot *robot, lh_quat attitude, const float *joint_angle, lh_posture *posture) {
    *posture = (lh_posture){.centre_of_mass = {0.0f, 0.0f, 0.0f}};
    frame frames[LH_MAX_LINKS] = {{.rotation = attitude}};
    float mass = 0.0f;
    lh_vec3 moment = {0.0f, 0.0f, 0.0f};
    for (int32_t i = 0; i < robot->num_links; i++) {
        const lh_link *link = &robot->links[i];
        if (i > 0) {
            frames[i] = child_frame(&frames[link->parent], link, joint_angle);
        }
        moment = lh_vec3_add(moment, lh_vec3_scale(in_world(&frames[i], link->centre), link->mass));
        mass += link->mass;
    }
    posture->centre_of_mass = lh_vec3_scale(moment, 1.0f / mass);

    for (int32_t i = 0; i < robot->num_supports; i++) {
        const lh_support *support = &robot->supports[i];
        posture->supports[i] = in_world(&frames[support->link], support->point);
        posture->supports[i].z -= support->radius;
    }
}
