/* step.c - one step of time on a sheet with layers, and what water does that spreads; model/film.c has water that flows.
 *
 * A fiber holds water and pigments in up to three layers:
 *
 *        surface_water, surface[i]        flows over the paper                     flow_surface()
 *          | absorption      |   ^
 *          v                 |   | lifting
 *        water, infused[i]   |   |        creeps from fiber to fiber               flow_infused()
 *            |  ^            v   |
 *            v  |          fixed[i]       stays
 *
 * First what happens in each fiber by itself: absorb(), settle(), evaporate(); then both flows, from the state that
 * this left.  A flow is computed once for each face, that between a fiber and its upper neighbour on the axis:
 *
 *          x-1          x          x+1
 *       +--------+--------+--------+      out: part of x's that goes up    (0 or more)
 *       |      F(x-1)    F(x)      |      in:  part of x+1's that comes down (0 or less)
 *       +--------+--------+--------+      F = whole grains of out * q(x) + in * q(x+1)
 *
 *       q(x) += F(x-1) - F(x)
 *
 * |out| and |in| are at most 1/8, so no fiber gives more than it has, though grains are rounded: of less than 4 nothing leaves,
 * of q at most 4 (q/8 + 1/2). Amounts are whole numbers up to 2^24, so sums are exact. That amounts stay there is seen to by
 * `room`: it is 1 where a fiber is loaded with up to half of
 * SHEET_LOAD_MAX and falls to 0 at that; four neighbours bring at most 4 * 1/8 * SHEET_LOAD_MAX * room.
 * A mirrored sheet gives mirrored bits, for every expression below is symmetric in a face's two sides.
 *
 * Sources: Small 1991 (displacement by gravity, tension, spreading; absorption; evaporation); Curtis et al. 1997 (wet area, edge
 * darkening, transfer of pigment, capacities). */
#include "model/model.h"

#include <math.h>

enum { TENSION_REACH = 10 };
#define SURFACE_SHARE 0.125
#define INFUSED_SHARE 0.125
#define CAPACITY_SHARE 0.25 /* of what a fiber can still take, at one face */
#define AROUND_LEAST 1e-6
/* A face's absorbency is at least this where it is open at all. */
#define OPEN_SCALE 1e6

struct paper_air paper_air_default(void)
{
    return (struct paper_air){
        .spread = 1,
        .relief = 0.05,
        .film = 0.02,
        .pinning = 0.8,
        .damp = 0.05,
        .absorption = 0.02,
        .carry = 0.3,
        .humidity = 0.0004,
        .edge = 15,
        .edge_width = 8,
        .settling = 0.1,
        .thesis = paper_weather_default(),
    };
}

/* d = 0 where q is, 1 where there is a grain of it */
static void present(CM_field_id_t d, CM_field_id_t q)
{
    kit_f_most(d, q, 1.0);
}

/* ---- in each fiber ---- */

/* Surface water sinks in, up to the capacity, pigments with it by their weight. Uses t[0..4]. */
static void absorb(struct paper_sheet *p)
{
    CM_field_id_t taken = p->t[0], part = p->t[1], moved = p->t[2], dry = p->t[3];
    kit_f_times(taken, p->page.absorbency, p->air.absorption);
    kit_f_mul(taken, taken, p->surface_water);
    kit_f_times(part, p->capacity, p->unit);
    kit_f_sub(part, part, p->page.water);
    kit_f_min(taken, taken, part);
    kit_f_least(taken, taken, 0.0);
    sheet_whole_of(taken, p->surface_water);
    kit_f_least(part, p->surface_water, 1.0);
    kit_f_div(part, taken, part);
    kit_f_sub(p->surface_water, p->surface_water, taken);
    kit_f_add(p->page.water, p->page.water, taken);
    if (!sheet_has(p, PAPER_PART_FIXING)) { /* what has fallen dry is in the fibers */
        present(dry, p->surface_water);
        kit_f_from(dry, 1.0, dry);
    }
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double *weight = p->config.pigments[i].weight;
        kit_f_times(moved, part, fmax(weight[0], weight[1]));
        if (!sheet_has(p, PAPER_PART_FIXING))
            kit_f_max(moved, moved, dry);
        kit_f_mul(moved, moved, p->surface[i]);
        sheet_whole_of(moved, p->surface[i]);
        kit_f_sub(p->surface[i], p->surface[i], moved);
        kit_f_add(p->infused[i], p->infused[i], moved);
    }
}

/* Pigments settle on the fibers, in hollows more than on hills, and are lifted again where it is wet: into the surface
 * water if there is any, else into that of the fibers. What has fallen dry stays. Uses t[0..7]. */
