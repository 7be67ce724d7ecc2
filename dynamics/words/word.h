/* word.h - springy words: letters in boxes of springs.
 *
 *     struct dyn_word_def def = dyn_word_def_usual();
 *     def.text = "breakdown";
 *     def.shaper = shaper;
 *     def.y = 3;
 *     struct dyn_world world = *dyn_network_world(network);
 *     if (dyn_preset_apply("breakdown", &def.style, &world) != DYN_OK ||
 *         dyn_preset_fit("breakdown", &def, NULL) != DYN_OK ||
 *         dyn_network_world_set(network, &world) != DYN_OK || dyn_word_create(network, &def, &word) != DYN_OK)
 *         die(dyn_error());
 *     for (int i = 0; i < dyn_word_glyphs_count(word); i++) {
 *         double corners[4][2];
 *         dyn_word_quad(word, network, i, corners);
 *         draw(dyn_word_letter(word, i), corners);
 *     }
 *     dyn_word_destroy(word);
 *
 * Text is shaped and broken into lines by fontpipe; each glyph that has ink, and is no mark on
 * another, is a letter: four masses at its box's corners, springs along its sides and
 * diagonals, and a pair of springs to the next letter of its line. Lines hang from each other:
 *
 *       3-------2 ~~~~ 3-------2          0 1 2 3   masses of a letter: its box's corners, as numbered in a quad
 *       | \   / |      |       |          - | \     sides and diagonals
 *       |   X   |      |       |          ~         links, with the real advance and kerning between
 *       | /   \ |      |       |          :         springs on which a line hangs
 *       0-------1 ~~~~ 0-------1
 *         :   :          :
 *       3-------2 ~~~~ ...
 *
 * With `brace` there are also springs across the gaps, from 1 to the next letter's 3 and from
 * 2 to its 0, and between lines; without them letters and lines slide along each other.
 *
 * A word's masses and springs are contiguous in the network, which owns them; a network may
 * have many words, and other masses. All springs are at rest where the letters are put,
 * straight or along a path.
 *
 * Source: the thesis, section 2.3.
 *
 * Errors: functions that can fail return a status and leave one line in dyn_error(). Others
 * cannot fail.
 *
 * Ownership: what is passed is copied, but for the shaper and its faces, which must outlive the
 * word.
 *
 * Threads: a word, its network and its shaper belong to one thread at a time. */
#ifndef LUTETIA_DYN_WORD_H
#define LUTETIA_DYN_WORD_H

#include <network.h>
#include <text.h>

#include <stdbool.h>

/* EM: as wide as the letter's advance without its margins, as high as the capital M. INK:
 * around its ink. */
enum dyn_box { DYN_BOX_EM, DYN_BOX_INK };

/* Which corners are tacked: the first letter's upper left one; that and the last letter's upper
 * right one; all upper ones of the first line; all lower ones of the last line. */
enum dyn_tack { DYN_TACK_NONE, DYN_TACK_FIRST, DYN_TACK_ENDS, DYN_TACK_TOP, DYN_TACK_BOTTOM };

/* CROSSED: springs across the gaps between letters of a line and between lines. Without them
 * nothing keeps letters and lines from sliding along each other. PARAGRAPH: the same, but a
 * text of one line has none. LINES: a text of several lines has them between letters alone, so
 * that its lines stay straight and swing. */
enum dyn_brace { DYN_BRACE_NONE, DYN_BRACE_CROSSED, DYN_BRACE_PARAGRAPH, DYN_BRACE_LINES };

/* All members are doubles, so that the table can describe them. */
struct dyn_word_style {
    double letter_mass;                /* kg; each corner has a quarter */
    double side, diagonal, link, hang; /* springs' constants, kg/s2 */
    double damping_ratio;              /* for each spring alone with its masses: 1 is
                                        * critical */
    double carry;                      /* constants are (1 + carry (lines - 1)) times as
                                        * large: the lowest line bears all others */
    double letter_breaking;  /* breaking strain of sides and diagonals; 0: they never break */
    double link_breaking;    /* for links and for springs between lines */
    double box, tack, brace; /* enum dyn_box, dyn_tack, dyn_brace: used when a word is made */
};

extern const struct control dyn_word_controls[]; /* the rows of struct dyn_word_style */
extern const int dyn_word_controls_count;
/* Each control at its usual value. */
struct dyn_word_style dyn_word_style_usual(void);

/* Styles and worlds by name. */
struct dyn_preset {
    const char *name, *does;
    const char *sets; /* "control=value ..." of a style's or a world's controls */
    /* its letters push each other apart (collide.h), which whoever steps it does */
    bool collides;
};
extern const struct dyn_preset dyn_presets[];
extern const int dyn_presets_count;

/* Sets the preset's controls; other controls of the style get their usual values, others of
 * the world stay. Errors: BAD_ARGUMENT: there is no preset of that name, and dyn_error()
 * lists the names. */
