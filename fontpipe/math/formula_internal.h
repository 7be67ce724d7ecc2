/* formula_internal.h - what the files of fontpipe/math share.
 *
 *     text -> nodes             formula_read.c; the names it knows: formula_names.c
 *          -> boxes of items    formula_set.c: goes through the nodes, and has boxes made out
 *                               of boxes by formula_glyph.c (characters, variants, assemblies),
 *                               formula_scripts.c, formula_stack.c, formula_array.c
 *          -> a layout          font_math.c
 *
 * A box is a range of the setter's items: what it is made of was made just before it, so the
 * ranges of its parts lie side by side, and a part is moved where it is. Numbers are pixels, y
 * downwards; heights and depths are told from the baseline. */
#ifndef LUTETIA_FONT_FORMULA_INTERNAL_H
#define LUTETIA_FONT_FORMULA_INTERNAL_H

#include "../internal.h"
#include "font_math.h"

#include <hb-ot.h>
#include <hb.h>

enum {
    FORMULA_BYTES_MAX = 1 << 16,
    FORMULA_DEPTH_MAX = 100,
    FORMULA_ITEMS_MAX = 1 << 20,
    FORMULA_COLUMNS_MAX = 64
};

/* Classes of atoms, in the order of TeX's table of spaces. */
enum formula_class {
    FORMULA_ORD,
    FORMULA_OP,
    FORMULA_BIN,
    FORMULA_REL,
    FORMULA_OPEN,
    FORMULA_CLOSE,
    FORMULA_PUNCT,
    FORMULA_INNER,
    FORMULA_CLASSES
};

/* Which letters a letter stands for: Unicode's mathematical alphabets. */
enum formula_alphabet {
    FORMULA_ITALIC, /* TeX's own: letters and small Greek slanted, the rest upright */
    FORMULA_UPRIGHT,
    FORMULA_BOLD,
    FORMULA_BOLD_ITALIC,
    FORMULA_DOUBLE,
    FORMULA_SCRIPT,
    FORMULA_FRAKTUR,
    FORMULA_SANS,
    FORMULA_MONO
};

enum formula_kind {
    FORMULA_SYMBOL,   /* character */
    FORMULA_GROUP,    /* a */
    FORMULA_WORDS,    /* text..text_bytes; style: 0 upright, or 1 and an alphabet */
    FORMULA_FRACTION, /* a over b; number: 0 without a rule; character, other: delimiters */
    FORMULA_RADICAL,  /* of a; b: its degree */
    FORMULA_ACCENT,   /* character over a; stretched, under */
    FORMULA_BAR,      /* over a, or under it */
    FORMULA_BOXED,    /* a in a frame */
    FORMULA_FENCED,   /* a between character and other */
    FORMULA_BIG,      /* character, so many ems high */
    FORMULA_ARRAY,    /* a: rows, whose a are cells, whose a are nodes; array */
    FORMULA_ROW,      /* of an array, or a cell of it */
    FORMULA_SPACE,    /* number: ems */
    FORMULA_STYLE,    /* style: of what follows */
    FORMULA_OVERSET,  /* b over a, or under it */
    FORMULA_ARROW,    /* character, stretched over b and under sub */
    FORMULA_PHANTOM,  /* a, unseen; bits of number: its width, its height and depth; 4: seen */
    FORMULA_STRIKE,   /* \not: a slash through what follows */
    FORMULA_KINDS
};

enum formula_limits { FORMULA_LIMITS_USUAL, FORMULA_LIMITS_NONE, FORMULA_LIMITS_ALWAYS };

/* How an environment sets its cells. */
struct formula_table {
    const char *name;
    uint32_t left, right; /* delimiters; 0: none */
    const char *columns;  /* l, c, r; the last for all after it */
    double gap_em;        /* between columns */
    double row_em;        /* of what rows are farther apart */
    int style;            /* of cells: a FORMULA_DISPLAY.. */
    bool pairs;           /* no gap behind each first of two columns */
    char argument;        /* what follows its name: 'c' columns, 'n' a number; 0: nothing */
};

