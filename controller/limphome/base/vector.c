#include "limphome/base/vector.h"

#include "limphome/base/elementary.h"

lh_vec3 lh_vec3_add(lh_vec3 a, lh_vec3 b) {
    return (lh_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

lh_vec3 lh_vec3_sub(lh_vec3 a, lh_vec3 b) {
    return (lh_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

lh_vec3 lh_vec3_scale(lh_vec3 a, float factor) {
    return (lh_vec3){a.x * factor, a.y * factor, a.z * factor};
}

lh_vec3 lh_vec3_cross(lh_vec3 a, lh_vec3 b) {
    return (lh_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

float lh_vec3_dot(lh_vec3 a, lh_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

float lh_vec3_norm(lh_vec3 a) {
    return lh_sqrt(lh_vec3_dot(a, a));
}

lh_quat lh_quat_about(lh_vec3 axis, float angle) {
    lh_vec3 v = lh_vec3_scale(axis, lh_sin(0.5f * angle));
    return (lh_quat){lh_cos(0.5f * angle), v.x, v.y, v.z};
}

lh_quat lh_quat_multiply(lh_quat a, lh_quat b) {
    return (lh_quat){
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
    };
}

/* v + 2 u x (u x v + w v), with u the vector part of q */
lh_vec3 lh_quat_rotate(lh_quat q, lh_vec3 v) {
    lh_vec3 u = {q.x, q.y, q.z};
    lh_vec3 inner = lh_vec3_add(lh_vec3_cross(u, v), lh_vec3_scale(v, q.w));
    return lh_vec3_add(v, lh_vec3_scale(lh_vec3_cross(u, inner), 2.0f));
}

lh_quat lh_quat_normalise(lh_quat q) {
    float norm = lh_sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (lh_quat){q.w / norm, q.x / norm, q.y / norm, q.z / norm};
}

float lh_quat_heading(lh_quat q) {
    lh_vec3 forward = lh_quat_rotate(q, (lh_vec3){1.0f, 0.0f, 0.0f});
    return lh_wrap_angle(lh_atan2(forward.y, forward.x));
}

/* By two arguments, as an arc sine loses half its digits near the vertical. */
float lh_quat_pitch(lh_quat q) {
    lh_vec3 forward = lh_quat_rotate(q, (lh_vec3){1.0f, 0.0f, 0.0f});
    return lh_atan2(-forward.z, lh_sqrt(forward.x * forward.x + forward.y * forward.y));
}

float lh_quat_roll(lh_quat q) {
    lh_vec3 left = lh_quat_rotate(q, (lh_vec3){0.0f, 1.0f, 0.0f});
    lh_vec3 up = lh_quat_rotate(q, (lh_vec3){0.0f, 0.0f, 1.0f});
    return lh_wrap_angle(lh_atan2(left.z, up.z));
}

float lh_quat_tilt(lh_quat q) {
    return 2.0f * lh_atan2(lh_sqrt(q.x * q.x + q.y * q.y), lh_sqrt(q.w * q.w + q.z * q.z));
}
