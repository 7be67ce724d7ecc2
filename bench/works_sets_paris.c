/* works_sets_paris.c - programs of works.h in C/Paris: gets along both axes, several VP sets,
 * vectors with looks, few of many processors. */
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "of_machine.h"
#include "paris_internal.h"
#include "works_paris.h"

/* ---- Fourier ---- */

static unsigned int log2_of(int n)
{
    unsigned int bits = 0;
    while (1 << bits < n)
        bits++;
    return bits;
}

/* The field of a stage's factors: real parts, then imaginary ones. */
static CM_field_id_t factors(const struct work_paris *p, unsigned int axis, unsigned int stage)
{
    return p->array + (axis * log2_of(p->side) + stage) * 2 * WORD;
}

static bool factors_upload(const struct work_paris *p, unsigned int axis, unsigned int stage)
{
    const int side = p->side, step = side >> (stage + 1);
    bool good = true;
    for (int part = 0; good && part < 2; part++) {
        for (int i = 0; i < p->n; i++) {
            const int x = axis ? i % side : i / side;
            float of[2];
            work_twiddle((x & ((1 << stage) - 1)) * step, side, &of[0], &of[1]);
            memcpy(&p->words[i], &of[part], sizeof of[part]);
        }
        good = bench_machine_said(
            machine_field_upload(paris_machine(), factors(p, axis, stage) + (part ? WORD : 0),
                                 MACHINE_UINT(WORD), p->words));
    }
    return good;
}

bool work_fourier_prepare(struct work_paris *p)
{
    const unsigned int stages = log2_of(p->side);
    bool good = true;
    p->array = CM_allocate_heap_field(2 * stages * 2 * WORD);
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_my_news_coordinate_1L(p->f[6] + axis * WORD, axis, WORD);
        for (unsigned int stage = 0; good && stage < stages; stage++)
            good = factors_upload(p, axis, stage);
    }
    return good;
}

/* x, y: the number, real and imaginary. One of a pair becomes the sum, the other the difference
 * times a factor. */
static void butterflies(const struct work_paris *p, unsigned int axis, unsigned int stage)
{
    const CM_field_id_t x = p->f[0], y = p->f[1], a = p->f[2], b = p->f[3], address = p->f[4],
                        coordinate = p->f[5], me = p->f[6] + axis * WORD,
                        re = factors(p, axis, stage), im = re + WORD;
    CM_logxor_constant_3_1L(coordinate, me, 1ul << stage, WORD);
    CM_my_send_address(address);
    CM_deposit_news_coordinate_1L(p->geometry, address, axis, coordinate, WORD);
    CM_get_1L(a, address, x, WORD);
    CM_get_1L(b, address, y, WORD);
    CM_load_context(me + stage);
    CM_f_negate_1_1L(x, S, E);
    CM_f_negate_1_1L(y, S, E);
    CM_set_context();
    CM_f_add_2_1L(x, a, S, E);
    CM_f_add_2_1L(y, b, S, E);
    CM_load_context(me + stage);
    CM_f_multiply_3_1L(a, x, im, S, E);
    CM_f_multiply_3_1L(b, y, im, S, E);
    CM_f_multiply_2_1L(x, re, S, E);
    CM_f_subtract_2_1L(x, b, S, E);
    CM_f_multiply_2_1L(y, re, S, E);
    CM_f_add_2_1L(y, a, S, E);
    CM_set_context();
}

uint32_t work_paris_fourier(const struct work_paris *p, uint32_t turn)
{
    work_part_make(p, p->f[0], 0);
    work_part_make(p, p->f[1], 12);
    CM_f_add_constant_2_1L(p->f[0], turn, S, E);
    for (unsigned int axis = 2; axis-- > 0;)
        for (unsigned int stage = log2_of(p->side); stage-- > 0;)
            butterflies(p, axis, stage);
    return work_paris_weighed(p->f[0], p->odd) + work_paris_weighed(p->f[1], p->odd);
}

/* ---- multigrid ---- */

