#include "touch.h"

#include <math.h>
#include <stdlib.h>

#include "robot_solid.h"

/* Shapes may reach beyond a belt by this share of its radius and still be the belt. */
#define BEYOND_BELT 0.05

/* Shapes may reach below the ground by this share of the crawlers' radius: what belts sink in, and rounding. */
#define BELOW_GROUND 0.005

/* What is fixed to the base must be as far above the ground [m]: belts sink in by half of it, more at one end. */
#define CLEARANCE 0.002

/* A shape on its way into the description. */
struct candidate {
    const struct xml_element *at;
    const struct file_link *link;
    robot_shape shape;
};

struct candidates {
    struct candidate *list;
    int count;
};

/* How far a shape reaches from its middle along a unit vector. */
static double reach(const robot_solid *solid, vector along) {
    double direction[3];
    vector_store(along, direction);
    return robot_solid_half_width(solid, direction);
}

/* Whether a shape lies within the box round a crawler. */
static bool is_belt(const robot_solid *solid, const robot_crawler *crawler) {
    const vector across = vector_of(crawler->axis), up = {0, 0, 1};
    const vector along = vector_cross(across, up);
    const vector away = vector_subtract(vector_of(solid->centre), vector_of(crawler->centre));
    const double room = BEYOND_BELT * crawler->radius;
    return fabs(vector_dot(away, along)) + reach(solid, along) <= crawler->length / 2 + room &&
           fabs(vector_dot(away, across)) + reach(solid, across) <= crawler->width / 2 + room &&
           fabs(vector_dot(away, up)) + reach(solid, up) <= crawler->radius + room;
}

/* Whether turning the sprocket leaves a shape as it is. */
static bool is_round_about(const robot_shape *shape, const robot_body *sprocket) {
    const double alike = 1e-3;
    const frame pose = frame_of(&shape->pose);
    const vector axis = vector_of(sprocket->axis);
    const vector off = vector_cross(pose.origin, axis);
    const vector own = {pose.axes.at[0][2], pose.axes.at[1][2], pose.axes.at[2][2]};
    const bool centred = vector_norm(off) <= alike * shape->half_size[0];
    return centred && (shape->kind == ROBOT_SPHERE ||
                       (shape->kind == ROBOT_CYLINDER && vector_norm(vector_cross(own, axis)) <= alike));
}

/* Whether a shape is left out: it belongs to a crawler. */
static bool belongs_to_belt(struct reading *r, const struct candidate *c, const robot_solid *solid,
                            const robot_description *robot) {
    const int body = c->shape.body;
    if (body > ROBOT_CRAWLERS) {
        return false;
    }
    for (int i = 0; i < ROBOT_CRAWLERS; i++) {
        if ((body == 0 || body == i + 1) && is_belt(solid, &robot->crawlers[i])) {
            remark(r, c->at, NULL, "lies within the %s crawler; left out, as the crawler's belt takes its place",
                   i == 0 ? "left" : "right");
            return true;
        }
    }
    if (is_sprocket(body) && !is_round_about(&c->shape, &robot->bodies[body])) {
        fault(r, c->at, NULL,
              "turns with the sprocket of a crawler and reaches beyond the crawler (length %g, width %g, radius %g m); "
              "must lie within it, be round about the sprocket's axis, or be left out by <no_contact link1=\"%s\"/>",
              robot->crawlers[body - 1].length, robot->crawlers[body - 1].width, robot->crawlers[body - 1].radius,
              c->shape.name);
    }
    return false;
}

static double mean_radius(const robot_description *robot) {
    return (robot->crawlers[0].radius + robot->crawlers[1].radius) / 2;
}

/* The robot is to stand on its crawlers when it is put down; the arm may then rest on the ground. */
static void check_above_ground(struct reading *r, const struct candidate *c, const robot_solid *solid,
                               const robot_description *robot) {
    const double lowest = solid->centre[2] - reach(solid, (vector){0, 0, 1});
    const bool is_arm = c->shape.body > ROBOT_CRAWLERS;
    if (lowest < -BELOW_GROUND * mean_radius(robot)) {
        fault(r, c->at, NULL,
              "reaches %.3g m below the ground on which the crawlers stand%s: the robot would stand on it, not on its "
              "crawlers; must not, or be left out by <no_contact link1=\"%s\"/>",
              -lowest, is_arm ? " (in the initial pose, home)" : "", c->shape.name);
    } else if (!is_arm && lowest < CLEARANCE) {
        fault(r, c->at, NULL,
              "reaches down to %g m above the ground on which the crawlers stand: part of the weight would rest on it; "
              "must end %g m above it, lie within a crawler, or be left out by <no_contact link1=\"%s\"/>",
              rint(lowest * 1e5) / 1e5 + 0.0, CLEARANCE, c->shape.name);
    }
}

