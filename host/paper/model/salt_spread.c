/* salt_spread.c - what salt does on wet paint: a part of a step.
 *
 * A crystal keeps the water on it saturated, and loses what that takes: it dissolves from its
 * rim inwards, small ones and crumbs first. Brine spreads from fiber to fiber through what is
 * wet and fades, so that it reaches about `reach` fibers. It comes freely into a fiber only
 * from a level that the fiber asks for, by its sizing and how high it stands, and creeps in
 * below: its front is ragged, but is no cliff.
 * Along the slope of its square pigments are pushed outwards, and surface water is drawn
 * inwards half as fast:
 *
 *       salt |>                    brine c         d = strength (c(x)^2 - c(x+1)^2), at most 1/8 either way
 *            |  >                                  pigment: part max (d, 0) of x's goes up, part max (-d, 0) of x+1's down
 *            |    > > >                            water: the other way, half of that
 *
 * The square, because a front of thin brine that stands for long would draw a dark ring around
 * itself. Where brine ended from one fiber to the next all that it pushed stayed in the first
 * fiber without any: a dark line as thin as a fiber around each spot, and dots inside. So brine
 * creeps, and stirs: it mixes pigments between neighbours, so that what is pushed together lies
 * in a soft band.
 *
 * Flows are whole grains of matter, computed once for each face, as in model/step.c: nothing is
 * lost, and mirrored sheets give mirrored bits. Brine is no matter of the sheet's; it is only
 * where it pushes from. */
#include "model/model.h"

#include <math.h>

#define PUSH 2.2
#define PUSH_MOST 0.125
#define SPREADING 0.2   /* of the difference, across an open wet face */
#define DISSOLVING 0.03 /* of a crystal, for brine that is made */
#define WET_FULL 0.15   /* water with which brine moves freely */
#define DRAW 0.5        /* of water, for what is pushed of pigment */
#define BRINE_LEAST 1e-5
/* The brine from which it comes into a fiber: of a usual one; what sizing, about 1, adds, and
 * height above 1/2, to the heights' deviation; at least; and how soon it comes freely. */
#define ASKED 0.19
#define ASKED_SIZING 1.3
#define ASKED_HEIGHT 0.5
#define ROUGH_LEAST 0.05
#define ASKED_LEAST 0.03
#define OPENING 6.0
#define LEAK 0.2 /* of it comes in below that */
/* Of pigments, across a face in brine that is thin; at most. */
#define MIXING 0.5
#define MIXING_MOST 0.05

/* Crystals dissolve into brine. Uses t[5..6]. */
static void crystals_dissolve(struct paper_sheet *p, CM_field_id_t wet)
{
    CM_field_id_t source = p->t[5], made = p->t[6];
    kit_f_times(source, p->salt, 2.0); /* half a crystal still saturates */
    kit_f_most(source, source, 1.0);
    kit_f_mul(source, source, wet);
    kit_f_sub(made, source, p->brine);
    kit_f_least(made, made, 0.0);
    kit_f_max(p->brine, p->brine, source);
    kit_f_times(made, made, DISSOLVING); /* brine spreads finer in as many more steps */
    kit_f_sub(p->salt, p->salt, made);
    kit_f_least(p->salt, p->salt, 0.0);
}

/* Fibers between neighbours, of the stock. */
static int neighbours_distance(const struct paper_sheet *p)
{
    return (int)fmax(1, round(p->finer));
}

int sheet_salt_reach(const struct paper_sheet *p)
{
    return p->salted ? 1 + neighbours_distance(p) : 0;
}

/* d = its mean with four neighbours, of the stock. Sums go in pairs: a mirrored sheet has the
 * same bits. Uses t[1..3]. */
static void neighbours_mean(struct paper_sheet *p, CM_field_id_t d)
{
    CM_field_id_t pair[2] = {p->t[1], p->t[2]}, other = p->t[3];
    const int distance = neighbours_distance(p);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_copy(pair[axis], d);
        kit_f_copy(other, d);
        for (int i = 0; i < distance; i++) {
            kit_f_next(pair[axis], pair[axis], axis);
            kit_f_previous(other, other, axis);
        }
        kit_f_add(pair[axis], pair[axis], other);
    }
    kit_f_add(pair[0], pair[0], pair[1]);
    kit_f_add(d, d, pair[0]);
    kit_f_times(d, d, 0.2);
}

/* asked = the brine from which it comes into a fiber; that of single fibers does not count, or
 * paint would gather in those that stay without. Uses t[1..5]. */
