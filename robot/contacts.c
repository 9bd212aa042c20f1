#include "contacts.h"

#include <string.h>

#include "robot_overlap.h"

static bool read_self_contact(struct reading *r, const struct xml_element *extension) {
    const char *value = xml_attribute(extension, "self_contact");
    if (value == NULL || strcmp(value, "true") == 0) {
        return true;
    }
    if (strcmp(value, "false") != 0) {
        fault(r, extension, "self_contact", "must be true or false");
    }
    return false;
}

static void read_exception(struct reading *r, const struct elements *e, const struct xml_element *at,
                           robot_description *robot) {
    const int first = read_known(r, at, "link1", e, find_link);
    if (xml_attribute(at, "link2") == NULL) { /* its shapes have been left out */
        return;
    }
    const int second = read_known(r, at, "link2", e, find_link);
    if (first < 0 || second < 0) {
        return;
    }
    const int a = e->links[first].body, b = e->links[second].body;
    if (!robot->may_meet[a][b]) {
        remark(r, at, "link1", "excepts nothing: link %.60s is joined to it, or is a sprocket, or is excepted already",
               e->links[second].name);
    }
    robot->may_meet[a][b] = robot->may_meet[b][a] = false;
}

void contacts_find(struct reading *r, const struct elements *e, robot_description *robot) {
    const bool wanted = read_self_contact(r, e->extension);
    for (int a = 0; a < robot->num_bodies && wanted; a++) {
        for (int b = 0; b < robot->num_bodies; b++) {
            const bool adjacent = robot->bodies[a].parent == b || robot->bodies[b].parent == a;
            robot->may_meet[a][b] = a != b && !adjacent && !is_sprocket(a) && !is_sprocket(b);
        }
    }
    for (const struct xml_element *at = xml_child(e->extension, "no_contact"); at != NULL; at = xml_again(at)) {
        read_exception(r, e, at, robot);
    }
}

static int body_of(const robot_description *robot, int index) {
    return index < robot->num_shapes ? robot->shapes[index].body : 0;
}

static const char *name_of(const robot_description *robot, int index) {
    static const char *const belts[ROBOT_CRAWLERS] = {"the left belt", "the right belt"};
    return index < robot->num_shapes ? robot->shapes[index].name : belts[index - robot->num_shapes];
}

/* Whether shapes of the link of shape `index`, as robot_overlap.h counts, are taken from meshes. */
static bool is_approximated(const struct elements *e, const robot_description *robot, int index) {
    if (index >= robot->num_shapes) { /* a belt */
        return false;
    }
    const struct file_link *link = e->shape_links[index];
    for (int i = 0; i < link->num_shapes; i++) {
        if (link->shapes[i].from_mesh) {
            return true;
        }
    }
    return false;
}

void contacts_check(struct reading *r, const struct elements *e, robot_description *robot) {
    robot_overlap overlap;
    while (robot_overlaps_at_home(robot, &overlap, 1) > 0) {
        const char *first = name_of(robot, overlap.shape), *second = name_of(robot, overlap.other);
        const int a = body_of(robot, overlap.shape), b = body_of(robot, overlap.other);
        if (is_approximated(e, robot, overlap.shape) || is_approximated(e, robot, overlap.other)) {
            remark(r, e->extension, NULL,
                   "%.60s and %.60s reach %.3g m into each other in the initial pose, with shapes taken from meshes: "
                   "their bodies are taken never to touch",
                   first, second, overlap.depth);
        } else {
            fault(r, e->extension, NULL,
                  "%.60s and %.60s reach %.3g m into each other in the initial pose; must not, or be excepted by "
                  "<no_contact link1=\"%.60s\" link2=\"%.60s\"/>",
                  first, second, overlap.depth, robot->bodies[a].name, robot->bodies[b].name);
        }
        robot->may_meet[a][b] = robot->may_meet[b][a] = false;
    }
}
