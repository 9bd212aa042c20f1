/* Normalised energy (NE) stability margin (10)(11): how far the centre of mass must rise before the robot tips over the
 * easiest edge of its support polygon. */
#ifndef LIMPHOME_STABILITY_H
#define LIMPHOME_STABILITY_H

#include <stdint.h>

#include "limphome/base/capacity.h"
#include "limphome/base/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* S_i of (10) for tipping about the line through a and b: with k its unit vector, r = g - a and p = r - (k.r) k,
 * S = |p| sqrt(1 - kz^2) - pz [m]. At least 0 on both sides of the line; 0 about a vertical one, or when a = b. */
float lh_stability_edge(lh_vec3 a, lh_vec3 b, lh_vec3 centre_of_mass);

/* S_NE of (11) [m]: the least S_i over the edges of the convex hull (seen from above) of points[count].
 * Where the centre of mass lies outside the hull (seen from above), the negative of the least S_i of the edges it is
 * outside of. Fewer than 3 points, or all in a line, carry nothing: the result is 0 or below.
 * count is 0 to LH_MAX_SUPPORTS. */
float lh_stability_margin(const lh_vec3 *points, int32_t count, lh_vec3 centre_of_mass);

#ifdef __cplusplus
}
#endif
#endif