static void settle(struct paper_sheet *p)
{
    CM_field_id_t dry = p->t[0], wet = p->t[1], damp = p->t[2], rate = p->t[3], down = p->t[4],
                  up = p->t[5], seeped = p->t[6], part = p->t[7];
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    present(damp, p->page.water);
    if (surface) {
        present(wet, p->surface_water);
        kit_f_from(dry, 1.0, wet);
        kit_f_mul(damp, damp, dry); /* lifted into the fibers */
    }
    for (int i = 0; i < p->config.pigments_count; i++) {
        const struct paper_pigment *pigment = &p->config.pigments[i];
        double pace = p->air.settling * pigment->density;
        kit_f_times(rate, p->height, -pace * pigment->granulation);
        kit_f_plus(rate, rate, pace);
        kit_f_times(up, p->height, pace / pigment->staining * pigment->granulation);
        kit_f_plus(up, up, pace / pigment->staining * (1 - pigment->granulation));
        if (pace > 0.5 || pace / pigment->staining > 0.5) { /* else they are within 0..1 */
            kit_f_most(rate, rate, 1.0);
            kit_f_least(rate, rate, 0.0);
            kit_f_most(up, up, 1.0);
            kit_f_least(up, up, 0.0);
        }
        kit_f_mul(up, up, p->fixed[i]);
        sheet_whole_of(up, p->fixed[i]);

        kit_f_mul(seeped, rate, p->infused[i]);
        if (surface) { /* with water above, settling from the fibers waits */
            kit_f_max(part, rate, dry);
            kit_f_mul(down, part, p->surface[i]);
            sheet_whole_of(down, p->surface[i]);
            kit_f_mul(part, up, wet);
            kit_f_sub(down, down, part);
            kit_f_sub(p->surface[i], p->surface[i], down);
            kit_f_add(p->fixed[i], p->fixed[i], down);
        }
        kit_f_mul(seeped, seeped, damp);
        sheet_whole_of(seeped, p->infused[i]);
        kit_f_mul(up, up, damp);
        kit_f_sub(up, up, seeped);
        kit_f_add(p->infused[i], p->infused[i], up);
        kit_f_sub(p->fixed[i], p->fixed[i], up);
    }
}

/* d = 0..1: how wet a fiber counts as. Surface water counts, and so does water in a fiber that
 * is more than damp. */
static void wetness(const struct paper_sheet *p, CM_field_id_t d)
{
    kit_f_plus(d, p->page.water, -floor(p->air.damp * p->unit));
    kit_f_least(d, d, 0.0);
    kit_f_add(d, d, p->surface_water);
    kit_f_most(d, d, 1.0);
}

/* q loses at most `loss`, which is kept count of. Uses t[8]. */
static void dry_up(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t loss)
{
    CM_field_id_t count = p->t[8];
    kit_f_min(loss, loss, q);
    sheet_whole_of(loss, q);
    kit_f_sub(q, q, loss);
    CM_u_f_truncate_2_2L(count, loss, SHEET_DRIED_BITS, KIT_F);
    CM_u_add_2_1L(p->dried, count, SHEET_DRIED_BITS);
}

/* Surface water dries first, at the edge of what is wet the faster. wet_around follows the wet area, blurred: it
 * spreads to the neighbours and relaxes, so that in the long run it is the area convolved with a bell as wide as
 * edge_width, whatever its shape. Uses t[0..8]. */
static void evaporate(struct paper_sheet *p)
{
    CM_field_id_t wet = p->t[0], loss = p->t[1], around = p->t[2], sum = p->t[3],
                  other = p->t[4];
    double grains = p->air.humidity * p->unit;
    if (sheet_has(p, PAPER_PART_EDGE) && p->air.edge > 0) {
        wetness(p, wet);
        kit_f_next(sum, p->wet_around, KIT_AXIS_X);
        kit_f_previous(other, p->wet_around, KIT_AXIS_X);
        kit_f_add(sum, sum, other);
        kit_f_next(around, p->wet_around, KIT_AXIS_Y);
        kit_f_previous(other, p->wet_around, KIT_AXIS_Y);
        kit_f_add(around, around, other);
        kit_f_add(around, around, sum);
        kit_f_times(around, around, 0.25);
        double relax = 1 / (1 + 4 * p->air.edge_width * p->air.edge_width);
        kit_f_times(around, around, 1 - relax);
        kit_f_times(other, wet, relax);
        kit_f_add(p->wet_around, around, other);
        kit_f_plus(p->wet_around, p->wet_around,
                   -AROUND_LEAST); /* no endless tail of tiny numbers */
        kit_f_least(p->wet_around, p->wet_around, 0.0);
        kit_f_from(loss, 1.0, p->wet_around);
        kit_f_least(loss, loss, 0.0);
        kit_f_mul(loss, loss, wet);
        kit_f_times(loss, loss, grains * p->air.edge);
        kit_f_plus(loss, loss, grains);
    } else {
        kit_f_set(loss, grains);
    }
    kit_f_copy(around, loss);
    if (sheet_has(p, PAPER_PART_SURFACE)) {
        present(wet, p->surface_water); /* before it dries */
        dry_up(p, p->surface_water, loss);
        kit_f_from(wet, 1.0, wet);
        kit_f_mul(around, around, wet);
    }
    dry_up(p, p->page.water, around);
}

