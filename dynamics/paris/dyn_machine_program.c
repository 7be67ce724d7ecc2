/* dyn_machine_program.c - a part of a step, in C/Paris: see dyn_machine.h and step.h. */
#include "dyn_machine_program.h"

/* d[] = the state of the second mass less that of the first. */
static void ends_get(const struct dyn_springs *s, const struct dyn_masses *m)
{
    for (int i = 0; i < STATES; i++) {
        CM_get_1L(s->d[i], s->address[1], m->state[i], REAL_BITS);
        CM_get_1L(s->other, s->address[0], m->state[i], REAL_BITS);
        CM_f_subtract_2_1L(s->d[i], s->other, REAL);
    }
}

/* Where the length is beyond the limit the spring breaks: it has no strength any more. */
static void long_ones_break(const struct dyn_springs *s)
{
    CM_f_gt_1L(s->length, s->limit, REAL);
    CM_logand_context_with_test();
    CM_f_move_constant_1L(s->k, 0, REAL);
    CM_f_move_constant_1L(s->k_rest, 0, REAL);
    CM_f_move_constant_1L(s->c, 0, REAL);
    CM_f_move_constant_1L(s->limit, DYN_MACHINE_BROKEN, REAL);
    CM_set_context();
}

/* pull = (k - k_rest / length) + c (d . dv) / length / length */
static void pull_find(const struct dyn_springs *s)
{
    CM_f_multiply_3_1L(s->length, s->d[STATE_X], s->d[STATE_X], REAL);
    CM_f_multiply_3_1L(s->other, s->d[STATE_Y], s->d[STATE_Y], REAL);
    CM_f_add_2_1L(s->length, s->other, REAL);
    CM_f_sqrt_1_1L(s->length, REAL);
    long_ones_break(s);
    CM_f_move_constant_1L(s->inverse, 0, REAL);
    CM_f_gt_constant_1L(s->length, 0, REAL);
    CM_logand_context_with_test();
    CM_f_divinto_constant_3_1L(s->inverse, s->length, 1, REAL);
    CM_set_context();
    CM_f_multiply_3_1L(s->pull, s->d[STATE_X], s->d[STATE_VX], REAL);
    CM_f_multiply_3_1L(s->other, s->d[STATE_Y], s->d[STATE_VY], REAL);
    CM_f_add_2_1L(s->pull, s->other, REAL);
    CM_f_multiply_2_1L(s->pull, s->c, REAL);
    CM_f_multiply_2_1L(s->pull, s->inverse, REAL);
    CM_f_multiply_2_1L(s->pull, s->inverse, REAL);
    CM_f_multiply_3_1L(s->other, s->k_rest, s->inverse, REAL);
    CM_f_subtract_3_1L(s->other, s->k, s->other, REAL);
    CM_f_add_3_1L(s->pull, s->other, s->pull, REAL);
}

static void forces_send(const struct dyn_springs *s, const struct dyn_masses *m)
{
    for (int axis = 0; axis < 2; axis++) {
        CM_f_multiply_3_1L(s->other, s->pull, s->d[axis], REAL);
        CM_send_with_f_add_1L(m->force[axis], s->address[0], s->other, REAL, CM_no_field);
        CM_f_negate_1_1L(s->other, REAL);
        CM_send_with_f_add_1L(m->force[axis], s->address[1], s->other, REAL, CM_no_field);
    }
}

/* ---- masses ---- */

static void speeds_change(const struct dyn_machine *machine)
{
    const struct dyn_masses *m = &machine->masses;
    for (int axis = 0; axis < 2; axis++) {
        CM_field_id_t v = m->state[STATE_VX + axis], f = m->force[axis];
        CM_f_multiply_2_1L(v, m->keep, REAL);
        CM_f_multiply_2_1L(f, m->kick, REAL);
        CM_f_add_2_1L(v, f, REAL);
        CM_f_add_2_1L(v, m->push[axis], REAL);
        CM_f_min_constant_2_1L(v, machine->speed_limit, REAL);
        CM_f_max_constant_2_1L(v, -machine->speed_limit, REAL);
        CM_f_move_constant_1L(f, 0, REAL);
    }
    for (int axis = 0; axis < 2; axis++) {
        CM_f_multiply_constant_3_1L(m->speed, m->state[STATE_VX + axis], machine->h, REAL);
        CM_f_add_2_1L(m->state[axis], m->speed, REAL);
    }
}

/* One side across an axis; inwards: 1 where places grow inwards, else -1. */
static void side_meet(const struct dyn_machine *machine, int axis, double bound, int inwards)
{
    const struct dyn_masses *m = &machine->masses;
    CM_field_id_t p = m->state[axis], v = m->state[STATE_VX + axis];
    CM_field_id_t t = m->state[STATE_VX + !axis];
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
    CM_f_multiply_constant_3_1L(m->speed, v, -inwards, REAL);
    CM_f_subtract_constant_3_1L(m->back, p, bound, REAL);
    CM_f_multiply_constant_2_1L(m->back, -inwards, REAL);
    CM_f_multiply_constant_3_1L(m->after, m->speed, machine->h, REAL);
    CM_f_min_2_1L(m->back, m->after, REAL);
    CM_f_multiply_3_1L(m->after, m->restitution, m->speed, REAL);
    CM_f_multiply_2_1L(m->back, m->restitution, REAL);
    CM_store_context(m->context); /* slow ones lie */
    CM_f_le_constant_1L(m->speed, machine->slow_speed, REAL);
    CM_logand_context_with_test();
    CM_f_move_constant_1L(m->after, 0, REAL);
    CM_f_move_constant_1L(m->back, 0, REAL);
    CM_load_context(m->context);
    CM_f_multiply_constant_3_1L(p, m->back, inwards, REAL);
    CM_f_add_constant_2_1L(p, bound, REAL);
    CM_f_multiply_constant_3_1L(v, m->after, inwards, REAL);
    /* friction */
    CM_f_add_2_1L(m->after, m->speed, REAL);
    CM_f_multiply_2_1L(m->after, m->friction, REAL);
    CM_f_min_3_1L(m->speed, t, m->after, REAL);
    CM_f_negate_1_1L(m->after, REAL);
    CM_f_max_2_1L(m->speed, m->after, REAL);
    CM_f_subtract_2_1L(t, m->speed, REAL);
    CM_set_context();
}

void dyn_machine_part(const struct dyn_machine *machine)
{
    CM_set_vp_set(machine->springs.set);
    ends_get(&machine->springs, &machine->masses);
    pull_find(&machine->springs);
    forces_send(&machine->springs, &machine->masses);
    CM_set_vp_set(machine->masses.set);
    speeds_change(machine);
    side_meet(machine, 1, machine->least_y, 1);
    side_meet(machine, 1, machine->most_y, -1);
    side_meet(machine, 0, machine->least_x, 1);
    side_meet(machine, 0, machine->most_x, -1);
}
