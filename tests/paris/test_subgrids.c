/* test_subgrids.c - the physical processor of each virtual one, and its place there, by a model
 * that follows the documented rules one processor after the other. All inquiries, send
 * addresses, coordinates on both sides, sends, gets and aliases agree with it, over generated
 * geometries of every kind and machines of several sizes. */
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

enum {
    AXES = 5,
    MOST = 2048,
    ROUNDS = 40,
    ROUNDS_RUN = 20,
    ROUNDS_COMPILED = 8,
    PHYSICAL_MOST = 512
};

static unsigned int physical; /* processors of the machine */
static bool compiled;         /* by kernels, on one size of machine */

/* Subgrids of NEWS order; rows of send order; dealt out, where a length is no power of two. */
enum kind { SUBGRIDS, IN_ROWS, IN_ROWS_OF_ANY, DEALT, KINDS };

static uint64_t state = 20;

static unsigned int next(unsigned int below)
{
    return (unsigned int)(sample_linear(&state) % below);
}

struct grid {
    CM_geometry_id_t id;
    enum kind kind;
    unsigned int rank, count, ratio, lengths[AXES], weights[AXES], sides[AXES];
    unsigned int bits[AXES], at[AXES]; /* of the block's number in the processor's */
    bool binary[AXES];                 /* in send order */
};

static unsigned int log2_of(unsigned int x)
{
    return 31 - (unsigned int)__builtin_clz(x);
}

/* What is known of the sides: in rows the last axes are whole, as far as a processor's virtual
 * ones suffice. Of subgrids the shape is asked for, and must be as good as any:
 * inquiries_agree(). */
static void sides_find(struct grid *g)
{
    unsigned int left = g->ratio, at = 0;
    for (unsigned int i = g->rank; i-- > 0;) {
        g->sides[i] = g->kind == SUBGRIDS    ? CM_geometry_axis_vp_ratio(g->id, i)
                      : left < g->lengths[i] ? left
                                             : g->lengths[i];
        left = g->kind == IN_ROWS ? left / g->sides[i] : 1;
        g->bits[i] = g->kind <= IN_ROWS ? log2_of(g->lengths[i] / g->sides[i]) : 0;
        g->at[i] = at;
        at += g->bits[i];
    }
}

/* Draws a geometry of that kind. With subgrids at least one axis is in NEWS order. */
static struct grid grid_make(enum kind kind, unsigned int rank)
{
    const bool any = kind == DEALT || kind == IN_ROWS_OF_ANY;
    struct CM_axis_descriptor axes[AXES] = {{0}};
    CM_axis_descriptor_t pointers[AXES];
    struct grid g = {.kind = kind, .rank = rank, .count = 1};
    for (unsigned int i = 0; i < rank; i++) {
        unsigned int left = MOST / g.count, log2 = 0;
        while (left >> log2 > 1)
            log2++;
        log2 = log2 > 11 / rank + 1 ? 11 / rank + 1 : log2;
        g.lengths[i] = any ? 1 + next((1u << log2)) : 1u << next(log2 + 1);
        if (any && i == 0)
            g.lengths[i] = 3 + 2 * next(log2 > 2 ? 1u << (log2 - 2) : 1);
        g.weights[i] = 1 + next(5);
        g.binary[i] = kind == IN_ROWS || kind == IN_ROWS_OF_ANY || (i && next(4) == 0);
        g.count *= g.lengths[i];
        axes[i].length = g.lengths[i];
        axes[i].weight = g.weights[i];
        axes[i].ordering = g.binary[i] ? CM_send_order : CM_news_order;
        pointers[i] = &axes[i];
    }
    g.id = CM_create_detailed_geometry(pointers, rank);
    g.ratio = (g.count + physical - 1) / physical;
    sides_find(&g);
    return g;
}

static void coordinates_of(const struct grid *g, unsigned int index, unsigned int *c)
{
    for (unsigned int i = g->rank; i-- > 0; index /= g->lengths[i])
        c[i] = index % g->lengths[i];
}

/* The send address by the documented rules: of subgrids the block and the place in it, on each
 * axis. */
