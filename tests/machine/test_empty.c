/* test_empty.c - machine_empty(): a machine that has been used is as one that was just made;
 * and which machines warm up. */
#include <unistd.h>

#include "support.h"

enum { COUNT = 777, TURNS = 40 };

/* What a program finds: ids, numbers, results. */
struct found {
    int set, other;
    uint32_t heap, stack, alias;
    uint64_t sum, random, received, read, context;
    struct machine_stats stats;
};

static struct machine_value *word(struct machine *m, uint32_t field)
{
    return machine_field_value(m, field, MACHINE_UINT(32), MACHINE_EVERYWHERE);
}

static struct machine_value *number(struct machine *m, uint64_t n)
{
    return machine_constant(m, MACHINE_UINT(32), (struct machine_scalar){n, 0});
}

static uint64_t reduced(struct machine *m, struct machine_value *v)
{
    struct machine_scalar out;
    assert_ok(machine_reduce(m, MACHINE_REDUCE_ADD, v, &out), m);
    return out.lo;
}

/* Two VP sets of other shapes, fields of both regions, an alias, a loop, a context, random
 * numbers, messages, and values that still wait at the end. */
static struct found use(struct machine *m, int count)
{
    struct found f = {0};
    struct machine_scalar one;
    f.set = machine_vpset_create(m, &count, 1);
    f.other = machine_vpset_create(m, (int[]){3, 8}, 2);
    assert_ok(machine_vpset_select(m, f.set), m);
    f.heap = machine_field_allocate(m, f.set, 32, MACHINE_HEAP);
    f.stack = machine_field_allocate(m, f.set, 32, MACHINE_STACK);
    f.alias = machine_alias_make(m, f.heap, f.set);
    assert_true(f.set && f.other && f.heap && f.stack && f.alias);
    for (int turn = 0; turn < TURNS; turn++) {
        machine_begin(m);
        struct machine_value *v =
            machine_binary(m, MACHINE_ADD, word(m, f.heap), machine_self_index(m, 32));
        assert_ok(machine_field_store(m, f.heap, v, MACHINE_EVERYWHERE), m);
        v = machine_shift(m, word(m, f.heap), 0, 1);
        assert_ok(machine_field_store(m, f.stack, v, MACHINE_EVERYWHERE), m);
    }
    machine_begin(m);
    f.sum = reduced(m, machine_binary(m, MACHINE_XOR, word(m, f.heap), word(m, f.stack)));
    machine_begin(m);
    assert_ok(machine_field_store(m, f.stack, machine_random(m, 32, 0), MACHINE_EVERYWHERE), m);
    f.random = reduced(m, word(m, f.stack));
    machine_begin(m);
    assert_ok(machine_send(m, f.stack, machine_self_address(m, 32), word(m, f.alias),
                           MACHINE_COMBINE_ADD, MACHINE_NO_FIELD),
              m);
    f.received = reduced(m, word(m, f.stack));
    machine_begin(m);
    assert_ok(machine_field_read(m, f.heap, MACHINE_UINT(32), (uint64_t)count / 2, &one), m);
    f.read = one.lo;
    machine_begin(m);
    assert_ok(
        machine_flag_store(m, MACHINE_CONTEXT,
                           machine_binary(m, MACHINE_ULT, word(m, f.stack), word(m, f.heap)),
                           MACHINE_EVERYWHERE),
        m);
    f.context =
        reduced(m, machine_resize(m, machine_flag_value(m, MACHINE_CONTEXT, MACHINE_EVERYWHERE),
                                  32, false));
    machine_stats_get(m, &f.stats);
    machine_begin(m);
    assert_ok(machine_field_store(
                  m, f.stack, machine_binary(m, MACHINE_MUL, word(m, f.stack), number(m, 3)),
                  MACHINE_WHERE_ACTIVE),
              m);
    return f;
}

static void same(const struct found *a, const struct found *b)
{
    assert_int_equal(a->set, b->set);
    assert_int_equal(a->other, b->other);
    assert_int_equal(a->heap, b->heap);
    assert_int_equal(a->stack, b->stack);
    assert_int_equal(a->alias, b->alias);
    assert_int_equal(a->sum, b->sum);
    assert_int_equal(a->random, b->random);
    assert_int_equal(a->received, b->received);
    assert_int_equal(a->read, b->read);
    assert_int_equal(a->context, b->context);
    assert_int_equal(a->stats.stores, b->stats.stores);
    assert_int_equal(a->stats.flushes, b->stats.flushes);
    assert_int_equal(a->stats.plans_built, b->stats.plans_built);
    assert_int_equal(a->stats.values_live, b->stats.values_live);
    assert_int_equal(a->stats.interpreted, b->stats.interpreted);
    assert_int_equal(a->stats.bytes_held, b->stats.bytes_held);
}