static void check_supports(struct reading *r, const struct elements *e, const robot_description *robot) {
    for (int i = robot->num_tips; i < e->num_supports; i++) {
        const robot_support *support = &robot->supports[i];
        const double lowest = support->point[2] - support->radius;
        if (support->body == 0 && lowest < -BELOW_GROUND * mean_radius(robot)) {
            fault(r, e->supports[i].at, "xyz", "lies %.3g m below the ground on which the crawlers stand; must not",
                  -lowest);
        }
    }
}

static void add(struct candidates *all, const struct xml_element *at, const struct file_link *link,
                const struct file_shape *from) {
    struct candidate *c = &all->list[all->count++];
    const frame pose = frame_multiply(&link->pose, &from->pose);
    c->at = at;
    c->link = link;
    short_name(c->shape.name, link->name);
    c->shape.body = link->body;
    c->shape.kind = from->kind;
    c->shape.pose = frame_pose(&pose);
    vector_store(from->half_size, c->shape.half_size);
}

/* Tips first, then the shapes of each link. */
static struct candidates gather(struct reading *r, const struct elements *e, const int order[MOST_LINKS]) {
    int count = e->num_tips;
    for (int i = 0; i < e->num_links; i++) {
        count += e->links[i].num_shapes;
    }
    struct candidates all = {.list = arena_take(&r->arena, (size_t)count, sizeof *all.list)};
    for (int i = 0; i < e->num_tips; i++) {
        const struct file_support *tip = &e->supports[i];
        const struct file_shape ball = {.kind = ROBOT_SPHERE,
                                        .pose = {tip->point, matrix_identity()},
                                        .half_size = {tip->radius, tip->radius, tip->radius}};
        add(&all, tip->at, &e->links[tip->link], &ball);
    }
    for (int i = 0; i < e->num_links; i++) {
        const struct file_link *link = &e->links[order[i]];
        for (int k = 0; k < link->num_shapes; k++) {
            add(&all, link->shapes[k].at, link, &link->shapes[k]);
        }
    }
    return all;
}

/* Half the longest line through a shape. */
static double bulk(const robot_shape *shape) {
    return shape->kind == ROBOT_SPHERE ? shape->half_size[0] : vector_norm(vector_of(shape->half_size));
}

static int smaller_first(const void *a, const void *b) {
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* How large a shape must be for there to be room for it: the smallest go first. */
static double least_bulk(struct reading *r, const struct elements *e, const struct candidates *all, int num_tips) {
    const int count = all->count - num_tips, room = ROBOT_MAX_SHAPES - num_tips;
    if (count <= room) {
        return 0;
    }
    double *sizes = arena_take(&r->arena, (size_t)count, sizeof *sizes);
    for (int i = 0; i < count; i++) {
        sizes[i] = bulk(&all->list[num_tips + i].shape);
    }
    qsort(sizes, (size_t)count, sizeof *sizes, smaller_first);
    const double least = sizes[count - room];
    remark(r, e->robot, NULL,
           "has %d shapes that may touch; the %d smallest, of at most %.3g m, are left out, for there is room for %d",
           count, count - room, 2 * least, room);
    return least;
}

/* Leaves out what is a belt; all else must be where it leaves the robot on its crawlers. */
static void sort_out(struct reading *r, struct candidates *all, const robot_description *robot) {
    int kept = 0;
    for (int i = 0; i < all->count; i++) {
        const struct candidate *c = &all->list[i];
        const robot_solid solid = robot_solid_at_home(robot, &c->shape);
        if (vector_norm(vector_of(solid.centre)) > 2 * MOST_METRES) {
            fault(r, c->at, NULL, "is more than %g m from the base", 2 * MOST_METRES);
        } else if (i < robot->num_tips || !belongs_to_belt(r, c, &solid, robot)) {
            check_above_ground(r, c, &solid, robot);
            all->list[kept++] = *c;
        }
    }
    all->count = kept;
}

void touch_find(struct reading *r, struct elements *e, const int order[MOST_LINKS], robot_description *robot) {
    struct candidates all = gather(r, e, order);
    check_supports(r, e, robot);
    sort_out(r, &all, robot);
    const double least = least_bulk(r, e, &all, robot->num_tips);
    for (int i = 0; i < all.count; i++) {
        const robot_shape *shape = &all.list[i].shape;
        if ((i < robot->num_tips || bulk(shape) >= least) && robot->num_shapes < ROBOT_MAX_SHAPES) {
            e->shape_links[robot->num_shapes] = all.list[i].link;
            robot->shapes[robot->num_shapes++] = *shape;
        }
    }
}
