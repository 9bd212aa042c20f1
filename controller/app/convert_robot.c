#include "convert_robot.h"

#include <math.h>
#include <string.h>

#include "robot_solid.h"

static lh_vec3 vec3(const double v[3]) {
    return (lh_vec3){(float)v[0], (float)v[1], (float)v[2]};
}

static lh_actuator convert_actuator(const robot_description *from, int index) {
    const robot_actuator *a = &from->actuators[index];
    return (lh_actuator){
        .kind = index < ROBOT_CRAWLERS ? LH_CRAWLER : LH_JOINT,
        .low = (float)a->lower,
        .high = (float)a->upper,
        .effort_limit = (float)a->effort,
    };
}

/* Turning a sprocket moves no mass. */
static lh_link convert_body(const robot_description *from, int index) {
    const robot_body *b = &from->bodies[index];
    const double *q = b->joint.rotation;
    return (lh_link){
        .parent = b->parent,
        .actuator = index <= ROBOT_CRAWLERS ? -1 : index - 1,
        .origin = vec3(b->joint.position),
        .rotation = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]},
        .axis = vec3(b->axis),
        .mass = (float)b->mass,
        .centre = vec3(b->centre),
    };
}

bool convert_robot(const robot_description *from, lh_robot *robot, char error[ERROR_LENGTH]) {
    if (from->num_actuators > LH_MAX_ACTUATORS || from->num_bodies > LH_MAX_LINKS ||
        from->num_supports > LH_MAX_SUPPORTS) {
        return fail_with(error,
                         "robot %s: has %d actuators and %d supports; this program was built for %d actuators, %d "
                         "links and %d supports",
                         from->name, from->num_actuators, from->num_supports, LH_MAX_ACTUATORS, LH_MAX_LINKS,
                         LH_MAX_SUPPORTS);
    }
    lh_robot converted;
    memset(&converted, 0, sizeof converted); /* padding too */
    converted.num_actuators = from->num_actuators;
    converted.num_links = from->num_bodies;
    converted.num_supports = from->num_supports;
    for (int i = 0; i < from->num_actuators; i++) {
        converted.actuators[i] = convert_actuator(from, i);
    }
    for (int i = 0; i < from->num_bodies; i++) {
        converted.links[i] = convert_body(from, i);
    }
    for (int i = 0; i < from->num_supports; i++) {
        const robot_support *s = &from->supports[i];
        converted.supports[i] = (lh_support){.link = s->body, .point = vec3(s->point), .radius = (float)s->radius};
    }
    const lh_error bad = lh_robot_validate(&converted);
    if (bad != LH_OK) {
        return fail_with(error, "robot %s: %s", from->name, lh_error_text(bad));
    }
    *robot = converted;
    return true;
}

/* Of the rotation from the frame to the axes, which is less than half a turn. */
static lh_quat quat_of_axes(const double axes[3][3]) {
    const double w = 0.5 * sqrt(1 + axes[0][0] + axes[1][1] + axes[2][2]);
    return (lh_quat){(float)w, (float)((axes[1][2] - axes[2][1]) / (4 * w)),
                     (float)((axes[2][0] - axes[0][2]) / (4 * w)), (float)((axes[0][1] - axes[1][0]) / (4 * w))};
}

static lh_shape convert_belt(const robot_crawler *crawler) {
    const robot_solid solid = robot_solid_of_belt(crawler);
    return (lh_shape){.centre = vec3(solid.centre),
                      .rotation = quat_of_axes(solid.axes),
                      .half = vec3(solid.half),
                      .radius = (float)solid.radius,
                      .disc = solid.disc};
}

static lh_shape convert_shape(const robot_shape *shape) {
    const robot_solid solid = robot_solid_of_shape(shape);
    const double *q = shape->pose.rotation;
    return (lh_shape){.centre = vec3(solid.centre),
                      .rotation = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]},
                      .half = vec3(solid.half),
                      .radius = (float)solid.radius,
                      .link = (int16_t)shape->body,
                      .disc = solid.disc};
}

/* False if there is no room for it. */
static bool add_shape(lh_shapes *shapes, lh_shape shape) {
    if (shapes->count == LH_MAX_SHAPES) {
        return false;
    }
    shapes->shape[shapes->count++] = shape;
    return true;
}

int convert_shapes(const robot_description *from, lh_shapes *shapes) {
    memset(shapes, 0, sizeof *shapes);
    for (int a = 0; a < from->num_bodies; a++) {
        for (int b = 0; b < from->num_bodies; b++) {
            shapes->may_meet[a] |= from->may_meet[a][b] ? (uint32_t)1 << b : 0;
        }
    }
    int left_out = 0;
    for (int i = 0; i < ROBOT_CRAWLERS && shapes->may_meet[0] != 0; i++) {
        left_out += !add_shape(shapes, convert_belt(&from->crawlers[i]));
    }
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < from->num_shapes; i++) {
            const robot_shape *shape = &from->shapes[i];
            const bool is_due = (shape->body == 0) == (pass == 1);
            if (is_due && shapes->may_meet[shape->body] != 0) {
                left_out += !add_shape(shapes, convert_shape(shape));
            }
        }
    }
    return left_out;
}
