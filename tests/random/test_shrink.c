/* test_shrink.c - the detector and the shrinker, without a device: the oracle against an oracle
 * with a deliberate fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "program.h"

static bool oracles_differ(void *context, const struct program *p)
{
    struct trace right = {0}, wrong = {0};
    size_t where;
    bool result;

    oracle_run(p, &right, SABOTAGE_NONE);
    oracle_run(p, &wrong, *(enum sabotage *)context);
    result = trace_differ(&right, &wrong, &where);
    trace_finish(&right);
    trace_finish(&wrong);
    return result;
}

/* Finds a program that shows the fault, shrinks it, and returns its length. */
static int shrunk_length(enum sabotage sabotage, struct program *p)
{
    for (uint64_t seed = 1; seed < 400; seed++) {
        program_generate(p, seed, 60);
        program_normalise(p);
        if (!oracles_differ(&sabotage, p))
            continue;
        program_shrink(p, oracles_differ, &sabotage);
        assert_true(oracles_differ(&sabotage, p));
        return p->count;
    }
    fail_msg("no program found sabotage %d", sabotage);
    return 0;
}

static bool has_row(const struct program *p, enum op op)
{
    for (int n = 0; n < p->count; n++)
        if (row_table[p->code[n].row].op == op)
            return true;
    return false;
}

static void shrink_finds_wrong_subtraction(void **state)
{
    struct program p;

    (void)state;
    assert_in_range(shrunk_length(SABOTAGE_SUBTRACT, &p), 1, 3); /* a field, the subtraction */
    assert_true(has_row(&p, OP_SUBTRACT));
}

static void shrink_finds_wrong_context(void **state)
{
    struct program p;

    (void)state;
    assert_in_range(shrunk_length(SABOTAGE_CONTEXT, &p), 1, 3); /* a field of zeros, the load */
    assert_true(has_row(&p, OP_LOAD_CONTEXT));
}

static void shrink_finds_wrong_neighbour(void **state)
{
    struct program p;

    (void)state;
    assert_in_range(shrunk_length(SABOTAGE_NEWS, &p), 1, 5);
    assert_true(has_row(&p, OP_GET_NEWS) || has_row(&p, OP_SEND_NEWS));
}

static void generate_is_a_function_of_the_seed(void **state)
{
    struct program *p = calloc(2, sizeof *p);
    struct trace a = {0}, b = {0};
    size_t where;

    (void)state;
    assert_non_null(p);
    for (uint64_t seed = 1; seed < 50; seed++) {
        program_generate(&p[0], seed, 60);
        program_generate(&p[1], seed, 60);
        assert_memory_equal(&p[0], &p[1], sizeof *p);
        program_normalise(&p[0]);
        p[1] = p[0];
        program_normalise(&p[1]);
        assert_int_equal(p[0].count, p[1].count); /* normalising twice changes nothing */
        oracle_run(&p[0], &a, SABOTAGE_NONE);
        oracle_run(&p[1], &b, SABOTAGE_NONE);
        assert_false(trace_differ(&a, &b, &where));
        trace_finish(&a);
        trace_finish(&b);
    }
    free(p);
}

/* Most drawn instructions survive normalising, and every row of the table is drawn. */
static void generate_reaches_every_row(void **state)
{
    static unsigned int seen[ROW_COUNT];
    struct program p;
    int kept = 0, drawn = 0;

    (void)state;
    for (uint64_t seed = 1; seed < 1500; seed++) {
        program_generate(&p, seed, 60);
        drawn += p.count;
        program_normalise(&p);
        kept += p.count;
        for (int n = 0; n < p.count; n++)
            seen[p.code[n].row]++;
    }
    assert_true(kept * 3 > drawn * 2);
    for (int row = 0; row < ROW_COUNT; row++)
        if (!seen[row])
            fail_msg("%s never occurs", row_table[row].name);
}

static void print_is_complete_c(void **state)
{
    struct program p;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);

    (void)state;
    assert_non_null(out);
    program_generate(&p, 7, 60);
    program_normalise(&p);
    program_print(&p, out);
    fclose(out);
    assert_non_null(strstr(text, "int main (void)"));
    for (int n = 0; n < p.count; n++)
        if (row_table[p.code[n].row].shape >= INT_1)
            assert_non_null(strstr(text, row_table[p.code[n].row].name));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shrink_finds_wrong_subtraction),
        cmocka_unit_test(shrink_finds_wrong_context),
        cmocka_unit_test(shrink_finds_wrong_neighbour),
        cmocka_unit_test(generate_is_a_function_of_the_seed),
        cmocka_unit_test(generate_reaches_every_row),
        cmocka_unit_test(print_is_complete_c),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
