/* capillary.c - water that creeps from fiber to fiber, where water flows (model/film.c), and
 * the pigments in it.
 *
 * Fibers suck by how empty they are, and let through the better the more they absorb; on sized
 * paper also the fuller they are. A dry fiber is entered only from one that is fuller than a
 * threshold, which is low for fibers that absorb well. Sized paper, all of whose thresholds are
 * high, keeps what is in it. On paper without size thresholds are low in the pores between
 * fibers that lie side by side (model/felt_fibers.c): water runs ahead along these, and fills
 * what lies between them later. So the front of ink comes to branches as wide as a pore. (With
 * thresholds of single fibers it had teeth one fiber wide.) Pigments go with the water, slower,
 * and so there is a rim of water around ink.
 *
 *     s    = water / capacity
 *     flow = face * conduction * min (capacity, capacity')
 *                 * (max (s - s', 0) pull gate' + min (s - s', 0) pull' gate)
 *     pull = s on sized paper, 1 on paper without size
 *     gate' = 0..1 from s = threshold' on
 *     threshold' = (base - slope absorbency') max (0, 1 - 16 s')
 *
 * at most a quarter of the room that the neighbour has, and an eighth of what a fiber holds.
 * Pigments go with the water by their weight, and spread a little where both sides are wet.
 *
 * What spreads by a share of the difference to each neighbour can go no faster than by a
 * quarter of it; in the 1,500 steps that a puddle has until it dries a front would come some 25
 * fibers far. Paper without size draws ink out further, so water creeps twice in a step
 * there. */
#include "model/model.h"

#include <math.h>

#define CONDUCTION 0.8         /* of a sized stock, in a step */
#define UNSIZED_CONDUCTION 1.0 /* of one without size, in a pass */
#define THRESHOLD_BASE 2.1     /* of a sized stock */
#define THRESHOLD_SLOPE 4.5
/* Of a stock without size: a fiber that absorbs as the stock's mean says has the threshold 0,
 * one that absorbs a tenth of the mean less has this / 10. */
#define UNSIZED_SLOPE 3.4
enum { UNSIZED_PASSES = 2 };
#define THRESHOLD_LEAST 0.05
#define THRESHOLD_MOST 0.98
#define WET_FROM 16.0 /* 1 / saturation from which a fiber is entered freely */
#define GATE_STEEPNESS 8.0
#define INFUSED_SHARE 0.125
#define CAPACITY_SHARE 0.25
#define CARRIED 3.0           /* of carry */
#define SPREADING 0.05        /* of 1 - carry */
#define UNSIZED_SPREADING 1.5 /* more, on a stock without size */

/* What a fiber contributes to the flow through its faces: the room it has left, how full a
 * neighbour must be to enter it, and 1 / water. */
struct pores {
    CM_field_id_t left, threshold, inverse;
};

int sheet_capillary_passes(const struct paper_sheet *p)
{
    return sheet_unsized(p) > 0 ? UNSIZED_PASSES : 1;
}

/* Wide pores let heavy pigments by: of a quarter half goes with the water. */
double sheet_weight_within(const struct paper_sheet *p, double weight)
{
    return weight + (sqrt(weight) - weight) * sheet_unsized(p);
}

/* How well a fiber leads in a pass. */
static double conduction(const struct paper_sheet *p)
{
    const double unsized = sheet_unsized(p);
    return (1 - unsized) * CONDUCTION / sheet_capillary_passes(p) +
           unsized * UNSIZED_CONDUCTION;
}

/* A threshold is line[0] + line[1] * absorbency. Sized paper has no fiber that is entered
 * before it must: single ones that absorb more than others stuck out of edges as hairs. */
static void threshold_line(const struct paper_sheet *p, double line[2])
{
    const double unsized = sheet_unsized(p);
    line[0] = (1 - unsized) * THRESHOLD_BASE + unsized * UNSIZED_SLOPE;
    line[1] = (unsized - 1) * THRESHOLD_SLOPE;
    if (unsized > 0)
        line[1] -= unsized * UNSIZED_SLOPE / p->config.stock.absorbency;
}

static void pores_make(struct paper_sheet *p, const struct sheet_terms *terms,
                       const struct pores *pores)
{
    CM_field_id_t dry = p->t[10];
    double line[2];
    threshold_line(p, line);
    kit_f_times(pores->left, p->capacity, p->unit);
    kit_f_sub(pores->left, pores->left, p->page.water);
    kit_f_times(pores->left, pores->left, CAPACITY_SHARE);
    kit_f_least(pores->left, pores->left, 0.0);
    kit_f_times(pores->threshold, p->page.absorbency, line[1]);
    kit_f_plus(pores->threshold, pores->threshold, line[0]);
    kit_f_least(pores->threshold, pores->threshold, THRESHOLD_LEAST);
    kit_f_most(pores->threshold, pores->threshold, THRESHOLD_MOST);
    kit_f_times(dry, terms->saturated, -WET_FROM);
    kit_f_plus(dry, dry, 1.0);
    kit_f_least(dry, dry, 0.0);
    kit_f_mul(pores->threshold, pores->threshold, dry);
    kit_f_least(pores->inverse, p->page.water, 1.0);
    CM_f_divinto_constant_2_1L(pores->inverse, 1.0, KIT_F);
}

/* d = how hard the first fiber presses by how full it is, times how far it can enter a fiber
 * with that threshold. Uses t[14]. */
static void pull_through(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t saturated,
                         CM_field_id_t threshold)
{
    const double unsized = sheet_unsized(p);
    CM_field_id_t pull = saturated;
    kit_f_sub(d, saturated, threshold);
    kit_f_times(d, d, GATE_STEEPNESS);
    kit_f_least(d, d, 0.0);
    kit_f_most(d, d, 1.0);
    if (unsized > 0) {
        pull = p->t[14];
        kit_f_times(pull, saturated, 1 - unsized);
        kit_f_plus(pull, pull, unsized);
    }
    kit_f_mul(d, d, pull);
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
    pull_through(p, up, terms->saturated, down);
    pull_through(p, down, other, pores->threshold);
    kit_f_least(other, slope, 0.0);
    kit_f_mul(up, up, other);
    kit_f_most(other, slope, 0.0);
    kit_f_mul(down, down, other);
    kit_f_add(flow, up, down);
    kit_f_mul(flow, flow, p->face[axis]);
    kit_f_next(other, p->capacity, axis);
    kit_f_min(other, other, p->capacity);
    kit_f_times(other, other, conduction(p) * p->unit);
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
    kit_f_times(spread, spread,
                (1 - p->air.carry) * SPREADING * (1 + UNSIZED_SPREADING * sheet_unsized(p)) /
                    p->unit);
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

static void infused_flow(struct paper_sheet *p, const struct sheet_faces *faces)
{
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double *weight = p->config.pigments[i].weight;
        const double by[2] = {sheet_weight_within(p, weight[0]),
                              sheet_weight_within(p, weight[1])};
        sheet_flow_through(p, p->infused[i], faces, by);
    }
}

static void pass(struct paper_sheet *p, const struct sheet_terms *terms)
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
    infused_flow(p, &faces);
}

void sheet_capillary_flow(struct paper_sheet *p, const struct sheet_terms *terms)
{
    for (int left = sheet_capillary_passes(p);; left--) {
        pass(p, terms);
        if (left == 1)
            return;
        sheet_step_part_end(p);
        sheet_room_make(p, terms->room);
        kit_f_times(terms->saturated, p->capacity, p->unit);
        kit_f_div(terms->saturated, p->page.water, terms->saturated);
    }
}
