/* vpsets.c - VP sets: their geometries, where their processors are in memory, their addresses.
 *
 * A VP set's id is the lowest one that is free; generation tells those apart that had the same one. Rows run
 * along the last axis, with columns of padding on both sides where vectors are used. */
#include "watch/watch.h"

#include <stdlib.h>
#include <string.h>

struct vpset *vpset_get(struct machine *m, int vpset)
{
    if (vpset > 0 && vpset < m->values->sets_count && m->values->sets[vpset].used)
        return &m->values->sets[vpset];
    machine_fail(m, MACHINE_BAD_ARGUMENT,
                 vpset ? "there is no VP set %d" : "there is no current VP set (%d)", vpset);
    return NULL;
}

int machine_vpset_create(struct machine *m, const int *dimensions, int rank)
{
    return machine_vpset_create_ordered(m, dimensions, rank, MACHINE_NEWS_ORDER);
}

static void vpset_lay_out(const struct machine *m, struct vpset *s, const int *dimensions,
                          int rank, enum machine_order order)
{
    s->order = order;
    s->rank = rank;
    memcpy(s->dimensions, dimensions, (size_t)rank * sizeof *dimensions);
    s->count = 1;
    for (int i = 0; i < rank; i++)
        s->count *= (uint64_t)dimensions[i];
    s->width = dimensions[rank - 1];
    s->rows = s->count / (uint64_t)s->width;
    s->ratio = (s->count + (uint64_t)m->values->processors_count - 1) /
               (uint64_t)m->values->processors_count;
    const struct device_shape *shape = &m->device->shape;
    s->halo = s->width >= shape->vector ? shape->halo : 0;
    s->pitch = (size_t)s->width + 2 * (size_t)s->halo;
    size_t whole =
        s->width < LINE_BYTES ? 16 : LINE_BYTES; /* of bytes, too, rows begin lines */
    if (s->halo)
        s->pitch = (s->pitch + whole - 1) / whole * whole;
}

/* Room for so many, with that of id 0, which is none. False: no memory. */
static bool vpsets_grow(struct machine *m, int count)
{
    int had = m->values->sets_count > 1 ? m->values->sets_count : 0;
    struct vpset *sets = realloc(m->values->sets, (size_t)count * sizeof *sets);
    m->values->sets = sets ? sets : m->values->sets;
    struct flags *flags = realloc(m->memory->flags, (size_t)count * sizeof *flags);
    m->memory->flags = flags ? flags : m->memory->flags;
    if (!sets || !flags)
        return false;
    memset(&sets[had], 0, (size_t)(count - had) * sizeof *sets);
    memset(&flags[had], 0, (size_t)(count - had) * sizeof *flags);
    m->values->sets_count = count;
    return true;
}

int machine_vpset_create_ordered(struct machine *m, const int *dimensions, int rank,
                                 enum machine_order order)
{
    if (rank < 1 || rank > MACHINE_AXES_MAX) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "a geometry has 1..%d axes (got %d)",
                     MACHINE_AXES_MAX, rank);
        return 0;
    }
    uint64_t count = 1;
    for (int i = 0; i < rank; i++) {
        if (dimensions[i] < 1) {
            machine_fail(m, MACHINE_BAD_ARGUMENT,
                         "axis %d must have a length of 1 or more (got %d)", i, dimensions[i]);
            return 0;
        }
        count *= (uint64_t)dimensions[i];
        if (count > INT32_MAX) {
            machine_fail(m, MACHINE_NO_MEMORY, "a VP set has at most 2^31 - 1 processors");
            return 0;
        }
    }
    replay_settle(m);
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
    vpset_lay_out(m, s, dimensions, rank, order);
    for (int flag = 0; flag < 3; flag++) {
        flags_of(m, s)->of[flag] = (struct slot){.bits = 1, .epoch_created = m->values->epoch};
        struct machine_value *one = machine_constant(
            m, MACHINE_BIT, (struct machine_scalar){flag == MACHINE_CONTEXT, 0});
        slot_set(m, &flags_of(m, s)->of[flag], one);
    }
    return id;
}

static void vpset_release(struct machine *m, struct vpset *s)
{
    flag_overflow_clear(m, &flags_of(m, s)->overflow);
    for (int flag = 0; flag < 3; flag++)
        graph_unref(m, flags_of(m, s)->of[flag].value);
    s->used = false;
}

