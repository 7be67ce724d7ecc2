/* polygon.c - polygons as screens: for each pixel how much of it the polygon covers.
 *
 * Each pixel row is cut in SUBROWS lines.  The crossings of a line with the polygon's edges
 * are sorted from left to right. The line is inside between the first and the second, the
 * third and the fourth, …; there it adds to each pixel the part that it covers.
 */
#include "sheet.h"

#include "base/base.h"

#include <patience.h>

#include <math.h>
#include <stdlib.h>

enum { SUBROWS = 8, POINTS_MAX = 100000 };
#define PLACE_MAX 1e6

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Adds to cover[0..width-1] the part of each pixel within x1..x2. */
static void span_add(float *cover, int width, double x1, double x2)
{
    x1 = fmax(x1, 0);
    x2 = fmin(x2, width);
    if (x2 <= x1)
        return;
    int first = (int)x1, last = (int)fmin(x2, width - 1);
    if (first == last) {
        cover[first] += (float)(x2 - x1);
        return;
    }
    cover[first] += (float)(first + 1 - x1);
    for (int x = first + 1; x < last; x++)
        cover[x] += 1;
    cover[last] += (float)(x2 - last);
}

static int crossings_find(const double *points, int count, double y, double *crossings)
{
    int found = 0;
    for (int i = 0; i < count; i++) {
        const double *a = points + 2 * i, *b = points + 2 * ((i + 1) % count);
        if ((a[1] <= y) != (b[1] <= y))
            crossings[found++] = a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
    }
    qsort(crossings, (size_t)found, sizeof *crossings, ascending);
    return found;
}

static int bounded(double at, int low, int high)
{
    return at <= low ? low : at >= high ? high : (int)at;
}

static enum paper_status polygon_fill(const double *points, int count, int left, int top,
                                      struct paper_screen *screen)
{
    size_t width = (size_t)screen->width_px;
    double *crossings = malloc((size_t)count * sizeof *crossings);
    float *cover = malloc(width * sizeof *cover);
    screen->gray = malloc(width * (size_t)screen->height_px);
    enum paper_status status = PAPER_OK;
    if (!crossings || !cover || !screen->gray) {
        status = paper_fail(PAPER_NO_MEMORY, "no memory for a shape of %dx%d", screen->width_px,
                            screen->height_px);
    }
    for (int row = 0; row < screen->height_px && status == PAPER_OK; row++) {
        if (row % 32 == 31 && patience_over()) {
            status = paper_fail(PAPER_MACHINE_FAILED, "stopped");
            break;
        }
        for (size_t x = 0; x < width; x++)
            cover[x] = 0;
        for (int sub = 0; sub < SUBROWS; sub++) {
            int found =
                crossings_find(points, count, top + row + (sub + 0.5) / SUBROWS, crossings);
            for (int i = 0; i + 1 < found; i += 2)
                span_add(cover, screen->width_px, crossings[i] - left, crossings[i + 1] - left);
        }
        for (size_t x = 0; x < width; x++)
            screen->gray[(size_t)row * width + x] =
                (uint8_t)lround(fmin(255, 255.0 / SUBROWS * (double)cover[x]));
    }
    free(crossings);
    free(cover);
    if (status != PAPER_OK) {
        free(screen->gray);
        screen->gray = NULL;
    }
    return status;
}

enum paper_status paper_polygon_screen(const double *points, int points_count, int width,
                                       int height, struct paper_screen *screen, int *x, int *y)
{
    *screen = (struct paper_screen){0};
    *x = *y = 0;
    if (points_count < 3 || points_count > POINTS_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "a polygon has 3..%d corners (got %d)",
                          POINTS_MAX, points_count);
    double x1 = PLACE_MAX, y1 = PLACE_MAX, x2 = -PLACE_MAX, y2 = -PLACE_MAX;
    for (int i = 0; i < points_count; i++) {
        double px = points[2 * i], py = points[2 * i + 1];
        if (!(fabs(px) <= PLACE_MAX && fabs(py) <= PLACE_MAX))
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "corners lie within -%g..%g (got %g, %g for number %d)",
                              PLACE_MAX, PLACE_MAX, px, py, i + 1);
        x1 = fmin(x1, px);
        y1 = fmin(y1, py);
        x2 = fmax(x2, px);
        y2 = fmax(y2, py);
    }
    int left = bounded(floor(x1), 0, width), right = bounded(ceil(x2), 0, width);
    int top = bounded(floor(y1), 0, height), bottom = bounded(ceil(y2), 0, height);
    if (left >= right || top >= bottom)
        return PAPER_OK;
    screen->width_px = right - left;
    screen->height_px = bottom - top;
    enum paper_status status = polygon_fill(points, points_count, left, top, screen);
    if (status != PAPER_OK) {
        *screen = (struct paper_screen){0};
        return status;
    }
    *x = left;
    *y = top;
    return PAPER_OK;
}
