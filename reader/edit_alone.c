/* edit_alone.c - lines that are read without the rest of their file: see edit_internal.h.
 *
 * What they are in the document does not depend on what stands before and behind them.
 *   Text: from one blank line to another, or a whole list, quote or table, where
 *   - the line before is blank, and the first one is moved in by nothing, so that it ends all
 *     that was open; it is no item where a list stands before;
 *   - a blank line follows, then one that is moved in by nothing, and no item behind a list;
 *   - no tag begins what goes on over blank lines, and fences are in lists and quotes;
 *   - what its brackets may mean is defined behind it: links (edit_defined.c), and notes that it
 *     calls, by their names. Labels stay.
 *   A note: its definition's lines, called by a line that is put ahead.
 *   Code: a fence that is in nothing, whose own two lines stay, and what it has in it has no
 *   fences. */
#include "edit_internal.h"
#include "edit_lines.h"
#include "tag.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LINES_BYTES_MOST = 64 << 10,
    NAMES = 64
}; /* of what is read alone: more is hardly faster */

static bool has_any(const char *s, size_t bytes, const char *signs)
{
    for (size_t i = 0; i < bytes; i++)
        if (s[i] && strchr(signs, s[i]))
            return true;
    return false;
}

/* Three signs of a fence in a row. */
static bool has_fence(const char *s, size_t bytes)
{
    for (size_t i = 0; i + 2 < bytes; i++)
        if ((s[i] == '`' || s[i] == '~') && s[i + 1] == s[i] && s[i + 2] == s[i])
            return true;
    return false;
}

/* Whether a line begins an item of a list, or might. */
static bool is_item(const char *s, size_t at, size_t bytes)
{
    size_t end = at;
    while (end < bytes && isdigit((unsigned char)s[end]))
        end++;
    const bool number = end > at && end < bytes && (s[end] == '.' || s[end] == ')'),
               bullet = end == at && end < bytes && strchr("-+*", s[end]) && s[end];
    return (number || bullet) &&
           (end + 1 >= bytes || s[end + 1] == ' ' || s[end + 1] == '\t' || s[end + 1] == '\n');
}

static int line_of(const struct reader_bytes *source, size_t at)
{
    int line = 1;
    for (const char *s = source->text, *stop = s + at;
         (s = memchr(s, '\n', (size_t)(stop - s))); s++)
        line++;
    return line;
}

static int line_ends(const char *text, size_t bytes)
{
    int count = 0;
    for (size_t i = 0; i < bytes; i++)
        count += text[i] == '\n';
    return count;
}

/* ---- where they begin and end ---- */

/* Whether the last block of the source that begins before the line is in a list. */
static bool list_before(const struct reader_document *d, int source, int line)
{
    const struct reader_block *last = NULL;
    for (int i = 0; i < d->blocks_count; i++)
        if (d->blocks[i].source == source && d->blocks[i].first_line < line &&
            (!last || d->blocks[i].first_line >= last->first_line))
            last = &d->blocks[i];
    return last && last->items > 0;
}

/* Whether all that was open ends at the line, which begins something. */
static bool begins_at(const struct reader_document *d, int source, const char *s, size_t at,
                      size_t bytes, int line)
{
    if (at >= bytes || strchr(" \t\n", s[at]))
        return false;
    if (definition_end(s, at, bytes))
        return true;
    if (at > 0 && !is_blank_line(s, line_begin(s, at - 1), bytes))
        return false;
    return !is_item(s, at, bytes) || !list_before(d, source, line);
}

/* Whether all ends with the line that ends there. */
static bool ends_at(const struct reader_document *d, int source, const char *s, size_t at,
                    size_t bytes, int line)
{
    if (at >= bytes)
        return true;
    size_t next = at + 1;
    if (definition_end(s, next, bytes))
        return true;
    if (!is_blank_line(s, next, bytes))
        return false;
    while (next < bytes && is_blank_line(s, next, bytes)) {
        while (next < bytes && s[next] != '\n')
            next++;
        next += next < bytes;
    }
    if (next >= bytes)
        return true;
    return s[next] != ' ' && s[next] != '\t' &&
           (!is_item(s, next, bytes) || !list_before(d, source, line + 1));
}

