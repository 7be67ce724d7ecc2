/* edit_block.c - one block that is edited, set in place of the one that it was: see
 * edit_internal.h.
 *
 * The lines around it are read alone, as they were and as they become (edit_alone.c). Where
 * what was read alone is not what the document has, or more than one block becomes another, all
 * files are read again. */
#include "builder.h"
#include "edit_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

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
static bool block_take(struct reader_document *d, struct reader_block *b,
                       struct reader_block *now, int lines)
{
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

/* ---- what was read alone ---- */

/* Of one document: those of its flow, or of a note. */
struct blocks {
    struct reader_block *all;
    int count;
};

static struct blocks blocks_of(const struct reader_document *alone, bool notes)
{
    return notes ? (struct blocks){alone->note_blocks, alone->notes[0].blocks_count}
                 : (struct blocks){alone->blocks, alone->blocks_count};
}

static bool is_same_text(const char *a, const char *b)
{
    return (!a && !b) || (a && b && strcmp(a, b) == 0);
}

/* Whether two blocks are of one kind and stand alike, whatever they say. */
static bool stand_alike(const struct reader_block *a, const struct reader_block *b)
{
    return a->kind == b->kind && a->align == b->align && a->level == b->level &&
           a->items == b->items && a->quotes == b->quotes &&
           is_same_text(a->marker, b->marker) && !a->continues && !b->continues &&
           is_same_text(a->info, b->info) && is_same_text(a->target, b->target) &&
           !a->include && !b->include && reader_beside_same(&a->beside, &b->beside) &&
           reader_asked_same(&a->asked, &b->asked) && a->head == b->head &&
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
               x->note == y->note && reader_asked_same(&x->asked, &y->asked) &&
               is_same_text(x->target, y->target);
    }
    return same;
}

/* Calls of notes have the document's numbers in place of their own. False: no memory, or a
 * note that the document has not. */
static bool calls_number(struct reader_block *b, const struct reader_document *alone,
                         const struct reader_document *d, int source)
{
    size_t bytes;
    char *text = NULL;
    FILE *to = open_memstream(&text, &bytes);
    bool good = to != NULL;
    for (int i = 0; i < b->spans_count && good; i++) {
        struct reader_span *s = &b->spans[i];
        const int begin = (int)ftell(to);
        if (s->look & READER_NOTE) {
            const struct reader_note *n = &alone->notes[s->note];
            s->note = edit_note_of(d, source, n);
            good = s->note >= 0;
            fprintf(to, "%d", s->note + 1);
        } else {
            fwrite(b->text + s->begin, 1, (size_t)(s->end - s->begin), to);
        }
        s->begin = begin;
        s->end = (int)ftell(to);
    }
    if (!to || fclose(to) != 0 || !good) {
        free(text);
        return false;
    }
    free(b->text);
    b->text = text;
    b->bytes = (int)bytes;
    return bytes < READER_PASSAGE_BYTES; /* where it is cut, its numbers count */
}

static bool all_number(struct reader_document *alone, bool notes,
                       const struct reader_document *d, int source)
{
    const struct blocks own = blocks_of(alone, notes);
    bool good = true;
    for (int i = 0; i < own.count && good; i++) {
        bool calls = false;
        for (int k = 0; k < own.all[i].spans_count; k++)
            calls = calls || (own.all[i].spans[k].look & READER_NOTE);
        good = !calls || calls_number(&own.all[i], alone, d, source);
    }
    return good;
}

/* No block but these has to do with lines first..last. */
static bool no_other(const struct reader_block *blocks, int count, int source, int first,
                     int last, int begin, int end)
{
    for (int i = 0; i < count; i++)
        if ((i < begin || i >= end) && blocks[i].source == source &&
            blocks[i].last_line >= first && blocks[i].first_line <= last)
            return false;
    return true;
}

/* The blocks of these lines are, in the document, what they are alone. */
static bool is_as_alone(const struct reader_document *d, int source, struct edit_alone *a)
{
    const struct blocks was = blocks_of(a->was, a->notes),
                        own = a->notes ? (struct blocks){d->note_blocks, d->note_blocks_count}
                                       : (struct blocks){d->blocks, d->blocks_count};
    const int count = was.count, from = a->line - 1 - a->ahead;
    a->first = a->notes ? d->notes[a->note].first_block : -1;
    for (int i = 0; i < own.count && a->first < 0; i++)
        if (own.all[i].source == source && own.all[i].last_line >= a->line)
            a->first = i;
    if (!count || a->first < 0 || a->first + count > own.count ||
        (a->notes && d->notes[a->note].blocks_count != count))
        return false;
    for (int i = 0; i < count; i++) {
        const struct reader_block *x = &own.all[a->first + i], *y = &was.all[i];
        if (x->source != source || x->first_line != y->first_line + from ||
            x->last_line != y->last_line + from || !stand_alike(x, y) || !say_alike(x, y))
            return false;
    }
    const int last = was.all[count - 1].last_line + from, end = a->first + count;
    return no_other(d->blocks, d->blocks_count, source, a->line, last, a->notes ? 0 : a->first,
                    a->notes ? 0 : end) &&
           no_other(d->note_blocks, d->note_blocks_count, source, a->line, last,
                    a->notes ? a->first : 0, a->notes ? end : 0);
}

