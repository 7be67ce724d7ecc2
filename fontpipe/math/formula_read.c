/* formula_read.c - TeX's notation as nodes. What is wrong in it, as a brace that is not closed,
 * ends where it must; nothing is refused but for its size. */
#include "formula_commands.h"
#include "formula_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct formula_node *list_read(struct formula_reader *r, int stops);
static struct formula_node *argument_read(struct formula_reader *r);
static struct formula_node *atom_read(struct formula_reader *r);

/* ---- arguments ---- */

static struct formula_node *braced_read(struct formula_reader *r)
{
    struct formula_node *list = NULL;
    r->at++;
    if (formula_enter(r))
        list = list_read(r, FORMULA_STOP_BRACE);
    r->depth--;
    if (r->at < r->end)
        r->at++;
    return list;
}

/* A group's nodes, or one command or character. NULL: there is nothing. */
static struct formula_node *argument_read(struct formula_reader *r)
{
    struct formula_node *node = NULL;
    formula_blank_skip(r);
    if (r->at == r->end || formula_stands_at_stop(r, FORMULA_STOP_BRACE | FORMULA_STOP_CELL |
                                                         FORMULA_STOP_RIGHT | FORMULA_STOP_END))
        return NULL;
    if (*r->at == '{')
        return braced_read(r);
    if (*r->at == '^' || *r->at == '_')
        return NULL;
    if (formula_enter(r))
        node = atom_read(r);
    r->depth--;
    return node;
}

/* [..]. NULL: there is none. */
static struct formula_node *option_read(struct formula_reader *r)
{
    struct formula_node *list = NULL;
    formula_blank_skip(r);
    if (r->at == r->end || *r->at != '[')
        return NULL;
    r->at++;
    if (formula_enter(r))
        list = list_read(r, FORMULA_STOP_BRACKET | FORMULA_STOP_BRACE);
    r->depth--;
    if (r->at < r->end && *r->at == ']')
        r->at++;
    return list;
}

/* Words between braces as they are; \% and the like are the signs. style: of WORDS. */
static struct formula_node *text_read(struct formula_reader *r, int style)
{
    size_t bytes;
    struct formula_node *group = formula_node_make(r, FORMULA_GROUP), **last = &group->a;
    const char *text = formula_raw_read(r, &bytes), *from = text, *end = text + bytes;
    for (const char *at = text; at <= end; at++) {
        bool escape = at < end && *at == '\\' && at + 1 < end && strchr("%$#&_{} ", at[1]);
        if (at < end && !escape)
            continue;
        if (at > from) {
            struct formula_node *words = formula_words_make(r, from, (size_t)(at - from));
            words->byte = (int)(from - r->begin);
            words->style = style;
            *last = words;
            last = &words->next;
        }
        from = at + 1;
        at += escape;
    }
    return group;
}

/* ---- commands ---- */

/* What stands between \left and \right: pieces, each with the delimiter behind it. */
static struct formula_node *fenced_read(struct formula_reader *r)
{
    struct formula_node *node = formula_node_make(r, FORMULA_FENCED), **last = &node->a;
    node->class = FORMULA_INNER;
    node->character = formula_delimiter_read(r);
    if (!formula_enter(r)) {
        r->depth--;
        return node;
    }
    for (bool more = true; more;) {
        struct formula_node *piece = formula_node_make(r, FORMULA_ROW);
        piece->a = list_read(r, FORMULA_STOP_RIGHT | FORMULA_STOP_BRACE | FORMULA_STOP_END |
                                    FORMULA_STOP_CELL);
        *last = piece;
        last = &piece->next;
        more = formula_command_take(r, "middle");
        if (more)
            piece->character = formula_delimiter_read(r);
        else if (formula_command_take(r, "right"))
            node->other = formula_delimiter_read(r);
    }
    r->depth--;
    return node;
}

