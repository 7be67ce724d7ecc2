/* sheet.h - a sheet of paper with any number of pigments, on the surface and in the fibers.
 *
 *     struct paper_sheet_config config = paper_sheet_config_default();
 *     config.stock = *paper_stock_find("cold press");
 *     config.pigments[config.pigments_count++] = *paper_pigment_find("quinacridone rose");
 *     struct paper_sheet *sheet;
 *     if (paper_sheet_create(&config, &sheet) != PAPER_OK)
 *         die(paper_error());
 *     double put[1 + PAPER_PIGMENTS_MAX] = {0.8, 0.5};
 *     paper_sheet_put(sheet, NULL, 0, 0, put);
 *     for (int step = 0; step < 300; step++)
 *         paper_sheet_step(sheet);
 *     paper_sheet_view(sheet, &(struct paper_sheet_view){.view = PAPER_SHOW_COLOR}, rgb16);
 *
 * The model (docs/paper.md) joins those of Small (SPIE 1991) and of Curtis et al. (SIGGRAPH
 * 1997), in parts that are switched on one by one.  Without any part it is the thesis's cycle
 * of paper.h, to the bit. With parts, amounts are in grains, PAPER_GRAINS to the unit: whole
 * numbers in floats, so flows between fibers are exact, and totals never drift.
 *
 * Errors, ownership and threads: as paper.h says.
 */
#ifndef LUTETIA_PAPER_SHEET_H
#define LUTETIA_PAPER_SHEET_H

#include "paper.h"

enum { PAPER_PIGMENTS_MAX = 16, PAPER_NAME_MAX = 48, PAPER_GRAINS = 1 << 20, PAPER_BANDS = 10 };

/* ---- pigments ---- */

struct paper_pigment {
    char name[PAPER_NAME_MAX];
    double weight[2];   /* mobility with water in the fibers, along x and along y, 0..1 */
    double density;     /* part of it that settles in a step, 0..1 */
    double staining;    /* resistance to being lifted again, 0.5..100 */
    double granulation; /* how much it prefers hollows when it settles, 0..1.6 */
    double k[3],
        s[3]; /* Kubelka-Munk absorption and scattering of one unit, red, green, blue, 0..100 */
    double takes[3]; /* rule of subtraction: what a unit takes from each channel, -1..1 */
    /* The same by bands of 35 nm, from 380 to 730 nm, 0..100. All 0: only k and s are known. */
    double absorption[PAPER_BANDS], scattering[PAPER_BANDS];
    double shift; /* drying shift: how much more it absorbs while it is wet, 0..2 */
};

/* A paint that shops sell, or one of the thesis's inks. */
struct paper_paint {
    struct paper_pigment pigment;
    const char *also;    /* shorter and other names, ", " between them; "": none */
    const char *index;   /* what is in it, by the Colour Index: "PB29" */
    double particle_um;  /* about how large its particles are */
    double transparency; /* 0: it hides what is below; 4: it hides nothing */
    /* of its spectrum: "measured", "adjusted", "fitted", "mixed", "Curtis", "thesis"
     * (docs/paints.md) */
    const char *source;
};

/* Paints by number from 0; NULL: none. They are constants of the library, valid for ever. */
const struct paper_paint *paper_paint_number(int number);
/* Their pigments by name, by a name of `also`, or by number; NULL: none. They are constants of
 * the library, valid for ever. */
const struct paper_pigment *paper_pigment_find(const char *name);
const struct paper_pigment *paper_pigment_number(int number);
/* What paper_pigment_find() found before there were paints: the twelve pigments of Curtis et
 * al. 1997 and the thesis's inks. NULL: none. They are constants of the library, valid for
 * ever. */
const struct paper_pigment *paper_pigment_curtis(const char *name);
#define PAPER_PIGMENT_USUAL "french ultramarine" /* of what is painted without naming one */
/* Their names, "quinacridone rose, indian red, ...", cut where there is no room;
 * PAPER_PIGMENT_NAMES_ROOM is enough. */
