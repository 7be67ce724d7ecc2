/* levels.c - see levels.h. A level that must be made again is marked so, and so is all that
 * lies below it. */
#include "levels.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>

struct font_levels {
    struct font_outline outline;
    struct font_master master;
    struct font_rectangles rectangles;
    struct font_filter *filter;
    struct font_edges edges;
    struct font_gray gray, gray_own;
    int em_px;
    double size_px, x_px, y_px;
    bool master_made, rectangles_made, edges_made, gray_made;
    bool master_edited, rectangles_edited, gray_edited, use_master;
    struct font_levels_made made;
};

enum { OUTLINE, MASTER, RECTANGLES, EDGES, GRAY };

/* What lies below a level is no longer what it would be. */
static void below_forget(struct font_levels *l, int level)
{
    if (level < MASTER)
        l->master_made = l->master_edited = false;
    if (level < RECTANGLES)
        l->rectangles_made = l->rectangles_edited = false;
    if (level < EDGES)
        l->edges_made = false;
    l->gray_made = l->gray_edited = false;
}

static bool from_master(const struct font_levels *l)
{
    return l->use_master || l->master_edited || l->rectangles_edited;
}

static bool size_fits(double size_px)
{
    return size_px >= 0.1 && size_px <= FONT_SIDE_MAX;
}

enum font_status font_levels_create(const struct font_outline *outline, int em_px,
                                    double size_px, const char *filter,
                                    struct font_levels **out)
{
    *out = NULL;
    if (!size_fits(size_px))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, size_px);
    struct font_levels *l = calloc(1, sizeof *l);
    if (!l)
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph's levels");
    l->size_px = size_px;
    enum font_status status = font_levels_filter_set(l, filter);
    if (status == FONT_OK)
        status = font_levels_master_em_set(l, em_px);
    if (status == FONT_OK)
        status = font_levels_outline_set(l, outline);
    if (status == FONT_OK)
        *out = l;
    else
        font_levels_destroy(l);
    return status;
}

void font_levels_destroy(struct font_levels *l)
{
    if (!l)
        return;
    font_outline_finish(&l->outline);
    font_master_finish(&l->master);
    font_rectangles_finish(&l->rectangles);
    font_filter_destroy(l->filter);
    font_edges_finish(&l->edges);
    font_gray_finish(&l->gray);
    font_gray_finish(&l->gray_own);
    free(l);
}

/* ---- changes ---- */

enum font_status font_levels_outline_set(struct font_levels *l,
                                         const struct font_outline *outline)
{
    struct font_outline copy;
    enum font_status status = font_outline_copy(outline, &copy);
    if (status == FONT_OK)
        status = font_outline_prepare(&copy, FONT_NONZERO);
    if (status == FONT_OK && !(copy.units_per_em > 0))
        status = font_fail(FONT_BAD_ARGUMENT, "an outline needs units to the em");
    if (status != FONT_OK) {
        font_outline_finish(&copy);
        return status;
    }
    font_outline_finish(&l->outline);
    l->outline = copy;
    below_forget(l, OUTLINE);
    return FONT_OK;
}

enum font_status font_levels_master_em_set(struct font_levels *l, int em_px)
{
    if (em_px < 1 || em_px > FONT_MASTER_EM_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a master's em must be 1..%d pixels (got %d)",
                         FONT_MASTER_EM_MAX, em_px);
    if (em_px == l->em_px)
        return FONT_OK;
    bool exact = l->edges_made && !from_master(l), gray = l->gray_made;
    l->em_px = em_px;
    below_forget(l, OUTLINE);
    l->edges_made = exact; /* the outline is as it was */
    l->gray_made = exact && gray;
    return FONT_OK;
}

enum font_status font_levels_master_fill(struct font_levels *l, int x, int y, int width,
                                         int height, bool black)
{
    const struct font_master *master;
    enum font_status status = font_levels_master(l, &master);
    if (status != FONT_OK)
        return status;
    font_master_fill(&l->master, x, y, width, height, black);
    below_forget(l, MASTER);
    l->master_edited = true;
    return FONT_OK;
}