/* Rows of cells up to what ends them. */
static struct formula_node *rows_read(struct formula_reader *r, int stops)
{
    struct formula_node *first = NULL, **last_row = &first;
    for (bool more_rows = true; more_rows;) {
        struct formula_node *row = formula_node_make(r, FORMULA_ROW), **last = &row->a;
        for (bool more = true; more;) {
            struct formula_node *cell = formula_node_make(r, FORMULA_ROW);
            cell->a = list_read(r, FORMULA_STOP_CELL | stops);
            *last = cell;
            last = &cell->next;
            more = r->at < r->end && *r->at == '&';
            r->at += more;
        }
        *last_row = row;
        last_row = &row->next;
        more_rows = formula_command_take(r, "\\") || formula_command_take(r, "cr");
        if (more_rows && r->at < r->end && *r->at == '[')
            option_read(r); /* a distance */
        formula_blank_skip(r);
        if (r->at == r->end || formula_stands_at_stop(r, stops))
            more_rows = false; /* what is behind the last \\ is no row */
    }
    return first;
}

static struct formula_node *environment_read(struct formula_reader *r)
{
    const char *begin = r->at;
    size_t bytes;
    const char *name = formula_raw_read(r, &bytes);
    const struct formula_table *table = formula_table_find(name, bytes);
    struct formula_node *node;
    if (!table) {
        r->at = begin - 6;
        return formula_unknown_read(r, 5);
    }
    node = formula_node_make(r, FORMULA_ARRAY);
    node->table = table;
    node->class = table->left || table->right ? FORMULA_INNER : FORMULA_ORD;
    if (r->end - r->at > 2 && r->at[0] == '[' && strchr("tcb", r->at[1]) && r->at[2] == ']')
        r->at += 3; /* which line is the formula's: it is the middle */
    if (table->argument) {
        const char *argument = formula_raw_read(r, &bytes);
        node->text = table->argument == 'c' ? argument : NULL;
        node->text_bytes = table->argument == 'c' ? (int)bytes : 0;
    }
    if (formula_enter(r))
        node->a = rows_read(r, FORMULA_STOP_END | FORMULA_STOP_BRACE);
    r->depth--;
    if (formula_command_take(r, "end"))
        formula_raw_read(r, &bytes);
    return node;
}

static struct formula_node *fraction_make(struct formula_reader *r,
                                          const struct formula_command *c)
{
    struct formula_node *node = formula_node_make(r, FORMULA_FRACTION);
    node->class = FORMULA_INNER;
    node->number = c->number;
    node->style = c->act == FORMULA_ACT_OVER ? -1 : c->style;
    node->character = c->character;
    node->other = c->other;
    return node;
}

/* mod in parentheses, or as an operator. */
static struct formula_node *modulo_read(struct formula_reader *r, int how)
{
    struct formula_node *group = formula_node_make(r, FORMULA_GROUP), **last = &group->a;
    struct formula_node *word = formula_words_make(r, "mod", 3);
    if (how == 0) {
        word->class = FORMULA_BIN;
        return word;
    }
    for (int i = 0; i < 5; i++) {
        bool paren = how == 1;
        struct formula_node *one =
            i == 0   ? formula_node_make(r, FORMULA_SPACE)
            : i == 1 ? (paren ? formula_symbol_make(r, '(', FORMULA_OPEN) : NULL)
            : i == 2 ? word
            : i == 3 ? formula_node_make(r, FORMULA_SPACE)
                     : NULL;
        if (i == 4) {
            one = formula_node_make(r, FORMULA_GROUP);
            one->a = argument_read(r);
        }
        if (!one)
            continue;
        if (one->kind == FORMULA_SPACE)
            one->number = i == 0 ? 1 : 1 / 3.0;
        *last = one;
        last = &one->next;
    }
    if (how == 1)
        *last = formula_symbol_make(r, ')', FORMULA_CLOSE);
    return group;
}

/* An equation's number, behind it; with a star without parentheses. */
static struct formula_node *tag_read(struct formula_reader *r, const struct formula_command *c)
{
    struct formula_node *group = formula_node_make(r, FORMULA_GROUP);
    struct formula_node *gap = formula_node_make(r, FORMULA_SPACE);
    const bool star = r->at < r->end && *r->at == '*';
    r->at += star;
    struct formula_node *words = text_read(r, 0);
    gap->number = c->number;
    group->a = gap;
    gap->next = words;
    if (!star && c->style) {
        gap->next = formula_symbol_make(r, '(', FORMULA_OPEN);
        gap->next->next = words;
        words->next = formula_symbol_make(r, ')', FORMULA_CLOSE);
    }
    return group;
}