static unsigned int address_of(const struct grid *g, unsigned int index)
{
    unsigned int c[AXES], processor = 0, vp = 0;
    if (g->kind == IN_ROWS || g->kind == IN_ROWS_OF_ANY)
        return index;
    if (g->kind == DEALT)
        return index % physical * g->ratio + index / physical;
    coordinates_of(g, index, c);
    for (unsigned int i = 0; i < g->rank; i++) {
        unsigned int block = c[i] / g->sides[i];
        unsigned int code = g->binary[i] ? block : block ^ block / 2;
        processor += code << g->at[i];
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

static struct grid grid_of_round(int round)
{
    return grid_make((enum kind)(round % KINDS), 1 + (unsigned int)round / KINDS * 2 % AXES);
}

static unsigned int bits_for(unsigned int count)
{
    unsigned int bits = 1;
    while (1u << bits < count)
        bits++;
    return bits;
}

static void subgrids_are_good(const struct grid *g)
{
    double shape = 0;
    unsigned int sides = 1, bits = 0;
    for (unsigned int i = 0; i < g->rank; i++) {
        sides *= g->sides[i];
        bits += g->bits[i];
        shape += g->weights[i] / (double)g->sides[i];
        assert_int_equal(g->sides[i] << g->bits[i], g->lengths[i]);
    }
    assert_int_equal(sides, g->ratio);
    assert_int_equal(g->count >= physical ? physical : g->count, 1u << bits);
    assert_true(g->kind == IN_ROWS || shape <= best_shape(g, 0, g->ratio) + 1e-9);
}

static void inquiries_agree(void **unused)
{
    (void)unused;
    for (int round = 0; round < ROUNDS; round++) {
        struct grid g = grid_of_round(round);
        unsigned int product = 1;
        for (unsigned int i = 0; i < g.rank; i++) {
            const unsigned int along = CM_geometry_axis_vp_ratio(g.id, i);
            assert_true(g.kind > IN_ROWS || along == g.sides[i]);
            product *= along;
            assert_int_equal(CM_geometry_axis_off_chip_bits(g.id, i), g.bits[i]);
            assert_int_equal(CM_geometry_axis_off_chip_pos(g.id, i), g.at[i]);
            assert_int_equal(CM_geometry_axis_on_chip_bits(g.id, i), 0);
            assert_int_equal(CM_geometry_axis_on_chip_pos(g.id, i), 0);
            assert_int_equal(CM_geometry_axis_length(g.id, i), g.lengths[i]);
            assert_int_equal(CM_geometry_axis_weight(g.id, i), g.weights[i]);
            assert_int_equal(CM_geometry_axis_ordering(g.id, i),
                             g.binary[i] ? CM_send_order : CM_news_order);
            assert_int_equal(CM_geometry_coordinate_length(g.id, i), bits_for(g.lengths[i]));
        }
        assert_int_equal(CM_geometry_rank(g.id), g.rank);
        assert_int_equal(CM_geometry_total_processors(g.id), g.count);
        assert_int_equal(CM_geometry_total_vp_ratio(g.id), g.ratio);
        assert_true(product >= g.ratio);
        assert_int_equal(CM_geometry_send_address_length(g.id), bits_for(physical * g.ratio));
        if (g.kind <= IN_ROWS)
            subgrids_are_good(&g);
        CM_deallocate_geometry(g.id);
    }
}

/* The row-major position on the axes of the mask. */
static unsigned int position(const struct grid *g, const unsigned int *c, unsigned int mask)
{
    unsigned int sum = 0;
    for (unsigned int i = 0; i < g->rank; i++)
        if (mask >> i & 1)
            sum = sum * g->lengths[i] + c[i];
    return sum;
}

/* The index of the processor with that coordinate on the axis and 0 on the others. */
static unsigned int alone(const struct grid *g, unsigned int axis, unsigned int coordinate)
{
    for (unsigned int i = axis + 1; i < g->rank; i++)
        coordinate *= g->lengths[i];
    return coordinate;
}

static void addresses_tell_of_subgrids(void **unused)
{
    (void)unused;
    for (int round = 0; round < ROUNDS; round++) {
        struct grid g = grid_of_round(round);
        static bool seen[MOST + MOST * PHYSICAL_MOST / 2];
        memset(seen, 0, sizeof seen);
        for (unsigned int n = 0; n < g.count; n++) {
            unsigned int a = address_by_calls(&g, n), c[AXES];
            assert_int_equal(a, address_of(&g, n));
            assert_true(a < physical * g.ratio && !seen[a]);
            seen[a] = true;
            coordinates_of(&g, n, c);
            for (unsigned int mask = 0; mask < 1u << g.rank; mask++)
                assert_int_equal(CM_fe_extract_multi_coordinate(g.id, mask, a),
                                 position(&g, c, mask));
            for (unsigned int i = 0; i < g.rank; i++) {
                assert_int_equal(CM_fe_extract_news_coordinate(g.id, i, a), c[i]);
                assert_int_equal(CM_fe_make_news_coordinate(g.id, i, c[i]),
                                 address_of(&g, alone(&g, i, c[i])));
                unsigned int up =
                    CM_fe_deposit_news_coordinate(g.id, a, i, (c[i] + 1) % g.lengths[i]);
                unsigned int wires = a / g.ratio ^ up / g.ratio;
                /* a neighbour is on the same processor, or on one that a wire of the cube
                 * connects */
                assert_true(g.kind != SUBGRIDS || g.binary[i] || (wires & (wires - 1)) == 0);
                /* the block's number on the axis is these bits of the processor's */
                const unsigned int code = a / g.ratio >> g.at[i] & ((1u << g.bits[i]) - 1);
                if (g.kind <= IN_ROWS)
                    assert_int_equal(g.binary[i] ? code : CM_fe_from_gray_code(code),
                                     c[i] / g.sides[i]);
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
        .length = physical, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    CM_vp_set_id_t above = CM_current_vp_set,
                   below = CM_allocate_vp_set(CM_create_detailed_geometry(axes, 1));
    uint32_t got[PHYSICAL_MOST];
    CM_set_vp_set(below);
    CM_field_id_t alias = CM_make_field_alias(field);
    for (unsigned int r = 0; r < g->ratio; r++) {
        read_all(alias + r * 32, 32, got);
        for (unsigned int n = 0; n < g->count; n++) /* others' memory is nobody's */
            if (address_of(g, n) % g->ratio == r)
                assert_int_equal(got[address_of(g, n) / g->ratio], address_of(g, n));
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
    const int rounds = compiled ? ROUNDS_COMPILED : ROUNDS_RUN;
    for (int round = 0; round < rounds; round++) {
        struct grid g = grid_of_round(round);
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
        const unsigned int mask = next(1u << g.rank);
        CM_extract_multi_coordinate_1L(g.id, coordinate, mask, mine, 32);
        read_all(coordinate, 32, got);
        for (unsigned int n = 0; n < g.count; n++) {
            unsigned int c[AXES];
            coordinates_of(&g, n, c);
            assert_int_equal(got[n], position(&g, c, mask));
        }
        read_all(made, 32, got);
        for (unsigned int n = 0; n < g.count; n++)
            assert_int_equal(got[n], address_of(&g, n));
        send_and_get(&g, made, bits);
        if (g.count >= physical)
            seen_from_below(&g, mine);
        CM_deallocate_stack_through(mine);
        CM_set_vp_set(before);
        CM_deallocate_vp_set(set);
        CM_deallocate_geometry(g.id);
    }
}

static int machine_of(void **size)
{
    struct machine_config config = machine_config_default();
    physical = (unsigned int)(uintptr_t)*size;
    config.processors_count = (int)physical;
    compiled = physical == 16;
    setenv("LUTETIA_INTERPRET", compiled ? "0" : "1", 1);
    if (!paris_reset(&config)) {
        fprintf(stderr, "skipped: %s\n", paris_error());
        exit(77);
    }
    return 0;
}

#define ON(physical)                                                                           \
    cmocka_unit_test_prestate_setup_teardown(inquiries_agree, machine_of, NULL,                \
                                             (void *)(uintptr_t)(physical)),                   \
        cmocka_unit_test_prestate_setup_teardown(addresses_tell_of_subgrids, machine_of, NULL, \
                                                 (void *)(uintptr_t)(physical)),               \
        cmocka_unit_test_prestate_setup_teardown(the_machine_agrees, machine_of, NULL,         \
                                                 (void *)(uintptr_t)(physical))

int main(void)
{
    const struct CMUnitTest tests[] = {ON(16), ON(1), ON(2), ON(64), ON(PHYSICAL_MOST)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
