/* test_many_plans.c - a program that never repeats: as many different plans as its argument
 * says (20,000). The numbers are right, and the memory, the plans kept, and the folder of kept
 * files do not grow beyond their bounds. Then the same with a kernel for each plan, as many as
 * the second argument says (40): no more than a few are in memory, and those that come back are
 * not compiled again. */
#include "support.h"

#include <dirent.h>

#include "base/clock.h"
#include "plans/plans.h"

enum { PLANS_BITS = 30, PLANS_FEW = 20000, UNITS_MOST = 8192 + 4096 + 64, FILES_MOST = 64 };
/* What may be added after the first plans, by whatever else the process does. AddressSanitizer
 * keeps 256 MiB of what is freed. */
#ifdef __SANITIZE_ADDRESS__
static const double ROOM_BYTES = 24e6 + 256 * 1048576.0;
#else
static const double ROOM_BYTES = 24e6;
#endif

static uint32_t plans_wanted = PLANS_FEW;

enum { KERNELS_FEW = 40 }; /* more than LUTETIA_KERNELS, which is 16 then */
static uint32_t kernels_wanted = KERNELS_FEW;

static double memory_bytes(void)
{
    long pages = 0, resident = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    assert_non_null(f);
    assert_int_equal(fscanf(f, "%ld %ld", &pages, &resident), 2);
    fclose(f);
    return (double)resident * 4096;
}

static int files_kept(void)
{
    char path[300];
    int count = 0;
    snprintf(path, sizeof path, "%s/lutetia", support_cache);
    DIR *folder = opendir(path);
    while (folder && readdir(folder))
        count++;
    if (folder)
        closedir(folder);
    return count;
}

/* The bits of k choose the operations: each k is another plan. */
static uint32_t step(struct machine *m, uint32_t f, uint32_t k, uint32_t x)
{
    const struct machine_type word = MACHINE_UINT(32);
    struct machine_value *one = support_value(m, f, word), *v = one;
    uint32_t y = x;
    for (int bit = 0; bit == 0 || k >> bit; bit++) {
        v = machine_binary(m, k >> bit & 1 ? MACHINE_ADD : MACHINE_XOR, v,
                           bit % 2 ? one : machine_unary(m, MACHINE_NOT, one));
        y = k >> bit & 1 ? y + (bit % 2 ? x : ~x) : y ^ (bit % 2 ? x : ~x);
    }
    assert_ok(machine_field_store(m, f, v, MACHINE_EVERYWHERE), m);
    machine_begin(m);
    return y;
}

static void a_program_that_never_repeats_stays_bounded(void **state)
{
    (void)state;
    struct machine_stats stats;
    struct machine_scalar read;
    setenv("LUTETIA_INTERPRET", "1", 1);
    setenv("LUTETIA_AT_ONCE", "0", 1); /* which makes no plans */
    struct machine *m = support_machine(0);
    assert_true(support_set(m, 1, 5) > 0);
    const uint32_t f = support_field(m, MACHINE_UINT(32), 1);
    assert_ok(machine_field_read(m, f, MACHINE_UINT(32), 2, &read), m);
    machine_begin(m);
    double before = 0, start = clock_s();
    uint32_t x = (uint32_t)read.lo;
    for (uint32_t k = 0; k < plans_wanted; k++) {
        x = step(m, f, k + 2, x);
        assert_ok(machine_field_read(m, f, MACHINE_UINT(32), 2, &read), m);
        machine_begin(m);
        assert_int_equal(read.lo, x);
        assert_true(m->plans->units <= UNITS_MOST);
        if (k == PLANS_FEW * 3 / 4)
            before = memory_bytes();
        if (k % 100000 == 99999)
            print_message("%u plans: %d kept, %.1f MB, %.0f s\n", k + 1, m->plans->count,
                          1e-6 * memory_bytes(), clock_s() - start);
    }
    machine_stats_get(m, &stats);
    assert_true(stats.plans_built >= plans_wanted);
    assert_true(memory_bytes() - before < ROOM_BYTES);
    assert_true(files_kept() <= FILES_MOST);
    support_machine_destroy(m);
}

static int compiled(void)
{
    char command[400];
    int count = -1;
    snprintf(command, sizeof command, "find %s -name '*.so' | wc -l", support_cache);
    FILE *f = popen(command, "r");
    assert_non_null(f);
    assert_int_equal(fscanf(f, "%d", &count), 1);
    pclose(f);
    return count;
}

