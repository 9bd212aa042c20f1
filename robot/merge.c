#include "merge.h"

#define LEAST_MASS 1e-6 /* [kg] */

/* What a joint that is held adds to its origin. */
static frame held_motion(const struct file_joint *joint) {
    if (joint->type == JOINT_REVOLUTE || joint->type == JOINT_CONTINUOUS) {
        return frame_about(joint->axis, joint->home);
    }
    return (frame){vector_scale(joint->axis, joint->home), matrix_identity()};
}

static void begin_body(const struct file_joint *joint, const struct file_link *link, const struct file_link *parent,
                       robot_body *body) {
    const frame origin = frame_multiply(&parent->pose, &joint->origin);
    short_name(body->name, link->name);
    body->parent = parent->body;
    body->joint = frame_pose(&origin);
    vector_store(joint->axis, body->axis);
}

static bool place(struct reading *r, struct elements *e, struct file_link *link, robot_description *robot) {
    const struct file_joint *joint = &e->joints[link->joint];
    const struct file_link *parent = &e->links[joint->parent];
    if (joint->actuator < 0) {
        const frame origin = frame_multiply(&parent->pose, &joint->origin);
        const frame motion = held_motion(joint);
        link->body = parent->body;
        link->pose = frame_multiply(&origin, &motion);
        return true;
    }
    const struct file_actuator *actuator = &e->actuators[joint->actuator];
    link->body = joint->actuator + 1;
    link->pose = frame_identity();
    e->moved[link->body] = joint->child;
    begin_body(joint, link, parent, &robot->bodies[link->body]);
    if (parent->body >= link->body) {
        fault(r, actuator->at, "joint", "stands before joint %.60s, which carries it; arms go from root to tip",
              e->joints[e->actuators[parent->body - 1].joint].name);
        return false;
    }
    if (is_sprocket(parent->body)) {
        fault(r, actuator->at, "joint", "hangs on the sprocket of a crawler; must hang on the base or on the arm");
        return false;
    }
    if (actuator->crawler && parent->body != 0) {
        fault(r, actuator->at, "joint", "hangs on the arm; a crawler must be fixed to the base");
        return false;
    }
    return true;
}

bool merge_links(struct reading *r, struct elements *e, const int order[MOST_LINKS], const frame *root_pose,
                 robot_description *robot) {
    struct file_link *root = &e->links[order[0]];
    root->body = 0;
    e->moved[0] = order[0];
    root->pose = *root_pose;
    short_name(robot->bodies[0].name, root->name);
    robot->bodies[0].parent = -1;
    robot->bodies[0].joint = (robot_pose){{0, 0, 0}, {1, 0, 0, 0}};
    robot->bodies[0].axis[2] = 1;
    robot->num_actuators = e->num_actuators;
    robot->num_bodies = e->num_actuators + 1;
    bool good = true;
    for (int i = 1; i < e->num_links; i++) {
        good = place(r, e, &e->links[order[i]], robot) && good;
    }
    for (int c = 0; c < ROBOT_CRAWLERS; c++) {
        const struct file_actuator *crawler = &e->actuators[c];
        if (crawler->joint < 0 && e->links[crawler->link].body != 0) {
            fault(r, crawler->at, "link", "moves with the arm or a sprocket; a crawler must be fixed to the base");
            good = false;
        }
    }
    return good;
}

/* Inertia that `mass` at `at` has about `centre`: parallel axes. */
static matrix about(double mass, vector at, vector centre) {
    const vector from = vector_subtract(at, centre);
    const double square = vector_dot(from, from);
    matrix m;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            m.at[i][k] = mass * ((i == k ? square : 0) - vector_component(from, i) * vector_component(from, k));
        }
    }
    return m;
}

static void add_mass(const struct file_link *link, robot_body *body) {
    if (link->mass == 0) {
        return;
    }
    const frame pose = frame_multiply(&link->pose, &link->inertial);
    const matrix back = matrix_transpose(&pose.axes);
    const matrix half = matrix_multiply(&pose.axes, &link->inertia);
    const matrix turned = matrix_multiply(&half, &back);
    const double mass = body->mass + link->mass;
    const vector before = vector_of(body->centre);
    const vector moment = vector_add(vector_scale(before, body->mass), vector_scale(pose.origin, link->mass));
    const vector centre = {moment.x / mass, moment.y / mass, moment.z / mass};
    const matrix moved = about(body->mass, before, centre), added = about(link->mass, pose.origin, centre);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            body->inertia[i][k] += moved.at[i][k] + turned.at[i][k] + added.at[i][k];
        }
    }
    body->mass = mass;
    vector_store(centre, body->centre);
}

/* The body of a sprocket that the file has no joint for is of no link. */
static bool has_links(const struct elements *e, int body) {
    return body == 0 || e->actuators[body - 1].joint >= 0;
}

static void check_body(struct reading *r, const struct xml_element *at, const robot_body *body) {
    if (!(body->mass >= LEAST_MASS)) {
        fault(r, at, NULL, "has no mass, nor has what is fixed to it; needs <inertial> with <mass> above 0");
    } else if (body->mass > MOST_KILOGRAMS) {
        fault(r, at, NULL, "has, with what is fixed to it, %g kg; must be at most %g", body->mass, MOST_KILOGRAMS);
    }
    if (is_far(body->joint.position) || is_far(body->centre)) {
        fault(r, at, NULL, "is, or has its centre of mass, more than %g m from what it hangs on", MOST_METRES);
    }
}

void merge_masses(struct reading *r, struct elements *e, const int order[MOST_LINKS], robot_description *robot) {
    for (int i = 0; i < e->num_links; i++) {
        const struct file_link *link = &e->links[order[i]];
        add_mass(link, &robot->bodies[link->body]);
    }
    for (int b = 0; b < robot->num_bodies; b++) {
        if (has_links(e, b)) {
            check_body(r, e->links[e->moved[b]].at, &robot->bodies[b]);
        }
    }
}
