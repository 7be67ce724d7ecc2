/* saved.c - see machine_saved.h. */
#include "machine_saved.h"

#include <string.h>

#include "access/settle.h"
#include "alias/alias.h"
#include "base/errors.h"
#include "memory/memory.h"
#include "run/materialise.h"
#include "values/graph.h"

void machine_numbers_saved(const struct machine *m, struct machine_saved_numbers *out)
{
    *out = (struct machine_saved_numbers){m->values->random_seed, m->values->random_draws,
                                          m->memory->next_base, m->memory->serial};
}

enum machine_status machine_numbers_restore(struct machine *m,
                                            const struct machine_saved_numbers *n)
{
    if (n->next_field > UINT32_MAX || n->next_field % 64)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "no field can get the id %llu",
                            (unsigned long long)n->next_field);
    m->values->random_seed = n->random_seed;
    m->values->random_draws = n->random_draws;
    m->memory->next_base = (uint32_t)n->next_field;
    m->memory->serial = n->next_order;
    return MACHINE_OK;
}

bool machine_field_saved(struct machine *m, int i, struct machine_saved_field *out)
{
    settle(m);
    if (i < 0 || i >= m->memory->fields_count)
        return false;
    struct field *f = m->memory->fields[i];
    if (!f->root && f->newest && !alias_settle(m, f))
        return false;
    *out = (struct machine_saved_field){.base = f->base,
                                        .bits = f->bits,
                                        .room = f->room,
                                        .vpset = f->vpset,
                                        .region = f->region,
                                        .order = f->serial,
                                        .root = f->root ? f->root->base : 0,
                                        .parts_count = f->root ? 0 : f->slots_count};
    if (f->root)
        memcpy(out->view,
               (uint32_t[4]){f->view.start, f->view.parts, f->view.outer, f->view.inner},
               sizeof out->view);
    return true;
}

bool machine_part_saved(struct machine *m, uint32_t field, int k,
                        struct machine_saved_part *out)
{
    const struct field *f = field_exact(m, field);
    if (!f || k < 0 || k >= f->slots_count)
        return false;
    const struct slot *s = &f->slots[k];
    *out = (struct machine_saved_part){.offset = s->offset, .type = s->value->type};
    if (out->type.kind != MACHINE_FLOAT || out->type.s)
        out->type = MACHINE_UINT(s->bits);
    out->constant = s->value->op == NODE_CONSTANT && !s->value->buffer &&
                    out->type.kind == s->value->type.kind;
    if (out->constant)
        out->number = s->value->imm;
    return true;
}

/* Whether the last bit of the last VP is within the memory of the root's. */
static bool view_is_within(const struct machine *m, const struct machine_saved_field *f,
                           const struct field *root)
{
    const struct vpset *of = &m->values->sets[root->vpset], *to = &m->values->sets[f->vpset];
    const uint64_t start = f->view[0], parts = f->view[1], outer = f->view[2],
                   inner = f->view[3], last = to->ratio - 1;
    if (!parts || of->ratio * root->bits > UINT32_MAX || to->ratio > UINT32_MAX)
        return false;
    const uint64_t part = last < parts ? last : parts - 1;
    const uint64_t there = of->ratio * root->bits;
    /* each product is below 2^64: both factors are below 2^32 */
    return start <= there && f->bits <= there && last / parts * outer <= there &&
           part * inner <= there &&
           start + last / parts * outer + part * inner + f->bits <= there;
}

/* Whether no other field has an id of this one's. */
static bool ids_are_free(const struct machine *m, const struct machine_saved_field *f)
{
    int low = 0, high = m->memory->fields_count;
    struct field *const *fields = m->memory->fields;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (fields[middle]->base <= f->base)
            low = middle + 1;
        else
            high = middle;
    }
    return (low == 0 || fields[low - 1]->base + fields[low - 1]->room <= f->base) &&
           (low == m->memory->fields_count || fields[low]->base >= f->base + f->room);
}

static const char *field_wrong(struct machine *m, const struct machine_saved_field *f)
{
    const struct values *v = m->values;
    if (f->vpset < 1 || f->vpset >= v->sets_count || !v->sets[f->vpset].used)
        return "is of no VP set";
    if (f->base < 64 || f->base % 64 || f->bits > INT32_MAX || f->room > INT32_MAX - f->base ||
        f->base > INT32_MAX || f->room < (f->bits + 128) / 64 * 64)
        return "has no room";
    if (!ids_are_free(m, f))
        return "has the ids of another";
    if (f->region != MACHINE_STACK && f->region != MACHINE_HEAP)
        return "is neither in the stack nor in the heap";
    const struct field *root = f->root ? field_exact(m, f->root) : NULL;
    if (f->root && (!root || root->root || root->region != f->region))
        return "is the alias of none";
    return root && !view_is_within(m, f, root)
               ? "reaches beyond the memory that it is an alias of"
               : NULL;
}

enum machine_status machine_field_restore(struct machine *m,
                                          const struct machine_saved_field *f)
{
    settle(m);
    const char *wrong = field_wrong(m, f);
    if (wrong)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "field %u %s", f->base, wrong);
    struct field *root = f->root ? field_exact(m, f->root) : NULL;
    m->memory->next_base = f->base;
    if (machine_field_allocate(m, f->vpset, f->bits, f->region) != f->base)
        return machine_fail(m, MACHINE_NO_MEMORY, "field %u cannot have its id", f->base);
    struct field *made = field_exact(m, f->base);
    made->room = f->room;
    made->serial = f->order;
    if (!root)
        return MACHINE_OK;
    made->root = root;
    made->view = (struct view){f->view[0], f->view[1], f->view[2], f->view[3]};
    made->next_alias = root->aliases;
    root->aliases = made;
    return MACHINE_OK;
}

enum machine_status machine_part_restore(struct machine *m, uint32_t field,
                                         const struct machine_saved_part *part,
                                         const void *array)
{
    if (!part->constant)
        return machine_field_upload(m, field + part->offset, part->type, array);
    machine_begin(m);
    return machine_field_store(m, field + part->offset,
                               machine_constant(m, part->type, part->number),
                               MACHINE_EVERYWHERE);
}

enum machine_status machine_flag_upload(struct machine *m, int vpset, enum machine_flag flag,
                                        const uint8_t *in)
{
    machine_begin(m);
    const int current = m->values->set_current;
    if (!vpset_get(m, vpset))
        return m->status;
    m->values->set_current = vpset;
    struct machine_value *v = materialise_upload(m, vpset, MACHINE_BIT, in);
    const enum machine_status status =
        v ? machine_flag_store(m, flag, v, MACHINE_EVERYWHERE) : m->status;
    m->values->set_current = current;
    return status;
}