enum font_status font_levels_master_set(struct font_levels *l, const struct font_master *master)
{
    struct font_master copy;
    if (master->em_px < 1 || master->em_px > FONT_MASTER_EM_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a master's em must be 1..%d pixels (got %d)",
                         FONT_MASTER_EM_MAX, master->em_px);
    enum font_status status = font_master_copy(master, &copy);
    if (status != FONT_OK)
        return status;
    font_master_finish(&l->master);
    l->master = copy;
    l->em_px = copy.em_px;
    below_forget(l, MASTER);
    l->master_made = l->master_edited = true;
    return FONT_OK;
}

enum font_status font_levels_rectangles_merge(struct font_levels *l, int slack, int *gone)
{
    const struct font_rectangles *rectangles;
    enum font_status status = font_levels_rectangles(l, &rectangles);
    if (status != FONT_OK)
        return status;
    int before = rectangles->count;
    struct font_rectangles rows = {0};
    const struct font_master *master;
    if (!l->rectangles_edited) {
        /* alike ones, though there are more of them, may merge to fewer */
        status = font_levels_master(l, &master);
        if (status == FONT_OK)
            status = font_rectangles_make_rows(&rows, master);
        if (status != FONT_OK) {
            font_rectangles_finish(&rows);
            return status;
        }
        font_rectangles_merge(&rows, slack);
    }
    font_rectangles_merge(&l->rectangles, slack);
    if (!l->rectangles_edited && rows.count < l->rectangles.count) {
        struct font_rectangles more = l->rectangles;
        l->rectangles = rows;
        rows = more;
    }
    font_rectangles_finish(&rows);
    if (gone)
        *gone = before - l->rectangles.count;
    below_forget(l, RECTANGLES);
    l->rectangles_edited = true;
    return FONT_OK;
}

enum font_status font_levels_rectangle_set(struct font_levels *l, int index,
                                           struct font_rectangle q)
{
    const struct font_rectangles *rectangles;
    enum font_status status = font_levels_rectangles(l, &rectangles);
    if (status != FONT_OK)
        return status;
    if (index < 0 || index >= rectangles->count || q.x1 < q.x0 || q.y1 < q.y0)
        return font_fail(FONT_BAD_ARGUMENT, "there is no rectangle %d, or it is turned around",
                         index);
    l->rectangles.items[index] = q;
    below_forget(l, RECTANGLES);
    l->rectangles_edited = true;
    return FONT_OK;
}

enum font_status font_levels_rectangles_set(struct font_levels *l,
                                            const struct font_rectangles *rectangles)
{
    /* By the master that they cover, where nothing is covered twice. */
    struct font_master covered = {0};
    struct font_rectangles made = {0};
    enum font_status status = font_rectangles_master(rectangles, &covered);
    if (status == FONT_OK)
        status = font_rectangles_make(&made, &covered);
    font_master_finish(&covered);
    if (status != FONT_OK) {
        font_rectangles_finish(&made);
        return status;
    }
    font_rectangles_finish(&l->rectangles);
    l->rectangles = made;
    below_forget(l, RECTANGLES);
    l->rectangles_made = l->rectangles_edited = true;
    return FONT_OK;
}

enum font_status font_levels_gray_set(struct font_levels *l, const struct font_gray *gray)
{
    struct font_gray copy;
    enum font_status status = font_gray_copy(gray, &copy);
    if (status != FONT_OK)
        return status;
    font_gray_finish(&l->gray_own);
    l->gray_own = copy;
    l->gray_edited = true;
    l->gray_made = false;
    return FONT_OK;
}

