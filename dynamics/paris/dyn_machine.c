/* dyn_machine.c - a network's masses and springs in two VP sets: see dyn_machine.h. */
#include "dyn_machine.h"
#include "dyn_machine_program.h"

#include <kit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int zero[1], axis[1];

static enum dyn_status said(enum kit_status status)
{
    if (status == KIT_OK)
        return DYN_OK;
    return dyn_fail(status == KIT_NO_MEMORY ? DYN_NO_MEMORY : DYN_BAD_ARGUMENT, "%s",
                    kit_error());
}

static CM_field_id_t real_field(void)
{
    return CM_allocate_heap_field(REAL_BITS);
}

/* A field of the current set from an array of doubles. */
static CM_field_id_t real_of(const double *values, int count)
{
    CM_field_id_t field = real_field();
    int counts[1] = {count};
    CM_f_write_to_news_array_1L(values, zero, zero, counts, axis, field, REAL, 1, counts,
                                CM_float_double);
    return field;
}

static void set_make(CM_geometry_id_t *geometry, CM_vp_set_id_t *set, int count)
{
    int dimensions[1] = {count};
    *geometry = CM_create_geometry(dimensions, 1);
    *set = CM_allocate_vp_set(*geometry);
    CM_set_vp_set(*set);
    CM_set_context();
}

static void masses_make(struct dyn_masses *m, const struct dyn_network *n, double *row)
{
    const struct dyn_prepared *p = &n->prepared;
    m->count = n->masses_count;
    set_make(&m->geometry, &m->set, m->count);
    for (int i = 0; i < STATES; i++) {
        for (int k = 0; k < m->count; k++) {
            const struct dyn_state *s = &n->state[k];
            row[k] = i == STATE_X ? s->x : i == STATE_Y ? s->y : i == STATE_VX ? s->vx : s->vy;
        }
        m->state[i] = real_of(row, m->count);
    }
    for (int i = 0; i < 2; i++) {
        m->force[i] = real_field();
        CM_f_move_constant_1L(m->force[i], 0, REAL);
    }
    m->kick = real_of(p->kick, m->count);
    m->keep = real_of(p->keep, m->count);
    m->push[0] = real_of(p->push_x, m->count);
    m->push[1] = real_of(p->push_y, m->count);
    m->restitution = real_of(p->restitution, m->count);
    m->friction = real_of(p->friction, m->count);
    m->speed = real_field();
    m->after = real_field();
    m->back = real_field();
    m->context = CM_allocate_heap_field(1);
}

/* Springs that fill up a vector are left out: they are last. */
static int springs_in(const struct dyn_packed *packed)
{
    int count = packed->count;
    while (count > 0 && packed->which[count - 1] < 0)
        count--;
    return count;
}

static void springs_make(struct dyn_springs *s, const struct dyn_masses *m,
                         const struct dyn_packed *packed, double *row)
{
    int counts[1] = {s->count};
    set_make(&s->geometry, &s->set, s->count);
    CM_field_id_t place = CM_allocate_stack_field(ADDRESS_BITS);
    for (int end = 0; end < 2; end++) {
        s->address[end] = CM_allocate_heap_field(ADDRESS_BITS);
        CM_u_write_to_news_array_1L(packed->end[end], zero, zero, counts, axis, place,
                                    ADDRESS_BITS, 1, counts, CM_32_bit);
        CM_make_news_coordinate_1L(m->geometry, s->address[end], 0, place, ADDRESS_BITS);
    }
    CM_deallocate_stack_through(place);
    s->k = real_of(packed->k, s->count);
    s->k_rest = real_of(packed->k_rest, s->count);
    s->c = real_of(packed->c, s->count);
    for (int i = 0; i < s->count; i++)
        row[i] = fmin(packed->limit[i], DYN_MACHINE_NEVER);
    s->limit = real_of(row, s->count);
    for (int i = 0; i < STATES; i++)
        s->d[i] = real_field();
    s->other = real_field();
    s->length = real_field();
    s->inverse = real_field();
    s->pull = real_field();
}

static enum dyn_status look(const struct dyn_network *n)
{
    if ((int)n->world.integrator != DYN_SYMPLECTIC)
        return dyn_fail(DYN_BAD_ARGUMENT, "the machine makes symplectic steps only");
    if (n->pulls_count)
        return dyn_fail(DYN_BAD_ARGUMENT, "the machine knows no hands that pull");
    if (!n->masses_count || !springs_in(&n->prepared.springs))
        return dyn_fail(DYN_BAD_ARGUMENT, "the machine needs masses and springs");
    return DYN_OK;
}

