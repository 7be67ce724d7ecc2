/* page.c - the page around the thesis's listings, in C/Paris calls only. */
#include "page.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "oracle.h"

float gravity = 0.75f;
float molecular_weight[3] = {0.9f, 0.55f, 0.3f};
int s = 23, e = 8;
int Y = 0, X = 1;
int i;

enum { COORDINATE_BITS = 16 };

CM_field_id_t page_field(const struct FiberStruct *page, enum page_field which)
{
    switch (which) {
    case PAGE_WATER:
        return page->water;
    case PAGE_ABSORBENCY:
        return page->absorbency;
    case PAGE_CYAN:
        return page->cyan;
    case PAGE_MAGENTA:
        return page->magenta;
    case PAGE_YELLOW:
        return page->yellow;
    case PAGE_TEMP1:
        return page->temp1;
    case PAGE_TEMP2:
        return page->temp2;
    case PAGE_INWARD:
        return page->inward;
    case PAGE_OUTWARD:
        return page->outward;
    case PAGE_INFLOW:
        return page->inflow;
    case PAGE_OUTFLOW:
        return page->outflow;
    case PAGE_IMAGE:
        return page->image_field;
    case PAGE_CONTEXT:
        return page->context;
    case PAGE_OLD_CONTEXT:
        return page->old_context_store;
    case PAGE_SEEN_CONTEXT:
        return page->seen_context;
    case PAGE_SEEN_TEST:
        return page->seen_test;
    case PAGE_SEEN_OVERFLOW:
        return page->seen_overflow;
    case PAGE_FIELD_COUNT:
        break;
    }
    abort();
}

int page_field_bits(enum page_field which)
{
    return which < PAGE_FLOAT_COUNT ? 32 : which == PAGE_IMAGE ? 24 : 1;
}

void page_create(struct FiberStruct *page, int width, int height)
{
    unsigned int dimensions[2] = {(unsigned int)height, (unsigned int)width};
    CM_field_id_t *const floats[] = {&page->water,   &page->absorbency, &page->cyan,
                                     &page->magenta, &page->yellow,     &page->temp1,
                                     &page->temp2,   &page->inward,     &page->outward,
                                     &page->inflow,  &page->outflow};
    CM_field_id_t *const flags[] = {&page->context, &page->old_context_store,
                                    &page->seen_context, &page->seen_test,
                                    &page->seen_overflow};

    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    page->width = width;
    page->height = height;
    page->s = s;
    page->e = e;
    page->bits_per_pixel = 3 * CHANNEL_SIZE;
    for (size_t n = 0; n < sizeof floats / sizeof floats[0]; n++)
        *floats[n] = CM_allocate_heap_field((unsigned int)(s + e + 1));
    for (size_t n = 0; n < sizeof flags / sizeof flags[0]; n++)
        *flags[n] = CM_allocate_heap_field(1);
    page->image_field = CM_allocate_heap_field((unsigned int)page->bits_per_pixel);
    page->image_red = page->image_field;
    page->x_coordinate = CM_allocate_heap_field(COORDINATE_BITS);
    page->y_coordinate = CM_allocate_heap_field(COORDINATE_BITS);
    CM_my_news_coordinate_1L(page->x_coordinate, (unsigned int)X, COORDINATE_BITS);
    CM_my_news_coordinate_1L(page->y_coordinate, (unsigned int)Y, COORDINATE_BITS);
}

void page_destroy(struct FiberStruct *page)
{
    for (int which = 0; which < PAGE_FIELD_COUNT; which++)
        CM_deallocate_heap_field(page_field(page, (enum page_field)which));
    CM_deallocate_heap_field(page->x_coordinate);
    CM_deallocate_heap_field(page->y_coordinate);
}

static void page_transfer(struct FiberStruct *page, enum page_field which, unsigned int *words,
                          int write)
{
    int offset[2] = {0, 0};
    unsigned int start[2] = {0, 0};
    unsigned int end[2] = {(unsigned int)page->height, (unsigned int)page->width};
    unsigned int axes[2] = {0, 1};
    unsigned int dimensions[2] = {(unsigned int)page->height, (unsigned int)page->width};
    CM_field_id_t field = page_field(page, which);
    unsigned int bits = (unsigned int)page_field_bits(which);

    if (write)
        CM_u_write_to_news_array_1L(words, offset, start, end, axes, field, bits, 2, dimensions,
                                    CM_32_bit);
    else
        CM_u_read_from_news_array_1L(words, offset, start, end, axes, field, bits, 2,
                                     dimensions, CM_32_bit);
}

void page_write(struct FiberStruct *page, enum page_field which, const unsigned int *words)
{
    size_t bytes = sizeof *words * (size_t)page->width * (size_t)page->height;
    unsigned int *copy = malloc(bytes);

    if (!copy)
        abort();
    for (size_t n = 0; n < bytes / sizeof *words; n++)
        copy[n] = words[n];
    page_transfer(page, which, copy, 1);
    free(copy);
}

void page_read(struct FiberStruct *page, enum page_field which, unsigned int *words)
{
    page_transfer(page, which, words, 0);
}

void page_look_at_flags(struct FiberStruct *page)
{
    CM_store_context(page->seen_context);
    CM_store_test_always(page->seen_test);
    CM_store_overflow_always(page->seen_overflow);
}

void page_compare(struct FiberStruct *page, const struct oracle *o, int step)
{
    static const char *const names[PAGE_FIELD_COUNT] = {
        "water",     "absorbency",   "cyan",    "magenta",           "yellow",
        "temp1",     "temp2",        "inward",  "outward",           "inflow",
        "outflow",   "image",        "context", "old_context_store", "context flag",
        "test flag", "overflow flag"};
    int count = o->width * o->height;
    unsigned int *words = malloc((size_t)count * sizeof *words);

    assert_non_null(words);
    page_look_at_flags(page);
    for (int which = 0; which < PAGE_FIELD_COUNT; which++) {
        page_read(page, (enum page_field)which, words);
        for (int n = 0; n < count; n++)
            if (words[n] != oracle_word(o, which, n))
                fail_msg(
                    "%s at row %d column %d of %dx%d after step %d: %08x, the oracle has %08x",
                    names[which], n / o->width, n % o->width, o->width, o->height, step,
                    words[n], oracle_word(o, which, n));
    }
    free(words);
}

int Turn_on_context(struct FiberStruct *Page, CM_field_id_t saved, int x1, int y1, int x2,
                    int y2)
{
    CM_store_context(saved);
    CM_s_ge_constant_1L(Page->x_coordinate, x1, COORDINATE_BITS);
    CM_logand_context_with_test();
    CM_s_le_constant_1L(Page->x_coordinate, x2, COORDINATE_BITS);
    CM_logand_context_with_test();
    CM_s_ge_constant_1L(Page->y_coordinate, y1, COORDINATE_BITS);
    CM_logand_context_with_test();
    CM_s_le_constant_1L(Page->y_coordinate, y2, COORDINATE_BITS);
    CM_logand_context_with_test();
    return 0;
}