enum { PAPER_PIGMENT_NAMES_ROOM = 1200 };
void paper_pigment_names(char *text, size_t room);

/* K and S of a layer of one unit with these colours over white and over black, in linear
 * light. Errors: BAD_ARGUMENT unless 0 < over_black < over_white < 1 in each channel.
 * Source: Curtis et al. 1997, 5.1. */
enum paper_status paper_pigment_colors(struct paper_pigment *pigment,
                                       const double over_white[3], const double over_black[3]);

/* Of the pigment only k and s are known from now on. */
void paper_pigment_unband(struct paper_pigment *pigment);

/* Linear light of a display value, and back; both 0..1 (IEC 61966-2-1). */
double paper_light_linear(double display);
double paper_light_display(double linear);

/* ---- papers ---- */

struct paper_stock {
    char name[PAPER_NAME_MAX];
    double color[3];        /* of dry fibers, display values, 0..1 */
    double color_variation; /* 0..1 */
    /* mean part of a gradient that flows across a face, 0..PAPER_ABSORBENCY_MAX */
    double absorbency;
    double absorbency_variation;
    double absorbency_along[2]; /* factors along x and along y, 0..1 */
    double
        capacity[2];  /* water capacity of a fiber where the paper is low and where it is high,
              * 0.01..1 */
    double roughness; /* deviation of heights about 1/2, 0..1 */
    double grain_px;  /* size of its hills, 1..64 */
    int fiber_length
        [2]; /* length of fibers along x and along y, along which the paper is uniform, 1..64 */
};

/* "cold press", "hot press", "rough", "blotting", "glass", "laid", "xuan"; by name or by number
 * from 0; NULL: none. They are constants of the library, valid for ever. */
const struct paper_stock *paper_stock_find(const char *name);
const struct paper_stock *paper_stock_number(int number);
/* Their names, "cold press, hot press, ...". */
void paper_stock_names(char *text, size_t room);

/* The edges of a handmade sheet: fibers seep under the frame of the mould, the deckle. Lengths
 * in fibers. */
struct paper_deckle {
    double margin; /* from the picture's border to the mean edge, 2..4096 */
    double waves;  /* deviation of the edge from it, 0..256 */
    double thin;   /* over how many fibers the sheet gets as thick as it is, 1..1024 */
    double fringe; /* how far single fibers reach over the edge, 0..256 */
};
struct paper_deckle paper_deckle_default(void);

/* ---- the sheet ---- */

enum {
    PAPER_PART_INFUSED = 1, /* water and pigments in the fibers */
    PAPER_PART_SURFACE = 2, /* and on the surface; implies INFUSED */
    PAPER_PART_FIXING = 4,  /* pigments settle on the fibers and are lifted again */
    PAPER_PART_EDGE = 8,    /* wet areas dry faster at their edges; implies SURFACE */
    PAPER_PARTS_ALL = 15
};

enum paper_rule {
    PAPER_RULE_KUBELKA_MUNK,
    PAPER_RULE_SUBTRACT, /* the thesis's rule: the paper's colour minus what pigments take */
    PAPER_RULE_LUMINOUS  /* for dark paper: the paper's colour plus what pigments do not take */
};

struct paper_air {     /* conditions that may change at any time */
    double gravity[2]; /* pull on the surface along x and along y, -1..1 */
    double seep[2];    /* the same in the fibers, -1..1 */
    double spread;     /* rate at which surface water levels, 0..1 */
    double relief;     /* influence of the paper's height on the water, 0..1 */
    double film;       /* thinner water flows slower, 0.001..1 */
    double pinning; /* depth from which water enters dry fibers, 0..2; 0: it flows anywhere */
    double absorption; /* surface water that sinks in, times absorbency, 0..4 */
    double carry; /* part of a pigment's flow in fibers that follows the water; the rest follows
                          the pigment's own gradient, 0..1 */
    double humidity;   /* water that dries in a step, 0..1 */
    double edge;       /* how many times faster a wet area dries at its edge, 0..200 */
    double edge_width; /* fibers, 1..32 */
    double settling;   /* factor on density and lifting, 0..10 */
    struct paper_weather thesis; /* without parts */
};
/* Calm air over a flat sheet, for all parts; and the weather of paper_weather_default(). */
struct paper_air paper_air_default(void);

