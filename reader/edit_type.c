/* edit_type.c - letters that are typed and deleted, as changes of the source: see
 * reader_edit.h. Each is tried in several ways, the plainest first, until what is read is what
 * was meant. */
#include "edit_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A place in a block. */
struct spot {
    const struct reader_block *block; /* NULL: the document is empty */
    struct edit_map map;
    const struct reader_bytes *source;
    int p;
};

static enum reader_status cannot(void)
{
    return reader_fail(READER_BAD_ARGUMENT,
                       "this cannot be told in Markdown here: edit its source");
}

static bool is_code(const struct reader_block *b)
{
    return b && (b->kind == READER_CODE_BLOCK || b->kind == READER_LIVE ||
                 b->kind == READER_MATH || b->kind == READER_HTML);
}

static void spot_finish(struct spot *spot)
{
    edit_map_finish(&spot->map);
}

static enum reader_status spot_find(const struct reader_edit *e, size_t byte, struct spot *out)
{
    const struct reader_block *b = reader_document_block(*e->document, byte);
    *out = (struct spot){.block = b};
    if (!b)
        return READER_OK;
    const size_t from = byte > b->at ? byte - b->at : 0;
    out->p = from < (size_t)b->bytes ? (int)from : b->bytes;
    out->source = &e->files->texts[b->source];
    return edit_map_make(b, out->source, &out->map)
               ? READER_OK
               : reader_fail(READER_NO_MEMORY, "no memory for an edit");
}

/* Behind the letter before a place, or before the one behind it; -1: not known. */
static int place_behind(const struct spot *s, int p)
{
    return p > s->map.count ? -1 : p > 0 ? s->map.end[p - 1] : s->map.head;
}

static int place_before(const struct spot *s, int p)
{
    return p < s->map.count ? s->map.begin[p] : -1;
}

static const struct reader_span *span_at(const struct reader_block *b, int p)
{
    for (int i = 0; i < b->spans_count; i++)
        if (p >= b->spans[i].begin && p < b->spans[i].end)
            return &b->spans[i];
    return NULL;
}

/* ---- letters as Markdown ---- */

enum written { AS_TYPED, SIGNS_ESCAPED, ALL_ESCAPED, WRITTEN };

/* Text with backslashes before signs, blanks at its ends by their number, and what a line
 * begins with behind each of its ends. NULL: no memory. */
static char *write_as(const char *text, size_t count, enum written how, const char *line,
                      size_t *bytes)
{
    char *out = NULL;
    FILE *to = open_memstream(&out, bytes);
    for (size_t i = 0; i < count && to; i++) {
        const char c = text[i];
        const bool edge = i == 0 || i + 1 == count;
        if (how != AS_TYPED && ispunct((unsigned char)c) && c &&
            (how == ALL_ESCAPED || edge || strchr("\\`*_[]<>#&$|~", c)))
            fputc('\\', to);
        if (how == ALL_ESCAPED && c == ' ' && edge)
            fputs("&#32;", to);
        else
            fputc(c, to);
        if (c == '\n')
            fputs(line, to);
    }
    if (!to || fclose(to) != 0) {
        free(out);
        return NULL;
    }
    return out;
}

/* What lines of code begin with, in lists and quotes; of a formula between dollars, nothing. */
static void code_line(const struct spot *s, char to[EDIT_PREFIX_BYTES])
{
    int begin = s->map.head;
    const char *t = s->source->text;
    while (begin > 0 && t[begin - 1] != '\n')
        begin--;
    const bool dollar =
        s->block->kind == READER_MATH && s->map.head && t[s->map.head - 1] == '$';
    snprintf(to, EDIT_PREFIX_BYTES, "%.*s", dollar ? 0 : s->map.head - begin, t + begin);
}

static enum reader_status try_bytes(struct reader_edit *e, int source, int begin, int end,
                                    const char *text, size_t bytes,
                                    const struct edit_meant *meant,
                                    struct reader_edit_change *change, bool *done)
{
    if (*done || begin < 0 || end < begin)
        return READER_OK;
    const struct edit_splice splice = {source, (size_t)begin, (size_t)(end - begin), text,
                                       bytes};
    const enum reader_status status = edit_try(e, &splice, meant, change, done);
    return status == READER_TOO_LARGE || status == READER_NO_MEMORY ? status : READER_OK;
}

/* Bytes begin..end of the source become the letters, written in each way. lead, tail: before
 * and behind them. */