static struct formula_node *boxed_read(struct formula_reader *r, bool words)
{
    struct formula_node *node = formula_node_make(r, FORMULA_BOXED);
    node->a = words ? text_read(r, 0) : argument_read(r);
    return node;
}

static struct formula_node *skip_read(struct formula_reader *r)
{
    struct formula_node *node = formula_node_make(r, FORMULA_SPACE);
    node->number = formula_length_read(r);
    return node;
}

static struct formula_node *alphabet_read(struct formula_reader *r,
                                          const struct formula_command *c)
{
    enum formula_alphabet before = r->alphabet;
    struct formula_node *node = formula_node_make(r, FORMULA_GROUP);
    r->alphabet = (enum formula_alphabet)c->style;
    node->a = argument_read(r);
    r->alphabet = before;
    return node;
}

static struct formula_node *operator_read(struct formula_reader *r,
                                          const struct formula_command *c)
{
    struct formula_node *node;
    bool limits = c->stretched;
    if (c->act == FORMULA_ACT_OPERATOR) {
        limits = r->at < r->end && *r->at == '*';
        r->at += limits;
        node = formula_node_make(r, FORMULA_GROUP);
        enum formula_alphabet before = r->alphabet;
        r->alphabet = FORMULA_UPRIGHT;
        node->a = argument_read(r);
        r->alphabet = before;
    } else {
        const char *text = c->text ? c->text : c->name;
        node = formula_words_make(r, text, strlen(text));
    }
    node->class = FORMULA_OP;
    node->limits = limits ? FORMULA_LIMITS_USUAL : FORMULA_LIMITS_NONE;
    return node;
}

static struct formula_node *overset_read(struct formula_reader *r,
                                         const struct formula_command *c)
{
    struct formula_node *node = formula_node_make(r, FORMULA_OVERSET);
    node->under = c->under;
    node->b = argument_read(r);
    node->a = argument_read(r);
    node->class = c->class != FORMULA_CLASSES ? c->class
                  : node->a && !node->a->next ? node->a->class
                                              : FORMULA_ORD;
    return node;
}

static struct formula_node *arrow_read(struct formula_reader *r,
                                       const struct formula_command *c)
{
    struct formula_node *node = formula_node_make(r, FORMULA_ARROW);
    node->class = FORMULA_REL;
    node->character = c->character;
    node->a = option_read(r);
    node->b = argument_read(r);
    return node;
}

/* A slash through the next character. */
static struct formula_node *not_read(struct formula_reader *r)
{
    struct formula_node *of = argument_read(r);
    uint32_t struck = of && of->kind == FORMULA_SYMBOL ? formula_struck(of->character) : 0;
    if (struck) {
        of->character = struck;
        return of;
    }
    struct formula_node *node = formula_node_make(r, FORMULA_STRIKE);
    node->a = of;
    node->class = of ? of->class : FORMULA_ORD;
    return node;
}

/* Commands that make one node out of their arguments. */
static struct formula_node *simple_read(struct formula_reader *r,
                                        const struct formula_command *c)
{
    static const enum formula_kind kinds[] = {
        [FORMULA_ACT_RADICAL] = FORMULA_RADICAL, [FORMULA_ACT_ACCENT] = FORMULA_ACCENT,
        [FORMULA_ACT_BAR] = FORMULA_BAR,         [FORMULA_ACT_SPACE] = FORMULA_SPACE,
        [FORMULA_ACT_STYLE] = FORMULA_STYLE,     [FORMULA_ACT_BIG] = FORMULA_BIG,
        [FORMULA_ACT_PHANTOM] = FORMULA_PHANTOM, [FORMULA_ACT_CLASS] = FORMULA_GROUP};
    struct formula_node *node = formula_node_make(r, kinds[c->act]);
    bool brace = c->act == FORMULA_ACT_ACCENT && c->character >= 0x23b4 && c->stretched &&
                 c->character < 0x2400;
    node->class = brace ? FORMULA_OP : c->class;
    node->limits = brace ? FORMULA_LIMITS_ALWAYS : FORMULA_LIMITS_USUAL;
    node->character = c->character;
    node->number = c->act == FORMULA_ACT_PHANTOM ? c->style : c->number;
    node->style = c->style;
    node->stretched = c->stretched;
    node->under = c->under;
    if (c->act == FORMULA_ACT_BIG)
        node->character = formula_delimiter_read(r);
    if (c->act == FORMULA_ACT_RADICAL)
        node->b = option_read(r);
    if (node->kind != FORMULA_SPACE && node->kind != FORMULA_STYLE && node->kind != FORMULA_BIG)
        node->a = argument_read(r);
    return node;
}

