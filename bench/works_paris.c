/* works_paris.c - programs of works.h in C/Paris. */
#include "works.h"

#include <stdlib.h>

#include "harness.h"
#include "of_machine.h"
#include "paris_internal.h"
#include "works_paris.h"
#include <cm/paris.h>

/* ---- making ---- */

static bool upload(const struct work_paris *p, CM_field_id_t to, uint32_t first)
{
    for (int i = 0; i < p->n; i++)
        p->words[i] = work_word(first + (uint32_t)i);
    return bench_machine_said(
        machine_field_upload(paris_machine(), to, MACHINE_UINT(WORD), p->words));
}

/* dest = 2 index + 1 */
static void odd_make(CM_geometry_id_t g, CM_field_id_t dest, CM_field_id_t spare)
{
    int rank = CM_geometry_rank(g);
    CM_u_move_zero_1L(dest, WORD);
    for (int axis = 0; axis < rank; axis++) {
        unsigned int length = CM_geometry_axis_length(g, (unsigned int)axis);
        CM_my_news_coordinate_1L(spare, (unsigned int)axis, WORD);
        CM_u_multiply_constant_2_1L(dest, length, WORD);
        CM_u_add_2_1L(dest, spare, WORD);
    }
    CM_u_multiply_constant_2_1L(dest, 2, WORD);
    CM_u_add_constant_2_1L(dest, 1, WORD);
}

