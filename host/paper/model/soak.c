/* soak.c - a fiber's own part of a step where water flows (model/film.c): what sinks in,
 * settles and dries; and what part of it is wet.
 *
 * What part. Water on a fiber that is not all wet stands on that part alone, as high as a
 * neighbour's that is:
 *
 *         ____________                    depth h, wet part f:  height H = h / f
 *        |            |____               the edge comes forward where H would be more than `advance`,
 *     ___|____________|____|____                 f = h / advance,
 *         f = 1        f = 0.4   f = 0    goes back where H is less than `film`, f = h / film, and else stays where it is.
 *
 * So type's gray edge stays as gray as it was put. `advance` is the angle at which water comes
 * forward, as a height: it goes with the sizing, is less on damp paper, and less where more of
 * the neighbours are wet, so that edges are neither lines along the axes nor frayed. A film's
 * surface also pulls along a bent edge: it closes dry spots and holds back tips, over some ten
 * fibers. wet_around says how an edge is bent: it is 1/2 at a straight one, more in a bay, less
 * at a tip. It follows the water late, so a fast front must stand higher than a slow one, as
 * angles of moving water are larger. That goes with how uneven the sizing is, which bends
 * edges: glass has none, and drops run on it as they will. Damp paper has no edge to bend.
 *
 * How round. The surface of water pulls itself round: its edge lies on the paper, so water is
 * low there and high in the middle, and the narrower it is, the harder it presses for its
 * height. Its height counts for 1 + SHEET_ROUND (1 - wet_around): once well inside, half as
 * much more at a straight edge, more where edges are near on both sides. So the end of a
 * rivulet is a bead whose depth grows over its whole length, and most in the middle; without
 * this it was a basin with a level surface, and its paint began at a level line. `advance` is
 * the height of water well inside that presses as hard.
 *
 * What part is stained. Paint that comes into a clean fiber lies on the part that is wet, and
 * on more as the water comes forward in it; it stays there when the water is gone. A dark line
 * gathers in a fiber at an edge as much paint as others have on all of them; it is seen beside
 * the paper (view.c), not spread over it, so edges stay gray however dark they get. */
#include "model/model.h"

#include <math.h>

#define ADVANCE 4.375      /* of pinning */
#define ADVANCE_LEAST 1e-3 /* units */
/* The most by which wet neighbours lower it; along a straight edge a quarter of the neighbours
 * are wet. With 1.2 rows of fibers filled from end to end: edges came to lie along the axes. */
#define NEIGHBOURS_HELP 0.3
#define NEIGHBOURS_LEAST 0.1
/* Sixteenths of how wet the neighbours are at which water closes over a fiber; all eight
 * are 12. How wet the fiber itself is does not count: where a wash fades out all fibers are wet
 * in part, and water would close over one after the other, in facets along the axes and the
 * diagonals. */
#define HOLE_FROM 12.0
#define HOLE_STEEPNESS 0.5
#define DAMP_HELP 0.85
/* On a stock without size a fiber is as damp as it can be from a saturation of a fifth on, and
 * `advance` is lowered by the second there: a film runs over damp paper. */
#define DAMP_UNSIZED 24.0
#define DAMP_UNSIZED_HELP 0.98
#define BAY_LEAST 0.1 /* of `advance`, at the end of a dry spot; at a thin tip it is doubled */
#define UNBENT_FROM 16.0 /* 1 / the square of the saturation at which bends count no longer */
#define EMPTY_PART 0.015625 /* of a fiber, that counts as full up to `advance` */
#define DEEP_FROM 8.0 /* a wet part of less than 1 / this of a fiber does not move as a film */
#define SUCTION 10.0  /* of the stock's absorbency: well absorbing paper sucks the more */
#define SUCTION_LOCAL 0.25
#define SETTLING 4.0
/* of granulation; below 1, because pigment that is lifted and settles again gathers in hollows
 * by itself */
#define HOLLOWS 0.6
#define LIFTING 0.4
#define LIFTED_FROM 0.25 /* depth, units, at which water lifts as fast as it can */
/* Water that lifts nothing, times `film`. In the last of a film each fiber that is still wet
 * would draw the pigments of those around it up to its surface, and keep them: the wash would
 * have measles. */
#define LIFTS_NOT 8.0
/* Nothing is lifted from a fiber of which less than 1 - 1 / this is wet: otherwise the edge
 * would be washed out. */
