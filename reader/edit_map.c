/* edit_map.c - where the letters of a block stand in its source: see edit_internal.h.
 *
 * Text and source are walked side by side. Between letters stands what only says how they look:
 * signs that end one look and begin another, where links lead to, signs of quotes at lines'
 * begins. Where it is not known what something is, the map ends. A map that is wrong does no
 * harm: each edit is read before it is done. */
#include "edit_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct walk {
    const struct reader_block *block;
    const char *s;
    int at, end; /* of the source */
    struct edit_map *map;
};

void edit_map_finish(struct edit_map *map)
{
    free(map->begin);
    free(map->end);
    *map = (struct edit_map){0};
}

void edit_lines_find(const struct reader_bytes *source, int first, int last, int *begin,
                     int *end)
{
    const char *at = source->text, *stop = at + source->bytes;
    int line = 1;
    for (const char *next; line < first && (next = memchr(at, '\n', (size_t)(stop - at)));
         line++)
        at = next + 1;
    *begin = (int)(at - source->text);
    for (const char *next; line <= last; line++, at = next + 1) {
        next = memchr(at, '\n', (size_t)(stop - at));
        if (!next || line == last) {
            at = next ? next : stop;
            break;
        }
    }
    *end = (int)(at - source->text);
    if (*end > *begin && source->text[*end - 1] == '\r')
        --*end;
}

/* ---- what lines begin with ---- */