static enum reader_status letters_try(struct reader_edit *e, const struct spot *s, int begin,
                                      int end, const char *lead, const char *utf8, size_t bytes,
                                      const char *tail, const struct edit_meant *meant,
                                      struct reader_edit_change *change, bool *done)
{
    char line[EDIT_PREFIX_BYTES] = "";
    enum reader_status status = READER_OK;
    const int source = s->block ? s->block->source : 0;
    const int ways = is_code(s->block) ? SIGNS_ESCAPED : WRITTEN;
    if (is_code(s->block))
        code_line(s, line);
    for (int how = AS_TYPED; how < ways && !*done && status == READER_OK; how++) {
        size_t written;
        char *text = write_as(utf8, bytes, (enum written)how, line, &written), *all = NULL;
        if (!text || asprintf(&all, "%s%s%s", lead, text, tail) < 0) {
            free(text);
            return reader_fail(READER_NO_MEMORY, "no memory for an edit");
        }
        status = try_bytes(e, source, begin, end, all, strlen(lead) + written + strlen(tail),
                           meant, change, done);
        free(text);
        free(all);
    }
    return status;
}

/* ---- what waits ---- */

bool reader_edit_wait_end(struct reader_edit *e)
{
    const bool waited = e->waits != READER_WAITS_NOTHING;
    e->waits = READER_WAITS_NOTHING;
    return waited;
}

enum reader_edit_waits reader_edit_waits(const struct reader_edit *e)
{
    return e->waits;
}

/* What begins another paragraph, or item, behind a block's text. */
static void break_write(const struct spot *s, bool outside, char to[2 * EDIT_PREFIX_BYTES + 4])
{
    char next[EDIT_PREFIX_BYTES], more[EDIT_PREFIX_BYTES], blank[EDIT_PREFIX_BYTES];
    edit_prefix(s->source->text, s->map.first, s->map.last, next, more);
    snprintf(blank, sizeof blank, "%s", more);
    for (size_t n = strlen(blank); n && blank[n - 1] == ' ';)
        blank[--n] = '\0';
    if (outside)
        snprintf(to, 2 * EDIT_PREFIX_BYTES + 4, "\n\n");
    else if (s->block->marker && strcmp(next, more) != 0)
        snprintf(to, 2 * EDIT_PREFIX_BYTES + 4, "\n%s", next);
    else
        snprintf(to, 2 * EDIT_PREFIX_BYTES + 4, "\n%s\n%s", blank, more);
}

/* ---- typing ---- */

/* Blanks that Markdown would not keep. True: there is nothing more to be done. */
static bool blank_typed(struct reader_edit *e, const struct spot *s, size_t byte,
                        struct reader_edit_change *change)
{
    const struct reader_block *b = s->block;
    change->caret = byte;
    const bool within = b && s->p == 0 && reader_block_is_cut_off(b) && b->unspaced;
    if (is_code(b) || (within && e->waits == READER_WAITS_NOTHING))
        return false;
    if (!b || s->p == 0 || e->waits != READER_WAITS_NOTHING)
        return true;
    if (s->p < b->bytes && b->text[s->p] == ' ') {
        change->caret = byte + 1;
        return true;
    }
    if (strchr(" \n\t", b->text[s->p - 1]))
        return true;
    if (s->p < b->bytes && b->text[s->p] != '\t' && b->text[s->p] != '\n')
        return false;
    e->waits = READER_WAITS_BLANK;
    e->waits_at = byte;
    return true;
}

static enum reader_status empty_typed(struct reader_edit *e, const char *utf8, size_t bytes,
                                      struct reader_edit_change *change, bool *done)
{
    const struct spot none = {0};
    const int end = e->files->count ? (int)e->files->texts[0].bytes : -1;
    const struct edit_meant meant = {
        .text = utf8, .bytes = bytes, .caret = bytes, .typed = true};
    return letters_try(e, &none, end, end, "", utf8, bytes, "", &meant, change, done);
}

/* Among the words of a link that is called by them: it gets its name. */
static enum reader_status named_try(struct reader_edit *e, const struct spot *s, int begin,
                                    int end, const char *lead, const char *utf8, size_t bytes,
                                    const struct edit_meant *meant,
                                    struct reader_edit_change *change, bool *done)
{
    int behind;
    char *tail =
        edit_link_name(s->source->text, s->map.first, s->map.last, begin, end, &behind);
    const enum reader_status status =
        tail ? letters_try(e, s, begin, behind, lead, utf8, bytes, tail, meant, change, done)
             : READER_OK;
    free(tail);
    return status;
}

