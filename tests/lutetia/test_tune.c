/* test_tune.c - `lutetia tune`: the measured programs give the bits of plain C with all
 * settings; the command's messages. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lutetia.h" /* before cmocka, whose fail() is a macro */

#include <cmocka.h>

#include "child.h"
#include "tune_work.h"

enum { HEIGHT = 40, WIDTH = 2048, COUNT = HEIGHT * WIDTH, RUNS = 3, TURNS = 32 };

/* ---- the stencil, in plain C ---- */

static float wanted[COUNT];

static void spread(float *x, const float *absorbency, const float *wet, int axis)
{
    static float in[COUNT];
    for (int r = 0; r < HEIGHT; r++)
        for (int c = 0; c < WIDTH; c++) {
            int lower = axis ? r * WIDTH + (c + WIDTH - 1) % WIDTH
                             : (r + HEIGHT - 1) % HEIGHT * WIDTH + c;
            int here = r * WIDTH + c;
            in[here] = (x[lower] - x[here]) * absorbency[here];
            if (wet)
                in[here] *= wet[here];
        }
    for (int r = 0; r < HEIGHT; r++)
        for (int c = 0; c < WIDTH; c++) {
            int upper = axis ? r * WIDTH + (c + 1) % WIDTH : (r + 1) % HEIGHT * WIDTH + c;
            int here = r * WIDTH + c;
            float sum = x[here] + in[here] - in[upper];
            sum = sum < 1 ? sum : 1;
            x[here] = sum > 0 ? sum : 0;
        }
}

static int oracle(void **state)
{
    static float water[COUNT], absorbency[COUNT];
    (void)state;
    tune_work_start(water, COUNT, 1);
    tune_work_start(absorbency, COUNT, 2);
    tune_work_start(wanted, COUNT, 3);
    for (int i = 0; i < RUNS * TURNS; i++)
        for (int axis = 0; axis < 2; axis++) {
            spread(water, absorbency, NULL, axis);
            spread(wanted, absorbency, water, axis);
        }
    return setenv("LUTETIA_BOX_AFTER", "0", 1);
}

static void every_knob_gives_the_same_bits(void **state)
{
    static const struct {
        enum machine_knob knob;
        int value;
    } forced[] = {{MACHINE_VECTOR, 16},    {MACHINE_VECTOR, 8},  {MACHINE_VECTOR, 1},
                  {MACHINE_RUN, 48},       {MACHINE_RUN, 1},     {MACHINE_TURNS, 3},
                  {MACHINE_COLUMNS, 96},   {MACHINE_STREAMS, 0}, {MACHINE_STRIPS_EACH, 1},
                  {MACHINE_STRIPS_EACH, 7}};
    static float is[COUNT];

    (void)state;
    for (size_t i = 0; i < sizeof forced / sizeof *forced; i++) {
        struct machine_tuning tuning = machine_tuning_usual();
        tuning.of[forced[i].knob] = forced[i].value;
        struct tune_work *w = tune_work_create(TUNE_STENCIL, HEIGHT, &tuning);
        if (!w)
            fail_msg("%s", tune_work_error());
        assert_int_equal(tune_work_count(w), COUNT);
        for (int run = 0; run < RUNS; run++)
            if (!(tune_work_run(w) > 0))
                fail_msg("%s", tune_work_error());
        assert_true(tune_work_read(w, is));
        for (int n = 0; n < COUNT; n++)
            if (memcmp(&is[n], &wanted[n], sizeof *is))
                fail_msg("%s %d: row %d, column %d: %a instead of %a",
                         machine_knob_name(forced[i].knob), forced[i].value, n / WIDTH,
                         n % WIDTH, is[n], wanted[n]);
        tune_work_destroy(w);
    }
}

/* On any device the measured costs are plausible, and measuring leaves the machine as it
 * was. */
