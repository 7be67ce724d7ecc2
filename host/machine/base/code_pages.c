/* code_pages.c - see code_pages.h. */
#include "base/code_pages.h"

#include <link.h>
#include <sched.h>
#include <stdint.h>
#include <sys/mman.h>

enum {
    PAGE_BYTES = 4096,
    LINE_BYTES = 64,
    PIECE_BYTES = 128 << 10,
    MOST_ON_A_SIDE =
        2 << 20 /* the machine and C/Paris are linked one after the other, and have less */
};

struct search {
    uintptr_t wanted;
    size_t most;
    struct code_pages found;
};

static int object_look(struct dl_phdr_info *object, size_t bytes, void *of)
{
    struct search *s = of;
    (void)bytes;
    for (int i = 0; i < object->dlpi_phnum; i++) {
        const ElfW(Phdr) *p = &object->dlpi_phdr[i];
        const uintptr_t begin = object->dlpi_addr + p->p_vaddr, end = begin + p->p_memsz;
        if (p->p_type != PT_LOAD || s->wanted < begin || s->wanted >= end)
            continue;
        const uintptr_t first = s->wanted - begin > s->most ? s->wanted - s->most : begin,
                        last = end - s->wanted > s->most ? s->wanted + s->most : end;
        s->found = (struct code_pages){(const char *)(first / PAGE_BYTES * PAGE_BYTES),
                                       (const char *)last};
        return 1;
    }
    return 0;
}

struct code_pages code_pages_find(size_t most_on_a_side)
{
    struct search s = {.wanted = (uintptr_t)code_pages_find, .most = most_on_a_side};
    dl_iterate_phdr(object_look, &s);
    return s.found;
}

/* A piece at a time, since whoever wants more memory waits meanwhile. */
static void fetch(void *nothing)
{
    const struct code_pages c = code_pages_find(MOST_ON_A_SIDE);
    (void)nothing;
    for (const char *at = c.begin, *next; at < c.end; at = next) {
        next = c.end - at > PIECE_BYTES ? at + PIECE_BYTES : c.end;
#ifdef MADV_POPULATE_READ /* many pages at once; an older system does not know it */
        madvise((void *)(uintptr_t)at, (size_t)(next - at), MADV_POPULATE_READ);
#endif
        for (const volatile char *line = at; line < next; line += LINE_BYTES)
            (void)*line;
    }
}

void code_pages_begin(struct aside *a)
{
    cpu_set_t ours;
    if (!sched_getaffinity(0, sizeof ours, &ours) && CPU_COUNT(&ours) > 1)
        aside_begin(a, fetch, NULL);
}
