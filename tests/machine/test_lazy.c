/* test_lazy.c - the promises of lazy evaluation: a value that nobody reads is not computed, a
 * step seen before builds no kernel, and the graph does not grow. Measured by
 * machine_stats_get(); the values are compared with the eager machine's. */
#include "sample.h"
#include "support.h"

enum { ROWS = 20, COLUMNS = 70, COUNT = ROWS * COLUMNS };

struct sheet {
    struct machine *m;
    uint32_t water, flow, scratch;
};

static void sheet_open(struct sheet *s, int eager)
{
    int set;

    s->m = support_machine(eager);
    set = support_set(s->m, 2, ROWS, COLUMNS);
    s->water = support_field(s->m, MACHINE_UINT(32), 1);
    s->flow = machine_field_allocate(s->m, set, 32, MACHINE_HEAP);
    s->scratch = machine_field_allocate(s->m, set, 32, MACHINE_STACK);
}

static struct machine_stats stats(struct machine *m)
{
    struct machine_stats now;

    machine_stats_get(m, &now);
    return now;
}

static struct machine_value *constant(struct machine *m, uint64_t x)
{
    return machine_constant(m, MACHINE_UINT(32), (struct machine_scalar){x, 0});
}

static void store(struct sheet *s, uint32_t field, struct machine_value *v)
{
    assert_ok(machine_field_store(s->m, field, v, MACHINE_WHERE_ACTIVE), s->m);
    machine_begin(s->m);
}

/* water += (left neighbour's water - water) * k, by way of two temporaries and a nested
 * context. */
static void step(struct sheet *s, uint64_t k)
{
    struct machine *m = s->m;
    const struct machine_type word = MACHINE_UINT(32);
    struct machine_value *test;

    machine_begin(m);
    store(s, s->scratch, machine_shift(m, support_value(m, s->water, word), 1, -1));
    store(s, s->flow,
          machine_binary(m, MACHINE_SUB, support_value(m, s->scratch, word),
                         support_value(m, s->water, word)));
    test = machine_binary(m, MACHINE_SLT, support_value(m, s->flow, word), constant(m, 0));
    assert_ok(machine_flag_store(m, MACHINE_TEST, test, MACHINE_WHERE_ACTIVE), m);
    machine_begin(m);
    assert_ok(machine_flag_store(m, MACHINE_CONTEXT,
                                 machine_flag_value(m, MACHINE_TEST, MACHINE_EVERYWHERE),
                                 MACHINE_EVERYWHERE),
              m);
    machine_begin(m);
    store(s, s->flow,
          machine_binary(m, MACHINE_MUL, support_value(m, s->flow, word), constant(m, k)));
    assert_ok(
        machine_flag_store(m, MACHINE_CONTEXT,
                           machine_constant(m, MACHINE_BIT, (struct machine_scalar){1, 0}),
                           MACHINE_EVERYWHERE),
        m);
    machine_begin(m);
    store(s, s->water,
          machine_binary(m, MACHINE_ADD, support_value(m, s->water, word),
                         support_value(m, s->flow, word)));
}

static void look(struct sheet *s, uint32_t *out)
{
    machine_begin(s->m);
    assert_ok(machine_field_download(s->m, s->water, MACHINE_UINT(32), out), s->m);
}

/* So that neighbours' bits are stored, and not the longer numbers made of them. */
static void neighbours_read_a_number_before_it_is_made_longer(void **state)
{
    struct sheet s;
    (void)state;
    sheet_open(&s, 0);
    machine_begin(s.m);
    struct machine_value *bit = machine_binary(
        s.m, MACHINE_ULT, support_value(s.m, s.water, MACHINE_UINT(32)), constant(s.m, 77));
    struct machine_value *moved = machine_shift(s.m, bit, 1, -3);
    for (int is_signed = 0; is_signed < 2; is_signed++)
        assert_ptr_equal(machine_shift(s.m, machine_resize(s.m, bit, 32, is_signed), 1, -3),
                         machine_resize(s.m, moved, 32, is_signed));
    assert_ptr_not_equal(moved, bit);
    machine_destroy(s.m);
}

static void unobserved_values_are_never_computed(void **state)
{
    struct sheet s;
    struct machine_stats before, after;

    (void)state;
    sheet_open(&s, 0);
    assert_ok(machine_finish(s.m), s.m);
    before = stats(s.m);
    for (int n = 0; n < 100; n++) {
        machine_begin(s.m);
        store(&s, s.scratch,
              machine_binary(s.m, MACHINE_MUL, support_value(s.m, s.water, MACHINE_UINT(32)),
                             constant(s.m, (uint64_t)n)));
    }
    store(&s, s.scratch, constant(s.m, 5)); /* overwritten before anybody read it */
    after = stats(s.m);
    assert_int_equal(after.kernels_run, before.kernels_run);
    assert_int_equal(after.stores, before.stores + 101);
    machine_destroy(s.m);
}