/* In place of begin..end of the spot's block: those letters; lead, and as it is read: what
 * waits before them. */
static enum reader_status typed_try(struct reader_edit *e, struct spot *s, size_t begin,
                                    size_t end, const char *lead, const char *lead_read,
                                    const char *utf8, size_t bytes,
                                    struct reader_edit_change *change, bool *done)
{
    const struct reader_block *b = s->block;
    const int p = s->p, q = p + (int)(end - begin);
    const struct reader_span *before = p ? span_at(b, p - 1) : NULL, *behind = span_at(b, p);
    char *read = NULL;
    if (asprintf(&read, "%s%.*s", lead_read, (int)bytes, utf8) < 0)
        return reader_fail(READER_NO_MEMORY, "no memory for an edit");
    const struct edit_meant meant = {.begin = begin,
                                     .end = end,
                                     .text = read,
                                     .bytes = strlen(read),
                                     .caret = begin + strlen(read),
                                     .typed = begin == end && !strchr(utf8, '\n')};
    int from[2] = {place_behind(s, p), place_before(s, p)};
    if (begin == end && before && (before->look & READER_LINK) && before != behind) {
        const int inside = from[0]; /* what is typed behind a link is not of it */
        from[0] = from[1];
        from[1] = inside;
    }
    enum reader_status status = READER_OK;
    for (int i = 0; i < 2 && !*done && status == READER_OK; i++) {
        const int to = begin == end ? from[i] : place_behind(s, q);
        status = letters_try(e, s, from[i], to, lead, utf8, bytes, "", &meant, change, done);
    }
    for (int i = 0; i < 2 && !*done && status == READER_OK; i++)
        status = named_try(e, s, from[i], begin == end ? from[i] : place_behind(s, q), lead,
                           utf8, bytes, &meant, change, done);
    free(read);
    return status;
}

enum reader_status reader_edit_insert(struct reader_edit *e, size_t begin, size_t end,
                                      const char *utf8, size_t bytes,
                                      struct reader_edit_change *change)
{
    char lead[2 * EDIT_PREFIX_BYTES + 4] = "";
    struct spot s;
    bool done = false;
    *change = (struct reader_edit_change){.block = -1};
    enum reader_status status = spot_find(e, begin, &s);
    if (status != READER_OK ||
        (begin == end && bytes == 1 && *utf8 == ' ' && blank_typed(e, &s, begin, change))) {
        spot_finish(&s);
        return status;
    }
    const struct reader_block *b = s.block;
    const char *read = "";
    if (b && e->waits != READER_WAITS_NOTHING && e->waits_at == begin && begin == end) {
        read = e->waits == READER_WAITS_BLANK ? " " : "\n\n";
        if (e->waits == READER_WAITS_BLANK)
            strcpy(lead, " ");
        else
            break_write(&s, e->waits == READER_WAITS_OUTSIDE, lead);
    }
    if (!b)
        status = empty_typed(e, utf8, bytes, change, &done);
    else if (begin >= b->at && end <= b->at + (size_t)b->bytes && end >= begin)
        status = typed_try(e, &s, begin, end, lead, read, utf8, bytes, change, &done);
    spot_finish(&s);
    if (done)
        e->waits = READER_WAITS_NOTHING;
    return status == READER_OK && !done ? cannot() : status;
}

/* ---- a paragraph ends ---- */

static enum reader_status break_within(struct reader_edit *e, const struct spot *s, size_t byte,
                                       struct reader_edit_change *change, bool *done)
{
    char lead[2 * EDIT_PREFIX_BYTES + 4];
    const char *t = s->block->text;
    const bool behind = t[s->p] == ' ', before = t[s->p - 1] == ' ';
    const int from = place_behind(s, before ? s->p - 1 : s->p),
              to = behind ? place_behind(s, s->p + 1) : place_behind(s, s->p);
    const struct edit_meant meant = {.begin = byte - before,
                                     .end = byte + behind,
                                     .text = "\n\n",
                                     .bytes = 2,
                                     .caret = byte - before + 2};
    break_write(s, false, lead);
    return try_bytes(e, s->block->source, from, to, lead, strlen(lead), &meant, change, done);
}