static void is_as_made(struct machine *m, const struct found *before)
{
    struct machine_field_info info;
    struct machine_stats stats;
    machine_stats_get(m, &stats);
    assert_int_equal(stats.stores, 0);
    assert_int_equal(stats.values_live, 0);
    assert_int_equal(stats.bytes_held, 0);
    assert_int_equal(stats.plans_built, 0);
    assert_int_equal(stats.flushes, 0);
    assert_int_equal(machine_processors_count(m), 16);
    assert_false(machine_field_lookup(m, before->heap, &info));
    assert_false(machine_field_lookup(m, before->alias, &info));
    assert_int_not_equal(machine_vpset_select(m, before->set), MACHINE_OK);
    machine_error_clear(m);
}

static void a_used_one_is_as_made(void **state)
{
    const char *const tiers[] = {"1", "2", "0"};
    (void)state;
    for (int tier = 0; tier < 3; tier++) {
        setenv("LUTETIA_INTERPRET", tiers[tier], 1);
        for (int eager = 0; eager < 2; eager++) {
            struct machine *m = support_machine(eager);
            struct found first = use(m, COUNT), again;
            for (int time = 0; time < 3; time++) {
                assert_ok(machine_empty(m), m);
                is_as_made(m, &first);
                if (time == 1)
                    use(m, 5000); /* another program in between */
                if (time == 1)
                    assert_ok(machine_empty(m), m);
                again = use(m, COUNT);
                same(&first, &again);
            }
            machine_destroy(m);
        }
    }
    unsetenv("LUTETIA_INTERPRET");
}

/* While kernels are compiled for it. */
static void a_busy_one_is_as_made(void **state)
{
    (void)state;
    setenv("LUTETIA_BACKGROUND", "1", 1);
    setenv("LUTETIA_OPTIMISE_AFTER", "1000", 1);
    struct machine *m = support_machine(0);
    struct found first = use(m, COUNT);
    for (int time = 0; time < 5; time++) {
        assert_ok(machine_empty(m), m);
        is_as_made(m, &first);
        struct found again = use(m, COUNT);
        assert_int_equal(first.sum, again.sum);
        assert_int_equal(first.random, again.random);
        assert_int_equal(first.received, again.received);
    }
    machine_destroy(m);
    unsetenv("LUTETIA_OPTIMISE_AFTER");
    setenv("LUTETIA_BACKGROUND", "0", 1);
}

static bool warms_up(const char *variable, const char *value)
{
    if (variable)
        setenv(variable, value, 1);
    struct machine_config config = machine_config_default();
    struct machine *m;
    assert_int_equal(machine_create(&config, &m), MACHINE_OK);
    bool is = machine_warms_up(m);
    machine_destroy(m);
    if (variable)
        unsetenv(variable);
    return is;
}

static void only_what_nobody_watches_warms_up(void **state)
{
    char trace[64];
    (void)state;
    setenv("LUTETIA_INTERPRET", "1", 1);
    assert_true(warms_up(NULL, NULL));
    assert_false(warms_up("LUTETIA_INTERPRET", "0"));
    setenv("LUTETIA_INTERPRET", "1", 1);
    assert_false(warms_up("LUTETIA_EAGER", "1"));
    assert_false(warms_up("LUTETIA_OPTIMISE_AFTER", "0"));
    assert_false(warms_up("LUTETIA_DUMP", support_cache));
    snprintf(trace, sizeof trace, "%.50s/trace", support_cache);
    assert_false(warms_up("LUTETIA_TRACE", trace));
    unlink(trace);
    unsetenv("LUTETIA_INTERPRET");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_used_one_is_as_made),
        cmocka_unit_test(a_busy_one_is_as_made),
        cmocka_unit_test(only_what_nobody_watches_warms_up),
    };
    return cmocka_run_group_tests(tests, support_cache_make, support_cache_remove);
}
