#include "limphome/safety/collision.h"

#include "limphome/base/elementary.h"
#include "limphome/body/frame.h"
#include "limphome/safety/solid.h"

#define ROUNDING 1e-5f /* coming nearer by less is none [m] */

_Static_assert(LH_MAX_LINKS <= 32, "a bit for each link");

static bool is_good_size(float size) {
    return lh_within(size, 0.0f, LH_LENGTH_LIMIT);
}

static bool is_good_shape(const lh_shape *s, int32_t num_links) {
    const lh_quat *q = &s->rotation;
    float square = q->w * q->w + q->x * q->x + q->y * q->y + q->z * q->z;
    return s->link >= 0 && s->link < num_links && lh_within(square, 0.999f, 1.001f) &&
           lh_within(s->centre.x, -LH_LENGTH_LIMIT, LH_LENGTH_LIMIT) &&
           lh_within(s->centre.y, -LH_LENGTH_LIMIT, LH_LENGTH_LIMIT) &&
           lh_within(s->centre.z, -LH_LENGTH_LIMIT, LH_LENGTH_LIMIT) && is_good_size(s->half.x) &&
           is_good_size(s->half.y) && is_good_size(s->half.z) && is_good_size(s->radius);
}

lh_error lh_shapes_validate(const lh_shapes *shapes, const lh_robot *robot) {
    bool good = shapes->count >= 0 && shapes->count <= LH_MAX_SHAPES;
    for (int32_t i = 0; good && i < shapes->count; i++) {
        good = is_good_shape(&shapes->shape[i], robot->num_links);
    }
    return good ? LH_OK : LH_ERROR_ROBOT;
}

/* The robot in one posture. */
typedef struct posture {
    const lh_shapes *shapes;
    lh_frame frames[LH_MAX_LINKS];
} posture;

static void take_posture(const lh_robot *robot, const float *angle, posture *p) {
    lh_frames_of_links(robot, (lh_quat){1.0f, 0.0f, 0.0f, 0.0f}, angle, p->frames);
}

static lh_solid place(const posture *p, int32_t index) {
    const lh_shape *shape = &p->shapes->shape[index];
    const lh_frame *frame = &p->frames[shape->link];
    lh_quat rotation = lh_quat_multiply(frame->rotation, shape->rotation);
    return (lh_solid){
        .centre = lh_frame_point(frame, shape->centre),
        .x = lh_quat_rotate(rotation, (lh_vec3){1.0f, 0.0f, 0.0f}),
        .y = lh_quat_rotate(rotation, (lh_vec3){0.0f, 1.0f, 0.0f}),
        .z = lh_quat_rotate(rotation, (lh_vec3){0.0f, 0.0f, 1.0f}),
        .half = shape->half,
        .radius = shape->radius,
        .disc = shape->disc,
    };
}

static float distance(const posture *p, int32_t i, int32_t j, float enough) {
    lh_solid a = place(p, i);
    lh_solid b = place(p, j);
    return lh_solid_distance(&a, &b, enough);
}

/* Joints that move links against each other, bit by bit: those between a link and the root, of which what two have in
 * common moves neither against the other. */
static void find_chains(const lh_robot *robot, uint32_t moving, uint32_t *chain) {
    chain[0] = 0;
    for (int32_t i = 1; i < robot->num_links; i++) {
        const lh_link *link = &robot->links[i];
        uint32_t own = link->actuator >= 0 ? (uint32_t)1 << link->actuator : 0;
        chain[i] = chain[link->parent] | (own & moving);
    }
}

/* Of the joints in `chain`, those that have brought links together on the way from `now` to `then`. */
static uint32_t approaching(const posture *now, const posture *then, const uint32_t *chain, float clearance) {
    const lh_shapes *shapes = now->shapes;
    uint32_t joints = 0;
    for (int32_t i = 0; i < shapes->count; i++) {
        for (int32_t j = 0; j < i; j++) {
            int32_t a = shapes->shape[i].link;
            int32_t b = shapes->shape[j].link;
            uint32_t between = chain[a] ^ chain[b];
            if ((shapes->may_meet[a] >> b & 1u) == 0 || between == 0) {
                continue;
            }
            float left = distance(then, i, j, clearance);
            if (left < clearance && distance(now, i, j, left + ROUNDING) >= left + ROUNDING) {
                joints |= between;
            }
        }
    }
    return joints;
}

uint32_t lh_collision_joints(const lh_robot *robot, const lh_shapes *shapes, float clearance, const float *angle,
                             const float *next) {
    uint32_t chain[LH_MAX_LINKS];
    uint32_t moving = 0;
    float way = 0.0f;
    for (int32_t k = 0; k < robot->num_actuators; k++) {
        float own = robot->actuators[k].kind == LH_JOINT ? lh_magnitude(next[k] - angle[k]) : 0.0f;
        moving |= own > 0.0f ? (uint32_t)1 << k : 0;
        way += own;
    }
    if (moving == 0 || shapes->count == 0) {
        return 0;
    }
    find_chains(robot, moving, chain);
    posture now = {.shapes = shapes};
    posture then = {.shapes = shapes};
    take_posture(robot, angle, &now);
    int32_t places = 1 + (int32_t)lh_clip(way / LH_SWEEP_STEP, 0.0f, (float)(LH_SWEEP_MOST - 1));
    uint32_t joints = 0;
    for (int32_t i = 1; i <= places; i++) {
        float between[LH_MAX_ACTUATORS];
        float share = (float)i / (float)places;
        for (int32_t k = 0; k < robot->num_actuators; k++) {
            between[k] = angle[k] + share * (next[k] - angle[k]);
        }
        take_posture(robot, between, &then);
        joints |= approaching(&now, &then, chain, clearance);
    }
    return joints;
}