enum reader_status reader_edit_break(struct reader_edit *e, size_t byte,
                                     struct reader_edit_change *change)
{
    struct spot s;
    bool done = false;
    *change = (struct reader_edit_change){.block = -1, .caret = byte};
    enum reader_status status = spot_find(e, byte, &s);
    const struct reader_block *b = s.block;
    if (status == READER_OK && is_code(b)) {
        spot_finish(&s);
        return reader_edit_insert(e, byte, byte, "\n", 1, change);
    }
    if (status == READER_OK && b && s.p == b->bytes && s.map.count == b->bytes &&
        b->kind != READER_ROW && b->kind != READER_RULE) {
        const bool listed = b->items || b->quotes;
        e->waits = e->waits == READER_WAITS_PARAGRAPH && listed ? READER_WAITS_OUTSIDE
                                                                : READER_WAITS_PARAGRAPH;
        e->waits_at = byte;
        done = true;
    } else if (status == READER_OK && b && s.p > 0 && s.p < b->bytes) {
        e->waits = READER_WAITS_NOTHING;
        status = break_within(e, &s, byte, change, &done);
    } else {
        done = s.p == 0; /* there is no empty paragraph */
    }
    spot_finish(&s);
    return status == READER_OK && !done ? cannot() : status;
}

/* ---- deleting ---- */

/* What stands between letters from..to of the map, which are deleted. Owns: the caller frees
 * it; NULL: no memory. */
static char *between_letters(const struct spot *s, int from, int to, size_t *bytes)
{
    char *out = NULL;
    FILE *file = open_memstream(&out, bytes);
    for (int i = from; i + 1 < to && file; i++)
        if (s->map.begin[i + 1] > s->map.end[i])
            fprintf(file, "%.*s", s->map.begin[i + 1] - s->map.end[i],
                    s->source->text + s->map.end[i]);
    if (!file || fclose(file) != 0) {
        free(out);
        return NULL;
    }
    return out;
}

/* A paragraph of the text goes with its lines, and the blank ones behind it. */
static void whole_lines(const struct spot *s, int *begin, int *end)
{
    const char *t = s->source->text;
    *begin = s->map.first;
    *end = s->map.last;
    const int all = (int)s->source->bytes;
    if (*end < all && t[*end] == '\r')
        ++*end;
    if (*end < all && t[*end] == '\n')
        ++*end;
    for (int k = *end; k < all && strchr(" \t\r\n", t[k]); k++)
        if (t[k] == '\n')
            *end = k + 1;
}

static enum reader_status within_try(struct reader_edit *e, const struct spot *s, int q,
                                     const struct edit_meant *meant,
                                     struct reader_edit_change *change, bool *done)
{
    const struct reader_block *b = s->block;
    const int p = s->p, source = b->source;
    const bool all = p == 0 && q == b->bytes;
    enum reader_status status = READER_OK;
    if (q > s->map.count)
        return status;
    const bool ends = p > 0 && q == b->bytes && b->text[p - 1] == ' ' && !is_code(b);
    const int first = ends ? place_behind(s, p - 1) : s->map.begin[p],
              last = s->map.end[q - 1]; /* with the blank that would be at the end */
    const struct reader_span *own = span_at(b, p), *end = span_at(b, q - 1);
    if (all && !b->items && !b->quotes && !is_code(b) && b->kind == READER_PARAGRAPH) {
        int from, to;
        whole_lines(s, &from, &to);
        status = try_bytes(e, source, from, to, "", 0, meant, change, done);
    }
    if (all && status == READER_OK && !*done && !is_code(b)) /* and the signs around it */
        status = try_bytes(e, source, s->map.head, s->map.last, "", 0, meant, change, done);
    if (*done || status != READER_OK) /* the spans are gone */
        return status;
    if (own && end && own->begin == p && end->end == q && (own->look || end->look) &&
        place_behind(s, p) <= first)
        status = try_bytes(e, source, place_behind(s, p),
                           place_before(s, q) < 0 ? last : place_before(s, q), "", 0, meant,
                           change, done);
    if (*done || status != READER_OK)
        return status;
    size_t bytes;
    char *between = between_letters(s, ends ? p - 1 : p, q, &bytes);
    if (!between)
        return reader_fail(READER_NO_MEMORY, "no memory for an edit");
    status = try_bytes(e, source, first, last, between, bytes, meant, change, done);
    free(between);
    if (status == READER_OK)
        status = try_bytes(e, source, first, last, "", 0, meant, change, done);
    int behind;
    char *named =
        *done || status != READER_OK
            ? NULL
            : edit_link_name(s->source->text, s->map.first, s->map.last, first, last, &behind);
    if (named)
        status = try_bytes(e, source, first, behind, named, strlen(named), meant, change, done);
    free(named);
    return status;
}

