/* edit.c - a change of a source's bytes, what it takes along, and undo: see reader_edit.h. */
#include "anchor_internal.h"
#include "edit_internal.h"

#include <stdlib.h>
#include <string.h>

static enum reader_status no_memory(void)
{
    return reader_fail(READER_NO_MEMORY, "no memory for an edit");
}

enum reader_status reader_edit_create(struct reader_document **document,
                                      struct reader_files *files,
                                      struct reader_remarks *remarks, struct reader_edit **out)
{
    *out = NULL;
    if (!files->keep || !(*document)->plain)
        return reader_fail(READER_BAD_ARGUMENT, "the files' bytes are not kept");
    struct reader_edit *e = calloc(1, sizeof *e);
    if (!e)
        return no_memory();
    e->document = document;
    e->files = files;
    e->remarks = remarks;
    *out = e;
    return READER_OK;
}

static void done_finish(struct edit_done *done)
{
    free(done->removed);
    free(done->inserted);
    free(done->moves);
    free(done->touched[0]);
    free(done->touched[1]);
}

void reader_edit_destroy(struct reader_edit *e)
{
    if (!e)
        return;
    for (int i = 0; i < e->done_count; i++)
        done_finish(&e->done[i]);
    free(e->done);
    free(e);
}

/* ---- all files anew ---- */

static char *spliced(const struct reader_bytes *source, const struct edit_splice *s,
                     size_t *bytes)
{
    *bytes = source->bytes - s->removed + s->bytes;
    char *text = malloc(*bytes + 1);
    if (!text)
        return NULL;
    memcpy(text, source->text, s->at);
    if (s->bytes)
        memcpy(text + s->at, s->text, s->bytes);
    memcpy(text + s->at + s->bytes, source->text + s->at + s->removed,
           source->bytes - s->at - s->removed + 1);
    return text;
}

/* Sources of one file have one text. */
static bool is_of(const struct reader_files *files, int i, int source)
{
    return i == source || (files->whole[i] && files->whole[source] &&
                           strcmp(files->whole[i], files->whole[source]) == 0);
}

static enum reader_status all_read(struct reader_files *held, struct reader_files *files,
                                   struct reader_document **out)
{
    enum reader_status status = reader_document_create(out);
    *files = (struct reader_files){.keep = true, .held = held};
    for (int i = 0; i < held->count && status == READER_OK; i++)
        if (held->from[i] < 0)
            status = reader_files_add(files, *out, held->paths[i], held->texts[i].text,
                                      held->texts[i].bytes);
    if (status == READER_OK)
        status = reader_files_refer(files, *out);
    if (status == READER_OK)
        status = reader_document_plain(*out);
    files->held = NULL;
    return status;
}

static bool same_files(const struct reader_files *a, const struct reader_files *b)
{
    bool same = a->count == b->count;
    for (int i = 0; i < a->count && same; i++)
        same = a->from[i] == b->from[i] && strcmp(a->paths[i], b->paths[i]) == 0;
    return same;
}

/* Where paragraphs are cut for their length may be elsewhere now. */
static bool has_cuts(const struct reader_document *d)
{
    for (int i = 1; i < d->blocks_count; i++)
        if (reader_block_is_cut_off(&d->blocks[i]))
            return true;
    return false;
}

static enum reader_status all_moves(const struct reader_document *before,
                                    const struct edit_meant *meant,
                                    const struct reader_document *now,
                                    struct reader_edit_change *change)
{
    const size_t removed = meant->end - meant->begin;
    const bool exact = !meant->any && !has_cuts(before) && !has_cuts(now) &&
                       now->plain_bytes + removed == before->plain_bytes + meant->bytes &&
                       edit_meant_text(before->plain, before->plain_bytes, meant, now->plain,
                                       now->plain_bytes);
    return (exact ? edit_move_add(change, meant->begin, removed, meant->bytes)
                  : edit_moves_find(before, now, change))
               ? READER_OK
               : no_memory();
}

