/* cuts.c - which VP sets are cut, and how: see sequencers.h. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "ranks/ranks.h"
#include "sequencers/sequencers.h"

/* Smaller sets are not worth a message. LINE_GHOSTS: of a set with one axis, whose planes are
 * single processors. RUN: blocks of such a set begin where a run of a reduction does, where it
 * is long enough. */
enum {
    COUNT_LEAST = 65536,
    SHEET_GHOSTS = 16,
    SPACE_GHOSTS = 4,
    LINE_GHOSTS = 512,
    RUN = 4096
};

uint64_t cut_first(const struct cut *c, int block)
{
    const uint64_t back = (uint64_t)c->ghosts % c->length;
    return (c->first[block] + c->length - back) % c->length;
}

int cut_owner(const struct cut *c, int count, uint64_t plane, uint64_t *at)
{
    int i = 0;
    while (i < count - 1 && plane >= c->first[i + 1])
        i++;
    *at = plane - c->first[i] + (uint64_t)c->ghosts;
    return i;
}

static int ghosts_of(const struct machine *m, const struct vpset *s)
{
    if (m->settings.ghosts != SETTING_FREE)
        return (int)m->settings.ghosts;
    return s->rank == 1 && s->count >= COUNT_LEAST ? LINE_GHOSTS
           : s->rank > 2                           ? SPACE_GHOSTS
                                                   : SHEET_GHOSTS;
}

/* Where blocks begin, and how high the largest one is with its ghosts. */
static void blocks_place(struct cut *c, int count, bool line)
{
    const uint64_t unit = line && c->length >= (uint64_t)RUN * (uint64_t)count ? RUN : 1,
                   units = (c->length + unit - 1) / unit;
    c->height = 0;
    for (int i = 0; i <= count; i++)
        c->first[i] = i == count ? c->length : units * (uint64_t)i / (uint64_t)count * unit;
    for (int i = 0; i < count; i++)
        if (c->first[i + 1] - c->first[i] > c->height)
            c->height = c->first[i + 1] - c->first[i];
    c->height += 2 * (uint64_t)c->ghosts;
}

/* An index of all that a block's array and the set have together fits 32 bits: see
 * build/divided.c. */
static bool can_cut(const struct machine *m, const struct vpset *s, const struct cut *c)
{
    const bool forced = m->settings.blocks_from != SETTING_FREE;
    const uint64_t least = forced ? m->settings.blocks_from : COUNT_LEAST,
                   plane = s->count / c->length;
    if (s->count < least || c->length < 2 || (c->height + c->length) * plane > INT32_MAX)
        return false;
    /* what is before a block's own planes is passed to kernels as columns: sequencers_band() */
    if (s->rank > 1 &&
        (uint64_t)c->ghosts * (s->rows / c->length) * s->pitch > INT32_MAX - LINE_BYTES)
        return false;
    return forced || c->length >= 2 * (uint64_t)m->sequencers->count * (uint64_t)c->ghosts;
}

/* What the first sequencer's set is, the others' are. */
static void set_share(const struct sequencers *q, int set)
{
    for (int i = 1; i < q->machines_count; i++)
        q->machines[i]->values->sets[set] = q->machines[0]->values->sets[set];
}

static void cut_make(struct machine *m, int set, struct cut *c)
{
    struct machine *local = m->sequencers->machines[0];
    const struct vpset *s = &m->values->sets[set];
    int dimensions[MACHINE_AXES_MAX];
    *c = (struct cut){.generation = s->generation};
    local->values->sets[set] = *s;
    c->length = (uint64_t)s->dimensions[0];
    c->ghosts = ghosts_of(m, s);
    blocks_place(c, m->sequencers->count, s->rank == 1);
    c->is = can_cut(m, s, c);
    if (c->is) {
        memcpy(dimensions, s->dimensions, sizeof dimensions);
        dimensions[0] = (int)c->height;
        geometry_make(local, &local->values->sets[set], dimensions, s->rank, &s->layout);
    }
    set_share(m->sequencers, set);
    if (c->is && m->sequencers->far)
        ranks_command_all((struct ranks_command){RANKS_SET, sizeof *s, {(uint64_t)set}},
                          &local->values->sets[set]);
}

/* As many sets as the front end has. */
static void sets_grow(struct machine *m)
{
    struct sequencers *q = m->sequencers;
    const int count = m->values->sets_count;
    const size_t more = (size_t)(count > q->cuts_count ? count - q->cuts_count : 0);
    if (!more)
        return;
    q->cuts = realloc(q->cuts, (size_t)count * sizeof *q->cuts);
    NEEDS_MEMORY(q->cuts);
    memset(&q->cuts[q->cuts_count], 0, more * sizeof *q->cuts);
    for (int i = 0; i < q->machines_count; i++) {
        struct values *v = q->machines[i]->values;
        v->sets = realloc(v->sets, (size_t)count * sizeof *v->sets);
        NEEDS_MEMORY(v->sets);
        memset(&v->sets[q->cuts_count], 0, more * sizeof *v->sets);
        v->sets_count = count;
    }
    q->cuts_count = count;
}

const struct cut *sequencers_cut(struct machine *m, int set)
{
    sets_grow(m);
    struct cut *c = &m->sequencers->cuts[set];
    if (set == 0 || !m->values->sets[set].used)
        return NULL;
    if (c->generation != m->values->sets[set].generation)
        cut_make(m, set, c);
    return c->is ? c : NULL;
}
