#include "urdf.h"

#include <errno.h>
#include <string.h>

#include "urdf_elements.h"

static struct urdf_link *find_link(struct urdf_reading *r, const char *name) {
    for (int i = 0; i < r->num_links; i++) {
        if (strcmp(r->links[i].name, name) == 0) {
            return &r->links[i];
        }
    }
    return NULL;
}

static struct urdf_joint *find_joint(struct urdf_reading *r, const char *name) {
    for (int i = 0; i < r->num_joints; i++) {
        if (strcmp(r->joints[i].name, name) == 0) {
            return &r->joints[i];
        }
    }
    return NULL;
}

static const struct urdf_joint *joint_of_child(const struct urdf_reading *r, const char *link) {
    for (int i = 0; i < r->num_joints; i++) {
        if (strcmp(r->joints[i].child, link) == 0) {
            return &r->joints[i];
        }
    }
    return NULL;
}

/* Crawlers first, then the arm; their joints must exist, and an arm joint must have a range. */
static void build_actuators(struct urdf_reading *r, urdf_robot *out) {
    if (r->num_crawlers != URDF_CRAWLERS) {
        urdf_fail(r, "<limphome>: needs two <crawler> elements, left then right");
        return;
    }
    for (int i = 0; i < r->num_crawlers + r->num_arm; i++) {
        const bool crawler = i < r->num_crawlers;
        const char *name = crawler ? r->crawlers[i] : r->arm[i - r->num_crawlers];
        const struct urdf_joint *joint = find_joint(r, name);
        if (joint == NULL) {
            urdf_fail(r, "<limphome>: there is no joint %s", name);
            return;
        }
        if (!(joint->effort > 0)) {
            urdf_fail(r, "joint %s: needs <limit> with effort above 0", name);
            return;
        }
        if (!crawler && !(joint->limited && joint->high > joint->low)) {
            urdf_fail(r, "joint %s: must be revolute with lower below upper", name);
            return;
        }
        lh_actuator *actuator = &out->robot.actuators[out->robot.num_actuators];
        actuator->kind = crawler ? LH_CRAWLER : LH_JOINT;
        actuator->low = crawler ? 0 : joint->low;
        actuator->high = crawler ? 0 : joint->high;
        actuator->effort_limit = joint->effort;
        snprintf(out->actuator_name[out->robot.num_actuators++], URDF_NAME_LENGTH, "%s", name);
    }
}

/* Index of the arm actuator of that name, or -1: what a joint must have for its angle to move masses. */
static int32_t arm_actuator(const urdf_robot *out, const char *name) {
    for (int32_t i = 0; i < out->robot.num_actuators; i++) {
        if (out->robot.actuators[i].kind == LH_JOINT && strcmp(out->actuator_name[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

/* Orders the links so that each follows its parent; `order` receives indices into r->links. */
static void build_links(struct urdf_reading *r, urdf_robot *out, int order[LH_MAX_LINKS]) {
    bool placed[LH_MAX_LINKS] = {false};
    lh_robot *robot = &out->robot;
    for (bool progress = true; progress;) {
        progress = false;
        for (int i = 0; i < r->num_links; i++) {
            const struct urdf_joint *joint = joint_of_child(r, r->links[i].name);
            int32_t parent = -1;
            for (int32_t k = 0; k < robot->num_links && joint != NULL; k++) {
                parent = strcmp(r->links[order[k]].name, joint->parent) == 0 ? k : parent;
            }
            const bool root = joint == NULL && robot->num_links == 0;
            if (placed[i] || !(root || parent >= 0)) {
                continue;
            }
            robot->links[robot->num_links] = (lh_link){
                .parent = parent,
                .actuator = root ? -1 : arm_actuator(out, joint->name),
                .origin = root ? (lh_vec3){0, 0, 0} : joint->origin,
                .rotation = root ? (lh_quat){1, 0, 0, 0} : joint->rotation,
                .axis = root ? (lh_vec3){0, 0, 1} : joint->axis,
                .mass = r->links[i].mass,
                .centre = r->links[i].centre,
            };
            order[robot->num_links++] = i;
            placed[i] = true;
            progress = true;
        }
    }
    for (int i = 0; i < r->num_links; i++) {
        if (!placed[i]) {
            urdf_fail(r, "link %s: is not joined to the root link", r->links[i].name);
        }
    }
}

static void build_supports(struct urdf_reading *r, urdf_robot *out, const int order[LH_MAX_LINKS]) {
    for (int i = 0; i < r->num_supports; i++) {
        const struct urdf_link *link = find_link(r, r->supports[i].link);
        if (link == NULL) {
            urdf_fail(r, "<limphome>: there is no link %s to stand on", r->supports[i].link);
            return;
        }
        int32_t index = 0;
        while (&r->links[order[index]] != link) {
            index++;
        }
        out->robot.supports[out->robot.num_supports++] =
            (lh_support){.link = index, .point = r->supports[i].point, .radius = r->supports[i].radius};
    }
}

static void build(struct urdf_reading *r, urdf_robot *out) {
    int order[LH_MAX_LINKS] = {0};
    if (!r->extended) {
        urdf_fail(r, "<limphome>: missing; it names crawlers, arm joints and supports");
    }
    if (!r->failed) {
        build_actuators(r, out);
    }
    if (!r->failed) {
        build_links(r, out, order);
    }
    if (!r->failed) {
        build_supports(r, out, order);
    }
    const lh_error error = r->failed ? LH_OK : lh_robot_validate(&out->robot);
    if (error != LH_OK) {
        urdf_fail(r, "%s", lh_error_text(error));
    }
}

bool urdf_read(urdf_robot *robot, const char *path, char error[ERROR_LENGTH]) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return fail_with(error, "%.200s: cannot be opened: %s", path, strerror(errno));
    }
    struct urdf_reading reading = {.path = path, .error = error, .parser = XML_ParserCreate(NULL)};
    if (reading.parser == NULL) {
        fclose(file);
        return fail_with(error, "%.200s: out of memory", path);
    }
    urdf_read_elements(&reading, file);

    urdf_robot read;
    memset(&read, 0, sizeof read);
    read.hash = reading.hash;
    fclose(file);
    if (!reading.failed) {
        build(&reading, &read);
    }
    XML_ParserFree(reading.parser);
    if (!reading.failed) {
        *robot = read;
    }
    return !reading.failed;
}