/* No plan gets better kernels here for having run on many processors: in seven blocks with
 * ghosts these steps run on more than are needed for that. */
static void repeated_step_builds_nothing_new(void **state)
{
    struct sheet s;
    struct machine_stats before, after;
    uint32_t *out = malloc(COUNT * sizeof *out);

    (void)state;
    assert_non_null(out);
    setenv("LUTETIA_OPTIMISE_AFTER", "1000000000", 1);
    sheet_open(&s, 0);
    unsetenv("LUTETIA_OPTIMISE_AFTER");
    for (int n = 0; n < 8; n++) {
        step(&s, 3);
        look(&s, out);
    }
    before = stats(s.m);
    for (int n = 0; n < 50; n++) {
        step(&s, 3);
        look(&s, out);
    }
    after = stats(s.m);
    assert_int_equal(after.plans_built, before.plans_built);
    assert_int_equal(after.kernels_built, before.kernels_built);
    assert_true(after.kernels_run >= before.kernels_run + 50);
    for (uint64_t k = 4; k < 40; k++) { /* scalars are arguments */
        step(&s, k * 1000003);
        look(&s, out);
    }
    after = stats(s.m);
    assert_int_equal(after.kernels_built, before.kernels_built);
    assert_int_equal(after.plans_built, before.plans_built);
    machine_destroy(s.m);
    free(out);
}

static void unobserved_steps_stay_bounded(void **state)
{
    struct sheet s;
    struct machine_stats early, late;

    (void)state;
    sheet_open(&s, 0);
    for (int n = 0; n < 1000; n++)
        step(&s, 3);
    early = stats(s.m);
    for (int n = 0; n < 9000; n++)
        step(&s, 3);
    late = stats(s.m);
    assert_true(late.values_live < 2 * early.values_live + 1000);
    assert_true(late.bytes_held <= 2 * early.bytes_held + 64 * COUNT);
    assert_int_equal(late.plans_built, early.plans_built);
    /* a plan that is run often gets better kernels, once */
    assert_true(late.kernels_built <= early.kernels_built + 2 * early.plans_built);
    machine_destroy(s.m);
}

static void temporaries_rewritten_do_not_grow_the_graph(void **state)
{
    struct sheet s;
    struct machine_stats early = {0}, late;

    (void)state;
    sheet_open(&s, 0);
    for (int n = 0; n < 10000; n++) {
        machine_begin(s.m);
        store(&s, s.scratch,
              machine_binary(s.m, MACHINE_ADD, support_value(s.m, s.water, MACHINE_UINT(32)),
                             constant(s.m, (uint64_t)n)));
        if (n == 100)
            early = stats(s.m);
    }
    late = stats(s.m);
    assert_true(late.values_live <= early.values_live + 10);
    assert_int_equal(late.kernels_run, early.kernels_run);
    machine_destroy(s.m);
}

static void fields_allocated_each_step_do_not_leak(void **state)
{
    struct sheet s;
    struct machine_stats early = {0}, late;

    (void)state;
    sheet_open(&s, 0);
    for (int n = 0; n < 2000; n++) {
        uint32_t t = machine_field_allocate(s.m, machine_vpset_current(s.m), 32, MACHINE_STACK);

        machine_begin(s.m);
        store(&s, t, machine_shift(s.m, support_value(s.m, s.water, MACHINE_UINT(32)), 0, 1));
        store(&s, s.water,
              machine_binary(s.m, MACHINE_XOR, support_value(s.m, t, MACHINE_UINT(32)),
                             constant(s.m, 1)));
        assert_ok(machine_field_deallocate_through(s.m, t), s.m);
        if (n == 500)
            early = stats(s.m);
    }
    late = stats(s.m);
    assert_true(late.values_live < 2 * early.values_live + 100);
    assert_true(late.bytes_held <= 2 * early.bytes_held + 64 * COUNT);
    machine_destroy(s.m);
}