/* dest: the address in that geometry of the processor whose coordinates are ours, doubled or
 * halved. */
static void address_make(CM_field_id_t dest, CM_geometry_id_t there, bool doubled,
                         CM_field_id_t spare)
{
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_my_news_coordinate_1L(spare, axis, WORD);
        CM_u_shift_constant_2_1L(spare, doubled ? 1 : -1, WORD);
        if (axis == 0)
            CM_make_news_coordinate_1L(there, dest, axis, spare, WORD);
        else
            CM_deposit_news_coordinate_1L(there, dest, axis, spare, WORD);
    }
}

void work_multigrid_prepare(struct work_paris *p)
{
    for (int k = 0; k < WORK_GRIDS; k++) {
        struct work_grid *g = &p->grids[k];
        g->side = p->side >> k;
        unsigned int sides[2] = {(unsigned int)g->side, (unsigned int)g->side};
        g->geometry = k ? CM_create_geometry(sides, 2) : p->geometry;
        g->set = k ? CM_allocate_vp_set(g->geometry) : p->set;
        CM_set_vp_set(g->set);
        CM_set_context();
        CM_field_id_t *const fields[] = {&g->u,     &g->f,     &g->sum,
                                         &g->other, &g->finer, &g->coarser};
        for (int i = 0; i < 6; i++)
            *fields[i] = CM_allocate_heap_field(WORD);
    }
    for (int k = 0; k < WORK_GRIDS; k++) {
        const struct work_grid *g = &p->grids[k];
        CM_set_vp_set(g->set);
        if (k)
            address_make(g->finer, g[-1].geometry, true, g->other);
        if (k + 1 < WORK_GRIDS)
            address_make(g->coarser, g[1].geometry, false, g->other);
    }
    CM_set_vp_set(p->set);
    work_part_make(p, p->grids[0].f, 0);
}

/* sum = f and the four neighbours */
static void neighbours_add(const struct work_grid *g)
{
    CM_f_move_1L(g->sum, g->f, S, E);
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_get_from_news_1L(g->other, g->u, axis, CM_upward, WORD);
        CM_f_add_2_1L(g->sum, g->other, S, E);
        CM_get_from_news_1L(g->other, g->u, axis, CM_downward, WORD);
        CM_f_add_2_1L(g->sum, g->other, S, E);
    }
}

static void smooth(const struct work_grid *g, int times)
{
    for (int i = 0; i < times; i++) {
        neighbours_add(g);
        CM_f_multiply_constant_2_1L(g->sum, 0.25, S, E);
        CM_f_subtract_2_1L(g->sum, g->u, S, E);
        CM_f_multiply_constant_2_1L(g->sum, 0.75, S, E);
        CM_f_add_2_1L(g->u, g->sum, S, E);
    }
}

/* What is left to solve for, to the next grid: the sum of four. */
static void restrict_from(const struct work_grid *g)
{
    neighbours_add(g);
    CM_f_multiply_constant_3_1L(g->other, g->u, 4, S, E);
    CM_f_subtract_2_1L(g->sum, g->other, S, E);
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_get_from_news_1L(g->other, g->sum, axis, CM_upward, WORD);
        CM_f_add_2_1L(g->sum, g->other, S, E);
    }
    CM_set_vp_set(g[1].set);
    CM_get_1L(g[1].f, g[1].finer, g->sum, WORD);
    CM_f_move_zero_1L(g[1].u, S, E);
}

