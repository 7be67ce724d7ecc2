/* Compares the cost model with measurements. The plan that it prefers takes hardly longer than
 * the alternatives, and predicted times are within a factor of measured ones. Times are
 * processor time, the least of several rounds, because other programs may be running. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "model.h"

static const int SIDE = 1024, ROUNDS = 9;
static const double DEARER_MOST = 1.4, WRONG_MOST = 4;

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

static void what_is_chosen_is_fast(void **state)
{
    (void)state;
    for (int p = 0; p < model_programs_count(); p++) {
        struct model_result r[MODEL_FORMS];
        if (!model_measure(p, SIDE, SIDE, ROUNDS, r))
            fail_msg("%s: %s", model_program_name(p), bench_error());
        /* The chosen form was measured twice. */
        const bool in_strips = r[MODEL_CHOSEN].in_strips;
        const double rows = r[MODEL_ROWS].processor.min, strips = r[MODEL_STRIPS].processor.min,
                     chosen = lesser(r[MODEL_CHOSEN].processor.min, in_strips ? strips : rows),
                     predicted = r[MODEL_CHOSEN].predicted;
        printf("%-8s rows %.3f (%.3f), strips %.3f (%.3f), chosen %.3f (%.3f) ns%s\n",
               model_program_name(p), rows, r[MODEL_ROWS].predicted, strips,
               r[MODEL_STRIPS].predicted, chosen, predicted, in_strips ? ", in strips" : "");
        assert_false(r[MODEL_ROWS].in_strips);
        assert_true(chosen < DEARER_MOST * lesser(rows, strips));
        assert_true(predicted < WRONG_MOST * chosen && chosen < WRONG_MOST * predicted);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_chosen_is_fast)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
