/* formula_commands.h - what TeX's commands do that are no symbols: rows of one table. */
#ifndef LUTETIA_FONT_FORMULA_COMMANDS_H
#define LUTETIA_FONT_FORMULA_COMMANDS_H

#include "formula_internal.h"

enum formula_act {
    /* number: 1 with a rule; style: of the fraction, -1 as it stands; character, other:
     * delimiters */
    FORMULA_ACT_FRACTION,
    FORMULA_ACT_RADICAL,
    FORMULA_ACT_ACCENT, /* character; stretched, under; braces take limits */
    FORMULA_ACT_BAR,
    FORMULA_ACT_ALPHABET, /* style: a FORMULA_ITALIC.. */
    FORMULA_ACT_SWITCH,   /* the same, of all that follows in the braces */
    FORMULA_ACT_BOXED,    /* style: 1 of words */
    FORMULA_ACT_TEXT,     /* style: 0, or 1 and an alphabet's letters */
    /* an operator's name; text: what is written, NULL: the command's own; stretched: with
     * limits */
    FORMULA_ACT_FUNCTION,
    FORMULA_ACT_OPERATOR, /* the same of an argument; a star: with limits */
    FORMULA_ACT_SPACE,    /* number: ems */
    FORMULA_ACT_SKIP,     /* of an argument */
    FORMULA_ACT_STYLE,    /* style */
    FORMULA_ACT_BIG,      /* number: ems; class */
    FORMULA_ACT_OVERSET,  /* under; class */
    FORMULA_ACT_ARROW,    /* character */
    FORMULA_ACT_PHANTOM,  /* style: its bits */
    FORMULA_ACT_NOT,
    FORMULA_ACT_CLASS,  /* class: of an argument */
    FORMULA_ACT_MODULO, /* style: 0 \bmod, 1 \pmod, 2 \mod */
    FORMULA_ACT_TAG,    /* words; number: ems before them; style: 1 in parentheses */
    FORMULA_ACT_UNSEEN, /* its argument is not seen */
    FORMULA_ACT_FENCE,
    FORMULA_ACT_BEGIN,
    FORMULA_ACT_SUBSTACK,
    FORMULA_ACT_NOTHING,
    FORMULA_ACT_OVER, /* between what is before and behind it: as FRACTION */
    FORMULA_ACT_STOP  /* ends a list: \right, \middle, \end, \\, \cr */
};

struct formula_command {
    const char *name;
    enum formula_act act;
    uint32_t character, other;
    double number;
    int style;
    enum formula_class class;
    bool stretched, under;
    const char *text;
};

/* NULL: there is none. */
const struct formula_command *formula_command_find(const char *name, size_t bytes);

#endif
