/* sums.c - adds up what the hooks of watch.h report.
 *
 * The fate of each value is counted once: it was computed, in the first evaluation that
 * reached it, or released before any evaluation did. Foreseen calls make no values; the
 * kernels that they run are counted like all others.
 */
#include <stdlib.h>
#include <string.h>

#include "watch/sums.h"

struct watch_sums *sums_create(void)
{
    return calloc(1, sizeof(struct watch_sums));
}

void sums_destroy(struct watch_sums *e)
{
    if (!e)
        return;
    for (struct kernel_note *n = e->notes, *next; n; n = next) {
        next = n->next;
        free((void *)(uintptr_t)n->facts.stores);
        free(n->name);
        free(n);
    }
    free(e->kernels);
    free(e->families);
    free(e);
}

void sums_call(struct watch_sums *e, const char *name, int foreseen, double time_s)
{
    uint32_t h = 2166136261u;
    for (const char *c = name; *c; c++)
        h = (h ^ (unsigned char)*c) * 16777619u;
    int16_t *place;
    for (h %= CALL_NAMES_SIZE;; h = (h + 1) % CALL_NAMES_SIZE) {
        place = &e->calls_hashed[h];
        if (!*place || strcmp(e->calls[*place - 1].name, name) == 0)
            break;
    }
    struct machine_explained *f = &e->facts;
    f->calls_recorded += !foreseen;
    f->calls_foreseen += (uint64_t)foreseen;
    if (!*place) {
        if (f->calls_count == CALL_NAMES_MOST)
            return;
        e->calls[f->calls_count].name = name;
        *place = (int16_t)++f->calls_count;
    }
    struct machine_explained_row *row = &e->calls[*place - 1];
    row->count += !foreseen;
    row->bytes += (uint64_t)foreseen;
    row->time_s += time_s;
}

struct kernel_note *sums_note(struct watch_sums *e, uint64_t kernel, const char *name,
                              int vpset, uint64_t processors)
{
    for (struct kernel_note *n = e->notes; n; n = n->next)
        if (n->kernel == kernel && n->facts.vpset == vpset &&
            n->facts.processors == processors && (!name || strcmp(n->name, name) == 0))
            return n;
    struct kernel_note *n = calloc(1, sizeof *n);
    if (!n || !(n->name = strdup(name ? name : ""))) {
        free(n);
        return NULL;
    }
    n->kernel = kernel;
    n->facts.name = n->name;
    n->facts.vpset = vpset;
    n->facts.processors = processors;
    n->facts.made = "by hand";
    n->next = e->notes;
    e->notes = n;
    return n;
}