enum machine_status machine_vpset_destroy(struct machine *m, int vpset)
{
    struct vpset *s = vpset_get(m, vpset);
    if (!s)
        return m->status;
    machine_begin(m);
    replay_forget(m);
    for (int i = m->memory->fields_count - 1; i >= 0; i--)
        if (i < m->memory->fields_count && m->memory->fields[i]->vpset == vpset)
            field_destroy(m, m->memory->fields[i]);
    machine_begin(m);
    if (!reshape_forget_set(m, vpset))
        return m->status;
    vpset_release(m, s);
    if (m->values->set_current == vpset)
        m->values->set_current = 0;
    return MACHINE_OK;
}

void vpsets_finish(struct machine *m)
{
    for (int i = 1; i < m->values->sets_count; i++)
        if (m->values->sets[i].used)
            vpset_release(m, &m->values->sets[i]);
    free(m->values->sets);
    free(m->memory->flags);
}

/* Every value of the set in memory, as numbers of the new layout. False: error set. */
static bool slots_lay_out(struct machine *m, struct slot *slots, int count, int vpset,
                          const struct vpset *to, struct machine_value **out, int *out_count)
{
    for (int i = 0; i < count; i++) {
        struct machine_value *v = slots[i].value;
        if (v->op != NODE_CONSTANT && !(v = reshape_lay_out(m, v, vpset, to)))
            return false;
        out[(*out_count)++] = v;
    }
    return true;
}

/* All or nothing: the new values are made before any is put in its place. */
enum machine_status machine_vpset_arrange(struct machine *m, int vpset, const int *dimensions,
                                          int rank, enum machine_order order)
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
    replay_forget(m);
    flag_resolved(m, s, MACHINE_OVERFLOW);
    size_t slots_count = 3;
    for (int i = 0; i < m->memory->fields_count; i++)
        slots_count += m->memory->fields[i]->vpset == vpset
                           ? (size_t)m->memory->fields[i]->slots_count
                           : 0;
    struct vpset to = *s;
    vpset_lay_out(m, &to, dimensions, rank, order);
    struct machine_value **fresh = calloc(slots_count, sizeof *fresh);
    if (!fresh)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for another geometry");
    int done = 0;
    bool good = run_evaluate(m, NULL, 0, true) == MACHINE_OK && reshape_forget_set(m, vpset) &&
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

int machine_vpset_current(const struct machine *m)
{
    return m->values->set_current;
}

static const struct vpset *peek(const struct machine *m, int vpset)
{
    return vpset > 0 && vpset < m->values->sets_count && m->values->sets[vpset].used
               ? &m->values->sets[vpset]
               : NULL;
}

int machine_vpset_rank(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->rank : 0;
}

int machine_vpset_length(const struct machine *m, int vpset, int axis)
{
    const struct vpset *s = peek(m, vpset);
    return s && axis >= 0 && axis < s->rank ? s->dimensions[axis] : 0;
}

uint64_t machine_vpset_count(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->count : 0;
}

uint64_t machine_vpset_ratio(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->ratio : 0;
}

enum machine_order machine_vpset_order(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    return s ? s->order : MACHINE_NEWS_ORDER;
}

int machine_address_bits(const struct machine *m, int vpset)
{
    const struct vpset *s = peek(m, vpset);
    uint64_t addresses = s ? (uint64_t)m->values->processors_count * s->ratio : 1;
    int bits = 1;
    while (bits < 63 && UINT64_C(1) << bits < addresses)
        bits++;
    return bits;
}

uint64_t machine_send_address(const struct machine *m, int vpset, uint64_t index)
{
    const struct vpset *s = peek(m, vpset);
    uint64_t processors = (uint64_t)m->values->processors_count;
    if (s && s->order == MACHINE_SEND_ORDER)
        return index;
    return s ? index % processors * s->ratio + index / processors : 0;
}

uint64_t machine_index(const struct machine *m, int vpset, uint64_t send_address)
{
    const struct vpset *s = peek(m, vpset);
    if (!s)
        return UINT64_MAX;
    uint64_t processor = send_address / s->ratio, which = send_address % s->ratio;
    uint64_t index = s->order == MACHINE_SEND_ORDER
                         ? send_address
                         : which * (uint64_t)m->values->processors_count + processor;
    return processor < (uint64_t)m->values->processors_count && index < s->count ? index
                                                                                 : UINT64_MAX;
}
