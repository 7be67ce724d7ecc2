/* view.c - looking at a sheet: its colour by Kubelka-Munk or by the thesis's rule, its water,
 * any layer.
 *
 * The pigments of a fiber are one layer on what they lie on; K and S are the sums over them,
 * times their amounts. With Q = sqrt(K (K + 2 S)) and E = exp(-Q),
 *
 *     D = (K + S) (1 - E^2) + Q (1 + E^2)     R = S (1 - E^2) / D     T = 2 Q E / D
 *     seen = R + T^2 below / (1 - R below)
 *     seen = stained seen + (1 - stained) below             paint on a part of a fiber lies
 *                                                           beside paper
 *
 * which is Kubelka and Munk's R and T (a = 1 + K/S, b S = Q) without a division by S. Q is kept
 * from 0, where 1 - E^2 would lose its digits; that changes R and T by less than 2e-5.
 *
 * Where pigments are known by bands (bands.h), K and S of a band are sums like those of a
 * channel, but for wet paint, which absorbs more; what an even layer throws back is the same in
 * another form,
 *
 *     c = Q coth Q     seen = (S + below (c - K - S)) / (K + S + c - S below)
 *
 * and the colour is the sum over bands. Paint does not lie evenly within a fiber. Its amounts
 * are spread there by a gamma distribution of shape 2, and what passes, exp (-2 Q), is in the
 * mean 1 / (1 + Q)^2. With this instead of E^2
 *
 *     c = Q + 2 / (Q + 2)
 *
 * which is the mean of what is seen where nothing scatters, and off by less than 0.01 over
 * paper where paint does (tests/paper/test_paints.c).
 *
 * The machine computes 16 bits of each channel, of linear light its root (dark shades need the
 * finer steps), all three in one word, so that a picture is one kernel and one array to read;
 * picture.c reads it. */
#include "bands.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>

#define Q_LEAST 2e-3
#define EXPONENT_LEAST (-40.0)
#define WET_FROM                                                                               \
    2.0 /* of the water in a fiber and on it: half a unit is as wet as can be seen */

/* d = sum over pigments of amount * share[pigment], or of amount * (1 - share); amounts of all
 * layers. Uses t[6]. */
static void mixture(struct paper_sheet *p, CM_field_id_t d, size_t member, int channel,
                    bool inverted)
{
    CM_field_id_t amount = p->t[6], fields[3];
    kit_f_set(d, 0.0);
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double *row =
            (const double *)(const void *)((const char *)&p->config.pigments[i] + member);
        double share = inverted ? 1 - row[channel] : row[channel];
        if (share == 0)
            continue;
        int count = sheet_pigment_fields(p, i, fields);
        kit_f_copy(amount, fields[0]);
        for (int j = 1; j < count; j++)
            kit_f_add(amount, amount, fields[j]);
        kit_f_times(amount, amount, share / p->unit);
        kit_f_add(d, d, amount);
    }
}

/* Units of paint, all pigments together, that lie above one another at most: where a part of a
 * fiber would have more, a greater part is stained. */
#define DEEPEST 3.0

/* Whether paint may lie on parts of fibers. Paper that is not sized draws it into all of
 * each. */
static bool stained_in_part(const struct paper_sheet *p)
{
    return sheet_has(p, PAPER_PART_SURFACE) && p->config.stock.absorbency <= SHEET_SIZED_MOST;
}

/* d = the part of each fiber that is stained, above 0. Uses t[0]. */
static void stained_make(struct paper_sheet *p, CM_field_id_t d)
{
    CM_field_id_t other = p->t[0];
    kit_f_times(other, p->stained, SHEET_STAINED_SCALE); /* 0 stands for all of it */
    kit_f_most(other, other, 1.0);
    kit_f_from(other, 1.0, other);
    kit_f_add(d, p->stained, other);
    sheet_paint_sum(p, other);
    kit_f_times(other, other, 1 / (DEEPEST * p->unit));
    kit_f_max(d, d, other);
    kit_f_most(d, d, 1.0);
}

/* d = the layer over what it lies on, in one channel. stained: the part of each fiber where it
 * lies; 0: on all. Uses t[0..7]. */