/* ---- between fibers ---- */

/* The parts of a gradient that flow through the two faces of a fiber on an axis: out of it and
 * into it at the face above, and at the face below, which is the lower neighbour's upper face. */
struct faces {
    CM_field_id_t out, in, out_below, in_below;
};

/* Uses t[16..23]. */
static void faces_init(const struct paper_sheet *p, struct faces faces[2])
{
    for (unsigned axis = 0; axis < 2; axis++)
        faces[axis] = (struct faces){p->t[16 + 4 * axis], p->t[17 + 4 * axis],
                                     p->t[18 + 4 * axis], p->t[19 + 4 * axis]};
}

static void faces_below(const struct faces *faces, unsigned axis)
{
    kit_f_previous(faces->out_below, faces->out, axis);
    kit_f_previous(faces->in_below, faces->in, axis);
}

/* All parts times weight. Uses t[7..10], t[16 + ...]. */
static void faces_weigh(const struct paper_sheet *p, struct faces *d, const struct faces *faces,
                        unsigned axis, double weight)
{
    *d = *faces;
    if (weight == 1)
        return;
    *d = (struct faces){p->t[4 + 4 * axis], p->t[5 + 4 * axis], p->t[6 + 4 * axis],
                        p->t[7 + 4 * axis]};
    kit_f_times(d->out, faces->out, weight);
    kit_f_times(d->in, faces->in, weight);
    kit_f_times(d->out_below, faces->out_below, weight);
    kit_f_times(d->in_below, faces->in_below, weight);
}

/* q gets what flows through its four faces. What comes in from below is computed again from both sides' amounts: the
 * machine would have to store a flow for the neighbour, and that takes longer. The difference of two flows is exact while
 * both have KIT_WHOLE in them. Uses t[12..15]. */
static void flow_take(struct paper_sheet *p, CM_field_id_t q, const struct faces faces[2])
{
    CM_field_id_t other = p->t[15], flow = p->t[13], sum[2] = {p->t[12], p->t[15]};
    for (unsigned axis = 0; axis < 2; axis++) {
        const struct faces *f = &faces[axis];
        kit_f_previous(other, q, axis);
        sheet_flow_sum(flow, f->out_below, other, f->in_below, q, p->t[14]);
        kit_f_next(other, q, axis);
        sheet_flow_sum(other, f->out, q, f->in, other, p->t[14]);
        kit_f_sub(sum[axis], flow, other);
    }
    kit_f_add(q, q, sum[0]);
    kit_f_add(q, q, sum[1]);
}

/* Upwards: d = w(x+1) + w(x+2)/2 + ... + w(x+10)/10. Downwards the sum begins at the fiber
 * itself: w(x) + w(x-1)/2 + .... Beyond the edge of a sheet that is no torus, fibers are dry.
 * Uses t[14]. */
static void pull_make(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t water,
                      unsigned axis, bool upwards)
{
    CM_field_id_t far = p->t[14], part = p->t[13];
    kit_f_copy(far, water);
    for (int n = 1; n <= TENSION_REACH; n++) {
        if (upwards || n > 1) {
            if (upwards)
                kit_f_next(far, far, axis);
            else
                kit_f_previous(far, far, axis);
            if (!p->config.torus) {
                bool x = axis == KIT_AXIS_X;
                unsigned bits = (unsigned)(x ? p->page.grid.x_bits : p->page.grid.y_bits);
                int last = (x ? p->page.grid.width : p->page.grid.height) - 1;
                CM_u_eq_constant_1L(x ? p->page.grid.x_coord : p->page.grid.y_coord,
                                    upwards ? (unsigned)last : 0, bits);
                CM_logand_context_with_test();
                kit_f_set(far, 0.0);
                CM_set_context();
            }
        }
        if (n == 1) {
            kit_f_copy(d, far);
        } else {
            kit_f_times(part, far, 1.0 / n);
            kit_f_add(d, d, part);
        }
    }
}

