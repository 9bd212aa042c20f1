#include <math.h>
#include <string.h>

#include "print.h"

#define DEGREES (180.0 / 3.14159265358979323846)

/* Width of the column of names. */
static int name_width(const robot_description *robot) {
    size_t width = 12;
    for (int i = 0; i < robot->num_bodies; i++) {
        const size_t body = strlen(robot->bodies[i].name);
        width = body > width ? body : width;
    }
    for (int i = 0; i < robot->num_actuators; i++) {
        const size_t actuator = strlen(robot->actuators[i].name);
        width = actuator > width ? actuator : width;
    }
    return (int)width;
}

static void put_bodies(FILE *out, const robot_description *robot, const robot_facts *facts) {
    const int width = name_width(robot);
    fprintf(out, "\n%-*s         mass  centre of mass [m], in the frame of each\n", width + 2, "bodies");
    for (int i = 0; i < robot->num_bodies; i++) {
        const robot_body *b = &robot->bodies[i];
        fprintf(out, "  %-*s  %8.4g kg  %7.3f %7.3f %7.3f\n", width, b->name, b->mass, b->centre[0], b->centre[1],
                b->centre[2]);
    }
    const double *all = facts->home.centre_of_mass;
    fprintf(out, "  %-*s  %8.4g kg  %7.3f %7.3f %7.3f  at home, in the frame of the base\n", width, "all", facts->mass,
            all[0], all[1], all[2]);
}

static void put_crawlers(FILE *out, const robot_description *robot, const robot_facts *facts) {
    const int width = name_width(robot);
    fprintf(out, "\n%-*s    long    wide  radius [m]  middle at [m]\n", width + 2, "crawlers");
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        const robot_crawler *c = &robot->crawlers[i];
        const robot_actuator *a = &robot->actuators[i];
        fprintf(out, "  %-*s  %6.3f  %6.3f  %6.3f      %6.3f %6.3f %6.3f, %.4g N m, %.3g rad/s (%.3g m/s)\n", width,
                a->name, c->length, c->width, c->radius, c->centre[0], c->centre[1], c->centre[2], a->effort, a->speed,
                a->speed * c->radius);
    }
    if (isfinite(facts->ground_pressure)) {
        fprintf(out, "  they press on firm ground with %.3g kPa\n", facts->ground_pressure / 1000.0);
    }
}

static void put_arm(FILE *out, const robot_description *robot) {
    const int width = name_width(robot);
    fprintf(out, "\n%-*s      from       to     home [rad]\n", width + 2, "arm");
    for (int i = ROBOT_CRAWLERS; i < robot->num_actuators; i++) {
        const robot_actuator *a = &robot->actuators[i];
        fprintf(out, "  %-*s  %8.3f %8.3f %8.3f      %.4g N m, %.3g rad/s\n", width, a->name, a->lower, a->upper,
                a->home, a->effort, a->speed);
    }
}

static void put_strength(FILE *out, const robot_description *robot, double mass, const facts_strength *s,
                         const char *where) {
    if (s->lift_bound == FACTS_UNBOUNDED) {
        fprintf(out, "    %s no joint moves it up or down\n", where);
        return;
    }
    if (s->lift < 0.0) {
        fprintf(out, "    %s %s cannot hold the arm up\n", where, robot->actuators[s->lift_bound].name);
    } else if (s->lift_bound == FACTS_TUMBLES) {
        fprintf(out, "    %s lifts %.3g kg, then the robot tumbles\n", where, s->lift);
    } else {
        fprintf(out, "    %s lifts %.3g kg, then %s gives way\n", where, s->lift, robot->actuators[s->lift_bound].name);
    }
    if (s->press_bound >= 0) {
        fprintf(out, "    %s presses down with %.3g N, %.0f %% of the weight, then %s gives way\n", where, s->press,
                100.0 * s->press / (mass * FACTS_GRAVITY), robot->actuators[s->press_bound].name);
    }
}