/* The version of the model, which saved states name. A change that gives other bits, or another
 * plane, is a new version. States of older versions are read: their water and paint have the
 * same bits; that of version 1 lies on all of each fiber. */
enum { PAPER_MODEL_VERSION = 5, PAPER_MODEL_READ = 1 };

struct paper_sheet_config {
    int width, height; /* fibers, PAPER_SIDE_MIN..PAPER_SIDE_MAX */
    bool torus;        /* water that leaves at one edge enters at the opposite one */
    unsigned parts;    /* PAPER_PART_...; 0: the thesis's model */
    enum paper_rule rule;
    struct paper_stock stock;
    uint64_t seed;
    int pigments_count; /* 0..PAPER_PIGMENTS_MAX */
    struct paper_pigment pigments[PAPER_PIGMENTS_MAX];
    /* with parts and fibers, no torus: the sheet has such edges. Else it is cut at the
     * picture's border */
    bool deckled;
    struct paper_deckle deckle;
};
/* A sheet of the usual model with all parts, without pigments. */
struct paper_sheet_config paper_sheet_config_default(void);
/* Fibers along the picture's borders where the sheet may end or be thin: 0 without a deckle. */
double paper_sheet_margin(const struct paper_sheet_config *config);
/* What brushes keep of each fiber on the front end, bytes: its tooth, and how many touch
 * it. */
enum { PAPER_BRUSHES_BYTES = 4 };
/* Memory that a sheet of that size takes, bytes: of the device each field, its replacement, and
 * temporaries in a part of a step, a little above what was measured of 4096x4096 fibers with
 * three pigments (67 float arrays) and of 2900x2900 with six (85); and what brushes keep. While
 * the first steps of a smaller sheet are computed it may be twice that. */
double paper_sheet_bytes(double width, double height, int pigments);

struct paper_sheet;

/* Errors: BAD_ARGUMENT, NO_DEVICE, NO_MEMORY, MACHINE_FAILED; *out is then NULL. Owns: the
 * caller destroys *out. */
enum paper_status paper_sheet_create(const struct paper_sheet_config *config,
                                     struct paper_sheet **out);
void paper_sheet_destroy(struct paper_sheet *sheet); /* NULL is fine */
const struct paper_sheet_config *paper_sheet_get_config(const struct paper_sheet *sheet);

/* The layers of a sheet: properties of the paper, and its contents. Three layers exist once
 * for each pigment. */
#define PAPER_GRIP_LEAST 0.15f
#define PAPER_GRIP_MOST 2.0f

enum paper_layer {
    PAPER_LAYER_HEIGHT,     /* 0..1 */
    PAPER_LAYER_ABSORBENCY, /* 0..PAPER_ABSORBENCY_MAX */
    PAPER_LAYER_CAPACITY,   /* 0.01..1 */
    PAPER_LAYER_RESIST,     /* masking fluid: 1 where nothing can be put */
    PAPER_LAYER_VARNISH,    /* 0..1; techniques.h */
    PAPER_LAYER_SALT,       /* grains, 0..4, and what has dissolved of them, 0..4 */
    PAPER_LAYER_BRINE,
    PAPER_LAYER_RED, /* the colour under the pigments: linear light, 0..1, or, by the other
                      * rules, display values */
    PAPER_LAYER_GREEN,
    PAPER_LAYER_BLUE,
    PAPER_LAYER_SURFACE_WATER, /* this and the next five: 0..15, and 0..4 when written */
    PAPER_LAYER_INFUSED_WATER,
    PAPER_LAYER_DRIED_WATER,     /* what has evaporated */
    PAPER_LAYER_SURFACE_PIGMENT, /* one for each */
    PAPER_LAYER_INFUSED_PIGMENT,
    PAPER_LAYER_FIXED_PIGMENT,
    /* Of sheets with a surface: resistance of fibers to wetting, 0.01..100, about 1; eddies,
     * -10..10; wet part of each fiber, 0..1 */
    PAPER_LAYER_SIZING,
    PAPER_LAYER_CURRENT,
    PAPER_LAYER_WET_PART,
    /* Of sheets with parts: how willingly the paper takes what a bristle leaves, 0.15..2, about
     * 1 */
    PAPER_LAYER_GRIP,
    /* Of sheets with a deckle: 1; less towards the edge, and 0 where there is no paper */
    PAPER_LAYER_THICKNESS,
    /* Of sheets with a surface: what part of each fiber its paint lies on, 0..1; 0: on all of
     * it. It cannot be written */
    PAPER_LAYER_STAINED_PART,
    PAPER_LAYERS_COUNT
};

