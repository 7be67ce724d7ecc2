/* formula_stack.c - fractions, roots, accents, bars, fences, arrows: The TeXbook, appendix G,
 * rules 9 to 12, 15 and 19. */
#include "formula_internal.h"

#include <math.h>

#define C(name) formula_constant(m, HB_OT_MATH_CONSTANT_##name, style)

/* A box that begins where its first part does, and ends with the last item. */
static struct formula_box around(const struct font_math *m, int begin)
{
    return (struct formula_box){.begin = begin, .end = m->items_count};
}

static void cover(struct formula_box *box, const struct formula_box *part, double y)
{
    box->height = fmax(box->height, part->height - y);
    box->depth = fmax(box->depth, part->depth + y);
}

struct formula_box formula_fraction(struct font_math *m, struct formula_box over,
                                    struct formula_box under, bool rule,
                                    struct formula_style style, int byte)
{
    const bool display = style.level == FORMULA_DISPLAY;
    const double axis = formula_axis(m, style), thick = rule ? C(FRACTION_RULE_THICKNESS) : 0;
    double up, down, width = fmax(over.width, under.width);
    if (rule) {
        double above =
            display ? C(FRACTION_NUM_DISPLAY_STYLE_GAP_MIN) : C(FRACTION_NUMERATOR_GAP_MIN);
        double below =
            display ? C(FRACTION_DENOM_DISPLAY_STYLE_GAP_MIN) : C(FRACTION_DENOMINATOR_GAP_MIN);
        up = fmax(display ? C(FRACTION_NUMERATOR_DISPLAY_STYLE_SHIFT_UP)
                          : C(FRACTION_NUMERATOR_SHIFT_UP),
                  axis + thick / 2 + above + over.depth);
        down = fmax(display ? C(FRACTION_DENOMINATOR_DISPLAY_STYLE_SHIFT_DOWN)
                            : C(FRACTION_DENOMINATOR_SHIFT_DOWN),
                    under.height + below + thick / 2 - axis);
    } else {
        double gap = display ? C(STACK_DISPLAY_STYLE_GAP_MIN) : C(STACK_GAP_MIN);
        up = display ? C(STACK_TOP_DISPLAY_STYLE_SHIFT_UP) : C(STACK_TOP_SHIFT_UP);
        down = display ? C(STACK_BOTTOM_DISPLAY_STYLE_SHIFT_DOWN) : C(STACK_BOTTOM_SHIFT_DOWN);
        double short_of = gap - ((up - over.depth) - (under.height - down));
        up += fmax(0, short_of) / 2;
        down += fmax(0, short_of) / 2;
    }
    formula_box_move(m, &over, (width - over.width) / 2, -up);
    formula_box_move(m, &under, (width - under.width) / 2, down);
    formula_rule(m, 0, -axis - thick / 2, width, thick, byte);
    struct formula_box box = around(m, over.begin);
    box.height = -INFINITY;
    box.depth = -INFINITY;
    box.width = width;
    cover(&box, &over, -up);
    cover(&box, &under, down);
    return box;
}

struct formula_box formula_radical(struct font_math *m, struct formula_box in,
                                   struct formula_style style, int byte)
{
    const double thick = C(RADICAL_RULE_THICKNESS);
    double gap = style.level == FORMULA_DISPLAY ? C(RADICAL_DISPLAY_STYLE_VERTICAL_GAP)
                                                : C(RADICAL_VERTICAL_GAP);
    const double inside = fmax(0, in.height + in.depth);
    struct formula_box sign = formula_tall(m, 0x221a, inside + gap + thick, style, byte);
    double more = sign.height + sign.depth - thick - inside - gap;
    gap += fmax(0, more) / 2;
    double top = in.height + gap + thick;
    formula_box_move(m, &in, sign.width, 0);
    formula_box_move(m, &sign, 0, sign.height - top);
    formula_rule(m, sign.width, -top, in.width, thick, byte);
    struct formula_box box = around(m, in.begin);
    box.width = sign.width + in.width;
    box.height = top + C(RADICAL_EXTRA_ASCENDER);
    box.depth = fmax(in.depth, sign.depth + sign.height - top);
    return box;
}

struct formula_box formula_degree(struct font_math *m, struct formula_box radical,
                                  struct formula_box degree, struct formula_style style)
{
    double percent =
        hb_ot_math_get_constant(m->hb, HB_OT_MATH_CONSTANT_RADICAL_DEGREE_BOTTOM_RAISE_PERCENT);
    double before = C(RADICAL_KERN_BEFORE_DEGREE), after = C(RADICAL_KERN_AFTER_DEGREE);
    double up = percent / 100 * (radical.height + radical.depth) - radical.depth + degree.depth;
    /* The sign does not reach out to the left of the whole. */
    double left = fmax(0, before + degree.width + after);
    formula_box_move(m, &degree, fmax(before, -degree.width - after), -up);
    formula_box_move(m, &radical, left, 0);
    struct formula_box box = around(m, radical.begin);
    box.width = left + radical.width;
    box.height = fmax(radical.height, up + degree.height);
    box.depth = radical.depth;
    return box;
}

/* Where an accent's middle goes over a box, or over itself. */
static double attachment(const struct font_math *m, const struct formula_box *box, double size)
{
    if (!box->glyph)
        return box->width / 2;
    return hb_ot_math_get_glyph_top_accent_attachment(m->hb, box->glyph) * size / m->upem;
}

