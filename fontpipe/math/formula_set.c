/* formula_set.c - nodes as boxes, from the leaves up; and the spaces between atoms (The
 * TeXbook, chapter 18). */
#include "formula_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS_MAX = 1 << 16 };

static struct formula_style raised(struct formula_style s)
{
    s.level = s.level < FORMULA_SCRIPT_STYLE ? FORMULA_SCRIPT_STYLE : FORMULA_SCRIPTSCRIPT;
    return s;
}

static struct formula_style lowered(struct formula_style s)
{
    s.cramped = true;
    return raised(s);
}

static struct formula_style cramped(struct formula_style s)
{
    s.cramped = true;
    return s;
}

/* Of a fraction's numerator. */
static struct formula_style smaller(struct formula_style s)
{
    s.level = s.level == FORMULA_SCRIPTSCRIPT ? s.level : s.level + 1;
    return s;
}

/* ---- characters ---- */

static uint32_t letter_of(const struct font_math *m, const struct formula_node *node)
{
    const uint32_t c = formula_letter(node->character, node->alphabet);
    return formula_has(m, c) ? c : node->character;
}

static struct formula_box symbol_set(struct font_math *m, const struct formula_node *node,
                                     struct formula_style style)
{
    struct formula_box box;
    if (!node->big && !formula_has(m, letter_of(m, node)))
        return formula_foreign(m, node->character, style, node->byte);
    if (!node->big) {
        box = formula_glyph_box(m, formula_glyph(m, letter_of(m, node), style),
                                formula_size(m, style), node->byte);
        box.letter = true;
        return box;
    }
    double least =
        style.level == FORMULA_DISPLAY
            ? formula_constant(m, HB_OT_MATH_CONSTANT_DISPLAY_OPERATOR_MIN_HEIGHT, style)
            : 0;
    box = formula_tall(m, node->character, least, style, node->byte);
    formula_box_centre(m, &box, style);
    return box;
}

static bool is_simple(const struct formula_node *node)
{
    return node && !node->next && !node->sup && !node->sub && node->kind == FORMULA_SYMBOL;
}

/* What is in braces; a single letter stays one. */
static struct formula_box group_set(struct font_math *m, const struct formula_node *first,
                                    struct formula_style style)
{
    return is_simple(first) ? symbol_set(m, first, style) : formula_set(m, first, style);
}

/* ---- what has parts ---- */

static struct formula_box list_set(struct font_math *m, const struct formula_node *first,
                                   int before, struct formula_style style);

static struct formula_box fraction_set(struct font_math *m, const struct formula_node *node,
                                       struct formula_style style)
{
    if (node->style >= 0)
        style.level = node->style;
    struct formula_box over = formula_set(m, node->a, smaller(style));
    struct formula_box under = formula_set(m, node->b, cramped(smaller(style)));
    struct formula_box box =
        formula_fraction(m, over, under, node->number > 0, style, node->byte);
    return formula_fenced(m, box, node->character, node->other, style, node->byte);
}

static struct formula_box radical_set(struct font_math *m, const struct formula_node *node,
                                      struct formula_style style)
{
    struct formula_box in = formula_set(m, node->a, cramped(style));
    struct formula_box box = formula_radical(m, in, style, node->byte);
    const struct formula_style least = {FORMULA_SCRIPTSCRIPT, false};
    return node->b ? formula_degree(m, box, formula_set(m, node->b, least), style) : box;
}

static struct formula_box accent_set(struct font_math *m, const struct formula_node *node,
                                     struct formula_style style)
{
    struct formula_box in = group_set(m, node->a, cramped(style));
    /* Braces and arrows are as long as what they are over; hats no longer. */
    bool stack = node->stretched && node->character >= 0x2190;
    if (!stack)
        in.width += in.letter ? 0 : in.italic;
    return stack ? formula_brace(m, in, node->character, node->under, style, node->byte)
                 : formula_accent(m, in, node, style);
}

