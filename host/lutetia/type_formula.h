/* type_formula.h - formulas in TeX's notation, for verbs. */
#ifndef LUTETIA_TYPE_FORMULA_H
#define LUTETIA_TYPE_FORMULA_H

#include <font_math.h>

#include <stdbool.h>

/* Sets a formula; says which commands are shown as they are written. EXIT_SUCCESS, or prints
 * why not. The caller destroys *math, after it has finished *layout. */
int type_formula_layout(const char *verb, struct font_face *face, const char *tex,
                        double size_px, bool display, struct font_math **math,
                        struct font_layout *layout);

#endif