/* Its text is that of all sources of the file; gives the one that there was. */
static void texts_swap(struct reader_files *files, int source, char **text, size_t *bytes)
{
    const struct reader_bytes before = files->texts[source];
    files->texts[source] = (struct reader_bytes){*text, *bytes};
    *text = before.text;
    *bytes = before.bytes;
}

static enum reader_status all_try(struct reader_edit *e, const struct edit_splice *splice,
                                  const struct edit_meant *meant,
                                  struct reader_edit_change *change, bool *done)
{
    struct reader_files *files = e->files, now = {0};
    struct reader_document *document = NULL;
    char **others = calloc((size_t)files->count, sizeof *others);
    size_t *others_bytes = calloc((size_t)files->count, sizeof *others_bytes);
    enum reader_status status = others && others_bytes ? READER_OK : no_memory();
    for (int i = 0; i < files->count && status == READER_OK; i++)
        if (is_of(files, i, splice->source)) {
            others[i] = spliced(&files->texts[i], splice, &others_bytes[i]);
            status = others[i] ? READER_OK : no_memory();
        }
    for (int i = 0; i < files->count && status == READER_OK; i++)
        if (others[i])
            texts_swap(files, i, &others[i], &others_bytes[i]);
    const bool swapped = status == READER_OK;
    if (swapped)
        status = all_read(files, &now, &document);
    if (status == READER_OK && !same_files(files, &now))
        status =
            reader_fail(READER_BAD_ARGUMENT, "with this edit other files would be included: "
                                             "make it in another editor");
    *done = status == READER_OK && edit_meant_document(*e->document, meant, document);
    if (*done)
        status = all_moves(*e->document, meant, document, change);
    *done = *done && status == READER_OK;
    if (*done) {
        change->before = *e->document;
        *e->document = document;
        reader_files_finish(files);
        *files = now;
    } else {
        for (int i = 0; i < files->count && swapped; i++)
            if (others[i])
                texts_swap(files, i, &others[i], &others_bytes[i]);
        reader_document_destroy(document);
        reader_files_finish(&now);
    }
    for (int i = 0; others && i < files->count; i++)
        free(others[i]);
    free(others);
    free(others_bytes);
    return status;
}

/* ---- remarks ---- */

static bool loses_letters(const struct reader_remark_place *r,
                          const struct reader_edit_change *change)
{
    size_t begin = r->begin, end = r->end;
    for (int k = 0; k < change->moves_count && !r->orphan; k++) {
        const struct reader_edit_move *m = &change->moves[k];
        if (m->removed && m->at <= end && m->at + m->removed >= begin)
            return true;
        anchor_range_edit(&begin, &end, m->at, m->removed, m->inserted);
    }
    return false;
}

/* Keeps where remarks were that lose letters. Without memory for that they come back when the
 * text is found again. */
static void touched_keep(struct reader_edit *e, const struct reader_edit_change *change,
                         struct reader_remark_place **out, int *count)
{
    const int all = e->remarks ? reader_remarks_count(e->remarks) : 0;
    int capacity = 0;
    *out = NULL;
    *count = 0;
    for (int i = 0; i < all; i++) {
        const struct reader_remark_place place = reader_remarks_place_of(e->remarks, i);
        if (!loses_letters(&place, change))
            continue;
        if (!array_reserve(out, &capacity, *count + 1, sizeof **out))
            return;
        (*out)[(*count)++] = place;
    }
}

static void remarks_move(struct reader_edit *e, const struct reader_edit_change *change)
{
    for (int k = 0; k < change->moves_count && e->remarks; k++)
        reader_remarks_edit(e->remarks, change->moves[k].at, change->moves[k].removed,
                            change->moves[k].inserted);
}

/* ---- trying ---- */

/* Where the caret is in the text that was read: behind the letters that were meant to be before
 * it. before: what was there, where all has been read again; else NULL. */
