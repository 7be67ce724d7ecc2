/* apply.c - putting water and pigment on the sheet: through a rectangle, and through a screen. */
#include "base/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static enum paper_status ink_check(const struct paper_ink *ink)
{
    const double amounts[4] = {ink->cyan, ink->magenta, ink->yellow, ink->water};
    for (int i = 0; i < 4; i++)
        if (!(fabs(amounts[i]) <= 1))
            return paper_fail(
                PAPER_BAD_ARGUMENT,
                "cyan, magenta, yellow and water must be -1..1 (got %g, %g, %g, %g)", ink->cyan,
                ink->magenta, ink->yellow, ink->water);
    return PAPER_OK;
}

/* The field and the amount of each of the four substances in turn. */
static CM_field_id_t substance_field(const struct paper *p, int i)
{
    return i < 3 ? p->pigment[i] : p->water;
}

static double substance_amount(const struct paper_ink *ink, int i)
{
    const double amounts[4] = {ink->cyan, ink->magenta, ink->yellow, ink->water};
    return amounts[i];
}

static void substance_limit(CM_field_id_t field)
{
    CM_f_min_constant_2_1L(field, 1.0, PAPER_S, PAPER_E);
    CM_f_max_constant_2_1L(field, 0.0, PAPER_S, PAPER_E);
}

/* Where x begins and ends on the sheet; places far off would overflow an int. */
static int clip(int64_t at, int length)
{
    return at < 0 ? 0 : at > length ? length : (int)at;
}

enum paper_status paper_rectangle(struct paper *p, int x, int y, int width, int height,
                                  const struct paper_ink *ink)
{
    enum paper_status status = ink_check(ink);
    if (status != PAPER_OK)
        return status;
    paper_enter(p);
    CM_set_context();
    paper_context_rectangle(p, clip(x, p->width), clip(y, p->height),
                            clip((int64_t)x + width, p->width),
                            clip((int64_t)y + height, p->height));
    for (int i = 0; i < 4; i++) {
        if (substance_amount(ink, i) == 0)
            continue;
        CM_f_add_constant_2_1L(substance_field(p, i), substance_amount(ink, i), PAPER_S,
                               PAPER_E);
        substance_limit(substance_field(p, i));
    }
    paper_context_restore(p);
    return paper_leave(p);
}

/* A sheet-sized copy of the screen, so that it goes to the machine as one array. NULL: no memory. */
static uint8_t *screen_on_sheet(const struct paper *p, const struct paper_screen *screen, int x,
                                int y)
{
    uint8_t *sheet = calloc((size_t)p->height, (size_t)p->width);
    if (!sheet)
        return NULL;
    int x1 = clip(x, p->width), x2 = clip((int64_t)x + screen->width_px, p->width);
    int y1 = clip(y, p->height), y2 = clip((int64_t)y + screen->height_px, p->height);
    for (int row = y1; row < y2 && x1 < x2; row++)
        memcpy(sheet + (size_t)row * (size_t)p->width + x1,
               screen->gray + (size_t)(row - y) * (size_t)screen->width_px + (x1 - x),
               (size_t)(x2 - x1));
    return sheet;
}

enum paper_status paper_screen_ink(struct paper *p, const struct paper_screen *screen, int x,
                                   int y, const struct paper_ink *ink)
{
    enum paper_status status = ink_check(ink);
    if (status != PAPER_OK)
        return status;
    if (!screen->gray || screen->width_px < 1 || screen->height_px < 1)
        return paper_fail(PAPER_BAD_ARGUMENT, "the screen is empty");
    uint8_t *gray = screen_on_sheet(p, screen, x, y);
    if (!gray)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a screen of %dx%d", p->width,
                          p->height);

    paper_enter(p);
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X};
    int size[2] = {p->height, p->width};
    CM_field_id_t shade =
        p->image; /* its red channel: the picture is made anew when it is looked at */
    CM_field_id_t part = p->inflow, amount = p->inward;
    CM_set_context();
    CM_u_write_to_news_array_1L(gray, offset, start, size, axes, shade, PAPER_CHANNEL_BITS, 2,
                                size, CM_8_bit);
    paper_context_rectangle(p, clip(x, p->width), clip(y, p->height),
                            clip((int64_t)x + screen->width_px, p->width),
                            clip((int64_t)y + screen->height_px, p->height));
    CM_f_u_float_2_2L(part, shade, PAPER_CHANNEL_BITS, PAPER_S, PAPER_E);
    CM_f_divide_constant_2_1L(part, 255.0, PAPER_S, PAPER_E);
    for (int i = 0; i < 4; i++) {
        if (substance_amount(ink, i) == 0)
            continue;
        CM_f_multiply_constant_3_1L(amount, part, substance_amount(ink, i), PAPER_S, PAPER_E);
        CM_f_add_2_1L(substance_field(p, i), amount, PAPER_S, PAPER_E);
        substance_limit(substance_field(p, i));
    }
    /* On the rim temporaries stay zero: the flow reads them there. */
    CM_f_move_zero_1L(part, PAPER_S, PAPER_E);
    CM_f_move_zero_1L(amount, PAPER_S, PAPER_E);
    paper_context_restore(p);
    free(gray);
    return paper_leave(p);
}
