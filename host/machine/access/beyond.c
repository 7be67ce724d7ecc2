/* beyond.c - see beyond.h. Nothing here is fast: it is for programs that cannot be changed. */
#include "access/beyond.h"

enum { WIDEST = 128 };

void machine_lenient_set(struct machine *m, bool on)
{
    m->settings.lenient = on;
}

bool machine_lenient(const struct machine *m)
{
    return m->settings.lenient;
}

static struct field *near_overrun(const struct machine *m, uint32_t id, uint32_t bits)
{
    uint32_t offset;
    struct field *f = field_near(m, id, &offset);
    bool over = f && !f->root && (offset >= f->bits || bits > f->bits - offset);
    /* What is longer than a value goes in pieces, each named by an id of its own. */
    return over && (bits <= WIDEST || bits <= f->room - offset) ? f : NULL;
}

bool machine_field_runs_over(const struct machine *m, uint32_t field, uint32_t bits)
{
    return near_overrun(m, field, bits) != NULL;
}

struct field *beyond_field(const struct machine *m, uint32_t id, uint32_t bits)
{
    return m->settings.lenient && bits <= WIDEST ? near_overrun(m, id, bits) : NULL;
}

/* The one that was allocated next, of the same VP set and region. */
static struct field *field_after(const struct machine *m, const struct field *f)
{
    struct field *next = NULL;
    for (int i = 0; i < m->memory->fields_count; i++) {
        struct field *g = m->memory->fields[i];
        if (!g->root && g->vpset == f->vpset && g->region == f->region &&
            g->serial > f->serial && (!next || g->serial < next->serial))
            next = g;
    }
    return next;
}

uint32_t beyond_part(const struct machine *m, uint32_t id, uint32_t at, uint32_t *bits)
{
    uint32_t offset;
    const struct field *f = field_near(m, id, &offset);
    offset += at;
    while (f && offset >= f->bits) {
        offset -= f->bits;
        f = field_after(m, f);
    }
    if (!f)
        return MACHINE_NO_FIELD;
    if (*bits > f->bits - offset)
        *bits = f->bits - offset;
    return f->base + offset;
}