/* One block says something else, the others are what they were. */
static bool one_changed(struct edit_alone *a)
{
    const struct blocks was = blocks_of(a->was, a->notes), now = blocks_of(a->now, a->notes);
    const int count = was.count;
    a->changed = count == 1 ? 0 : -1;
    if (now.count != count || a->now->tables_count != a->was->tables_count ||
        a->now->notes_count != a->was->notes_count)
        return false;
    for (int i = 0; i < count; i++) {
        const struct reader_block *x = &was.all[i], *y = &now.all[i];
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
    a->lines = now.all[a->changed].last_line - was.all[a->changed].last_line;
    for (int i = 0; i < count; i++) {
        const struct reader_block *x = &was.all[i], *y = &now.all[i];
        if (y->first_line - x->first_line != (i > a->changed ? a->lines : 0) ||
            y->last_line - x->last_line != (i < a->changed ? 0 : a->lines))
            return false;
    }
    return a->lines == a->more;
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
        if (s->target && strchr(s->target, '#') &&
            memchr(now->text + s->begin, '#', (size_t)(s->end - s->begin)))
            return false;
    }
    return true;
}

/* The same notes are called, one after the other: so all have their numbers still. */
static bool calls_stay(const struct reader_block *was, const struct reader_block *now)
{
    int i = 0, k = 0;
    for (;; i++, k++) {
        while (i < was->spans_count && !(was->spans[i].look & READER_NOTE))
            i++;
        while (k < now->spans_count && !(now->spans[k].look & READER_NOTE))
            k++;
        if (i == was->spans_count || k == now->spans_count)
            return i == was->spans_count && k == now->spans_count;
        if (was->spans[i].note != now->spans[k].note)
            return false;
    }
}

/* A heading's name, and the order of a bibliography's entries, have to do with other blocks. */
static bool has_others(const struct reader_document *d, int source,
                       const struct reader_block *was, const struct reader_block *now)
{
    if (was->kind == READER_HEADING)
        return d->references || reader_document_label(d, "bibliography", -1) ||
               strcasestr(now->text, "bibliography");
    return was->items && reader_document_label(d, "bibliography", source);
}

static bool can_be_taken(enum reader_kind kind)
{
    return kind == READER_PARAGRAPH || kind == READER_HEADING || kind == READER_ROW ||
           kind == READER_CODE_BLOCK || kind == READER_LIVE || kind == READER_MATH;
}

static bool alone_find(const struct reader_document *d, const struct reader_files *files,
                       const struct edit_splice *splice, struct edit_alone *a)
{
    const int source = splice->source;
    *a = (struct edit_alone){0};
    if (!is_once(files, source) || !edit_alone_read(d, &files->texts[source], splice, a) ||
        !all_number(a->was, a->notes, d, source) || !all_number(a->now, a->notes, d, source) ||
        !is_as_alone(d, source, a) || !one_changed(a))
        return false;
    const struct reader_block *was = &blocks_of(a->was, a->notes).all[a->changed],
                              *now = &blocks_of(a->now, a->notes).all[a->changed];
    return can_be_taken(was->kind) && links_stay(was, now) && calls_stay(was, now) &&
           !has_others(d, source, was, now);
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

static bool is_within(const struct reader_block *b, const struct edit_meant *meant)
{
    return meant->begin >= b->at && meant->end <= b->at + (size_t)b->bytes;
}

/* Whether it is what is meant. */
static bool is_meant(const struct reader_block *b, const struct reader_block *now,
                     const struct edit_meant *meant)
{
    const struct edit_meant own = {.begin = meant->begin - b->at,
                                   .end = meant->end - b->at,
                                   .text = meant->text,
                                   .bytes = meant->bytes};
    return meant->any ||
           (is_within(b, meant) &&
            edit_meant_text(b->text, (size_t)b->bytes, &own, now->text, (size_t)now->bytes));
}

enum reader_status edit_block_try(struct reader_document *d, struct reader_files *files,
                                  const struct edit_splice *splice,
                                  const struct edit_meant *meant,
                                  struct reader_edit_change *change, bool *done)
{
    struct reader_bytes *source = &files->texts[splice->source];
    struct edit_alone alone = {0};
    *done = false;
    if (source->bytes - splice->removed + splice->bytes > READER_BYTES_MAX ||
        !alone_find(d, files, splice, &alone)) {
        edit_alone_finish(&alone);
        return READER_OK;
    }
    const int block = alone.first + alone.changed;
    struct reader_block *b = alone.notes ? &d->note_blocks[block] : &d->blocks[block];
    struct reader_block *now = &blocks_of(alone.now, alone.notes).all[alone.changed];
    bool good = true;
    if (is_meant(b, now, meant)) {
        good = alone_move(change, b, now, meant) &&
               bytes_replace(&source->text, &source->bytes, splice->at, splice->removed,
                             splice->text, splice->bytes);
        if (good) {
            files->bytes += files->from[splice->source] >= 0
                                ? (double)splice->bytes - (double)splice->removed
                                : 0;
            good = block_take(d, b, now, alone.lines);
        }
        change->block = alone.notes ? d->blocks_count + block : block;
        *done = good;
    } else if (is_within(b, meant)) { /* nor is it when all is read */
        edit_alone_finish(&alone);
        return reader_fail(READER_BAD_ARGUMENT, "it would be read as something else");
    }
    edit_alone_finish(&alone);
    return good ? READER_OK : reader_fail(READER_NO_MEMORY, "no memory for an edit");
}
