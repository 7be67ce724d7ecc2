/* capillary.c - water that creeps from fiber to fiber, where water flows (model/film.c), and
 * the pigments in it.
 *
 * Fibers suck by how empty they are, and let through the better the fuller they are and the
 * more they absorb. A dry fiber is entered only from one that is fuller than a threshold, which
 * is low for fibers that absorb well: ink on absorbent paper runs along these and comes to
 * fingers, and sized paper, all of whose thresholds are high, keeps what is in it.
 *
 *     s    = water / capacity
 *     flow = face * CONDUCTION min (capacity, capacity') * (max (s - s', 0) s gate' + min (s - s', 0) s' gate)
 *     gate' = 0..1 from s = threshold' on;   threshold' = (1.5 - 4.5 absorbency') max (0, 1 -
 *                                            16 s')
 *
 * at most a quarter of the room that the neighbour has, and an eighth of what a fiber holds.
 * Pigments go with the water by their weight, and spread a little where both sides are wet. */
#include "model/model.h"

#include <math.h>

#define CONDUCTION 0.8
#define THRESHOLD_BASE 1.5
#define THRESHOLD_SIZED 0.6 /* more, where the stock is sized */
#define UNSIZED_LEAST 0.2   /* absorbency of a stock without size at all */
#define THRESHOLD_SLOPE 4.5 /* by absorbency */
#define THRESHOLD_LEAST 0.05
#define THRESHOLD_MOST 0.98
#define WET_FROM 16.0 /* 1 / saturation from which a fiber is entered freely */
#define GATE_STEEPNESS 8.0
#define INFUSED_SHARE 0.125
#define CAPACITY_SHARE 0.25
#define CARRIED 3.0    /* of carry */
#define SPREADING 0.05 /* of 1 - carry */

/* What a fiber contributes to the flow through its faces: the room it has left, how full a
 * neighbour must be to enter it, and 1 / water. */
struct pores {
    CM_field_id_t left, threshold, inverse;
};

/* Sized paper has no fiber that is entered before it must: single ones that absorb more than
 * others stuck out of edges as hairs. */
static double threshold_base(const struct paper_sheet *p)
{
    const double mean = p->config.stock.absorbency,
                 sized = fmin(
                     1, fmax(0, (UNSIZED_LEAST - mean) / (UNSIZED_LEAST - SHEET_SIZED_MOST)));
    return THRESHOLD_BASE + THRESHOLD_SIZED * sized;
}

static void pores_make(struct paper_sheet *p, const struct sheet_terms *terms,
                       const struct pores *pores)
{
    CM_field_id_t dry = p->t[10];
    kit_f_times(pores->left, p->capacity, p->unit);
    kit_f_sub(pores->left, pores->left, p->page.water);
    kit_f_times(pores->left, pores->left, CAPACITY_SHARE);
    kit_f_least(pores->left, pores->left, 0.0);
    kit_f_times(pores->threshold, p->page.absorbency, -THRESHOLD_SLOPE);
    kit_f_plus(pores->threshold, pores->threshold, threshold_base(p));
    kit_f_least(pores->threshold, pores->threshold, THRESHOLD_LEAST);
    kit_f_most(pores->threshold, pores->threshold, THRESHOLD_MOST);
    kit_f_times(dry, terms->saturated, -WET_FROM);
    kit_f_plus(dry, dry, 1.0);
    kit_f_least(dry, dry, 0.0);
    kit_f_mul(pores->threshold, pores->threshold, dry);
    kit_f_least(pores->inverse, p->page.water, 1.0);
    CM_f_divinto_constant_2_1L(pores->inverse, 1.0, KIT_F);
}

/* d = the saturation of the first fiber, times how far it can enter a fiber with that
 * threshold. */
static void pull_through(CM_field_id_t d, CM_field_id_t saturated, CM_field_id_t threshold)
{
    kit_f_sub(d, saturated, threshold);
    kit_f_times(d, d, GATE_STEEPNESS);
    kit_f_least(d, d, 0.0);
    kit_f_most(d, d, 1.0);
    kit_f_mul(d, d, saturated);
}