/* The lines around the splice that stand alone. */
static bool lines_find(const struct reader_document *d, const struct reader_bytes *source,
                       const struct edit_splice *splice, struct edit_alone *out)
{
    const char *s = source->text;
    const size_t bytes = source->bytes;
    size_t begin = line_begin(s, splice->at),
           end = line_end(s, splice->at + splice->removed, bytes);
    out->line = line_of(source, begin);
    int last = out->line + line_ends(s + begin, end - begin);
    while (!begins_at(d, splice->source, s, begin, bytes, out->line)) {
        if (begin == 0 || end - begin > LINES_BYTES_MOST)
            return false;
        begin = line_begin(s, begin - 1);
        out->line--;
    }
    for (; !ends_at(d, splice->source, s, end, bytes, last); last++) {
        if (end - begin > LINES_BYTES_MOST)
            return false;
        end = line_end(s, end + 1, bytes);
    }
    out->begin = begin;
    while (end < bytes && is_blank_line(s, end + 1, bytes)) /* cmark-gfm counts them as a */
        end = line_end(s, end + 1, bytes);                  /* heading's */
    out->end = end < bytes ? end + 1 : end;
    out->notes = definition_end(s, begin, bytes) > 0;
    return true;
}

/* ---- the ways ---- */

/* Whether formulas there are what they are alone: they stand in no fence, and end with their
 * paragraph, which goes over the lines of several notes. */
static bool formulas_stand_alone(const struct reader_bytes *source, const struct edit_alone *a,
                                 const char *now, size_t bytes)
{
    const char *s = source->text;
    size_t begin = a->begin, end = a->end;
    while (begin > 0 && !is_blank_line(s, line_begin(s, begin - 1), source->bytes))
        begin = line_begin(s, begin - 1);
    while (end < source->bytes && !is_blank_line(s, line_begin(s, end - 1), source->bytes))
        end = end < source->bytes ? line_end(s, end, source->bytes) + 1 : end;
    end = end < source->bytes ? end : source->bytes;
    if (!memchr(s + begin, '$', end - begin) && !memchr(now, '$', bytes))
        return true;
    return begin == a->begin && end == a->end && !reader_mask_is_fenced(s, (int)begin);
}

/* Whether tags in them may hold blocks: where others stand. */
static bool has_holders(const char *s, size_t bytes)
{
    const char *const end = s + bytes;
    for (const char *at = s; (at = memchr(at, '<', (size_t)(end - at))); at++) {
        struct tag tag;
        if (tag_read(at, &tag) && tag_is_block(&tag))
            return true;
    }
    return false;
}

/* Whether nothing in these lines goes on behind them. */
static bool is_plain(const char *s, size_t bytes)
{
    return bytes && s[0] != ' ' && s[0] != '\t' && !has_any(s, bytes, "\r") &&
           !edit_goes_on(s, bytes) && !has_holders(s, bytes);
}

/* Whether fences there are what they are alone to who looks for formulas. */
static bool fences_stand_alone(const struct reader_bytes *source, const struct edit_alone *a,
                               const char *now, size_t bytes)
{
    const char *was = source->text + a->begin;
    const size_t was_bytes = a->end - a->begin;
    if (!has_fence(was, was_bytes) && !has_fence(now, bytes))
        return true;
    return !reader_mask_is_fenced(was, (int)was_bytes) &&
           !reader_mask_is_fenced(now, (int)bytes) &&
           !reader_mask_is_fenced(source->text, (int)a->begin);
}