/* Behind an item's sign and the blanks that it has; `at`: there is none. */
static int item_sign(const char *s, int at, int end, int *number_end)
{
    int k = at;
    while (k < end && k - at < 9 && isdigit((unsigned char)s[k]))
        k++;
    *number_end = k;
    const bool counted = k > at && k < end && (s[k] == '.' || s[k] == ')'),
               bullet = k == at && k < end && strchr("-*+", s[k]);
    if (!counted && !bullet)
        return at;
    k++;
    if (k < end && s[k] != ' ' && s[k] != '\t')
        return at;
    while (k < end && (s[k] == ' ' || s[k] == '\t'))
        k++;
    return k;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/* Behind a task's box and the blanks that it has. */
static int task_box(const char *s, int at, int end)
{
    if (at + 3 >= end || s[at] != '[' || !strchr(" xX", s[at + 1]) || s[at + 2] != ']' ||
        !is_blank(s[at + 3]))
        return at;
    for (at += 4; at < end && is_blank(s[at]);)
        at++;
    return at;
}

static void text_join(char *to, const char *text, int bytes)
{
    const size_t has = strlen(to);
    if (to && has + (size_t)bytes < EDIT_PREFIX_BYTES)
        snprintf(to + has, EDIT_PREFIX_BYTES - has, "%.*s", bytes, text);
}

static void blanks_join(char *to, int count)
{
    for (; count > 0; count--)
        text_join(to, " ", 1);
}

int edit_prefix(const char *s, int at, int end, char *next, char *more)
{
    char following[EDIT_PREFIX_BYTES] = "", going[EDIT_PREFIX_BYTES] = "";
    while (at < end) {
        int number, k = at;
        if (s[k] == ' ' || s[k] == '\t' || s[k] == '>') {
            text_join(following, s + k, 1);
            text_join(going, s + k, 1);
            at++;
            continue;
        }
        k = item_sign(s, at, end, &number);
        if (k == at)
            break;
        snprintf(following, sizeof following, "%s", going);
        if (number > at) {
            char counted[24];
            const int n =
                snprintf(counted, sizeof counted, "%ld", strtol(s + at, NULL, 10) + 1);
            text_join(following, counted, n);
            text_join(following, s + number, k - number);
        } else {
            text_join(following, s + at, k - at);
        }
        blanks_join(going, k - at);
        at = k;
        if (task_box(s, at, end) > at) {
            at = task_box(s, at, end);
            text_join(following, "[ ] ", 4);
            break;
        }
    }
    if (next)
        memcpy(next, following, sizeof following);
    if (more)
        memcpy(more, going, sizeof going);
    return at;
}

/* ---- one letter ---- */

static bool byte_keep(struct walk *w, int begin, int end)
{
    w->map->begin[w->map->count] = begin;
    w->map->end[w->map->count++] = end;
    w->at = end;
    return true;
}

/* Behind the line's end, and the signs of quotes and blanks that the next one begins with;
 * -1: no line ends there. */
static int line_behind(const struct walk *w, int at)
{
    while (at < w->end && (is_blank(w->s[at]) || w->s[at] == '\r'))
        at++;
    if (at >= w->end || w->s[at] != '\n')
        return -1;
    at++;
    for (int quotes = 0; at < w->end; at++) {
        if (w->s[at] == '>' && quotes < w->block->quotes)
            quotes++;
        else if (!is_blank(w->s[at]))
            break;
    }
    return at;
}

/* Behind a tag that ends a line, and the blanks and line's end that are no more than it; `at`:
 * there is none. */
static int break_behind(const struct walk *w, int at)
{
    int behind = (int)(reader_tag_break(w->s + at) - w->s);
    if (behind == at || behind > w->end)
        return at;
    const int line = line_behind(w, behind);
    while (behind < w->end && is_blank(w->s[behind]))
        behind++;
    return line >= 0 ? line : behind;
}

static bool blank_take(struct walk *w, char c)
{
    const int from = w->at;
    int behind = line_behind(w, from);
    const int tag = break_behind(w, from);
    if (tag > from && c != '\t')
        return byte_keep(w, from, tag);
    if (c == '\t') { /* the border of two cells */
        int k = from;
        while (k < w->end && is_blank(w->s[k]))
            k++;
        if (k >= w->end || w->s[k] != '|')
            return false;
        for (k++; k < w->end && is_blank(w->s[k]);)
            k++;
        return byte_keep(w, from, k);
    }
    if (c == '\n' && from < w->end && w->s[from] == '\\')
        behind = line_behind(w, from + 1);
    if (behind >= 0)
        return byte_keep(w, from, behind);
    if (c != ' ' || from >= w->end || !is_blank(w->s[from]))
        return false;
    int k = from;
    while (k < w->end && is_blank(w->s[k]))
        k++;
    return byte_keep(w, from, k);
}

/* A character that is told by its name or number: &amp; */
static bool entity_take(struct walk *w, const char *text, int left)
{
    int k = w->at + 1;
    while (k < w->end && k - w->at < 34 && (isalnum((unsigned char)w->s[k]) || w->s[k] == '#'))
        k++;
    if (k >= w->end || w->s[k] != ';' || k < w->at + 3)
        return false;
    const int from = w->at;
    int bytes = 1;
    while (bytes < left && ((unsigned char)text[bytes] & 0xc0) == 0x80)
        bytes++;
    if (text[0] == '&' && strncmp(w->s + from, "&amp;", 5) != 0 &&
        strncmp(w->s + from, "&#38;", 5) != 0)
        return false;
    for (int i = 0; i < bytes; i++)
        byte_keep(w, from, k + 1);
    return true;
}

/* One letter of the text. False: it does not stand here. */
static bool letter_take(struct walk *w, unsigned look)
{
    const char *text = w->block->text + w->map->count;
    const bool plain = look & (READER_CODE | READER_FORMULA);
    if (*text == ' ' || *text == '\t' || *text == '\n')
        return blank_take(w, *text);
    if (w->at >= w->end)
        return false;
    const char c = w->s[w->at];
    if (!plain && c == '\\' && w->at + 1 < w->end && w->s[w->at + 1] == *text &&
        ispunct((unsigned char)*text))
        return byte_keep(w, w->at, w->at + 2);
    if (w->block->kind == READER_ROW && c == '\\' && *text == '|' && w->s[w->at + 1] == '|')
        return byte_keep(w, w->at, w->at + 2);
    if (!plain && c == '&' && entity_take(w, text, w->block->bytes - w->map->count))
        return true;
    return c == *text && byte_keep(w, w->at, w->at + 1);
}

/* ---- what stands between letters ---- */

/* Behind brackets that begin at `at`, which may be within each other; -1: they do not end. */
static int brackets_behind(const struct walk *w, int at)
{
    const char open = w->s[at], close = open == '(' ? ')' : open == '[' ? ']' : '>';
    char quote = '\0';
    int depth = 0;
    for (int k = at; k < w->end; k++) {
        const char c = w->s[k];
        if (c == '\\')
            k++;
        else if (quote)
            quote = c == quote ? '\0' : quote;
        else if (open == '(' && k > at && (c == '"' || c == '\'') && is_blank(w->s[k - 1]))
            quote = c;
        else if (c == open && open != '<')
            depth++;
        else if (c == close && (open == '<' || --depth == 0))
            return k + 1;
    }
    return -1;
}

/* One sign that is no letter; false: there is none. */
static bool sign_skip(struct walk *w)
{
    const char c = w->at < w->end ? w->s[w->at] : '\0';
    int behind = -1;
    if (c == ']' && w->at + 1 < w->end && (w->s[w->at + 1] == '(' || w->s[w->at + 1] == '['))
        behind = brackets_behind(w, w->at + 1);
    else if (c == '<')
        behind = brackets_behind(w, w->at);
    if (behind < 0 && c && strchr("*_~`[]!<>$", c))
        behind = w->at + 1;
    if (behind < 0)
        return false;
    w->at = behind;
    const char *text = w->block->text + w->map->count;
    const bool enough = w->map->count && text[-1] == ' ' && *text != ' ';
    while (enough && w->at < w->end && is_blank(w->s[w->at])) /* around a comment */
        w->at++;
    return true;
}

static bool other_link(const struct reader_span *a, const struct reader_span *b)
{
    const char *from = a && a->target ? a->target : "", *to = b && b->target ? b->target : "";
    return strcmp(from, to) != 0;
}

/* How many signs of that kind end one look or begin another. */
static int signs_of(unsigned other, char c)
{
    switch (c) {
    case '*':
    case '_':
        return (other & READER_HEAVY ? 2 : 0) + (other & READER_SLANTED ? 1 : 0);
    case '~':
        return other & READER_STRUCK ? 2 : 0;
    case '`':
        return other & READER_CODE ? 80 : 0;
    default:
        return 0;
    }
}

/* Where letters begin to look otherwise: the signs that say so. */
static void look_change(struct walk *w, const struct reader_span *from,
                        const struct reader_span *to)
{
    const unsigned other = (from ? from->look : 0) ^ to->look;
    const bool linked = other_link(from, to), was_linked = from && from->target;
    int used[3] = {0};
    bool closed = !was_linked, opened = false;
    for (bool more = true; more && w->at < w->end;) {
        const char c = w->s[w->at];
        const char *kind = c == '_' ? "*" : strchr("*~`", c);
        more = false;
        if (c && kind && signs_of(other, c)) {
            const int i = *kind == '*' ? 0 : *kind == '~' ? 1 : 2;
            if (used[i]++ < signs_of(other, c)) {
                w->at++;
                more = true;
            }
        } else if (linked && !closed && (c == ']' || c == '>')) {
            more = closed = sign_skip(w);
        } else if (linked && !opened && to->target && (c == '[' || c == '<' || c == '!')) {
            w->at++;
            opened = c != '!';
            more = true;
        }
    }
    if ((other & READER_CODE) && (to->look & READER_CODE) && w->at < w->end &&
        w->s[w->at] == ' ' && w->block->text[to->begin] != ' ')
        w->at++;
}

/* A note's number stands for its name. */
static bool note_take(struct walk *w, const struct reader_span *span)
{
    const int from = w->at;
    if (from + 2 >= w->end || w->s[from] != '[' || w->s[from + 1] != '^')
        return false;
    const int behind = brackets_behind(w, from);
    for (int i = span->begin; i < span->end && behind >= 0; i++)
        byte_keep(w, from, behind);
    return behind >= 0;
}

/* A picture of a tag, or one without a caption: all of it is each of its letters. */
static bool image_take(struct walk *w, const struct reader_span *span)
{
    const int from = w->at;
    for (int tries = 0; tries < 64 && w->at + 4 < w->end; tries++) {
        const char *s = w->s + w->at;
        int behind = strncasecmp(s, "<img", 4) == 0 ? brackets_behind(w, w->at)
                     : strncmp(s, "![](", 4) == 0   ? brackets_behind(w, w->at + 3)
                                                    : -1;
        if (behind >= 0) {
            const int at = w->at;
            for (int i = span->begin; i < span->end; i++)
                byte_keep(w, at, behind);
            return true;
        }
        if (*s == '!' || !sign_skip(w))
            break;
    }
    w->at = from;
    return false;
}

static void letters_walk(struct walk *w)
{
    const struct reader_block *b = w->block;
    for (int i = 0; i < b->spans_count; i++) {
        const struct reader_span *span = &b->spans[i];
        if (span->look & READER_IMAGE && image_take(w, span))
            continue;
        look_change(w, i ? span - 1 : NULL, span);
        while (w->map->count < span->end) {
            const int from = w->at;
            bool good =
                span->look & READER_NOTE ? note_take(w, span) : letter_take(w, span->look);
            for (int tries = 0; !good && tries < 64 && sign_skip(w); tries++)
                good =
                    span->look & READER_NOTE ? note_take(w, span) : letter_take(w, span->look);
            if (!good) {
                w->at = from;
                return;
            }
        }
    }
}

/* ---- lines of code ---- */

/* Each line of the text is the end of one of the source. */
static void code_walk(struct walk *w, bool fenced)
{
    const struct reader_block *b = w->block;
    int at = w->map->first;
    if (fenced) {
        const char *next = memchr(w->s + at, '\n', (size_t)(w->end - at));
        at = next ? (int)(next - w->s) + 1 : w->end;
    }
    w->map->head = at;
    for (int from = 0; from <= b->bytes;) {
        const char *text = b->text + from,
                   *stop = memchr(text, '\n', (size_t)(b->bytes - from));
        const int length = stop ? (int)(stop - text) : b->bytes - from;
        const char *next = memchr(w->s + at, '\n', (size_t)(w->end - at));
        int end = next ? (int)(next - w->s) : w->end;
        const int behind = next ? end + 1 : end;
        end -= end > at && w->s[end - 1] == '\r';
        if (end - at < length || memcmp(w->s + end - length, text, (size_t)length) != 0)
            return;
        if (from == 0)
            w->map->head = end - length;
        for (int i = 0; i < length; i++)
            byte_keep(w, end - length + i, end - length + i + 1);
        from += length + 1;
        if (!stop)
            return;
        const char *more = memchr(w->s + behind, '\n', (size_t)(w->end - behind));
        int more_end = more ? (int)(more - w->s) : w->end;
        more_end -= more_end > behind && w->s[more_end - 1] == '\r';
        const char *text_next = b->text + from,
                   *stop_next = memchr(text_next, '\n', (size_t)(b->bytes - from));
        const int length_next = stop_next ? (int)(stop_next - text_next) : b->bytes - from;
        byte_keep(w, end, more_end - length_next > end ? more_end - length_next : behind);
        at = behind;
    }
}

/* The letters of a formula between two dollars, which begins in the block's line and may go on
 * in the next ones. False: it is a fence. */
static bool formula_walk(struct walk *w, int all)
{
    const struct reader_block *b = w->block;
    for (int at = w->map->first; at + b->bytes + 4 <= all && at < w->end; at++) {
        int i = 0;
        while (i < b->bytes && w->s[at + 2 + i] == b->text[i])
            i++;
        if (i < b->bytes || strncmp(w->s + at, "$$", 2) != 0 ||
            strncmp(w->s + at + 2 + i, "$$", 2) != 0)
            continue;
        w->map->head = at + 2;
        for (int k = 0; k < b->bytes; k++)
            byte_keep(w, at + 2 + k, at + 3 + k);
        return true;
    }
    return false;
}

static int head_find(const struct reader_block *block, const char *s, int first, int last)
{
    const char *line_stop = memchr(s + first, '\n', (size_t)(last - first));
    const int line_end = line_stop ? (int)(line_stop - s) : last;
    int head = edit_prefix(s, first, line_end, NULL, NULL);
    if (head + 1 < line_end && s[head] == '[' && s[head + 1] == '^') { /* a note's text */
        const char *behind = memchr(s + head, ']', (size_t)(line_end - head));
        if (behind && behind[1] == ':')
            for (head = (int)(behind - s) + 2; head < line_end && is_blank(s[head]);)
                head++;
    }
    if (block->kind == READER_HEADING && head < line_end && s[head] == '#') {
        while (head < line_end && s[head] == '#')
            head++;
        while (head < line_end && is_blank(s[head]))
            head++;
    }
    if (block->kind == READER_ROW && head < line_end && s[head] == '|')
        for (head++; head < line_end && is_blank(s[head]);)
            head++;
    return head;
}

/* Behind blanks and a line's end. */
static int blanks_skip(const char *s, int at, int last)
{
    while (at < last && is_blank(s[at]))
        at++;
    if (at == last || s[at] != '\n')
        return at;
    const char *stop = memchr(s + at + 1, '\n', (size_t)(last - at - 1));
    return edit_prefix(s, at + 1, stop ? (int)(stop - s) : last, NULL, NULL);
}

/* at: where its text begins; -1: where that of its lines does. */
static bool map_from(const struct reader_block *block, const struct reader_bytes *source,
                     int at, struct edit_map *out)
{
    *out = (struct edit_map){.begin = malloc(((size_t)block->bytes + 1) * sizeof(int)),
                             .end = malloc(((size_t)block->bytes + 1) * sizeof(int))};
    if (!out->begin || !out->end) {
        edit_map_finish(out);
        return false;
    }
    edit_lines_find(source, block->first_line, block->last_line, &out->first, &out->last);
    struct walk w = {.block = block, .s = source->text, .end = out->last, .map = out};
    out->head = w.at = at < 0 ? head_find(block, source->text, out->first, out->last) : at;
    switch (block->kind) {
    case READER_CODE_BLOCK:
    case READER_LIVE:
    case READER_MATH:
        if (block->kind == READER_MATH && formula_walk(&w, (int)source->bytes))
            break;
        code_walk(&w, source->text[out->head] == '`' || source->text[out->head] == '~');
        break;
    case READER_HTML:
        code_walk(&w, false);
        break;
    case READER_PARAGRAPH:
    case READER_HEADING:
    case READER_RULE:
    case READER_ROW:
    case READER_PICTURE:
        letters_walk(&w);
        break;
    }
    return true;
}

bool edit_map_make(const struct reader_block *block, const struct reader_bytes *source,
                   struct edit_map *out)
{
    const struct reader_block *b = block;
    int at = -1;
    while (reader_block_is_cut_off(b))
        b--;
    for (; b < block; b++) {
        struct edit_map map;
        if (!map_from(b, source, at, &map))
            return false;
        if (map.count)
            at = blanks_skip(source->text, map.end[map.count - 1], map.last);
        edit_map_finish(&map);
    }
    return map_from(block, source, at, out);
}