static void kubelka_munk(struct paper_sheet *p, CM_field_id_t d, int channel,
                         CM_field_id_t stained)
{
    CM_field_id_t k = p->t[0], s = p->t[1], q = p->t[2], e = p->t[3], r = p->t[4], t = p->t[5];
    CM_field_id_t bottom = p->t[6], part = p->t[7], below = p->substrate[channel];
    mixture(p, k, offsetof(struct paper_pigment, k), channel, false);
    mixture(p, s, offsetof(struct paper_pigment, s), channel, false);
    if (stained) {
        kit_f_div(k, k, stained);
        kit_f_div(s, s, stained);
    }
    kit_f_add(q, s, s);
    kit_f_add(q, q, k);
    kit_f_mul(q, q, k);
    CM_f_sqrt_1_1L(q, KIT_F);
    kit_f_least(q, q, Q_LEAST);
    kit_f_times(e, q, -1.0);
    kit_f_least(e, e, EXPONENT_LEAST);
    CM_f_exp_1_1L(e, KIT_F);
    kit_f_mul(t, e, q);
    kit_f_add(t, t, t);
    kit_f_mul(e, e, e);
    kit_f_from(part, 1.0, e);
    kit_f_mul(r, s, part);
    kit_f_add(bottom, k, s);
    kit_f_mul(bottom, bottom, part);
    kit_f_plus(part, e, 1.0);
    kit_f_mul(part, part, q);
    kit_f_add(bottom, bottom, part);
    kit_f_div(r, r, bottom);
    kit_f_div(t, t, bottom);
    kit_f_mul(t, t, t);
    kit_f_mul(t, t, below);
    kit_f_mul(part, r, below);
    kit_f_from(part, 1.0, part);
    kit_f_least(part, part, 1e-6);
    kit_f_div(t, t, part);
    kit_f_add(d, r, t);
    if (stained) {
        kit_f_sub(d, d, below);
        kit_f_mul(d, d, stained);
        kit_f_add(d, d, below);
    }
}

/* d = how wet each fiber looks, 0..1. */
static void wetness_make(struct paper_sheet *p, CM_field_id_t d)
{
    kit_f_copy(d, p->page.water);
    if (sheet_has(p, PAPER_PART_SURFACE))
        kit_f_add(d, d, p->surface_water);
    kit_f_times(d, d, WET_FROM / p->unit);
    kit_f_most(d, d, 1.0);
}

/* d = amounts of pigment i in all layers, in units, each where it is stained. Uses t[7]. */
static void amount_make(struct paper_sheet *p, CM_field_id_t d, int i, CM_field_id_t per)
{
    CM_field_id_t fields[3];
    const int count = sheet_pigment_fields(p, i, fields);
    kit_f_copy(d, fields[0]);
    for (int j = 1; j < count; j++)
        kit_f_add(d, d, fields[j]);
    kit_f_times(d, d, 1 / p->unit);
    if (per)
        kit_f_mul(d, d, per);
}

/* What is known of the sheet's pigments, by bands, and by wet bands; where each fiber is wet;
 * the inverse of its stained part, 0: 1. */
struct bands {
    double k[PAPER_PIGMENTS_MAX][PAPER_BANDS], s[PAPER_PIGMENTS_MAX][PAPER_BANDS];
    CM_field_id_t wet, per;
};

/* k, s = those of the mixture in a band. The amounts are the same values in every band: the
 * machine makes them once. Uses t[6..7]. */
static void band_mix(struct paper_sheet *p, const struct bands *bands, int band,
                     CM_field_id_t k, CM_field_id_t s)
{
    CM_field_id_t amount = p->t[6], part = p->t[7];
    kit_f_set(k, 0.0);
    kit_f_set(s, 0.0);
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double shift = p->config.pigments[i].shift;
        amount_make(p, amount, i, bands->per);
        if (bands->s[i][band] > 0) {
            kit_f_times(part, amount, bands->s[i][band]);
            kit_f_add(s, s, part);
        }
        if (shift > 0) {
            kit_f_times(part, bands->wet, shift);
            kit_f_plus(part, part, 1.0);
            kit_f_mul(amount, amount, part);
        }
        kit_f_times(part, amount, bands->k[i][band]);
        kit_f_add(k, k, part);
    }
}

