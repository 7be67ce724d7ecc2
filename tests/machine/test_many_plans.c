/* test_many_plans.c - a program that never repeats: as many different plans as its argument says (20,000). The numbers are right, and
 * the memory, the plans kept, and the folder of kept files do not grow beyond their bounds. */
#include "support.h"

#include <dirent.h>

#include "base/clock.h"
#include "build/plans.h"

enum { PLANS_BITS = 30, PLANS_FEW = 20000, UNITS_MOST = 8192 + 4096 + 64, FILES_MOST = 64 };
/* What may be added after the first plans, by whatever else the process does. AddressSanitizer keeps 256 MiB of what is freed. */
#ifdef __SANITIZE_ADDRESS__
static const double ROOM_BYTES = 24e6 + 256 * 1048576.0;
#else
static const double ROOM_BYTES = 24e6;
#endif

static uint32_t plans_wanted = PLANS_FEW;

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

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_program_that_never_repeats_stays_bounded),
    };
    if (argc > 1)
        plans_wanted = (uint32_t)strtoul(argv[1], NULL, 10);
    if (plans_wanted < PLANS_FEW || plans_wanted >> PLANS_BITS) {
        fprintf(stderr, "%s [PLANS], %d or more\n", argv[0], PLANS_FEW);
        return 2;
    }
    return cmocka_run_group_tests(tests, support_cache_make, support_cache_remove);
}
