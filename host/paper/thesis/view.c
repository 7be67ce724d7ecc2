/* view.c - looking at the sheet: the machine makes the picture, the front end reads it. */
#include "base/page.h"

#include <stdlib.h>

/* image's channel = value (0..1) rounded to 0..255; value is used up. */
static void channel_set(struct paper *p, int channel, CM_field_id_t value)
{
    CM_f_max_constant_2_1L(value, 0.0, KIT_F);
    CM_f_min_constant_2_1L(value, 1.0, KIT_F);
    CM_f_multiply_constant_2_1L(value, 255.0, KIT_F);
    CM_u_f_round_2_2L(CM_add_offset_to_field_id(p->image, channel * PAPER_CHANNEL_BITS), value,
                      PAPER_CHANNEL_BITS, KIT_F);
}

static void image_color(struct paper *p)
{
    for (int channel = 0; channel < 3; channel++) {
        CM_f_u_float_2_2L(
            p->scratch, CM_add_offset_to_field_id(p->fiber_color, channel * PAPER_CHANNEL_BITS),
            PAPER_CHANNEL_BITS, KIT_F);
        CM_f_divide_constant_2_1L(p->scratch, 255.0, KIT_F);
        CM_f_subtract_2_1L(p->scratch, p->pigment[channel], KIT_F);
        channel_set(p, channel, p->scratch);
    }
}

static void image_water(struct paper *p)
{
    for (int channel = 0; channel < 3; channel++) {
        CM_f_move_1L(p->scratch, p->water, KIT_F);
        channel_set(p, channel, p->scratch);
    }
}

enum paper_status paper_view_read(struct paper *p, enum paper_view view, uint8_t *rgb)
{
    size_t count = (size_t)p->grid.width * (size_t)p->grid.height;
    uint32_t *pixels = malloc(count * sizeof *pixels);
    if (!pixels)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", p->grid.width,
                          p->grid.height);
    paper_enter(p);
    CM_set_context();
    if (view == PAPER_VIEW_WATER)
        image_water(p);
    else
        image_color(p);
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {KIT_AXIS_Y, KIT_AXIS_X};
    int size[2] = {p->grid.height, p->grid.width};
    CM_u_read_from_news_array_1L(pixels, offset, start, size, axes, p->image, PAPER_IMAGE_BITS,
                                 2, size, CM_32_bit);
    enum paper_status status = paper_leave(p);
    if (status == PAPER_OK)
        for (size_t i = 0; i < count; i++)
            for (int channel = 0; channel < 3; channel++)
                rgb[3 * i + (size_t)channel] =
                    (uint8_t)(pixels[i] >> channel * PAPER_CHANNEL_BITS);
    free(pixels);
    return status;
}

enum paper_status paper_total(struct paper *p, enum paper_amount amount, double *total)
{
    CM_field_id_t field = amount == PAPER_WATER ? p->water : p->pigment[amount - PAPER_CYAN];
    paper_enter(p);
    CM_set_context();
    *total = CM_global_f_add_1L(field, KIT_F);
    return paper_leave(p);
}