struct formula_node {
    enum formula_kind kind;
    enum formula_class class;
    enum formula_alphabet alphabet;
    enum formula_limits limits;
    uint32_t character, other;
    double number;
    int style, byte;
    bool stretched, under, big;
    bool is_source; /* its words stand so in the formula's text */
    const char *text;
    int text_bytes;
    const struct formula_table *table;
    struct formula_node *a, *b, *sup, *sub, *next;
};

/* ---- formula_names.c ---- */

struct formula_symbol {
    const char *name;
    uint32_t character;
    enum formula_class class;
    enum formula_limits limits; /* of an operator: NONE as \int has it */
};
/* NULL: there is none. */
const struct formula_symbol *formula_symbol_find(const char *name, size_t bytes);
/* What a character is by itself; ORD if nothing is known. */
enum formula_class formula_class_of(uint32_t character);
/* The characters that a letter stands for in an alphabet; itself if it has none there. */
uint32_t formula_letter(uint32_t character, enum formula_alphabet alphabet);
/* A character that is `character` with a slash through it; 0: there is none. */
uint32_t formula_struck(uint32_t character);
const struct formula_table *formula_table_find(const char *name, size_t bytes);

/* ---- formula_read.c ---- */

struct formula_nodes {
    struct formula_node **blocks; /* of FORMULA_BLOCK each */
    int blocks_count, blocks_capacity, used;
};
enum { FORMULA_BLOCK = 128 };
void formula_nodes_finish(struct formula_nodes *nodes);

struct formula_read {
    struct formula_node *first;
    int unknown_count;
    char unknown[48];
};
/* Errors: TOO_LARGE, NO_MEMORY. Nodes are those of `nodes`. */
enum font_status formula_read(const char *tex, size_t bytes, struct formula_nodes *nodes,
                              struct formula_read *out);

/* ---- boxes ---- */

enum { FORMULA_DISPLAY, FORMULA_TEXT, FORMULA_SCRIPT_STYLE, FORMULA_SCRIPTSCRIPT };
struct formula_style {
    int level;    /* FORMULA_DISPLAY.. */
    bool cramped; /* raises superscripts less */
};

struct formula_item {
    struct font_face *face; /* NULL: a rule */
    uint32_t glyph;
    int byte;
    double x, y;          /* of its origin; of a rule's upper left corner */
    double size;          /* of the em */
    double width, height; /* of a rule */
};

struct formula_box {
    double width, height, depth;
    double italic; /* of the last glyph */
    int begin, end;
    uint32_t glyph; /* where it is one glyph, 0 otherwise */
    bool letter;    /* a single character: scripts hang on it by the font's own heights alone */
};

struct font_math {
    struct font_face *face, *square;
    hb_font_t *hb;
    hb_buffer_t *buffer;
    double upem;
    struct formula_nodes nodes;
    struct formula_read read;
    /* Of the formula that is being set. */
    struct formula_item *items;
    int items_count, items_capacity;
    double size; /* of its em */
    enum font_status status;
    struct font_layout *out; /* what is missing is told there */
    hb_codepoint_t *scripts; /* GSUB's lookups for glyphs of scripts (ssty) */
    unsigned scripts_count;
    struct font_shaper *shaper; /* of what the font has not; NULL until that is met */
};

/* formula_constants.c: a constant of the MATH table at a style's size, in pixels; and the
 * size. */
double formula_size(const struct font_math *m, struct formula_style style);
double formula_constant(const struct font_math *m, hb_ot_math_constant_t constant,
                        struct formula_style style);
double formula_axis(const struct font_math *m, struct formula_style style);

/* formula_glyph.c */
struct formula_box formula_box_empty(const struct font_math *m);
void formula_item_add(struct font_math *m, const struct formula_item *item);
void formula_box_move(struct font_math *m, const struct formula_box *box, double x, double y);
struct formula_box formula_glyph_box(struct font_math *m, uint32_t glyph, double size,
                                     int byte);
