#include "inertia.h"

#include <math.h>
#include <string.h>

/* One principal moment may be above the sum of the two others by this share: numbers in files are rounded. */
#define ROUNDED 1.1

/* A radius of gyration this many times farther out than anything of the link is known to be: units, most likely. */
#define FAR_OUT 5.0

/* And this many times farther in: a placeholder, most likely. */
#define FAR_IN 0.02

/* Share of a body's mass or inertia from which on a link makes a difference to it. */
#define MATTERS 0.1

/* Denser than a link can be even if less of it is drawn than there is; osmium has 22600 [kg/m^3]. */
#define MOST_DENSITY 1e5

/* A body of all that is fixed to each other. */
struct body_facts {
    double mass, moments[3];
    bool possible;
};

static bool is_possible(const double moments[3]) {
    return moments[0] >= -1e-9 * moments[2] && moments[2] <= ROUNDED * (moments[0] + moments[1]);
}

static void body_moments(const robot_body *body, double moments[3]) {
    matrix inertia;
    memcpy(inertia.at, body->inertia, sizeof inertia.at);
    matrix_eigenvalues(&inertia, moments);
}

static double farther(double reach, vector from, vector to, double beyond) {
    return fmax(reach, vector_norm(vector_subtract(to, from)) + beyond);
}

/* How far from its centre of mass anything of a link is: shapes, and joints it is held at; 0: nothing is known. */
static double link_reach(const struct elements *e, int index) {
    const struct file_link *link = &e->links[index];
    const vector centre = link->inertial.origin;
    double reach = 0;
    for (int i = 0; i < link->num_seen; i++) {
        const struct file_shape *shape = &link->shapes[i];
        const double round = shape->kind == ROBOT_SPHERE ? shape->half_size.x : vector_norm(shape->half_size);
        reach = farther(reach, centre, shape->pose.origin, round);
    }
    if (reach == 0) {
        return 0;
    }
    reach = farther(reach, centre, (vector){0, 0, 0}, 0);
    for (int i = 0; i < e->num_joints; i++) {
        if (e->joints[i].parent == index) {
            reach = farther(reach, centre, e->joints[i].origin.origin, 0);
        }
    }
    return reach;
}

/* Told of a link that makes no difference to the body it is part of. */
static const char harmless[] = "; taken as it stands, for it makes no difference to what it is fixed to";

/* A link against its size, where that is known, for as far as that makes a difference. */
static void check_size(struct reading *r, const struct elements *e, int index, const double moments[3],
                       const struct body_facts *body) {
    const struct file_link *link = &e->links[index];
    const double reach = link_reach(e, index);
    if (reach == 0) {
        return;
    }
    const double gyration = sqrt(moments[2] / link->mass);
    const bool turns = moments[2] > MATTERS * body->moments[2], weighs = link->mass > MATTERS * body->mass;
    if (gyration > FAR_OUT * reach) {
        (turns ? fault : remark)(
            r, link->inertia_at, NULL,
            "is that of a mass %.3g m from its centre, but nothing of the link is farther than %.3g m "
            "from it; must be in kg m^2%s",
            gyration, reach, turns ? "" : harmless);
    } else if (weighs && sqrt(body->moments[2] / body->mass) < FAR_IN * reach) {
        fault(r, link->inertia_at, NULL,
              "is that of a mass within %.3g m of its centre, but the link reaches %.3g m from it; must be in kg m^2",
              gyration, reach);
    }
    const double density = link->mass / (4.18879 * reach * reach * reach);
    if (density > MOST_DENSITY) {
        (weighs ? fault : remark)(
            r, link->mass_at, link->mass_at == link->inertia_at ? "mass" : "value",
            "would be %.3g kg in each cubic metre of a ball of %.3g m that holds the link; must be in "
            "kg%s",
            density, reach, weighs ? "" : harmless);
    }
}

static void check_link(struct reading *r, const struct elements *e, int index, const struct body_facts *body) {
    const struct file_link *link = &e->links[index];
    double moments[3];
    matrix_eigenvalues(&link->inertia, moments);
    if (link->mass == 0) {
        if (moments[2] != 0) {
            remark(r, link->inertia_at, NULL, "passed over, as the mass is 0");
        }
        return;
    }
    if (moments[0] < -1e-9 * fabs(moments[2])) {
        fault(r, link->inertia_at, NULL, "has the principal moments %.3g, %.3g, %.3g kg m^2; none may be negative",
              moments[0], moments[1], moments[2]);
        return;
    }
    if (is_sprocket(link->body)) {
        return;
    }
    if (!is_possible(moments)) {
        (body->possible ? remark : fault)(r, link->inertia_at, NULL,
                                          "has the principal moments %.3g, %.3g, %.3g kg m^2, which no body has: the "
                                          "largest is at most the sum of the "
                                          "two others%s",
                                          moments[0], moments[1], moments[2], body->possible ? harmless : "");
        return;
    }
    check_size(r, e, index, moments, body);
}

void inertia_check(struct reading *r, const struct elements *e, const robot_description *robot) {
    struct body_facts facts[ROBOT_MAX_BODIES] = {{0}};
    for (int b = 0; b < robot->num_bodies; b++) {
        if (b > 0 && e->actuators[b - 1].joint < 0) {
            continue; /* a sprocket that no link is */
        }
        const double *moments = facts[b].moments;
        body_moments(&robot->bodies[b], facts[b].moments);
        facts[b].mass = robot->bodies[b].mass;
        facts[b].possible = is_sprocket(b) || is_possible(moments);
        if (!(moments[0] > 0) && facts[b].possible) {
            fault(r, e->links[e->moved[b]].at, NULL,
                  "has, with what is fixed to it, the principal moments %.3g, %.3g, %.3g kg m^2; needs <inertia>, all "
                  "above 0",
                  moments[0], moments[1], moments[2]);
        }
    }
    for (int i = 0; i < e->num_links; i++) {
        check_link(r, e, i, &facts[e->links[i].body]);
    }
}