static struct formula_node *substack_read(struct formula_reader *r)
{
    struct formula_node *node = formula_node_make(r, FORMULA_ARRAY);
    node->table = formula_table_find("substack", 8);
    formula_blank_skip(r);
    if (r->at == r->end || *r->at != '{')
        return node;
    r->at++;
    if (formula_enter(r))
        node->a = rows_read(r, FORMULA_STOP_BRACE);
    r->depth--;
    if (r->at < r->end)
        r->at++;
    return node;
}

static struct formula_node *command_read(struct formula_reader *r, size_t length)
{
    const struct formula_command *c = formula_command_find(r->at + 1, length);
    struct formula_node *node = NULL;
    if (!c || c->act == FORMULA_ACT_STOP || c->act == FORMULA_ACT_OVER)
        return formula_unknown_read(r, length); /* what stops a list that is not there */
    r->at += 1 + length;
    switch (c->act) {
    case FORMULA_ACT_FRACTION:
        node = fraction_make(r, c);
        node->a = argument_read(r);
        node->b = argument_read(r);
        return node;
    case FORMULA_ACT_ALPHABET:
        return alphabet_read(r, c);
    case FORMULA_ACT_TEXT:
        return text_read(r, c->style);
    case FORMULA_ACT_FUNCTION:
    case FORMULA_ACT_OPERATOR:
        return operator_read(r, c);
    case FORMULA_ACT_OVERSET:
        return overset_read(r, c);
    case FORMULA_ACT_ARROW:
        return arrow_read(r, c);
    case FORMULA_ACT_NOT:
        return not_read(r);
    case FORMULA_ACT_MODULO:
        return modulo_read(r, c->style);
    case FORMULA_ACT_TAG:
        return tag_read(r, c);
    case FORMULA_ACT_BOXED:
        return boxed_read(r, c->style);
    case FORMULA_ACT_SKIP:
        return skip_read(r);
    case FORMULA_ACT_SWITCH:
        r->alphabet = (enum formula_alphabet)c->style;
        break;
    case FORMULA_ACT_UNSEEN:
        formula_raw_read(r, &(size_t){0});
        break;
    case FORMULA_ACT_FENCE:
        return fenced_read(r);
    case FORMULA_ACT_BEGIN:
        return environment_read(r);
    case FORMULA_ACT_SUBSTACK:
        return substack_read(r);
    case FORMULA_ACT_NOTHING:
        return formula_node_make(r, FORMULA_GROUP);
    case FORMULA_ACT_RADICAL:
    case FORMULA_ACT_ACCENT:
    case FORMULA_ACT_BAR:
    case FORMULA_ACT_SPACE:
    case FORMULA_ACT_STYLE:
    case FORMULA_ACT_BIG:
    case FORMULA_ACT_PHANTOM:
    case FORMULA_ACT_CLASS:
        return simple_read(r, c);
    case FORMULA_ACT_OVER:
    case FORMULA_ACT_STOP:
        break;
    }
    return formula_node_make(r, FORMULA_GROUP);
}

/* ---- lists ---- */

