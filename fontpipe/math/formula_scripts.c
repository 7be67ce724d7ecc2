/* formula_scripts.c - what is raised, lowered, above and below: The TeXbook, appendix G, rules
 * 13a and 18. */
#include "formula_internal.h"

#include <math.h>

#define C(name) formula_constant(m, HB_OT_MATH_CONSTANT_##name, style)

/* How far a superscript is raised, and a subscript lowered. */
struct shifts {
    double up, down;
};

static struct shifts shifts_find(const struct font_math *m, const struct formula_box *nucleus,
                                 const struct formula_box *sup, const struct formula_box *sub,
                                 struct formula_style style)
{
    struct shifts s = {0, 0};
    if (!nucleus->letter) {
        s.up = nucleus->height - C(SUPERSCRIPT_BASELINE_DROP_MAX);
        s.down = nucleus->depth + C(SUBSCRIPT_BASELINE_DROP_MIN);
    }
    if (!sup) {
        s.down =
            fmax(s.down, fmax(C(SUBSCRIPT_SHIFT_DOWN), sub->height - C(SUBSCRIPT_TOP_MAX)));
        return s;
    }
    double least = style.cramped ? C(SUPERSCRIPT_SHIFT_UP_CRAMPED) : C(SUPERSCRIPT_SHIFT_UP);
    s.up = fmax(s.up, fmax(least, sup->depth + C(SUPERSCRIPT_BOTTOM_MIN)));
    if (!sub)
        return s;
    s.down = fmax(s.down, C(SUBSCRIPT_SHIFT_DOWN));
    double gap = (s.up - sup->depth) - (sub->height - s.down);
    if (gap < C(SUB_SUPERSCRIPT_GAP_MIN)) {
        s.down += C(SUB_SUPERSCRIPT_GAP_MIN) - gap;
        double more = C(SUPERSCRIPT_BOTTOM_MAX_WITH_SUBSCRIPT) - (s.up - sup->depth);
        if (more > 0) {
            s.up += more;
            s.down -= more;
        }
    }
    return s;
}

struct formula_box formula_scripts(struct font_math *m, struct formula_box nucleus,
                                   struct formula_box *sup, struct formula_box *sub,
                                   bool is_operator, struct formula_style style)
{
    struct shifts s = shifts_find(m, &nucleus, sup, sub, style);
    struct formula_box box = nucleus;
    double width = 0;
    /* An integral's superscript stands where its glyph ends, the subscript nearer. */
    double over = nucleus.width + (is_operator ? 0 : nucleus.italic);
    double under = nucleus.width - (is_operator ? nucleus.italic : 0);
    if (sup) {
        formula_box_move(m, sup, over, -s.up);
        width = over + sup->width;
        box.height = fmax(box.height, s.up + sup->height);
        box.depth = fmax(box.depth, sup->depth - s.up);
    }
    if (sub) {
        formula_box_move(m, sub, under, s.down);
        width = fmax(width, under + sub->width);
        box.height = fmax(box.height, sub->height - s.down);
        box.depth = fmax(box.depth, s.down + sub->depth);
    }
    box.width = fmax(nucleus.width, width + C(SPACE_AFTER_SCRIPT));
    box.italic = 0;
    box.glyph = 0;
    box.letter = false;
    box.end = m->items_count;
    return box;
}

struct formula_box formula_limits(struct font_math *m, struct formula_box nucleus,
                                  struct formula_box *over, struct formula_box *under,
                                  struct formula_style style)
{
    struct formula_box box = nucleus;
    double width = fmax(nucleus.width, fmax(over ? over->width : 0, under ? under->width : 0));
    formula_box_move(m, &nucleus, (width - nucleus.width) / 2, 0);
    if (over) {
        double rise = nucleus.height + fmax(C(UPPER_LIMIT_GAP_MIN) + over->depth,
                                            C(UPPER_LIMIT_BASELINE_RISE_MIN));
        formula_box_move(m, over, (width - over->width + nucleus.italic) / 2, -rise);
        box.height = rise + over->height;
    }
    if (under) {
        double drop = nucleus.depth + fmax(C(LOWER_LIMIT_GAP_MIN) + under->height,
                                           C(LOWER_LIMIT_BASELINE_DROP_MIN));
        formula_box_move(m, under, (width - under->width - nucleus.italic) / 2, drop);
        box.depth = drop + under->depth;
    }
    box.width = width;
    box.italic = 0;
    box.glyph = 0;
    box.letter = false;
    box.end = m->items_count;
    return box;
}