/* Whether the font has the character. */
bool formula_has(const struct font_math *m, uint32_t character);
/* The glyph of a character at a style; tells of one that the font has not. */
uint32_t formula_glyph(struct font_math *m, uint32_t character, struct formula_style style);
/* A character at least so high (wide), by a variant or put together of parts; not centred.
 * most: at most so wide instead, and never of parts. */
struct formula_box formula_tall(struct font_math *m, uint32_t character, double height,
                                struct formula_style style, int byte);
struct formula_box formula_wide(struct font_math *m, uint32_t character, double width,
                                bool most, struct formula_style style, int byte);
/* Moves a box so that its middle is on the axis. */
void formula_box_centre(struct font_math *m, struct formula_box *box,
                        struct formula_style style);
/* A delimiter around what is so high and deep: TeX's rule 19. character 0: the blank that
 * stands for none. */
struct formula_box formula_fence(struct font_math *m, uint32_t character, double height,
                                 double depth, struct formula_style style, int byte);
/* formula_words.c: words by the font's shaping, upright. Words, or a single character, that
 * have letters which the font has not are set as text is: by other fonts. */
struct formula_box formula_words(struct font_math *m, const struct formula_node *node,
                                 struct formula_style style);
struct formula_box formula_foreign(struct font_math *m, uint32_t character,
                                   struct formula_style style, int byte);
struct formula_box formula_rule(struct font_math *m, double x, double y, double width,
                                double height, int byte);

/* formula_scripts.c: boxes out of boxes, which were made just before, the nucleus first. NULL:
 * there is none. */
struct formula_box formula_scripts(struct font_math *m, struct formula_box nucleus,
                                   struct formula_box *sup, struct formula_box *sub,
                                   bool is_operator, struct formula_style style);
struct formula_box formula_limits(struct font_math *m, struct formula_box nucleus,
                                  struct formula_box *over, struct formula_box *under,
                                  struct formula_style style);

/* formula_stack.c: likewise. */
struct formula_box formula_fraction(struct font_math *m, struct formula_box over,
                                    struct formula_box under, bool rule,
                                    struct formula_style style, int byte);
struct formula_box formula_radical(struct font_math *m, struct formula_box in,
                                   struct formula_style style, int byte);
/* The degree is made after the radical. */
struct formula_box formula_degree(struct font_math *m, struct formula_box radical,
                                  struct formula_box degree, struct formula_style style);
struct formula_box formula_accent(struct font_math *m, struct formula_box in,
                                  const struct formula_node *node, struct formula_style style);
struct formula_box formula_bar(struct font_math *m, struct formula_box in, bool under,
                               struct formula_style style, int byte);
/* What was made just before, in a frame. */
struct formula_box formula_boxed(struct font_math *m, struct formula_box in,
                                 struct formula_style style, int byte);
struct formula_box formula_fenced(struct font_math *m, struct formula_box in, uint32_t left,
                                  uint32_t right, struct formula_style style, int byte);
/* A stretched sign over what is in the box, or under it. */
struct formula_box formula_brace(struct font_math *m, struct formula_box in, uint32_t character,
                                 bool under, struct formula_style style, int byte);
struct formula_box formula_arrow(struct font_math *m, uint32_t character,
                                 struct formula_box *over, struct formula_box *under,
                                 struct formula_style style, int byte);

/* formula_array.c: cells row by row, each made after the other; rows have `columns` cells,
 * those that are missing being empty boxes. */
struct formula_box formula_array(struct font_math *m, struct formula_box *cells, int rows,
                                 int columns, const struct formula_table *table,
                                 const char *kinds, int kinds_bytes,
                                 struct formula_style style);

/* formula_set.c */
struct formula_box formula_set(struct font_math *m, const struct formula_node *first,
                               struct formula_style style);

#endif
