#include "hold.h"

#include <math.h>

static bool is_held(const struct file_joint *joint) {
    return joint->actuator < 0 && joint->type != JOINT_FIXED;
}

static bool has_limits(const struct file_joint *joint) {
    return (joint->type == JOINT_REVOLUTE || joint->type == JOINT_PRISMATIC) && xml_child(joint->at, "limit") != NULL;
}

static bool is_free(const struct file_joint *joint) {
    return joint->type == JOINT_FLOATING || joint->type == JOINT_PLANAR;
}

static void read_hold(struct reading *r, struct elements *e, const struct xml_element *at) {
    const int index = read_known(r, at, "joint", e, find_joint);
    double home = 0;
    if (!read_numbers(r, at, "home", true, &home, 1) || index < 0) {
        return;
    }
    struct file_joint *joint = &e->joints[index];
    if (!is_held(joint) || is_free(joint)) {
        fault(r, at, "joint",
              joint->actuator >= 0 ? "is an actuator; only other joints are held"
                                   : "does not turn or slide; only joints that do are held");
    } else if (joint->hold != NULL) {
        fault(r, at, "joint", "is held already (line %lu)", joint->hold->line);
    } else if (has_limits(joint) && !(home >= joint->lower && home <= joint->upper)) {
        fault(r, at, "home", "must lie within the limits of the joint, %g to %g", joint->lower, joint->upper);
    } else if (fabs(home) > MOST_METRES) {
        fault(r, at, "home", "must be of at most %g", MOST_METRES);
    } else {
        joint->hold = at;
        joint->home = home;
    }
}

/* The joint that leads a joint with <mimic>, or -1 with a fault. */
static int leader(struct reading *r, const struct elements *e, const struct file_joint *joint) {
    return read_known(r, joint->mimic, "joint", e, find_joint);
}

static bool follows(const struct file_joint *joint) {
    return is_held(joint) && joint->mimic != NULL && joint->hold == NULL;
}

/* Where the joints that lead it put it. False with a fault if they go round in a circle. */
static bool follow(struct reading *r, const struct elements *e, struct file_joint *joint) {
    double multiplier = 1, offset = 0;
    const struct file_joint *at = joint;
    for (int steps = 0; follows(at); steps++) {
        const int next = leader(r, e, at);
        if (next < 0) {
            return false;
        }
        if (steps == e->num_joints) {
            fault(r, joint->mimic, "joint", "follows a joint that in the end follows it");
            return false;
        }
        offset += multiplier * at->offset;
        multiplier *= at->multiplier;
        at = &e->joints[next];
    }
    joint->home = multiplier * at->home + offset;
    return true;
}

static void tell(struct reading *r, const struct file_joint *joint) {
    if (is_free(joint)) {
        remark(r, joint->at, NULL, "moves, but is no actuator of <limphome>; held where it is at rest");
        return;
    }
    const char *unit = joint->type == JOINT_PRISMATIC ? "m" : "rad";
    if (follows(joint)) {
        remark(r, joint->mimic, "joint", "is not followed; held at %.4g %s, where the initial pose puts it",
               joint->home, unit);
    } else {
        remark(r, joint->at, NULL, "moves, but is no actuator of <limphome>; held at %.4g %s", joint->home, unit);
    }
}

void hold_joints(struct reading *r, struct elements *e) {
    for (const struct xml_element *at = xml_child(e->extension, "hold"); at != NULL; at = xml_again(at)) {
        read_hold(r, e, at);
    }
    for (int i = 0; i < e->num_joints; i++) {
        struct file_joint *joint = &e->joints[i];
        if (is_held(joint) && joint->hold == NULL && has_limits(joint) && joint->lower <= joint->upper) {
            joint->home = fmin(fmax(0, joint->lower), joint->upper);
        }
    }
    for (int i = 0; i < e->num_joints; i++) {
        struct file_joint *joint = &e->joints[i];
        if (follows(joint) && !follow(r, e, joint)) {
            continue;
        }
        if (is_held(joint) && fabs(joint->home) > MOST_METRES) {
            fault(r, joint->at, NULL, "would be held at %g; must be of at most %g", joint->home, MOST_METRES);
        } else if (is_held(joint) && joint->hold == NULL) {
            tell(r, joint);
        }
    }
}
