/* map.c - maps from an outline's plane to the picture's: see edges.h. */
#include "edges.h"
#include "internal.h"

#include <math.h>
#include <quad.h>

struct font_map font_map_size(double size_px, double units_per_em)
{
    double scale = size_px / units_per_em;
    return (struct font_map){FONT_AFFINE, {scale, 0, 0, 0, -scale, 0}};
}

struct font_map font_map_rotation(double degrees)
{
    double c = cos(degrees * M_PI / 180), s = sin(degrees * M_PI / 180);
    return (struct font_map){FONT_AFFINE, {c, s, 0, -s, c, 0}}; /* y is downwards */
}

struct font_map font_map_shear(double x_per_y)
{
    return (struct font_map){FONT_AFFINE, {1, -x_per_y, 0, 0, 1, 0}};
}

struct font_map font_map_then(struct font_map map, struct font_map affine)
{
    const double *a = affine.m, *m = map.m;
    struct font_map out = map;
    double *r = out.m;
    switch (map.kind) {
    case FONT_AFFINE:
        for (int i = 0; i < 3; i++) {
            r[i] = a[0] * m[i] + a[1] * m[3 + i] + (i == 2 ? a[2] : 0);
            r[3 + i] = a[3] * m[i] + a[4] * m[3 + i] + (i == 2 ? a[5] : 0);
        }
        break;
    case FONT_PROJECTIVE:
        for (int i = 0; i < 3; i++) {
            r[i] = a[0] * m[i] + a[1] * m[3 + i] + a[2] * m[6 + i];
            r[3 + i] = a[3] * m[i] + a[4] * m[3 + i] + a[5] * m[6 + i];
        }
        break;
    case FONT_BILINEAR:
        for (int i = 0; i < 4; i++) {
            r[i] = a[0] * m[i] + a[1] * m[4 + i] + (i == 0 ? a[2] : 0);
            r[4 + i] = a[3] * m[i] + a[4] * m[4 + i] + (i == 0 ? a[5] : 0);
        }
        break;
    case FONT_SMOOTH:
        for (int i = 0; i < 4; i++) {
            r[i] = a[0] * m[i] + a[1] * m[4 + i] + a[2] * m[8 + i];
            r[4 + i] = a[3] * m[i] + a[4] * m[4 + i] + a[5] * m[8 + i];
        }
        break;
    }
    return out;
}

