#include "limphome/safety/solid.h"

#include "limphome/base/elementary.h"

#define NO_DIRECTION 1e-8f /* square of a length that is all rounding: of axes that span no plane, say */
#define PROJECTIONS 16     /* back and forth between two solids */

static float half_width(const lh_solid *s, lh_vec3 direction) {
    float along_z = lh_vec3_dot(s->z, direction);
    float across = s->disc ? lh_clip(1.0f - along_z * along_z, 0.0f, 1.0f) : 1.0f;
    return s->half.x * lh_magnitude(lh_vec3_dot(s->x, direction)) +
           s->half.y * lh_magnitude(lh_vec3_dot(s->y, direction)) + s->half.z * lh_magnitude(along_z) +
           s->radius * lh_sqrt(across);
}

/* Two solids, and the most that a direction has shown so far. */
typedef struct search {
    const lh_solid *a, *b;
    lh_vec3 between; /* from the centre of b to that of a */
    float distance;
} search;

/* Any direction shows that the solids are at least so far apart: the best of many is what is looked for. */
static void try_direction(search *s, lh_vec3 direction) {
    float square = lh_vec3_dot(direction, direction);
    if (square >= NO_DIRECTION) {
        lh_vec3 normal = lh_vec3_scale(direction, 1.0f / lh_sqrt(square));
        float distance =
            lh_magnitude(lh_vec3_dot(s->between, normal)) - half_width(s->a, normal) - half_width(s->b, normal);
        s->distance = distance > s->distance ? distance : s->distance;
    }
}

static void try_faces(search *s, const lh_solid *of) {
    try_direction(s, of->x);
    try_direction(s, of->y);
    try_direction(s, of->z);
}

static void try_edges(search *s, lh_vec3 edge) {
    try_direction(s, lh_vec3_cross(edge, s->b->x));
    try_direction(s, lh_vec3_cross(edge, s->b->y));
    try_direction(s, lh_vec3_cross(edge, s->b->z));
}

/* The point of the solid that is nearest to `point`. */
static lh_vec3 project(const lh_solid *s, lh_vec3 point) {
    lh_vec3 from_centre = lh_vec3_sub(point, s->centre);
    lh_vec3 at = {lh_vec3_dot(from_centre, s->x), lh_vec3_dot(from_centre, s->y), lh_vec3_dot(from_centre, s->z)};
    lh_vec3 on = {lh_clip(at.x, -s->half.x, s->half.x), lh_clip(at.y, -s->half.y, s->half.y),
                  lh_clip(at.z, -s->half.z, s->half.z)};
    lh_vec3 beyond = {at.x - on.x, at.y - on.y, s->disc ? 0.0f : at.z - on.z};
    float square = lh_vec3_dot(beyond, beyond);
    float share = square > s->radius * s->radius ? s->radius / lh_sqrt(square) : 1.0f;
    on = lh_vec3_add(on, lh_vec3_scale(beyond, share));
    lh_vec3 across = lh_vec3_add(lh_vec3_scale(s->x, on.x), lh_vec3_scale(s->y, on.y));
    return lh_vec3_add(s->centre, lh_vec3_add(across, lh_vec3_scale(s->z, on.z)));
}

/* What is rounded of it, made smaller: inside two solids that reach into each other a little, these are still apart. */
static lh_solid shrunk(const lh_solid *s, float share) {
    lh_solid result = *s;
    result.radius *= share;
    result.half.z *= s->disc ? share : 1.0f;
    return result;
}

/* The part of v across the axis that a disc rounds about. */
static void try_across(search *s, const lh_solid *of, lh_vec3 v) {
    if (of->disc) {
        try_direction(s, lh_vec3_sub(v, lh_vec3_scale(of->z, lh_vec3_dot(v, of->z))));
    }
}

/* From one to the other where they are nearest, which is where projecting back and forth comes to rest (von Neumann).
 */
static void try_nearest_points(search *s, float share) {
    lh_solid a = shrunk(s->a, share);
    lh_solid b = shrunk(s->b, share);
    lh_vec3 on_b = b.centre;
    lh_vec3 on_a = a.centre;
    for (int i = 0; i < PROJECTIONS; i++) {
        on_a = project(&a, on_b);
        on_b = project(&b, on_a);
    }
    lh_vec3 to_a = lh_vec3_sub(on_a, on_b);
    try_direction(s, to_a);
    try_across(s, &a, to_a);
    try_across(s, &b, to_a);
}

/* From what is cheap to what is not. */
float lh_solid_distance(const lh_solid *a, const lh_solid *b, float enough) {
    search s = {.a = a, .b = b, .between = lh_vec3_sub(a->centre, b->centre)};
    s.distance = lh_vec3_norm(s.between) - lh_vec3_norm(a->half) - a->radius - lh_vec3_norm(b->half) - b->radius;
    if (s.distance < enough) {
        try_faces(&s, a);
        try_faces(&s, b);
    }
    if (s.distance < enough) {
        try_edges(&s, a->x);
        try_edges(&s, a->y);
        try_edges(&s, a->z);
    }
    if (s.distance < enough) {
        try_nearest_points(&s, 0.9f); /* for rims of discs */
        try_nearest_points(&s, 0.1f); /* for what is deep inside */
    }
    return s.distance;
}
