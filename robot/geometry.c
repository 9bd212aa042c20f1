#include "geometry.h"

#include <math.h>

vector vector_add(vector a, vector b) {
    return (vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

vector vector_subtract(vector a, vector b) {
    return (vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

vector vector_scale(vector v, double factor) {
    return (vector){v.x * factor, v.y * factor, v.z * factor};
}

double vector_dot(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

vector vector_cross(vector a, vector b) {
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double vector_norm(vector v) {
    return sqrt(vector_dot(v, v));
}

vector vector_unit(vector v) {
    const double norm = vector_norm(v);
    return (vector){v.x / norm, v.y / norm, v.z / norm};
}

double vector_component(vector v, int index) {
    return index == 0 ? v.x : index == 1 ? v.y : v.z;
}

void vector_store(vector v, double out[3]) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

vector vector_of(const double from[3]) {
    return (vector){from[0], from[1], from[2]};
}

matrix matrix_identity(void) {
    return (matrix){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

matrix matrix_multiply(const matrix *a, const matrix *b) {
    matrix product;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            product.at[i][k] = a->at[i][0] * b->at[0][k] + a->at[i][1] * b->at[1][k] + a->at[i][2] * b->at[2][k];
        }
    }
    return product;
}

matrix matrix_transpose(const matrix *m) {
    matrix transposed;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            transposed.at[i][k] = m->at[k][i];
        }
    }
    return transposed;
}

vector matrix_apply(const matrix *m, vector v) {
    return (vector){m->at[0][0] * v.x + m->at[0][1] * v.y + m->at[0][2] * v.z,
                    m->at[1][0] * v.x + m->at[1][1] * v.y + m->at[1][2] * v.z,
                    m->at[2][0] * v.x + m->at[2][1] * v.y + m->at[2][2] * v.z};
}

/* Jacobi's rotation that makes m[p][q] zero. */
static void rotate_away(matrix *m, int p, int q) {
    if (m->at[p][q] == 0) {
        return;
    }
    const double theta = (m->at[q][q] - m->at[p][p]) / (2 * m->at[p][q]);
    const double t = copysign(1, theta) / (fabs(theta) + hypot(theta, 1));
    const double c = 1 / hypot(t, 1);
    matrix rotation = matrix_identity();
    rotation.at[p][p] = rotation.at[q][q] = c;
    rotation.at[p][q] = t * c;
    rotation.at[q][p] = -t * c;
    const matrix left = matrix_transpose(&rotation);
    const matrix half = matrix_multiply(&left, m);
    *m = matrix_multiply(&half, &rotation);
    m->at[p][q] = m->at[q][p] = 0;
}

void matrix_eigenvalues(const matrix *m, double values[3]) {
    enum { SWEEPS = 12 }; /* converges quadratically: a few are enough */
    matrix rest = *m;
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        rotate_away(&rest, 0, 1);
        rotate_away(&rest, 0, 2);
        rotate_away(&rest, 1, 2);
    }
    for (int i = 0; i < 3; i++) {
        values[i] = rest.at[i][i];
    }
    for (int i = 0; i < 3; i++) { /* three values: two passes of neighbours sort them */
        for (int k = 0; k < 2; k++) {
            if (values[k] > values[k + 1]) {
                const double larger = values[k];
                values[k] = values[k + 1];
                values[k + 1] = larger;
            }
        }
    }
}

frame frame_identity(void) {
    return (frame){{0, 0, 0}, matrix_identity()};
}

vector frame_apply(const frame *f, vector point) {
    return vector_add(matrix_apply(&f->axes, point), f->origin);
}

frame frame_multiply(const frame *a, const frame *b) {
    return (frame){frame_apply(a, b->origin), matrix_multiply(&a->axes, &b->axes)};
}

frame frame_inverse(const frame *f) {
    const matrix axes = matrix_transpose(&f->axes);
    return (frame){matrix_apply(&axes, vector_scale(f->origin, -1)), axes};
}

frame frame_about(vector axis, double angle) {
    const double c = cos(angle), s = sin(angle), d = 1 - c;
    const vector a = axis;
    return (frame){{0, 0, 0},
                   {{{c + d * a.x * a.x, d * a.x * a.y - s * a.z, d * a.x * a.z + s * a.y},
                     {d * a.y * a.x + s * a.z, c + d * a.y * a.y, d * a.y * a.z - s * a.x},
                     {d * a.z * a.x - s * a.y, d * a.z * a.y + s * a.x, c + d * a.z * a.z}}}};
}

frame frame_from_rpy(vector origin, vector rpy) {
    const frame roll = frame_about((vector){1, 0, 0}, rpy.x);
    const frame pitch = frame_about((vector){0, 1, 0}, rpy.y);
    const frame yaw = frame_about((vector){0, 0, 1}, rpy.z);
    const matrix tilted = matrix_multiply(&pitch.axes, &roll.axes);
    return (frame){origin, matrix_multiply(&yaw.axes, &tilted)};
}

/* The largest component is found from the diagonal, so that no small number is divided by. */
robot_pose frame_pose(const frame *f) {
    const double(*m)[3] = f->axes.at;
    const double squares[4] = {1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2],
                               1 - m[0][0] + m[1][1] - m[2][2], 1 - m[0][0] - m[1][1] + m[2][2]};
    const double products[4][4] = {
        {squares[0], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
        {m[2][1] - m[1][2], squares[1], m[1][0] + m[0][1], m[0][2] + m[2][0]},
        {m[0][2] - m[2][0], m[1][0] + m[0][1], squares[2], m[2][1] + m[1][2]},
        {m[1][0] - m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2], squares[3]},
    };
    int largest = 0;
    for (int i = 1; i < 4; i++) {
        largest = squares[i] > squares[largest] ? i : largest;
    }
    robot_pose pose;
    vector_store(f->origin, pose.position);
    double norm = 0;
    for (int i = 0; i < 4; i++) {
        norm += products[largest][i] * products[largest][i];
    }
    const double sign = products[largest][0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++) {
        pose.rotation[i] = sign * products[largest][i] / sqrt(norm);
    }
    return pose;
}

frame frame_of(const robot_pose *pose) {
    const double w = pose->rotation[0], x = pose->rotation[1], y = pose->rotation[2], z = pose->rotation[3];
    return (frame){vector_of(pose->position),
                   {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                     {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                     {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}}};
}