static size_t caret_now(const struct reader_document *before, const struct reader_document *now,
                        const struct edit_meant *meant)
{
    const size_t caret = meant->caret < now->plain_bytes ? meant->caret : now->plain_bytes;
    if (!before || meant->any || meant->caret != meant->begin + meant->bytes ||
        (!has_cuts(before) && !has_cuts(now)))
        return caret;
    size_t letters = 0, at = 0;
    for (size_t i = 0; i < meant->begin; i++)
        letters += before->plain[i] != ' ';
    for (size_t i = 0; i < meant->bytes; i++)
        letters += meant->text[i] != ' ';
    for (; at < now->plain_bytes && letters > 0; at++)
        letters -= now->plain[at] != ' ';
    const char last = meant->bytes   ? meant->text[meant->bytes - 1]
                      : meant->begin ? before->plain[meant->begin - 1]
                                     : '\n';
    while (last == ' ' && at < now->plain_bytes && now->plain[at] == ' ')
        at++;
    return at;
}

static enum reader_status splice_do(struct reader_edit *e, const struct edit_splice *splice,
                                    const struct edit_meant *meant,
                                    struct reader_edit_change *change, bool *done)
{
    *change = (struct reader_edit_change){.block = -1};
    enum reader_status status =
        edit_block_try(*e->document, e->files, splice, meant, change, done);
    if (status == READER_OK && !*done)
        status = all_try(e, splice, meant, change, done);
    if (!*done)
        reader_edit_change_finish(change);
    return status;
}

static bool moves_join(struct edit_done *done, const struct reader_edit_change *change)
{
    const size_t all = (size_t)(done->moves_count + change->moves_count);
    struct reader_edit_move *more = realloc(done->moves, (all + 1) * sizeof *more);
    if (!more)
        return false;
    done->moves = more;
    for (int i = 0; i < change->moves_count; i++) {
        const struct reader_edit_move *m = &change->moves[i];
        struct reader_edit_move *last = done->moves_count ? &more[done->moves_count - 1] : NULL;
        if (last && !last->removed && !m->removed && last->at + last->inserted == m->at)
            last->inserted += m->inserted;
        else
            more[done->moves_count++] = *m;
    }
    return true;
}

/* What is typed on is undone together. */
static bool typed_join(struct reader_edit *e, const struct edit_splice *splice,
                       const struct edit_meant *meant, const struct reader_edit_change *change)
{
    struct edit_done *last = e->at == e->done_count && e->at ? &e->done[e->at - 1] : NULL;
    if (!last || e->part || !meant->typed || !last->typed || splice->removed ||
        last->source != splice->source || last->at + last->inserted_bytes != splice->at ||
        (e->group != 0 && last->group != e->group))
        return false;
    char *more = realloc(last->inserted, last->inserted_bytes + splice->bytes + 1);
    if (more)
        last->inserted = more;
    if (!more || !moves_join(last, change))
        return false;
    memcpy(more + last->inserted_bytes, splice->text, splice->bytes);
    last->inserted_bytes += splice->bytes;
    last->caret_after = meant->caret;
    return true;
}

static void done_cut(struct reader_edit *e)
{
    while (e->done_count > e->at)
        done_finish(&e->done[--e->done_count]);
}

static char *bytes_copy(const char *text, size_t bytes)
{
    char *copy = malloc(bytes + 1);
    if (copy && bytes)
        memcpy(copy, text, bytes);
    if (copy)
        copy[bytes] = '\0';
    return copy;
}