/* From one block to another one of the same file. */
static enum reader_status across_try(struct reader_edit *e, const struct spot *a,
                                     const struct spot *b, const struct edit_meant *meant,
                                     struct reader_edit_change *change, bool *done)
{
    const int begin = place_behind(a, a->p);
    const int ends[2] = {b->p ? place_behind(b, b->p) : b->map.head, place_before(b, b->p)};
    enum reader_status status = READER_OK;
    if (a->block->source != b->block->source)
        return status;
    const int source = a->block->source;
    for (int i = 0; i < 2 && status == READER_OK && !*done; i++) {
        status = try_bytes(e, source, begin, ends[i], "", 0, meant, change, done);
        if (status == READER_OK && !*done && a->p == 0) /* with what the line begins with */
            status = try_bytes(e, source, a->map.first, ends[i], "", 0, meant, change, done);
    }
    return status;
}

static void wait_behind(struct reader_edit *e, const struct reader_block *b,
                        enum reader_edit_waits waits, struct reader_edit_change *change)
{
    e->waits = waits;
    e->waits_at = change->caret = b->at + (size_t)b->bytes;
}

/* What is left may end with a blank that is not kept. */
static void blank_left(struct reader_edit *e, struct reader_edit_change *change)
{
    const struct reader_block *left = reader_document_block(*e->document, change->caret);
    if (left && !is_code(left) && left->bytes &&
        change->caret == left->at + (size_t)left->bytes + 1)
        wait_behind(e, left, READER_WAITS_BLANK, change);
}

enum reader_status reader_edit_delete(struct reader_edit *e, size_t begin, size_t end,
                                      struct reader_edit_change *change)
{
    const struct edit_meant meant = {
        .begin = begin, .end = end, .text = "", .bytes = 0, .caret = begin};
    struct spot a = {0}, b = {0};
    bool done = false;
    const int blocks = (*e->document)->blocks_count;
    *change = (struct reader_edit_change){.block = -1, .caret = begin};
    e->waits = READER_WAITS_NOTHING;
    if (begin >= end || end > (*e->document)->plain_bytes)
        return begin == end ? READER_OK : cannot();
    enum reader_status status = spot_find(e, begin, &a);
    if (status == READER_OK)
        status = spot_find(e, end, &b);
    const struct reader_document *before = *e->document;
    const bool within = a.block == b.block;
    const long block_number =
        a.block >= before->blocks && a.block < before->blocks + before->blocks_count
            ? a.block - before->blocks
            : -1;
    if (status == READER_OK && a.block && a.block == b.block && b.p > a.p)
        status = within_try(e, &a, b.p, &meant, change, &done);
    else if (status == READER_OK && a.block && b.block && a.block != b.block)
        status = across_try(e, &a, &b, &meant, change, &done);
    const struct reader_document *d = *e->document;
    const long number = a.block && a.p == 0 && done ? block_number : -1;
    spot_finish(&a);
    spot_finish(&b);
    if (status != READER_OK || !done)
        return status == READER_OK ? cannot() : status;
    if (within && number > 0 && number <= d->blocks_count && d->blocks_count == blocks - 1)
        wait_behind(e, &d->blocks[number - 1], READER_WAITS_PARAGRAPH, change);
    else
        blank_left(e, change);
    return READER_OK;
}

/* ---- the source itself ---- */

enum reader_status reader_edit_source(struct reader_edit *e, int source, size_t begin,
                                      size_t end, const char *utf8, size_t bytes,
                                      struct reader_edit_change *change)
{
    bool done;
    *change = (struct reader_edit_change){.block = -1};
    e->waits = READER_WAITS_NOTHING;
    if (source < 0 || source >= e->files->count || begin > end ||
        end > e->files->texts[source].bytes)
        return reader_fail(READER_BAD_ARGUMENT, "there are no such bytes in the source");
    const struct edit_splice splice = {source, begin, end - begin, utf8, bytes};
    const struct edit_meant meant = {.any = true};
    e->part = true;
    return edit_try(e, &splice, &meant, change, &done);
}