/* A program gives the same bits whenever its values are observed, and on the eager machine. */
static void when_it_is_observed_makes_no_difference(void **state)
{
    enum { STEPS = 23 };
    uint32_t *wanted = malloc(COUNT * sizeof *wanted), *got = malloc(COUNT * sizeof *got);

    (void)state;
    assert_true(wanted && got);
    for (int way = 0; way < 5; way++) {
        struct sheet s;

        sheet_open(&s, way == 0);
        for (int n = 0; n < STEPS; n++) {
            step(&s, 3);
            if (way == 2 || (way == 3 && n % 5 == 0))
                look(&s, got);
            if (way == 4 && n % 3 == 0)
                assert_ok(n % 2 ? machine_flush(s.m) : machine_finish(s.m), s.m);
        }
        look(&s, way == 0 ? wanted : got);
        if (way > 0)
            assert_memory_equal(wanted, got, COUNT * sizeof *got);
        machine_destroy(s.m);
    }
    free(wanted);
    free(got);
}

static void finish_leaves_nothing_to_compute(void **state)
{
    struct sheet s;
    struct machine_stats before;
    uint32_t *out = malloc(COUNT * sizeof *out);

    (void)state;
    assert_non_null(out);
    sheet_open(&s, 0);
    step(&s, 7);
    assert_ok(machine_finish(s.m), s.m);
    before = stats(s.m);
    look(&s, out);
    assert_int_equal(stats(s.m).kernels_run, before.kernels_run);
    machine_destroy(s.m);
    free(out);
}

/* A value that was read stays valid until the next instruction, even if the field's content is
 * computed in the meantime. */
static void value_outlives_the_content_it_is_a_part_of(void **state)
{
    struct sheet s;
    const struct machine_type word = MACHINE_UINT(32);
    uint32_t *water = malloc(COUNT * sizeof *water), *out = malloc(COUNT * sizeof *out);

    (void)state;
    assert_true(water && out);
    sheet_open(&s, 0);
    look(&s, water);
    machine_begin(s.m);
    struct machine_value *some = machine_binary(
        s.m, MACHINE_ULT, support_value(s.m, s.water, word), constant(s.m, 1u << 31));
    assert_ok(machine_flag_store(s.m, MACHINE_CONTEXT, some, MACHINE_EVERYWHERE), s.m);
    machine_begin(s.m);
    store(
        &s, s.flow,
        machine_binary(s.m, MACHINE_MUL, support_value(s.m, s.water, word), constant(s.m, 9)));

    struct machine_value *product =
        machine_field_value(s.m, s.flow, word, MACHINE_WHERE_ACTIVE);
    assert_ok(machine_flush(s.m), s.m);
    for (uint64_t i = 0; i < 8; i++) /* new nodes reuse the memory of a freed node */
        machine_binary(s.m, MACHINE_XOR, support_value(s.m, s.water, word), constant(s.m, i));
    store(&s, s.scratch, product);
    assert_ok(machine_field_download(s.m, s.scratch, word, out), s.m);
    for (int i = 0; i < COUNT; i++)
        assert_int_equal(out[i], water[i] < 1u << 31 ? water[i] * 9 : 0);
    machine_destroy(s.m);
    free(water);
    free(out);
}

/* ---- contexts that take turns ---- */

enum { TURNED = 4 };

/* Whether the i-th processor is in the k-th context: three colours, and one that is a part of
 * two of them. */
static bool is_turned(int k, int i)
{
    return k < 3 ? (i / COLUMNS + i) % 3 == k : (i / COLUMNS + i) % 3 && i % COLUMNS < 33;
}

static void contexts_make(struct sheet *s, uint32_t contexts[TURNED])
{
    uint8_t *bits = malloc(COUNT);
    assert_non_null(bits);
    for (int k = 0; k < TURNED; k++) {
        for (int i = 0; i < COUNT; i++)
            bits[i] = is_turned(k, i);
        contexts[k] =
            machine_field_allocate(s->m, machine_vpset_current(s->m), 1, MACHINE_HEAP);
        assert_ok(machine_field_upload(s->m, contexts[k], MACHINE_BIT, bits), s->m);
    }
    free(bits);
}

/* Where both hold. */
static void context_load(struct sheet *s, uint32_t context, uint32_t other)
{
    machine_begin(s->m);
    struct machine_value *c = support_value(s->m, context, MACHINE_BIT);
    if (other != context)
        c = machine_binary(s->m, MACHINE_AND, c, support_value(s->m, other, MACHINE_BIT));
    assert_ok(machine_flag_store(s->m, MACHINE_CONTEXT, c, MACHINE_EVERYWHERE), s->m);
    machine_begin(s->m);
}

/* Nobody sees what a colour stored a turn ago: it is let go of, though other colours have
 * stored since. */