/* Shape: height * width numbers, rows from the top. Writing clamps to the range above
 * (DRIED_WATER cannot be written). Errors: BAD_ARGUMENT (NaN, a pigment that is not there),
 * NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_layer_write(struct paper_sheet *sheet, enum paper_layer layer,
                                          int pigment, const float *values);
enum paper_status paper_sheet_layer_read(struct paper_sheet *sheet, enum paper_layer layer,
                                         int pigment, float *values);

/* What writing clamps to. */
void paper_sheet_layer_range(const struct paper_sheet *sheet, enum paper_layer layer,
                             double range[2]);

/* The total over the sheet, in units: of water (substance 0), of a pigment (1 + its number), or
 * of the water that has dried (-1). Exact on sheets with parts. Errors: NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status paper_sheet_total(struct paper_sheet *sheet, int substance, double *total);

/* Adds amount[0] of water and amount[1 + i] of pigment i (each -4..4) through a screen whose
 * upper left corner is at x, y, or everywhere (NULL), on the surface if there is one, else
 * into the fibers. A fiber's water and each pigment can reach 4 by this (without parts 1).
 * Fibers with resist get nothing. Errors: BAD_ARGUMENT, NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_put(struct paper_sheet *sheet, const struct paper_screen *screen,
                                  int x, int y, const double *amount);

/* Removes the fraction `part` (0..1) of the water and of the pigments that move with it, on the
 * surface and in the fibers, and the fraction `lift` (0..1) of the fixed pigments. Errors: as
 * paper_sheet_put(). */
enum paper_status paper_sheet_blot(struct paper_sheet *sheet, const struct paper_screen *screen,
                                   int x, int y, double part, double lift);

/* Paints masking fluid on (amount 1) or rubs it off (0). Errors: as paper_sheet_put(). */
enum paper_status paper_sheet_resist(struct paper_sheet *sheet,
                                     const struct paper_screen *screen, int x, int y, bool on);

/* Dries the whole sheet at once; pigments stay, and are fixed if there is fixing. Errors:
 * NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_dry(struct paper_sheet *sheet);
/* Dries everything and seals the pigments under a varnish: they become part of the paper's
 * colour. Errors: as paper_sheet_dry(). */
enum paper_status paper_sheet_seal(struct paper_sheet *sheet);

/* Sets the air. Errors: BAD_ARGUMENT, NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_air(struct paper_sheet *sheet, const struct paper_air *air);
/* A name for this moment of the history, which changes nothing of the sheet. Errors:
 * NO_MEMORY. */
struct paper_bookmark {
    char name[PAPER_NAME_MAX]; /* UTF-8; "": none */
};
enum paper_status paper_sheet_bookmark(struct paper_sheet *sheet,
                                       const struct paper_bookmark *bookmark);
/* The air that the sheet has now, never NULL; valid until the sheet's air changes, or the sheet
 * is destroyed. */
