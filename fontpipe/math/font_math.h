/* font_math.h - formulas in TeX's notation, set by a font's MATH table and TeX's rules (The
 * TeXbook, appendix G).
 *
 *     struct font_math *math;
 *     if (font_math_create(face, &math) != FONT_OK)
 *         die(font_error());
 *     const struct font_math_options options = {.size_px = 20, .display = true};
 *     const char *tex = "\\frac{-b \\pm \\sqrt{b^2 - 4ac}}{2a}";
 *     struct font_layout layout;
 *     font_math_layout(math, tex, strlen(tex), &options, &layout);
 *     font_painter_layout(painter, &layout, NULL, 10, 10 + layout.ascent_px, &picture);
 *     font_layout_finish(&layout);
 *     font_math_destroy(math);
 *
 * A formula is a layout like any text's: whoever draws, measures or writes layouts does so with
 * formulas. Its rules (a fraction's bar) are glyphs, too: of a face that has one square, under
 * a map of their own.
 *
 * What is known: letters and digits, some 400 symbols by name or as characters, scripts and
 * primes, \frac and its kin, \sqrt, \left and \right, \big, accents, lines and braces over and
 * under, operators with limits, \operatorname, \text, alphabets (\mathbf, \mathbb, ..),
 * matrices, cases, array, aligned and gathered lines, spaces, styles, \overset, \xrightarrow,
 * \phantom, \not. docs/fonts.md lists it. A command that is not known is shown as it is
 * written, upright, and counted.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). No text
 * is an error, but for one that is too large.
 *
 * Ownership: the face is borrowed; texts are. Threads: it belongs, with its face, to one thread
 * at a time. */
#ifndef LUTETIA_FONT_MATH_H
#define LUTETIA_FONT_MATH_H

#include "text.h"

struct font_math;

/* The names of fonts that have a MATH table, NULL-ended, the one that formulas are set in first
 * where nobody says. Owns: nobody; valid for ever. */
extern const char *const font_math_fonts[];

/* face: must outlive it and its layouts, which outlive nothing of it. Errors: BAD_ARGUMENT (the
 * font has no MATH table), NO_MEMORY. Owns: the caller destroys *out, after the layouts that it
 * made. */
enum font_status font_math_create(struct font_face *face, struct font_math **out);
void font_math_destroy(struct font_math *math); /* NULL is fine */

struct font_math_options {
    double size_px; /* of the em; 0.1..FONT_SIDE_MAX */
    bool display;   /* a line of its own; else within a line of text */
};

/* Sets a formula, UTF-8, without the dollars around it. *out is one line whose baseline is at y
 * 0: its width_px, ascent_px and descent_px are the formula's box, of what stands over the
 * baseline and under it; clusters are bytes of `tex`. Errors: BAD_ARGUMENT (a size out of its
 * range), TOO_LARGE (more than 64 KiB, or nested deeper than 100), NO_MEMORY; *out is then
 * empty. Owns: the caller finishes *out. */
enum font_status font_math_layout(struct font_math *math, const char *tex, size_t bytes,
                                  const struct font_math_options *options,
                                  struct font_layout *out);

/* How many commands of the last formula are not known, and the first of them ("\\foo"; "" if
 * all are known), cut after 47 bytes. Owns: `math`, valid until it sets another. */
const char *font_math_unknown(const struct font_math *math, int *count);

#endif
