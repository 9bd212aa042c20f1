/* Vectors, rotations and frames in double precision. Products with what is exactly identity are exact. */
#ifndef LIMPHOME_ROBOT_GEOMETRY_H
#define LIMPHOME_ROBOT_GEOMETRY_H

#include "robot_description.h"

typedef struct vector {
    double x, y, z;
} vector;

typedef struct matrix {
    double at[3][3];
} matrix;

/* Where something is: its origin and, as columns, its axes, seen from what it hangs on. */
typedef struct frame {
    vector origin;
    matrix axes;
} frame;

vector vector_add(vector a, vector b);
vector vector_subtract(vector a, vector b);
vector vector_scale(vector v, double factor);
double vector_dot(vector a, vector b);
vector vector_cross(vector a, vector b);
double vector_norm(vector v);
/* Of length 1; v must not be zero. */
vector vector_unit(vector v);
/* Component 0, 1 or 2. */
double vector_component(vector v, int index);
void vector_store(vector v, double out[3]);
vector vector_of(const double from[3]);

matrix matrix_identity(void);
matrix matrix_multiply(const matrix *a, const matrix *b);
matrix matrix_transpose(const matrix *m);
vector matrix_apply(const matrix *m, vector v);
/* Symmetric: eigenvalues, least first. */
void matrix_eigenvalues(const matrix *m, double values[3]);

frame frame_identity(void);
frame frame_multiply(const frame *a, const frame *b);
frame frame_inverse(const frame *f);
vector frame_apply(const frame *f, vector point);
/* URDF's pose: roll, pitch, yaw about fixed axes. */
frame frame_from_rpy(vector origin, vector rpy);
/* Turned by `angle` about the unit vector `axis`. */
frame frame_about(vector axis, double angle);
robot_pose frame_pose(const frame *f);
frame frame_of(const robot_pose *pose);

#endif
