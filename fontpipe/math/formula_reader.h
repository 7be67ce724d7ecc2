/* formula_reader.h - what reads TeX's notation: the place where it is, nodes, and what is read
 * without looking into it. */
#ifndef LUTETIA_FONT_FORMULA_READER_H
#define LUTETIA_FONT_FORMULA_READER_H

#include "formula_internal.h"

/* What ends a list besides the text's end. */
enum {
    FORMULA_STOP_BRACE = 1,
    FORMULA_STOP_CELL = 2,
    FORMULA_STOP_RIGHT = 4,
    FORMULA_STOP_END = 8,
    FORMULA_STOP_BRACKET = 16
};

struct formula_reader {
    const char *begin, *at, *end;
    struct formula_nodes *nodes;
    struct formula_read *out;
    enum formula_alphabet alphabet;
    int depth;
    enum font_status status;
};

/* Never NULL: where there is no memory, one that is thrown away, and reading ends. */
struct formula_node *formula_node_make(struct formula_reader *r, enum formula_kind kind);
/* One nesting deeper. False: it is too deep. */
bool formula_enter(struct formula_reader *r);
void formula_blank_skip(struct formula_reader *r);
/* The command at a backslash: its name's bytes behind it; 0: the text ends there. */
size_t formula_command_length(const struct formula_reader *r);
bool formula_command_is(const struct formula_reader *r, const char *name);
/* Takes it if it is there. */
bool formula_command_take(struct formula_reader *r, const char *name);
bool formula_stands_at_stop(const struct formula_reader *r, int stops);
struct formula_node *formula_symbol_make(struct formula_reader *r, uint32_t character,
                                         enum formula_class class);
/* What stands at the place, as it is written, upright. */
struct formula_node *formula_words_make(struct formula_reader *r, const char *text,
                                        size_t bytes);
struct formula_node *formula_unknown_read(struct formula_reader *r, size_t bytes);
/* A character as it stands. */
struct formula_node *formula_character_read(struct formula_reader *r);
/* The bytes between braces, without looking at them. */
const char *formula_raw_read(struct formula_reader *r, size_t *bytes);
/* A length behind a command, with braces or without, in ems: of 10 points where it says points.
 * What is none, or beyond 100 ems, is 0. */
double formula_length_read(struct formula_reader *r);
/* A delimiter; 0: none. */
uint32_t formula_delimiter_read(struct formula_reader *r);

#endif
