/* near_links.c - see near_links.h: the chunks of near_loops.h, none of which lies in two
 * arrays. */
#include "ops/near_links.h"

#include <stdlib.h>

#include "interpret/lanes.h"
#include "ops/near_loops.h"

/* What the parts share. */
struct linked {
    const struct loops *loops;
    struct stretch *pieces;
    struct chunk *chunks; /* of each */
    size_t count;
    int parts, chunk;
    bool writes; /* the last time */
};

/* Whether the next LOOPS_RUNS pieces are whole chunks of one array. */
static bool are_runs(const struct linked *g, size_t i, size_t end)
{
    const struct stretch *last = &g->pieces[i + LOOPS_RUNS - 1];
    return g->loops->sums && i + LOOPS_RUNS <= end && last->j == g->pieces[i].j &&
           last->end - last->begin == g->chunk;
}

static void part_scan(void *of, int part, int worker)
{
    const struct linked *g = of;
    const size_t first = g->count * (size_t)part / (size_t)g->parts,
                 end = g->count * (size_t)(part + 1) / (size_t)g->parts;
    (void)worker;
    for (size_t i = first; i < end; i++)
        if (g->writes) {
            g->loops->scan(&g->pieces[i], &g->chunks[i]);
        } else if (are_runs(g, i, end)) {
            g->loops->sums(&g->pieces[i], &g->chunks[i]);
            i += LOOPS_RUNS - 1;
        } else {
            g->loops->sum(&g->pieces[i], &g->chunks[i]);
        }
    if (g->pieces[0].j->streams)
        lanes_table()->settle();
}

/* Cuts links into chunks. */
static size_t pieces_make(struct stretch *pieces, const struct link *links, int count,
                          ptrdiff_t step, int chunk)
{
    size_t made = 0;
    for (int i = 0; i < count; i++)
        for (int begin = links[i].begin; begin < links[i].end; begin += chunk) {
            const int left = links[i].end - begin;
            pieces[made++] =
                (struct stretch){.j = &links[i].scan,
                                 .at = links[i].at + (size_t)((begin - links[i].begin) * step),
                                 .step = step,
                                 .begin = begin,
                                 .end = begin + (left < chunk ? left : chunk)};
        }
    return made;
}

bool near_links_scan(struct crew *crew, int parts, const struct link *links, int count,
                     ptrdiff_t step, int chunk)
{
    struct linked g = {
        .loops = near_loops_of(links[0].scan.element), .parts = parts, .chunk = chunk};
    size_t most = 0;
    for (int i = 0; i < count; i++)
        most += (size_t)((links[i].end - links[i].begin - 1) / chunk + 1);
    g.pieces = malloc(most * sizeof *g.pieces);
    g.chunks = malloc(most * sizeof *g.chunks);
    const bool good = g.pieces && g.chunks;
    if (good) {
        g.count = pieces_make(g.pieces, links, count, step, chunk);
        crew_run(crew, parts, part_scan, &g);
        g.loops->join(&links[0].scan, g.chunks, (int)g.count);
        g.writes = true;
        crew_run(crew, parts, part_scan, &g);
    }
    free(g.pieces);
    free(g.chunks);
    return good;
}
