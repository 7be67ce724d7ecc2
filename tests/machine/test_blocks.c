/* test_blocks.c - large VP sets in blocks (LUTETIA_BLOCKS): the same bits as in one piece, and
 * really in blocks. */
#include "device/device.h"
#include "machine_explained.h"
#include "machine_inside.h"
#include "support.h"

enum { TURNS = 24, SETS = 5 };

/* Sheets, lines and spaces; blocks higher and lower than their ghosts, and of unequal
 * height. */
static const struct form {
    int rank, lengths[3];
    const char *ghosts;
} forms[SETS] = {
    {2, {56, 40}, "16"},   {2, {101, 67}, "3"}, {1, {30011}, "16"},
    {3, {21, 6, 19}, "2"}, {2, {5, 300}, "8"},
};

struct found {
    uint64_t count;
    float *water;
    uint32_t *life;
    struct machine_scalar sum, largest, bits;
    struct machine_blocks blocks;
};

static struct machine *machine_of(const char *blocks, const struct form *s)
{
    setenv("LUTETIA_BLOCKS", blocks, 1);
    setenv("LUTETIA_BLOCKS_FROM", "2", 1);
    setenv("LUTETIA_GHOSTS", s->ghosts, 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_BLOCKS");
    unsetenv("LUTETIA_BLOCKS_FROM");
    unsetenv("LUTETIA_GHOSTS");
    return m;
}

static struct machine_value *real(struct machine *m, double x)
{
    const float f = (float)x;
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return machine_constant(m, MACHINE_F32, (struct machine_scalar){bits, 0});
}

static struct machine_value *water_of(struct machine *m, uint32_t field)
{
    return machine_field_value(m, field, MACHINE_F32, MACHINE_EVERYWHERE);
}

static struct machine_value *life_of(struct machine *m, uint32_t field)
{
    return machine_field_value(m, field, MACHINE_UINT(32), MACHINE_EVERYWHERE);
}

static void store(struct machine *m, uint32_t field, struct machine_value *v)
{
    assert_ok(machine_field_store(m, field, v, MACHINE_WHERE_ACTIVE), m);
}

/* Places, draws, and their neighbours: what is another expression in a block. */
static void begin(struct machine *m, const struct form *s, uint32_t water, uint32_t life)
{
    machine_begin(m);
    struct machine_value *x = machine_self_index(m, 32);
    for (int axis = 0; axis < s->rank; axis++)
        x = machine_binary(m, MACHINE_XOR, x, machine_coordinate(m, axis, 32));
    store(m, life, machine_binary(m, MACHINE_ADD, x, machine_random(m, 32, 0)));
    machine_begin(m);
    store(m, life,
          machine_binary(m, MACHINE_XOR, life_of(m, life), machine_random(m, 32, 1000003)));
    machine_begin(m);
    store(
        m, life,
        machine_binary(m, MACHINE_ADD, life_of(m, life),
                       machine_resize(m, machine_random(m, 40, UINT64_C(1) << 35), 32, false)));
    machine_begin(m);
    store(m, life,
          machine_binary(m, MACHINE_XOR, life_of(m, life), machine_self_address(m, 32)));
    machine_begin(m);
    store(m, water, machine_to_float(m, life_of(m, life), MACHINE_F32, false));
}

/* Along all axes, and by a distance along the first; a context of places. */
static void turn(struct machine *m, const struct form *s, uint32_t water, uint32_t life)
{
    machine_begin(m);
    struct machine_value *w = water_of(m, water), *sum = w, *l = life_of(m, life);
    for (int axis = 0; axis < s->rank; axis++) {
        sum = machine_binary(m, MACHINE_FADD, sum, machine_shift(m, w, axis, 1));
        sum = machine_binary(m, MACHINE_FADD, sum, machine_shift(m, w, axis, -1));
    }
    store(m, water, machine_binary(m, MACHINE_FMUL, sum, real(m, 0.23)));
    machine_begin(m);
    store(m, life,
          machine_binary(m, MACHINE_ADD, machine_shift(m, l, 0, -2),
                         machine_binary(m, MACHINE_XOR, l, machine_coordinate(m, 0, 32))));
}

static struct found run(const char *blocks, const struct form *s)
{
    struct machine *m = machine_of(blocks, s);
    struct found f = {.count = 1};
    for (int axis = 0; axis < s->rank; axis++)
        f.count *= (uint64_t)s->lengths[axis];
    const int set = machine_vpset_create(m, s->lengths, s->rank);
    assert_ok(machine_vpset_select(m, set), m);
    const uint32_t water = machine_field_allocate(m, set, 32, MACHINE_HEAP),
                   life = machine_field_allocate(m, set, 32, MACHINE_HEAP);
    begin(m, s, water, life);
    for (int i = 0; i < TURNS; i++) {
        turn(m, s, water, life);
        assert_ok(machine_flush(m), m);
    }
    f.blocks = machine_blocks(m);
    machine_begin(m);
    store(m, life,
          machine_binary(m, MACHINE_XOR, life_of(m, life),
                         machine_shift(m, life_of(m, life), 0, s->lengths[0] / 2)));
    assert_ok(machine_reduce(m, MACHINE_REDUCE_FADD, water_of(m, water), &f.sum), m);
    assert_ok(machine_reduce(m, MACHINE_REDUCE_FMAX, water_of(m, water), &f.largest), m);
    assert_ok(machine_reduce(m, MACHINE_REDUCE_ADD, life_of(m, life), &f.bits), m);
    f.water = malloc(f.count * sizeof *f.water);
    f.life = malloc(f.count * sizeof *f.life);
    assert_true(f.water && f.life);
    assert_ok(machine_field_download(m, water, MACHINE_F32, f.water), m);
    assert_ok(machine_field_download(m, life, MACHINE_UINT(32), f.life), m);
    for (uint64_t i = 0; i < f.count; i += f.count / 5) {
        struct machine_scalar x;
        assert_ok(machine_field_read(m, life, MACHINE_UINT(32), i, &x), m);
        assert_int_equal(x.lo, f.life[i]);
    }
    machine_destroy(m);
    return f;
}

static void blocks_give_the_bits_of_one_piece(void **state)
{
    (void)state;
    static const char *const counts[] = {"2", "3", "4", "7"};
    for (int i = 0; i < SETS; i++) {
        struct found one = run("1", &forms[i]);
        assert_int_equal(one.blocks.run, 0);
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
            struct found f = run(counts[k], &forms[i]);
            assert_memory_equal(f.water, one.water, f.count * sizeof *f.water);
            assert_memory_equal(f.life, one.life, f.count * sizeof *f.life);
            assert_memory_equal(&f.sum, &one.sum, sizeof f.sum);
            assert_memory_equal(&f.largest, &one.largest, sizeof f.largest);
            assert_memory_equal(&f.bits, &one.bits, sizeof f.bits);
            /* all turns have run in blocks, nothing has been put together for them, and ghosts
             * did not last */
            assert_true(f.blocks.run >= TURNS);
            assert_int_equal(f.blocks.gathered, 0);
            assert_true(f.blocks.fetched > 0);
            free(f.water);
            free(f.life);
        }
        free(one.water);
        free(one.life);
    }
}