/* So many turns of a loop of one call; from the fourth on they are foreseen. */
static uint32_t loop(struct machine *m, uint32_t f, uint32_t x)
{
    struct machine_scalar read;
    for (int i = 0; i < 12; i++) {
        x = step(m, f, 1, x);
        assert_ok(machine_field_read(m, f, MACHINE_UINT(32), 2, &read), m);
        machine_begin(m);
        assert_int_equal(read.lo, x);
    }
    return x;
}

static uint32_t all_kernels(struct machine *m, uint32_t f, uint32_t x, const char *when)
{
    struct machine_scalar read;
    for (uint32_t k = 0; k < kernels_wanted; k++) {
        x = step(m, f, k + 2, x);
        assert_ok(machine_field_read(m, f, MACHINE_UINT(32), 2, &read), m);
        machine_begin(m);
        assert_int_equal(read.lo, x);
        assert_true(m->device->kernel_units <= m->settings.kernels + 4);
        if (k % 500 == 499)
            print_message("%s, %u plans: %d units of kernels, %.1f MB\n", when, k + 1,
                          (int)m->device->kernel_units, 1e-6 * memory_bytes());
    }
    return x;
}

/* A field of numbers; x: the third of them. */
static uint32_t numbers(struct machine *m, uint32_t *x)
{
    struct machine_scalar read;
    assert_true(support_set(m, 1, 5) > 0);
    const uint32_t f = support_field(m, MACHINE_UINT(32), 1);
    assert_ok(machine_field_read(m, f, MACHINE_UINT(32), 2, &read), m);
    machine_begin(m);
    *x = (uint32_t)read.lo;
    return f;
}

/* Kernels that had to go are loaded from the driver's cache, not compiled. What runs all the
 * time stays. */
static void compiled_kernels_stay_bounded(void **state)
{
    (void)state;
    setenv("LUTETIA_INTERPRET", "0", 1);
    setenv("LUTETIA_AT_ONCE", "0", 1);
    if (kernels_wanted == KERNELS_FEW)
        setenv("LUTETIA_KERNELS", "16", 1);
    struct machine *m = support_machine(0);
    uint32_t x;
    const uint32_t f = numbers(m, &x);
    x = loop(m, f, x);
    x = all_kernels(m, f, x, "compiled");
    const int there = compiled();
    const uint64_t built = m->device->kernels_built;
    assert_true(m->device->kernels_gone > 0 || kernels_wanted < m->settings.kernels);
    x = loop(m, f, x);
    all_kernels(m, f, x, "again");
    assert_int_equal(compiled(), there);
    assert_true(m->device->kernels_built > built || kernels_wanted < m->settings.kernels);
    support_machine_destroy(m);
    unsetenv("LUTETIA_KERNELS");
}

/* A process that has started as many kernels as the driver has room for computes all else
 * without. */
static void a_process_has_so_many_kernels(void **state)
{
    (void)state;
    struct machine_stats stats[2];
    setenv("LUTETIA_KERNELS_EVER", "5", 1); /* other cases have started more */
    struct machine *m = support_machine(0);
    uint32_t x;
    const uint32_t f = numbers(m, &x);
    machine_stats_get(m, &stats[0]);
    loop(m, f, x);
    machine_stats_get(m, &stats[1]);
    assert_int_equal(stats[0].kernels_built, stats[1].kernels_built);
    assert_true(stats[0].interpreted < stats[1].interpreted);
    support_machine_destroy(m);
    unsetenv("LUTETIA_KERNELS_EVER");
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_program_that_never_repeats_stays_bounded),
        cmocka_unit_test(compiled_kernels_stay_bounded),
        cmocka_unit_test(a_process_has_so_many_kernels),
    };
    if (argc > 1)
        plans_wanted = (uint32_t)strtoul(argv[1], NULL, 10);
    if (argc > 2)
        kernels_wanted = (uint32_t)strtoul(argv[2], NULL, 10);
    if (plans_wanted < PLANS_FEW || plans_wanted >> PLANS_BITS ||
        kernels_wanted < KERNELS_FEW || kernels_wanted >> PLANS_BITS) {
        fprintf(stderr, "%s [PLANS [KERNELS]], %d and %d or more\n", argv[0], PLANS_FEW,
                KERNELS_FEW);
        return 2;
    }
    return cmocka_run_group_tests(tests, support_cache_make, support_cache_remove);
}