uint32_t work_paris_multigrid(const struct work_paris *p, uint32_t turn)
{
    const struct work_grid *grids = p->grids;
    CM_f_move_constant_1L(grids[0].u, turn, S, E);
    for (int cycle = 0; cycle < WORK_CYCLES; cycle++) {
        for (int k = 0; k + 1 < WORK_GRIDS; k++) {
            smooth(&grids[k], WORK_SMOOTHINGS);
            restrict_from(&grids[k]);
        }
        smooth(&grids[WORK_GRIDS - 1], 4 * WORK_SMOOTHINGS);
        for (int k = WORK_GRIDS - 2; k >= 0; k--) {
            CM_set_vp_set(grids[k].set);
            CM_get_1L(grids[k].other, grids[k].coarser, grids[k + 1].u, WORD);
            CM_f_add_2_1L(grids[k].u, grids[k].other, S, E);
            smooth(&grids[k], WORK_SMOOTHINGS);
        }
    }
    CM_u_move_1L(p->f[0], grids[0].u, WORD);
    return work_paris_weighed(p->f[0], p->odd);
}

/* ---- vectors ---- */

/* Each call of a library of vectors begins so: only so many processors hold numbers. */
static void vector_begin(const struct work_paris *p, int length)
{
    CM_set_context();
    CM_u_lt_constant_1L(p->f[6], (unsigned int)length, WORD);
    CM_logand_context_with_test();
}

/* Where those go that are marked, from `first` on; returns how many there are. */
static uint32_t vector_places(const struct work_paris *p, int length, CM_field_id_t marks,
                              CM_field_id_t places, uint32_t first)
{
    vector_begin(p, length);
    CM_logand_context(marks);
    CM_enumerate_1L(places, 0, WORD, CM_upward, CM_exclusive, CM_none, CM_no_field);
    CM_u_add_constant_2_1L(places, first, WORD);
    return CM_global_count_context();
}

uint32_t work_paris_vectors(const struct work_paris *p, uint32_t turn)
{
    const CM_field_id_t x = p->f[0], y = p->f[1], places = p->f[2], marks = p->bit,
                        others = p->f[3];
    const int length = work_vector_length(p->n);
    uint32_t result = 0;
    vector_begin(p, length);
    CM_u_add_constant_3_1L(x, p->in, turn, WORD);
    for (int round = 0; round < WORK_ROUNDS; round++) {
        const uint32_t pivot = (uint32_t)CM_u_read_from_processor_1L(
            (CM_sendaddr_t)(length / WORK_ROUNDS * round), x, WORD);
        vector_begin(p, length);
        CM_u_lt_constant_1L(x, pivot, WORD);
        CM_store_test(marks);
        vector_begin(p, length);
        CM_lognot_2_1L(others, marks, 1);
        const uint32_t count = vector_places(p, length, marks, places, 0);
        vector_places(p, length, others, places, count);
        vector_begin(p, length);
        CM_send_1L(y, places, x, WORD, CM_no_field);
        vector_begin(p, length);
        CM_u_multiply_constant_3_1L(x, y, 0x9e3779b1u, WORD);
        vector_begin(p, length);
        CM_u_add_constant_2_1L(x, pivot, WORD);
        vector_begin(p, length);
        result = result * 31 + count + CM_global_u_add_1L(x, WORD);
    }
    CM_set_context();
    return result;
}

/* ---- few of many ---- */

uint32_t work_paris_few(const struct work_paris *p, uint32_t turn)
{
    const CM_field_id_t x = p->f[0], y = p->f[1], z = p->f[2];
    uint32_t result = 0;
    vector_begin(p, work_few_length(p->n));
    CM_u_add_constant_3_1L(x, p->in, turn, WORD);
    CM_u_move_1L(y, p->in, WORD);
    for (unsigned int k = 0; k < WORK_LOOKS; k++) {
        for (unsigned int i = 0; i < WORK_CALLS; i++) {
            CM_u_multiply_3_1L(z, x, y, WORD);
            CM_logxor_2_1L(x, z, WORD);
            CM_u_max_3_1L(y, x, z, WORD);
            CM_u_add_constant_2_1L(y, k * WORK_CALLS + i, WORD);
        }
        CM_scan_with_u_add_1L(z, y, 0, WORD, CM_upward, CM_inclusive, CM_none, CM_no_field);
        CM_logxor_2_1L(x, z, WORD);
        result = result * 31 + CM_global_u_add_1L(x, WORD);
    }
    CM_set_context();
    return result;
}
