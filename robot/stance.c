#include "stance.h"

#include <math.h>

#define DEGREE 0.017453292519943295

/* Crawlers may differ in height, and lie apart along the robot, by this share of the distance between them; their axes
 * may point by as many radians past each other. */
#define ALIKE 0.01

static const struct xml_element *crawler_at(const struct elements *e, int crawler) {
    return e->actuators[crawler].at;
}

/* A sprocket whose axis points to the right turns the other way. */
static void turn_axes(struct reading *r, struct elements *e, vector left, const robot_description *robot) {
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        if (vector_dot(vector_of(robot->crawlers[c].axis), left) < 0) {
            struct file_joint *joint = &e->joints[e->actuators[c].joint];
            remark(r, joint->at, NULL,
                   "its axis points to the right; taken the other way round, so that positive turning "
                   "drives forward");
            joint->axis = vector_scale(joint->axis, -1);
        }
    }
}

/* Where the axes do not tell what is forward, the order of the crawlers does; it is easily mistaken. */
static void tell_reversed(struct reading *r, const struct elements *e, vector left) {
    if (left.y < -0.99 * hypot(left.x, left.y)) {
        remark(r, crawler_at(e, 0), NULL,
               "lies to the right, as seen along the x axis of the root link; as the first one is the left one, "
               "forward is against that axis: if it is not, change the order of the crawlers");
    }
}

static double ground_below(const robot_crawler *crawler) {
    return crawler->centre[2] - crawler->radius;
}

/* Whether the crawlers are a pair that a robot can stand on: `left` leads from the right one to the left one. */
static bool check_pair(struct reading *r, const struct elements *e, vector left, const robot_description *robot) {
    const robot_crawler *c = robot->crawlers;
    const double track = hypot(left.x, left.y);
    if (!(track > (c[0].width + c[1].width) / 2)) {
        fault(r, crawler_at(e, 1), "xyz", "the crawlers lie %.4g m apart and are %.4g m wide: they overlap", track,
              (c[0].width + c[1].width) / 2);
        return false;
    }
    const double step = ground_below(&c[0]) - ground_below(&c[1]);
    if (fabs(step) > ALIKE * track) {
        fault(r, crawler_at(e, 0), "xyz",
              "the left crawler stands %.4g m %s than the right; both must stand on one "
              "plane",
              fabs(step), step > 0 ? "higher" : "lower");
        return false;
    }
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        const vector axis = vector_of(c[i].axis);
        const vector across = vector_scale((vector){left.x, left.y, 0}, 1 / track);
        const double angle = atan2(vector_norm(vector_cross(axis, across)), fabs(vector_dot(axis, across)));
        if (angle > ALIKE) {
            fault(r, crawler_at(e, i), NULL,
                  "the axis of its sprocket (%.3g %.3g %.3g) points %.3g degrees past the "
                  "other crawler; both must lie on one line across the robot, z up",
                  axis.x, axis.y, axis.z, angle / DEGREE);
            return false;
        }
    }
    /* the axes tell what is forward; against them, left and right have changed places */
    const vector sum = vector_add(vector_of(c[0].axis), vector_of(c[1].axis));
    if (left.y < -0.5 * track && vector_dot(sum, left) < track) {
        fault(r, crawler_at(e, 0), "xyz", "lies to the right of the other crawler; the left one must come first");
        return false;
    }
    return true;
}

/* The body frame in the base frame of the file. */
static frame body_frame(vector left, const robot_description *robot) {
    const robot_crawler *c = robot->crawlers;
    const vector across = vector_unit((vector){left.x, left.y, 0});
    const vector middle = vector_scale(vector_add(vector_of(c[0].centre), vector_of(c[1].centre)), 0.5);
    return (frame){{middle.x, middle.y, (ground_below(&c[0]) + ground_below(&c[1])) / 2},
                   {{{across.y, across.x, 0}, {-across.x, across.y, 0}, {0, 0, 1}}}};
}

bool stance_find(struct reading *r, struct elements *e, const robot_description *robot, frame *root_pose) {
    const vector left = vector_subtract(vector_of(robot->crawlers[0].centre), vector_of(robot->crawlers[1].centre));
    if (!check_pair(r, e, left, robot)) {
        return false;
    }
    turn_axes(r, e, left, robot);
    tell_reversed(r, e, left);
    const frame body = body_frame(left, robot);
    *root_pose = frame_inverse(&body);
    const double turned = atan2(body.axes.at[1][0], body.axes.at[0][0]) / DEGREE;
    if (vector_norm(body.origin) > 1e-6 || fabs(turned) > 1e-4) {
        remark(r, e->robot, NULL,
               "the body frame, on the ground midway between the crawlers, lies at (%.4g %.4g %.4g) m of the "
               "root link, turned by %.4g degrees",
               body.origin.x, body.origin.y, body.origin.z, turned + 0.0);
    }
    return true;
}
