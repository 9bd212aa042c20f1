#include "crawler.h"

static const lh_quat no_rotation = {1.0f, 0.0f, 0.0f, 0.0f};

static lh_link fixed_mass(lh_vec3 origin, float mass) {
    return (lh_link){.parent = 0, .actuator = -1, .origin = origin, .rotation = no_rotation, .mass = mass};
}

lh_robot crawler_robot(void) {
    const lh_vec3 up = {0.0f, 0.0f, 1.0f};
    const lh_vec3 right = {0.0f, -1.0f, 0.0f};
    lh_robot robot = {
        .num_actuators = 5,
        .num_links = 6,
        .num_supports = 5,
        .actuators = {{LH_CRAWLER, 0.0f, 0.0f, 1000.0f},
                      {LH_CRAWLER, 0.0f, 0.0f, 1000.0f},
                      {LH_JOINT, -2.6f, 2.6f, 3000.0f},
                      {LH_JOINT, -0.6f, 1.2f, 6000.0f},
                      {LH_JOINT, -2.4f, 0.0f, 4000.0f}},
        .supports = {{0, {0.62f, 0.625f, 0.0f}, 0.0f},
                     {0, {-0.62f, 0.625f, 0.0f}, 0.0f},
                     {0, {-0.62f, -0.625f, 0.0f}, 0.0f},
                     {0, {0.62f, -0.625f, 0.0f}, 0.0f},
                     {5, {0.8f, 0.0f, 0.0f}, 0.08f}},
    };
    robot.links[0] = (lh_link){-1, -1, {0, 0, 0}, no_rotation, up, 498.0f, {0.0f, 0.0f, 0.3f}};
    robot.links[1] = fixed_mass((lh_vec3){-0.62f, 0.475f, 0.18f}, 1.0f);
    robot.links[2] = fixed_mass((lh_vec3){-0.62f, -0.475f, 0.18f}, 1.0f);
    robot.links[3] = (lh_link){0, 2, {0, 0, 0.5f}, no_rotation, up, 350.0f, {-0.1f, 0.0f, 0.35f}};
    robot.links[4] = (lh_link){3, 3, {0.4f, 0, 0.3f}, no_rotation, right, 60.0f, {0.55f, 0.0f, 0.0f}};
    robot.links[5] = (lh_link){4, 4, {1.1f, 0, 0}, no_rotation, right, 35.0f, {0.4f, 0.0f, 0.0f}};
    return robot;
}

lh_robot scaled_robot(const lh_robot *robot, float factor) {
    lh_robot scaled = *robot;
    for (int32_t i = 0; i < scaled.num_links; i++) {
        scaled.links[i].origin = lh_vec3_scale(scaled.links[i].origin, factor);
        scaled.links[i].centre = lh_vec3_scale(scaled.links[i].centre, factor);
    }
    for (int32_t i = 0; i < scaled.num_supports; i++) {
        scaled.supports[i].point = lh_vec3_scale(scaled.supports[i].point, factor);
        scaled.supports[i].radius *= factor;
    }
    return scaled;
}

lh_controlled crawler_controlled(void) {
    return (lh_controlled){.count = 4, .index = {1, 2, 3, 4}};
}

lh_state crawler_state(float x, float y, float heading) {
    return (lh_state){
        .position = {x, y, 0.0f},
        .orientation = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, heading),
        .num_actuators = 5,
        .actuator_position = {0.0f, 0.0f, 0.0f, 0.6f, -1.5f},
    };
}