/* Whole grains of water over the faces of the axis. Uses t[10..15]. */
static void creep_make(struct paper_sheet *p, const struct sheet_terms *terms,
                       const struct pores *pores, unsigned axis, CM_field_id_t flow)
{
    CM_field_id_t other = p->t[10], slope = p->t[11], up = p->t[12], down = p->t[13];
    const double seep = p->air.seep[axis == KIT_AXIS_X ? 0 : 1];
    kit_f_next(other, terms->saturated, axis);
    kit_f_sub(slope, terms->saturated, other);
    if (seep != 0) {
        kit_f_add(up, terms->saturated, other);
        kit_f_times(up, up, seep / 2);
        kit_f_add(slope, slope, up);
    }
    kit_f_next(down, pores->threshold, axis);
    pull_through(up, terms->saturated, down);
    pull_through(down, other, pores->threshold);
    kit_f_least(other, slope, 0.0);
    kit_f_mul(up, up, other);
    kit_f_most(other, slope, 0.0);
    kit_f_mul(down, down, other);
    kit_f_add(flow, up, down);
    kit_f_mul(flow, flow, p->face[axis]);
    kit_f_next(other, p->capacity, axis);
    kit_f_min(other, other, p->capacity);
    kit_f_times(other, other, CONDUCTION * p->unit);
    kit_f_mul(flow, flow, other);

    kit_f_next(other, pores->left, axis);
    kit_f_min(flow, flow, other);
    kit_f_times(other, p->page.water, INFUSED_SHARE);
    kit_f_min(flow, flow, other);
    kit_f_times(other, pores->left, -1.0);
    kit_f_max(flow, flow, other);
    kit_f_next(other, p->page.water, axis);
    kit_f_times(other, other, -INFUSED_SHARE);
    kit_f_max(flow, flow, other);
    sheet_flow_round(flow);
}

/* Parts of pigments that go with it. Uses t[10..14]. */
static void carried_make(struct paper_sheet *p, const struct sheet_terms *terms,
                         const struct pores *pores, unsigned axis, CM_field_id_t flow,
                         CM_field_id_t out, CM_field_id_t in)
{
    CM_field_id_t other = p->t[10], spread = p->t[11];
    const double carried = fmin(1, CARRIED * p->air.carry);
    kit_f_next(other, p->page.water, axis);
    kit_f_min(spread, p->page.water, other);
    kit_f_times(spread, spread, (1 - p->air.carry) * SPREADING / p->unit);
    kit_f_mul(spread, spread, p->face[axis]);
    kit_f_least(out, flow, 0.0);
    kit_f_mul(out, out, pores->inverse);
    kit_f_times(out, out, carried);
    kit_f_add(out, out, spread);
    kit_f_most(out, out, INFUSED_SHARE);
    kit_f_next(other, terms->room, axis);
    kit_f_mul(out, out, other);
    kit_f_most(in, flow, 0.0);
    kit_f_next(other, pores->inverse, axis);
    kit_f_mul(in, in, other);
    kit_f_times(in, in, carried);
    kit_f_sub(in, in, spread);
    kit_f_least(in, in, -INFUSED_SHARE);
    kit_f_mul(in, in, terms->room);
}

/* Uses t[7..15], t[32..44]. */
void sheet_capillary_flow(struct paper_sheet *p, const struct sheet_terms *terms)
{
    const struct pores pores = {p->t[7], p->t[8], p->t[9]};
    CM_field_id_t flow[2] = {p->t[40], p->t[41]}, other = p->t[42],
                  sum[2] = {p->t[43], p->t[44]};
    struct sheet_faces faces;
    for (int axis = 0; axis < 2; axis++) {
        const CM_field_id_t *t = p->t + 32 + 4 * axis;
        faces.out[axis] = t[0];
        faces.in[axis] = t[1];
        faces.out_below[axis] = t[2];
        faces.in_below[axis] = t[3];
    }
    pores_make(p, terms, &pores);
    for (unsigned axis = 0; axis < 2; axis++) {
        creep_make(p, terms, &pores, axis, flow[axis]);
        carried_make(p, terms, &pores, axis, flow[axis], faces.out[axis], faces.in[axis]);
    }
    sheet_faces_below(&faces);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_previous(other, flow[axis], axis);
        kit_f_sub(sum[axis], other, flow[axis]);
    }
    kit_f_add(sum[0], sum[0], sum[1]);
    kit_f_add(p->page.water, p->page.water, sum[0]);
    for (int i = 0; i < p->config.pigments_count; i++)
        sheet_flow_through(p, p->infused[i], &faces, p->config.pigments[i].weight);
}
