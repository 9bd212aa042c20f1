#include <inttypes.h>

#include "json.h"
#include "print.h"

static void put_lines(json *j, const char *name, char *const *lines, int count) {
    json_open(j, name, '[');
    for (int i = 0; i < count; i++) {
        json_text(j, NULL, lines[i]);
    }
    json_close(j, ']');
}

static void put_meshes(json *j, const robot_report *report) {
    json_open(j, "meshes", '[');
    for (int i = 0; i < report->num_meshes; i++) {
        json_text(j, NULL, report->meshes[i].path);
    }
    json_close(j, ']');
}

static void put_pose(json *j, const robot_pose *pose) {
    json_numbers(j, "position", pose->position, 3);
    json_numbers(j, "rotation", pose->rotation, 4);
}

static void put_actuators(json *j, const robot_description *robot) {
    json_open(j, "actuators", '[');
    for (int i = 0; i < robot->num_actuators; i++) {
        const robot_actuator *a = &robot->actuators[i];
        json_open(j, NULL, '{');
        json_text(j, "name", a->name);
        json_bool(j, "crawler", i < ROBOT_CRAWLERS);
        json_number(j, "lower", a->lower);
        json_number(j, "upper", a->upper);
        json_number(j, "effort", a->effort);
        json_number(j, "speed", a->speed);
        json_number(j, "home", a->home);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void put_bodies(json *j, const robot_description *robot) {
    json_open(j, "bodies", '[');
    for (int i = 0; i < robot->num_bodies; i++) {
        const robot_body *b = &robot->bodies[i];
        json_open(j, NULL, '{');
        json_text(j, "name", b->name);
        json_whole(j, "parent", b->parent);
        put_pose(j, &b->joint);
        json_numbers(j, "axis", b->axis, 3);
        json_number(j, "mass", b->mass);
        json_numbers(j, "centre", b->centre, 3);
        json_open(j, "inertia", '[');
        for (int row = 0; row < 3; row++) {
            json_numbers(j, NULL, b->inertia[row], 3);
        }
        json_close(j, ']');
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void put_crawlers(json *j, const robot_description *robot) {
    json_open(j, "crawlers", '[');
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        const robot_crawler *c = &robot->crawlers[i];
        json_open(j, NULL, '{');
        json_numbers(j, "centre", c->centre, 3);
        json_numbers(j, "axis", c->axis, 3);
        json_number(j, "length", c->length);
        json_number(j, "width", c->width);
        json_number(j, "radius", c->radius);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void put_shapes(json *j, const robot_description *robot) {
    static const char *const kinds[] = {[ROBOT_SPHERE] = "sphere", [ROBOT_BOX] = "box", [ROBOT_CYLINDER] = "cylinder"};
    json_open(j, "shapes", '[');
    for (int i = 0; i < robot->num_shapes; i++) {
        const robot_shape *s = &robot->shapes[i];
        json_open(j, NULL, '{');
        json_text(j, "name", s->name);
        json_whole(j, "body", s->body);
        json_text(j, "kind", kinds[s->kind]);
        put_pose(j, &s->pose);
        json_numbers(j, "half_size", s->half_size, 3);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void put_supports(json *j, const robot_description *robot) {
    json_open(j, "supports", '[');
    for (int i = 0; i < robot->num_supports; i++) {
        const robot_support *s = &robot->supports[i];
        json_open(j, NULL, '{');
        json_bool(j, "tip", i < robot->num_tips);
        json_whole(j, "body", s->body);
        json_numbers(j, "point", s->point, 3);
        json_number(j, "radius", s->radius);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void put_may_meet(json *j, const robot_description *robot) {
    json_open(j, "may_meet", '[');
    for (int a = 0; a < robot->num_bodies; a++) {
        for (int b = a + 1; b < robot->num_bodies; b++) {
            if (robot->may_meet[a][b]) {
                json_open(j, NULL, '[');
                json_whole(j, NULL, a);
                json_whole(j, NULL, b);
                json_close(j, ']');
            }
        }
    }
    json_close(j, ']');
}

static void put_posture(json *j, const char *name, const robot_description *robot, const facts_posture *posture) {
    json_open(j, name, '{');
    json_open(j, "angles", '[');
    for (int i = 0; i < robot->num_actuators; i++) {
        json_number(j, NULL, (double)posture->angle[i]);
    }
    json_close(j, ']');
    json_bool(j, "rests", posture->rests);
    json_bool(j, "braced", posture->braced);
    json_number(j, "margin", posture->margin);
    json_numbers(j, "centre_of_mass", posture->centre_of_mass, 3);
    json_close(j, '}');
}

static void put_bound(json *j, const char *name, const robot_description *robot, int by) {
    json_text(j, name, by == FACTS_UNBOUNDED ? "" : by == FACTS_TUMBLES ? "tumbling" : robot->actuators[by].name);
}

static void put_strength(json *j, const char *name, const robot_description *robot, const facts_strength *strength) {
    json_open(j, name, '{');
    json_number(j, "lift", strength->lift);
    put_bound(j, "lift_bound", robot, strength->lift_bound);
    json_number(j, "press", strength->press);
    put_bound(j, "press_bound", robot, strength->press_bound);
    json_close(j, '}');
}

static void put_tips(json *j, const robot_description *robot, const robot_facts *facts) {
    json_open(j, "tips", '[');
    for (int i = 0; i < robot->num_tips; i++) {
        const facts_tip *tip = &facts->tips[i];
        json_open(j, NULL, '{');
        json_text(j, "body", robot->bodies[robot->supports[i].body].name);
        json_numbers(j, "at_home", facts->home.tip[i], 3);
        json_number(j, "reach", tip->reach);
        json_number(j, "low", tip->low);
        json_number(j, "high", tip->high);
        put_strength(j, "strength_at_home", robot, &tip->home);
        if (tip->far.rests) {
            put_posture(j, "farthest", robot, &tip->far);
            put_strength(j, "strength_at_reach", robot, &tip->there);
        }
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void put_facts(json *j, const robot_description *robot, const robot_facts *facts) {
    static const char *const directions[FACTS_DIRECTIONS] = {"forward", "left", "backward", "right"};
    json_number(j, "mass", facts->mass);
    json_number(j, "ground_pressure", facts->ground_pressure);
    put_posture(j, "home", robot, &facts->home);
    json_open(j, "tumbles_at", '{');
    for (int d = 0; d < FACTS_DIRECTIONS; d++) {
        json_number(j, directions[d], facts->tilt[d]);
    }
    json_close(j, '}');
    json_open(j, "sweep", '{');
    json_whole(j, "postures", facts->num_postures);
    json_whole(j, "braced", facts->num_braced);
    json_whole(j, "nowhere", facts->num_nowhere);
    if (facts->least.rests) {
        put_posture(j, "least", robot, &facts->least);
    }
    json_close(j, '}');
    put_tips(j, robot, facts);
}

void print_json(FILE *out, const char *path, const robot_report *report, const robot_description *robot,
                const robot_facts *facts) {
    json j = {out, true};
    json_open(&j, NULL, '{');
    json_text(&j, "file", path);
    json_bool(&j, "accepted", robot != NULL);
    put_lines(&j, "faults", report->faults, report->num_faults);
    put_lines(&j, "notices", report->notices, report->num_notices);
    put_meshes(&j, report);
    if (robot != NULL) {
        char hash[17];
        snprintf(hash, sizeof hash, "%016" PRIx64, robot->hash);
        json_text(&j, "name", robot->name);
        json_text(&j, "hash", hash);
        put_actuators(&j, robot);
        put_bodies(&j, robot);
        put_crawlers(&j, robot);
        put_shapes(&j, robot);
        put_supports(&j, robot);
        put_may_meet(&j, robot);
        put_facts(&j, robot, facts);
    }
    json_close(&j, '}');
    fputc('\n', out);
}
