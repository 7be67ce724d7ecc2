/* test_dispersion.c - the thesis's dispersion listing, unchanged, gives the oracle's bits.
 *
 * The environment chooses the mode (LUTETIA_EAGER, the device's thread count); meson runs the
 * program in four modes. It compares all fields and flags, temporaries and inactive fibers
 * included.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "oracle.h"
#include "page.h"
#include "paris_internal.h"
#include "sample.h"
#include "variant.h"

enum { STEPS = 200 };

static uint64_t random_state;

static uint32_t random_word(void)
{
    return (uint32_t)(sample_word(&random_state) >> 32);
}

/* A sheet that is wet in places, with pigment in spots. The temporaries hold arbitrary old
 * values. */
static float random_amount(enum page_field which)
{
    float unit = (float)(random_word() >> 8) * 0x1p-24f;

    if (which == PAGE_ABSORBENCY)
        return 0.05f + 0.2f * unit;
    if (which >= PAGE_TEMP1)
        return 4.0f * unit - 2.0f;
    return random_word() % 3 ? unit : 0.0f;
}

static void fill(struct FiberStruct *page, struct oracle *o)
{
    size_t count = (size_t)o->width * (size_t)o->height;
    unsigned int *words = malloc(count * sizeof *words);

    assert_non_null(words);
    for (int which = 0; which < PAGE_FLOAT_COUNT; which++) {
        for (size_t n = 0; n < count; n++)
            o->real[which][n] = random_amount((enum page_field)which);
        memcpy(words, o->real[which], count * sizeof *words);
        page_write(page, (enum page_field)which, words);
    }
    for (size_t n = 0; n < count; n++)
        words[n] = o->test[n] = random_word() & 1;
    page_write(page, PAGE_SEEN_TEST, words);
    CM_load_test(page->seen_test);
    /* the caller's context: a band of fibers and some scattered fibers are off */
    for (size_t n = 0; n < count; n++)
        words[n] = o->context[n] = n % (size_t)o->width / 5 != 3 && random_word() % 16 != 0;
    page_write(page, PAGE_SEEN_CONTEXT, words);
    CM_load_context(page->seen_context);
    free(words);
}

/* Prints the machine's counts to the test's log. */
static void report(void)
{
    struct machine_stats now;

    machine_stats_get(paris_machine(), &now);
    print_message("%llu plans and %llu kernels built so far, %llu kernels run, %.1f s waited\n",
                  (unsigned long long)now.plans_built, (unsigned long long)now.kernels_built,
                  (unsigned long long)now.kernels_run, now.busy_s);
}

/* observed_every 0: at the end only. */
static void disperse(int width, int height, int observed_every)
{
    struct FiberStruct page;
    struct oracle o;

    random_state = (uint64_t)(width * 1000 + height);
    oracle_init(&o, width, height);
    o.gravity = gravity;
    memcpy(o.molecular_weight, molecular_weight, sizeof molecular_weight);
    page_create(&page, width, height);
    fill(&page, &o);
    for (int step = 1; step <= STEPS; step++) {
        variant_step(&page);
        oracle_disperse(&o);
        if (step == STEPS || (observed_every && step % observed_every == 0))
            page_compare(&page, &o, step);
    }
    page_destroy(&page);
    oracle_finish(&o);
    report();
}

static void dispersion_square_sheet_agrees(void **state)
{
    (void)state;
    disperse(256, 256, 0);
}

static void dispersion_odd_sheet_agrees(void **state)
{
    (void)state;
    disperse(131, 97, 0);
}

static void dispersion_observed_every_step_agrees(void **state)
{
    (void)state;
    disperse(131, 97, 1);
}

static void dispersion_observed_every_seventh_step_agrees(void **state)
{
    (void)state;
    disperse(131, 97, 7);
}

/* The argument `few` leaves out the tests that need many kernels. */
int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dispersion_square_sheet_agrees),
        cmocka_unit_test(dispersion_odd_sheet_agrees),
        cmocka_unit_test(dispersion_observed_every_step_agrees),
        cmocka_unit_test(dispersion_observed_every_seventh_step_agrees),
    };

    size_t count = argc > 1 && !strcmp(argv[1], "few") ? 2 : sizeof tests / sizeof *tests;
    CM_init();
    return _cmocka_run_group_tests("dispersion", tests, count, NULL, NULL);
}
