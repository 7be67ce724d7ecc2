/* dyn_machine.c - a network's masses and springs in two VP sets: see dyn_machine.h. */
#include "dyn_machine.h"
#include "dyn_machine_program.h"

#include <bounce.h>

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

/* Makes a field of the current set from an array of doubles. A number that all have is in no
 * memory. */
static CM_field_id_t real_of(const double *values, int count)
{
    CM_field_id_t field = real_field();
    int counts[1] = {count};
    if (!memcmp(values, values + 1, ((size_t)count - 1) * sizeof *values)) {
        CM_f_move_constant_1L(field, values[0], REAL);
        return field;
    }
    CM_f_write_to_news_array_1L(values, zero, zero, counts, axis, field, REAL, 1, counts,
                                CM_float_double);
    return field;
}

/* The arrays with which slots are found. */
struct slots_room {
    int32_t *degrees, *which; /* as many as masses */
    int32_t *sends;           /* as many as springs, and one */
};

/* In send order: a processor's address is its number. */
static void set_make(CM_geometry_id_t *geometry, CM_vp_set_id_t *set, int count)
{
    struct CM_axis_descriptor line = {
        .length = (unsigned)count, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&line};
    *geometry = CM_create_detailed_geometry(axes, 1);
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
}

/* The number of springs without padding, which is at the end. */
static int springs_in(const struct dyn_packed *packed)
{
    int count = packed->count;
    while (count > 0 && packed->which[count - 1] < 0)
        count--;
    return count;
}

/* A field with the send addresses in the geometry: element i is the address of processor
 * numbers[i]. */
static CM_field_id_t addresses_of(CM_geometry_id_t geometry, const int32_t *numbers, int count)
{
    int counts[1] = {count};
    CM_field_id_t place = CM_allocate_stack_field(ADDRESS_BITS),
                  address = CM_allocate_heap_field(ADDRESS_BITS);
    CM_u_write_to_news_array_1L(numbers, zero, zero, counts, axis, place, ADDRESS_BITS, 1,
                                counts, CM_32_bit);
    CM_make_news_coordinate_1L(geometry, address, 0, place, ADDRESS_BITS);
    CM_deallocate_stack_through(place);
    return address;
}

/* The number of slots of each mass: the most springs that any mass has; or, if that is more
 * than SLOTS_MOST, the greatest number that more than an eighth of the masses have. */
static int slots_needed(const int32_t *degrees, int count)
{
    int with[SLOTS_MOST + 2] = {0}; /* masses with so many springs or more */
    for (int i = 0; i < count; i++)
        for (int k = 0; k <= degrees[i] && k <= SLOTS_MOST + 1; k++)
            with[k]++;
    int slots = SLOTS_MOST;
    while (slots > 0 && with[slots] <= (with[SLOTS_MOST + 1] ? count / 8 : 0))
        slots--;
    return slots;
}

/* Which springs each mass gets from, and which send. which: as many as masses. */
static void slots_make(struct dyn_masses *m, struct dyn_springs *s,
                       const struct dyn_order *order, int end, struct slots_room *room)
{
    memset(room->degrees, 0, (size_t)m->count * sizeof *room->degrees);
    for (int i = 0; i < s->count; i++)
        room->degrees[order->end[end][i]]++;
    m->slots[end] = slots_needed(room->degrees, m->count);
    for (int k = 0; k < m->slots[end]; k++) {
        /* The k-th spring of each mass. */
        memset(room->degrees, 0, (size_t)m->count * sizeof *room->degrees);
        for (int i = 0; i < m->count; i++)
            room->which[i] = s->count;
        for (int i = 0; i < s->count; i++) {
            int mass = order->end[end][i];
            if (room->degrees[mass]++ == k)
                room->which[mass] = i;
        }
        CM_set_vp_set(m->set);
        m->slot[end][k] = addresses_of(s->geometry, room->which, m->count);
    }
    memset(room->degrees, 0, (size_t)m->count * sizeof *room->degrees);
    s->any_sends[end] = false;
    for (int i = 0; i < s->count; i++) {
        room->sends[i] = room->degrees[order->end[end][i]]++ >= m->slots[end];
        s->any_sends[end] = s->any_sends[end] || room->sends[i];
    }
    room->sends[s->count] = 0;
    if (s->any_sends[end]) {
        int counts[1] = {s->count + 1};
        CM_set_vp_set(s->set);
        s->sends[end] = CM_allocate_heap_field(1);
        CM_u_write_to_news_array_1L(room->sends, zero, zero, counts, axis, s->sends[end], 1, 1,
                                    counts, CM_32_bit);
    }
}

