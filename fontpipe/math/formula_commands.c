/* formula_commands.c - see formula_commands.h. */
#include "formula_commands.h"

#include <string.h>

static const struct formula_command commands[] = {
#define COMMAND(...) {__VA_ARGS__},
#define FRACTION(name_, rule, style_, left, right)                                             \
    COMMAND(.name = name_, .act = FORMULA_ACT_FRACTION, .number = rule, .style = style_,       \
            .character = left, .other = right)
#define OVER(name_, rule, left, right)                                                         \
    COMMAND(.name = name_, .act = FORMULA_ACT_OVER, .number = rule, .character = left,         \
            .other = right)
#define ACCENT(name_, character_, stretched_, under_)                                          \
    COMMAND(.name = name_, .act = FORMULA_ACT_ACCENT, .character = character_,                 \
            .stretched = stretched_, .under = under_)
#define ALPHABET(name_, which)                                                                 \
    COMMAND(.name = name_, .act = FORMULA_ACT_ALPHABET, .style = which)
#define SWITCH(name_, which) COMMAND(.name = name_, .act = FORMULA_ACT_SWITCH, .style = which)
#define TEXT(name_, which) COMMAND(.name = name_, .act = FORMULA_ACT_TEXT, .style = which)
#define FUNCTION(name_, limits, text_)                                                         \
    COMMAND(.name = name_, .act = FORMULA_ACT_FUNCTION, .stretched = limits, .text = text_)
#define SPACE(name_, ems) COMMAND(.name = name_, .act = FORMULA_ACT_SPACE, .number = ems)
#define STYLE(name_, which) COMMAND(.name = name_, .act = FORMULA_ACT_STYLE, .style = which)
#define BIG_OF(name_, ems, class_)                                                             \
    COMMAND(.name = name_, .act = FORMULA_ACT_BIG, .number = ems, .class = class_)
#define BIG(name_, ems)                                                                        \
    BIG_OF(name_, ems, FORMULA_ORD)                                                            \
    BIG_OF(name_ "l", ems, FORMULA_OPEN)                                                       \
    BIG_OF(name_ "r", ems, FORMULA_CLOSE)                                                      \
    BIG_OF(name_ "m", ems, FORMULA_REL)
#define CLASS(name_, which) COMMAND(.name = name_, .act = FORMULA_ACT_CLASS, .class = which)
#define NOTHING(name_) COMMAND(.name = name_, .act = FORMULA_ACT_NOTHING)
#define STOP(name_) COMMAND(.name = name_, .act = FORMULA_ACT_STOP)
#include "commands.tab"
};

const struct formula_command *formula_command_find(const char *name, size_t bytes)
{
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (strlen(commands[i].name) == bytes && memcmp(commands[i].name, name, bytes) == 0)
            return &commands[i];
    return NULL;
}
