/* paper.h - wet paper: a sheet of fibers that hold water and pigment, as a program in C/Paris.
 *
 *     struct paper_config config = paper_config_default();
 *     struct paper *sheet;
 *     if (paper_create(&config, &sheet) != PAPER_OK)
 *         die(paper_error());
 *     paper_rectangle(sheet, 100, 100, 400, 50, &(struct paper_ink){.cyan = 0.8, .water = 1.0});
 *     struct paper_weather weather = paper_weather_default();
 *     for (int step = 0; step < 300; step++)
 *         paper_disperse(sheet, &weather);
 *     paper_view_read(sheet, PAPER_VIEW_COLOR, rgb);
 *
 * The model is that of David Small's thesis (MIT 1990), chapter 5: one fiber for each pixel and
 * one virtual processor for each fiber; docs/paper.md describes it.  x grows to the right and y
 * downwards, both in fibers.
 *
 * Errors: functions that can fail return a status and leave one line in paper_error();
 * unless stated otherwise, a failed call changes nothing. Other functions cannot fail.
 *
 * Ownership: arguments stay the caller's, and nothing is kept of them after the call.
 *
 * Threads: Paris has one machine, so all papers and sheets belong to one thread at a time.
 */
#ifndef LUTETIA_PAPER_H
#define LUTETIA_PAPER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum paper_status {
    PAPER_OK = 0,
    PAPER_BAD_ARGUMENT, /* a size, place, amount or rate that is out of range */
    PAPER_NO_DEVICE,    /* no OpenCL device, or not the one asked for */
    PAPER_NO_MEMORY,
    PAPER_BAD_FONT, /* not found, or not a font */
    PAPER_BAD_TEXT, /* not UTF-8, or without any visible character */
    PAPER_MACHINE_FAILED,
    PAPER_BAD_FILE /* not a saved state, or a damaged one */
};

/* Detail of this thread's last failure, one line without a newline; "" if there was none,
 * never NULL. Owns: the library; valid until the next failure. */
const char *paper_error(void);

/* ---- the sheet ---- */

#define PAPER_SIDE_MIN 8 /* the rim, two fibers wide on each side, takes no part in the flow */
#define PAPER_SIDE_MAX 16384
/* The part of water and pigment that crosses one face in one cycle; what leaves through a
 * fiber's two faces on an axis is at most what it has. */
#define PAPER_ABSORBENCY_MAX 0.25
#define PAPER_GRAVITY_MAX 2.0

struct paper_config {
    int width, height;           /* fibers, PAPER_SIDE_MIN..PAPER_SIDE_MAX each */
    double color[3];             /* of dry fibers: red, green, blue, 0..1 */
    double color_variation;      /* variation of the fibers' lightness, 0..1 */
    double absorbency;           /* mean part of a gradient that flows in a cycle,
                             * 0..PAPER_ABSORBENCY_MAX */
    double absorbency_variation; /* variation as a part of the mean, 0..1 */
    int fiber_length;            /* length of fibers in pixels, along which the paper is
                                  * uniform, 1..64 */
    uint64_t seed;               /* the same seed gives the same sheet on every device */
};
/* 1024 x 1024 fibers of warm white; the seed is always the same. */
struct paper_config paper_config_default(void);

struct paper;

/* Makes a dry sheet without pigment. The first one attaches the machine. Errors:
 * BAD_ARGUMENT, NO_DEVICE, NO_MEMORY, MACHINE_FAILED; *out is then NULL. Owns: the caller
 * destroys *out. */
enum paper_status paper_create(const struct paper_config *config, struct paper **out);
void paper_destroy(struct paper *p); /* NULL is fine */

/* In fibers. */
int paper_width(const struct paper *p);
int paper_height(const struct paper *p);

/* Describes a sheet's fields in the order of allocation; false if there is no field of that
 * number. */
bool paper_field_describe(int width, int height, int number, const char **name, int *bits);
/* Bits that one fiber takes in a sheet of that size: the sum over its fields. */
int paper_bits_per_fiber(int width, int height);

/* ---- water and pigment ---- */

struct paper_ink { /* amounts to add to a fiber; the sum is clamped to 0..1 */
    double cyan, magenta, yellow;
    double water;
};

/* Shades of gray through which ink is put: 255 lets all of it pass, 0 none. */
struct paper_drawing; /* drawing.h */
struct paper_screen {
    int width_px, height_px;
    uint8_t *gray;         /* rows from the top, no padding */
    int origin_x_px;       /* type: its origin, from the left edge */
    int baseline_y_px;     /* type: the first baseline at the origin, from the top edge */
    double advance_px;     /* type: the length of the longest line, or the column */
    double line_height_px; /* type: the mean */
    int lines_count;
    /* what it was drawn from, for renders; NULL: they interpolate. Not the screen's own */
    struct paper_drawing *drawing;
};

