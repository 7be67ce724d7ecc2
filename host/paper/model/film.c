/* film.c - water that flows over the paper as a thin film, with a speed of its own at each
 * face.
 *
 * A step: what happens in each fiber by itself (soak.c), then what flows over faces, from the
 * state that this left:
 *
 *        level H r + relief    drives      speed u at a face, damped by the paper: thin water is slow (H^2)
 *             u                moves       water, and with it what floats in it
 *        eddies, edge          move        pigments only
 *
 *     r: how much more water presses near edges (soak.c)
 *     D  = level(x) - level(x+1) + gravity                  a fiber that is not all wet stands as high as its wet part; a dry one as
 *                                                           high as water must be to come in: no edge is a special case
 *     m  = ease H^2,  at most MOBILITY_MOST                 ease = 2 / (sizing + sizing'), H the deeper side's depth
 *     u' = (u k + g D) m / ((m + g) k),  k = 1 + H c        drag is implicit; k keeps deep water from swinging
 *     out, in = u' where it is > 0 or < 0, times gates      water comes into a fiber less wet
 *                                                           than its own only from one nearly
 *                                                           all wet
 *
 * Eddies: at each corner of four fibers a stream function, times the depth that is least around
 * it, so that what flows over the faces of a fiber sums to nothing: water need not move for it.
 * Edge: water that dries at the edge of what is wet is replaced from inside, and brings
 * pigment. That flow keeps the film as it is, so only pigments are moved by it, along the slope
 * of wet_around, less towards the very edge: a dark band as wide as edge_width says.
 *
 * A sheet that is drawn anew `finer` times as fine goes finer^2 steps in the time of one:
 * speeds are 1 / finer, and the drag works 1 / finer^2 as fast. What drives the water falls by
 * itself.
 *
 * Pigments do not mix in the thinnest water, of SHEET_STILL times `film`. In what is left of a
 * film that dries unevenly they would all gather in the last wet fibers: the wash would have
 * measles.
 *
 * Pigments go with all these flows, and spread a little. Parts of a fiber that go over one face
 * are at most 1/5 of what it has beyond 4 grains: of q at most 4 ((q - 4)/5 + 1/2) < q, so none
 * gives more than it has; step.c has the rest of the argument. The speeds are numbers of each
 * fiber, kept; those below TOO_SLOW are none, or they would fade into the smallest of floats,
 * which are slow to compute with.
 *
 * Sources: Oron, Davis and Bankoff, Rev. Mod. Phys. 69 (1997), thin films; de Gennes, Rev. Mod.
 * Phys. 57 (1985), contact angles that differ forward and back; Curtis et al. 1997, flow
 * outward at edges. */
#include "model/model.h"

#include <math.h>

#define MOBILITY 2.0 /* of spread */
#define MOBILITY_MOST 4.0
#define UNSIZED_MOBILITY 4.0 /* more, on a stock that is not sized */
#define PULL 0.3
#define SWING (0.75 * (1 + SHEET_ROUND))
#define SPEED_MOST 0.14
#define TOO_SLOW 1e-5
#define GATE_STEEPNESS 4.0
#define DRY_PART 8.0 /* of a fiber, that gives all of its film: 1 / this */
#define PIGMENT_SHARE 0.2
#define MIXING 0.06
#define EDDIES 1.5
#define EDGE_DRIES 0.05 /* see edge_flow_make() */
#define EDGE_BALANCE 0.004
#define EDGE_PLATEAU 12.0
#define CARRIES_FROM 1.0 /* depth, times `film`, below which water carries no pigment */
#define CARRIES_STEEPNESS 0.5
#define OPEN_SCALE 1e6 /* see step.c */

/* ---- what does not change from step to step ---- */

