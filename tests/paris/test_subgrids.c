/* test_subgrids.c - the physical processor of each virtual one: inquiries, send addresses, coordinates, sends, gets and
 * aliases agree on the subgrids, over generated geometries. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <cm/paris.h>

#include "device.h"
#include "sample.h"

enum { PHYSICAL = 16, AXES = 5, MOST = 2048, ROUNDS = 40, ROUNDS_RUN = 12 };

static uint64_t state = 20;

static unsigned int next(unsigned int below)
{
    return (unsigned int)(sample_linear(&state) % below);
}

struct grid {
    CM_geometry_id_t id;
    unsigned int rank, count, ratio, lengths[AXES], weights[AXES], sides[AXES];
    bool binary[AXES]; /* in send order */
};

/* Draws a geometry; lengths are powers of two, and at least one axis is in NEWS order. */
static struct grid grid_make(unsigned int rank)
{
    struct CM_axis_descriptor axes[AXES] = {{0}};
    CM_axis_descriptor_t pointers[AXES];
    struct grid g = {.rank = rank, .count = 1};
    for (unsigned int i = 0; i < rank; i++) {
        unsigned int left = MOST / g.count, log2 = 0;
        while (left >> log2 > 1)
            log2++;
        log2 = log2 > 11 / rank + 1 ? 11 / rank + 1 : log2;
        g.lengths[i] = 1u << next(log2 + 1);
        g.weights[i] = 1 + next(5);
        g.binary[i] = i && next(4) == 0;
        g.count *= g.lengths[i];
        axes[i].length = g.lengths[i];
        axes[i].weight = g.weights[i];
        axes[i].ordering = g.binary[i] ? CM_send_order : CM_news_order;
        pointers[i] = &axes[i];
    }
    g.id = CM_create_detailed_geometry(pointers, rank);
    g.ratio = (g.count + PHYSICAL - 1) / PHYSICAL;
    for (unsigned int i = 0; i < rank; i++)
        g.sides[i] = CM_geometry_axis_vp_ratio(g.id, i);
    return g;
}

static void coordinates_of(const struct grid *g, unsigned int index, unsigned int *c)
{
    for (unsigned int i = g->rank; i-- > 0; index /= g->lengths[i])
        c[i] = index % g->lengths[i];
}

/* The send address by the documented rule: the block and the place in it, on each axis. */
static unsigned int address_of(const struct grid *g, unsigned int index)
{
    unsigned int c[AXES], processor = 0, vp = 0;
    coordinates_of(g, index, c);
    for (unsigned int i = 0; i < g->rank; i++) {
        unsigned int block = c[i] / g->sides[i];
        unsigned int code = g->binary[i] ? block : block ^ block / 2;
        processor += code << CM_geometry_axis_off_chip_pos(g->id, i);
        vp = vp * g->sides[i] + c[i] % g->sides[i];
    }
    return processor * g->ratio + vp;
}

static unsigned int address_by_calls(const struct grid *g, unsigned int index)
{
    unsigned int c[AXES], address = 0;
    coordinates_of(g, index, c);
    for (unsigned int i = 0; i < g->rank; i++)
        address = CM_fe_deposit_news_coordinate(g->id, address, i, c[i]);
    return address;
}

/* The least sum of weight / side among all shapes of a block. */
static double best_shape(const struct grid *g, unsigned int axis, unsigned int left)
{
    double best = 1e9;
    if (axis == g->rank)
        return left == 1 ? 0 : best;
    for (unsigned int side = 1; side <= left && side <= g->lengths[axis]; side *= 2) {
        double sum = g->weights[axis] / (double)side + best_shape(g, axis + 1, left / side);
        best = sum < best ? sum : best;
    }
    return best;
}

static void inquiries_agree(void **unused)
{
    (void)unused;
    for (int round = 0; round < ROUNDS; round++) {
        struct grid g = grid_make(1 + (unsigned int)round % AXES);
        unsigned int sides = 1, bits = 0;
        double shape = 0;
        for (unsigned int i = 0; i < g.rank; i++) {
            unsigned int node = CM_geometry_axis_off_chip_bits(g.id, i);
            sides *= g.sides[i];
            shape += g.weights[i] / (double)g.sides[i];
            assert_int_equal(g.sides[i] << node, g.lengths[i]);
            assert_int_equal(CM_geometry_axis_on_chip_bits(g.id, i), 0);
            bits += node;
        }
        assert_int_equal(sides, g.ratio);
        assert_int_equal(CM_geometry_total_vp_ratio(g.id), g.ratio);
        assert_true(shape <= best_shape(&g, 0, g.ratio) + 1e-9);
        assert_int_equal(g.count >= PHYSICAL ? PHYSICAL : g.count, 1u << bits);
        CM_deallocate_geometry(g.id);
    }
}

static void addresses_tell_of_subgrids(void **unused)
{
    (void)unused;
    for (int round = 0; round < ROUNDS; round++) {
        struct grid g = grid_make(1 + (unsigned int)round % AXES);
        bool seen[MOST] = {false};
        for (unsigned int n = 0; n < g.count; n++) {
            unsigned int a = address_by_calls(&g, n), c[AXES];
            assert_int_equal(a, address_of(&g, n));
            assert_true(a < g.count && !seen[a]);
            seen[a] = true;
            coordinates_of(&g, n, c);
            for (unsigned int i = 0; i < g.rank; i++) {
                assert_int_equal(CM_fe_extract_news_coordinate(g.id, i, a), c[i]);
                unsigned int up =
                    CM_fe_deposit_news_coordinate(g.id, a, i, (c[i] + 1) % g.lengths[i]);
                unsigned int wires = a / g.ratio ^ up / g.ratio;
                /* a neighbour is on the same processor, or on one that a wire of the cube connects */
                assert_true(g.binary[i] || (wires & (wires - 1)) == 0);
            }
        }
        CM_deallocate_geometry(g.id);
    }
}

