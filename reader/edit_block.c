/* edit_block.c - one block that is edited, set in place of the one that it was: see
 * edit_internal.h.
 *
 * The lines around it from one blank line to another, a whole list, quote or table, are read
 * alone, as they were and as they become. What they are in the document does not depend on what
 * stands before and behind them where
 *   - the line before is blank, and the first one is moved in by nothing, so that it ends all
 *     that was open; it is no item where a list stands before;
 *   - a blank line follows, then one that is moved in by nothing, and no item behind a list;
 *   - there are no fences, tags and formulas, and no brackets where anything in the source
 *     defines what they mean.
 * Where what was read alone is not what the document has, or more than one block becomes
 * another, all files are read again. */
#include "builder.h"
#include "edit_internal.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { LINES_BYTES_MOST = 64 << 10 }; /* of what is read alone: more is hardly faster */

static bool is_blank_line(const char *s, size_t at, size_t bytes)
{
    while (at < bytes && (s[at] == ' ' || s[at] == '\t'))
        at++;
    return at == bytes || s[at] == '\n';
}

/* Whether nothing in these lines depends on what is elsewhere. brackets: they may have some. */
static bool is_plain(const char *s, size_t bytes, bool brackets)
{
    if (!bytes || s[0] == ' ' || s[0] == '\t')
        return false;
    for (size_t i = 0; i < bytes; i++) {
        if (strchr("<$\r", s[i]) || (s[i] == '[' && !brackets))
            return false;
        if ((s[i] == '`' || s[i] == '~') && i + 2 < bytes && s[i + 1] == s[i] &&
            s[i + 2] == s[i])
            return false;
    }
    return true;
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

/* These lines as a document; NULL: they depend on others, or cannot be read. */
static struct reader_document *lines_read(const char *s, size_t bytes, bool brackets)
{
    struct reader_document *d;
    if (!is_plain(s, bytes, brackets) || reader_document_create(&d) != READER_OK)
        return NULL;
    if (reader_document_add(d, s, bytes) == READER_OK && d->blocks_count > 0 &&
        !d->notes_count && !d->labels_count)
        return d;
    reader_document_destroy(d);
    return NULL;
}

static int line_of(const struct reader_bytes *source, size_t at)
{
    int line = 1;
    for (const char *s = source->text, *stop = s + at;
         (s = memchr(s, '\n', (size_t)(stop - s))); s++)
        line++;
    return line;
}

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

static bool is_once(const struct reader_files *files, int source)
{
    for (int i = 0; i < files->count; i++)
        if (i != source && files->whole[i] && files->whole[source] &&
            strcmp(files->whole[i], files->whole[source]) == 0)
            return false;
    return true;
}

/* ---- in place ---- */

static bool bytes_replace(char **text, size_t *bytes, size_t at, size_t removed,
                          const char *with, size_t with_bytes)
{
    const size_t now = *bytes - removed + with_bytes;
    if (now > *bytes) {
        char *more = realloc(*text, now + 1);
        if (!more)
            return false;
        *text = more;
    }
    memmove(*text + at + with_bytes, *text + at + removed, *bytes - at - removed + 1);
    if (with_bytes)
        memcpy(*text + at, with, with_bytes);
    *bytes = now;
    return true;
}

static void blocks_shift(struct reader_block *blocks, int count, int source, int line,
                         int lines, size_t at, size_t removed, size_t inserted)
{
    for (int i = 0; i < count; i++) {
        if (blocks[i].at > at)
            blocks[i].at = blocks[i].at - removed + inserted;
        if (blocks[i].source == source && blocks[i].first_line > line) {
            blocks[i].first_line += lines;
            blocks[i].last_line += lines;
        }
    }
}

/* The document has the block of another one in place of its own. */
static bool block_take(struct reader_document *d, int block, struct reader_block *now,
                       int lines)
{
    struct reader_block *b = &d->blocks[block];
    const size_t removed = (size_t)b->bytes, inserted = (size_t)now->bytes;
    const int line = b->first_line;
    if (!bytes_replace(&d->plain, &d->plain_bytes, b->at, removed, now->text, inserted))
        return false;
    struct reader_block taken = *now;
    taken.source = b->source;
    taken.at = b->at;
    taken.table = b->table;
    taken.first_line = line;
    taken.last_line = b->last_line + lines;
    *now = *b;
    *b = taken;
    blocks_shift(d->blocks, d->blocks_count, b->source, line, lines, b->at, removed, inserted);
    blocks_shift(d->note_blocks, d->note_blocks_count, b->source, line, lines, b->at, removed,
                 inserted);
    for (int i = 0; i < d->lost_count; i++)
        if (d->lost[i].source == b->source && d->lost[i].line > line)
            d->lost[i].line += lines;
    return b->kind != READER_HEADING || reader_labels_again(d) == READER_OK;
}

/* ---- trying ---- */

struct alone {
    size_t begin, end; /* its lines, with blank ones behind them */
    int line;          /* the first of them */
    int first;         /* block of the document's; those of `was` are it and the next ones */
    struct reader_document *was, *now;
    int changed; /* of their blocks */
    int lines;   /* by so many it has more */
};

static void alone_finish(struct alone *a)
{
    reader_document_destroy(a->was);
    reader_document_destroy(a->now);
}

/* Whether all that was open ends at the line, which begins something. */
static bool begins_at(const struct reader_document *d, int source, const char *s, size_t at,
                      size_t bytes, int line)
{
    size_t before = at;
    if (at >= bytes || strchr(" \t\n", s[at]))
        return false;
    if (at > 0) {
        for (before--; before > 0 && s[before - 1] != '\n';)
            before--;
        if (!is_blank_line(s, before, bytes))
            return false;
    }
    return !is_item(s, at, bytes) || !list_before(d, source, line);
}

/* Whether all ends with the line that ends there. */
static bool ends_at(const struct reader_document *d, int source, const char *s, size_t at,
                    size_t bytes, int line)
{
    if (at >= bytes)
        return true;
    size_t next = at + 1;
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

static int line_ends(const char *text, size_t bytes)
{
    int count = 0;
    for (size_t i = 0; i < bytes; i++)
        count += text[i] == '\n';
    return count;
}

/* The lines around the splice that stand alone. */
static bool lines_find(const struct reader_document *d, const struct reader_bytes *source,
                       const struct edit_splice *splice, struct alone *out)
{
    const char *s = source->text;
    size_t begin = splice->at, end = splice->at + splice->removed;
    while (begin > 0 && s[begin - 1] != '\n')
        begin--;
    while (end < source->bytes && s[end] != '\n')
        end++;
    out->line = line_of(source, begin);
    int last = out->line + line_ends(s + begin, end - begin);
    while (!begins_at(d, splice->source, s, begin, source->bytes, out->line)) {
        if (begin == 0 || end - begin > LINES_BYTES_MOST)
            return false;
        for (begin--; begin > 0 && s[begin - 1] != '\n';)
            begin--;
        out->line--;
    }
    for (; !ends_at(d, splice->source, s, end, source->bytes, last); last++) {
        if (end - begin > LINES_BYTES_MOST)
            return false;
        for (end++; end < source->bytes && s[end] != '\n';)
            end++;
    }
    out->begin = begin;
    while (end < source->bytes && is_blank_line(s, end + 1, source->bytes)) /* cmark-gfm */
        for (end++; end < source->bytes && s[end] != '\n';) /* counts them as a heading's */
            end++;
    out->end = end < source->bytes ? end + 1 : end;
    return true;
}

static bool is_same_text(const char *a, const char *b)
{
    return (!a && !b) || (a && b && strcmp(a, b) == 0);
}

/* Whether two blocks are of one kind and stand alike, whatever they say. */
static bool stand_alike(const struct reader_block *a, const struct reader_block *b)
{
    return a->kind == b->kind && a->level == b->level && a->items == b->items &&
           a->quotes == b->quotes && is_same_text(a->marker, b->marker) && !a->continues &&
           !b->continues && is_same_text(a->info, b->info) &&
           is_same_text(a->target, b->target) && !a->include && !b->include &&
           reader_beside_same(&a->beside, &b->beside) && a->head == b->head &&
           a->columns == b->columns && a->number == b->number &&
           (a->kind != READER_ROW || memcmp(a->aligns, b->aligns, sizeof a->aligns) == 0);
}

static bool say_alike(const struct reader_block *a, const struct reader_block *b)
{
    bool same = a->bytes == b->bytes && a->spans_count == b->spans_count &&
                (!a->bytes || memcmp(a->text, b->text, (size_t)a->bytes) == 0);
    for (int i = 0; i < a->spans_count && same; i++) {
        const struct reader_span *x = &a->spans[i], *y = &b->spans[i];
        same = x->begin == y->begin && x->end == y->end && x->look == y->look &&
               x->note == y->note && is_same_text(x->target, y->target);
    }
    return same;
}

/* The blocks of these lines are, in the document, what they are alone. */
static bool is_as_alone(const struct reader_document *d, int source, struct alone *a)
{
    const int count = a->was->blocks_count;
    const int last = a->line + a->was->blocks[count - 1].last_line - 1;
    a->first = -1;
    for (int i = 0; i < d->blocks_count && a->first < 0; i++)
        if (d->blocks[i].source == source && d->blocks[i].last_line >= a->line)
            a->first = i;
    if (a->first < 0 || a->first + count > d->blocks_count)
        return false;
    for (int i = 0; i < count; i++) {
        const struct reader_block *x = &d->blocks[a->first + i], *y = &a->was->blocks[i];
        if (x->source != source || x->first_line != y->first_line + a->line - 1 ||
            x->last_line != y->last_line + a->line - 1 || !stand_alike(x, y) ||
            !say_alike(x, y))
            return false;
    }
    for (int i = 0; i < d->blocks_count; i++) /* no other one has to do with them */
        if ((i < a->first || i >= a->first + count) && d->blocks[i].source == source &&
            d->blocks[i].last_line >= a->line && d->blocks[i].first_line <= last)
            return false;
    for (int i = 0; i < d->note_blocks_count; i++)
        if (d->note_blocks[i].source == source && d->note_blocks[i].last_line >= a->line &&
            d->note_blocks[i].first_line <= last)
            return false;
    return true;
}

/* One block says something else, the others are what they were. */
static bool one_changed(struct alone *a)
{
    const int count = a->was->blocks_count;
    a->changed = count == 1 ? 0 : -1;
    if (a->now->blocks_count != count || a->now->tables_count != a->was->tables_count)
        return false;
    for (int i = 0; i < count; i++) {
        const struct reader_block *x = &a->was->blocks[i], *y = &a->now->blocks[i];
        if (!stand_alike(x, y) || x->table != y->table)
            return false;
        if (say_alike(x, y) && x->last_line - x->first_line == y->last_line - y->first_line)
            continue;
        if (a->changed > 0 || (a->changed == 0 && count > 1))
            return false;
        a->changed = i;
    }
    if (a->changed < 0)
        return false;
    a->lines = a->now->blocks[a->changed].last_line - a->was->blocks[a->changed].last_line;
    for (int i = 0; i < count; i++) {
        const struct reader_block *x = &a->was->blocks[i], *y = &a->now->blocks[i];
        if (y->first_line - x->first_line != (i > a->changed ? a->lines : 0) ||
            y->last_line - x->last_line != (i < a->changed ? 0 : a->lines))
            return false;
    }
    return true;
}

/* The next span from *i on that leads to another place of the documents than the one before;
 * NULL: there is none. */
static const char *place_next(const struct reader_block *b, int *i, const char *before)
{
    for (; *i < b->spans_count; ++*i) {
        const char *target = b->spans[*i].target;
        if (target && strchr(target, '#') && !is_same_text(target, before))
            return target;
    }
    return NULL;
}

/* Links that lead to other places now, and references, have to do with other blocks. */
static bool links_stay(const struct reader_block *was, const struct reader_block *now)
{
    const char *a = NULL, *b = NULL;
    int i = 0, k = 0;
    do {
        a = place_next(was, &i, a);
        b = place_next(now, &k, b);
        if (!is_same_text(a, b))
            return false;
    } while (a);
    for (k = 0; k < now->spans_count; k++) {
        const struct reader_span *s = &now->spans[k];
        if (s->target && s->target[0] == '#' &&
            memchr(now->text + s->begin, '#', (size_t)(s->end - s->begin)))
            return false;
    }
    return true;
}

/* A heading's name, and the order of a bibliography's entries, have to do with other blocks. */
static bool has_others(const struct reader_document *d, int source, const struct alone *a)
{
    const struct reader_block *was = &a->was->blocks[a->changed],
                              *now = &a->now->blocks[a->changed];
    if (was->kind == READER_HEADING)
        return d->references || reader_document_label(d, "bibliography", -1) ||
               strcasestr(now->text, "bibliography");
    return was->items && reader_document_label(d, "bibliography", source);
}

/* What the lines become. Owns: the caller frees it; NULL: no memory. */
static char *lines_spliced(const char *s, const struct alone *a,
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

static bool alone_find(const struct reader_document *d, const struct reader_files *files,
                       const struct edit_splice *splice, struct alone *a)
{
    const struct reader_bytes *source = &files->texts[splice->source];
    size_t bytes;
    *a = (struct alone){0};
    if (!is_once(files, splice->source) || !lines_find(d, source, splice, a))
        return false;
    char *now = lines_spliced(source->text, a, splice, &bytes);
    if (!now)
        return false;
    const bool brackets =
        (memchr(now, '[', bytes) || memchr(source->text + a->begin, '[', a->end - a->begin)) &&
        !memmem(source->text, source->bytes, "]:", 2) && !strstr(now, "]:");
    a->was = lines_read(source->text + a->begin, a->end - a->begin, brackets);
    if (a->was && is_as_alone(d, splice->source, a) && bytes && !strchr(" \t\n", now[0]) &&
        (!is_item(now, 0, bytes) || !list_before(d, splice->source, a->line)))
        a->now = lines_read(now, bytes, brackets);
    const int more =
        line_ends(now, bytes) - line_ends(source->text + a->begin, a->end - a->begin);
    free(now);
    return a->now && one_changed(a) && a->lines == more &&
           (a->was->blocks[a->changed].kind == READER_PARAGRAPH ||
            a->was->blocks[a->changed].kind == READER_HEADING ||
            a->was->blocks[a->changed].kind == READER_ROW) &&
           links_stay(&a->was->blocks[a->changed], &a->now->blocks[a->changed]) &&
           !has_others(d, splice->source, a);
}

static bool alone_move(struct reader_edit_change *change, const struct reader_block *b,
                       const struct reader_block *now, const struct edit_meant *meant)
{
    const size_t removed = meant->end - meant->begin;
    if (!meant->any && (size_t)now->bytes + removed == (size_t)b->bytes + meant->bytes)
        return edit_move_add(change, meant->begin, removed, meant->bytes);
    int begin = 0, end = 0;
    const int least = b->bytes < now->bytes ? b->bytes : now->bytes;
    while (begin < least && b->text[begin] == now->text[begin])
        begin++;
    while (end < least - begin &&
           b->text[b->bytes - 1 - end] == now->text[now->bytes - 1 - end])
        end++;
    return edit_move_add(change, b->at + (size_t)begin, (size_t)(b->bytes - begin - end),
                         (size_t)(now->bytes - begin - end));
}

enum reader_status edit_block_try(struct reader_document *d, struct reader_files *files,
                                  const struct edit_splice *splice,
                                  const struct edit_meant *meant,
                                  struct reader_edit_change *change, bool *done)
{
    struct reader_bytes *source = &files->texts[splice->source];
    struct alone alone = {0};
    *done = false;
    if (source->bytes - splice->removed + splice->bytes > READER_BYTES_MAX ||
        !alone_find(d, files, splice, &alone)) {
        alone_finish(&alone);
        return READER_OK;
    }
    const int block = alone.first + alone.changed;
    const struct reader_block *b = &d->blocks[block];
    struct reader_block *now = &alone.now->blocks[alone.changed];
    const struct edit_meant own = {.begin = meant->begin - b->at,
                                   .end = meant->end - b->at,
                                   .text = meant->text,
                                   .bytes = meant->bytes};
    const bool within = meant->begin >= b->at && meant->end <= b->at + (size_t)b->bytes;
    bool good = true;
    if (meant->any || (within && edit_meant_text(b->text, (size_t)b->bytes, &own, now->text,
                                                 (size_t)now->bytes))) {
        good = alone_move(change, b, now, meant) &&
               bytes_replace(&source->text, &source->bytes, splice->at, splice->removed,
                             splice->text, splice->bytes);
        if (good) {
            files->bytes += files->from[splice->source] >= 0
                                ? (double)splice->bytes - (double)splice->removed
                                : 0;
            good = block_take(d, block, now, alone.lines);
        }
        change->block = block;
        *done = good;
    }
    alone_finish(&alone);
    return good ? READER_OK : reader_fail(READER_NO_MEMORY, "no memory for an edit");
}