static void costs_are_measured(void **state)
{
    struct machine_config config = machine_config_default();
    struct machine *m;
    double ns[MACHINE_COSTS];
    (void)state;
    config.eager = 0;
    assert_int_equal(machine_create(&config, &m), MACHINE_OK);
    int set = machine_vpset_create(m, (int[]){8, 192}, 2);
    assert_int_equal(machine_vpset_select(m, set), MACHINE_OK);
    struct machine_tuning before = machine_tuning_get(m);
    assert_int_equal(machine_costs_measure(m, ns), MACHINE_OK);
    assert_int_equal(machine_vpset_current(m), set);
    struct machine_tuning after = machine_tuning_get(m);
    assert_memory_equal(&before, &after, sizeof before);
    assert_true(ns[MACHINE_COST_LAUNCH] > 10 && ns[MACHINE_COST_LAUNCH] < 1e7);
    assert_true(ns[MACHINE_COST_OP] > 1e-5 && ns[MACHINE_COST_OP] < 100);
    assert_true(ns[MACHINE_COST_BYTE] > 1e-5 && ns[MACHINE_COST_BYTE] < 100);
    machine_destroy(m);
}

/* ---- the command ---- */

static void fails_with(struct child *child, int status, const char *said)
{
    child_run(child);
    assert_int_equal(child->status, status);
    if (!strstr(child->errors, said) ||
        strchr(child->errors, '\n') != strrchr(child->errors, '\n'))
        fail_msg("\"%s\" instead of \"%s\"", child->errors, said);
}

static void wrong_lines_are_said(void **state)
{
    const char *lutetia = getenv("LUTETIA");
    struct child word = {.arguments = {lutetia, "tune", "faster"}};
    struct child forced = {.arguments = {lutetia, "tune"}, .variables = {"LUTETIA_TURNS=2"}};
    struct child nowhere = {.arguments = {lutetia, "tune", "--dry-run"},
                            .variables = {"LUTETIA_DEVICE=nonsense"}};

    (void)state;
    fails_with(&word, 2, "'faster'");
    fails_with(&forced, 2, "LUTETIA_TURNS");
    fails_with(&nowhere, 1, "nonsense");
}

/* After Ctrl-C no measurement is kept. */
static void an_interrupted_one_keeps_nothing(void **state)
{
    char folder[] = "/tmp/lutetia-tune-XXXXXX", cache[64], command[128];
    (void)state;
    assert_non_null(mkdtemp(folder));
    snprintf(cache, sizeof cache, "XDG_CACHE_HOME=%s", folder);
    struct child child = {.arguments = {getenv("LUTETIA"), "tune"},
                          .variables = {cache},
                          .interrupt_after_ms = 1500};
    fails_with(&child, 130, "interrupted");
    snprintf(command, sizeof command, "ls %s/lutetia | grep -q tuning", folder);
    assert_int_not_equal(system(command), 0);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

/* A run whose first step waits seconds for its kernels, and whose later steps come to take
 * longer: what is said to be left is right from the first time on, and again soon after the
 * pace has changed. */
static void the_time_left_is_by_the_pace_of_late(void **state)
{
    (void)state;
    enum { FIRST = 300, TOTAL = 500 };
    const double begin = 1000, waited = 8, fast = 0.05, slow = 0.2,
                 changed = begin + waited + FIRST * fast;
    struct progress progress = {.total = TOTAL, .began_s = begin};
    int said = 0;
    for (int done = 1; done < TOTAL; done++) {
        const double now = done <= FIRST ? begin + waited + (done - 1) * fast
                                         : changed + (done - FIRST) * slow,
                     left = progress_left(&progress, done, now);
        const bool early = done <= FIRST;
        const double wanted_left = early ? (TOTAL - done) * fast : (TOTAL - done) * slow;
        if (early && now < begin + waited + 1)
            assert_true(left < 0);
        if (left < 0)
            continue;
        said++;
        if ((early || now > changed + 20) && fabs(left - wanted_left) > 0.2 * wanted_left + 0.1)
            fail_msg("after %d steps %g s are left, and %g s were said", done, wanted_left,
                     left);
    }
    assert_true(said > TOTAL - 60);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_knob_gives_the_same_bits),
        cmocka_unit_test(costs_are_measured),
        cmocka_unit_test(wrong_lines_are_said),
        cmocka_unit_test(an_interrupted_one_keeps_nothing),
        cmocka_unit_test(the_time_left_is_by_the_pace_of_late),
    };
    return cmocka_run_group_tests(tests, oracle, NULL);
}
