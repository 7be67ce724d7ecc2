/* code_pages.c - see code_pages.h.
 *
 *     a library     | names | code ... this function ... | constants | tables for exceptions | constants with addresses | variables
 *                           '---------- fetched ---------'-----------'                       '--------------------------'
 *
 * So GNU's linkers lay it out; LLVM's and mold put the constants before the code:
 *
 *     a library     | names | constants | tables for exceptions | code ... this function ... | constants with addresses | variables
 *                           '- fetched -'                       '----------------------------'--------------------------' */
#include "device/code_pages.h"

#include <link.h>
#include <sched.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/mman.h>

#include "device/shape.h"

struct search {
    uintptr_t wanted;
    size_t most;
    struct code_range *found;
    int count;
};

static void range_add(struct search *s, uintptr_t begin, uintptr_t end)
{
    if (s->count < CODE_RANGES_MOST && begin < end)
        s->found[s->count++] = (struct code_range){
            (const char *)(begin / PAGE_BYTES * PAGE_BYTES), (const char *)end};
}

/* Where that part of the object would be. */
static uintptr_t place(const struct dl_phdr_info *object, const ElfW(Phdr) * part)
{
    return object->dlpi_addr + part->p_vaddr;
}

/* Where the names end that the linker has for the loader: symbols, and what is to be relocated.
 * 0: the object has none. */
static uintptr_t names_end(const struct dl_phdr_info *object)
{
    uintptr_t strings = 0, moved = 0, called = 0;
    size_t strings_bytes = 0, moved_bytes = 0, called_bytes = 0;
    const ElfW(Dyn) *entry = NULL;
    for (int i = 0; i < object->dlpi_phnum; i++)
        if (object->dlpi_phdr[i].p_type == PT_DYNAMIC)
            entry = (const ElfW(Dyn) *)place(object, &object->dlpi_phdr[i]);
    for (; entry && entry->d_tag != DT_NULL; entry++) {
        strings = entry->d_tag == DT_STRTAB ? entry->d_un.d_ptr : strings;
        strings_bytes = entry->d_tag == DT_STRSZ ? entry->d_un.d_val : strings_bytes;
        moved = entry->d_tag == DT_RELA ? entry->d_un.d_ptr : moved;
        moved_bytes = entry->d_tag == DT_RELASZ ? entry->d_un.d_val : moved_bytes;
        called = entry->d_tag == DT_JMPREL ? entry->d_un.d_ptr : called;
        called_bytes = entry->d_tag == DT_PLTRELSZ ? entry->d_un.d_val : called_bytes;
    }
    const uintptr_t ends[] = {strings + strings_bytes, moved + moved_bytes,
                              called + called_bytes};
    uintptr_t last = 0;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        last = ends[i] > last ? ends[i] : last;
    return last;
}

/* The constants that lie before the code, with their tables for exceptions at the end. */
static void constants_before_add(struct search *s, const struct dl_phdr_info *object,
                                 uintptr_t begin, uintptr_t exceptions)
{
    const uintptr_t names = names_end(object);
    range_add(s, names > begin && names < exceptions ? names : begin, exceptions);
}

static int object_look(struct dl_phdr_info *object, size_t bytes, void *of)
{
    struct search *s = of;
    uintptr_t exceptions = 0, code = 0;
    (void)bytes;
    for (int i = 0; i < object->dlpi_phnum; i++) {
        const ElfW(Phdr) *p = &object->dlpi_phdr[i];
        const uintptr_t begin = place(object, p), end = begin + p->p_memsz;
        if (p->p_type == PT_GNU_EH_FRAME)
            exceptions = begin;
        if (p->p_type != PT_LOAD || s->wanted < begin || s->wanted >= end)
            continue;
        code = begin;
        range_add(s, s->wanted - begin > s->most ? s->wanted - s->most : begin,
                  end - s->wanted > s->most ? s->wanted + s->most : end);
    }
    for (int i = 0; code && i < object->dlpi_phnum; i++) {
        const ElfW(Phdr) *p = &object->dlpi_phdr[i];
        const uintptr_t begin = place(object, p), end = begin + p->p_memsz;
        if ((p->p_type == PT_LOAD && begin > code && !(p->p_flags & PF_W)) ||
            p->p_type == PT_GNU_RELRO)
            range_add(s, begin, exceptions > begin && exceptions < end ? exceptions : end);
        else if (p->p_type == PT_LOAD && begin < code && exceptions > begin && exceptions < end)
            constants_before_add(s, object, begin, exceptions);
    }
    return code != 0;
}

int code_pages_find(size_t most_on_a_side, struct code_range out[CODE_RANGES_MOST])
{
    struct search s = {
        .wanted = (uintptr_t)code_pages_find, .most = most_on_a_side, .found = out};
    dl_iterate_phdr(object_look, &s);
    return s.count;
}

/* A piece at a time, since whoever wants more memory waits meanwhile. Sanitizers are not asked:
 * what lies between two constants is read, too. */
__attribute__((no_sanitize("address"))) static void range_fetch(const struct code_range *r)
{
    for (const char *at = r->begin, *next; at < r->end; at = next) {
        next = r->end - at > CODE_PIECE_BYTES ? at + CODE_PIECE_BYTES : r->end;
#ifdef MADV_POPULATE_READ /* many pages at once; an older system does not know it */
        madvise((void *)(uintptr_t)at, (size_t)(next - at), MADV_POPULATE_READ);
#endif
        for (const volatile char *line = at; line < next; line += LINE_BYTES)
            (void)*line;
    }
}

static void fetch(void *nothing)
{
    struct code_range ranges[CODE_RANGES_MOST];
    const int count = code_pages_find(CODE_SIDE_BYTES, ranges);
    (void)nothing;
    for (int i = 0; i < count; i++)
        range_fetch(&ranges[i]);
}

void code_pages_near(void)
{
    struct code_range ranges[CODE_RANGES_MOST];
    if (code_pages_find(CODE_NEAR_BYTES, ranges))
        for (const volatile char *line = ranges[0].begin; line < ranges[0].end;
             line += LINE_BYTES)
            (void)*line;
}

void code_pages_begin(struct aside *a)
{
    cpu_set_t ours;
    if (!sched_getaffinity(0, sizeof ours, &ours) && CPU_COUNT(&ours) > 1)
        aside_begin(a, fetch, NULL);
}
