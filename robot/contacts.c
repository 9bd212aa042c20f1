#include "contacts.h"

#include <string.h>

static bool is_sprocket(int body) {
    return body > 0 && body <= ROBOT_CRAWLERS;
}

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
