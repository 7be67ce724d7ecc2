/* nearest.c - the mass or spring nearest to a point: see network.h. */
#include "internal.h"

#include <math.h>

int dyn_network_nearest(const struct dyn_network *n, double x, double y, double within)
{
    int nearest = -1;
    double least = within * within;
    for (int i = 0; i < n->masses_count; i++) {
        double dx = n->state[i].x - x, dy = n->state[i].y - y, d = dx * dx + dy * dy;
        if (d < least || (d == least && nearest < 0)) {
            least = d;
            nearest = i;
        }
    }
    return nearest;
}

/* The square of the distance between the point and the line from a to b. */
static double line_distance(const struct dyn_state *a, const struct dyn_state *b, double x,
                            double y)
{
    double dx = b->x - a->x, dy = b->y - a->y, length = dx * dx + dy * dy;
    double t = length > 0 ? ((x - a->x) * dx + (y - a->y) * dy) / length : 0;
    t = fmin(fmax(t, 0), 1);
    double px = a->x + t * dx - x, py = a->y + t * dy - y;
    return px * px + py * py;
}

int dyn_network_nearest_spring(const struct dyn_network *n, double x, double y, double within)
{
    int nearest = -1;
    double least = within * within;
    for (int i = 0; i < n->springs_count; i++) {
        if (n->broken[i])
            continue;
        double d = line_distance(&n->state[n->end[i][0]], &n->state[n->end[i][1]], x, y);
        if (d < least || (d == least && nearest < 0)) {
            least = d;
            nearest = i;
        }
    }
    return nearest;
}
