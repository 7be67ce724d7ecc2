/* test_memory.c - what brushes keep of each fiber on the front end, beside what is told:
 * blocks are counted where the program asks for them (meson.build wraps malloc() and its
 * like). */
#include <brush.h>
#include <paper.h>

#include "sheet_calls.h"
#include "sheets.h"

#include <malloc.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* Smaller blocks are not counted: no arrays of the large sheet's fibers. */
enum { LARGE_BYTES = 48 << 10, WIDTH = 256, HEIGHT = 128, FIBERS = WIDTH * HEIGHT };

static _Atomic size_t held, held_most;

void *__real_malloc(size_t bytes);
void *__real_calloc(size_t count, size_t bytes);
void *__real_realloc(void *block, size_t bytes);
void __real_free(void *block);
void *__wrap_malloc(size_t bytes);
void *__wrap_calloc(size_t count, size_t bytes);
void *__wrap_realloc(void *block, size_t bytes);
void __wrap_free(void *block);

static void *counted(void *block)
{
    const size_t bytes = block ? malloc_usable_size(block) : 0;
    if (bytes < LARGE_BYTES)
        return block;
    const size_t now = atomic_fetch_add(&held, bytes) + bytes;
    size_t most = held_most;
    while (now > most && !atomic_compare_exchange_weak(&held_most, &most, now))
        ;
    return block;
}

static void *uncounted(void *block)
{
    const size_t bytes = block ? malloc_usable_size(block) : 0;
    if (bytes >= LARGE_BYTES)
        atomic_fetch_sub(&held, bytes);
    return block;
}

void *__wrap_malloc(size_t bytes)
{
    return counted(__real_malloc(bytes));
}

void *__wrap_calloc(size_t count, size_t bytes)
{
    return counted(__real_calloc(count, bytes));
}

void *__wrap_realloc(void *block, size_t bytes)
{
    void *moved = __real_realloc(uncounted(block), bytes);
    return counted(moved || bytes == 0 ? moved : block);
}

void __wrap_free(void *block)
{
    __real_free(uncounted(block));
}

static struct paper_sheet *sheet_make(int width, int height)
{
    struct paper_sheet_config config =
        sheet_of_curtis(width, height, "burnt umber", "phthalo green");
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    return sheet;
}

static void dry_stroke(struct paper_sheet *sheet)
{
    const struct paper_stroke_sample line[2] = {
        {.x = 16, .y = 24, .pressure = 0.6}, {.time_s = 0.05, .x = 40, .y = 24, .pressure = 1}};
    struct paper_brush brush = paper_brush_default();
    check(paper_sheet_brush(sheet, &brush));
    check(paper_sheet_dip(
        sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.5, 0.5}}));
    check(paper_sheet_stroke(
        sheet, &(struct paper_stroke){.pace = 0, .samples_count = 2, .samples = line}, NULL));
}

/* Bytes that brushes keep on the front end; *making: the most while the tooth is made. */
static double brushes_keep(int width, int height, double *making)
{
    struct paper_sheet *sheet = sheet_make(width, height);
    const size_t before = held;
    held_most = before;
    dry_stroke(sheet);
    const double kept = (double)held - (double)before;
    *making = (double)held_most - (double)before;
    paper_sheet_destroy(sheet);
    return kept;
}

/* Two sheets are compared, so that what does not grow with a sheet falls out. */
static void brushes_keep_what_is_told(void **state)
{
    (void)state;
    double making[2];
    const double small = brushes_keep(64, 48, &making[0]),
                 large = brushes_keep(WIDTH, HEIGHT, &making[1]),
                 of_fiber = (large - small) / FIBERS, most = (making[1] - making[0]) / FIBERS;
    print_message("brushes keep %.2f bytes of each fiber, told are %d; while the tooth is made "
                  "they take %.1f\n",
                  of_fiber, PAPER_BRUSHES_BYTES, most);
    assert_true(fabs(of_fiber - PAPER_BRUSHES_BYTES) < 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(brushes_keep_what_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