/* c = Q + 2 / (Q + 2). Uses t[2..4]. */
static void uneven_make(struct paper_sheet *p, CM_field_id_t c, CM_field_id_t k,
                        CM_field_id_t s)
{
    CM_field_id_t q = p->t[2], more = p->t[3], part = p->t[4];
    kit_f_add(q, s, s);
    kit_f_add(q, q, k);
    kit_f_mul(q, q, k);
    CM_f_sqrt_1_1L(q, KIT_F);
    kit_f_plus(more, q, 2.0);
    kit_f_set(part, 2.0);
    kit_f_div(part, part, more);
    kit_f_add(c, q, part);
}

/* d += what a band throws back, as one channel of light sees it. */
static void band_see(struct paper_sheet *p, const struct bands *bands, int band,
                     const CM_field_id_t dest[3])
{
    CM_field_id_t k = p->t[0], s = p->t[1], below = p->t[2], c = p->t[5], part = p->t[3],
                  bottom = p->t[4];
    band_mix(p, bands, band, k, s);
    uneven_make(p, c, k, s);
    kit_f_times(below, p->substrate[0], paper_band_of_light[band][0]);
    for (int i = 1; i < 3; i++) {
        kit_f_times(part, p->substrate[i], paper_band_of_light[band][i]);
        kit_f_add(below, below, part);
    }
    kit_f_add(k, k, s);
    kit_f_mul(part, s, below);
    kit_f_add(bottom, k, c);
    kit_f_sub(bottom, bottom, part);
    kit_f_sub(c, c, k);
    kit_f_mul(c, c, below);
    kit_f_add(s, s, c);
    kit_f_div(s, s, bottom);
    for (int i = 0; i < 3; i++) {
        kit_f_times(part, s, paper_light_of_band[i][band]);
        kit_f_add(dest[i], dest[i], part);
    }
}

/* dest = the layer over what it lies on. stained: the part of each fiber where it lies; 0: on
 * all. Uses t[0..7], t[12..13]. */
static void bands_see(struct paper_sheet *p, const CM_field_id_t dest[3], CM_field_id_t stained)
{
    struct bands bands = {.wet = p->t[12], .per = stained ? p->t[13] : 0};
    wetness_make(p, bands.wet);
    if (stained)
        kit_f_set(bands.per, 1.0);
    if (stained)
        kit_f_div(bands.per, bands.per, stained);
    for (int i = 0; i < p->config.pigments_count; i++)
        paper_pigment_bands(&p->config.pigments[i], bands.k[i], bands.s[i]);
    for (int i = 0; i < 3; i++)
        kit_f_set(dest[i], 0.0);
    for (int band = 0; band < PAPER_BANDS; band++)
        band_see(p, &bands, band, dest);
    for (int i = 0; stained && i < 3; i++) {
        kit_f_sub(dest[i], dest[i], p->substrate[i]);
        kit_f_mul(dest[i], dest[i], stained);
        kit_f_add(dest[i], dest[i], p->substrate[i]);
    }
}

void sheet_color_make(struct paper_sheet *p, const CM_field_id_t dest[3])
{
    const bool parts = p->config.rule == PAPER_RULE_KUBELKA_MUNK && stained_in_part(p);
    CM_field_id_t stained = parts ? p->t[11] : 0;
    if (parts)
        stained_make(p, stained);
    const bool banded =
        p->config.rule == PAPER_RULE_KUBELKA_MUNK && paper_config_banded(&p->config);
    if (banded)
        bands_see(p, dest, stained);
    for (int i = 0; i < 3; i++) {
        if (banded) {
            /* made */
        } else if (p->config.rule == PAPER_RULE_KUBELKA_MUNK) {
            kubelka_munk(p, dest[i], i, stained);
        } else {
            mixture(p, p->t[0], offsetof(struct paper_pigment, takes), i,
                    p->config.rule == PAPER_RULE_LUMINOUS);
            if (p->config.rule == PAPER_RULE_SUBTRACT)
                kit_f_sub(dest[i], p->substrate[i], p->t[0]);
            else
                kit_f_add(dest[i], p->substrate[i], p->t[0]);
        }
        kit_f_least(dest[i], dest[i], 0.0);
        kit_f_most(dest[i], dest[i], 1.0);
    }
}