/* Whether fences end with their list or quote. */
static bool fences_are_nested(const struct reader_document *d)
{
    for (int i = 0; i < d->blocks_count; i++) {
        const struct reader_block *b = &d->blocks[i];
        if ((b->kind == READER_CODE_BLOCK || b->kind == READER_LIVE || b->info) && !b->items &&
            !b->quotes)
            return false;
    }
    return true;
}

/* The same places have the same names. */
static bool labels_stay(const struct reader_document *was, const struct reader_document *now)
{
    bool same = was->labels_count == now->labels_count;
    for (int i = 0; i < was->labels_count && same; i++)
        same = was->labels[i].block == now->labels[i].block &&
               strcmp(was->labels[i].name, now->labels[i].name) == 0;
    same = same && was->note_labels_count == now->note_labels_count;
    for (int i = 0; i < was->note_labels_count && same; i++)
        same = was->note_labels[i].note == now->note_labels[i].note &&
               strcmp(was->note_labels[i].name, now->note_labels[i].name) == 0;
    return same;
}

int edit_note_of(const struct reader_document *d, int source, const struct reader_note *note)
{
    for (int i = 0; i < d->notes_count; i++) {
        const struct reader_note *n = &d->notes[i];
        if (n->blocks_count && d->note_blocks[n->first_block].source == source &&
            strcmp(n->name, note->name) == 0 && strcmp(n->class, note->class) == 0)
            return i;
    }
    return -1;
}

/* By what stands between the brackets. */
static int note_find(const struct reader_document *d, int source, const char *name,
                     size_t bytes)
{
    char whole[128];
    if (bytes >= sizeof whole)
        return -1;
    snprintf(whole, sizeof whole, "%.*s", (int)bytes, name);
    char *colon = strchr(whole, ':');
    if (colon)
        *colon = '\0';
    return edit_note_of(d, source,
                        &(struct reader_note){.name = colon ? colon + 1 : whole,
                                              .class = colon ? whole : whole + strlen(whole)});
}

/* The document's notes that a text calls, each once; false: there is one that it has not, or
 * there are too many. */
static bool names_find(const struct reader_document *d, int source, const char *s, size_t bytes,
                       int names[NAMES], int *count)
{
    for (const char *at = s, *end = s + bytes; (at = memmem(at, (size_t)(end - at), "[^", 2));
         at++) {
        const char *close = memchr(at, ']', (size_t)(end - at));
        const int note = close ? note_find(d, source, at + 2, (size_t)(close - at) - 2) : -1;
        int i = 0;
        while (i < *count && names[i] != note)
            i++;
        if (note < 0 || (i == *count && *count == NAMES))
            return false;
        names[i] = note;
        *count += i == *count;
    }
    return true;
}

/* What is read ahead of lines and behind them. */
struct around {
    char ahead[128];
    char *behind; /* NULL: no memory */
};

static bool around_make(const struct reader_document *d, int source,
                        const struct reader_bytes *bytes, const struct edit_alone *a,
                        const char *now, size_t now_bytes, struct around *out)
{
    const char *s = bytes->text + a->begin;
    int names[NAMES], count = 0;
    size_t behind_bytes, own = 0;
    if (a->notes) {
        own = definition_end(bytes->text, a->begin, bytes->bytes) - a->begin;
        if (own > sizeof out->ahead - 4 || now_bytes < own || memcmp(s, now, own) != 0)
            return false;
        snprintf(out->ahead, sizeof out->ahead, "%.*s\n\n", (int)own - 1, s);
    }
    if (!names_find(d, source, s + own, a->end - a->begin - own, names, &count) ||
        !names_find(d, source, now + own, now_bytes - own, names, &count))
        return false;
    FILE *to = open_memstream(&out->behind, &behind_bytes);
    if (!to)
        return false;
    const bool brackets = memchr(s, '[', a->end - a->begin) || memchr(now, '[', now_bytes);
    const bool good = !brackets || edit_defined(d, source, bytes, a->begin, a->end, to);
    for (int i = 0; i < count; i++) {
        const struct reader_note *n = &d->notes[names[i]];
        if (!a->notes || names[i] != a->note)
            fprintf(to, "\n\n[^%s%s%s]: x\n", n->class, *n->class ? ":" : "", n->name);
    }
    return fclose(to) == 0 && good;
}

