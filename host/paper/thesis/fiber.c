/* fiber.c - what a dry sheet is like: each fiber's absorbency and colour, from the seed.
 *
 * Both come from one noise, so that paper looks as it behaves: where fibers lie thick it is a
 * little darker and takes water better.  The noise is made as paper is, of fibers laid in both
 * directions: a random number at each pixel, averaged along x with its neighbours at 1, 2, 4,
 * ... (a box as long as the fibers), another likewise along y, and a third left as it is: the
 * grain.  The sheet is a torus to it.
 *
 *     noise = amount * (along x + along y + grain / 2), mean 0, deviation about 1
 */
#include "base/page.h"

#include <math.h>

enum { RANDOM_BITS = 16 };

/* The least absorbent fiber, beside the mean one. */
#define FIBER_LEAST 0.15

/* dest = a number in -1/2..1/2 at each fiber, another at each call. */
static void noise_white(CM_field_id_t dest, CM_field_id_t bits)
{
    CM_u_random_1L(bits, RANDOM_BITS, 1ul << RANDOM_BITS);
    CM_f_u_float_2_2L(dest, bits, RANDOM_BITS, KIT_F);
    CM_f_multiply_constant_2_1L(dest, 1.0 / (1 << RANDOM_BITS), KIT_F);
    CM_f_subtract_constant_2_1L(dest, 0.5, KIT_F);
}

/* Averages over `length` (a power of two) neighbours along the axis, and brings the deviation
 * back to what it was.  Copying over distance d takes d NEWS steps. */
static void noise_smear(CM_field_id_t field, CM_field_id_t neighbour, unsigned axis, int length)
{
    for (int distance = 1; distance < length; distance *= 2) {
        CM_get_from_news_1L(neighbour, field, axis, CM_upward, KIT_FLOAT_BITS);
        for (int step = 1; step < distance; step++)
            CM_get_from_news_1L(neighbour, neighbour, axis, CM_upward, KIT_FLOAT_BITS);
        CM_f_add_2_1L(field, neighbour, KIT_F);
        CM_f_multiply_constant_2_1L(field, sqrt(0.5), KIT_F);
    }
}

/* One channel of fiber_color = 255 * color * (1 + lightness), cut off to 0..255; lightness is
 * in `noise`. */
static void color_channel(struct paper *p, int channel, double color, CM_field_id_t noise,
                          CM_field_id_t temporary)
{
    CM_f_multiply_constant_3_1L(temporary, noise, 255 * color, KIT_F);
    CM_f_add_constant_2_1L(temporary, 255 * color, KIT_F);
    CM_f_max_constant_2_1L(temporary, 0.0, KIT_F);
    CM_f_min_constant_2_1L(temporary, 255.0, KIT_F);
    CM_u_f_round_2_2L(CM_add_offset_to_field_id(p->fiber_color, channel * PAPER_CHANNEL_BITS),
                      temporary, PAPER_CHANNEL_BITS, KIT_F);
}

void paper_fibers_make(struct paper *p, const struct paper_config *config)
{
    /* The deviation of a uniform number on -1/2..1/2 is 1/sqrt(12); three parts add up in
     * squares. */
    double unit = sqrt(12.0) / sqrt(1 + 1 + 0.25);
    CM_field_id_t noise = p->inward, other = p->outward, neighbour = p->inflow;

    CM_set_context();
    CM_initialize_random_generator((unsigned)(config->seed ^ config->seed >> 32));
    noise_white(noise, p->scratch);
    noise_smear(noise, neighbour, KIT_AXIS_X, config->fiber_length);
    noise_white(other, p->scratch);
    noise_smear(other, neighbour, KIT_AXIS_Y, config->fiber_length);
    CM_f_add_2_1L(noise, other, KIT_F);
    noise_white(other, p->scratch);
    CM_f_multiply_constant_2_1L(other, 0.5, KIT_F);
    CM_f_add_2_1L(noise, other, KIT_F);
    CM_f_multiply_constant_2_1L(noise, unit, KIT_F);

    CM_f_multiply_constant_3_1L(p->absorbency, noise,
                                config->absorbency * config->absorbency_variation, KIT_F);
    CM_f_add_constant_2_1L(p->absorbency, config->absorbency, KIT_F);
    /* A fiber that takes nothing would keep its ink as a speck. */
    CM_f_max_constant_2_1L(p->absorbency, config->absorbency * FIBER_LEAST, KIT_F);
    CM_f_min_constant_2_1L(p->absorbency, PAPER_ABSORBENCY_MAX, KIT_F);

    CM_f_multiply_constant_2_1L(noise, -0.05 * config->color_variation, KIT_F);
    for (int channel = 0; channel < 3; channel++)
        color_channel(p, channel, config->color[channel], noise, other);

    /* Fibers on the rim never write their temporaries again, so these are cleared: the noise
     * must not remain in them. */
    CM_f_move_zero_1L(p->inflow, KIT_F);
    CM_f_move_zero_1L(p->inward, KIT_F);
    CM_f_move_zero_1L(p->outward, KIT_F);
    CM_f_move_zero_1L(p->scratch, KIT_F);
}