static void numbers_set(struct dyn_machine *m, const struct dyn_network *n, double dt_s)
{
    const struct dyn_world *w = &n->world;
    m->h = n->prepared.h;
    m->parts = n->prepared.plan.parts;
    m->dt_s = dt_s;
    m->speed_limit = w->speed_limit;
    m->slow_speed = 2 * m->h * fabs(w->gravity);
    m->least_x = w->left_on > 0 ? w->left : -DYN_EDGE;
    m->most_x = w->right_on > 0 ? w->right : DYN_EDGE;
    m->least_y = w->floor_on > 0 ? w->floor : -DYN_EDGE;
    m->most_y = w->ceiling_on > 0 ? w->ceiling : DYN_EDGE;
    m->of_masses = n->masses_count;
    m->of_springs = n->springs_count;
}

enum dyn_status dyn_machine_create(struct dyn_network *n, double dt_s, struct dyn_machine **out)
{
    struct dyn_plan plan;
    *out = NULL;
    enum dyn_status status = dyn_network_plan(n, dt_s, &plan);
    if (status == DYN_OK)
        status = look(n);
    if (status == DYN_OK)
        status = said(kit_attach());
    if (status != DYN_OK)
        return status;
    int springs = springs_in(&n->prepared.springs);
    int most = springs > n->masses_count ? springs : n->masses_count;
    struct dyn_machine *m = calloc(1, sizeof *m);
    double *row = malloc((size_t)most * sizeof *row);
    if (m)
        m->which = malloc((size_t)springs * sizeof *m->which);
    if (!m || !row || !m->which) {
        free(row);
        dyn_machine_destroy(m);
        return dyn_fail(DYN_NO_MEMORY, "no memory for %d springs on the machine", springs);
    }
    memcpy(m->which, n->prepared.springs.which, (size_t)springs * sizeof *m->which);
    m->springs.count = springs;
    numbers_set(m, n, dt_s);
    kit_begin();
    masses_make(&m->masses, n, row);
    springs_make(&m->springs, &m->masses, &n->prepared.springs, row);
    free(row);
    status = said(kit_leave());
    if (status == DYN_OK)
        *out = m;
    else
        dyn_machine_destroy(m);
    return status;
}

static void set_free(CM_vp_set_id_t set, CM_geometry_id_t geometry)
{
    if (set)
        CM_deallocate_vp_set(set); /* its fields go too */
    if (geometry)
        CM_deallocate_geometry(geometry);
}

void dyn_machine_destroy(struct dyn_machine *m)
{
    if (!m)
        return;
    set_free(m->springs.set, m->springs.geometry);
    set_free(m->masses.set, m->masses.geometry);
    free(m->which);
    free(m);
}

enum dyn_status dyn_machine_step(struct dyn_machine *m, int count)
{
    if (count < 0)
        return dyn_fail(DYN_BAD_ARGUMENT, "the count of steps cannot be %d", count);
    kit_enter(m->springs.set);
    for (int step = 0; step < count; step++)
        for (int part = 0; part < m->parts; part++)
            dyn_machine_part(m);
    m->steps += count;
    return said(kit_leave());
}

enum dyn_status dyn_machine_finish(struct dyn_machine *m)
{
    return said(kit_finish(m->masses.set));
}

static void real_read(double *values, int count, CM_field_id_t field)
{
    int counts[1] = {count};
    CM_f_read_from_news_array_1L(values, zero, zero, counts, axis, field, REAL, 1, counts,
                                 CM_float_double);
}

enum dyn_status dyn_machine_read(struct dyn_machine *m, struct dyn_network *n)
{
    size_t masses = (size_t)m->masses.count, springs = (size_t)m->springs.count;
    if (n->masses_count != m->of_masses || n->springs_count != m->of_springs)
        return dyn_fail(DYN_BAD_ARGUMENT, "it is not the network that the machine has");
    double *values = malloc((STATES * masses + springs) * sizeof *values);
    if (!values)
        return dyn_fail(DYN_NO_MEMORY, "no memory to read %zu masses", masses);
    kit_enter(m->masses.set);
    for (size_t i = 0; i < STATES; i++)
        real_read(values + i * masses, m->masses.count, m->masses.state[i]);
    CM_set_vp_set(m->springs.set);
    real_read(values + STATES * masses, m->springs.count, m->springs.limit);
    enum dyn_status status = said(kit_leave());
    for (size_t i = 0; status == DYN_OK && i < masses; i++)
        n->state[i] = (struct dyn_state){values[i], values[masses + i], values[2 * masses + i],
                                         values[3 * masses + i]};
    for (size_t i = 0; status == DYN_OK && i < springs; i++)
        if (values[STATES * masses + i] >= DYN_MACHINE_BROKEN)
            n->broken[m->which[i]] = true;
    for (; status == DYN_OK && m->steps > 0; m->steps--)
        n->time_s += m->dt_s;
    n->changed = true;
    free(values);
    return status;
}
