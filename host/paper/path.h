/* path.h - reads the ways of strokes: SVG paths, SVG files, recorded samples.
 *
 *     struct paper_lines lines;
 *     if (paper_path_parse("M 10 80 C 40 10, 65 10, 95 80 S 150 150, 180 80", 0.1, &lines) != PAPER_OK)
 *         die(paper_error());
 *     for (int i = 0; i < lines.count; i++)
 *         follow(lines.line[i].points, lines.line[i].points_count);
 *     paper_lines_destroy(&lines);
 *
 * Errors: functions that can fail return a status, leave one line in paper_error(), which gives
 * the character of a path or the line of a file, and make what they hand out zeros.
 *
 * Ownership: arguments stay the caller's. Threads: any.
 */
#ifndef LUTETIA_PAPER_PATH_H
#define LUTETIA_PAPER_PATH_H

#include "brush.h"

struct paper_lines {
    int count;
    struct paper_way {
        int points_count;
        double *points; /* pairs x, y */
    } * line;
};
void paper_lines_destroy(struct paper_lines *lines); /* zeros are fine */

/* An SVG path (all commands of SVG 1.1, 8.3), each of its sub-paths a line; curves become
 * chords that deviate from them by at most tolerance. Errors: BAD_ARGUMENT, NO_MEMORY. Owns:
 * the caller destroys *lines. */
enum paper_status paper_path_parse(const char *path, double tolerance,
                                   struct paper_lines *lines);

/* All <path> elements of an SVG file that are drawn (not those in <defs> and the like),
 * transformed by their and their groups' transform attributes, in user units. `name` is for
 * messages. Errors: BAD_ARGUMENT (also a file that cannot be read), NO_MEMORY. Owns: the caller
 * destroys *lines. */
enum paper_status paper_svg_parse(const char *bytes, size_t count, const char *name,
                                  double tolerance, struct paper_lines *lines);
enum paper_status paper_svg_read(const char *file, double tolerance, struct paper_lines *lines);

/* Recorded samples: a line of text each, time, x, y [, pressure [, tilt x, tilt y]],
 * separated by commas, semicolons, tabs or spaces; empty lines, lines that begin with #, and
 * a first line of names are skipped. The default pressure is 0.5. The first time need not be
 * 0. Errors: as paper_svg_parse(). Owns: the caller frees *samples. */
enum paper_status paper_samples_parse(const char *bytes, size_t count, const char *name,
                                      struct paper_stroke_sample **samples, int *samples_count);
enum paper_status paper_samples_read(const char *file, struct paper_stroke_sample **samples,
                                     int *samples_count);

#endif