/* Whether the driver says that it divides the device by counts: PoCL 7.1 does not. */
static bool driver_divides(const struct machine *m)
{
    cl_device_partition_property ways[16];
    size_t bytes = 0;
    assert_int_equal(clGetDeviceInfo(m->device->id, CL_DEVICE_PARTITION_PROPERTIES, sizeof ways,
                                     ways, &bytes),
                     CL_SUCCESS);
    for (size_t i = 0; i < bytes / sizeof *ways; i++)
        if (ways[i] == CL_DEVICE_PARTITION_BY_COUNTS)
            return true;
    return false;
}

/* Whether each block has a sequencer of its own or not. */
static void sequencers_have_shares_of_the_device(void **state)
{
    (void)state;
    const struct form *s = &forms[1];
    struct machine *m = machine_of("2", s);
    const bool divides = m->device->is_pocl && m->device->units > 1 && m->settings.near &&
                         device_is_ours(m->device) && driver_divides(m);
    machine_destroy(m);
    struct found together = run("2", s);
    setenv("LUTETIA_BLOCKS_APART", "1", 1);
    struct found apart = run("2", s);
    unsetenv("LUTETIA_BLOCKS_APART");
    assert_int_equal(apart.blocks.sequencers, divides ? 2 : 1);
    assert_int_equal(together.blocks.sequencers, 1);
    assert_memory_equal(apart.water, together.water, apart.count * sizeof *apart.water);
    assert_memory_equal(apart.life, together.life, apart.count * sizeof *apart.life);
    assert_int_equal(apart.blocks.fetched, together.blocks.fetched);
    free(apart.water);
    free(apart.life);
    free(together.water);
    free(together.life);
}