/* A nucleus, without scripts. */
static struct formula_node *atom_read(struct formula_reader *r)
{
    if (*r->at == '{') {
        struct formula_node *group = formula_node_make(r, FORMULA_GROUP);
        group->a = braced_read(r);
        return group;
    }
    if (*r->at != '\\')
        return formula_character_read(r);
    int byte = (int)(r->at - r->begin);
    size_t length = formula_command_length(r);
    const struct formula_symbol *symbol = formula_symbol_find(r->at + 1, length);
    struct formula_node *node;
    if (length && symbol) {
        node = formula_symbol_make(r, symbol->character, symbol->class);
        node->limits = symbol->limits;
        node->big = symbol->class == FORMULA_OP;
        r->at += 1 + length;
    } else {
        node = length ? command_read(r, length) : formula_unknown_read(r, 0);
    }
    node->byte = byte;
    return node;
}

/* '' and what is raised behind it. */
static void primes_read(struct formula_reader *r, struct formula_node *node)
{
    struct formula_node **last = &node->sup;
    while (r->at < r->end && *r->at == '\'') {
        *last = formula_symbol_make(r, 0x2032, FORMULA_ORD);
        last = &(*last)->next;
        r->at++;
    }
    if (r->at < r->end && *r->at == '^') {
        r->at++;
        *last = argument_read(r);
    }
}

static void scripts_read(struct formula_reader *r, struct formula_node *node)
{
    for (;;) {
        formula_blank_skip(r);
        if (r->at == r->end)
            return;
        if (*r->at == '\'' && !node->sup) {
            primes_read(r, node);
        } else if ((*r->at == '^' && !node->sup) || (*r->at == '_' && !node->sub)) {
            struct formula_node **to = *r->at++ == '^' ? &node->sup : &node->sub;
            *to = argument_read(r);
            if (!*to)
                *to = formula_node_make(r, FORMULA_GROUP);
        } else if (formula_command_take(r, "limits")) {
            node->limits = FORMULA_LIMITS_ALWAYS;
        } else if (formula_command_take(r, "nolimits")) {
            node->limits = FORMULA_LIMITS_NONE;
        } else if (formula_command_take(r, "displaylimits")) {
            node->limits = FORMULA_LIMITS_USUAL;
        } else {
            return;
        }
    }
}

static struct formula_node *list_read(struct formula_reader *r, int stops)
{
    struct formula_node *first = NULL, **last = &first, *over = NULL;
    const enum formula_alphabet before = r->alphabet;
    for (;;) {
        formula_blank_skip(r);
        if (r->at == r->end || formula_stands_at_stop(r, stops))
            break;
        const struct formula_command *c =
            *r->at == '\\' ? formula_command_find(r->at + 1, formula_command_length(r)) : NULL;
        if (c && c->act == FORMULA_ACT_OVER && !over) {
            over = fraction_make(r, c);
            over->a = first;
            first = NULL;
            last = &first;
            r->at += 1 + strlen(c->name);
            continue;
        }
        struct formula_node *node = *r->at == '^' || *r->at == '_' || *r->at == '\''
                                        ? formula_node_make(r, FORMULA_GROUP)
                                        : atom_read(r);
        if (node->kind != FORMULA_SPACE && node->kind != FORMULA_STYLE)
            scripts_read(r, node);
        if (r->status != FONT_OK)
            break;
        *last = node;
        last = &node->next;
    }
    r->alphabet = before;
    if (!over)
        return first;
    over->b = first;
    return over;
}

enum font_status formula_read(const char *tex, size_t bytes, struct formula_nodes *nodes,
                              struct formula_read *out)
{
    *out = (struct formula_read){0};
    if (bytes > FORMULA_BYTES_MAX)
        return font_fail(FONT_TOO_LARGE, "a formula has up to %d bytes (this one has %zu)",
                         FORMULA_BYTES_MAX, bytes);
    struct formula_reader r = {tex, tex, tex + bytes, nodes, out, FORMULA_ITALIC, 0, FONT_OK};
    struct formula_node *rows = rows_read(&r, 0);
    if (r.status != FONT_OK)
        return r.status;
    out->first = rows->a->a;
    if (rows->next ||
        rows->a->next) { /* lines, or columns, without an environment around them */
        const char *name = rows->a->next ? "aligned" : "gathered";
        struct formula_node *array = formula_node_make(&r, FORMULA_ARRAY);
        array->table = formula_table_find(name, strlen(name));
        array->a = rows;
        out->first = array;
    }
    return r.status;
}