void sheet_film_faces_make(struct paper_sheet *p)
{
    CM_field_id_t open[2] = {p->t[0], p->t[1]}, sum = p->t[2], other = p->t[3], far = p->t[4];
    if (!sheet_has(p, PAPER_PART_SURFACE))
        return;
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_times(open[axis], p->face[axis], OPEN_SCALE);
        kit_f_most(open[axis], open[axis], 1.0);
        kit_f_next(other, p->sizing, axis);
        kit_f_add(sum, p->sizing, other);
        kit_f_div(p->ease[axis], open[axis], sum);
    }
    /* the mean of the four fibers at the corner, added in opposite pairs; only where all four
     * faces between them are open */
    kit_f_next(other, p->current, KIT_AXIS_X);
    kit_f_next(far, other, KIT_AXIS_Y);
    kit_f_add(sum, p->current, far);
    kit_f_next(far, p->current, KIT_AXIS_Y);
    kit_f_add(far, far, other);
    kit_f_add(sum, sum, far);
    kit_f_times(sum, sum, EDDIES / 4);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_mul(sum, sum, open[axis]);
        kit_f_next(other, open[axis], 1 - axis);
        kit_f_mul(sum, sum, other);
    }
    kit_f_copy(p->swirl, sum);
}

/* ---- faces ---- */

/* d = 0..1: the share of the flow from a fiber whose part `from` is wet that reaches a fiber
 * whose part `to` is wet. Uses t[15]. */
static void gate_make(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t from,
                      CM_field_id_t to)
{
    CM_field_id_t full = p->t[15];
    kit_f_times(full, from, GATE_STEEPNESS);
    kit_f_plus(full, full, 1 - GATE_STEEPNESS);
    kit_f_sub(d, to, from);
    kit_f_times(d, d, GATE_STEEPNESS);
    kit_f_plus(d, d, 1.0);
    kit_f_max(d, d, full);
    kit_f_most(d, d, 1.0);
    kit_f_least(d, d, 0.0);
    kit_f_times(full, from, DRY_PART);
    kit_f_most(full, full, 1.0);
    kit_f_mul(d, d, full);
}

/* Computes the new speed[axis]. out and in are its positive and negative parts, before the
 * receiver's room limits them. Uses t[7..15]. */
static void speed_make(struct paper_sheet *p, const struct sheet_terms *terms, unsigned axis,
                       CM_field_id_t out, CM_field_id_t in)
{
    CM_field_id_t other = p->t[7], drive = p->t[8], deep = p->t[9], ease = p->t[10],
                  speed = p->speed[axis];
    const double gravity = p->air.gravity[axis == KIT_AXIS_X ? 0 : 1],
                 pull = PULL / (p->finer * p->finer), most = SPEED_MOST / p->finer,
                 slow = TOO_SLOW / p->finer;
    kit_f_next(other, terms->level, axis);
    kit_f_sub(drive, terms->level, other);
    kit_f_plus(drive, drive, gravity);
    kit_f_times(drive, drive, pull);
    kit_f_next(other, terms->deep, axis);
    kit_f_max(deep, terms->deep, other);
    kit_f_times(ease, p->ease[axis],
                MOBILITY * p->air.spread * (1 + UNSIZED_MOBILITY * sheet_unsized(p)));
    kit_f_mul(ease, ease, deep);
    kit_f_mul(ease, ease, deep);
    kit_f_most(ease, ease, MOBILITY_MOST);
    kit_f_times(deep, deep, SWING);
    kit_f_plus(deep, deep, 1.0);
    kit_f_mul(speed, speed, deep);
    kit_f_add(speed, speed, drive);
    kit_f_mul(speed, speed, ease);
    kit_f_plus(ease, ease, pull);
    kit_f_mul(ease, ease, deep);
    kit_f_div(speed, speed, ease);
    kit_f_most(speed, speed, most);
    kit_f_least(speed, speed, -most);

    kit_f_next(other, p->wet_part, axis);
    gate_make(p, drive, p->wet_part, other);
    gate_make(p, ease, other, p->wet_part);
    kit_f_mul(out, speed, drive);
    kit_f_plus(out, out, -slow);
    kit_f_least(out, out, 0.0);
    kit_f_mul(in, speed, ease);
    kit_f_plus(in, in, slow);
    kit_f_most(in, in, 0.0);
    kit_f_add(speed, out, in);
}