/* Pieces with delimiters around and between them, all as large as the largest asks for. */
static struct formula_box fenced_set(struct font_math *m, const struct formula_node *node,
                                     struct formula_style style)
{
    struct formula_box all = formula_box_empty(m);
    int count = 0, i = 0;
    for (const struct formula_node *piece = node->a; piece; piece = piece->next)
        count++;
    struct formula_box *pieces = calloc((size_t)count + 1, sizeof *pieces);
    if (!pieces) {
        m->status = font_fail(FONT_NO_MEMORY, "no memory for a formula");
        return all;
    }
    for (const struct formula_node *piece = node->a; piece; piece = piece->next, i++) {
        pieces[i] = formula_set(m, piece->a, style);
        all.height = fmax(all.height, pieces[i].height);
        all.depth = fmax(all.depth, pieces[i].depth);
    }
    i = 0;
    const struct formula_box ends = all;
    for (const struct formula_node *piece = node->a; piece; piece = piece->next, i++) {
        formula_box_move(m, &pieces[i], all.width, 0);
        all.width += pieces[i].width;
        if (!piece->next)
            break;
        struct formula_box middle =
            formula_fence(m, piece->character, ends.height, ends.depth, style, node->byte);
        formula_box_move(m, &middle, all.width, 0);
        all.width += middle.width;
    }
    free(pieces);
    all.end = m->items_count;
    return formula_fenced(m, all, node->character, node->other, style, node->byte);
}

static int columns_count(const struct formula_node *rows, int *rows_count)
{
    int most = 0;
    *rows_count = 0;
    for (const struct formula_node *row = rows; row; row = row->next) {
        int columns = 0;
        for (const struct formula_node *cell = row->a; cell; cell = cell->next)
            columns++;
        most = columns > most ? columns : most;
        ++*rows_count;
    }
    return most;
}

static struct formula_box array_set(struct font_math *m, const struct formula_node *node,
                                    struct formula_style style)
{
    int rows, columns = columns_count(node->a, &rows), at = 0;
    struct formula_box empty = formula_box_empty(m);
    const struct formula_table *table = node->table;
    if (columns > FORMULA_COLUMNS_MAX || (long)rows * columns > CELLS_MAX) {
        m->status = font_fail(FONT_TOO_LARGE, "a formula has up to %d columns and %d cells",
                              FORMULA_COLUMNS_MAX, CELLS_MAX);
        return empty;
    }
    struct formula_box *cells = calloc((size_t)rows * (size_t)columns + 1, sizeof *cells);
    if (!cells) {
        m->status = font_fail(FONT_NO_MEMORY, "no memory for a formula");
        return empty;
    }
    for (const struct formula_node *row = node->a; row; row = row->next) {
        const struct formula_node *cell = row->a;
        for (int c = 0; c < columns; c++, cell = cell ? cell->next : NULL)
            /* A second of two goes on with what the first began. */
            cells[at++] = cell ? list_set(m, cell->a, table->pairs && c % 2 ? FORMULA_ORD : -1,
                                          (struct formula_style){table->style, style.cramped})
                               : formula_box_empty(m);
    }
    const char *kinds = node->text ? node->text : table->columns;
    struct formula_box box =
        formula_array(m, cells, rows, columns, table, kinds,
                      node->text ? node->text_bytes : (int)strlen(kinds), style);
    free(cells);
    return table->left || table->right
               ? formula_fenced(m, box, table->left, table->right, style, node->byte)
               : box;
}

static struct formula_box overset_set(struct font_math *m, const struct formula_node *node,
                                      struct formula_style style)
{
    struct formula_box of = group_set(m, node->a, style);
    struct formula_box more =
        formula_set(m, node->b, node->under ? lowered(style) : raised(style));
    of.italic = 0;
    return formula_limits(m, of, node->under ? NULL : &more, node->under ? &more : NULL, style);
}

