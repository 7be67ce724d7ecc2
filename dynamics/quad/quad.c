/* quad.c - see quad.h. */
#include "quad.h"

#include <math.h>
#include <string.h>

/* Twice the signed area of the triangle. */
static double triangle(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* t_i of quad.h divided by the greatest of them, with the quad's orientation as positive.
 * Returns the condition; 0: no quad at all. */
static double weights(const double q[4][2], double t[4])
{
    t[0] = triangle(q[1], q[2], q[3]);
    t[1] = triangle(q[0], q[2], q[3]);
    t[2] = triangle(q[0], q[1], q[3]);
    t[3] = triangle(q[0], q[1], q[2]);
    double most = 0, least = INFINITY, sense = t[0] + t[2] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        most = fmax(most, fabs(t[i]));
    if (!(most > 0 && isfinite(most)))
        return 0;
    for (int i = 0; i < 4; i++) {
        t[i] *= sense / most;
        least = fmin(least, t[i]);
    }
    return least;
}

static bool all_finite(const double q[4][2])
{
    for (int i = 0; i < 4; i++)
        if (!isfinite(q[i][0]) || !isfinite(q[i][1]))
            return false;
    return true;
}

double dyn_quad_condition(const double corners[4][2])
{
    double t[4];
    return all_finite(corners) ? weights(corners, t) : 0;
}

/* The share of the bilinear map. */
static double share(double condition)
{
    double t = (DYN_QUAD_PROJECTIVE_FROM - condition) /
               (DYN_QUAD_PROJECTIVE_FROM - DYN_QUAD_BILINEAR_TO);
    t = fmin(fmax(t, 0), 1);
    return t * t * (3 - 2 * t);
}

bool dyn_quad_make(struct dyn_quad_map *map, enum dyn_quad_kind kind,
                   const double corners[4][2])
{
    double t[4];
    *map = (struct dyn_quad_map){.kind = kind};
    if (!all_finite(corners))
        return false;
    map->condition = weights(corners, t);
    switch (kind) {
    case DYN_QUAD_PROJECTIVE:
        break;
    case DYN_QUAD_BILINEAR:
        map->mix = 1;
        break;
    case DYN_QUAD_SMOOTH:
        map->mix = share(map->condition);
        map->kind = map->mix >= 1  ? DYN_QUAD_BILINEAR
                    : map->mix > 0 ? DYN_QUAD_SMOOTH
                                   : DYN_QUAD_PROJECTIVE;
        break;
    }
    memcpy(map->corner, corners, sizeof map->corner);
    for (int i = 0; i < 4; i++)
        map->weight[i] = map->mix < 1 ? (1 - map->mix) * t[i] + map->mix : 1;
    return map->kind == DYN_QUAD_BILINEAR || map->condition > 0;
}

bool dyn_quad_point(const struct dyn_quad_map *map, double u, double v, double *x, double *y,
                    double jacobian[4])
{
    const double *t = map->weight;
    double b[4] = {(1 - u) * (1 - v) * t[0], u * (1 - v) * t[1], u * v * t[2],
                   (1 - u) * v * t[3]};
    double along_u[4] = {-(1 - v) * t[0], (1 - v) * t[1], v * t[2], -v * t[3]};
    double along_v[4] = {-(1 - u) * t[0], -u * t[1], u * t[2], (1 - u) * t[3]};
    double sum[3] = {0}, du[3] = {0}, dv[3] = {0};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            double q = k < 2 ? map->corner[i][k] : 1;
            sum[k] += b[i] * q;
            du[k] += along_u[i] * q;
            dv[k] += along_v[i] * q;
        }
    if (!(sum[2] > 0))
        return false;
    *x = sum[0] / sum[2];
    *y = sum[1] / sum[2];
    for (int k = 0; jacobian && k < 2; k++) {
        double at = k ? *y : *x;
        jacobian[2 * k] = (du[k] - at * du[2]) / sum[2];
        jacobian[2 * k + 1] = (dv[k] - at * dv[2]) / sum[2];
    }
    return true;
}

void dyn_quad_coefficients(const struct dyn_quad_map *map, double c[3][4])
{
    const double *t = map->weight;
    for (int k = 0; k < 3; k++) {
        double at[4];
        for (int i = 0; i < 4; i++)
            at[i] = t[i] * (k < 2 ? map->corner[i][k] : 1);
        c[k][0] = at[0];
        c[k][1] = at[1] - at[0];
        c[k][2] = at[3] - at[0];
        c[k][3] = map->kind == DYN_QUAD_PROJECTIVE ? 0 : at[0] - at[1] + at[2] - at[3];
    }
}