/* d = the flow that eddies cause through the faces of the axis, in units. q: the stream
 * function at corners. */
static void eddies_make(CM_field_id_t d, CM_field_id_t q, unsigned axis)
{
    kit_f_previous(d, q, 1 - axis);
    if (axis == KIT_AXIS_X)
        kit_f_sub(d, q, d);
    else
        kit_f_sub(d, d, q);
}

/* d = how fast pigments go to the edge over the faces of the axis. Uses t[8], t[11].
 *
 * With s the distance from the edge over L = sheet_edge_length(), wet_around is 1 - exp (-s) /
 * 2 inside; so u = wet_around + wet_around' - 1 is 1 - exp (-s), and the slope is (1 - u) / (2
 * L). The speed is
 *
 *     (dries L + balance / root of L) u (1 - u) (1 + 12 u^2)          which grows in line with
 *                                                                     s up to about s = 1
 *
 * A speed that falls to 0 in line towards the edge keeps an even band even. One that grows with
 * L moves wide and narrow bands alike in the same time; it goes with humidity, as what dries is
 * what draws. The last part keeps narrow bands against mixing. */
static void edge_flow_make(struct paper_sheet *p, unsigned axis, CM_field_id_t d)
{
    CM_field_id_t other = p->t[8], bent = p->t[11];
    const double width = sheet_edge_length(p);
    const double flow =
        (1 - sheet_unsized(p)) * p->air.edge *
        (EDGE_DRIES * p->air.humidity * width * width + EDGE_BALANCE * sqrt(width / p->finer));
    kit_f_next(other, p->wet_around, axis);
    kit_f_sub(d, p->wet_around, other);
    kit_f_times(d, d, flow);
    kit_f_add(other, p->wet_around, other);
    kit_f_plus(other, other, -1.0);
    kit_f_least(other, other, 0.0);
    kit_f_mul(d, d, other);
    kit_f_mul(bent, other, other);
    kit_f_times(bent, bent, EDGE_PLATEAU);
    kit_f_plus(bent, bent, 1.0);
    kit_f_mul(d, d, bent);
}

/* The parts of pigments that pass the faces of the axis, from the parts of water, before the
 * receiver's room limits them. Uses t[7..15]. */
static void pigment_faces_make(struct paper_sheet *p, const struct sheet_terms *terms,
                               unsigned axis, CM_field_id_t water_out, CM_field_id_t water_in,
                               CM_field_id_t out, CM_field_id_t in)
{
    CM_field_id_t net = p->t[7], other = p->t[8], both = p->t[9], part = p->t[10],
                  mixed = p->t[11];
    kit_f_mul(net, water_out, terms->depth);
    kit_f_next(other, terms->depth, axis);
    kit_f_mul(part, water_in, other);
    kit_f_add(net, net, part);
    kit_f_max(both, terms->depth, other);
    kit_f_times(both, both, CARRIES_STEEPNESS / p->air.film);
    kit_f_plus(both, both, -CARRIES_STEEPNESS * CARRIES_FROM);
    kit_f_least(both, both, 0.0);
    kit_f_most(both, both, 1.0);
    kit_f_mul(net, net, both);
    eddies_make(part, terms->swirled, axis);
    kit_f_add(net, net, part);
    kit_f_min(both, terms->depth, other);
    kit_f_plus(both, both, -SHEET_STILL * p->air.film);
    kit_f_least(both, both, 0.0);
    kit_f_times(part, p->face[axis], OPEN_SCALE);
    kit_f_most(part, part, 1.0);
    kit_f_mul(both, both, part);
    if (sheet_has(p, PAPER_PART_EDGE)) {
        edge_flow_make(p, axis, part);
        kit_f_mul(part, part, both);
        kit_f_add(net, net, part);
    }
    kit_f_times(mixed, both, MIXING);
    kit_f_least(part, net, 0.0);
    kit_f_add(part, part, mixed);
    kit_f_mul(part, part, terms->inverse);
    kit_f_most(out, part, PIGMENT_SHARE);
    kit_f_most(part, net, 0.0);
    kit_f_sub(part, part, mixed);
    kit_f_next(other, terms->inverse, axis);
    kit_f_mul(part, part, other);
    kit_f_least(in, part, -PIGMENT_SHARE);
}