static void read_all(CM_field_id_t field, int bits, uint32_t *out)
{
    assert_int_equal(machine_field_download(paris_machine(), field, MACHINE_UINT(bits), out),
                     MACHINE_OK);
}

/* Sends to and gets from the mirror image on the last axis; addresses come from coordinates. */
static void send_and_get(const struct grid *g, CM_field_id_t address, unsigned int bits)
{
    uint32_t got[MOST], last = g->lengths[g->rank - 1];
    CM_field_id_t here = CM_allocate_stack_field(32), mirror = CM_allocate_stack_field(32),
                  dest = CM_allocate_stack_field(32), sum = CM_allocate_stack_field(32);
    CM_my_news_coordinate_1L(here, g->rank - 1, 32);
    CM_u_move_constant_1L(mirror, last - 1, 32);
    CM_u_subtract_2_1L(mirror, here, 32);
    CM_deposit_news_coordinate_1L(g->id, address, g->rank - 1, mirror, 32);
    CM_my_send_address(here);
    CM_send_1L(dest, address, here, bits, CM_no_field);
    read_all(dest, 32, got);
    for (unsigned int n = 0; n < g->count; n++)
        assert_int_equal(got[n], address_of(g, n - n % last + (last - 1 - n % last)));
    CM_get_1L(dest, address, here, bits);
    read_all(dest, 32, got);
    for (unsigned int n = 0; n < g->count; n++)
        assert_int_equal(got[n], address_of(g, n - n % last + (last - 1 - n % last)));
    CM_u_move_constant_1L(sum, 0, 32);
    CM_send_with_u_add_1L(sum, address, here, 32, CM_no_field);
    read_all(sum, 32, got);
    for (unsigned int n = 0; n < g->count; n++)
        assert_int_equal(got[n], address_of(g, n - n % last + (last - 1 - n % last)));
    CM_extract_news_coordinate_1L(g->id, mirror, g->rank - 1, address, 32);
    read_all(mirror, 32, got);
    for (unsigned int n = 0; n < g->count; n++)
        assert_int_equal(got[n], last - 1 - n % last);
    CM_deallocate_stack_through(here);
}

/* Reads each processor's memory through a set of ratio 1. */
static void seen_from_below(const struct grid *g, CM_field_id_t field)
{
    struct CM_axis_descriptor axis = {
        .length = PHYSICAL, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    CM_vp_set_id_t above = CM_current_vp_set,
                   below = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 1));
    uint32_t got[PHYSICAL];
    CM_set_vp_set(below);
    CM_field_id_t alias = CM_make_field_alias(field);
    for (unsigned int r = 0; r < g->ratio; r++) {
        read_all(alias + r * 32, 32, got);
        for (unsigned int p = 0; p < PHYSICAL; p++)
            assert_int_equal(got[p], p * g->ratio + r);
    }
    for (unsigned int r = 0; r < g->ratio; r++)
        CM_u_add_constant_2_1L(alias + r * 32, 1000, 32);
    CM_set_vp_set(above);
    uint32_t all[MOST];
    read_all(field, 32, all);
    for (unsigned int n = 0; n < g->count; n++)
        assert_int_equal(all[n], address_of(g, n) + 1000);
    CM_set_vp_set(below);
    CM_remove_field_alias(alias);
    CM_set_vp_set(above);
    CM_deallocate_vp_set(below);
}

static void the_machine_agrees(void **unused)
{
    (void)unused;
    CM_vp_set_id_t before = CM_current_vp_set;
    for (int round = 0; round < ROUNDS_RUN; round++) {
        struct grid g = grid_make(1 + (unsigned int)round % AXES);
        uint32_t got[MOST];
        CM_vp_set_id_t set = CM_allocate_vp_set(g.id);
        CM_set_vp_set(set);
        unsigned int bits = CM_geometry_send_address_length(g.id);
        CM_field_id_t mine = CM_allocate_stack_field(32), made = CM_allocate_stack_field(32),
                      coordinate = CM_allocate_stack_field(32);
        CM_my_send_address(mine);
        read_all(mine, 32, got);
        for (unsigned int n = 0; n < g.count; n++)
            assert_int_equal(got[n], address_of(&g, n));
        for (unsigned int i = 0; i < g.rank; i++) {
            CM_my_news_coordinate_1L(coordinate, i, 32);
            if (i)
                CM_deposit_news_coordinate_1L(g.id, made, i, coordinate, 32);
            else
                CM_make_news_coordinate_1L(g.id, made, i, coordinate, 32);
        }
        read_all(made, 32, got);
        for (unsigned int n = 0; n < g.count; n++)
            assert_int_equal(got[n], address_of(&g, n));
        send_and_get(&g, made, bits);
        if (g.count >= PHYSICAL)
            seen_from_below(&g, mine);
        CM_deallocate_stack_through(mine);
        CM_set_vp_set(before);
        CM_deallocate_vp_set(set);
        CM_deallocate_geometry(g.id);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inquiries_agree),
        cmocka_unit_test(addresses_tell_of_subgrids),
        cmocka_unit_test(the_machine_agrees),
    };
    return cmocka_run_group_tests(tests, device_setup, NULL);
}