/* The distance outside of the square; 0 within. */
static double outside(double u, double v)
{
    return fmax(fmax(fmax(-u, u - 1), fmax(-v, v - 1)), 0);
}

/* Tries a solution, which replaces the best so far if it is better: v is known; u comes from
 * the equation in which it has the larger coefficient. */
static void solution(const struct dyn_quad_map *map, const double e[2][4], double v,
                     double *best, double *to_u, double *to_v)
{
    double along[2] = {e[0][1] + v * e[0][3], e[1][1] + v * e[1][3]}, x, y;
    int k = fabs(along[0]) > fabs(along[1]) ? 0 : 1;
    double u = -(e[k][0] + v * e[k][2]) / along[k];
    if (isfinite(u) && isfinite(v) && outside(u, v) < *best &&
        dyn_quad_point(map, u, v, &x, &y, NULL)) {
        *best = outside(u, v);
        *to_u = u;
        *to_v = v;
    }
}

/* Two equations, e[k] = (x w) - x w = 0, of the form a + b u + c v + d u v. Eliminating u
 * gives a quadratic equation in v. */
bool dyn_quad_inverse(const struct dyn_quad_map *map, double x, double y, double *u, double *v)
{
    double c[3][4], e[2][4], best = INFINITY;
    dyn_quad_coefficients(map, c);
    for (int i = 0; i < 4; i++) {
        e[0][i] = c[0][i] - x * c[2][i];
        e[1][i] = c[1][i] - y * c[2][i];
    }
    double k2 = e[0][2] * e[1][3] - e[1][2] * e[0][3];
    double k1 = e[0][0] * e[1][3] - e[1][0] * e[0][3] + e[0][2] * e[1][1] - e[1][2] * e[0][1];
    double k0 = e[0][0] * e[1][1] - e[1][0] * e[0][1];
    double root = k1 * k1 - 4 * k2 * k0;
    if (!(root >= 0))
        return false;
    double q = -0.5 * (k1 + copysign(sqrt(root), k1));
    solution(map, e, q / k2, &best, u, v);
    solution(map, e, k0 / q, &best, u, v);
    return best < INFINITY;
}

/* ---- matrices ---- */

void dyn_quad_matrix(const struct dyn_quad_map *map, double m[4][4])
{
    static const int from[3] = {1, 2, 0}, row[3] = {0, 1, 3}; /* u, v, 1 */
    double c[3][4];
    dyn_quad_coefficients(map, c);
    memset(m, 0, 16 * sizeof(double));
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            m[row[i]][row[k]] = c[k][from[i]];
}

static void identity(double m[4][4])
{
    for (int i = 0; i < 16; i++)
        m[i / 4][i % 4] = i / 4 == i % 4;
}

/* m = m n */
static void multiply(double m[4][4], const double n[4][4])
{
    double out[4][4] = {{0}};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            for (int j = 0; j < 4; j++)
                out[i][j] += m[i][k] * n[k][j];
    memcpy(m, out, sizeof out);
}

bool dyn_quad_thesis(const double q[4][2], double m[4][4])
{
    double scale_x = q[1][0] - q[0][0], scale_y = q[3][1] - q[0][1];
    double shear_x = (q[3][0] - q[0][0]) / scale_x, shear_y = (q[1][1] - q[0][1]) / scale_y;
    double turned = 1 - shear_x * shear_y;
    double x3 = (q[2][0] - q[0][0]) / scale_x, y3 = (q[2][1] - q[0][1]) / scale_y;
    double homo_x = (x3 - shear_x * y3) / turned, homo_y = y3 - shear_y * homo_x;
    double across = homo_x + homo_y - 1;
    double a = (1 - homo_y) / across, b = (1 - homo_x) / across, n[4][4];
    if (scale_x == 0 || scale_y == 0 || turned == 0 || across == 0)
        return false;
    identity(m);
    m[0][0] = a + 1;
    m[1][1] = b + 1;
    m[0][3] = a;
    m[1][3] = b;
    identity(n);
    n[1][0] = shear_x;
    n[0][1] = shear_y;
    multiply(m, n);
    identity(n);
    n[0][0] = scale_x;
    n[1][1] = scale_y;
    multiply(m, n);
    identity(n);
    n[3][0] = q[0][0];
    n[3][1] = q[0][1];
    multiply(m, n);
    return true;
}
