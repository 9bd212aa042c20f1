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

static lh_shape shape_box(int16_t link, lh_vec3 centre, lh_vec3 half) {
    return (lh_shape){.link = link, .centre = centre, .rotation = no_rotation, .half = half};
}

static lh_shape shape_ball(int16_t link, lh_vec3 centre, float radius) {
    return (lh_shape){.link = link, .centre = centre, .rotation = no_rotation, .radius = radius};
}

static lh_shape shape_belt(float y) {
    const float half = 0.70710678f; /* a quarter of a turn about x, which brings z to -y */
    return (lh_shape){.centre = {0.0f, y, 0.18f},
                      .rotation = {half, half, 0.0f, 0.0f},
                      .half = {0.62f, 0.0f, 0.15f},
                      .radius = 0.18f,
                      .disc = true};
}

lh_shapes crawler_shapes(void) {
    const lh_shape all[] = {
        shape_belt(0.475f),
        shape_belt(-0.475f),
        shape_ball(5, (lh_vec3){0.8f, 0.0f, 0.0f}, 0.08f),
        shape_box(5, (lh_vec3){0.4f, 0.0f, 0.0f}, (lh_vec3){0.35f, 0.06f, 0.06f}),
        shape_box(3, (lh_vec3){-0.1f, 0.0f, 0.43f}, (lh_vec3){0.5f, 0.4f, 0.43f}),
        shape_box(4, (lh_vec3){0.55f, 0.0f, 0.0f}, (lh_vec3){0.5f, 0.07f, 0.08f}),
        shape_ball(4, (lh_vec3){1.1f, 0.0f, 0.0f}, 0.08f),
        shape_box(0, (lh_vec3){0.0f, 0.0f, 0.3f}, (lh_vec3){0.6f, 0.325f, 0.15f}),
    };
    lh_shapes shapes = {.may_meet = {[0] = 1u << 4 | 1u << 5, [3] = 1u << 5, [4] = 1u << 0, [5] = 1u << 0 | 1u << 3}};
    for (int32_t i = 0; i < (int32_t)(sizeof all / sizeof all[0]) && i < LH_MAX_SHAPES; i++) {
        shapes.shape[shapes.count++] = all[i];
    }
    return shapes;
}