static CM_geometry_id_t line_make(unsigned int n)
{
    struct CM_axis_descriptor axis = {.length = n, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    return CM_create_detailed_geometry(axes, 1);
}

static void transposed_addresses(const struct work_paris *p)
{
    CM_my_news_coordinate_1L(p->f[1], 1, WORD);
    CM_u_from_gray_code_1_1L(p->f[1], WORD);
    CM_make_news_coordinate_1L(p->geometry, p->f[0], 0, p->f[1], WORD);
    CM_my_news_coordinate_1L(p->f[1], 0, WORD);
    CM_u_to_gray_code_1_1L(p->f[1], WORD);
    CM_deposit_news_coordinate_1L(p->geometry, p->f[0], 1, p->f[1], WORD);
}

static bool list_make(const struct work_paris *p)
{
    work_list(p->words, p->n);
    return bench_machine_said(
        machine_field_upload(paris_machine(), p->in, MACHINE_UINT(WORD), p->words));
}

static void elimination_prepare(const struct work_paris *p)
{
    CM_f_u_float_2_2L(p->f[0], p->in, 12, LONG_S, LONG_E);
    CM_f_multiply_constant_2_1L(p->f[0], 1.0 / 4096, LONG_S, LONG_E);
    CM_my_news_coordinate_1L(p->f[5], 0, WORD);
    CM_my_news_coordinate_1L(p->f[6], 1, WORD);
    CM_u_eq_1L(p->f[5], p->f[6], WORD);
    CM_logand_context_with_test();
    CM_f_add_constant_2_1L(p->f[0], p->side, LONG_S, LONG_E);
    CM_set_context();
}

/* array: a bit where a processor is no wall and red, one where it is black. */
static void red_black_prepare(struct work_paris *p, const int sides[3])
{
    p->array = CM_allocate_heap_field(2);
    work_part_make(p, p->f[0], 0);
    work_part_make(p, p->f[1], 12);
    CM_u_move_zero_1L(p->f[6], WORD);
    CM_set_bit(p->array);
    for (unsigned int a = 0; a < 3; a++) {
        CM_my_news_coordinate_1L(p->f[5], a, WORD);
        CM_u_add_2_1L(p->f[6], p->f[5], WORD);
        CM_u_eq_constant_1L(p->f[5], 0, WORD);
        CM_logand_context_with_test();
        CM_clear_bit(p->array);
        CM_set_context();
        CM_u_eq_constant_1L(p->f[5], (unsigned int)sides[a] - 1, WORD);
        CM_logand_context_with_test();
        CM_clear_bit(p->array);
        CM_set_context();
    }
    CM_lognot_2_1L(p->array + 1, p->f[6], 1);
    CM_logand_2_1L(p->array + 1, p->array, 1);
    CM_logand_2_1L(p->array, p->f[6], 1);
}

static bool work_prepare(struct work_paris *p)
{
    int sides[3];
    bool good = upload(p, p->in, 0);
    switch (p->work) {
    case WORK_HISTOGRAM:
        p->bins_geometry = line_make(WORK_BINS);
        p->bins_set = CM_allocate_vp_set(p->bins_geometry);
        CM_set_vp_set(p->bins_set);
        p->bins = CM_allocate_heap_field(WORD);
        p->bins_odd = CM_allocate_heap_field(WORD);
        odd_make(p->bins_geometry, p->bins_odd, p->bins);
        CM_set_vp_set(p->set);
        CM_u_move_constant_1L(p->f[1], 1, WORD);
        break;
    case WORK_TRANSPOSITION:
        transposed_addresses(p);
        break;
    case WORK_RANKING:
        return good && list_make(p);
    case WORK_SCANS:
        CM_u_mod_constant_3_1L(p->f[0], p->in, WORK_SEGMENT, WORD);
        CM_u_eq_constant_1L(p->f[0], 0, WORD);
        CM_store_test(p->bit);
        break;
    case WORK_WIDE:
        p->array = CM_allocate_heap_field(2 * WORK_LIMBS * WORD);
        CM_u_subtract_constant_3_1L(p->f[0], p->odd, 1, WORD);
        CM_u_shift_constant_2_1L(p->f[0], -1, WORD);
        for (unsigned int k = 0; k < 2 * WORK_LIMBS; k++)
            CM_u_multiply_constant_3_1L(p->array + k * WORD, p->f[0], 0x9e3779b1u + 2 * k,
                                        WORD);
        break;
    case WORK_CODE:
        p->array = CM_allocate_heap_field(3 * WORK_CELLS * WORD);
        for (unsigned int k = 0; good && k < 2 * WORK_CELLS; k++)
            good = upload(p, p->array + (WORK_CELLS + k) * WORD, k * (uint32_t)p->n);
        break;
    case WORK_PRODUCT:
        work_part_make(p, p->f[0], 0);
        work_part_make(p, p->f[1], 12);
        break;
    case WORK_ELIMINATION:
        elimination_prepare(p);
        break;
    case WORK_RED_BLACK:
        work_box(p->n, sides);
        red_black_prepare(p, sides);
        break;
    case WORK_FOURIER:
        return good && work_fourier_prepare(p);
    case WORK_MULTIGRID:
        work_multigrid_prepare(p);
        break;
    case WORK_VECTORS:
    case WORK_FEW:
        CM_my_news_coordinate_1L(p->f[6], 0, WORD);
        break;
    case WORK_SORT:
    case WORKS_COUNT:
        break;
    }
    return good;
}

static CM_geometry_id_t geometry_make(const struct work_paris *p)
{
    int lengths[3] = {p->side, p->side, 0};
    unsigned int rank = 2;
    switch (p->work) {
    case WORK_SCANS:
        lengths[0] = p->n / WORK_ROW;
        lengths[1] = WORK_ROW;
        break;
    case WORK_RED_BLACK:
        work_box(p->n, lengths);
        rank = 3;
        break;
    case WORK_TRANSPOSITION:
    case WORK_PRODUCT:
    case WORK_ELIMINATION:
    case WORK_FOURIER:
    case WORK_MULTIGRID:
        break;
    case WORK_VECTORS:
    case WORK_FEW:
    case WORK_HISTOGRAM:
    case WORK_SORT:
    case WORK_RANKING:
    case WORK_WIDE:
    case WORK_CODE:
    case WORKS_COUNT:
        return line_make((unsigned int)p->n);
    }
    return CM_create_geometry((CM_vector_t){.ints = lengths}, rank);
}

struct work_paris *work_paris_create(enum work w, int n)
{
    struct work_paris *p = calloc(1, sizeof *p);
    if (!p) {
        bench_fail("no memory for a work");
        return NULL;
    }
    *p = (struct work_paris){.work = w, .n = n};
    while (p->side * p->side < n)
        p->side++;
    p->words = malloc((size_t)n * sizeof *p->words);
    p->moved = malloc((size_t)n * sizeof *p->moved);
    p->geometry = geometry_make(p);
    p->set = CM_allocate_vp_set(p->geometry);
    CM_set_vp_set(p->set);
    CM_set_context();
    p->in = CM_allocate_heap_field(WORD);
    p->odd = CM_allocate_heap_field(WORD);
    p->bit = CM_allocate_heap_field(1);
    for (int i = 0; i < FIELDS; i++)
        p->f[i] = CM_allocate_heap_field(LONG);
    odd_make(p->geometry, p->odd, p->f[0]);
    const bool has_memory = p->words && p->moved;
    if (has_memory && work_prepare(p))
        return p;
    if (!has_memory)
        bench_fail("no memory for %d words", n);
    work_paris_destroy(p);
    return NULL;
}

void work_paris_destroy(struct work_paris *p)
{
    if (!p)
        return;
    CM_deallocate_vp_set(p->set);
    CM_deallocate_geometry(p->geometry);
    if (p->bins_set) {
        CM_deallocate_vp_set(p->bins_set);
        CM_deallocate_geometry(p->bins_geometry);
    }
    for (int k = 1; k < WORK_GRIDS && p->grids[k].set; k++) {
        CM_deallocate_vp_set(p->grids[k].set);
        CM_deallocate_geometry(p->grids[k].geometry);
    }
    free(p->words);
    free(p->moved);
    free(p);
}

/* ---- running ---- */

static uint32_t histogram(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t x = p->f[0], one = p->f[1], address = p->f[2];
    uint32_t result = 0;
    CM_u_add_constant_3_1L(x, p->in, turn, WORD);
    for (int k = 0; k < WORK_HISTOGRAMS; k++) {
        CM_set_vp_set(p->bins_set);
        CM_u_move_zero_1L(p->bins, WORD);
        CM_set_vp_set(p->set);
        CM_u_shift_constant_3_1L(address, x, -3 * k, WORD);
        CM_logand_constant_2_1L(address, WORK_BINS - 1, WORD);
        CM_send_with_u_add_1L(p->bins, address, one, WORD, CM_no_field);
        CM_set_vp_set(p->bins_set);
        result = result * 31 + work_paris_weighed(p->bins, p->bins_odd);
        CM_set_vp_set(p->set);
    }
    return result;
}

static uint32_t transposition(const struct work_paris *p, uint32_t turn)
{
    int start[2] = {0, 0}, end[2] = {p->side, p->side}, axes[2] = {0, 1};
    CM_vector_t from = {.ints = start}, to = {.ints = end}, axis = {.ints = axes};
    CM_field_id_t x = p->f[1], y = p->f[2];
    CM_u_write_to_news_array_1L(p->words, from, from, to, axis, x, WORD, 2, to, CM_32_bit);
    CM_u_add_constant_2_1L(x, turn, WORD);
    CM_send_1L(y, p->f[0], x, WORD, CM_no_field);
    CM_u_read_from_news_array_1L(p->moved, from, from, to, axis, y, WORD, 2, to, CM_32_bit);
    return work_weighed(p->moved, p->n, 1);
}

static uint32_t sort(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t x = p->f[0], other = p->f[1], me = p->f[2], address = p->f[3], kept = p->f[4];
    unsigned int bits = 0;
    while (1 << bits < p->n)
        bits++;
    CM_u_add_constant_3_1L(x, p->in, turn, WORD);
    CM_my_news_coordinate_1L(me, 0, WORD);
    for (unsigned int k = 1; k <= bits; k++)
        for (unsigned int j = k; j-- > 0;) {
            CM_logxor_constant_3_1L(address, me, 1ul << j, WORD);
            CM_get_1L(other, address, x, WORD);
            CM_u_min_3_1L(kept, x, other, WORD);
            CM_logxor_3_1L(p->bit, me + k, me + j, 1);
            CM_load_context(p->bit);
            CM_u_max_3_1L(kept, x, other, WORD);
            CM_set_context();
            CM_u_move_1L(x, kept, WORD);
        }
    return work_paris_weighed(x, p->odd);
}

static uint32_t ranking(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t left = p->f[0], next = p->f[1], got = p->f[2], me = p->f[3];
    CM_u_move_1L(next, p->in, WORD);
    CM_my_news_coordinate_1L(me, 0, WORD);
    CM_logand_constant_3_1L(left, me, 15, WORD);
    CM_u_add_constant_2_1L(left, turn, WORD);
    CM_u_eq_1L(me, next, WORD);
    CM_logand_context_with_test();
    CM_u_move_zero_1L(left, WORD);
    CM_set_context();
    for (int reach = 1; reach < p->n; reach *= 2) {
        CM_get_1L(got, next, left, WORD);
        CM_u_add_2_1L(left, got, WORD);
        CM_get_1L(got, next, next, WORD);
        CM_u_move_1L(next, got, WORD);
    }
    return work_paris_weighed(left, p->odd);
}

static uint32_t scans(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t x = p->f[0], sum = p->f[1], all = p->f[2];
    CM_u_move_zero_1L(all, WORD);
    for (unsigned int k = 0; k < WORK_SCANS_COUNT; k++) {
        CM_u_add_constant_3_1L(x, p->in, turn + k, WORD);
        if (k % 3 == 2)
            CM_scan_with_u_max_1L(sum, x, 1, WORD, CM_upward, CM_inclusive, CM_segment_bit,
                                  p->bit);
        else
            CM_scan_with_u_add_1L(sum, x, 1, WORD, CM_upward, CM_inclusive, CM_segment_bit,
                                  p->bit);
        CM_logxor_2_1L(all, sum, WORD);
    }
    return work_paris_weighed(all, p->odd);
}

static uint32_t wide(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t carry = p->f[0], product = p->f[1], factor = p->f[2], mixed = p->f[3],
                  more = p->f[4], limb = p->f[5];
    CM_u_move_constant_1L(carry, turn, LONG);
    CM_u_move_zero_1L(product, LONG);
    CM_u_move_zero_1L(mixed, WORD);
    for (unsigned int k = 0; k < WORK_LIMBS; k++) {
        CM_u_move_2L(more, p->array + k * WORD, LONG, WORD);
        CM_u_add_2_1L(carry, more, LONG);
        CM_u_move_2L(more, p->array + (WORK_LIMBS + k) * WORD, LONG, WORD);
        CM_u_add_2_1L(carry, more, LONG);
        CM_u_move_1L(limb, carry, WORD);
        CM_u_shift_constant_2_1L(carry, -WORD, LONG);
        if (k == 0)
            CM_u_move_1L(factor, limb, WORD);
        CM_u_multiply_3_3L(more, limb, factor, LONG, WORD, WORD);
        CM_u_add_2_1L(product, more, LONG);
        CM_u_add_constant_3_1L(more, product, k, WORD);
        CM_logxor_2_1L(mixed, more, WORD);
        CM_u_shift_constant_2_1L(product, -WORD, LONG);
    }
    return work_paris_weighed(mixed, p->odd);
}

static void code_step(const struct work_paris *p, CM_field_id_t at, CM_field_id_t sum)
{
    CM_field_id_t cell = p->f[2], op = p->f[3], x = p->f[4], program;
    program = p->array + 2 * WORK_CELLS * WORD;
    CM_aref_2L(op, program, at, WORD, WORD, WORK_CELLS, WORD);
    CM_logand_constant_3_1L(cell, op, WORK_CELLS - 1, WORD);
    CM_u_shift_constant_2_1L(op, -4, WORD);
    CM_logand_constant_2_1L(op, 7, WORD);
    CM_aref_2L(x, p->array, cell, WORD, WORD, WORK_CELLS, WORD);
    CM_u_ge_constant_1L(op, 6, WORD);
    CM_logand_context_with_test();
    CM_logand_constant_3_1L(p->f[5], sum, 3, WORD);
    CM_u_add_2_1L(at, p->f[5], WORD);
    CM_set_context();
    CM_u_ge_constant_1L(op, 3, WORD);
    CM_logand_context_with_test();
    CM_u_le_constant_1L(op, 4, WORD);
    CM_logand_context_with_test();
    CM_aset_2L(sum, p->array, cell, WORD, WORD, WORK_CELLS, WORD);
    CM_set_context();
    CM_u_eq_constant_1L(op, 5, WORD);
    CM_logand_context_with_test();
    CM_u_multiply_2_1L(sum, x, WORD);
    CM_set_context();
    CM_u_eq_constant_1L(op, 2, WORD);
    CM_logand_context_with_test();
    CM_logxor_2_1L(sum, x, WORD);
    CM_set_context();
    CM_u_lt_constant_1L(op, 2, WORD);
    CM_logand_context_with_test();
    CM_u_add_2_1L(sum, x, WORD);
    CM_set_context();
    CM_u_add_constant_2_1L(at, 1, WORD);
    CM_logand_constant_2_1L(at, WORK_CELLS - 1, WORD);
}

static uint32_t code(const struct work_paris *p, uint32_t turn)
{
    for (unsigned int k = 0; k < WORK_CELLS; k++)
        CM_u_move_1L(p->array + k * WORD, p->array + (WORK_CELLS + k) * WORD, WORD);
    CM_u_move_zero_1L(p->f[0], WORD);
    CM_u_move_constant_1L(p->f[1], turn, WORD);
    for (int step = 0; step < WORK_STEPS; step++)
        code_step(p, p->f[0], p->f[1]);
    return work_paris_weighed(p->f[1], p->odd);
}

static uint32_t product(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t sum = p->f[2], column = p->f[3], row = p->f[4];
    CM_f_move_constant_1L(sum, turn, S, E);
    for (unsigned int k = 0; k < (unsigned int)p->side; k++) {
        CM_spread_with_copy_1L(column, p->f[0], 1, WORD, k);
        CM_spread_with_copy_1L(row, p->f[1], 0, WORD, k);
        CM_f_multiply_2_1L(column, row, S, E);
        CM_f_add_2_1L(sum, column, S, E);
    }
    return work_paris_weighed(sum, p->odd);
}

static uint32_t elimination(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t a = p->f[1], row = p->f[2], column = p->f[3], pivot = p->f[4];
    CM_f_add_constant_3_1L(a, p->f[0], turn, LONG_S, LONG_E);
    for (unsigned int k = 0; k + 1 < (unsigned int)p->side; k++) {
        CM_spread_with_copy_1L(row, a, 0, LONG, k);
        CM_spread_with_copy_1L(pivot, row, 1, LONG, k);
        CM_u_gt_constant_1L(p->f[5], k, WORD);
        CM_logand_context_with_test();
        CM_u_eq_constant_1L(p->f[6], k, WORD);
        CM_logand_context_with_test();
        CM_f_divide_2_1L(a, pivot, LONG_S, LONG_E);
        CM_set_context();
        CM_spread_with_copy_1L(column, a, 1, LONG, k);
        CM_u_gt_constant_1L(p->f[5], k, WORD);
        CM_logand_context_with_test();
        CM_u_gt_constant_1L(p->f[6], k, WORD);
        CM_logand_context_with_test();
        CM_f_multiply_2_1L(column, row, LONG_S, LONG_E);
        CM_f_subtract_2_1L(a, column, LONG_S, LONG_E);
        CM_set_context();
    }
    return work_paris_weighed(a, p->odd) + work_paris_weighed(a + WORD, p->odd);
}

static uint32_t red_black(const struct work_paris *p, uint32_t turn)
{
    CM_field_id_t u = p->f[2], sum = p->f[3], other = p->f[4];
    CM_f_add_constant_3_1L(u, p->f[0], turn, S, E);
    for (int s = 0; s < 2 * WORK_SWEEPS; s++) {
        CM_load_context(p->array + (unsigned int)s % 2);
        CM_f_move_1L(sum, p->f[1], S, E);
        for (unsigned int a = 0; a < 3; a++) {
            CM_get_from_news_1L(other, u, a, CM_upward, WORD);
            CM_f_add_2_1L(sum, other, S, E);
            CM_get_from_news_1L(other, u, a, CM_downward, WORD);
            CM_f_add_2_1L(sum, other, S, E);
        }
        CM_f_multiply_constant_3_1L(u, sum, 1.0 / 6, S, E);
        CM_set_context();
    }
    return work_paris_weighed(u, p->odd);
}

uint32_t work_paris_run(struct work_paris *p, uint32_t turn)
{
    uint32_t (*const runs[WORKS_COUNT])(const struct work_paris *,
                                        uint32_t) = {histogram,
                                                     transposition,
                                                     sort,
                                                     ranking,
                                                     scans,
                                                     wide,
                                                     code,
                                                     product,
                                                     elimination,
                                                     red_black,
                                                     work_paris_fourier,
                                                     work_paris_multigrid,
                                                     work_paris_vectors,
                                                     work_paris_few};
    CM_set_vp_set(p->set);
    return runs[p->work](p, turn);
}
