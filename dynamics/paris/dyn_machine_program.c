/* dyn_machine_program.c - a part of a step, in C/Paris: see dyn_machine.h and step.h. */
#include "dyn_machine_program.h"

#include <internal.h>

/* What a spring needs for a while: fields that are new each time are in no memory unless they
 * are looked at. */
struct between {
    CM_field_id_t force[2], d[STATES], other, length, inverse, pull;
};

static CM_field_id_t real_for_a_while(void)
{
    return CM_allocate_stack_field(REAL_BITS);
}

static struct between between_make(void)
{
    struct between b;
    for (int i = 0; i < 2; i++)
        b.force[i] = real_for_a_while();
    for (int i = 0; i < STATES; i++)
        b.d[i] = real_for_a_while();
    b.other = real_for_a_while();
    b.length = real_for_a_while();
    b.inverse = real_for_a_while();
    b.pull = real_for_a_while();
    return b;
}

/* Nobody is going to ask for them. */
static void flags_clear(void)
{
    CM_clear_test();
    CM_clear_overflow();
}

/* d[] = the state of the second mass less that of the first. */
static void ends_get(const struct dyn_springs *s, const struct dyn_masses *m,
                     const struct between *b)
{
    for (int i = 0; i < STATES; i++) {
        CM_get_1L(b->d[i], s->address[1], m->state[i], REAL_BITS);
        CM_get_1L(b->other, s->address[0], m->state[i], REAL_BITS);
        CM_f_subtract_2_1L(b->d[i], b->other, REAL);
    }
}

/* A spring whose length is beyond the limit breaks: it has no strength any more. */
static void long_ones_break(const struct dyn_springs *s, const struct between *b)
{
    if (!s->any_breaks)
        return;
    CM_f_gt_1L(b->length, s->limit, REAL);
    CM_logior_test(s->broken);
    CM_store_test(s->broken);
}

/* pull = (k - k_rest / length) + c (d . dv) / length / length */
static void pull_find(const struct dyn_springs *s, const struct between *b)
{
    CM_f_multiply_3_1L(b->length, b->d[STATE_X], b->d[STATE_X], REAL);
    CM_f_multiply_3_1L(b->other, b->d[STATE_Y], b->d[STATE_Y], REAL);
    CM_f_add_2_1L(b->length, b->other, REAL);
    CM_f_sqrt_1_1L(b->length, REAL);
    long_ones_break(s, b);
    CM_f_move_constant_1L(b->inverse, 0, REAL);
    CM_f_gt_constant_1L(b->length, 0, REAL);
    CM_logand_context_with_test();
    CM_f_divinto_constant_3_1L(b->inverse, b->length, 1, REAL);
    CM_set_context();
    CM_f_multiply_3_1L(b->pull, b->d[STATE_X], b->d[STATE_VX], REAL);
    CM_f_multiply_3_1L(b->other, b->d[STATE_Y], b->d[STATE_VY], REAL);
    CM_f_add_2_1L(b->pull, b->other, REAL);
    CM_f_multiply_2_1L(b->pull, s->c, REAL);
    CM_f_multiply_2_1L(b->pull, b->inverse, REAL);
    CM_f_multiply_2_1L(b->pull, b->inverse, REAL);
    CM_f_multiply_3_1L(b->other, s->k_rest, b->inverse, REAL);
    CM_f_subtract_3_1L(b->other, s->k, b->other, REAL);
    CM_f_add_3_1L(b->pull, b->other, b->pull, REAL);
    if (!s->any_breaks)
        return;
    CM_load_context(s->broken);
    CM_f_move_constant_1L(b->pull, 0, REAL);
    CM_set_context();
}

static void forces_find(const struct dyn_springs *s, const struct dyn_masses *m,
                        const struct between *b)
{
    ends_get(s, m, b);
    pull_find(s, b);
    for (int axis = 0; axis < 2; axis++)
        CM_f_multiply_3_1L(b->force[axis], b->pull, b->d[axis], REAL);
    CM_deallocate_stack_through(b->d[0]);
    flags_clear();
}

/* To masses that have no slot for it. */
static void forces_send(const struct dyn_springs *s, const struct dyn_masses *m,
                        const struct between *b)
{
    if (!s->any_sends[0] && !s->any_sends[1])
        return;
    CM_field_id_t force = real_for_a_while();
    for (int axis = 0; axis < 2; axis++)
        for (int end = 0; end < 2; end++) {
            if (!s->any_sends[end])
                continue;
            CM_f_move_1L(force, b->force[axis], REAL);
            if (end)
                CM_f_negate_1_1L(force, REAL);
            CM_load_context(s->sends[end]);
            CM_send_with_f_add_1L(m->force[axis], s->address[end], force, REAL, CM_no_field);
            CM_set_context();
        }
    CM_deallocate_stack_through(force);
    flags_clear();
}

/* ---- masses ---- */

/* Each mass gets the forces of its springs: a get is as fast as a load from memory, where many
 * that send to one are not. */
static void forces_get(const struct between *b, const struct dyn_masses *m)
{
    CM_field_id_t got = real_for_a_while();
    for (int axis = 0; axis < 2; axis++)
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < m->slots[end]; i++) {
                CM_get_1L(got, m->slot[end][i], b->force[axis], REAL_BITS);
                if (end)
                    CM_f_subtract_2_1L(m->force[axis], got, REAL);
                else
                    CM_f_add_2_1L(m->force[axis], got, REAL);
            }
    CM_deallocate_stack_through(got);
}

