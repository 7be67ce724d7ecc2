/* levels.h - a glyph at every level of the pipeline at once, each of which can be looked at,
 * kept and changed:
 *
 *     outline -> master -> rectangles --+
 *        |                              +-- filter table -> gray
 *        +------------ edges -----------+
 *
 *     struct font_levels *levels;
 *     font_levels_create(&outline, 980, 12.25, "gaussian-fast", &levels);
 *     font_levels_master_fill(levels, 100, -300, 40, 40, false);       // retouched
 *     // made of the retouched master
 *     font_levels_gray(levels, 0.25, 0, &gray);
 *     font_levels_filter_set(levels, "cone");
 *     // the same rectangles, another table
 *     font_levels_gray(levels, 0.25, 0, &gray);
 *     font_levels_destroy(levels);
 *
 * Nothing is made before it is asked for, and what was made is kept until something above it
 * changes: another filter makes neither master nor rectangles again, a retouched master does
 * not touch the outline. While nothing but outline, size and filter was changed, gray comes
 * from the outline's edges, exactly; once the master or its rectangles were edited, from those.
 * Setting the outline forgets such edits.
 *
 * Errors: functions that can fail return a status and leave one line in font_error():
 * BAD_ARGUMENT, TOO_LARGE, NO_MEMORY.
 *
 * Ownership: what is passed is copied. Threads: levels belong to one thread at a time. */
#ifndef LUTETIA_FONT_LEVELS_H
#define LUTETIA_FONT_LEVELS_H

#include "gray.h"
#include "master.h"

struct font_levels;

/* The outline is copied, and prepared if it is not. Errors: BAD_ARGUMENT (a size, an em or a
 * filter that cannot be), TOO_LARGE, NO_MEMORY. Owns: the caller destroys *out. */
enum font_status font_levels_create(const struct font_outline *outline, int master_em_px,
                                    double size_px, const char *filter,
                                    struct font_levels **out);
void font_levels_destroy(struct font_levels *levels); /* NULL is fine */

/* Changes; what lies below is made again when it is asked for. On failure nothing is changed.
 * Errors: BAD_ARGUMENT, TOO_LARGE, NO_MEMORY. */
enum font_status font_levels_outline_set(struct font_levels *levels,
                                         const struct font_outline *outline);
enum font_status font_levels_master_em_set(struct font_levels *levels, int em_px);
enum font_status font_levels_master_fill(struct font_levels *levels, int x, int y, int width,
                                         int height, bool black);
/* Replaces the master by a copy of this one, which was retouched elsewhere. The levels take
 * over its em. Errors: BAD_ARGUMENT, NO_MEMORY. */
enum font_status font_levels_master_set(struct font_levels *levels,
                                        const struct font_master *master);
/* Returns how many rectangles are gone in *gone, which may be NULL; gives one of them other
 * sides. Errors: BAD_ARGUMENT, TOO_LARGE, NO_MEMORY. */
enum font_status font_levels_rectangles_merge(struct font_levels *levels, int slack, int *gone);
enum font_status font_levels_rectangle_set(struct font_levels *levels, int index,
                                           struct font_rectangle rectangle);
/* Replaces the rectangles by copies of these, which were edited elsewhere; they may overlap:
 * what they cover counts. Errors: BAD_ARGUMENT, TOO_LARGE, NO_MEMORY. */
enum font_status font_levels_rectangles_set(struct font_levels *levels,
                                            const struct font_rectangles *rectangles);
/* Replaces the gray of this size by a copy of this, whatever the place between pixels: its
 * origin goes to the nearest whole pixel. Another size or filter, or a change above, forgets
 * it. Errors: TOO_LARGE, NO_MEMORY. */
enum font_status font_levels_gray_set(struct font_levels *levels, const struct font_gray *gray);
/* Another filter; another size. Errors: as font_levels_create(). */
enum font_status font_levels_filter_set(struct font_levels *levels, const char *filter);
enum font_status font_levels_size_set(struct font_levels *levels, double size_px);
/* Gray from master and rectangles even where nothing was edited: the thesis's way. */
void font_levels_use_master(struct font_levels *levels, bool use);

/* Looks: what is asked for is made, and is the levels'; never NULL, valid until the next
 * change. Errors: BAD_ARGUMENT (the outline cannot be mapped so), TOO_LARGE, NO_MEMORY. */
const struct font_outline *font_levels_outline(const struct font_levels *levels);
enum font_status font_levels_master(struct font_levels *levels, const struct font_master **out);
enum font_status font_levels_rectangles(struct font_levels *levels,
                                        const struct font_rectangles **out);
const struct font_filter *font_levels_filter(const struct font_levels *levels);
double font_levels_size(const struct font_levels *levels); /* in pixels */
enum font_status font_levels_edges(struct font_levels *levels, const struct font_edges **out);
/* gray: the levels'; valid until the next change or the next gray. The same place again is not
 * drawn again. Errors: as font_levels_edges(). */
enum font_status font_levels_gray(struct font_levels *levels, double x_px, double y_px,
                                  const struct font_gray **out);

/* How often each level was made. */
struct font_levels_made {
    int masters, rectangles, filters, edges, grays;
};
void font_levels_made_get(const struct font_levels *levels, struct font_levels_made *out);

#endif