#define LIFTED_WET 4.0
#define HELD_UP 0.75 /* by a unit of depth, of what settles */
/* Water that moves keeps its pigments: they settle half as fast at a speed of about 0.03
 * through all faces of a fiber. So rivulets do not leave all of them on their way, and end in
 * dark beads. */
#define STIRRED 500.0
#define SEEPED_SETTLING 0.1
#define FIBERS_DRYING 0.25  /* of what dries on the surface */
#define DRIED_LEAST 4.0     /* grains */
#define AROUND_LEAST 0.01   /* of what it relaxes by */
#define AROUND_REACH 0.1875 /* of edge_width */
#define EDGE_SLOPE 1.6
#define EDGE_BLUR 2.5 /* fibers by which mixing widens a band */
#define EDGE_LEAST 1.0
#define ROOM_FROM 13.0 /* units that may be taken in before a fiber is full */

/* How much faster a stock takes water in that is not sized, or less than others: in proportion
 * to what it absorbs. (By the cube of that blotting paper takes a drop before it can run, and a
 * wash keeps the strokes it was laid by.) */
static double thirst(const struct paper_sheet *p)
{
    return fmax(1, p->config.stock.absorbency / SHEET_SIZED_MOST);
}

/* Surface water sinks in where it wets the fiber, pigments with it by their weight. Uses
 * t[8..11]. */
static void sink_in(struct paper_sheet *p)
{
    CM_field_id_t taken = p->t[8], left = p->t[9], part = p->t[10], moved = p->t[11];
    const double mean = p->config.stock.absorbency,
                 pull = p->air.absorption * SUCTION * mean * thirst(p);
    kit_f_times(left, p->capacity, p->unit);
    kit_f_sub(left, left, p->page.water);
    kit_f_times(taken, p->page.absorbency, pull * SUCTION_LOCAL);
    kit_f_plus(taken, taken, pull * (1 - SUCTION_LOCAL) * mean);
    kit_f_mul(taken, taken, left);
    kit_f_mul(taken, taken, p->wet_part);
    kit_f_min(taken, taken, left);
    kit_f_least(taken, taken, 0.0);
    sheet_whole_of(taken, p->surface_water);
    kit_f_least(part, p->surface_water, 1.0);
    kit_f_div(part, taken, part);
    kit_f_sub(p->surface_water, p->surface_water, taken);
    kit_f_add(p->page.water, p->page.water, taken);
    kit_f_most(left, p->surface_water, 1.0); /* 1 where water is left */
    kit_f_from(left, 1.0, left);
    for (int i = 0; i < p->config.pigments_count; i++) {
        const double *weight = p->config.pigments[i].weight;
        kit_f_times(moved, part, sheet_weight_within(p, fmax(weight[0], weight[1])));
        if (!sheet_has(p, PAPER_PART_FIXING)) /* what has fallen dry is in the fibers */
            kit_f_max(moved, moved, left);
        kit_f_mul(moved, moved, p->surface[i]);
        sheet_whole_of(moved, p->surface[i]);
        kit_f_sub(p->surface[i], p->surface[i], moved);
        kit_f_add(p->infused[i], p->infused[i], moved);
    }
}

/* d = by * (height * slope + least), cut off at 1 where it could be more. */
static void rate_make(struct paper_sheet *p, CM_field_id_t d, double slope, double least,
                      CM_field_id_t by)
{
    kit_f_times(d, p->height, slope);
    kit_f_plus(d, d, least);
    if (by)
        kit_f_mul(d, d, by);
    if (least > 1 || slope + least > 1)
        kit_f_most(d, d, 1.0);
}

double sheet_settling_pace(const struct paper_sheet *p, int pigment)
{
    return p->air.settling * SETTLING * p->config.pigments[pigment].density;
}

/* Part of what is fixed, and of what is in the fibers, is lifted into the water above. Uses
 * t[11..15]. */