/* These lines as a document; NULL: they depend on others, or cannot be read. */
static struct reader_document *lines_read(const char *s, size_t bytes,
                                          const struct around *around)
{
    struct reader_document *d;
    const size_t ahead = strlen(around->ahead), behind = strlen(around->behind);
    char *all = malloc(ahead + bytes + behind + 1);
    if (!all || reader_document_create(&d) != READER_OK) {
        free(all);
        return NULL;
    }
    memcpy(all, around->ahead, ahead);
    memcpy(all + ahead, s, bytes);
    memcpy(all + ahead + bytes, around->behind, behind + 1);
    const bool good = reader_document_add(d, all, ahead + bytes + behind) == READER_OK &&
                      d->blocks_count > 0 &&
                      (!ahead || (d->blocks_count == 1 && d->notes_count > 0));
    free(all);
    if (good)
        return d;
    reader_document_destroy(d);
    return NULL;
}

/* ---- code ---- */

/* The fence that the splice is in; NULL: there is none that could be read alone. */
static const struct reader_block *code_of(const struct reader_document *d, int source,
                                          int first, int last)
{
    for (int i = 0; i < d->blocks_count; i++) {
        const struct reader_block *b = &d->blocks[i];
        const bool fence =
            b->kind == READER_CODE_BLOCK || b->kind == READER_LIVE || b->kind == READER_MATH;
        if (fence && b->source == source && b->first_line < first && b->last_line > last &&
            !b->items && !b->quotes && !b->continues)
            return b;
    }
    return NULL;
}

/* How many signs a fence has that begins there; 0: none does. */
static size_t fence_signs(const char *s, size_t at, size_t bytes)
{
    size_t n = 0;
    while (at + n < bytes && (s[at] == '`' || s[at] == '~') && s[at + n] == s[at])
        n++;
    return n >= 3 ? n : 0;
}

static bool code_find(const struct reader_document *d, const struct reader_bytes *source,
                      const struct edit_splice *splice, struct edit_alone *out)
{
    const char *s = source->text;
    const int first = line_of(source, splice->at),
              last = first + line_ends(s + splice->at, splice->removed);
    const struct reader_block *b = code_of(d, splice->source, first, last);
    int begin, end;
    if (!b)
        return false;
    edit_lines_find(source, b->first_line, b->last_line, &begin, &end);
    const size_t closing = line_begin(s, (size_t)end),
                 signs = fence_signs(s, (size_t)begin, source->bytes),
                 ending = fence_signs(s, closing, source->bytes);
    const size_t content = line_end(s, (size_t)begin, source->bytes) + 1;
    if (!signs || ending < signs || s[closing] != s[begin] ||
        !is_blank_line(s, closing + ending, source->bytes) || closing < content ||
        splice->at < content || splice->at + splice->removed >= closing ||
        (begin > 0 && !is_blank_line(s, line_begin(s, (size_t)begin - 1), source->bytes)))
        return false;
    /* What is between the fences: neither ends them, nor is looked at for formulas. */
    const char *was = s + content;
    const size_t bytes = closing - content;
    if (has_fence(was, bytes) || has_any(was, bytes, "\r") ||
        has_any(splice->text, splice->bytes, "\r"))
        return false;
    out->begin = (size_t)begin;
    out->end = closing + ending;
    out->line = b->first_line;
    out->code = true;
    return true;
}