static void speeds_change(const struct dyn_machine *machine)
{
    const struct dyn_masses *m = &machine->masses;
    const CM_field_id_t *gained = m->gained;
    CM_field_id_t way = real_for_a_while();
    for (int axis = 0; axis < 2; axis++) {
        CM_field_id_t v = m->state[STATE_VX + axis], f = m->force[axis];
        if (machine->bouncing)
            CM_f_negate_2_1L(gained[axis], v, REAL);
        CM_f_multiply_2_1L(v, m->keep, REAL);
        CM_f_multiply_2_1L(f, m->kick, REAL);
        CM_f_add_2_1L(v, f, REAL);
        CM_f_add_2_1L(v, m->push[axis], REAL);
        CM_f_min_constant_2_1L(v, machine->speed_limit, REAL);
        CM_f_max_constant_2_1L(v, -machine->speed_limit, REAL);
        if (machine->bouncing)
            CM_f_add_2_1L(gained[axis], v, REAL);
        CM_f_move_constant_1L(f, 0, REAL);
    }
    for (int axis = 0; axis < 2; axis++) {
        CM_f_multiply_constant_3_1L(way, m->state[STATE_VX + axis], machine->h, REAL);
        CM_f_add_2_1L(m->state[axis], way, REAL);
    }
    CM_deallocate_stack_through(way);
}

/* Reflects masses at one side of an axis; inwards: 1 if coordinates grow inwards, else -1.
 * Those that bounce are left as they are: dyn_machine.c. */
static void side_meet(const struct dyn_machine *machine, int axis, double bound, int inwards)
{
    const struct dyn_masses *m = &machine->masses;
    CM_field_id_t p = m->state[axis], v = m->state[STATE_VX + axis];
    CM_field_id_t t = m->state[STATE_VX + !axis];
    CM_field_id_t speed = real_for_a_while(), grip = real_for_a_while();
    const CM_field_id_t hit = CM_allocate_stack_field(1), came = CM_allocate_stack_field(1);
    if (inwards > 0)
        CM_f_lt_constant_1L(p, bound, REAL);
    else
        CM_f_gt_constant_1L(p, bound, REAL);
    CM_logand_context_with_test();
    if (inwards > 0)
        CM_f_lt_constant_1L(v, 0, REAL);
    else
        CM_f_gt_constant_1L(v, 0, REAL);
    CM_logand_context_with_test();
    CM_store_context(hit);
    CM_f_multiply_constant_3_1L(speed, v, -inwards, REAL);
    if (machine->bouncing) {
        CM_f_gt_constant_1L(speed, machine->slow_speed, REAL);
        CM_logand_context_with_test();
        CM_f_gt_constant_1L(m->restitution, 0, REAL);
        CM_logand_context_with_test();
        /* which moved so before the part, or are elastic */
        CM_f_subtract_3_1L(grip, v, m->gained[axis], REAL);
        CM_f_multiply_constant_2_1L(grip, -inwards, REAL);
        CM_f_gt_constant_1L(grip, 0, REAL);
        CM_store_test(came);
        CM_f_gt_constant_1L(m->restitution, DYN_ELASTIC, REAL);
        CM_logior_test(came);
        CM_logand_context_with_test();
        CM_u_move_constant_1L(m->bounces, 1, 1);
        CM_invert_context();
        CM_logand_context(hit);
    }
    CM_f_move_constant_1L(p, bound, REAL);
    CM_f_move_constant_1L(v, 0, REAL);
    /* friction */
    CM_f_multiply_3_1L(grip, speed, m->friction, REAL);
    CM_f_min_3_1L(speed, t, grip, REAL);
    CM_f_negate_1_1L(grip, REAL);
    CM_f_max_2_1L(speed, grip, REAL);
    CM_f_subtract_2_1L(t, speed, REAL);
    CM_set_context();
    CM_deallocate_stack_through(speed);
}

static void bound_meet(const struct dyn_machine *machine, int axis, int inwards)
{
    const struct dyn_bound *bound = inwards > 0 ? &machine->least[axis] : &machine->most[axis];
    CM_field_id_t place = machine->masses.state[axis];
    if (bound->side)
        side_meet(machine, axis, bound->at, inwards);
    else if (inwards > 0)
        CM_f_max_constant_2_1L(place, bound->at, REAL);
    else
        CM_f_min_constant_2_1L(place, bound->at, REAL);
}

void dyn_machine_part(const struct dyn_machine *machine)
{
    const struct dyn_springs *springs = &machine->springs;
    CM_set_vp_set(springs->set);
    struct between b = between_make();
    forces_find(springs, &machine->masses, &b);
    forces_send(springs, &machine->masses, &b);
    CM_set_vp_set(machine->masses.set);
    forces_get(&b, &machine->masses);
    speeds_change(machine);
    if (machine->bouncing)
        CM_u_move_constant_1L(machine->masses.bounces, 0, 1);
    for (int axis = 1; axis >= 0; axis--) {
        bound_meet(machine, axis, 1);
        bound_meet(machine, axis, -1);
    }
    flags_clear();
    CM_set_vp_set(springs->set);
    CM_deallocate_stack_through(b.force[0]);
}
