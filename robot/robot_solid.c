#include "robot_solid.h"

#include <math.h>
#include <string.h>

/* What another kind of meeting must be nearer by to be preferred: faces carry in several points, and are not to be
 * given up for rounding [m]. */
static const double least_gain[] = {
    [ROBOT_FACE_OF_A] = 0, [ROBOT_FACE_OF_B] = 1e-6, [ROBOT_EDGES] = 1e-4, [ROBOT_POINTS] = 1e-6};

enum { PROJECTIONS = 16 }; /* back and forth between two solids */

static const double no_direction = 1e-12; /* square of a length that is all rounding: of axes that span no plane, say */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3]) {
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

static void rotate(const double q[4], const double v[3], double result[3]) {
    double inner[3], outer[3];
    cross(q + 1, v, inner);
    for (int i = 0; i < 3; i++) {
        inner[i] += q[0] * v[i];
    }
    cross(q + 1, inner, outer);
    for (int i = 0; i < 3; i++) {
        result[i] = v[i] + 2 * outer[i];
    }
}

static const robot_solid at_origin = {.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

robot_solid robot_solid_placed(const robot_solid *solid, const robot_pose *pose) {
    robot_solid placed = *solid;
    rotate(pose->rotation, solid->centre, placed.centre);
    for (int i = 0; i < 3; i++) {
        placed.centre[i] += pose->position[i];
        rotate(pose->rotation, solid->axes[i], placed.axes[i]);
    }
    return placed;
}

robot_solid robot_solid_of_shape(const robot_shape *shape) {
    robot_solid solid = at_origin;
    switch (shape->kind) {
        case ROBOT_SPHERE:
            solid.radius = shape->half_size[0];
            break;
        case ROBOT_BOX:
            memcpy(solid.half, shape->half_size, sizeof solid.half);
            break;
        case ROBOT_CYLINDER:
            solid.radius = shape->half_size[0];
            solid.half[2] = shape->half_size[2];
            solid.disc = true;
            break;
    }
    return robot_solid_placed(&solid, &shape->pose);
}

robot_solid robot_solid_at_home(const robot_description *robot, const robot_shape *shape) {
    robot_solid solid = robot_solid_of_shape(shape);
    for (int body = shape->body; body > 0; body = robot->bodies[body].parent) {
        const robot_body *b = &robot->bodies[body];
        const double half = 0.5 * robot->actuators[body - 1].home;
        const robot_pose turned = {
            .rotation = {cos(half), sin(half) * b->axis[0], sin(half) * b->axis[1], sin(half) * b->axis[2]}};
        solid = robot_solid_placed(&solid, &turned);
        solid = robot_solid_placed(&solid, &b->joint);
    }
    return solid;
}

/* Axis 0 forward, 1 down, 2 along the sprocket. */
robot_solid robot_solid_of_belt(const robot_crawler *crawler) {
    robot_solid solid = {.half = {0.5 * crawler->length - crawler->radius, 0, 0.5 * crawler->width},
                         .radius = crawler->radius,
                         .disc = true};
    static const double up[3] = {0, 0, 1};
    memcpy(solid.centre, crawler->centre, sizeof solid.centre);
    memcpy(solid.axes[2], crawler->axis, sizeof solid.axes[2]);
    cross(crawler->axis, up, solid.axes[0]);
    const double length = sqrt(dot(solid.axes[0], solid.axes[0]));
    for (int i = 0; i < 3; i++) {
        solid.axes[0][i] /= length;
    }
    cross(solid.axes[2], solid.axes[0], solid.axes[1]);
    return solid;
}

double robot_solid_reach(const robot_solid *solid) {
    return sqrt(dot(solid->half, solid->half)) + solid->radius;
}

double robot_solid_half_width(const robot_solid *solid, const double direction[3]) {
    double width = 0;
    for (int i = 0; i < 3; i++) {
        width += solid->half[i] * fabs(dot(solid->axes[i], direction));
    }
    const double along = solid->disc ? dot(solid->axes[2], direction) : 0;
    return width + solid->radius * sqrt(fmax(0, 1 - along * along));
}

/* Two solids, and the best that was found so far. */
typedef struct search {
    const robot_solid *a, *b;
    double between[3]; /* from the centre of b to that of a */
    robot_gap best;
} search;

/* Any direction shows that the solids are at least so far apart: the best of many is what is looked for. */
static void try_direction(search *s, const double direction[3], robot_meeting meeting, int axis_a, int axis_b) {
    const double square = dot(direction, direction);
    if (square < no_direction) {
        return;
    }
    const double along = dot(s->between, direction);
    const double scale = (along < 0 ? -1 : 1) / sqrt(square);
    const double normal[3] = {scale * direction[0], scale * direction[1], scale * direction[2]};
    const double distance = scale * along - robot_solid_half_width(s->a, normal) - robot_solid_half_width(s->b, normal);
    if (distance > s->best.distance + least_gain[meeting]) {
        s->best.distance = distance;
        memcpy(s->best.normal, normal, sizeof normal);
        s->best.meeting = meeting;
        s->best.axis_a = axis_a;
        s->best.axis_b = axis_b;
    }
}

/* A direction in which a solid is flat. A ball is nowhere. */
static bool is_face(const robot_solid *solid) {
    return solid->disc || solid->radius == 0;
}

static void try_faces_and_edges(search *s) {
    for (int i = 0; i < 3 && is_face(s->a); i++) {
        try_direction(s, s->a->axes[i], ROBOT_FACE_OF_A, i, 0);
    }
    for (int j = 0; j < 3 && is_face(s->b); j++) {
        try_direction(s, s->b->axes[j], ROBOT_FACE_OF_B, 0, j);
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double direction[3];
            cross(s->a->axes[i], s->b->axes[j], direction);
            try_direction(s, direction, ROBOT_EDGES, i, j);
        }
    }
}

/* What is rounded of it, made smaller: inside two solids that reach into each other a little, these are still apart. */
static robot_solid shrunk(const robot_solid *solid, double share) {
    robot_solid result = *solid;
    result.radius *= share;
    result.half[2] *= solid->disc ? share : 1;
    return result;
}

/* The point of the solid that is nearest to `point`. */
static void project(const robot_solid *solid, const double point[3], double result[3]) {
    double from_centre[3], along[3], beyond[3];
    for (int k = 0; k < 3; k++) {
        from_centre[k] = point[k] - solid->centre[k];
    }
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double at = dot(from_centre, solid->axes[i]);
        along[i] = fmax(-solid->half[i], fmin(solid->half[i], at));
        beyond[i] = solid->disc && i == 2 ? 0 : at - along[i];
        square += beyond[i] * beyond[i];
    }
    const double share = square > solid->radius * solid->radius ? solid->radius / sqrt(square) : 1;
    for (int k = 0; k < 3; k++) {
        result[k] = solid->centre[k];
        for (int i = 0; i < 3; i++) {
            result[k] += (along[i] + share * beyond[i]) * solid->axes[i][k];
        }
    }
}

