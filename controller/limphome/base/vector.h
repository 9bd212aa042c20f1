/* Vectors and rotations in three dimensions, single precision. */
#ifndef LIMPHOME_VECTOR_H
#define LIMPHOME_VECTOR_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_vec3 {
    float x, y, z;
} lh_vec3;

/* Unit quaternion, w the scalar part. */
typedef struct lh_quat {
    float w, x, y, z;
} lh_quat;

lh_vec3 lh_vec3_add(lh_vec3 a, lh_vec3 b);
lh_vec3 lh_vec3_sub(lh_vec3 a, lh_vec3 b);
lh_vec3 lh_vec3_scale(lh_vec3 a, float factor);
lh_vec3 lh_vec3_cross(lh_vec3 a, lh_vec3 b);
float lh_vec3_dot(lh_vec3 a, lh_vec3 b);
float lh_vec3_norm(lh_vec3 a);

/* Rotation by `angle` [rad] about `axis`, a unit vector, right-handed. */
lh_quat lh_quat_about(lh_vec3 axis, float angle);
/* First b, then a. */
lh_quat lh_quat_multiply(lh_quat a, lh_quat b);
/* v turned by q. */
lh_vec3 lh_quat_rotate(lh_quat q, lh_vec3 v);
/* q scaled to unit length; q must not be 0. */
lh_quat lh_quat_normalise(lh_quat q);

/* Angles of the rotation body to world, applied in the order yaw, pitch, roll (z, y', x''):
 * heading: angle of the body's x axis from the world's x axis, seen from above, in (-pi, pi] [rad]
 * pitch: positive nose down, in [-pi/2, pi/2] [rad]; roll: positive left side up, in (-pi, pi] [rad] */
float lh_quat_heading(lh_quat q);
float lh_quat_pitch(lh_quat q);
float lh_quat_roll(lh_quat q);

/* Angle between the body's z axis and the world's z axis, in [0, pi] [rad]. */
float lh_quat_tilt(lh_quat q);

#ifdef __cplusplus
}
#endif
#endif