static void water_make(struct paper_sheet *p, CM_field_id_t d)
{
    if (sheet_has(p, PAPER_PART_SURFACE))
        kit_f_add(d, p->page.water, p->surface_water);
    else
        kit_f_copy(d, p->page.water);
    kit_f_times(d, d, 1 / p->unit);
}

/* The field's 0..1 as 16 bits of the word. */
static void shade_store(struct paper_sheet *p, int channel, CM_field_id_t value, bool linear)
{
    kit_f_least(value, value, 0.0);
    kit_f_most(value, value, 1.0);
    if (linear)
        CM_f_sqrt_1_1L(value, KIT_F);
    kit_f_times(value, value, (1 << SHEET_SHADE_BITS) - 1);
    CM_u_f_round_2_2L(p->shade, value, SHEET_SHADE_BITS, KIT_F);
    if (channel == 0) {
        CM_u_move_2L(p->shades, p->shade, SHEET_SHADES_BITS, SHEET_SHADE_BITS);
        return;
    }
    CM_u_shift_constant_3_2L(p->shifted, p->shade, SHEET_SHADE_BITS * channel,
                             SHEET_SHADES_BITS, SHEET_SHADE_BITS);
    CM_logior_2_1L(p->shades, p->shifted, SHEET_SHADES_BITS);
}

struct paper_sheet_view paper_sheet_view_default(const struct paper_sheet_config *config)
{
    return (struct paper_sheet_view){
        .high = 1, .light = config->parts ? PAPER_LIGHT_USUAL : 0, .scale = 1};
}

enum paper_status sheet_view_check(const struct paper_sheet *p,
                                   const struct paper_sheet_view *view)
{
    if (view->show == PAPER_SHOW_LAYER) {
        if (!sheet_layer_field(p, view->layer, view->pigment))
            return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no such layer to show");
        if (!(isfinite(view->low) && isfinite(view->high) && view->high != view->low))
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "black and white must be two numbers (got %g and %g)", view->low,
                              view->high);
    }
    return paper_within(view->light, 0, 4)
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT, "light must be 0..4 (got %g)", view->light);
}

bool sheet_view_colored(const struct paper_sheet_view *view)
{
    return view->show == PAPER_SHOW_COLOR || view->show == PAPER_SHOW_WET;
}

bool sheet_view_linear(const struct paper_sheet *p, const struct paper_sheet_view *view)
{
    return sheet_view_colored(view) && p->config.rule == PAPER_RULE_KUBELKA_MUNK;
}

void sheet_shades_make(struct paper_sheet *p, const struct paper_sheet_view *view)
{
    CM_set_context();
    CM_field_id_t color[3] = {p->t[8], p->t[9], p->t[10]};
    const bool colored = sheet_view_colored(view);
    if (colored) {
        sheet_color_make(p, color);
        if (view->light > 0)
            sheet_relief_light(p, color, view->light);
        if (view->show == PAPER_SHOW_WET && sheet_has(p, PAPER_PART_SURFACE))
            sheet_water_shine(p, color);
        if (p->varnished)
            sheet_varnish_shine(p, color);
    } else if (view->show == PAPER_SHOW_WATER) {
        water_make(p, color[0]);
    } else {
        const CM_field_id_t layer = sheet_layer_field(p, view->layer, view->pigment);
        if (view->layer == PAPER_LAYER_DRIED_WATER)
            CM_f_u_float_2_2L(color[0], layer, SHEET_DRIED_BITS, KIT_F);
        else
            kit_f_copy(color[0], layer);
        const double unit = sheet_layer_amount(view->layer) ? p->unit : 1;
        kit_f_times(color[0], color[0], 1 / (unit * (view->high - view->low)));
        kit_f_plus(color[0], color[0], -view->low / (view->high - view->low));
    }
    for (int i = 0; i < (colored ? 3 : 1); i++)
        shade_store(p, i, color[i], sheet_view_linear(p, view));
    if (p->config.parts)
        sheet_temporaries_clear(p);
    CM_u_move_constant_1L(p->shade, 0, SHEET_SHADE_BITS);
    CM_u_move_constant_1L(p->shifted, 0, SHEET_SHADES_BITS);
    CM_clear_overflow(); /* else the machine would keep how to tell it */
}
