/* path.c - paths for baselines: see word.h and word_internal.h. */
#include "word_internal.h"

#include <math.h>
#include <stdlib.h>

void dyn_path_circle(double x, double y, double radius, double from_degrees,
                     double (*points)[2], int count)
{
    for (int i = 0; i < count; i++) {
        double angle = from_degrees * M_PI / 180 - 2 * M_PI * i / (count - 1);
        points[i][0] = x + radius * cos(angle);
        points[i][1] = y + radius * sin(angle);
    }
}

enum dyn_status dyn_path_make(struct dyn_path *path, const double (*points)[2], int count)
{
    *path = (struct dyn_path){.points = points, .count = count};
    if (count < 2)
        return dyn_fail(DYN_BAD_ARGUMENT, "a path has two points or more (got %d)", count);
    path->at = malloc((size_t)count * sizeof *path->at);
    if (!path->at)
        return dyn_fail(DYN_NO_MEMORY, "no memory for a path of %d points", count);
    path->at[0] = 0;
    for (int i = 1; i < count; i++)
        path->at[i] = path->at[i - 1] +
                      hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
    if (path->at[count - 1] > 0 && path->at[count - 1] <= 1e6)
        return DYN_OK;
    double length = path->at[count - 1];
    dyn_path_finish(path);
    return dyn_fail(DYN_BAD_ARGUMENT, "a path cannot be %g units long", length);
}

void dyn_path_finish(struct dyn_path *path)
{
    free(path->at);
    *path = (struct dyn_path){0};
}

struct dyn_place dyn_path_place(const struct dyn_path *path, double x, double y)
{
    int i = 1;
    while (i < path->count - 1 && (path->at[i] <= x || path->at[i] == path->at[i - 1]))
        i++;
    while (i > 1 && path->at[i] == path->at[i - 1])
        i--; /* a path's end may stand still */
    const double *a = path->points[i - 1], *b = path->points[i];
    double length = path->at[i] - path->at[i - 1];
    double ux = (b[0] - a[0]) / length, uy = (b[1] - a[1]) / length;
    double along = x - path->at[i - 1]; /* straight on beyond an end */
    return (struct dyn_place){a[0] + ux * along - uy * y, a[1] + uy * along + ux * y};
}
