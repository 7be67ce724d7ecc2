/* apply.c - putting water and pigment on the sheet: through a rectangle, and through a
 * screen. */
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
    CM_f_min_constant_2_1L(field, 1.0, KIT_F);
    CM_f_max_constant_2_1L(field, 0.0, KIT_F);
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
    kit_grid_narrow(&p->grid, clip(x, p->grid.width), clip(y, p->grid.height),
                    clip((int64_t)x + width, p->grid.width),
                    clip((int64_t)y + height, p->grid.height));
    for (int i = 0; i < 4; i++) {
        if (substance_amount(ink, i) == 0)
            continue;
        CM_f_add_constant_2_1L(substance_field(p, i), substance_amount(ink, i), KIT_F);
        substance_limit(substance_field(p, i));
    }
    kit_grid_widen(&p->grid);
    return paper_leave(p);
}

/* A sheet-sized copy of the screen, so that it goes to the machine as one array. NULL: no
 * memory. */
static uint8_t *screen_on_sheet(const struct paper *p, const struct paper_screen *screen, int x,
                                int y)
{
    uint8_t *sheet = calloc((size_t)p->grid.height, (size_t)p->grid.width);
    if (!sheet)
        return NULL;
    int x1 = clip(x, p->grid.width), x2 = clip((int64_t)x + screen->width_px, p->grid.width);
    int y1 = clip(y, p->grid.height), y2 = clip((int64_t)y + screen->height_px, p->grid.height);
    for (int row = y1; row < y2 && x1 < x2; row++)
        memcpy(sheet + (size_t)row * (size_t)p->grid.width + x1,
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
        return paper_fail(PAPER_NO_MEMORY, "no memory for a screen of %dx%d", p->grid.width,
                          p->grid.height);

    paper_enter(p);
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {KIT_AXIS_Y, KIT_AXIS_X};
    int size[2] = {p->grid.height, p->grid.width};
    CM_field_id_t shade =
        p->image; /* its red channel: the picture is made anew when it is looked at */
    CM_field_id_t part = p->inflow, amount = p->inward;
    CM_set_context();
    CM_u_write_to_news_array_1L(gray, offset, start, size, axes, shade, PAPER_CHANNEL_BITS, 2,
                                size, CM_8_bit);
    kit_grid_narrow(&p->grid, clip(x, p->grid.width), clip(y, p->grid.height),
                    clip((int64_t)x + screen->width_px, p->grid.width),
                    clip((int64_t)y + screen->height_px, p->grid.height));
    CM_f_u_float_2_2L(part, shade, PAPER_CHANNEL_BITS, KIT_F);
    CM_f_divide_constant_2_1L(part, 255.0, KIT_F);
    for (int i = 0; i < 4; i++) {
        if (substance_amount(ink, i) == 0)
            continue;
        CM_f_multiply_constant_3_1L(amount, part, substance_amount(ink, i), KIT_F);
        CM_f_add_2_1L(substance_field(p, i), amount, KIT_F);
        substance_limit(substance_field(p, i));
    }
    /* On the rim temporaries stay zero: the flow reads them there. */
    CM_f_move_zero_1L(part, KIT_F);
    CM_f_move_zero_1L(amount, KIT_F);
    kit_grid_widen(&p->grid);
    free(gray);
    return paper_leave(p);
}
