#include "tree.h"

#include <stdio.h>
#include <string.h>

/* The link that a joint names at one end, or -1 with a fault. */
static int end_of(struct reading *r, const struct elements *e, const struct file_joint *joint, const char *end,
                  const char *name) {
    const int link = find_link(e, name);
    if (link < 0 && name[0] != '\0') {
        fault(r, xml_child(joint->at, end), "link", "there is no such link");
    }
    return link;
}

static bool join(struct reading *r, struct elements *e, int index) {
    struct file_joint *joint = &e->joints[index];
    joint->parent = end_of(r, e, joint, "parent", joint->parent_name);
    joint->child = end_of(r, e, joint, "child", joint->child_name);
    if (joint->parent < 0 || joint->child < 0) {
        return false;
    }
    if (joint->parent == joint->child) {
        fault(r, joint->at, NULL, "link %.60s would hang on itself; parent and child must differ", joint->child_name);
        return false;
    }
    struct file_link *child = &e->links[joint->child];
    if (child->joint >= 0) {
        const struct file_joint *first = &e->joints[child->joint];
        fault(r, joint->at, NULL, "link %.60s hangs on joint %.60s already (line %lu); a link has one parent",
              joint->child_name, first->name, first->at->line);
        return false;
    }
    child->joint = index;
    return true;
}

/* Follows the parents of a link that no root leads to; they lead into the loop, and round it back to `start`. */
static void tell_loop(struct reading *r, const struct elements *e, int link) {
    for (int steps = 0; steps < e->num_links; steps++) {
        link = e->joints[e->links[link].joint].parent;
    }
    char text[400];
    const int start = link;
    size_t length = (size_t)snprintf(text, sizeof text, "%.60s", e->links[start].name);
    do {
        link = e->joints[e->links[link].joint].parent;
        if (length < sizeof text - 100) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%.60s", " on ", e->links[link].name);
        }
    } while (link != start);
    fault(r, e->joints[e->links[start].joint].at, NULL, "closes a loop: %s; links must be a tree", text);
}

bool tree_resolve(struct reading *r, struct elements *e, int order[MOST_LINKS]) {
    bool good = true;
    for (int i = 0; i < e->num_joints; i++) {
        good = join(r, e, i) && good;
    }
    int placed = 0, root = -1;
    for (int i = 0; i < e->num_links && good; i++) {
        if (e->links[i].joint >= 0) {
            continue;
        }
        if (root >= 0) {
            fault(r, e->links[i].at, NULL, "hangs on no joint, nor does link %.60s (line %lu); only the root link may",
                  e->links[root].name, e->links[root].at->line);
            good = false;
        } else {
            order[placed++] = root = i;
        }
    }
    if (!good) {
        return false;
    }
    bool *is_placed = arena_take(&r->arena, (size_t)e->num_links, sizeof *is_placed);
    if (root >= 0) {
        is_placed[root] = true;
    }
    for (bool progress = true; progress;) { /* in the order of the file where it can be */
        progress = false;
        for (int i = 0; i < e->num_links; i++) {
            if (!is_placed[i] && e->links[i].joint >= 0 && is_placed[e->joints[e->links[i].joint].parent]) {
                order[placed++] = i;
                is_placed[i] = progress = true;
            }
        }
    }
    for (int i = 0; i < e->num_links; i++) {
        if (!is_placed[i]) {
            tell_loop(r, e, i);
            return false;
        }
    }
    return placed > 0;
}
