/* salt_spread.c - what salt does on wet paint: a part of a step.
 *
 * A grain dissolves where it is wet and keeps the water on it saturated; brine spreads from
 * fiber to fiber through what is wet and fades, so that it reaches about `reach` fibers. Along
 * its slope pigments are pushed outwards, and surface water is drawn inwards half as fast:
 *
 *       salt |>                    brine c         d = strength (c(x) - c(x+1)), at most 1/8 either way
 *            |  >                                  pigment: part max (d, 0) of x's goes up, part max (-d, 0) of x+1's down
 *            |    > > >                            water: the other way, half of that
 *
 * Flows are whole grains of matter, computed once for each face, as in model/step.c: nothing is
 * lost, and mirrored sheets give mirrored bits. Brine is no matter of the sheet's; it is only
 * where it pushes from. */
#include "model/model.h"

#include <math.h>

#define PUSH_MOST 0.125
#define SPREADING 0.2    /* of the difference, across an open wet face */
#define DISSOLVING 0.004 /* of a grain in a step, in water */
#define WET_FULL 0.15    /* water with which brine moves freely */
#define DRAW 0.5         /* of water, for what is pushed of pigment */
#define BRINE_LEAST 1e-5

/* Grains dissolve; brine spreads and fades. wet: 0..1. */
static void brine_spread(struct paper_sheet *p, CM_field_id_t wet)
{
    CM_field_id_t open = p->t[1], other = p->t[2], flow[2] = {p->t[3], p->t[4]},
                  source = p->t[5];
    const double steps = p->finer * p->finer; /* in the time of one */
    kit_f_times(source, wet, -DISSOLVING / steps);
    kit_f_plus(source, source, 1.0);
    kit_f_mul(p->salt, p->salt, source);
    kit_f_mul(source, p->salt, wet);
    kit_f_times(source, source, 2.0); /* half a grain still saturates */
    kit_f_most(source, source, 1.0);
    kit_f_max(p->brine, p->brine, source);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_next(open, wet, axis);
        kit_f_min(open, open, wet);
        /* along fibers that absorb well it goes further: its rim is ragged */
        kit_f_times(other, p->face[axis], SPREADING / fmax(p->config.stock.absorbency, 1e-3));
        kit_f_most(other, other, SPREADING);
        kit_f_mul(open, open, other);
        kit_f_next(other, p->brine, axis);
        kit_f_sub(flow[axis], p->brine, other);
        kit_f_mul(flow[axis], flow[axis], open);
    }
    for (unsigned axis = 0; axis < 2;
         axis++) { /* no whole numbers: the order of sums must be alike too */
        kit_f_previous(other, flow[axis], axis);
        kit_f_sub(flow[axis], other, flow[axis]);
    }
    kit_f_add(flow[0], flow[0], flow[1]);
    kit_f_add(p->brine, p->brine, flow[0]);
    kit_f_times(p->brine, p->brine, 1 - SPREADING / (p->salt_reach * p->salt_reach + 1));
    kit_f_plus(p->brine, p->brine, -BRINE_LEAST / steps);
    kit_f_least(p->brine, p->brine, 0.0);
}

void sheet_salt_step(struct paper_sheet *p)
{
    CM_field_id_t wet = p->t[0], room = p->t[6], other = p->t[5], flow[2] = {p->t[3], p->t[4]};
    CM_field_id_t up[2] = {p->t[7], p->t[8]}, down[2] = {p->t[9], p->t[10]};
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    if (surface)
        kit_f_add(wet, p->page.water, p->surface_water);
    else
        kit_f_copy(wet, p->page.water);
    kit_f_times(wet, wet, 1 / (WET_FULL * p->unit));
    kit_f_most(wet, wet, 1.0);
    brine_spread(p, wet);
    sheet_room_make(p, room);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_next(other, p->brine, axis);
        kit_f_sub(up[axis], p->brine, other);
        kit_f_times(up[axis], up[axis], p->salt_strength);
        kit_f_next(other, wet, axis);
        kit_f_min(other, other, wet);
        kit_f_mul(up[axis], up[axis], other);
        kit_f_times(down[axis], up[axis], -1.0);
        kit_f_times(other, p->face[axis], 1e6); /* 0 where it is closed */
        kit_f_most(other, other, PUSH_MOST);
        kit_f_min(up[axis], up[axis], other);
        kit_f_min(down[axis], down[axis], other);
        kit_f_least(up[axis], up[axis], 0.0);
        kit_f_least(down[axis], down[axis], 0.0);
        kit_f_next(other, room, axis);
        kit_f_mul(up[axis], up[axis], other);
        kit_f_mul(down[axis], down[axis], room);
    }
    for (int i = 0; i < p->config.pigments_count; i++)
        for (int layer = surface ? 0 : 1; layer < 2; layer++) {
            CM_field_id_t q = layer == 0 ? p->surface[i] : p->infused[i];
            for (unsigned axis = 0; axis < 2; axis++)
                sheet_flow_make(p, flow[axis], up[axis], down[axis], q, axis);
            for (unsigned axis = 0; axis < 2; axis++)
                sheet_flow_take(p, q, flow[axis], axis);
        }
    if (!surface)
        return;
    for (unsigned axis = 0; axis < 2; axis++) { /* water comes from where pigment goes */
        kit_f_times(up[axis], up[axis], DRAW);
        kit_f_times(down[axis], down[axis], DRAW);
        sheet_flow_make(p, flow[axis], down[axis], up[axis], p->surface_water, axis);
    }
    for (unsigned axis = 0; axis < 2; axis++)
        sheet_flow_take(p, p->surface_water, flow[axis], axis);
}
