/* formula_constants.c - numbers of the MATH table at a style's size: see formula_internal.h. */
#include "formula_internal.h"

double formula_size(const struct font_math *m, struct formula_style style)
{
    if (style.level < FORMULA_SCRIPT_STYLE)
        return m->size;
    hb_position_t percent = hb_ot_math_get_constant(
        m->hb, style.level == FORMULA_SCRIPT_STYLE
                   ? HB_OT_MATH_CONSTANT_SCRIPT_PERCENT_SCALE_DOWN
                   : HB_OT_MATH_CONSTANT_SCRIPT_SCRIPT_PERCENT_SCALE_DOWN);
    if (percent <= 0 || percent > 100) /* left out, or nonsense: as TeX's own fonts */
        percent = style.level == FORMULA_SCRIPT_STYLE ? 70 : 50;
    return m->size * percent / 100;
}

double formula_constant(const struct font_math *m, hb_ot_math_constant_t constant,
                        struct formula_style style)
{
    return hb_ot_math_get_constant(m->hb, constant) * formula_size(m, style) / m->upem;
}

double formula_axis(const struct font_math *m, struct formula_style style)
{
    return formula_constant(m, HB_OT_MATH_CONSTANT_AXIS_HEIGHT, style);
}