/* Adds ink to the fibers in the rectangle; its part off the sheet is ignored. Errors:
 * BAD_ARGUMENT (amounts must be -1..1), NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_rectangle(struct paper *p, int x, int y, int width, int height,
                                  const struct paper_ink *ink);

/* Adds ink through a screen whose upper left corner is at x, y; its part off the sheet is
 * ignored. Errors: as paper_rectangle(). */
enum paper_status paper_screen_ink(struct paper *p, const struct paper_screen *screen, int x,
                                   int y, const struct paper_ink *ink);

/* ---- type ---- */

enum paper_align { /* alignment of lines, in the column or within the longest line */
                   PAPER_ALIGN_START, /* where the text's direction begins */
                   PAPER_ALIGN_LEFT,
                   PAPER_ALIGN_RIGHT,
                   PAPER_ALIGN_CENTER,
                   PAPER_ALIGN_JUSTIFY
};

/* Members that are zero have their defaults. */
struct paper_line {
    const char *text;   /* UTF-8; lines end at newlines */
    const char *font;   /* a file, a font file's name without its ending, or a family */
    double size_px;     /* of the em, 1..8192 */
    double tracking_em; /* added between letters */
    double anchor;      /* the origin's place on the first baseline, as a part of its length,
                        * 0..1 */
    double x_px, y_px;  /* offset of the type in fractions of a fiber, -1..1 */
    double angle_deg;   /* rotation around the origin, counterclockwise */
    double width_px;    /* width of the column to which lines are broken; 0: none */
    double leading;     /* distance of lines, in sizes; 0: the font's */
    enum paper_align align;
    const char *filter;   /* a filter of docs/fonts.md; NULL: "box", the part of a fiber that is
                 * covered */
    const char *features; /* OpenType: "-liga,ss01" */
    const char *language; /* "fr" */
    int right_to_left;    /* 1: right to left, -1: left to right, 0: by the first letter */
    double pixels_max;    /* of the screen; 0: 2^29 */
    const char *axes;     /* of a variable font: "wght=700,wdth=80"; NULL: the defaults */
    double darken_px;     /* widens the stems of small type, in pixels, 0..2 */
    /* The places of the type's upper left, upper right, lower right and lower left corner
     * (x, y, ...), in place of x_px, y_px and an angle; NULL: none. */
    const double *corners;
    bool bilinear; /* bilinear map to the corners; else projective */
};

/* Sets type as a screen: shaped, filtered, and cropped to its ink. Characters that the font
 * lacks are taken from other fonts. Characters that no font has are set as the font's own
 * sign for missing ones; *missing (may be NULL) gets the first such code point, or 0.
 * Errors: BAD_ARGUMENT, BAD_FONT, BAD_TEXT, NO_MEMORY; *screen is then zeros. Owns: the
 * caller destroys *screen. */
enum paper_status paper_line_screen(const struct paper_line *line, struct paper_screen *screen,
                                    uint32_t *missing);
/* Frees what the screen points to, but not its drawing, and makes it zeros; zeros are fine. */
void paper_screen_destroy(struct paper_screen *screen);

/* ---- time ---- */

struct paper_weather {
    double gravity_x,
        gravity_y;   /* 1: none; 2: flow to the right (down) is doubled, flow back is halved */
    double humidity; /* water that every fiber loses in a cycle, 0..1 */
    double molecular_weight[3]; /* mobility of cyan, magenta and yellow, 0..1 */
};
/* No gravity, 0.0004 of water dries in a cycle. */
struct paper_weather paper_weather_default(void);

/* Goes one cycle: water and pigments spread along x, then along y; then fibers lose the
 * humidity. The cycle is computed when the sheet is read; see paper_finish(). Errors:
 * BAD_ARGUMENT, NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_disperse(struct paper *p, const struct paper_weather *weather);

/* Waits until all cycles have been computed. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_finish(struct paper *p);

/* ---- looking ---- */

enum paper_view {
    PAPER_VIEW_COLOR, /* the fiber's colour minus its pigments: red minus cyan, and so on */
    PAPER_VIEW_WATER  /* gray: lighter where it is wetter */
};

/* Shape: rgb holds height * width * 3 bytes, rows from the top. Errors: NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status paper_view_read(struct paper *p, enum paper_view view, uint8_t *rgb);

enum paper_amount { PAPER_WATER, PAPER_CYAN, PAPER_MAGENTA, PAPER_YELLOW };
/* The total amount in the whole sheet. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_total(struct paper *p, enum paper_amount amount, double *total);

#endif
