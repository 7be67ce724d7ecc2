/* disperse.c - one cycle of time: water and pigments spread, then fibers dry.
 *
 * Every fiber looks at the gradient towards itself across one face, that to the neighbour below
 * it on the axis:
 *
 *          x-1          x          x+1
 *       +--------+--------+--------+
 *       |        >        >        |         inward(x)  = absorbency(x) * (w(x-1) - w(x)), eased or hindered
 *       +--------+--------+--------+                      by gravity
 *            inward(x)  inward(x+1) = outward(x)
 *
 *       w(x) += inward(x) - outward(x)
 *
 * so what leaves one fiber arrives in the next.  A pigment's gradient is multiplied by the
 * water at the receiving fiber and by the pigment's molecular weight too: it moves where it is
 * wet, and a light pigment runs ahead. Gravity is a factor: gradients along it are multiplied
 * by it, those against it divided.
 *
 * Two fibers at each edge take no part; what flows out over the rim is gone.  At most
 * PAPER_ABSORBENCY_MAX * PAPER_GRAVITY_MAX = 1/2 of a gradient flows across a face, so the
 * explicit scheme is stable and amounts stay within 0..1, which the limits below only enforce
 * against rounding and against gravity's pile-up. */
#include "base/page.h"

#include <math.h>

enum { RIM = 2 };

struct paper_weather paper_weather_default(void)
{
    return (struct paper_weather){
        .gravity_x = 1,
        .gravity_y = 1,
        .humidity = 0.0004,
        .molecular_weight = {1.0, 0.35, 0.7},
    };
}

enum paper_status paper_weather_check(const struct paper_weather *w)
{
    const double least = 1 / PAPER_GRAVITY_MAX;
    if (!(w->gravity_x >= least && w->gravity_x <= PAPER_GRAVITY_MAX && w->gravity_y >= least &&
          w->gravity_y <= PAPER_GRAVITY_MAX))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "gravity must be %g..%g (got %g along x, %g along y)", least,
                          PAPER_GRAVITY_MAX, w->gravity_x, w->gravity_y);
    if (!(w->humidity >= 0 && w->humidity <= 1))
        return paper_fail(PAPER_BAD_ARGUMENT, "humidity must be 0..1 (got %g)", w->humidity);
    for (int i = 0; i < 3; i++)
        if (!(w->molecular_weight[i] >= 0 && w->molecular_weight[i] <= 1))
            return paper_fail(PAPER_BAD_ARGUMENT, "molecular weights must be 0..1 (got %g)",
                              w->molecular_weight[i]);
    return PAPER_OK;
}

/* Multiplies or divides the inward gradient by gravity, in fibers where the gradient has that
 * sign (+1 or -1). */
static void gravity_pull(struct paper *p, double gravity)
{
    if (gravity == 1)
        return; /* changes no bit */
    CM_store_context(p->inner_context);
    CM_f_gt_zero_1L(p->inward, KIT_F);
    CM_logand_context_with_test();
    CM_f_multiply_constant_2_1L(p->inward, gravity, KIT_F);
    CM_load_context(p->inner_context);

    CM_store_context(p->inner_context);
    CM_f_lt_zero_1L(p->inward, KIT_F);
    CM_logand_context_with_test();
    CM_f_divide_constant_2_1L(p->inward, gravity, KIT_F);
    CM_load_context(p->inner_context);
}

/* inward = absorbency * (the lower neighbour's substance - ours). */
static void gradient_take(struct paper *p, CM_field_id_t substance, unsigned axis)
{
    CM_get_from_news_1L(p->inflow, substance, axis, CM_downward, KIT_FLOAT_BITS);
    CM_f_subtract_3_1L(p->inward, p->inflow, substance, KIT_F);
    CM_f_multiply_2_1L(p->inward, p->absorbency, KIT_F);
}

/* substance += inward - outward, kept within 0..1. */
static void gradient_flow(struct paper *p, CM_field_id_t substance, unsigned axis)
{
    CM_get_from_news_1L(p->outward, p->inward, axis, CM_upward, KIT_FLOAT_BITS);
    CM_f_add_2_1L(substance, p->inward, KIT_F);
    CM_f_subtract_2_1L(substance, p->outward, KIT_F);
    CM_f_min_constant_2_1L(substance, 1.0, KIT_F);
    CM_f_max_constant_2_1L(substance, 0.0, KIT_F);
}

static void disperse_along(struct paper *p, unsigned axis, double gravity,
                           const CM_field_id_t *pigments, const double *weights, int count)
{
    kit_grid_narrow(&p->grid, RIM, RIM, p->grid.width - RIM, p->grid.height - RIM);
    gradient_take(p, p->water, axis);
    gravity_pull(p, gravity);
    gradient_flow(p, p->water, axis);
    for (int i = 0; i < count; i++) {
        gradient_take(p, pigments[i], axis);
        CM_f_multiply_2_1L(p->inward, p->water, KIT_F);
        CM_f_multiply_constant_2_1L(p->inward, weights[i], KIT_F);
        gravity_pull(p, gravity);
        gradient_flow(p, pigments[i], axis);
    }
    kit_grid_widen(&p->grid);
}

void paper_cycle(struct paper *p, const struct paper_weather *weather,
                 const CM_field_id_t *pigments, const double *weights, int count)
{
    disperse_along(p, KIT_AXIS_X, weather->gravity_x, pigments, weights, count);
    disperse_along(p, KIT_AXIS_Y, weather->gravity_y, pigments, weights, count);
    if (weather->humidity > 0) {
        CM_f_subtract_constant_2_1L(p->water, weather->humidity, KIT_F);
        CM_f_max_constant_2_1L(p->water, 0.0, KIT_F);
    }
}

enum paper_status paper_disperse(struct paper *p, const struct paper_weather *weather)
{
    enum paper_status status = paper_weather_check(weather);
    if (status != PAPER_OK)
        return status;
    paper_enter(p);
    CM_set_context();
    paper_cycle(p, weather, p->pigment, weather->molecular_weight, 3);
    return paper_leave(p);
}
