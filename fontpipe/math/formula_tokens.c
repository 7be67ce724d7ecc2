/* formula_tokens.c - see formula_reader.h. */
#include "formula_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void formula_nodes_finish(struct formula_nodes *n)
{
    for (int i = 0; i < n->blocks_count; i++)
        free(n->blocks[i]);
    free(n->blocks);
    *n = (struct formula_nodes){0};
}

struct formula_node *formula_node_make(struct formula_reader *r, enum formula_kind kind)
{
    static _Thread_local struct formula_node thrown_away;
    struct formula_nodes *n = r->nodes;
    struct formula_node *node = &thrown_away;
    if (r->status == FONT_OK && (n->blocks_count == 0 || n->used == FORMULA_BLOCK)) {
        struct formula_node *block = calloc(FORMULA_BLOCK, sizeof *block);
        if (block && array_reserve(&n->blocks, &n->blocks_capacity, n->blocks_count + 1,
                                   sizeof *n->blocks)) {
            n->blocks[n->blocks_count++] = block;
            n->used = 0;
        } else {
            free(block);
            r->status = font_fail(FONT_NO_MEMORY, "no memory for a formula");
            r->at = r->end;
        }
    }
    if (r->status == FONT_OK)
        node = &n->blocks[n->blocks_count - 1][n->used++];
    *node = (struct formula_node){
        .kind = kind, .alphabet = r->alphabet, .byte = (int)(r->at - r->begin)};
    return node;
}

bool formula_enter(struct formula_reader *r)
{
    if (++r->depth <= FORMULA_DEPTH_MAX)
        return true;
    if (r->status == FONT_OK)
        r->status =
            font_fail(FONT_TOO_LARGE, "a formula is nested deeper than %d", FORMULA_DEPTH_MAX);
    r->at = r->end;
    return false;
}

void formula_blank_skip(struct formula_reader *r)
{
    while (r->at < r->end) {
        if (strchr(" \t\r\n", *r->at) && *r->at) {
            r->at++;
        } else if (*r->at == '%') {
            while (r->at < r->end && *r->at != '\n')
                r->at++;
        } else {
            return;
        }
    }
}