struct formula_box formula_accent(struct font_math *m, struct formula_box in,
                                  const struct formula_node *node, struct formula_style style)
{
    const double size = formula_size(m, style);
    struct formula_box accent =
        node->stretched
            ? formula_wide(m, node->character, in.width, true, style, node->byte)
            : formula_glyph_box(m, formula_glyph(m, node->character, style), size, node->byte);
    double up = fmax(0, in.height - C(ACCENT_BASE_HEIGHT));
    formula_box_move(m, &accent, attachment(m, &in, size) - attachment(m, &accent, size), -up);
    struct formula_box box = around(m, in.begin);
    box.width = in.width;
    box.italic = in.italic;
    box.height = fmax(in.height, accent.height + up);
    box.depth = in.depth;
    return box;
}

struct formula_box formula_bar(struct font_math *m, struct formula_box in, bool under,
                               struct formula_style style, int byte)
{
    double thick = under ? C(UNDERBAR_RULE_THICKNESS) : C(OVERBAR_RULE_THICKNESS);
    double gap = under ? C(UNDERBAR_VERTICAL_GAP) : C(OVERBAR_VERTICAL_GAP);
    double y = under ? in.depth + gap : -in.height - gap - thick;
    formula_rule(m, 0, y, in.width, thick, byte);
    struct formula_box box = around(m, in.begin);
    box.width = in.width;
    box.height = in.height;
    box.depth = in.depth;
    if (under)
        box.depth += gap + thick + C(UNDERBAR_EXTRA_DESCENDER);
    else
        box.height += gap + thick + C(OVERBAR_EXTRA_ASCENDER);
    return box;
}

struct formula_box formula_boxed(struct font_math *m, struct formula_box in,
                                 struct formula_style style, int byte)
{
    /* LaTeX's \fboxsep and \fboxrule at ten points. */
    const double size = formula_size(m, style), gap = 0.3 * size, thick = 0.04 * size,
                 edge = gap + thick, width = in.width + 2 * edge,
                 height = in.height + in.depth + 2 * edge;
    formula_box_move(m, &in, edge, 0);
    formula_rule(m, 0, -in.height - edge, width, thick, byte);
    formula_rule(m, 0, in.depth + gap, width, thick, byte);
    formula_rule(m, 0, -in.height - edge, thick, height, byte);
    formula_rule(m, width - thick, -in.height - edge, thick, height, byte);
    struct formula_box box = around(m, in.begin);
    box.width = width;
    box.height = in.height + edge;
    box.depth = in.depth + edge;
    return box;
}

struct formula_box formula_fenced(struct font_math *m, struct formula_box in, uint32_t left,
                                  uint32_t right, struct formula_style style, int byte)
{
    struct formula_box l = formula_fence(m, left, in.height, in.depth, style, byte);
    struct formula_box r = formula_fence(m, right, in.height, in.depth, style, byte);
    formula_box_move(m, &in, l.width, 0);
    formula_box_move(m, &r, l.width + in.width, 0);
    struct formula_box box = around(m, in.begin);
    box.width = l.width + in.width + r.width;
    box.height = in.height;
    box.depth = in.depth;
    cover(&box, &l, 0);
    cover(&box, &r, 0);
    return box;
}

struct formula_box formula_brace(struct font_math *m, struct formula_box in, uint32_t character,
                                 bool under, struct formula_style style, int byte)
{
    struct formula_box sign = formula_wide(m, character, in.width, false, style, byte);
    double gap = under ? C(STRETCH_STACK_GAP_BELOW_MIN) : C(STRETCH_STACK_GAP_ABOVE_MIN);
    double width = fmax(in.width, sign.width);
    /* The sign's ink, wherever its font has it, stands at the gap. */
    double y = under ? in.depth + gap + sign.height : -(in.height + gap + sign.depth);
    formula_box_move(m, &in, (width - in.width) / 2, 0);
    formula_box_move(m, &sign, (width - sign.width) / 2, y);
    struct formula_box box = around(m, in.begin);
    box.width = width;
    box.height = in.height;
    box.depth = in.depth;
    cover(&box, &sign, y);
    return box;
}

struct formula_box formula_arrow(struct font_math *m, uint32_t character,
                                 struct formula_box *over, struct formula_box *under,
                                 struct formula_style style, int byte)
{
    const double pad =
        0.55 * formula_size(m, style); /* beyond what stands over it, on both sides */
    double text = fmax(over ? over->width : 0, under ? under->width : 0);
    struct formula_box sign = formula_wide(m, character, text + 2 * pad, false, style, byte);
    double width = fmax(text, sign.width);
    formula_box_move(m, &sign, (width - sign.width) / 2, 0);
    struct formula_box box = around(m, over ? over->begin : under ? under->begin : sign.begin);
    box.width = width;
    box.height = sign.height;
    box.depth = fmax(0, sign.depth);
    if (over) {
        double up = sign.height + C(STRETCH_STACK_GAP_ABOVE_MIN) + over->depth;
        formula_box_move(m, over, (width - over->width) / 2, -up);
        cover(&box, over, -up);
    }
    if (under) {
        double down = sign.depth + C(STRETCH_STACK_GAP_BELOW_MIN) + under->height;
        formula_box_move(m, under, (width - under->width) / 2, down);
        cover(&box, under, down);
    }
    return box;
}