enum reader_status edit_try(struct reader_edit *e, const struct edit_splice *splice,
                            const struct edit_meant *meant, struct reader_edit_change *change,
                            bool *done)
{
    const struct reader_bytes *source = &e->files->texts[splice->source];
    struct edit_done one = {.source = splice->source,
                            .at = splice->at,
                            .removed = bytes_copy(source->text + splice->at, splice->removed),
                            .inserted = bytes_copy(splice->text, splice->bytes),
                            .removed_bytes = splice->removed,
                            .inserted_bytes = splice->bytes,
                            .caret_before = meant->end,
                            .caret_after = meant->caret,
                            .typed = meant->typed,
                            .group = e->group ? e->group : ++e->groups};
    *done = false;
    if (!one.removed || !one.inserted ||
        !array_reserve(&e->done, &e->done_capacity, e->done_count + 1, sizeof *e->done)) {
        done_finish(&one);
        return no_memory();
    }
    enum reader_status status = splice_do(e, splice, meant, change, done);
    if (!*done) {
        done_finish(&one);
        return status;
    }
    touched_keep(e, change, &one.touched[0], &one.touched_count[0]);
    remarks_move(e, change);
    change->caret = caret_now(change->before, *e->document, meant);
    if (typed_join(e, splice, meant, change)) {
        done_finish(&one);
    } else {
        if (!moves_join(&one, change))
            one.moves_count = 0;
        done_cut(e);
        e->done[e->done_count++] = one;
        e->at = e->done_count;
    }
    e->part = false;
    return status;
}

/* ---- undo ---- */

/* The moves of an edit, or those that take them back: where letters are alike, what was read
 * would not tell which of them have come. */
static enum reader_status moves_again(const struct edit_done *done, bool redo,
                                      struct reader_edit_change *change)
{
    const int count = done->moves_count;
    change->moves_count = 0;
    for (int i = 0; i < count; i++) {
        const struct reader_edit_move *m = &done->moves[redo ? i : count - 1 - i];
        if (!edit_move_add(change, m->at, redo ? m->removed : m->inserted,
                           redo ? m->inserted : m->removed))
            return no_memory();
    }
    return READER_OK;
}

void reader_edit_part(struct reader_edit *e)
{
    e->part = true;
}

void reader_edit_group(struct reader_edit *e, bool begins)
{
    e->depth += begins ? 1 : -1;
    if (begins && e->depth == 1)
        e->group = ++e->groups;
    if (!e->depth)
        e->group = 0;
    e->part = true;
}

bool reader_edit_can(const struct reader_edit *e, bool redo)
{
    return redo ? e->at < e->done_count : e->at > 0;
}

enum reader_status reader_edit_undo(struct reader_edit *e, bool redo,
                                    struct reader_edit_change *change)
{
    bool done;
    *change = (struct reader_edit_change){.block = -1};
    e->waits = READER_WAITS_NOTHING;
    if (!reader_edit_can(e, redo))
        return reader_fail(READER_BAD_ARGUMENT, "there is nothing to be undone");
    struct edit_done *one = &e->done[redo ? e->at : e->at - 1];
    const struct edit_splice splice = {
        .source = one->source,
        .at = one->at,
        .removed = redo ? one->removed_bytes : one->inserted_bytes,
        .text = redo ? one->inserted : one->removed,
        .bytes = redo ? one->inserted_bytes : one->removed_bytes};
    enum reader_status status =
        splice_do(e, &splice, &(struct edit_meant){.any = true}, change, &done);
    if (!done)
        return status;
    status = moves_again(one, redo, change);
    const int own = redo ? 0 : 1; /* what this direction takes, the other one gives back */
    free(one->touched[own]);
    touched_keep(e, change, &one->touched[own], &one->touched_count[own]);
    remarks_move(e, change);
    if (e->remarks)
        reader_remarks_place(e->remarks, one->touched[1 - own], one->touched_count[1 - own]);
    e->at += redo ? 1 : -1;
    e->part = true;
    const size_t caret = redo ? one->caret_after : one->caret_before;
    const size_t most = (*e->document)->plain_bytes;
    change->caret = caret < most ? caret : most;
    change->more =
        reader_edit_can(e, redo) && e->done[redo ? e->at : e->at - 1].group == one->group;
    return status;
}