enum font_status font_levels_filter_set(struct font_levels *l, const char *name)
{
    struct font_filter *filter;
    enum font_status status = font_filter_create_named(name, &filter);
    if (status != FONT_OK)
        return status;
    font_filter_destroy(l->filter);
    l->filter = filter;
    l->made.filters++;
    /* Edges of the outline are as fine as the filter asks for; those of rectangles are always
     * the same. */
    if (!from_master(l))
        l->edges_made = false;
    l->gray_made = l->gray_edited = false;
    return FONT_OK;
}

enum font_status font_levels_size_set(struct font_levels *l, double size_px)
{
    if (!size_fits(size_px))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, size_px);
    if (size_px != l->size_px)
        below_forget(l, RECTANGLES);
    l->size_px = size_px;
    return FONT_OK;
}

void font_levels_use_master(struct font_levels *l, bool use)
{
    bool before = from_master(l);
    l->use_master = use;
    if (before != from_master(l))
        below_forget(l, RECTANGLES);
}

/* ---- looks ---- */

const struct font_outline *font_levels_outline(const struct font_levels *l)
{
    return &l->outline;
}

const struct font_filter *font_levels_filter(const struct font_levels *l)
{
    return l->filter;
}

double font_levels_size(const struct font_levels *l)
{
    return l->size_px;
}

enum font_status font_levels_master(struct font_levels *l, const struct font_master **out)
{
    *out = &l->master;
    if (l->master_made)
        return FONT_OK;
    enum font_status status = font_master_make(&l->master, &l->outline, l->em_px);
    l->master_made = status == FONT_OK;
    l->made.masters++;
    return status;
}

enum font_status font_levels_rectangles(struct font_levels *l,
                                        const struct font_rectangles **out)
{
    const struct font_master *master;
    *out = &l->rectangles;
    if (l->rectangles_made)
        return FONT_OK;
    enum font_status status = font_levels_master(l, &master);
    if (status == FONT_OK)
        status = font_rectangles_make(&l->rectangles, master);
    l->rectangles_made = status == FONT_OK;
    l->made.rectangles++;
    return status;
}

enum font_status font_levels_edges(struct font_levels *l, const struct font_edges **out)
{
    *out = &l->edges;
    if (l->edges_made)
        return FONT_OK;
    enum font_status status;
    if (from_master(l)) {
        const struct font_rectangles *rectangles;
        status = font_levels_rectangles(l, &rectangles);
        if (status == FONT_OK)
            status = font_rectangles_edges(rectangles, l->size_px, &l->edges);
    } else {
        struct font_map map = font_map_size(l->size_px, l->outline.units_per_em);
        status = font_edges_build(&l->edges, &l->outline, &map, l->filter);
    }
    l->edges_made = status == FONT_OK;
    l->made.edges++;
    return status;
}

enum font_status font_levels_gray(struct font_levels *l, double x_px, double y_px,
                                  const struct font_gray **out)
{
    const struct font_edges *edges;
    *out = &l->gray;
    if (l->gray_edited && fabs(x_px) <= FONT_SIDE_MAX && fabs(y_px) <= FONT_SIDE_MAX) {
        const int left = l->gray_own.left_px + (int)floor(x_px + 0.5),
                  top = l->gray_own.top_px + (int)floor(y_px + 0.5);
        const struct font_gray_frame frame = {left, top, l->gray_own.width_px,
                                              l->gray_own.height_px};
        font_gray_finish(&l->gray);
        return font_gray_put(&l->gray, &frame, l->gray_own.pixels, (size_t)l->gray_own.pitch);
    }
    enum font_status status = font_levels_edges(l, &edges);
    if (status != FONT_OK || (l->gray_made && l->x_px == x_px && l->y_px == y_px))
        return status;
    status = font_gray_draw(&l->gray, edges, l->filter, x_px, y_px);
    l->gray_made = status == FONT_OK;
    l->x_px = x_px;
    l->y_px = y_px;
    l->made.grays++;
    return status;
}

void font_levels_made_get(const struct font_levels *l, struct font_levels_made *out)
{
    *out = l->made;
}