enum dyn_status dyn_preset_apply(const char *name, struct dyn_word_style *style,
                                 struct dyn_world *world);
/* False, too, where there is no preset of that name. */
bool dyn_preset_collides(const char *name);

struct dyn_word_def {
    const char *text;           /* UTF-8, ended by a 0 */
    struct font_shaper *shaper; /* borrowed; its faces must outlive the word */
    double size;                /* size of an em, in units: 0.01..1000 */
    double x, y;                /* the place where the first baseline begins */
    double width; /* width of the column to which lines are broken; 0: only at newlines */
    enum font_align align;
    const char *features; /* as in font_text_options; NULL is fine */
    const double (
        *path)[2]; /* points of a path for the first baseline, in place of (x, y); further lines
              * are below it */
    int path_count; /* 0: straight */
    struct dyn_word_style style;
};
/* Fits the style of a preset, which has been applied, to the word: where the preset breaks, its
 * links bear a line of fewer letters than nine, so they are weaker there. Others stay as they
 * are. *letters (NULL is fine): how many the longest line has. Errors: those of
 * dyn_word_create(); the style is unchanged. */
enum dyn_status dyn_preset_fit(const char *name, struct dyn_word_def *def, int *letters);
/* Without text and shaper; the style of dyn_word_style_usual(). */
struct dyn_word_def dyn_word_def_usual(void);

/* A circle as a path, clockwise from that angle in degrees (90: its top), once round. */
void dyn_path_circle(double x, double y, double radius, double from_degrees,
                     double (*points)[2], int count);

struct dyn_word;

/* Errors: BAD_ARGUMENT (a text without ink or that cannot be shaped, a number outside of its
 * range, a path without a length), TOO_LARGE, NO_MEMORY; the network is unchanged. Owns: the
 * caller destroys *out. */
enum dyn_status dyn_word_create(struct dyn_network *n, const struct dyn_word_def *def,
                                struct dyn_word **out);
void dyn_word_destroy(struct dyn_word *word); /* NULL is fine; masses and springs stay in the
                                               * network */

struct dyn_letter {
    struct font_face *face;
    uint32_t glyph;
    double size; /* the length of an em, in units */
    double x0, y0, x1,
        y1;      /* the box in the glyph's own coordinates: units from its origin, y upwards */
    int link[2]; /* springs to the next letter of its line, below and above; -1: last letter */
    int mass[4]; /* lower left, lower right, upper right, upper left */
    int cluster; /* byte offset of its character in the text */
    int line;
};

/* After the letters come the marks that stand on letters, accents and such: they have their
 * letter's masses and its box, and are only drawn. glyphs: both together. */
int dyn_word_letters_count(const struct dyn_word *word);
int dyn_word_glyphs_count(const struct dyn_word *word);
/* Glyph `index`, which must be one of the word; never NULL, valid as long as the word. */
const struct dyn_letter *dyn_word_letter(const struct dyn_word *word, int index);

/* The places of the letter's corners, in the order of its masses. */
void dyn_word_quad(const struct dyn_word *word, const struct dyn_network *n, int index,
                   double corners[4][2]);

/* The letter whose box contains the point: of several the last, which is drawn on top; -1:
 * none. (u, v): the place in the box; NULL is fine. */
int dyn_word_letter_at(const struct dyn_word *word, const struct dyn_network *n, double x,
                       double y, double uv[2]);

enum dyn_part {
    DYN_SIDE,
    DYN_DIAGONAL,
    DYN_LINK,
    DYN_HANG,
    DYN_LINK_BRACE,
    DYN_HANG_BRACE,
    DYN_PARTS_COUNT
};

/* The word's springs and masses in the network: first number and count. The kind of a
 * spring: index from 0 on. */
struct dyn_word_range {
    int first_mass, masses_count, first_spring, springs_count;
};
struct dyn_word_range dyn_word_range(const struct dyn_word *word);
enum dyn_part dyn_word_part(const struct dyn_word *word, int index);

/* The style that the word has now. */
struct dyn_word_style dyn_word_style_get(const struct dyn_word *word);
/* Applies the style to the word's masses and springs; box and tacks stay. Errors:
 * BAD_ARGUMENT. */
enum dyn_status dyn_word_style_set(struct dyn_word *word, struct dyn_network *n,
                                   const struct dyn_word_style *style);

/* Hangs the first line of one word from the last line of another, by springs of the lower
 * one's style: each upper corner from the nearest lower corner. *first: the number of the
 * first spring; *count: how many. Errors: TOO_LARGE, NO_MEMORY; the network is unchanged. */
enum dyn_status dyn_words_hang(struct dyn_network *n, const struct dyn_word *upper,
                               const struct dyn_word *lower, int *first, int *count);

#endif