static void pigment_settle(struct paper_sheet *p, int i, CM_field_id_t thin, CM_field_id_t slow,
                           CM_field_id_t dry, CM_field_id_t inside)
{
    CM_field_id_t rate = p->t[11], up = p->t[12], part = p->t[13];
    CM_field_id_t surface = p->surface[i], infused = p->infused[i], fixed = p->fixed[i];
    const struct paper_pigment *pigment = &p->config.pigments[i];
    const double pace = sheet_settling_pace(p, i),
                 lift = p->air.settling * LIFTING / pigment->staining,
                 hollows = pigment->granulation * HOLLOWS;
    rate_make(p, up, lift * hollows, lift * (1 - hollows), thin);
    kit_f_mul(part, up, infused);
    kit_f_mul(part, part, inside);
    sheet_whole_of(part, infused);
    kit_f_sub(infused, infused, part);
    kit_f_mul(up, up, fixed);
    sheet_whole_of(up, fixed);
    kit_f_sub(fixed, fixed, up);
    kit_f_add(up, up, part);

    rate_make(p, rate, -pace * hollows, pace, slow);
    kit_f_times(part, rate, SEEPED_SETTLING);
    kit_f_mul(part, part, infused);
    kit_f_mul(part, part, dry);
    sheet_whole_of(part, infused);
    kit_f_sub(infused, infused, part);
    kit_f_add(fixed, fixed, part);

    kit_f_max(rate, rate, dry);
    kit_f_mul(rate, rate, surface);
    sheet_whole_of(rate, surface);
    kit_f_sub(surface, surface, rate);
    kit_f_add(fixed, fixed, rate);
    kit_f_add(surface, surface, up);
}

/* slow /= 1 + STIRRED times the squares of the speeds at the four faces. Uses t[11..13]. */
static void stirred_heed(struct paper_sheet *p, CM_field_id_t slow)
{
    CM_field_id_t squares[2] = {p->t[11], p->t[12]}, other = p->t[13];
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_previous(other, p->speed[axis], axis);
        kit_f_mul(other, other, other);
        kit_f_mul(squares[axis], p->speed[axis], p->speed[axis]);
        kit_f_add(squares[axis], squares[axis], other);
    }
    kit_f_add(other, squares[0], squares[1]);
    kit_f_times(other, other, STIRRED * p->finer * p->finer);
    kit_f_plus(other, other, 1.0);
    kit_f_div(slow, slow, other);
}

/* Pigments settle, in hollows more than on hills, slower from deep water and from water that
 * moves; what falls dry stays. Uses t[8..15]. */
static void settle_under(struct paper_sheet *p)
{
    CM_field_id_t thin = p->t[8], slow = p->t[9], wet = p->t[10], dry = p->t[14],
                  inside = p->t[15];
    kit_f_times(slow, p->surface_water, 1 / p->unit);
    kit_f_most(slow, slow, 1.0);
    kit_f_copy(thin, slow);
    kit_f_plus(thin, thin, -LIFTS_NOT * p->air.film);
    kit_f_least(thin, thin, 0.0);
    kit_f_times(thin, thin, 1 / LIFTED_FROM);
    kit_f_most(thin, thin, 1.0);
    kit_f_times(wet, p->wet_part, LIFTED_WET); /* none where only a part is wet */
    kit_f_plus(wet, wet, 1 - LIFTED_WET);
    kit_f_least(wet, wet, 0.0);
    kit_f_mul(thin, thin, wet);
    kit_f_times(slow, slow, -HELD_UP);
    kit_f_plus(slow, slow, 1.0);
    kit_f_most(dry, p->surface_water, 1.0);
    kit_f_from(dry, 1.0, dry);
    kit_f_max(wet, wet, dry); /* what is not lifted must not settle, or it gathers there */
    kit_f_mul(slow, slow, wet);
    stirred_heed(p, slow);
    kit_f_times(inside, p->wet_around, 4.0);
    kit_f_plus(inside, inside, -3.0);
    kit_f_least(inside, inside, 0.0);
    for (int i = 0; i < p->config.pigments_count; i++)
        pigment_settle(p, i, thin, slow, dry, inside);
}

/* Without a surface: in the fibers, while they are damp. Uses t[8..15]. */
static void settle_within(struct paper_sheet *p)
{
    CM_field_id_t damp = p->t[8], up = p->t[12], part = p->t[13];
    kit_f_most(damp, p->page.water, 1.0);
    for (int i = 0; i < p->config.pigments_count; i++) {
        const struct paper_pigment *pigment = &p->config.pigments[i];
        const double pace = p->air.settling * SETTLING * SEEPED_SETTLING * pigment->density,
                     lift = p->air.settling * LIFTING * SEEPED_SETTLING / pigment->staining,
                     hollows = pigment->granulation * HOLLOWS;
        rate_make(p, up, lift * hollows, lift * (1 - hollows), damp);
        kit_f_mul(up, up, p->fixed[i]);
        sheet_whole_of(up, p->fixed[i]);
        rate_make(p, part, -pace * hollows, pace, damp);
        kit_f_mul(part, part, p->infused[i]);
        sheet_whole_of(part, p->infused[i]);
        kit_f_sub(up, up, part);
        kit_f_add(p->infused[i], p->infused[i], up);
        kit_f_sub(p->fixed[i], p->fixed[i], up);
    }
}