/* What was between the fences, and is now. */
static bool code_stands_alone(const struct reader_bytes *source, const struct edit_alone *a,
                              const char *now, size_t bytes)
{
    const char *s = source->text;
    const size_t head = line_end(s, a->begin, source->bytes) + 1 - a->begin,
                 foot = a->end - line_begin(s, a->end);
    if (bytes < head + foot || has_fence(now + head, bytes - head - foot))
        return false;
    const bool signs = has_any(s + a->begin + head, a->end - a->begin - head - foot, "$`~") ||
                       has_any(now + head, bytes - head - foot, "$`~");
    return !signs || !reader_mask_is_fenced(s, (int)a->begin);
}

/* ---- reading them ---- */

/* What the lines become. Owns: the caller frees it; NULL: no memory. */
static char *lines_spliced(const char *s, const struct edit_alone *a,
                           const struct edit_splice *splice, size_t *bytes)
{
    const size_t before = splice->at - a->begin, behind = a->end - splice->at - splice->removed;
    *bytes = before + splice->bytes + behind;
    char *now = malloc(*bytes + 1);
    if (!now)
        return NULL;
    memcpy(now, s + a->begin, before);
    if (splice->bytes)
        memcpy(now + before, splice->text, splice->bytes);
    memcpy(now + before + splice->bytes, s + splice->at + splice->removed, behind);
    now[*bytes] = '\0';
    return now;
}

/* Whether the lines say, as they were and as they become, all that there is to know of them. */
static bool stand_alone(const struct reader_document *d, const struct reader_bytes *source,
                        int number, const struct edit_alone *a, const char *now, size_t bytes)
{
    const char *was = source->text + a->begin;
    const size_t was_bytes = a->end - a->begin;
    if (a->code)
        return code_stands_alone(source, a, now, bytes);
    return is_plain(was, was_bytes) && is_plain(now, bytes) &&
           (a->notes || !memmem(now, bytes, "]:", 2)) &&
           fences_stand_alone(source, a, now, bytes) &&
           formulas_stand_alone(source, a, now, bytes) && !strchr(" \t\n", now[0]) &&
           (!is_item(now, 0, bytes) || !list_before(d, number, a->line));
}

static bool documents_read(const struct reader_document *d, const struct reader_bytes *source,
                           int number, struct edit_alone *a, const char *now, size_t bytes)
{
    struct around around = {0};
    if (a->notes) {
        const char *name = source->text + a->begin + 2;
        const size_t end = definition_end(source->text, a->begin, source->bytes);
        a->note = note_find(d, number, name, end - a->begin - 4);
        a->ahead = 2;
        if (a->note < 0)
            return false;
    }
    bool good = stand_alone(d, source, number, a, now, bytes);
    if (good && a->code)
        good = (around.behind = strdup("")) != NULL;
    else if (good)
        good = around_make(d, number, source, a, now, bytes, &around);
    if (good)
        a->was = lines_read(source->text + a->begin, a->end - a->begin, &around);
    if (a->was)
        a->now = lines_read(now, bytes, &around);
    free(around.behind);
    return a->now && (a->code || (labels_stay(a->was, a->now) && fences_are_nested(a->was) &&
                                  fences_are_nested(a->now)));
}

bool edit_alone_read(const struct reader_document *d, const struct reader_bytes *source,
                     const struct edit_splice *splice, struct edit_alone *a)
{
    size_t bytes;
    *a = (struct edit_alone){.note = -1};
    if (!code_find(d, source, splice, a) && !lines_find(d, source, splice, a))
        return false;
    char *now = lines_spliced(source->text, a, splice, &bytes);
    const bool good = now && bytes && documents_read(d, source, splice->source, a, now, bytes);
    a->more =
        now ? line_ends(now, bytes) - line_ends(source->text + a->begin, a->end - a->begin) : 0;
    free(now);
    return good;
}

void edit_alone_finish(struct edit_alone *a)
{
    reader_document_destroy(a->was);
    reader_document_destroy(a->now);
}
