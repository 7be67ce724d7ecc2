/* Plans that differ only in numbers (bit positions, widths, distances) share kernels that take
 * the numbers as arguments. Generated steps give the same bits with such kernels, by every
 * width of vectors, as interpreted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../sample.h"
#include "machine_explained.h"
#include "paris_internal.h"
#include <cm/paris.h>

enum { STEPS = 20, WIDE = 100, HEIGHT = 19, WIDTH = 70 };

static uint64_t state;

static unsigned int below(unsigned int n)
{
    return (unsigned int)(sample_shifted(&state) >> 33) % n;
}

static struct {
    CM_field_id_t wide, word, sum, small, bit;
} on;

/* ---- programs ---- */

static void begin_as(const char *interpret, const char *numbers, const char *vector)
{
    struct machine_config config = machine_config_default();
    setenv("LUTETIA_INTERPRET", interpret, 1);
    setenv("LUTETIA_NUMBERS", numbers, 1);
    setenv("LUTETIA_VECTOR", vector, 1);
    config.processors_count = 16;
    config.explain = 1;
    assert_true(paris_reset(&config));
}

static void set_make(void)
{
    static unsigned int sides[2] = {HEIGHT, WIDTH};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sides, 2)));
    CM_set_context();
    on.wide = CM_allocate_heap_field(WIDE);
    on.word = CM_allocate_heap_field(32);
    on.sum = CM_allocate_heap_field(32);
    on.small = CM_allocate_heap_field(8);
    on.bit = CM_allocate_heap_field(1);
    CM_my_news_coordinate_1L(on.word, 0, 32);
    CM_u_multiply_constant_2_1L(on.word, 0x9e3779b1u, 32);
    CM_my_news_coordinate_1L(on.sum, 1, 32);
    CM_u_multiply_constant_2_1L(on.sum, 0x85ebca6bu, 32);
    CM_logxor_2_1L(on.word, on.sum, 32);
    CM_u_multiply_3_3L(on.wide, on.word, on.sum, 64, 32, 32);
    CM_u_multiply_3_3L(on.wide + 60, on.sum, on.word, WIDE - 60, 32, 32);
    CM_u_move_2L(on.small, on.word + 9, 8, 8);
    CM_u_read_from_processor_1L(0, on.wide, 32); /* all is in memory */
    CM_u_read_from_processor_1L(0, on.small, 8);
}

/* A step with numbers of its own. */
static void step(void)
{
    unsigned int k = below(32), length = 2 + below(15), direction = below(2);
    CM_field_id_t part = on.wide + below(60);
    switch (below(9)) {
    case 0:
        CM_u_add_2_2L(on.sum, part, 32, length);
        break;
    case 1:
        CM_s_add_2_2L(on.sum, on.word + k % 16, 32, length);
        break;
    case 2:
        CM_u_move_2L(on.wide + k, on.sum, 13, 13);
        break;
    case 3:
        CM_get_from_power_two_1L(on.word, on.sum, 1, below(5),
                                 direction ? CM_upward : CM_downward, 32);
        break;
    case 4:
        CM_get_from_power_two_1L(on.word, on.sum, 0, below(4),
                                 direction ? CM_upward : CM_downward, 32);
        CM_u_add_2_1L(on.sum, on.word, 32);
        break;
    case 5:
        CM_u_move_2L(on.small, part, 8, 3 + k % 5);
        CM_u_add_2_1L(on.small, part + 8, 2 + k % 6);
        break;
    case 6:
        CM_s_lt_1L(part, on.sum + k % 8, length);
        CM_store_test(on.bit);
        break;
    case 7:
        CM_logxor_2_1L(on.bit, part, 1);
        CM_load_context(on.bit);
        CM_s_move_2L(on.sum, part, 32, length);
        CM_set_context();
        break;
    default:
        CM_logxor_2_1L(on.wide + k, on.wide + k + 33, 20 + length);
    }
}

static uint64_t content_hash(uint64_t h)
{
    static unsigned char content[16 * HEIGHT * WIDTH];
    struct machine *m = paris_machine();
    const struct {
        CM_field_id_t field;
        int bits;
    } all[] = {{on.wide, WIDE}, {on.word, 32}, {on.sum, 32}, {on.small, 8}, {on.bit, 1}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        memset(content, 0, sizeof content);
        assert_int_equal(
            machine_field_download(m, all[i].field, MACHINE_UINT(all[i].bits), content),
            MACHINE_OK);
        for (size_t k = 0; k < sizeof content; k++)
            h = (h ^ content[k]) * 0x100000001b3u;
    }
    return h;
}

