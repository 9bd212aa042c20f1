#include "convert_robot.h"

#include <string.h>

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