/* A fiber that is full takes nothing in. Uses t[7]. */
static void room_heed(struct paper_sheet *p, CM_field_id_t room, unsigned axis,
                      CM_field_id_t out, CM_field_id_t in)
{
    CM_field_id_t other = p->t[7];
    kit_f_next(other, room, axis);
    kit_f_mul(out, out, other);
    kit_f_mul(in, in, room);
}

/* The depth that eddies move at a corner is the least depth of its four fibers. Uses
 * t[7..9]. */
static void swirl_make(struct paper_sheet *p, CM_field_id_t swirled)
{
    CM_field_id_t other = p->t[7];
    kit_f_next(other, swirled, KIT_AXIS_X);
    kit_f_min(swirled, swirled, other);
    kit_f_next(other, swirled, KIT_AXIS_Y);
    kit_f_min(swirled, swirled, other);
    kit_f_mul(swirled, swirled, p->swirl);
}

static void faces_of(const struct paper_sheet *p, struct sheet_faces *faces, int first)
{
    for (int axis = 0; axis < 2; axis++) {
        const CM_field_id_t *t = p->t + first + 4 * axis;
        faces->out[axis] = t[0];
        faces->in[axis] = t[1];
        faces->out_below[axis] = t[2];
        faces->in_below[axis] = t[3];
    }
}

/* Uses t[7..31]. */
static void film_flow(struct paper_sheet *p, const struct sheet_terms *terms)
{
    struct sheet_faces water, pigment;
    faces_of(p, &water, 16);
    faces_of(p, &pigment, 24);
    swirl_make(p, terms->swirled);
    for (unsigned axis = 0; axis < 2; axis++) {
        speed_make(p, terms, axis, water.out[axis], water.in[axis]);
        pigment_faces_make(p, terms, axis, water.out[axis], water.in[axis], pigment.out[axis],
                           pigment.in[axis]);
        room_heed(p, terms->room, axis, water.out[axis], water.in[axis]);
        room_heed(p, terms->room, axis, pigment.out[axis], pigment.in[axis]);
    }
    sheet_faces_below(&water);
    sheet_faces_below(&pigment);
    sheet_flow_through(p, p->surface_water, &water, NULL);
    for (int i = 0; i < p->config.pigments_count; i++)
        sheet_flow_through(p, p->surface[i], &pigment, NULL);
}

/* What only the film needs goes before its arrays would wait for the end of the step. */
static void film_terms_clear(const struct sheet_terms *terms)
{
    const CM_field_id_t of_film[] = {terms->depth, terms->level, terms->deep, terms->inverse,
                                     terms->swirled};
    for (size_t i = 0; i < sizeof of_film / sizeof *of_film; i++)
        kit_f_set(of_film[i], 0.0);
}

void sheet_film_step(struct paper_sheet *p)
{
    struct sheet_terms terms;
    sheet_soak(p, &terms);
    sheet_step_part_end(p);
    if (sheet_has(p, PAPER_PART_SURFACE)) {
        film_flow(p, &terms);
        film_terms_clear(&terms);
        sheet_step_part_end(p);
    }
    sheet_capillary_flow(p, &terms);
}