/* Each step is looked at, so each is an evaluation, and most are plans that nothing has had
 * before. */
static void program_run(int program, uint64_t hashes[STEPS])
{
    state = 88172645463325252u + (uint64_t)program * 104729;
    set_make();
    for (int i = 0; i < STEPS; i++) {
        step();
        hashes[i] = content_hash(1);
    }
}

static struct machine_stats stats_of(void)
{
    struct machine_stats stats;
    machine_stats_get(paris_machine(), &stats);
    return stats;
}

static void arguments_give_the_same_bits(void **unused)
{
    static const char *const vectors[] = {"16", "1", "4"};
    uint64_t interpreted[STEPS], lifted[STEPS];
    (void)unused;
    for (int program = 0; program < 3; program++) {
        begin_as("2", "1", "16");
        program_run(program, interpreted);
        begin_as("0", "1", vectors[program]);
        program_run(program, lifted);
        for (int i = 0; i < STEPS; i++)
            if (interpreted[i] != lifted[i])
                fail_msg("program %d, step %d: not the same by vectors of %s", program, i,
                         vectors[program]);
        assert_int_equal(stats_of().interpreted, 0);
    }
}

/* ---- how many kernels ---- */

static void positions(unsigned int count)
{
    for (unsigned int k = 0; k < count; k++) {
        CM_u_add_2_2L(on.sum, on.wide + 1 + k, 32, 12);
        CM_u_read_from_processor_1L(0, on.sum, 32);
    }
}

static void distances(unsigned int count)
{
    for (unsigned int k = 0; k < count; k++) {
        CM_get_from_power_two_1L(on.word, on.sum, 0, k % 4, CM_upward, 32);
        CM_u_add_2_1L(on.sum, on.word, 32);
        CM_u_read_from_processor_1L(0, on.sum, 32);
    }
}

/* Kernels that a loop builds, beyond those for what there was before. */
static uint64_t built(const char *numbers, void (*loop)(unsigned int count), unsigned int count)
{
    begin_as("0", numbers, "16");
    set_make();
    loop(1);
    uint64_t before = stats_of().kernels_built;
    loop(count);
    return stats_of().kernels_built - before;
}

static void kernels_are_shared(void **unused)
{
    (void)unused;
    uint64_t shared = built("", positions, 16), own = built("0", positions, 16);
    if (own < 12 || shared > 4)
        fail_msg("16 positions: %d kernels, %d where none takes numbers as arguments",
                 (int)shared, (int)own);
    shared = built("1", distances, 12);
    if (shared > 3)
        fail_msg("12 distances: %d kernels", (int)shared);
}

/* The plans of a loop are told as one family, with what they differ in. */
static void families_are_explained(void **unused)
{
    (void)unused;
    begin_as("2", "", "16");
    set_make();
    positions(16);
    const struct machine_explained *e = machine_explain(paris_machine(), false);
    assert_non_null(e);
    int found = 0;
    for (int i = 0; i < e->families_count; i++) {
        const struct machine_explained_family *f = &e->families[i];
        const struct machine_explained_range *where = &f->differ[MACHINE_NUMBER_POSITION];
        if (f->plans < 15)
            continue;
        assert_true(where->differs);
        assert_int_equal(where->most - where->least, f->plans - 1);
        assert_false(f->differ[MACHINE_NUMBER_DISTANCE].differs);
        assert_int_equal(f->runs[MACHINE_TIER_INTERPRETED], f->plans);
        assert_int_equal(f->runs[MACHINE_TIER_QUICK], 0);
        found++;
    }
    assert_int_equal(found, 1);
}

/* What earlier runs have left on disk would decide which kernels are taken. */
static int cache_make(void **unused)
{
    static char folder[] = "/tmp/lutetia-numbers-XXXXXX";
    (void)unused;
    return !mkdtemp(folder) || setenv("XDG_CACHE_HOME", folder, 1) ||
           setenv("POCL_CACHE_DIR", folder, 1);
}

static int cache_remove(void **unused)
{
    char command[100];
    (void)unused;
    snprintf(command, sizeof command, "rm -rf '%.60s'", getenv("XDG_CACHE_HOME"));
    return system(command);
}

int main(void)
{
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_are_shared),
        cmocka_unit_test(arguments_give_the_same_bits),
        cmocka_unit_test(families_are_explained),
    };
    return cmocka_run_group_tests(tests, cache_make, cache_remove);
}