/* A store into one processor, and a whole field written, between turns in blocks. */
static void writes_between_turns_are_seen_by_all_blocks(void **state)
{
    (void)state;
    static const char *const counts[] = {"1", "5"};
    const struct form *s = &forms[0];
    uint32_t found[2][56 * 40], in[56 * 40];
    for (int k = 0; k < 2; k++) {
        struct machine *m = machine_of(counts[k], s);
        const int set = machine_vpset_create(m, s->lengths, s->rank);
        assert_ok(machine_vpset_select(m, set), m);
        const uint32_t water = machine_field_allocate(m, set, 32, MACHINE_HEAP),
                       life = machine_field_allocate(m, set, 32, MACHINE_HEAP);
        begin(m, s, water, life);
        for (int i = 0; i < TURNS; i++) {
            turn(m, s, water, life);
            assert_ok(machine_flush(m), m);
            machine_begin(m);
            assert_ok(machine_field_write(m, life, MACHINE_UINT(32), (uint64_t)i * 91 % 2240,
                                          (struct machine_scalar){(uint64_t)i * 77, 0}),
                      m);
            for (int p = 0; i == 9 && p < 56 * 40; p++)
                in[p] = (uint32_t)p * 2654435761u;
            if (i == 9)
                assert_ok(machine_field_upload(m, life, MACHINE_UINT(32), in), m);
        }
        assert_ok(machine_field_download(m, life, MACHINE_UINT(32), found[k]), m);
        machine_destroy(m);
    }
    assert_memory_equal(found[0], found[1], sizeof found[0]);
}

static void small_sets_and_low_ones_are_whole(void **state)
{
    (void)state;
    setenv("LUTETIA_BLOCKS", "4", 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_BLOCKS");
    static const struct form whole[] = {{2, {255, 256}, ""},
                                        {2, {127, 4096}, ""},
                                        {1, {65535}, ""}},
                             cut[] = {
                                 {2, {256, 256}, ""}, {1, {65536}, ""}, {3, {64, 64, 64}, ""}};
    uint64_t run = 0;
    for (int k = 0; k < 6; k++) {
        const struct form *s = k < 3 ? &whole[k] : &cut[k - 3];
        const int set = machine_vpset_create(m, s->lengths, s->rank);
        assert_ok(machine_vpset_select(m, set), m);
        const uint32_t life = machine_field_allocate(m, set, 32, MACHINE_HEAP);
        machine_begin(m);
        store(m, life, machine_random(m, 32, 0));
        assert_ok(machine_flush(m), m);
        assert_int_equal(machine_blocks(m).run > run, k >= 3);
        run = machine_blocks(m).run;
        assert_ok(machine_vpset_destroy(m, set), m);
    }
    machine_destroy(m);
}

/* Kernels of blocks are no kernels of the program's own nodes, and are told all the same. */
static void blocks_are_explained(void **state)
{
    (void)state;
    const struct form *s = &forms[0];
    struct machine_config config = machine_config_default();
    struct machine *m;
    int told = 0;
    config.explain = 1;
    setenv("LUTETIA_BLOCKS", "3", 1);
    setenv("LUTETIA_BLOCKS_FROM", "2", 1);
    assert_int_equal(machine_create(&config, &m), MACHINE_OK);
    unsetenv("LUTETIA_BLOCKS");
    unsetenv("LUTETIA_BLOCKS_FROM");
    const int set = machine_vpset_create(m, s->lengths, s->rank);
    assert_ok(machine_vpset_select(m, set), m);
    const uint32_t water = machine_field_allocate(m, set, 32, MACHINE_HEAP),
                   life = machine_field_allocate(m, set, 32, MACHINE_HEAP);
    begin(m, s, water, life);
    for (int i = 0; i < TURNS; i++) {
        turn(m, s, water, life);
        assert_ok(machine_flush(m), m);
    }
    assert_true(machine_blocks(m).run >= TURNS);
    const struct machine_explained *x = machine_explain(m, false);
    assert_non_null(x);
    for (int i = 0; i < x->kernels_count; i++)
        for (int k = 0; x->kernels[i].generated && k < x->kernels[i].stores_count; k++) {
            assert_true(x->kernels[i].stores[k].operation[0] != '\0');
            told++;
        }
    assert_true(told > 0);
    machine_destroy(m);
}

static void a_wrong_number_of_blocks_is_one_line(void **state)
{
    (void)state;
    static const char *const wrong[] = {"0", "65", "two", "-1"};
    for (int i = 0; i < 4; i++) {
        const struct machine_config config = machine_config_default();
        struct machine *m;
        setenv("LUTETIA_BLOCKS", wrong[i], 1);
        assert_int_equal(machine_create(&config, &m), MACHINE_BAD_ARGUMENT);
        support_failed(m, MACHINE_BAD_ARGUMENT, "LUTETIA_BLOCKS must be a number from 1 to 64");
        machine_destroy(m);
    }
    unsetenv("LUTETIA_BLOCKS");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_give_the_bits_of_one_piece),
        cmocka_unit_test(sequencers_have_shares_of_the_device),
        cmocka_unit_test(writes_between_turns_are_seen_by_all_blocks),
        cmocka_unit_test(small_sets_and_low_ones_are_whole),
        cmocka_unit_test(blocks_are_explained),
        cmocka_unit_test(a_wrong_number_of_blocks_is_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
