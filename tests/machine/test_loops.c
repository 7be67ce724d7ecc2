/* test_loops.c - that byte code has loops: a missing one is right, too, but takes ten to thirty
 * times as long. test_interpret.c tests what loops compute. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "base/node_ops.h"
#include "interpret/lanes.h"
#include "tables.h"

/* What is no operation on lanes (blocks.c reads or moves it), what is performed lane by lane
 * because a call of a library takes longer than the loop, and what is rare. A row whose
 * operation has a loop is wrong, too. */
static const char *const without_loops[] = {
    "unpack", "slice",   "shift",  "send_address", "reinterpret", "random", "pack",   "index",
    "gather", "extract", "cross",  "coordinate",   "constant",    "concat", "buffer", "FTANH",
    "FTAN",   "FSINH",   "FSIN",   "FPOW",         "FLOG2",       "FLOG10", "FLN",    "FEXP",
    "FCOSH",  "FCOS",    "FATANH", "FATAN2",       "FATAN",       "FASINH", "FASIN",  "FACOSH",
    "FACOS",  "FREM",    "FMOD",   "UPOW_BEYOND",  "SPOW_BEYOND", "FSCALE"};

static bool loops_has(const struct lanes_table *t, int op)
{
    for (int c = 0; c < LANES_CLASSES; c++) {
        if (t->of[op][c])
            return true;
        for (int to = 0; to < LANES_CLASSES; to++)
            if (t->convert[op][c][to])
                return true;
    }
    return false;
}

static void each_operation_has_a_loop_or_is_named(void **state)
{
    const struct tables t = tables_here();
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++) {
        bool named = false;
        for (size_t i = 0; i < sizeof without_loops / sizeof *without_loops; i++)
            named = named || !strcmp(without_loops[i], node_ops[op].name);
        for (int k = 0; k < t.count; k++)
            if (loops_has(t.of[k], op) == named)
                fail_msg("table %d: %s %s a loop", k, node_ops[op].name,
                         named ? "is named here, but has" : "has not");
    }
}

/* All conversions have, but those of integers of more than 64 bits to floats. */
static void each_conversion_has_a_loop(void **state)
{
    static const struct {
        int op;
        bool from_float, to_float;
    } conversions[] = {
        {NODE_ZERO_EXTEND, false, false}, {NODE_U_TO_F, false, true},
        {NODE_S_TO_F, false, true},       {NODE_F_TO_U, true, false},
        {NODE_F_TO_S, true, false},       {NODE_F_TO_F, true, true},
    };
    const struct tables t = tables_here();
    (void)state;
    for (size_t i = 0; i < sizeof conversions / sizeof *conversions; i++)
        for (int from = 0; from < LANES_CLASSES; from++)
            for (int to = 0; to < LANES_CLASSES; to++) {
                if ((from >= LANES_INTEGERS) != conversions[i].from_float ||
                    (to >= LANES_INTEGERS) != conversions[i].to_float)
                    continue;
                const bool wide_to_float = !conversions[i].from_float &&
                                           conversions[i].to_float &&
                                           lanes_bytes((enum lanes_class)from) > 8;
                for (int k = 0; k < t.count; k++)
                    if (!t.of[k]->convert[conversions[i].op][from][to] != wide_to_float)
                        fail_msg("table %d: %s from class %d to class %d", k,
                                 node_ops[conversions[i].op].name, from, to);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_operation_has_a_loop_or_is_named),
        cmocka_unit_test(each_conversion_has_a_loop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
