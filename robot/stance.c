#include "stance.h"

#include <math.h>
#include <string.h>

#define DEGREE 0.017453292519943295

/* Crawlers may differ in height, and lie apart along the robot, by this share of the distance between them; their axes
 * may point by as many radians past each other. */
#define ALIKE 0.01

static const struct xml_element *crawler_at(const struct elements *e, int crawler) {
    return e->actuators[crawler].at;
}

/* A sprocket whose axis points to the right turns the other way. */
static void turn_axes(struct reading *r, const struct elements *e, vector left, robot_description *robot) {
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        robot_crawler *crawler = &robot->crawlers[c];
        if (vector_dot(vector_of(crawler->axis), left) < 0) {
            remark(r, crawler_at(e, c), NULL,
                   "axis points to the right; taken the other way round, so that turning "
                   "it forward drives forward");
            vector_store(vector_scale(vector_of(crawler->axis), -1), crawler->axis);
            vector_store(vector_scale(vector_of(robot->bodies[c + 1].axis), -1), robot->bodies[c + 1].axis);
        }
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
    /* the axis tells what is forward; against it, left and right have changed places */
    const vector sum = vector_add(vector_of(c[0].axis), vector_of(c[1].axis));
    if (left.y < -0.5 * track && vector_dot(sum, left) < 0) {
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

static void move_point(const frame *to, double point[3]) {
    vector_store(frame_apply(to, vector_of(point)), point);
}

static void move_pose(const frame *to, robot_pose *pose) {
    const frame from = frame_of(pose);
    const frame moved = frame_multiply(to, &from);
    *pose = frame_pose(&moved);
}

static void move_inertia(const frame *to, double inertia[3][3]) {
    matrix m;
    memcpy(m.at, inertia, sizeof m.at);
    const matrix back = matrix_transpose(&to->axes);
    const matrix half = matrix_multiply(&to->axes, &m);
    m = matrix_multiply(&half, &back);
    memcpy(inertia, m.at, sizeof m.at);
}

/* What is in the frame of the base, in another that is reached by `to`. */
static void move_base(const frame *to, robot_description *robot) {
    move_point(to, robot->bodies[0].centre);
    move_inertia(to, robot->bodies[0].inertia);
    for (int b = 1; b < robot->num_bodies; b++) {
        if (robot->bodies[b].parent == 0) {
            move_pose(to, &robot->bodies[b].joint);
        }
    }
    for (int i = 0; i < robot->num_shapes; i++) {
        if (robot->shapes[i].body == 0) {
            move_pose(to, &robot->shapes[i].pose);
        }
    }
    for (int i = 0; i < robot->num_supports; i++) {
        if (robot->supports[i].body == 0) {
            move_point(to, robot->supports[i].point);
        }
    }
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        move_point(to, robot->crawlers[c].centre);
        vector_store(matrix_apply(&to->axes, vector_of(robot->crawlers[c].axis)), robot->crawlers[c].axis);
    }
}

bool stance_find(struct reading *r, const struct elements *e, robot_description *robot) {
    const vector left = vector_subtract(vector_of(robot->crawlers[0].centre), vector_of(robot->crawlers[1].centre));
    if (!check_pair(r, e, left, robot)) {
        return false;
    }
    turn_axes(r, e, left, robot);
    const frame body = body_frame(left, robot);
    const frame to = frame_inverse(&body);
    const frame identity = frame_identity();
    if (memcmp(&to.axes, &identity.axes, sizeof to.axes) == 0 && vector_norm(body.origin) == 0) {
        return true; /* to the last bit what the file says */
    }
    move_base(&to, robot);
    return true;
}

void stance_add_supports(robot_description *robot) {
    if (robot->num_supports > robot->num_tips) {
        return;
    }
    static const double ends[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}; /* forward, left */
    for (int i = 0; i < 4; i++) {
        const robot_crawler *c = &robot->crawlers[ends[i][1] > 0 ? 0 : 1];
        robot->supports[robot->num_supports++] =
            (robot_support){.point = {c->centre[0] + ends[i][0] * (c->length / 2 - c->radius),
                                      c->centre[1] + ends[i][1] * c->width / 2, c->centre[2] - c->radius}};
    }
}