/* q loses at most `loss`, which is kept count of. Uses t[15]. */
static void water_lose(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t loss)
{
    CM_field_id_t count = p->t[15];
    kit_f_min(loss, loss, q);
    sheet_whole_of(loss, q);
    kit_f_sub(q, q, loss);
    CM_u_f_truncate_2_2L(count, loss, SHEET_DRIED_BITS, KIT_F);
    CM_u_add_2_1L(p->dried, count, SHEET_DRIED_BITS);
}

/* From the surface, where it is wet; from fibers that no water covers. Uses t[8..15]. */
static void dry_out(struct paper_sheet *p)
{
    CM_field_id_t loss = p->t[8], dry = p->t[9];
    const double grains = p->air.humidity * p->unit;
    if (!sheet_has(p, PAPER_PART_SURFACE)) {
        kit_f_set(loss, grains * FIBERS_DRYING);
        water_lose(p, p->page.water, loss);
        return;
    }
    kit_f_most(dry, p->surface_water, 1.0);
    kit_f_from(dry, 1.0, dry);
    kit_f_times(loss, p->wet_part, grains);
    kit_f_plus(loss, loss, DRIED_LEAST);
    water_lose(p, p->surface_water, loss);
    kit_f_times(loss, dry, grains * FIBERS_DRYING);
    water_lose(p, p->page.water, loss);
}

/* How far apart the fibers are among which wet_around spreads. Wide edges take greater
 * distances, so that they form in as many steps as narrow ones: else a band would be as wide as
 * wet_around has come when the water has dried, and not as wide as was asked for. */
int sheet_around_reach(const struct paper_sheet *p)
{
    const double width = p->air.edge_width / p->finer;
    return (int)fmax(1, floor(width * AROUND_REACH));
}

/* d = the sum over the two fibers at the distance `reach` on the axis. Uses t[11]. */
static void both_sides_make(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t a,
                            unsigned axis, int reach)
{
    CM_field_id_t far = p->t[11];
    kit_f_copy(d, a);
    kit_f_copy(far, a);
    for (int i = 0; i < reach; i++) {
        kit_f_next(d, d, axis);
        kit_f_previous(far, far, axis);
    }
    kit_f_add(d, d, far);
}

double sheet_edge_length(const struct paper_sheet *p)
{
    return p->finer * fmax(EDGE_LEAST, EDGE_SLOPE * p->air.edge_width / p->finer - EDGE_BLUR);
}

/* wet_around follows the wet part and spreads, to the neighbours and to those at `reach`: in
 * the long run it is 1 well inside, 1/2 at a straight edge and 0 outside, over a distance that
 * goes with edge_width. Uses t[8..12]. */
static void around_follow(struct paper_sheet *p)
{
    CM_field_id_t sum = p->t[8], along_y = p->t[9], along_x = p->t[10], near = p->t[12];
    const double width = sheet_edge_length(p);
    const int reach = sheet_around_reach(p);
    const double spread = (1 + reach * reach) / 8.0, relax = spread / (width * width + spread);
    for (int from = 1;; from = reach) {
        both_sides_make(p, along_y, p->wet_around, KIT_AXIS_Y, from);
        both_sides_make(p, along_x, p->wet_around, KIT_AXIS_X, from);
        kit_f_add(sum, along_y, along_x);
        if (from == reach)
            break;
        kit_f_copy(near, sum);
    }
    kit_f_add(sum, sum, reach == 1 ? sum : near);
    kit_f_times(sum, sum, 0.125 * (1 - relax));
    kit_f_times(near, p->wet_part, relax);
    kit_f_add(sum, sum, near);
    kit_f_plus(sum, sum, -AROUND_LEAST * relax); /* no endless tail of tiny numbers */
    kit_f_least(p->wet_around, sum, 0.0);
}

