/* cited.c - who cites what: each entry of a bibliography has links back to where it is cited.
 * See reader_document.h. */
#include "builder.h"

#include <stdlib.h>
#include <string.h>

struct cited {
    struct reader_document *d;
    const struct reader_files *files; /* NULL: none is known */
    const int *entry_of; /* of blocks: the first one of the entry that they are of; or -1 */
    struct reader_citation *list;
    int count, capacity;
    int *calls; /* of notes: the block that calls it; -1: none does */
};

static enum reader_status no_memory(void)
{
    return reader_fail(READER_NO_MEMORY, "no memory for a document");
}

/* The entry that a link leads to; -1: it leads to none. */
static int entry_find(const struct cited *c, const struct reader_block *from,
                      const struct reader_span *span)
{
    const struct reader_document *d = c->d;
    if (!(span->look & READER_LINK) || !span->target)
        return -1;
    const struct reader_block *place =
        reader_place_find(d, c->files, span->target, from->source);
    return place && place >= d->blocks && place < d->blocks + d->blocks_count
               ? c->entry_of[place - d->blocks]
               : -1;
}

/* What a block cites: where is the block that one is led back to. */
static enum reader_status block_cites(struct cited *c, const struct reader_block *block,
                                      int where)
{
    for (int i = 0; i < block->spans_count; i++) {
        const int entry = entry_find(c, block, &block->spans[i]);
        if (entry < 0 || where < 0 || c->entry_of[where] == entry)
            continue;
        if (!array_reserve(&c->list, &c->capacity, c->count + 1, sizeof *c->list))
            return no_memory();
        c->list[c->count++] = (struct reader_citation){entry, where};
    }
    return READER_OK;
}

/* Notes are cited from where they are called; those that notes call have larger numbers. */
static void calls_find(struct cited *c)
{
    const struct reader_document *d = c->d;
    for (int i = 0; i < d->notes_count; i++)
        c->calls[i] = -1;
    for (int i = 0; i < d->blocks_count; i++)
        for (int k = 0; k < d->blocks[i].spans_count; k++) {
            const struct reader_span *s = &d->blocks[i].spans[k];
            if (s->look & READER_NOTE && s->note >= 0 && c->calls[s->note] < 0)
                c->calls[s->note] = i;
        }
    for (int n = 0; n < d->notes_count; n++)
        for (int b = 0; b < d->notes[n].blocks_count; b++) {
            const struct reader_block *block = &d->note_blocks[d->notes[n].first_block + b];
            for (int k = 0; k < block->spans_count; k++) {
                const struct reader_span *s = &block->spans[k];
                if (s->look & READER_NOTE && s->note >= 0 && c->calls[s->note] < 0)
                    c->calls[s->note] = c->calls[n];
            }
        }
}

static int by_entry(const void *a, const void *b)
{
    const struct reader_citation *x = a, *y = b;
    return x->entry != y->entry ? x->entry - y->entry : x->where - y->where;
}

/* In the order of entries, each place once. */
static void sort(struct cited *c)
{
    int kept = 0;
    if (c->count)
        qsort(c->list, (size_t)c->count, sizeof *c->list, by_entry);
    for (int i = 0; i < c->count; i++)
        if (!kept || by_entry(&c->list[kept - 1], &c->list[i]) != 0)
            c->list[kept++] = c->list[i];
    c->count = kept;
}

enum reader_status reader_citations_find(struct reader_document *d,
                                         const struct reader_files *files, const int *entry_of,
                                         struct reader_citation **list, int *count)
{
    struct cited c = {.d = d, .files = files, .entry_of = entry_of};
    c.calls = malloc(((size_t)d->notes_count + 1) * sizeof *c.calls);
    enum reader_status status = c.calls ? READER_OK : no_memory();
    if (status == READER_OK)
        calls_find(&c);
    for (int i = 0; i < d->blocks_count && status == READER_OK; i++)
        status = block_cites(&c, &d->blocks[i], i);
    for (int n = 0; n < d->notes_count && status == READER_OK; n++)
        for (int b = 0; b < d->notes[n].blocks_count && status == READER_OK; b++)
            status = block_cites(&c, &d->note_blocks[d->notes[n].first_block + b], c.calls[n]);
    sort(&c);
    free(c.calls);
    *list = c.list;
    *count = c.count;
    return status;
}