/* The part of v across the axis that a disc rounds about. */
static void try_across(search *s, const robot_solid *solid, const double v[3]) {
    const double along = dot(v, solid->axes[2]);
    double direction[3];
    for (int k = 0; k < 3; k++) {
        direction[k] = v[k] - along * solid->axes[2][k];
    }
    if (solid->disc) {
        try_direction(s, direction, ROBOT_POINTS, 0, 0);
    }
}

/* From one to the other where they are nearest, which is where projecting back and forth comes to rest (von Neumann).
 */
static void try_nearest_points(search *s, double share) {
    const robot_solid a = shrunk(s->a, share), b = shrunk(s->b, share);
    double on_a[3], on_b[3], to_a[3];
    memcpy(on_b, b.centre, sizeof on_b);
    for (int i = 0; i < PROJECTIONS; i++) {
        project(&a, on_b, on_a);
        project(&b, on_a, on_b);
    }
    for (int k = 0; k < 3; k++) {
        to_a[k] = on_a[k] - on_b[k];
    }
    const double before = s->best.distance;
    try_direction(s, to_a, ROBOT_POINTS, 0, 0);
    try_across(s, &a, to_a);
    try_across(s, &b, to_a);
    if (s->best.distance > before) {
        memcpy(s->best.near_a, on_a, sizeof on_a);
        memcpy(s->best.near_b, on_b, sizeof on_b);
    }
}

robot_gap robot_solid_gap(const robot_solid *a, const robot_solid *b) {
    search s = {.a = a, .b = b, .best = {.distance = -HUGE_VAL, .normal = {0, 0, 1}}};
    for (int k = 0; k < 3; k++) {
        s.between[k] = a->centre[k] - b->centre[k];
    }
    try_faces_and_edges(&s);
    if (a->radius > 0 || b->radius > 0) {
        try_nearest_points(&s, 0.9); /* for rims of discs */
        try_nearest_points(&s, 0.1); /* for what is deep inside */
    }
    return s.best;
}
