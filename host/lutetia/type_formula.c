/* type_formula.c - see type_formula.h. */
#include "type_formula.h"

#include "lutetia.h"
#include "type_common.h"

#include <stdlib.h>
#include <string.h>

int type_formula_layout(const char *verb, struct font_face *face, const char *tex,
                        double size_px, bool display, struct font_math **math,
                        struct font_layout *layout)
{
    const struct font_math_options options = {.size_px = size_px, .display = display};
    int unknown = 0;
    if (font_math_create(face, math) != FONT_OK ||
        font_math_layout(*math, tex, strlen(tex), &options, layout) != FONT_OK)
        return fail_font(verb);
    const char *first = font_math_unknown(*math, &unknown);
    if (unknown == 1)
        tell(verb,
             "'%s' is no command of mathematics that is known: it stands as it is written",
             first);
    else if (unknown)
        tell(verb,
             "'%s' and %d more are no commands of mathematics that are known: they stand as "
             "they "
             "are written",
             first, unknown - 1);
    return EXIT_SUCCESS;
}
