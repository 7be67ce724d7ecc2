/* drawing.h - what a screen was drawn from, so that a render draws it anew, and does not
 * interpolate it.
 *
 *     struct event_bytes bytes = {0};
 *     paper_drawing_polygon (&bytes, corners, 4);
 *     paper_drawing_line (&bytes, &line, 20, 90);
 *     paper_drawing_join (&bytes, '-');
 *     screen.drawing = &(struct paper_drawing){bytes.at, bytes.count, 1};
 *
 * A drawing is a row of bytes that is read from the left: shapes, and what is done with the
 * last of them.
 *
 * Errors: shapes are added without a status: where there is no memory, the bytes say so
 * (events: bytes.h).
 *
 * Ownership: arguments stay the caller's, but for a drawing's bytes, which its screen only
 * points to. Threads: any. */
#ifndef LUTETIA_PAPER_DRAWING_H
#define LUTETIA_PAPER_DRAWING_H

#include "paper.h"

#include <bytes.h>

#include <math.h>

/* Longer drawings are not kept. */
enum { PAPER_DRAWING_MOST = 65536 };

struct paper_drawing {
    uint8_t *bytes;
    size_t count;
    double scale; /* pixels of the screen to one that the shapes are measured in */
};

/* The shapes' numbers are in pixels, from the sheet's upper left corner. */
void paper_drawing_polygon(struct event_bytes *b, const double *points, int points_count);
/* Its origin is at x, y; line->x_px and y_px are not used. False: it is not kept, as its font
 * is a file. */
bool paper_drawing_line(struct event_bytes *b, const struct paper_line *line, double x,
                        double y);
/* Of the last two: '+', '*' or '-'. */
void paper_drawing_join(struct event_bytes *b, char operation);
/* All of another one, in the same numbers. */
void paper_drawing_again(struct event_bytes *b, const struct paper_drawing *d);
/* The last one and a number; first: number - shape. */
void paper_drawing_number(struct event_bytes *b, char operation, double number, bool first);

/* The screen `scale` times as fine as the shapes' numbers, on a sheet of that size; *x, *y: its
 * upper left corner. Errors: BAD_FILE (it is no drawing), and those of the shapes; *screen is
 * then zeros. Owns: the caller destroys *screen. */
enum paper_status paper_drawing_screen(const struct paper_drawing *d, double scale, int width,
                                       int height, struct paper_screen *screen, int *x, int *y);

/* Of a drawing that is all that lies around another one, of polygons: 1 less that. How many of
 * its first bytes are the other one's; 0: it is no such drawing. */
size_t paper_drawing_within(const struct paper_drawing *d);

/* The corners of a polygon, if the drawing is all that lies around it: 1 less the polygon.
 * Shape: pairs of x, y, in pixels of the screen. False: it is another drawing, or there is no
 * memory. Owns: the caller frees *points. */
bool paper_drawing_around(const struct paper_drawing *d, double **points, int *points_count);

/* Two grays: '+' the greater, '*' the product, '-' the first without the second. */
static inline int paper_gray_join(char operation, int p, int q)
{
    return operation == '+'   ? p > q ? p : q
           : operation == '*' ? (p * q + 127) / 255
                              : (p * (255 - q) + 127) / 255;
}

/* A gray and a number, within 0..255. */
static inline uint8_t paper_gray_number(char operation, double number, bool first, int gray)
{
    const double value = gray / 255.0, made = operation == '*'   ? value * number
                                              : operation == '+' ? value + number
                                              : first            ? number - value
                                                                 : value - number;
    return (uint8_t)lround(255 * fmin(1, fmax(0, made)));
}

#endif