static void stores_of_contexts_in_turn_do_not_pile_up(void **state)
{
    struct sheet s;
    struct machine_stats early = {0};
    uint32_t contexts[TURNED], *water = malloc(COUNT * sizeof *water),
                               *out = malloc(COUNT * sizeof *out);
    (void)state;
    assert_true(water && out);
    sheet_open(&s, 0);
    contexts_make(&s, contexts);
    look(&s, water);
    for (int n = 0; n < 60; n++) {
        context_load(&s, contexts[n % 3], contexts[n % 3]);
        store(&s, s.flow,
              machine_binary(s.m, MACHINE_MUL, support_value(s.m, s.water, MACHINE_UINT(32)),
                             constant(s.m, (uint64_t)n + 3)));
        if (n == 5)
            early = stats(s.m);
    }
    assert_true(stats(s.m).values_live <= early.values_live + 3);
    assert_ok(machine_field_download(s.m, s.flow, MACHINE_UINT(32), out), s.m);
    for (int i = 0; i < COUNT; i++)
        assert_int_equal(out[i], water[i] * (60u + (uint32_t)(i / COLUMNS + i) % 3));
    machine_destroy(s.m);
    free(water);
    free(out);
}

static int below(uint64_t *chance, uint64_t n)
{
    return (int)(sample_word(chance) % n);
}

/* Steps: the processors of one context, or of two, take what their neighbours hold in some
 * field; sometimes somebody looks. */
static void turns_random(uint64_t chance)
{
    struct sheet s;
    uint32_t contexts[TURNED], fields[3], *held = malloc(3 * COUNT * sizeof *held),
                                          *out = malloc(COUNT * sizeof *out);
    assert_true(held && out);
    sheet_open(&s, 0);
    contexts_make(&s, contexts);
    memcpy(fields, (uint32_t[]){s.water, s.flow, s.scratch}, sizeof fields);
    for (int k = 0; k < 3; k++)
        assert_ok(machine_field_download(s.m, fields[k], MACHINE_UINT(32), held + k * COUNT),
                  s.m);
    for (int n = 0; n < 50; n++) {
        const int c = below(&chance, TURNED),
                  d = below(&chance, 3) ? c : below(&chance, TURNED), to = below(&chance, 3),
                  from = below(&chance, 3), further = below(&chance, 3);
        context_load(&s, contexts[c], contexts[d]);
        struct machine_value *v = support_value(s.m, fields[from], MACHINE_UINT(32));
        store(&s, fields[to],
              machine_binary(s.m, MACHINE_ADD, further ? machine_shift(s.m, v, 0, further) : v,
                             constant(s.m, (uint64_t)n)));
        for (int i = 0; i < COUNT; i++)
            out[i] = held[from * COUNT + (i + further * COLUMNS) % COUNT] + (uint32_t)n;
        for (int i = 0; i < COUNT; i++)
            held[to * COUNT + i] =
                is_turned(c, i) && is_turned(d, i) ? out[i] : held[to * COUNT + i];
        for (int k = 0; k < 3 && (n == 49 || below(&chance, 20) == 0); k++) {
            assert_ok(machine_field_download(s.m, fields[k], MACHINE_UINT(32), out), s.m);
            assert_memory_equal(out, held + k * COUNT, COUNT * sizeof *out);
        }
    }
    machine_destroy(s.m);
    free(held);
    free(out);
}

static int programs = 50;

static void random_turns_of_contexts_come_to_the_same(void **state)
{
    (void)state;
    setenv("LUTETIA_INTERPRET", "2", 1); /* no compiler for each of them */
    for (int seed = 0; seed < programs; seed++)
        turns_random((uint64_t)seed);
    setenv("LUTETIA_INTERPRET", "0", 1);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stores_of_contexts_in_turn_do_not_pile_up),
        cmocka_unit_test(random_turns_of_contexts_come_to_the_same),
        cmocka_unit_test(value_outlives_the_content_it_is_a_part_of),
        cmocka_unit_test(neighbours_read_a_number_before_it_is_made_longer),
        cmocka_unit_test(unobserved_values_are_never_computed),
        cmocka_unit_test(repeated_step_builds_nothing_new),
        cmocka_unit_test(unobserved_steps_stay_bounded),
        cmocka_unit_test(temporaries_rewritten_do_not_grow_the_graph),
        cmocka_unit_test(fields_allocated_each_step_do_not_leak),
        cmocka_unit_test(when_it_is_observed_makes_no_difference),
        cmocka_unit_test(finish_leaves_nothing_to_compute),
    };

    if (argc > 1) /* so many random programs */
        programs = atoi(argv[1]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