size_t formula_command_length(const struct formula_reader *r)
{
    const char *at = r->at + 1;
    while (at < r->end && ((*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z')))
        at++;
    if (at == r->at + 1 && at < r->end) {
        uint32_t character;
        font_utf8_next(&at, r->end, &character);
    }
    return (size_t)(at - r->at - 1);
}

bool formula_command_is(const struct formula_reader *r, const char *name)
{
    size_t n = strlen(name);
    return r->at < r->end && *r->at == '\\' && formula_command_length(r) == n &&
           memcmp(r->at + 1, name, n) == 0;
}

bool formula_command_take(struct formula_reader *r, const char *name)
{
    formula_blank_skip(r);
    if (!formula_command_is(r, name))
        return false;
    r->at += 1 + strlen(name);
    return true;
}

bool formula_stands_at_stop(const struct formula_reader *r, int stops)
{
    char c = *r->at;
    return (c == '}' && stops & FORMULA_STOP_BRACE) ||
           (c == ']' && stops & FORMULA_STOP_BRACKET) ||
           (c == '&' && stops & FORMULA_STOP_CELL) ||
           (stops & FORMULA_STOP_CELL &&
            (formula_command_is(r, "\\") || formula_command_is(r, "cr"))) ||
           (stops & FORMULA_STOP_RIGHT &&
            (formula_command_is(r, "right") || formula_command_is(r, "middle"))) ||
           (stops & FORMULA_STOP_END && formula_command_is(r, "end"));
}

struct formula_node *formula_symbol_make(struct formula_reader *r, uint32_t character,
                                         enum formula_class class)
{
    struct formula_node *node = formula_node_make(r, FORMULA_SYMBOL);
    node->character = character;
    node->class = class;
    return node;
}

struct formula_node *formula_words_make(struct formula_reader *r, const char *text,
                                        size_t bytes)
{
    struct formula_node *node = formula_node_make(r, FORMULA_WORDS);
    node->text = text;
    node->text_bytes = (int)bytes;
    node->is_source = text >= r->begin && text < r->end;
    return node;
}

struct formula_node *formula_unknown_read(struct formula_reader *r, size_t bytes)
{
    struct formula_node *node = formula_words_make(r, r->at, bytes + 1);
    if (!r->out->unknown_count++)
        snprintf(r->out->unknown, sizeof r->out->unknown, "%.*s", (int)bytes + 1, r->at);
    r->at += bytes + 1;
    return node;
}

struct formula_node *formula_character_read(struct formula_reader *r)
{
    static const uint32_t others[][2] = {
        {'-', 0x2212}, {'*', 0x2217}, {'~', ' '}, {'`', 0x2018}};
    const char *at = r->at;
    uint32_t c;
    font_utf8_next(&at, r->end, &c);
    struct formula_node *node = formula_symbol_make(r, c, formula_class_of(c));
    if (node->class == FORMULA_OP) {
        const struct formula_symbol *sum = formula_symbol_find("sum", 3);
        node->big = true;
        node->limits = c >= 0x222b && c <= 0x2230 ? FORMULA_LIMITS_NONE : sum->limits;
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i][0] == c)
            node->character = others[i][1];
    if (c == '~') {
        node->kind = FORMULA_SPACE;
        node->number = 1 / 3.0;
    }
    r->at = at;
    return node;
}

const char *formula_raw_read(struct formula_reader *r, size_t *bytes)
{
    formula_blank_skip(r);
    *bytes = 0;
    if (r->at == r->end || *r->at != '{')
        return r->at;
    const char *begin = ++r->at;
    int open = 1;
    for (; r->at < r->end; r->at++) {
        if (*r->at == '\\' && r->at + 1 < r->end) {
            r->at++;
            continue;
        }
        open += (*r->at == '{') - (*r->at == '}');
        if (!open)
            break;
    }
    *bytes = (size_t)(r->at - begin);
    if (r->at < r->end)
        r->at++;
    return begin;
}

uint32_t formula_delimiter_read(struct formula_reader *r)
{
    uint32_t c = 0;
    formula_blank_skip(r);
    if (r->at == r->end)
        return 0;
    if (*r->at == '\\') {
        size_t n = formula_command_length(r);
        const struct formula_symbol *symbol = formula_symbol_find(r->at + 1, n);
        if (symbol)
            r->at += 1 + n;
        return symbol ? symbol->character : 0;
    }
    font_utf8_next(&r->at, r->end, &c);
    return c == '.' ? 0 : c == '<' ? 0x27e8 : c == '>' ? 0x27e9 : c;
}

/* ---- lengths ---- */

/* A number with a decimal point. */
static double number_read(struct formula_reader *r)
{
    double value = 0, unit = 1;
    bool fraction = false;
    const bool minus = r->at < r->end && *r->at == '-';
    r->at += minus || (r->at < r->end && *r->at == '+');
    for (; r->at < r->end && ((*r->at >= '0' && *r->at <= '9') || *r->at == '.'); r->at++) {
        if (*r->at == '.') {
            fraction = true;
            continue;
        }
        value = fraction ? value + (*r->at - '0') * (unit /= 10) : 10 * value + (*r->at - '0');
    }
    return minus ? -value : value;
}

double formula_length_read(struct formula_reader *r)
{
    enum { MOST = 100 };
    static const struct {
        const char *name;
        double ems;
    } units[] = {{"em", 1},     {"ex", 0.43},    {"mu", 1 / 18.0}, {"pt", 0.1},
                 {"pc", 1.2},   {"px", 0.075},   {"bp", 0.10037},  {"in", 7.227},
                 {"cm", 2.845}, {"mm", 0.28453}, {"dd", 0.107}};
    r->at += r->at < r->end && *r->at == '*';
    formula_blank_skip(r);
    const bool braced = r->at < r->end && *r->at == '{';
    r->at += braced;
    double ems = 0, number = number_read(r);
    formula_blank_skip(r);
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (r->end - r->at >= 2 && memcmp(r->at, units[i].name, 2) == 0) {
            ems = number * units[i].ems;
            r->at += 2;
            break;
        }
    while (braced && r->at < r->end && *r->at != '}')
        r->at++;
    r->at += braced && r->at < r->end;
    return ems >= -MOST && ems <= MOST ? ems : 0;
}
