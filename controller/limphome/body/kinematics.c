#include "limphome/body/kinematics.h"

#include "limphome/body/frame.h"

void lh_kinematics_posture(const lh_robot *robot, lh_quat attitude, const float *joint_angle, lh_posture *posture) {
    *posture = (lh_posture){.centre_of_mass = {0.0f, 0.0f, 0.0f}};
    lh_frame frames[LH_MAX_LINKS];
    lh_frames_of_links(robot, attitude, joint_angle, frames);
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
}
