/* quad.h - maps the unit square onto four corners, and back.
 *
 *     const double corners[4][2] = {{0, 0}, {2, 0}, {2.5, 1}, {0, 1}};
 *     struct dyn_quad_map map;
 *     if (!dyn_quad_make(&map, DYN_QUAD_SMOOTH, corners))
 *         ...                                           // a corner is no number
 *     dyn_quad_point(&map, 0.5, 0.5, &x, &y, NULL);
 *     if (dyn_quad_inverse(&map, x, y, &u, &v) && u >= 0 && u <= 1 && v >= 0 && v <= 1)
 *         ...                                           // (x, y) is in the letter
 *
 * Corners go round: (0, 0), (1, 0), (1, 1), (0, 1) of the square come to lie in them, in either
 * sense.
 *
 * A point is the corners' mean, with Bernstein's weights times one number for each corner:
 *     p (u, v) = sum of B_i w_i q_i / sum of B_i w_i,    B = (1-u)(1-v), u (1-v), u v, (1-u) v
 * so the corners are met to the last bit whatever the numbers are.
 *
 *   Projective: w_i is t_i, twice the signed area of the triangle of the other three corners. The corners' one affine relation is
 *     t0 q0 - t1 q1 + t2 q2 - t3 q3 = 0, so that terms in u v cancel: lines stay straight, and it is one 4x4 matrix. Nothing is
 *     divided by a side: a square that is turned by 90 degrees is like any other. It exists where all t_i have one sign, which is
 *     where the quad is strictly convex.
 *   Bilinear: w_i is 1. It exists for any corners.
 *   Smooth: w_i goes from one to the other with the condition.
 *
 * The condition is the least t_i over the greatest, where the quad's own sense counts as
 * positive: 1 a parallelogram, 0 three corners in a line or less than a quad, negative a dent
 * or sides that cross. Smooth is projective at and above DYN_QUAD_PROJECTIVE_FROM, bilinear at
 * and below DYN_QUAD_BILINEAR_TO, and the share goes as a smoothstep between them: points and
 * their speeds are continuous while corners move.
 *
 * Errors: functions that can fail return false, and leave no message.
 *
 * Ownership: a map is the caller's, and points to nothing. Threads: any. */
#ifndef LUTETIA_DYN_QUAD_H
#define LUTETIA_DYN_QUAD_H

#include <stdbool.h>

enum dyn_quad_kind { DYN_QUAD_PROJECTIVE, DYN_QUAD_BILINEAR, DYN_QUAD_SMOOTH };

#define DYN_QUAD_PROJECTIVE_FROM 0.1
#define DYN_QUAD_BILINEAR_TO 0.02

struct dyn_quad_map {
    enum dyn_quad_kind kind; /* the map's kind: SMOOTH only if it is neither of the others */
    double corner[4][2];
    double weight[4];      /* the greatest t_i is 1 */
    double condition, mix; /* mix: the weights' share of 1 */
};

/* -1..1; 0 if a corner is not finite. */
double dyn_quad_condition(const double corners[4][2]);

/* False: a corner is not finite, or PROJECTIVE is asked for and the quad is not strictly
 * convex. */
bool dyn_quad_make(struct dyn_quad_map *map, enum dyn_quad_kind kind,
                   const double corners[4][2]);

/* jacobian: dx/du, dx/dv, dy/du, dy/dv; NULL is fine. False: the point is at or beyond the
 * map's horizon (never within the square). */
bool dyn_quad_point(const struct dyn_quad_map *map, double u, double v, double *x, double *y,
                    double jacobian[4]);

/* Finds a point of the plane that is mapped to (x, y): of several, one within the square if
 * there is one. False: none was found. */
bool dyn_quad_inverse(const struct dyn_quad_map *map, double x, double y, double *u, double *v);

/* As polynomials: x w, y w and w are c[.][0] + c[.][1] u + c[.][2] v + c[.][3] u v. The last
 * are 0 for w where the kind is BILINEAR, and for all where it is PROJECTIVE. */
void dyn_quad_coefficients(const struct dyn_quad_map *map, double c[3][4]);

/* Rows: (u, v, 0, 1) times m is (x w, y w, 0, w). Of a PROJECTIVE map. */
void dyn_quad_matrix(const struct dyn_quad_map *map, double m[4][4]);

/* The same matrix, up to its scale, as the thesis makes it: homogeneous, shear, scale and
 * translation, multiplied. False: one of the numbers it divides by is 0, as with a quad turned
 * by 90 degrees. Source: the thesis, section 2.2 and appendix 7.2. */
bool dyn_quad_thesis(const double corners[4][2], double m[4][4]);

#endif
