#include "robot_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contacts.h"
#include "elements.h"
#include "inertia.h"
#include "merge.h"
#include "parts.h"
#include "sprocket.h"
#include "stance.h"
#include "touch.h"
#include "tree.h"
#include "xml.h"

/* Bodies from links, in the frame that the crawlers give. */
static bool build_bodies(struct reading *r, struct elements *e, const int *order, robot_description *robot) {
    frame root_pose = frame_identity();
    if (!merge_links(r, e, order, &root_pose, robot)) {
        return false;
    }
    parts_crawlers(e, robot);
    if (!stance_find(r, e, robot, &root_pose) || !merge_links(r, e, order, &root_pose, robot)) {
        return false;
    }
    parts_crawlers(e, robot);
    merge_masses(r, e, order, robot);
    inertia_check(r, e, robot);
    return r->faults.count == 0;
}

/* What is found fault with element by element is told together; what follows from all of them only where they are
 * good. */
static void build(struct reading *r, struct elements *e, robot_description *robot) {
    int *order = arena_take(&r->arena, MOST_LINKS, sizeof *order);
    elements_read(r, e);
    const bool is_tree = tree_resolve(r, e, order);
    extension_read(r, e);
    if (r->faults.count > 0 || !is_tree || !build_bodies(r, e, order, robot)) {
        return;
    }
    const char *name = xml_attribute(e->robot, "name");
    short_name(robot->name, name == NULL ? "" : name);
    sprockets_make(r, e, robot);
    parts_actuators(e, robot);
    parts_supports(r, e, robot);
    touch_find(r, e, order, robot);
    contacts_find(r, e, robot);
    contacts_check(r, e, robot);
}

bool robot_file_read(const char *path, const char *packages, robot_description *robot, robot_report *report) {
    struct reading r = {.path = path, .packages = packages};
    robot_description read;
    memset(&read, 0, sizeof read); /* padding too: equal robots are equal bytes */
    struct elements e = {.robot = xml_read(&r, &read.hash)};
    if (e.robot != NULL) {
        build(&r, &e, &read);
    }
    reading_report(&r, report);
    arena_free(&r.arena);
    if (report->num_faults > 0) {
        return false;
    }
    *robot = read;
    return true;
}

bool robot_file_load(const char *path, const char *packages, robot_description *robot) {
    enum { MOST_LINES = 20 };
    robot_report report;
    const bool good = robot_file_read(path, packages, robot, &report);
    char *const *lines = good ? report.notices : report.faults;
    const int count = good ? report.num_notices : report.num_faults;
    for (int i = 0; i < count && i < MOST_LINES; i++) {
        fprintf(stderr, "%s\n", lines[i]);
    }
    if (count > MOST_LINES) {
        fprintf(stderr, "%s: and %d more\n", path, count - MOST_LINES);
    }
    robot_report_free(&report);
    return good;
}

static void free_lines(char **lines, int count) {
    for (int i = 0; i < count; i++) {
        free(lines[i]);
    }
    free(lines);
}

void robot_report_free(robot_report *report) {
    free_lines(report->faults, report->num_faults);
    free_lines(report->notices, report->num_notices);
    for (int i = 0; i < report->num_meshes; i++) {
        free(report->meshes[i].path);
        free(report->meshes[i].copy);
    }
    free(report->meshes);
    *report = (robot_report){0};
}