/* The parts of surface water, and of the pigments in it, that leave and enter along the axis.
 * level, film, wet, entry and room are fields with a number for each fiber. */
struct surface_terms {
    CM_field_id_t water, level, film, wet, entry, room;
};

static void displacement_make(struct paper_sheet *p, const struct surface_terms *terms,
                              unsigned axis, CM_field_id_t out, CM_field_id_t in)
{
    CM_field_id_t other = p->t[13], gate = p->t[12], d = p->t[11];
    double gravity = p->air.gravity[axis == KIT_AXIS_X ? 0 : 1];
    kit_f_next(other, terms->level, axis);
    kit_f_sub(d, terms->level, other);
    kit_f_times(d, d, p->air.spread);
    /* Levels even out as by diffusion with the coefficient spread * water. It is kept below
     * 1/8: larger coefficients would make levels swing. */
    kit_f_next(other, terms->water, axis);
    kit_f_add(other, other, terms->water);
    kit_f_times(other, other, 4 * p->air.spread);
    kit_f_plus(other, other, 1.0);
    kit_f_div(d, d, other);
    if (p->air.tension > 0) {
        pull_make(p, out, terms->water, axis, true);
        pull_make(p, in, terms->water, axis, false);
        kit_f_sub(out, out, in);
        kit_f_times(out, out, p->air.tension);
        kit_f_add(d, d, out);
    }
    if (gravity != 0) {
        kit_f_next(other, terms->water, axis);
        kit_f_add(other, other, terms->water);
        kit_f_times(other, other, gravity / 2);
        kit_f_add(d, d, other);
    }
    kit_f_times(gate, p->face[axis], OPEN_SCALE); /* 0 or 1: open */
    kit_f_most(gate, gate, 1.0);
    kit_f_mul(d, d, gate);
    kit_f_least(out, d, 0.0);
    kit_f_most(out, out, SURFACE_SHARE);
    kit_f_most(in, d, 0.0);
    kit_f_least(in, in, -SURFACE_SHARE);

    kit_f_mul(out, out, terms->film);
    kit_f_next(other, terms->film, axis);
    kit_f_mul(in, in, other);
    kit_f_next(other, terms->room, axis);
    kit_f_mul(out, out, other);
    kit_f_mul(in, in, terms->room);
    if (p->air.pinning > 0) {
        kit_f_next(other, terms->entry, axis);
        kit_f_sub(gate, terms->water, other);
        kit_f_times(gate, gate, 4.0);
        kit_f_least(gate, gate, 0.0);
        kit_f_next(other, terms->wet, axis);
        kit_f_add(gate, gate, other);
        kit_f_most(gate, gate, 1.0);
        kit_f_mul(out, out, gate);

        kit_f_next(other, terms->water, axis);
        kit_f_sub(gate, other, terms->entry);
        kit_f_times(gate, gate, 4.0);
        kit_f_least(gate, gate, 0.0);
        kit_f_add(gate, gate, terms->wet);
        kit_f_most(gate, gate, 1.0);
        kit_f_mul(in, in, gate);
    }
}

/* Small's displacement on the surface: what lies higher sinks, what is pulled goes, at most SURFACE_SHARE across a face;
 * thin films are slow, and dry fibers are entered only from water that stands higher than `pinning`, on hills higher
 * still. Uses t[1..15]; room is t[0]. */
static void flow_surface(struct paper_sheet *p, CM_field_id_t room)
{
    struct surface_terms terms = {.water = p->t[1],
                                  .level = p->t[2],
                                  .film = p->t[3],
                                  .wet = p->t[4],
                                  .entry = p->t[5],
                                  .room = room};
    struct faces faces[2];
    faces_init(p, faces);
    kit_f_times(terms.water, p->surface_water, 1 / p->unit);
    kit_f_times(terms.film, terms.water, 1 / p->air.film);
    kit_f_most(terms.film, terms.film, 1.0);
    kit_f_times(terms.level, p->height, p->air.relief);
    kit_f_add(terms.level, terms.level, terms.water);
    if (p->air.pinning > 0) {
        wetness(p, terms.wet);
        kit_f_plus(terms.entry, p->height, 0.5);
        kit_f_times(terms.entry, terms.entry, p->air.pinning);
    }
    for (unsigned axis = 0; axis < 2; axis++) {
        displacement_make(p, &terms, axis, faces[axis].out, faces[axis].in);
        faces_below(&faces[axis], axis);
    }
    flow_take(p, p->surface_water, faces);
    for (int i = 0; i < p->config.pigments_count; i++)
        flow_take(p, p->surface[i], faces);
}

