/* vpsets.c - VP sets: creating, destroying, rearranging, selecting. */
#include <stdlib.h>
#include <string.h>

#include "access/settle.h"
#include "alias/alias.h"
#include "base/errors.h"
#include "run/evaluate.h"
#include "run/notes.h"
#include "run/slices.h"

int machine_vpset_create(struct machine *m, const int *dimensions, int rank)
{
    return machine_vpset_create_ordered(m, dimensions, rank, MACHINE_NEWS_ORDER);
}

/* False: error set. */
static bool axes_good(struct machine *m, const int *dimensions, int rank)
{
    if (rank < 1 || rank > MACHINE_AXES_MAX) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "a geometry has 1..%d axes (got %d)",
                     MACHINE_AXES_MAX, rank);
        return false;
    }
    uint64_t count = 1;
    for (int i = 0; i < rank; i++) {
        if (dimensions[i] < 1) {
            machine_fail(m, MACHINE_BAD_ARGUMENT,
                         "axis %d must have a length of 1 or more (got %d)", i, dimensions[i]);
            return false;
        }
        count *= (uint64_t)dimensions[i];
        if (count > INT32_MAX) {
            machine_fail(m, MACHINE_NO_MEMORY, "a VP set has at most 2^31 - 1 processors");
            return false;
        }
    }
    return true;
}

int machine_vpset_create_ordered(struct machine *m, const int *dimensions, int rank,
                                 enum machine_order order)
{
    struct machine_layout layout;
    if (!axes_good(m, dimensions, rank))
        return 0;
    geometry_layout(m, &layout, dimensions, rank, order);
    return machine_vpset_create_laid_out(m, dimensions, rank, &layout);
}

int machine_vpset_create_laid_out(struct machine *m, const int *dimensions, int rank,
                                  const struct machine_layout *layout)
{
    if (!axes_good(m, dimensions, rank))
        return 0;
    settle(m);
    int id = 1;
    while (id < m->values->sets_count && m->values->sets[id].used)
        id++;
    if (id > UINT16_MAX) {
        machine_fail(m, MACHINE_NO_MEMORY, "there are too many VP sets");
        return 0;
    }
    if (id >= m->values->sets_count) {
        if (!vpsets_grow(m, id + 1)) {
            machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for another VP set");
            return 0;
        }
    }
    struct vpset *s = &m->values->sets[id];
    *s = (struct vpset){.used = true, .generation = (uint16_t)(s->generation + 1)};
    *flags_of(m, s) = (struct flags){.overflow = {.op = 0}};
    geometry_make(m, s, dimensions, rank, layout);
    for (int flag = 0; flag < 3; flag++) {
        flags_of(m, s)->of[flag] = (struct slot){.bits = 1, .epoch_created = m->values->epoch};
        struct machine_value *one = machine_constant(
            m, MACHINE_BIT, (struct machine_scalar){flag == MACHINE_CONTEXT, 0});
        slot_set(m, &flags_of(m, s)->of[flag], one);
    }
    return id;
}

enum machine_status machine_vpset_destroy(struct machine *m, int vpset)
{
    struct vpset *s = vpset_get(m, vpset);
    if (!s)
        return m->status;
    machine_begin(m);
    notes_forget(m);
    for (int i = m->memory->fields_count - 1; i >= 0; i--)
        if (i < m->memory->fields_count && m->memory->fields[i]->vpset == vpset) {
            struct field *f = m->memory->fields[i];
            if (f->root && f->root->newest == f)
                alias_settle(m, f->root); /* on failure that content is lost with the set */
            field_destroy(m, f);
        }
    machine_begin(m);
    if (!slices_forget_set(m, vpset))
        return m->status;
    vpset_release(m, s);
    if (m->values->set_current == vpset)
        m->values->set_current = 0;
    return MACHINE_OK;
}

/* Puts every value of the set into memory, in the rows of the new layout. False: error set. */
static bool slots_lay_out(struct machine *m, struct slot *slots, int count, int vpset,
                          const struct vpset *to, struct machine_value **out, int *out_count)
{
    for (int i = 0; i < count; i++) {
        struct machine_value *v = slots[i].value;
        if (v->op != NODE_CONSTANT && !(v = lay_out_value(m, v, vpset, to)))
            return false;
        out[(*out_count)++] = v;
    }
    return true;
}

/* All values are made before any is stored, so that a failure changes nothing. */
enum machine_status machine_vpset_arrange(struct machine *m, int vpset, const int *dimensions,
                                          int rank, const struct machine_layout *layout)
{
    struct vpset *s = vpset_get(m, vpset);
    uint64_t count = 1;
    for (int i = 0; s && i < rank && rank <= MACHINE_AXES_MAX; i++)
        count *= dimensions[i] > 0 ? (uint64_t)dimensions[i] : 0;
    if (!s)
        return m->status;
    if (rank < 1 || rank > MACHINE_AXES_MAX || count != s->count)
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "another geometry of a VP set has as many processors (%llu)",
                            (unsigned long long)s->count);
    machine_begin(m);
    notes_forget(m);
    flag_resolved(m, s, MACHINE_OVERFLOW);
    size_t slots_count = 3;
    for (int i = 0; i < m->memory->fields_count; i++)
        slots_count += m->memory->fields[i]->vpset == vpset
                           ? (size_t)m->memory->fields[i]->slots_count
                           : 0;
    struct vpset to = *s;
    geometry_make(m, &to, dimensions, rank, layout);
    struct machine_value **fresh = calloc(slots_count, sizeof *fresh);
    if (!fresh)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for another geometry");
    int done = 0;
    bool good = evaluate_values(m, NULL, 0, true) == MACHINE_OK &&
                slices_forget_set(m, vpset) &&
                slots_lay_out(m, flags_of(m, s)->of, 3, vpset, &to, fresh, &done);
    for (int i = 0; i < m->memory->fields_count && good; i++)
        if (m->memory->fields[i]->vpset == vpset)
            good = slots_lay_out(m, m->memory->fields[i]->slots,
                                 m->memory->fields[i]->slots_count, vpset, &to, fresh, &done);
    done = 0;
    for (int flag = 0; flag < 3 && good; flag++)
        slot_set(m, &flags_of(m, s)->of[flag], fresh[done++]);
    for (int i = 0; i < m->memory->fields_count && good; i++)
        for (int k = 0;
             m->memory->fields[i]->vpset == vpset && k < m->memory->fields[i]->slots_count; k++)
            slot_set(m, &m->memory->fields[i]->slots[k], fresh[done++]);
    known_addresses_forget(m);
    known_places_forget(m);
    known_ranks_forget(m);
    if (good) {
        to.generation++;
        *s = to;
    }
    free(fresh);
    machine_begin(m);
    return good ? MACHINE_OK : m->status;
}

enum machine_status machine_vpset_select(struct machine *m, int vpset)
{
    if (!vpset_get(m, vpset))
        return m->status;
    m->values->set_current = vpset;
    return MACHINE_OK;
}