static struct formula_box arrow_set(struct font_math *m, const struct formula_node *node,
                                    struct formula_style style)
{
    struct formula_box over = formula_set(m, node->b, raised(style));
    struct formula_box under = formula_set(m, node->a, lowered(style));
    return formula_arrow(m, node->character, &over, node->a ? &under : NULL, style, node->byte);
}

static struct formula_box phantom_set(struct font_math *m, const struct formula_node *node,
                                      struct formula_style style)
{
    enum { WIDTH = 1, HEIGHT = 2, SEEN = 4 };
    const int bits = (int)node->number;
    struct formula_box box = formula_set(m, node->a, style);
    if (!(bits & SEEN))
        m->items_count = box.end = box.begin;
    box.width = bits & WIDTH ? box.width : 0;
    box.height = bits & HEIGHT ? box.height : 0;
    box.depth = bits & HEIGHT ? box.depth : 0;
    return box;
}

/* A delimiter as \left would have it around a box so high. */
static struct formula_box big_set(struct font_math *m, const struct formula_node *node,
                                  struct formula_style style)
{
    struct formula_style text = {FORMULA_TEXT, style.cramped};
    return formula_fence(m, node->character, node->number * m->size, 0, text, node->byte);
}

static struct formula_box strike_set(struct font_math *m, const struct formula_node *node,
                                     struct formula_style style)
{
    struct formula_box box = group_set(m, node->a, style);
    struct formula_box slash =
        formula_glyph_box(m, formula_glyph(m, '/', style), formula_size(m, style), node->byte);
    formula_box_move(m, &slash, (box.width - slash.width) / 2, 0);
    box.height = fmax(box.height, slash.height);
    box.depth = fmax(box.depth, slash.depth);
    box.end = m->items_count;
    box.glyph = 0;
    box.letter = false;
    return box;
}

static struct formula_box nucleus_set(struct font_math *m, const struct formula_node *node,
                                      struct formula_style style)
{
    switch (node->kind) {
    case FORMULA_SYMBOL:
        return symbol_set(m, node, style);
    case FORMULA_GROUP:
        return group_set(m, node->a, style);
    case FORMULA_WORDS:
        return formula_words(m, node, style);
    case FORMULA_FRACTION:
        return fraction_set(m, node, style);
    case FORMULA_RADICAL:
        return radical_set(m, node, style);
    case FORMULA_ACCENT:
        return accent_set(m, node, style);
    case FORMULA_BAR:
        return formula_bar(m, formula_set(m, node->a, node->under ? style : cramped(style)),
                           node->under, style, node->byte);
    case FORMULA_BOXED:
        return formula_boxed(m, formula_set(m, node->a, style), style, node->byte);
    case FORMULA_FENCED:
        return fenced_set(m, node, style);
    case FORMULA_BIG:
        return big_set(m, node, style);
    case FORMULA_ARRAY:
        return array_set(m, node, style);
    case FORMULA_OVERSET:
        return overset_set(m, node, style);
    case FORMULA_ARROW:
        return arrow_set(m, node, style);
    case FORMULA_PHANTOM:
        return phantom_set(m, node, style);
    case FORMULA_STRIKE:
        return strike_set(m, node, style);
    case FORMULA_ROW:
    case FORMULA_SPACE:
    case FORMULA_STYLE:
    case FORMULA_KINDS:
        break;
    }
    return formula_box_empty(m);
}

/* A nucleus with what hangs on it. */
static struct formula_box atom_set(struct font_math *m, const struct formula_node *node,
                                   struct formula_style style)
{
    struct formula_box sup, sub, box = nucleus_set(m, node, style);
    bool is_operator = node->class == FORMULA_OP;
    if (!node->sup && !node->sub) {
        box.width += is_operator ? 0 : box.italic;
        return box;
    }
    if (node->sup)
        sup = formula_set(m, node->sup, raised(style));
    if (node->sub)
        sub = formula_set(m, node->sub, lowered(style));
    bool limits =
        node->limits == FORMULA_LIMITS_ALWAYS ||
        (is_operator && node->limits == FORMULA_LIMITS_USUAL && style.level == FORMULA_DISPLAY);
    struct formula_box *over = node->sup ? &sup : NULL, *under = node->sub ? &sub : NULL;
    return limits ? formula_limits(m, box, over, under, style)
                  : formula_scripts(m, box, over, under, is_operator, style);
}