const struct paper_air *paper_sheet_get_air(const struct paper_sheet *sheet);
/* Goes one step of time. Errors: as paper_sheet_air(). */
enum paper_status paper_sheet_step(struct paper_sheet *sheet);
/* Waits until all steps have been computed; else a step is computed when something of the sheet
 * is read. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_finish(struct paper_sheet *sheet);
/* Where water flows, steps are computed only in boxes around what can change, if they take less
 * than half of the sheet. The bits are the same. Their sides are a few multiples of `unit`
 * fibers, 4..4096: 64 unless told; 0: there are none. No event: it is not recorded. Errors:
 * BAD_ARGUMENT, MACHINE_FAILED. */
enum paper_status paper_sheet_confine(struct paper_sheet *sheet, int unit);
#define PAPER_PARTED_USUAL 8388608.0
/* Steps of a sheet, or of a box, that has so many fibers or more are computed in three parts
 * instead of at once: PAPER_PARTED_USUAL unless told. That takes less memory and a little more
 * time. The bits are the same. No event: it is not recorded. Errors: BAD_ARGUMENT (NaN, below
 * 0). */
enum paper_status paper_sheet_part_from(struct paper_sheet *sheet, double fibers);
/* The part of the sheet that the last step computed: 1 without boxes. */
double paper_sheet_share(const struct paper_sheet *sheet);
/* The number of steps that the sheet has gone through; during a stroke, those of the stroke so
 * far, too. */
long paper_sheet_now(const struct paper_sheet *sheet);

/* ---- looking ---- */

/* Light on the relief of sheets with parts, where nothing else is said. */
#define PAPER_LIGHT_USUAL 1.2

enum paper_show {
    PAPER_SHOW_COLOR, /* by the sheet's rule */
    PAPER_SHOW_WATER, /* gray: lighter where it is wetter, both layers */
    PAPER_SHOW_WET,   /* colour, with light from the upper left on the water's surface */
    PAPER_SHOW_LAYER  /* gray: black at `low`, white at `high` */
};
struct paper_sheet_view {
    enum paper_show show;
    enum paper_layer layer;
    int pigment;
    double low, high;
    /* on the paper's relief, from the upper left, in colours: 0 (even light) to 4; water that
     * stands hides it */
    double light;
    /* pixels a fiber each way: 1 (or 0), 2 or 4; the mean of a fiber's pixels is what one
     * shows */
    int scale;
    /* Of colours, where the sheet has a deckle: what it lies on, display values; NULL:
     * PAPER_GROUND_USUAL. With `alpha` there is no ground: it gets as many numbers as there are
     * pixels, how much of what is behind is hidden by the sheet and its shadow. */
    const double *ground;
    uint16_t *alpha;
};

/* What sheets with a deckle lie on, display values. */
#define PAPER_GROUND_USUAL                                                                     \
    {                                                                                          \
        0.44, 0.42, 0.40                                                                       \
    }

/* The colours as they are usually looked at: with light on the relief of sheets with parts,
 * without on the thesis's page. */
struct paper_sheet_view paper_sheet_view_default(const struct paper_sheet_config *config);

/* The memory besides rgb that a picture with more than one pixel a fiber takes while it is
 * made. */
double paper_sheet_view_bytes(const struct paper_sheet_config *config, int scale);

/* Shape: rgb holds height * width * 3 display values of 16 bits, rows from the top; with more
 * than one pixel a fiber, scale times as many each way. Errors: BAD_ARGUMENT, NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status paper_sheet_view(struct paper_sheet *sheet,
                                   const struct paper_sheet_view *view, uint16_t *rgb);

/* ---- shapes, as screens as small as they are, with soft edges a pixel wide ---- */

/* Shape: points_count pairs of x, y. A polygon may cross itself (even-odd). *x, *y get the
 * screen's corner. The polygon is clipped to 0, 0, width, height; if nothing is left, the
 * screen is empty (gray NULL). Errors: BAD_ARGUMENT, NO_MEMORY. Owns: the caller destroys
 * *screen. */
enum paper_status paper_polygon_screen(const double *points, int points_count, int width,
                                       int height, struct paper_screen *screen, int *x, int *y);

#endif