/* With one more at the end, which pulls at nothing: both its ends are one mass, so it has no
 * length. */
static CM_field_id_t real_of_springs(const double *values, const struct dyn_order *order,
                                     double *row)
{
    for (int i = 0; i < order->count; i++)
        row[i] = values[order->packed[i]];
    row[order->count] = values[0];
    return real_of(row, order->count + 1);
}

static void springs_make(struct dyn_springs *s, const struct dyn_masses *m,
                         const struct dyn_packed *packed, const struct dyn_order *order,
                         double *row, int32_t *ends)
{
    set_make(&s->geometry, &s->set, s->count + 1);
    for (int end = 0; end < 2; end++) {
        memcpy(ends, order->end[end], (size_t)s->count * sizeof *ends);
        ends[s->count] = 0;
        s->address[end] = addresses_of(m->geometry, ends, s->count + 1);
    }
    s->k = real_of_springs(packed->k, order, row);
    s->k_rest = real_of_springs(packed->k_rest, order, row);
    s->c = real_of_springs(packed->c, order, row);
    for (int i = 0; i < s->count; i++)
        row[i] = fmin(packed->limit[order->packed[i]], DYN_MACHINE_NEVER);
    row[s->count] = DYN_MACHINE_NEVER;
    s->limit = real_of(row, s->count + 1);
    s->broken = CM_allocate_heap_field(1);
    s->any_breaks = false;
    for (int i = 0; i < s->count; i++)
        s->any_breaks = s->any_breaks || row[i] < DYN_MACHINE_NEVER;
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

static struct dyn_bound bound_of(bool on, double side, double edge)
{
    return (struct dyn_bound){on ? side : edge, on};
}

static void numbers_set(struct dyn_machine *m, const struct dyn_network *n, double dt_s)
{
    const struct dyn_world *w = &n->world;
    m->h = n->prepared.h;
    m->parts = n->prepared.plan.parts;
    m->dt_s = dt_s;
    m->speed_limit = w->speed_limit;
    m->slow_speed = 2 * m->h * fabs(w->gravity);
    m->least[0] = bound_of(w->left_on > 0, w->left, -DYN_EDGE);
    m->most[0] = bound_of(w->right_on > 0, w->right, DYN_EDGE);
    m->least[1] = bound_of(w->floor_on > 0, w->floor, -DYN_EDGE);
    m->most[1] = bound_of(w->ceiling_on > 0, w->ceiling, DYN_EDGE);
    m->of_masses = n->masses_count;
    m->of_springs = n->springs_count;
}

/* Bounces are few and each is a small computation of its own, on its springs, too: the front
 * end makes them, with the library's own function, on a copy. */
static enum dyn_status bouncing_make(struct dyn_machine *m, struct dyn_network *n, double dt_s)
{
    struct dyn_masses *masses = &m->masses;
    struct dyn_plan plan;
    if (!dyn_bounces_possible(&n->world))
        return DYN_OK;
    m->values = malloc((STATES + 2) * (size_t)n->masses_count * sizeof *m->values);
    if (!m->values)
        return dyn_fail(DYN_NO_MEMORY, "no memory for the bounces of %d masses",
                        n->masses_count);
    enum dyn_status status = dyn_network_create(&m->bouncing);
    if (status == DYN_OK)
        status = dyn_network_copy(m->bouncing, n);
    if (status == DYN_OK)
        status = dyn_network_plan(m->bouncing, dt_s, &plan);
    if (status != DYN_OK)
        return status;
    m->bouncing->world.clank_speed = INFINITY; /* nothing is heard */
    CM_set_vp_set(masses->set);
    masses->gained[0] = real_field();
    masses->gained[1] = real_field();
    masses->bounces = CM_allocate_heap_field(1);
    return DYN_OK;
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
    size_t most = (size_t)(springs > n->masses_count ? springs : n->masses_count) + 1;
    struct dyn_machine *m = calloc(1, sizeof *m);
    double *row = malloc(most * sizeof *row);
    int32_t *numbers = malloc(3 * most * sizeof *numbers);
    const struct dyn_packed *packed = &n->prepared.springs;
    bool dealt = m && dyn_machine_deal(packed, springs, &m->order);
    if (m) {
        m->which = malloc((size_t)springs * sizeof *m->which);
        m->broken = calloc((size_t)springs + 1, sizeof *m->broken);
    }
    if (!dealt || !row || !numbers || !m->which || !m->broken) {
        free(row);
        free(numbers);
        dyn_machine_destroy(m);
        return dyn_fail(DYN_NO_MEMORY, "no memory for %d springs on the machine", springs);
    }
    for (int i = 0; i < springs; i++)
        m->which[i] = packed->which[m->order.packed[i]];
    m->springs.count = springs;
    numbers_set(m, n, dt_s);
    kit_begin();
    masses_make(&m->masses, n, row);
    springs_make(&m->springs, &m->masses, packed, &m->order, row, numbers);
    struct slots_room room = {numbers, numbers + most, numbers + 2 * most};
    for (int end = 0; end < 2; end++)
        slots_make(&m->masses, &m->springs, &m->order, end, &room);
    free(row);
    free(numbers);
    enum dyn_status bouncing = bouncing_make(m, n, dt_s);
    status = said(kit_leave());
    if (status == DYN_OK)
        status = bouncing;
    if (status == DYN_OK)
        *out = m;
    else
        dyn_machine_destroy(m);
    return status;
}

static void set_free(CM_vp_set_id_t set, CM_geometry_id_t geometry)
{
    if (set)
        CM_deallocate_vp_set(set); /* the set's fields go with it */
    if (geometry)
        CM_deallocate_geometry(geometry);
}

void dyn_machine_destroy(struct dyn_machine *m)
{
    if (!m)
        return;
    set_free(m->springs.set, m->springs.geometry);
    set_free(m->masses.set, m->masses.geometry);
    dyn_network_destroy(m->bouncing);
    free(m->values);
    free(m->which);
    dyn_order_free(&m->order);
    free(m->broken);
    free(m);
}

static void real_read(double *values, int count, CM_field_id_t field)
{
    int counts[1] = {count};
    CM_f_read_from_news_array_1L(values, zero, zero, counts, axis, field, REAL, 1, counts,
                                 CM_float_double);
}

/* Springs that have broken on the machine pull no more. */
static void broken_forget(struct dyn_machine *m, uint32_t *broken)
{
    struct dyn_packed *s = &m->bouncing->prepared.springs;
    int counts[1] = {m->springs.count};
    CM_set_vp_set(m->springs.set);
    CM_u_read_from_news_array_1L(broken, zero, zero, counts, axis, m->springs.broken, 1, 1,
                                 counts, CM_32_bit);
    CM_set_vp_set(m->masses.set);
    for (int i = 0; i < m->springs.count; i++)
        if (broken[i])
            s->k[m->order.packed[i]] = s->k_rest[m->order.packed[i]] = 0;
}

/* Reads the masses, and finds those that the machine left beyond a side. */
static void bounces_note(struct dyn_machine *m, struct dyn_job *job)
{
    int count = m->masses.count;
    size_t row = (size_t)count;
    double *v = m->values;
    for (int i = 0; i < STATES; i++)
        real_read(v + (size_t)i * row, count, m->masses.state[i]);
    for (int i = 0; i < 2; i++)
        real_read(v + (size_t)(STATES + i) * row, count, m->masses.gained[i]);
    for (int i = 0; i < count; i++, v++) {
        struct dyn_state s = {v[0], v[row], v[2 * row], v[3 * row]};
        double hx = s.vx - v[4 * row], hy = s.vy - v[5 * row];
        const struct {
            enum dyn_side side;
            double beyond, speed, had;
        } sides[] = {{DYN_FLOOR, job->least_y - s.y, -s.vy, -hy},
                     {DYN_CEILING, s.y - job->most_y, s.vy, hy},
                     {DYN_LEFT, job->least_x - s.x, -s.vx, -hx},
                     {DYN_RIGHT, s.x - job->most_x, s.vx, hx}};
        job->state[i] = s;
        for (int k = 0; k < 4 && job->restitution[i] > 0; k++)
            if (sides[k].beyond > 0 && sides[k].speed > job->slow_speed &&
                (sides[k].had > 0 || job->restitution[i] > DYN_ELASTIC))
                job->bounces[job->bounces_count++] =
                    (struct dyn_bounce){i, sides[k].side, {v[4 * row], v[5 * row]}};
    }
}

static void state_write(struct dyn_machine *m, const struct dyn_state *state)
{
    int count = m->masses.count, counts[1] = {count};
    for (int i = 0; i < STATES; i++) {
        for (int k = 0; k < count; k++)
            m->values[k] = (&state[k].x)[i];
        CM_f_write_to_news_array_1L(m->values, zero, zero, counts, axis, m->masses.state[i],
                                    REAL, 1, counts, CM_float_double);
    }
}

/* The bounces of the part that was made. */
static void bounces_make(struct dyn_machine *m)
{
    CM_set_vp_set(m->masses.set);
    CM_set_context();
    if (!CM_global_logior_1L(m->masses.bounces, 1))
        return;
    struct dyn_job job = dyn_job_make(m->bouncing, 0);
    if (m->springs.any_breaks)
        broken_forget(m, m->broken);
    bounces_note(m, &job);
    dyn_bounces_make(&job);
    state_write(m, job.state);
}

enum dyn_status dyn_machine_step(struct dyn_machine *m, int count)
{
    if (count < 0)
        return dyn_fail(DYN_BAD_ARGUMENT, "the count of steps cannot be %d", count);
    kit_enter(m->springs.set);
    for (int step = 0; step < count; step++)
        for (int part = 0; part < m->parts; part++) {
            dyn_machine_part(m);
            if (m->bouncing)
                bounces_make(m);
        }
    m->steps += count;
    return said(kit_leave());
}

enum dyn_status dyn_machine_finish(struct dyn_machine *m)
{
    return said(kit_finish(m->masses.set));
}

enum dyn_status dyn_machine_read(struct dyn_machine *m, struct dyn_network *n)
{
    size_t masses = (size_t)m->masses.count, springs = (size_t)m->springs.count;
    if (n->masses_count != m->of_masses || n->springs_count != m->of_springs)
        return dyn_fail(DYN_BAD_ARGUMENT, "it is not the network that the machine has");
    double *values = malloc(STATES * masses * sizeof *values);
    uint32_t *broken = m->broken;
    if (!values) {
        return dyn_fail(DYN_NO_MEMORY, "no memory to read %zu masses", masses);
    }
    kit_enter(m->masses.set);
    for (size_t i = 0; i < STATES; i++)
        real_read(values + i * masses, m->masses.count, m->masses.state[i]);
    if (m->springs.any_breaks) {
        int counts[1] = {m->springs.count};
        CM_set_vp_set(m->springs.set);
        CM_u_read_from_news_array_1L(broken, zero, zero, counts, axis, m->springs.broken, 1, 1,
                                     counts, CM_32_bit);
    }
    enum dyn_status status = said(kit_leave());
    for (size_t i = 0; status == DYN_OK && i < masses; i++)
        n->state[i] = (struct dyn_state){values[i], values[masses + i], values[2 * masses + i],
                                         values[3 * masses + i]};
    for (size_t i = 0; status == DYN_OK && i < springs; i++)
        if (broken[i])
            n->broken[m->which[i]] = true;
    for (; status == DYN_OK && m->steps > 0; m->steps--)
        n->time_s += m->dt_s;
    n->changed = true;
    free(values);
    return status;
}