/* ---- spaces ---- */

static bool is_atom(const struct formula_node *node)
{
    return node->kind != FORMULA_SPACE && node->kind != FORMULA_STYLE;
}

/* What an atom counts as beside its neighbours: rules 5 and 6. before: -1 for none. */
static int class_of(const struct formula_node *node, int before)
{
    if (node->class != FORMULA_BIN)
        return (int)node->class;
    const struct formula_node *next = node->next;
    while (next && !is_atom(next))
        next = next->next;
    bool after = next && next->class != FORMULA_REL && next->class != FORMULA_CLOSE &&
                 next->class != FORMULA_PUNCT;
    bool behind = before >= 0 && before != FORMULA_BIN && before != FORMULA_OP &&
                  before != FORMULA_REL && before != FORMULA_OPEN && before != FORMULA_PUNCT;
    return after && behind ? FORMULA_BIN : FORMULA_ORD;
}

/* In ems. */
static double space_between(int before, int class, struct formula_style style)
{
    /* 1 thin, 2 medium, 3 thick; negative: not in scripts. */
    static const int8_t table[FORMULA_CLASSES][FORMULA_CLASSES] = {
        [FORMULA_ORD] = {0, 1, -2, -3, 0, 0, 0, -1},
        [FORMULA_OP] = {1, 1, 0, -3, 0, 0, 0, -1},
        [FORMULA_BIN] = {-2, -2, 0, 0, -2, 0, 0, -2},
        [FORMULA_REL] = {-3, -3, 0, 0, -3, 0, 0, -3},
        [FORMULA_OPEN] = {0, 0, 0, 0, 0, 0, 0, 0},
        [FORMULA_CLOSE] = {0, 1, -2, -3, 0, 0, 0, -1},
        [FORMULA_PUNCT] = {-1, -1, 0, -1, -1, -1, -1, -1},
        [FORMULA_INNER] = {-1, 1, -2, -3, -1, 0, -1, -1}};
    static const double ems[] = {0, 3 / 18.0, 4 / 18.0, 5 / 18.0};
    if (before < 0)
        return 0;
    int space = table[before][class];
    if (space < 0)
        space = style.level >= FORMULA_SCRIPT_STYLE ? 0 : -space;
    return ems[space];
}

/* before: the class of what is thought to stand before the first; -1: nothing. */
static struct formula_box list_set(struct font_math *m, const struct formula_node *first,
                                   int before, struct formula_style style)
{
    struct formula_box box = formula_box_empty(m);
    bool any = false;
    for (const struct formula_node *node = first; node && m->status == FONT_OK;
         node = node->next) {
        if (node->kind == FORMULA_STYLE) {
            style.level = node->style;
            continue;
        }
        if (node->kind == FORMULA_SPACE) {
            box.width += node->number * formula_size(m, style);
            continue;
        }
        struct formula_box one = atom_set(m, node, style);
        int class = class_of(node, before);
        box.width += space_between(before, class, style) * formula_size(m, style);
        formula_box_move(m, &one, box.width, 0);
        box.width += one.width;
        box.height = any ? fmax(box.height, one.height) : one.height;
        box.depth = any ? fmax(box.depth, one.depth) : one.depth;
        before = class;
        any = true;
    }
    box.end = m->items_count;
    return box;
}

struct formula_box formula_set(struct font_math *m, const struct formula_node *first,
                               struct formula_style style)
{
    return list_set(m, first, -1, style);
}