/* d = how wet the eight neighbours are, sixteenths: by weights of 2 and 1, the fiber's own
 * being 4. Sums go in pairs of opposite sides, so a mirrored sheet has the same bits. Uses
 * t[10..14]. */
static void neighbourhood_make(struct paper_sheet *p, CM_field_id_t d)
{
    CM_field_id_t right = p->t[10], left = p->t[11], one = p->t[12], other = p->t[13],
                  corners = p->t[14];
    kit_f_next(right, p->wet_part, KIT_AXIS_X);
    kit_f_previous(left, p->wet_part, KIT_AXIS_X);
    kit_f_previous(one, left, KIT_AXIS_Y);
    kit_f_next(other, right, KIT_AXIS_Y);
    kit_f_add(corners, one, other);
    kit_f_previous(one, right, KIT_AXIS_Y);
    kit_f_next(other, left, KIT_AXIS_Y);
    kit_f_add(one, one, other);
    kit_f_add(corners, corners, one);
    kit_f_add(d, left, right);
    kit_f_previous(one, p->wet_part, KIT_AXIS_Y);
    kit_f_next(other, p->wet_part, KIT_AXIS_Y);
    kit_f_add(one, one, other);
    kit_f_add(d, d, one);
    kit_f_times(d, d, 2.0);
    kit_f_add(d, d, corners);
}

/* d = by how much `advance` is more or less where an edge is bent. damp: the square of how
 * saturated the fiber is. Uses t[10]. */
static void bend_make(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t damp)
{
    CM_field_id_t dry = p->t[10];
    kit_f_times(dry, damp, -UNBENT_FROM);
    kit_f_plus(dry, dry, 1.0);
    kit_f_least(dry, dry, 0.0);
    kit_f_times(d, p->wet_around, -2 * sheet_sizing_strength(p));
    kit_f_plus(d, d, sheet_sizing_strength(p));
    kit_f_mul(d, d, dry);
    kit_f_plus(d, d, 1.0);
    kit_f_least(d, d, BAY_LEAST);
}

/* d = how hard water presses for its height, by how near edges are; 1 well inside. */
static void round_make(const struct paper_sheet *p, CM_field_id_t d)
{
    kit_f_times(d, p->wet_around, -SHEET_ROUND);
    kit_f_plus(d, d, 1 + SHEET_ROUND);
}

/* Moves the edge of the wet part forward or back, then computes level and deep from it. Uses
 * t[7..14]. */
static void edge_move(struct paper_sheet *p, const struct sheet_terms *terms)
{
    CM_field_id_t advance = p->t[7], help = p->t[8], part = p->t[9];
    const double unsized = sheet_unsized(p);
    neighbourhood_make(p, part);
    kit_f_times(help, p->wet_part, 4.0);
    kit_f_add(help, part, help);
    kit_f_times(help, help, -NEIGHBOURS_HELP / 16);
    kit_f_plus(help, help, 1 + NEIGHBOURS_HELP / 4);
    kit_f_least(help, help, NEIGHBOURS_LEAST);
    kit_f_times(part, part, -HOLE_STEEPNESS);
    kit_f_plus(part, part, HOLE_FROM * HOLE_STEEPNESS);
    kit_f_least(part, part, 0.0);
    kit_f_min(help, help, part);
    kit_f_times(advance, p->sizing, ADVANCE * p->air.pinning);
    kit_f_mul(advance, advance, help);
    kit_f_most(help, terms->saturated, 1.0);
    kit_f_mul(help, help, help);
    bend_make(p, part, help);
    kit_f_mul(advance, advance, part);
    if (unsized > 0) {
        kit_f_times(help, help, 1 + DAMP_UNSIZED * unsized);
        kit_f_most(help, help, 1.0);
    }
    kit_f_times(help, help, -(DAMP_HELP + unsized * (DAMP_UNSIZED_HELP - DAMP_HELP)));
    kit_f_plus(help, help, 1.0);
    kit_f_mul(advance, advance, help);
    round_make(p, help);
    kit_f_div(advance, advance, help);
    kit_f_least(advance, advance, ADVANCE_LEAST);

    kit_f_times(part, terms->depth, 1 / p->air.film);
    kit_f_min(part, part, p->wet_part);
    kit_f_div(help, terms->depth, advance);
    kit_f_max(part, part, help);
    kit_f_most(part, part, 1.0);
    kit_f_sub(help, part, p->wet_part);
    kit_f_least(help, help, 0.0);
    kit_f_add(p->stained, p->stained, help);
    kit_f_most(p->stained, p->stained, 1.0);
    kit_f_copy(p->wet_part, part);

    kit_f_times(advance, advance, EMPTY_PART);
    kit_f_add(advance, advance, terms->depth);
    kit_f_plus(part, p->wet_part, EMPTY_PART);
    kit_f_div(advance, advance, part);
    kit_f_times(part, p->wet_part, DEEP_FROM);
    kit_f_most(part, part, 1.0);
    kit_f_mul(terms->deep, advance, part);
    round_make(p, help);
    kit_f_mul(advance, advance, help);
    kit_f_times(part, p->height, p->air.relief);
    kit_f_add(terms->level, advance, part);
}