static void asked_make(struct paper_sheet *p, CM_field_id_t asked)
{
    const double rough = fmax(p->config.stock.roughness, ROUGH_LEAST),
                 usual = ASKED - ASKED_HEIGHT / rough / 2;
    kit_f_times(asked, p->height, ASKED_HEIGHT / rough);
    if (sheet_has(p, PAPER_PART_SURFACE)) {
        kit_f_times(p->t[5], p->sizing, ASKED_SIZING);
        kit_f_add(asked, asked, p->t[5]);
        kit_f_plus(asked, asked, usual - ASKED_SIZING);
    } else {
        kit_f_plus(asked, asked, usual);
    }
    neighbours_mean(p, asked);
    kit_f_least(asked, asked, ASKED_LEAST);
}

/* flow = what goes from `giver` to `taker`, if that has less, as far as the taker lets it in.
 * Uses t[7]. */
static void brine_flow(struct paper_sheet *p, CM_field_id_t flow, CM_field_id_t giver,
                       CM_field_id_t taker, CM_field_id_t asked)
{
    CM_field_id_t gate = p->t[7];
    kit_f_sub(gate, giver, asked);
    kit_f_times(gate, gate, OPENING);
    kit_f_least(gate, gate, LEAK);
    kit_f_most(gate, gate, 1.0);
    kit_f_sub(flow, giver, taker);
    kit_f_least(flow, flow, 0.0);
    kit_f_mul(flow, flow, gate);
}

/* Brine spreads and fades. wet: 0..1. Uses t[1..9]. */
static void brine_spread(struct paper_sheet *p, CM_field_id_t wet)
{
    CM_field_id_t open = p->t[1], other = p->t[2], flow[2] = {p->t[3], p->t[4]},
                  asked = p->t[6], back = p->t[8], beyond = p->t[9];
    const double steps = p->finer * p->finer; /* in the time of one */
    asked_make(p, asked);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_next(open, wet, axis);
        kit_f_min(open, open, wet);
        /* along fibers that absorb well it goes further: its rim is ragged */
        kit_f_times(other, p->face[axis], SPREADING / fmax(p->config.stock.absorbency, 1e-3));
        kit_f_most(other, other, SPREADING);
        kit_f_mul(open, open, other);
        kit_f_next(beyond, p->brine, axis);
        kit_f_next(other, asked, axis);
        brine_flow(p, flow[axis], p->brine, beyond, other);
        brine_flow(p, back, beyond, p->brine, asked);
        kit_f_sub(flow[axis], flow[axis], back);
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

/* d = the part of pigments that brine exchanges over the faces of the axis. Uses t[5]. */
static void mixing_make(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t wet,
                        unsigned axis)
{
    CM_field_id_t other = p->t[5];
    kit_f_next(other, p->brine, axis);
    kit_f_min(d, other, p->brine);
    kit_f_times(d, d, MIXING);
    kit_f_most(d, d, MIXING_MOST);
    kit_f_mul(d, d, wet);
    kit_f_next(other, wet, axis);
    kit_f_mul(d, d, other);
    kit_f_times(other, p->face[axis], 1e6); /* 0 where it is closed */
    kit_f_most(other, other, 1.0);
    kit_f_mul(d, d, other);
}

void sheet_salt_step(struct paper_sheet *p)
{
    CM_field_id_t wet = p->t[0], room = p->t[6], other = p->t[5], flow[2] = {p->t[3], p->t[4]};
    CM_field_id_t up[2] = {p->t[7], p->t[8]}, down[2] = {p->t[9], p->t[10]}, mixed = p->t[11];
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    if (surface)
        kit_f_add(wet, p->page.water, p->surface_water);
    else
        kit_f_copy(wet, p->page.water);
    kit_f_times(wet, wet, 1 / (WET_FULL * p->unit));
    kit_f_most(wet, wet, 1.0);
    crystals_dissolve(p, wet);
    brine_spread(p, wet);
    sheet_room_make(p, room);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_mul(down[axis], p->brine, p->brine);
        kit_f_next(other, down[axis], axis);
        kit_f_sub(up[axis], down[axis], other);
        kit_f_times(up[axis], up[axis], PUSH * p->salt_strength);
        kit_f_next(other, wet, axis);
        kit_f_min(other, other, wet);
        kit_f_mul(up[axis], up[axis], other);
        kit_f_times(down[axis], up[axis], -1.0);
        kit_f_times(other, p->face[axis], 1e6); /* 0 where it is closed */
        kit_f_most(other, other, PUSH_MOST / p->finer);
        kit_f_min(up[axis], up[axis], other);
        kit_f_min(down[axis], down[axis], other);
        kit_f_least(up[axis], up[axis], 0.0);
        kit_f_least(down[axis], down[axis], 0.0);
        mixing_make(p, mixed, wet, axis);
        kit_f_add(up[axis], up[axis], mixed);
        kit_f_add(down[axis], down[axis], mixed);
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