/* Twice the signed area of the triangle. */
static double triangle(struct font_point a, struct font_point b, struct font_point c)
{
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/* The unit square onto four corners. False: there is no such map. */
static bool square_to(enum font_map_kind kind, const struct font_point q[4],
                      struct font_map *out)
{
    static const enum dyn_quad_kind kinds[] = {[FONT_PROJECTIVE] = DYN_QUAD_PROJECTIVE,
                                               [FONT_BILINEAR] = DYN_QUAD_BILINEAR,
                                               [FONT_SMOOTH] = DYN_QUAD_SMOOTH};
    struct dyn_quad_map map;
    double corners[4][2], c[3][4];
    for (int i = 0; i < 4; i++) {
        corners[i][0] = q[i].x;
        corners[i][1] = q[i].y;
    }
    if (!dyn_quad_make(&map, kinds[kind], corners))
        return false;
    dyn_quad_coefficients(&map, c);
    *out = (struct font_map){.kind = map.kind == DYN_QUAD_PROJECTIVE ? FONT_PROJECTIVE
                                     : map.kind == DYN_QUAD_BILINEAR ? FONT_BILINEAR
                                                                     : FONT_SMOOTH};
    bool projective = out->kind == FONT_PROJECTIVE;
    for (int k = 0; k < 3; k++)
        for (int i = 0; projective && i < 3; i++)
            out->m[3 * k + i] = c[k][(i + 1) % 3]; /* x, y, 1 */
    for (int i = 0; !projective && i < (out->kind == FONT_SMOOTH ? 12 : 8); i++)
        out->m[i] = c[i / 4][i % 4];
    return true;
}

/* A square form in x and y. */
struct square {
    double xx, xy, yy, x, y, one;
};

/* What x y stands for in a map m, of an affine map's x and y. */
static struct square square_after(const double *m, const double *a)
{
    const double p = m[12], r = 1 + m[13], q = m[14];
    return (struct square){
        .xx = r * a[0] * a[3] + p * a[0] * a[0] + q * a[3] * a[3],
        .xy = r * (a[0] * a[4] + a[1] * a[3]) + 2 * (p * a[0] * a[1] + q * a[3] * a[4]),
        .yy = r * a[1] * a[4] + p * a[1] * a[1] + q * a[4] * a[4],
        .x = r * (a[0] * a[5] + a[2] * a[3]) + 2 * (p * a[0] * a[2] + q * a[3] * a[5]),
        .y = r * (a[1] * a[5] + a[2] * a[4]) + 2 * (p * a[1] * a[2] + q * a[4] * a[5]),
        .one = r * a[2] * a[5] + p * a[2] * a[2] + q * a[5] * a[5]};
}

enum font_status font_map_compose(const struct font_map *first, const struct font_map *second,
                                  struct font_map *out)
{
    struct font_map before = *first, after = *second; /* *out may be either */
    const double *a = before.m, *m = after.m;
    if (before.kind != FONT_AFFINE)
        return font_fail(FONT_BAD_ARGUMENT, "a distortion comes last, after affine maps");
    *out = after;
    double *r = out->m;
    switch (after.kind) {
    case FONT_AFFINE:
    case FONT_PROJECTIVE:
        for (int row = 0; row < (after.kind == FONT_AFFINE ? 2 : 3); row++) {
            const double *s = m + 3 * row;
            r[3 * row] = s[0] * a[0] + s[1] * a[3];
            r[3 * row + 1] = s[0] * a[1] + s[1] * a[4];
            r[3 * row + 2] = s[0] * a[2] + s[1] * a[5] + s[2];
        }
        return FONT_OK;
    case FONT_BILINEAR:
    case FONT_SMOOTH:
        break;
    }
    struct square q = square_after(m, a);
    /* Where type is only sized and moved, x y is what it was. */
    bool mixed = fabs(q.xx) <= 1e-12 * fabs(q.xy) && fabs(q.yy) <= 1e-12 * fabs(q.xy);
    r[12] = mixed ? 0 : q.xx;
    r[13] = mixed ? 0 : q.xy - 1;
    r[14] = mixed ? 0 : q.yy;
    for (int row = 0; row < (after.kind == FONT_SMOOTH ? 3 : 2); row++) {
        const double *s = m + 4 * row;
        r[4 * row] = s[0] + s[1] * a[2] + s[2] * a[5] + s[3] * q.one;
        r[4 * row + 1] = s[1] * a[0] + s[2] * a[3] + s[3] * q.x;
        r[4 * row + 2] = s[1] * a[1] + s[2] * a[4] + s[3] * q.y;
        r[4 * row + 3] = mixed ? s[3] * q.xy : s[3];
    }
    return FONT_OK;
}

enum font_status font_map_corners(enum font_map_kind kind, double x0, double y0, double x1,
                                  double y1, const struct font_point q[4], struct font_map *out)
{
    double least = 1e300, most = -1e300;
    for (int i = 0; i < 4; i++) {
        double area = triangle(q[i], q[(i + 1) % 4], q[(i + 2) % 4]);
        least = fmin(least, area);
        most = fmax(most, area);
        if (!(fabs(q[i].x) <= 1e6 && fabs(q[i].y) <= 1e6))
            return font_fail(FONT_BAD_ARGUMENT, "a corner cannot be (%g, %g)", q[i].x, q[i].y);
    }
    if (!(x1 > x0 && y1 > y0) || kind == FONT_AFFINE)
        return font_fail(FONT_BAD_ARGUMENT, "corners are given to a rectangle");
    if (kind != FONT_SMOOTH && !(least > 1e-9) && !(most < -1e-9))
        return font_fail(FONT_BAD_ARGUMENT,
                         "the four corners must go around a shape without a dent");
    struct font_map unit = {
        FONT_AFFINE, {1 / (x1 - x0), 0, -x0 / (x1 - x0), 0, 1 / (y1 - y0), -y0 / (y1 - y0)}};
    struct font_map square;
    if (!square_to(kind, q, &square))
        return font_fail(FONT_BAD_ARGUMENT, "the four corners have no such map");
    return font_map_compose(&unit, &square, out);
}

bool font_map_point(const struct font_map *map, struct font_point from, struct font_point *to,
                    double jacobian[4])
{
    const double *m = map->m;
    double x = from.x, y = from.y, w;
    /* What x y stands for, and how it changes along x and along y. */
    double xy = m[12] * x * x + (1 + m[13]) * x * y + m[14] * y * y;
    double along_x = 2 * m[12] * x + (1 + m[13]) * y;
    double along_y = (1 + m[13]) * x + 2 * m[14] * y;
    switch (map->kind) {
    case FONT_AFFINE:
        *to = (struct font_point){m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5]};
        jacobian[0] = m[0];
        jacobian[1] = m[1];
        jacobian[2] = m[3];
        jacobian[3] = m[4];
        return true;
    case FONT_PROJECTIVE:
        w = m[6] * x + m[7] * y + m[8];
        if (!(w > 1e-9))
            return false;
        *to = (struct font_point){(m[0] * x + m[1] * y + m[2]) / w,
                                  (m[3] * x + m[4] * y + m[5]) / w};
        jacobian[0] = (m[0] - to->x * m[6]) / w;
        jacobian[1] = (m[1] - to->x * m[7]) / w;
        jacobian[2] = (m[3] - to->y * m[6]) / w;
        jacobian[3] = (m[4] - to->y * m[7]) / w;
        return true;
    case FONT_BILINEAR:
        *to = (struct font_point){m[0] + m[1] * x + m[2] * y + m[3] * xy,
                                  m[4] + m[5] * x + m[6] * y + m[7] * xy};
        jacobian[0] = m[1] + m[3] * along_x;
        jacobian[1] = m[2] + m[3] * along_y;
        jacobian[2] = m[5] + m[7] * along_x;
        jacobian[3] = m[6] + m[7] * along_y;
        return true;
    case FONT_SMOOTH:
        w = m[8] + m[9] * x + m[10] * y + m[11] * xy;
        if (!(w > 1e-9))
            return false;
        *to = (struct font_point){(m[0] + m[1] * x + m[2] * y + m[3] * xy) / w,
                                  (m[4] + m[5] * x + m[6] * y + m[7] * xy) / w};
        jacobian[0] = (m[1] + m[3] * along_x - to->x * (m[9] + m[11] * along_x)) / w;
        jacobian[1] = (m[2] + m[3] * along_y - to->x * (m[10] + m[11] * along_y)) / w;
        jacobian[2] = (m[5] + m[7] * along_x - to->y * (m[9] + m[11] * along_x)) / w;
        jacobian[3] = (m[6] + m[7] * along_y - to->y * (m[10] + m[11] * along_y)) / w;
        return true;
    }
    return false;
}