/* d = all of the pigments, in all layers. */
void sheet_paint_sum(struct paper_sheet *p, CM_field_id_t d)
{
    CM_field_id_t fields[3];
    kit_f_set(d, 0.0);
    for (int i = 0; i < p->config.pigments_count; i++)
        for (int j = sheet_pigment_fields(p, i, fields) - 1; j >= 0; j--)
            kit_f_add(d, d, fields[j]);
}

/* Of a clean fiber the part that is wet would be stained. Paint that has come into one that is
 * not wet, out of its neighbours' fibers, lies in all of it. Uses t[7..8]. */
static void stained_follow(struct paper_sheet *p, CM_field_id_t paint)
{
    CM_field_id_t some = p->t[7], part = p->t[8];
    kit_f_times(part, p->stained, SHEET_STAINED_SCALE);
    kit_f_most(part, part, 1.0);
    kit_f_from(part, 1.0, part);
    kit_f_add(part, part, p->stained);
    kit_f_most(some, paint, 1.0);
    kit_f_mul(part, part, some);
    kit_f_from(some, 1.0, some);
    kit_f_mul(some, some, p->wet_part);
    kit_f_add(p->stained, part, some);
}

/* Four neighbours bring at most 4/5 of 15 units each; see film.c. Uses t[7..8]. */
static void room_make(struct paper_sheet *p, CM_field_id_t room)
{
    const bool surface = sheet_has(p, PAPER_PART_SURFACE);
    sheet_paint_sum(p, room);
    if (surface)
        stained_follow(p, room);
    kit_f_add(room, room, surface ? p->surface_water : p->page.water);
    kit_f_from(room, SHEET_LOAD_MAX * p->unit, room);
    kit_f_times(room, room, 1 / (ROOM_FROM * p->unit));
    kit_f_least(room, room, 0.0);
    kit_f_most(room, room, 1.0);
}

void sheet_soak(struct paper_sheet *p, struct sheet_terms *terms)
{
    *terms = (struct sheet_terms){p->term[0], p->term[1], p->term[2], p->term[3],
                                  p->term[4], p->term[5], p->term[6]};
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    if (surface)
        sink_in(p);
    if (sheet_has(p, PAPER_PART_FIXING) && surface)
        settle_under(p);
    else if (sheet_has(p, PAPER_PART_FIXING))
        settle_within(p);
    if (p->air.humidity > 0)
        dry_out(p);
    room_make(p, terms->room);
    kit_f_times(terms->saturated, p->capacity, p->unit);
    kit_f_div(terms->saturated, p->page.water, terms->saturated);
    if (!surface)
        return;
    around_follow(p);
    kit_f_times(terms->depth, p->surface_water, 1 / p->unit);
    edge_move(p, terms);
    kit_f_least(terms->inverse, terms->depth, 4 / p->unit);
    CM_f_divinto_constant_2_1L(terms->inverse, 1.0, KIT_F);
    kit_f_times(terms->swirled, p->wet_around, 2.0);
    kit_f_plus(terms->swirled, terms->swirled, -1.0);
    kit_f_least(terms->swirled, terms->swirled, 0.0);
    kit_f_mul(terms->swirled, terms->swirled, terms->swirled);
    kit_f_plus(p->t[7], terms->depth, -SHEET_STILL * p->air.film);
    kit_f_least(p->t[7], p->t[7], 0.0);
    kit_f_mul(terms->swirled, terms->swirled, p->t[7]);
}