static void put_tips(FILE *out, const robot_description *robot, const robot_facts *facts) {
    for (int i = 0; i < robot->num_tips; i++) {
        const facts_tip *tip = &facts->tips[i];
        const double *at = facts->home.tip[i];
        fprintf(out, "\ntip of %s: ball of radius %.3g m\n", robot->bodies[robot->supports[i].body].name,
                robot->supports[i].radius);
        fprintf(out, "    home:  %.3f %.3f %.3f m (its lowest point)\n", at[0], at[1], at[2]);
        put_strength(out, robot, facts->mass, &tip->home, "home: ");
        fprintf(out, "    reach: %.3g m out, %.3g to %.3g m high\n", tip->reach, tip->low, tip->high);
        if (tip->far.rests) {
            put_strength(out, robot, facts->mass, &tip->there, "reach:");
        }
    }
}

static void put_angles(FILE *out, const robot_description *robot, const facts_posture *posture) {
    for (int i = ROBOT_CRAWLERS; i < robot->num_actuators; i++) {
        fprintf(out, "%s%s %.2f", i == ROBOT_CRAWLERS ? "" : ", ", robot->actuators[i].name, (double)posture->angle[i]);
    }
}

static void put_stance(FILE *out, const robot_description *robot, const robot_facts *facts) {
    fprintf(out, "\nstance\n  at home ");
    if (facts->home.rests) {
        fprintf(out, "it stands on its crawlers%s, margin %.3f m\n", facts->home.braced ? " and its arm" : "",
                facts->home.margin);
    } else {
        fprintf(out, "it does not stand: it tumbles\n");
    }
    fprintf(out,
            "  tumbles on ground that falls by %.0f degrees ahead, %.0f behind, %.0f to the left, %.0f to the right\n",
            facts->tilt[FACTS_FORWARD] * DEGREES, facts->tilt[FACTS_BACKWARD] * DEGREES,
            facts->tilt[FACTS_LEFT] * DEGREES, facts->tilt[FACTS_RIGHT] * DEGREES);
    if (facts->least.rests) {
        fprintf(out, "  least margin on its crawlers alone %.3f m, with ", facts->least.margin);
        put_angles(out, robot, &facts->least);
        fputc('\n', out);
    }
    fprintf(out, "  of %d postures of the arm %.0f %% have it on the ground, in %.0f %% the robot tumbles\n",
            facts->num_postures, 100.0 * facts->num_braced / facts->num_postures,
            100.0 * facts->num_nowhere / facts->num_postures);
    if (facts->num_braced == 0) {
        fprintf(out, "  the arm never reaches the ground: it cannot drag the robot\n");
    }
}

static void put_contacts(FILE *out, const robot_description *robot) {
    int pairs = 0;
    for (int a = 0; a < robot->num_bodies; a++) {
        for (int b = a + 1; b < robot->num_bodies; b++) {
            pairs += robot->may_meet[a][b];
        }
    }
    fprintf(out, "\n%d shapes that touch the ground: tips", robot->num_shapes);
    for (int i = robot->num_tips; i < robot->num_shapes; i++) {
        const bool again = i > robot->num_tips && strcmp(robot->shapes[i].name, robot->shapes[i - 1].name) == 0;
        if (!again) {
            fprintf(out, ", %s", robot->shapes[i].name);
        }
    }
    fprintf(out, "\n%d pairs of bodies that touch each other, %d points to stand on\n", pairs, robot->num_supports);
}

void print_text(FILE *out, const robot_description *robot, const robot_facts *facts) {
    fprintf(out, "robot %s: %.4g kg, arm of %d joints\n", robot->name, facts->mass,
            robot->num_actuators - ROBOT_CRAWLERS);
    put_bodies(out, robot, facts);
    put_crawlers(out, robot, facts);
    put_arm(out, robot);
    put_tips(out, robot, facts);
    put_stance(out, robot, facts);
    put_contacts(out, robot);
}
