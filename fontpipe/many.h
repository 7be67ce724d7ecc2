/* many.h - thousands of glyphs at once on an OpenCL device: a typeface at many sizes, a page.
 * The same edges, tables and sums as font_gray_draw(), in kernels/glyphs.cl: the same values to
 * rounding.
 *
 *     struct font_many *many;
 *     if (font_many_create(NULL, filter, &many) != FONT_OK)
 *         die(font_error());
 *     // kept on the device; any number of them
 *     int id = font_many_edges(many, &edges);
 *     struct font_many_job jobs[] = {{id, 0.25f, 0}, {id, 0.5f, 0}};
 *     const struct font_gray *grays;
 *     font_many_draw(many, jobs, 2, &grays);
 *     font_many_destroy(many);
 *
 * This part talks to OpenCL by itself: the pipeline knows nothing of the machine.
 * LUTETIA_DEVICE chooses the device, a part of its or its platform's name or its number, as it
 * does for the machine. A work-item is a glyph, with vectors of eight: made for processors with
 * vector units, as PoCL drives them; other devices run it too.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: what is passed is copied to the device. Threads: one thread at a time. */
#ifndef LUTETIA_FONT_MANY_H
#define LUTETIA_FONT_MANY_H

#include "gray.h"

struct font_many;

struct font_many_job {
    int edges; /* font_many_edges()'s number */
    float x_px, y_px;
};

enum { FONT_MANY_WIDTH_MAX = 1024 };

/* device: as LUTETIA_DEVICE, which NULL looks at. The filter is copied to the device. Errors:
 * NO_DEVICE, DEVICE_FAILED with the compiler's log's first line, NO_MEMORY. Owns: the caller
 * destroys *out. */
enum font_status font_many_create(const char *device, const struct font_filter *filter,
                                  struct font_many **out);
void font_many_destroy(struct font_many *many); /* NULL is fine */
/* The device's name; never NULL, valid as long as *many. */
const char *font_many_device(const struct font_many *many);

/* Keeps edges, made by font_edges_build_tabled(), and returns their number, from 0 on; -1 with
 * font_error() set. They go to the device with the next drawing. */
int font_many_edges(struct font_many *many, const struct font_edges *edges);
void font_many_edges_forget(struct font_many *many); /* all of them */

/* Draws all; *grays are as many pictures, valid until the next call. Errors: BAD_ARGUMENT for a
 * number that is not of edges, TOO_LARGE for a glyph wider than FONT_MANY_WIDTH_MAX, NO_MEMORY,
 * DEVICE_FAILED. */
enum font_status font_many_draw(struct font_many *many, const struct font_many_job *jobs,
                                int jobs_count, const struct font_gray **grays);

#endif
