#include "limphome/body/stability.h"

#include <stdbool.h>

#include "limphome/base/elementary.h"

float lh_stability_edge(lh_vec3 a, lh_vec3 b, lh_vec3 centre_of_mass) {
    lh_vec3 along = lh_vec3_sub(b, a);
    float length = lh_vec3_norm(along);
    if (length == 0.0f) {
        return 0.0f;
    }
    lh_vec3 k = lh_vec3_scale(along, 1.0f / length);
    lh_vec3 r = lh_vec3_sub(centre_of_mass, a);
    lh_vec3 p = lh_vec3_sub(r, lh_vec3_scale(k, lh_vec3_dot(k, r)));
    /* sqrt(1 - kz^2), without its cancellation for a steep edge */
    float level = lh_sqrt(k.x * k.x + k.y * k.y);
    float rise = lh_vec3_norm(p) * level - p.z;
    return rise > 0.0f ? rise : 0.0f; /* rounding */
}

/* Twice the area of the triangle a, b, c seen from above; positive if c lies left of a->b. */
static float area(lh_vec3 a, lh_vec3 b, lh_vec3 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Insertion sort by x, then y. */
static void sort(lh_vec3 *points, int32_t count) {
    for (int32_t i = 1; i < count; i++) {
        lh_vec3 moving = points[i];
        int32_t place = i;
        while (place > 0 && (points[place - 1].x > moving.x ||
                             (points[place - 1].x == moving.x && points[place - 1].y > moving.y))) {
            points[place] = points[place - 1];
            --place;
        }
        points[place] = moving;
    }
}

/* Adds `point` to one half of the hull, hull[start..size), after dropping the points that it makes superfluous.
 * Returns the new size. */
static int32_t push(lh_vec3 *hull, int32_t start, int32_t size, lh_vec3 point) {
    while (size >= start + 2 && area(hull[size - 2], hull[size - 1], point) <= 0.0f) {
        --size;
    }
    hull[size] = point;
    return size + 1;
}

/* Convex hull seen from above, counter-clockwise, by Andrew's monotone chain; points[count] end up sorted.
 * hull has room for 2 * count. Returns its number of corners, below 3 if the points are in a line. */
static int32_t convex_hull(lh_vec3 *points, int32_t count, lh_vec3 *hull) {
    sort(points, count);
    int32_t size = 0;
    for (int32_t i = 0; i < count; i++) {
        size = push(hull, 0, size, points[i]);
    }
    int32_t start = size - 1; /* the upper half begins at the last point of the lower */
    for (int32_t i = count - 2; i >= 0; --i) {
        size = push(hull, start, size, points[i]);
    }
    return count > 1 ? size - 1 : size; /* the first point closes the upper half */
}

float lh_stability_margin(const lh_vec3 *points, int32_t count, lh_vec3 centre_of_mass) {
    lh_vec3 sorted[LH_MAX_SUPPORTS];
    lh_vec3 hull[2 * LH_MAX_SUPPORTS];
    for (int32_t i = 0; i < count; i++) {
        sorted[i] = points[i];
    }
    int32_t corners = convex_hull(sorted, count, hull);
    if (corners == 0) {
        return 0.0f;
    }

    float inside = FLT_MAX;
    float outside = FLT_MAX;
    for (int32_t i = 0; i < corners; i++) {
        lh_vec3 a = hull[i];
        lh_vec3 b = hull[(i + 1) % corners];
        float rise = lh_stability_edge(a, b, centre_of_mass);
        /* both sides of a line are outside of it */
        bool is_outside = corners < 3 || area(a, b, centre_of_mass) < 0.0f;
        float *least = is_outside ? &outside : &inside;
        *least = rise < *least ? rise : *least;
    }
    return outside < FLT_MAX ? 0.0f - outside : inside;
}