/* Water creeps along its gradient into the capacity that its neighbour has left. Pigments
 * follow their own gradient where both sides of a face are wet, and move with the water. Uses
 * t[1..14]; room is t[0]. */
static void flow_infused(struct paper_sheet *p, CM_field_id_t room)
{
    CM_field_id_t left = p->t[1], other = p->t[2], moved = p->t[3], fromward = p->t[4];
    CM_field_id_t flow[2] = {p->t[5], p->t[6]};
    CM_field_id_t water = p->page.water;
    struct faces faces[2], weighed[2];
    faces_init(p, faces);
    kit_f_times(left, p->capacity, p->unit);
    kit_f_sub(left, left, water);
    kit_f_times(left, left, CAPACITY_SHARE);
    kit_f_least(left, left, 0.0);
    for (unsigned axis = 0; axis < 2; axis++) {
        CM_field_id_t out = faces[axis].out, in = faces[axis].in;
        double seep = p->air.seep[axis == KIT_AXIS_X ? 0 : 1];
        kit_f_next(other, water, axis);
        kit_f_sub(flow[axis], water, other);
        if (seep != 0) {
            kit_f_add(moved, water, other);
            kit_f_times(moved, moved, seep / 2);
            kit_f_add(flow[axis], flow[axis], moved);
        }
        kit_f_mul(flow[axis], flow[axis], p->face[axis]);
        kit_f_next(moved, left, axis);
        kit_f_min(flow[axis], flow[axis], moved);
        kit_f_times(moved, water, INFUSED_SHARE);
        kit_f_min(flow[axis], flow[axis], moved);
        kit_f_times(moved, left, -1.0);
        kit_f_max(flow[axis], flow[axis], moved);
        kit_f_times(moved, other, -INFUSED_SHARE);
        kit_f_max(flow[axis], flow[axis], moved);
        sheet_flow_round(flow[axis]);

        /* pigments: along their gradient, then with the water */
        kit_f_min(moved, water, other);
        kit_f_times(moved, moved, (1 - p->air.carry) / p->unit);
        kit_f_mul(moved, moved, p->face[axis]);
        kit_f_least(out, flow[axis], 0.0);
        kit_f_least(fromward, water, 1.0);
        kit_f_div(out, out, fromward);
        kit_f_times(out, out, p->air.carry);
        kit_f_add(out, out, moved);
        kit_f_most(in, flow[axis], 0.0);
        kit_f_least(fromward, other, 1.0);
        kit_f_div(in, in, fromward);
        kit_f_times(in, in, p->air.carry);
        kit_f_sub(in, in, moved);
        kit_f_most(out, out, INFUSED_SHARE);
        kit_f_least(in, in, -INFUSED_SHARE);
        kit_f_next(other, room, axis);
        kit_f_mul(out, out, other);
        kit_f_mul(in, in, room);
        faces_below(&faces[axis], axis);
    }
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_previous(other, flow[axis], axis);
        kit_f_add(water, water, other);
        kit_f_sub(water, water, flow[axis]);
    }
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double *weight = p->config.pigments[i].weight;
        for (unsigned axis = 0; axis < 2; axis++)
            faces_weigh(p, &weighed[axis], &faces[axis], axis,
                        weight[axis == KIT_AXIS_X ? 0 : 1]);
        flow_take(p, p->infused[i], weighed);
    }
}

static void spreading_step(struct paper_sheet *p)
{
    CM_field_id_t room = p->t[0];
    if (sheet_has(p, PAPER_PART_SURFACE))
        absorb(p);
    if (sheet_has(p, PAPER_PART_FIXING))
        settle(p);
    if (p->air.humidity > 0)
        evaporate(p);
    sheet_room_make(p, room);
    if (sheet_has(p, PAPER_PART_SURFACE))
        flow_surface(p, room);
    flow_infused(p, room);
}

void sheet_step_everywhere(struct paper_sheet *p)
{
    CM_set_context();
    if (p->config.parts == 0) {
        double weights[PAPER_PIGMENTS_MAX];
        for (int i = 0; i < p->config.pigments_count; i++)
            weights[i] = p->config.pigments[i].weight[0];
        paper_cycle(&p->page, &p->air.thesis, p->infused, weights, p->config.pigments_count);
        return;
    }
    if (sheet_flows(p))
        sheet_film_step(p);
    else
        spreading_step(p);
    if (p->salted)
        sheet_salt_step(p);
    sheet_temporaries_clear(p);
}
