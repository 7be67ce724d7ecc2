/* paper_openmp_flow.c - the rule of water that flows in plain C with OpenMP, three passes a
 * step:
 *
 *     own parts    row by row, in place; what faces need goes into rows of terms
 *     faces        parts of water, of pigments above, of pigments in fibers; speeds
 *     flows        for each amount: what goes up over each face, then what that leaves
 *
 * The operations are those of host/paper/model/{soak,film,capillary}.c in the same order, for
 * sized stocks; all rows become vectors. */
#include "paper_openmp.h"
#include "paper_openmp_rounding.h"

#include <math.h>
#include <string.h>

#define UNIT ((double)PAPER_GRAINS)

enum { FAR = 6 }; /* as far as anything looks along x */

/* ---- own parts ---- */

static void water_own(const struct paper_openmp *o, int y)
{
    const struct paper_air *air = &o->config.air;
    const int width = o->config.width;
    float *surface = field_row(o, F_SURFACE_WATER, y), *water = field_row(o, F_WATER, y),
          *part = term_row(o, T_PART, y);
    const float *absorbency = field_row(o, F_ABSORBENCY, y),
                *capacity = field_row(o, F_CAPACITY, y), *wet = field_row(o, o->wet_now, y);
    const double mean = o->config.absorbency, pull = air->absorption * 10 * mean;
    const float slope = (float)(pull * 0.25), base = (float)(pull * (1 - 0.25) * mean),
                unit = (float)UNIT;
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float s = surface[x], w = water[x], free = capacity[x] * unit - w;
        float taken = (absorbency[x] * slope + base) * free * wet[x];
        taken = whole_of(greatest(least(taken, free), 0.0f), s);
        part[x] = taken / greatest(s, 1.0f);
        surface[x] = s - taken;
        water[x] = w + taken;
    }
}

static void stirred_own(const struct paper_openmp *o, int y)
{
    const float *across = field_row(o, F_SPEED_X, y), *along = field_row(o, F_SPEED_Y, y),
                *below = field_row(o, F_SPEED_Y, y - 1);
    float *stirred = term_row(o, T_STIRRED, y);
#pragma omp simd
    for (int x = 0; x < o->config.width; x++)
        stirred[x] = ((across[x] * across[x] + across[x - 1] * across[x - 1]) +
                      (along[x] * along[x] + below[x] * below[x])) *
                         500.0f +
                     1.0f;
}

static void pigment_own(const struct paper_openmp *o, int y, int pigment)
{
    const struct paper_pigment *p = &o->config.pigments[pigment];
    const int width = o->config.width, field = F_PIGMENTS + 3 * pigment;
    float *surface = field_row(o, field, y), *infused = field_row(o, field + 1, y),
          *fixed = field_row(o, field + 2, y);
    const float *part_row = term_row(o, T_PART, y), *stirred = term_row(o, T_STIRRED, y),
                *height = field_row(o, F_HEIGHT, y), *water = field_row(o, F_SURFACE_WATER, y),
                *wet = field_row(o, o->wet_now, y), *around = field_row(o, o->around_now, y);
    const double pace = o->config.air.settling * 4 * p->density,
                 lift = o->config.air.settling * 0.4 / p->staining,
                 hollows = p->granulation * 0.6;
    const float weight = (float)fmax(p->weight[0], p->weight[1]),
                up_slope = (float)(lift * hollows), up_base = (float)(lift * (1 - hollows)),
                down_slope = (float)(-pace * hollows), down_base = (float)pace,
                to_unit = (float)(1 / UNIT);
    const bool up_cut = lift * (1 - hollows) > 1 || lift * hollows + lift * (1 - hollows) > 1,
               down_cut = pace > 1 || -pace * hollows + pace > 1;
    const float still = (float)(-8.0 * o->config.air.film);
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float s = surface[x], i = infused[x], f = fixed[x];
        float moved = whole_of(part_row[x] * weight * s, s);
        s -= moved;
        i += moved;
        float slow = least(water[x] * to_unit, 1.0f),
              thin = least(greatest(slow + still, 0.0f) * 4.0f, 1.0f);
        float covered = greatest(wet[x] * 4.0f + -3.0f, 0.0f);
        thin *= covered;
        slow = slow * -0.75f + 1.0f;
        float dry = 1.0f - least(water[x], 1.0f);
        slow *= greatest(covered, dry);
        slow /= stirred[x];
        float up = (height[x] * up_slope + up_base) * thin;
        up = up_cut ? least(up, 1.0f) : up;
        float inside = greatest(around[x] * 4.0f + -3.0f, 0.0f);
        float lifted = whole_of(up * i * inside, i);
        i -= lifted;
        up = whole_of(up * f, f);
        f -= up;
        up += lifted;
        float rate = (height[x] * down_slope + down_base) * slow;
        rate = down_cut ? least(rate, 1.0f) : rate;
        float seeped = whole_of(rate * 0.1f * i * dry, i);
        i -= seeped;
        f += seeped;
        rate = whole_of(greatest(rate, dry) * s, s);
        s -= rate;
        f += rate;
        s += up;
        surface[x] = s;
        infused[x] = i;
        fixed[x] = f;
    }
}

static void drying_own(const struct paper_openmp *o, int y)
{
    const int width = o->config.width;
    const double grains = o->config.air.humidity * UNIT;
    float *surface = field_row(o, F_SURFACE_WATER, y), *water = field_row(o, F_WATER, y);
    const float *wet = field_row(o, o->wet_now, y);
    uint32_t *dried = (uint32_t *)(void *)field_row(o, F_DRIED, y);
    const float all = (float)grains, fibers = (float)(grains * 0.25);
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float s = surface[x], w = water[x], dry = 1.0f - least(s, 1.0f);
        float above = whole_of(least(wet[x] * all + 4.0f, s), s);
        float below = whole_of(least(dry * fibers, w), w);
        surface[x] = s - above;
        water[x] = w - below;
        dried[x] =
            (dried[x] + (uint32_t)(int32_t)above + (uint32_t)(int32_t)below) & 0x7fffffffu;
    }
}

/* As model/soak.c has it. */
static double edge_length(const struct paper_openmp *o)
{
    const double width = o->config.air.edge_width;
    return fmax(1, 1.6 * width - 2.5);
}

static void around_own(const struct paper_openmp *o, int y)
{
    const struct paper_air *air = &o->config.air;
    const int width = o->config.width, reach = (int)fmax(1, floor(air->edge_width * 0.1875));
    const double wide = edge_length(o), spread = (1 + reach * reach) / 8.0,
                 relax = spread / (wide * wide + spread);
    const float *here = field_row(o, o->around_now, y),
                *up = field_row(o, o->around_now, y + 1),
                *down = field_row(o, o->around_now, y - 1),
                *far_up = field_row(o, o->around_now, y + reach),
                *far_down = field_row(o, o->around_now, y - reach),
                *wet = field_row(o, o->wet_now, y);
    float *to = field_row(o, o->around_next, y);
    const float stay = (float)(0.125 * (1 - relax)), follow = (float)relax,
                tail = (float)(-0.01 * relax);
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float near = (up[x] + down[x]) + (here[x + 1] + here[x - 1]);
        float far = (far_up[x] + far_down[x]) + (here[x + reach] + here[x - reach]);
        to[x] = greatest((far + near) * stay + wet[x] * follow + tail, 0.0f);
    }
}

static void edge_own(const struct paper_openmp *o, int y)
{
    const struct paper_air *air = &o->config.air;
    const int width = o->config.width;
    const float *surface = field_row(o, F_SURFACE_WATER, y), *water = field_row(o, F_WATER, y),
                *capacity = field_row(o, F_CAPACITY, y), *sizing = field_row(o, F_SIZING, y),
                *height = field_row(o, F_HEIGHT, y), *wet = field_row(o, o->wet_now, y),
                *up = field_row(o, o->wet_now, y + 1), *down = field_row(o, o->wet_now, y - 1),
                *around = field_row(o, o->around_next, y);
    float *to = field_row(o, o->wet_next, y), *depth = term_row(o, T_DEPTH, y),
          *level = term_row(o, T_LEVEL, y), *deep = term_row(o, T_DEEP, y),
          *inverse = term_row(o, T_INVERSE, y), *swirled = term_row(o, T_SWIRLED, y),
          *saturated = term_row(o, T_SATURATED, y);
    const double most = 0.3;
    const float unit = (float)UNIT, to_unit = (float)(1 / UNIT), help = (float)(-most / 16),
                least_depth = (float)(4 / UNIT), pinning = (float)(4.375 * air->pinning),
                film = (float)(1 / air->film), relief = (float)air->relief,
                helped = (float)(1 + most / 4);
    const float still = (float)(-4.0 * air->film);
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float h = surface[x] * to_unit, full = water[x] / (capacity[x] * unit);
        float corners = (down[x - 1] + up[x + 1]) + (down[x + 1] + up[x - 1]);
        float near = ((wet[x - 1] + wet[x + 1]) + (down[x] + up[x])) * 2.0f + corners;
        float help_here = greatest((near + wet[x] * 4.0f) * help + helped, 0.1f);
        help_here = least(help_here, greatest(near * -0.5f + 6.0f, 0.0f));
        float advance = sizing[x] * pinning * help_here;
        float damp = least(full, 1.0f);
        damp *= damp;
        advance *= greatest(
            (around[x] * -2.0f + 1.0f) * greatest(damp * -16.0f + 1.0f, 0.0f) + 1.0f, 0.1f);
        advance *= damp * -0.85f + 1.0f;
        float pressing = around[x] * -1.0f + 2.0f;
        advance = greatest(advance / pressing, 1e-3f);
        float part = least(h * film, wet[x]);
        part = least(greatest(part, h / advance), 1.0f);
        float high = (advance * 0.015625f + h) / (part + 0.015625f);
        to[x] = part;
        depth[x] = h;
        saturated[x] = full;
        deep[x] = high * least(part * 8.0f, 1.0f);
        level[x] = high * pressing + height[x] * relief;
        inverse[x] = 1.0f / greatest(h, least_depth);
        float inside = greatest(around[x] * 2.0f + -1.0f, 0.0f);
        swirled[x] = inside * inside * greatest(h + still, 0.0f);
    }
}

static void pores_own(const struct paper_openmp *o, int y)
{
    const int width = o->config.width;
    const float *water = field_row(o, F_WATER, y), *capacity = field_row(o, F_CAPACITY, y),
                *absorbency = field_row(o, F_ABSORBENCY, y),
                *saturated = term_row(o, T_SATURATED, y);
    float *load = term_row(o, T_LOAD, y), *room = term_row(o, T_ROOM, y),
          *left = term_row(o, T_LEFT, y), *threshold = term_row(o, T_THRESHOLD, y),
          *thin = term_row(o, T_THIN, y);
    const float unit = (float)UNIT, most = (float)(15 * UNIT), from = (float)(1 / (13 * UNIT));
#pragma omp simd
    for (int x = 0; x < width; x++) {
        room[x] = within((most - load[x]) * from, 0.0f, 1.0f);
        left[x] = greatest((capacity[x] * unit - water[x]) * 0.25f, 0.0f);
        threshold[x] = within(absorbency[x] * -4.5f + 2.1f, 0.05f, 0.98f) *
                       greatest(saturated[x] * -16.0f + 1.0f, 0.0f);
        thin[x] = 1.0f / greatest(water[x], 1.0f);
    }
}

/* What the fiber holds after it has dried. */
static void load_own(const struct paper_openmp *o, int y)
{
    memcpy(term_row(o, T_LOAD, y), field_row(o, F_SURFACE_WATER, y),
           (size_t)o->config.width * sizeof(float));
    for (int i = 0; i < o->config.pigments_count; i++) {
        const float *surface = field_row(o, F_PIGMENTS + 3 * i, y),
                    *infused = field_row(o, F_PIGMENTS + 3 * i + 1, y),
                    *fixed = field_row(o, F_PIGMENTS + 3 * i + 2, y);
        float *load = term_row(o, T_LOAD, y);
#pragma omp simd
        for (int x = 0; x < o->config.width; x++)
            load[x] = load[x] + fixed[x] + infused[x] + surface[x];
    }
}

static void own_part(const struct paper_openmp *o, int y)
{
    water_own(o, y);
    stirred_own(o, y);
    for (int i = 0; i < o->config.pigments_count; i++)
        pigment_own(o, y, i);
    if (o->config.air.humidity > 0)
        drying_own(o, y);
    load_own(o, y);
    around_own(o, y);
    edge_own(o, y);
    pores_own(o, y);
    for (int i = T_ROOM; i < T_FACES; i++)
        margins_fill(term_row(o, i, y), o->config.width, 1);
    margins_fill(field_row(o, o->around_next, y), o->config.width, FAR);
    margins_fill(field_row(o, o->wet_next, y), o->config.width, 1);
    for (int i = 0; i < o->flowing; i++)
        margins_fill(field_row(o, flow_field(i), y), o->config.width, 1);
}

/* ---- faces ---- */

INLINE float gate(float from, float to)
{
    float full = from * 4.0f + -3.0f;
    return within(greatest((to - from) * 4.0f + 1.0f, full), 0.0f, 1.0f) *
           least(from * 8.0f, 1.0f);
}

/* The stream function at the corners above row y. */
static void corners_make(const struct paper_openmp *o, int y, float *q)
{
    const float *here = term_row(o, T_SWIRLED, y), *next = term_row(o, T_SWIRLED, y + 1),
                *swirl = field_row(o, F_SWIRL, y);
#pragma omp simd
    for (int x = -1; x < o->config.width; x++)
        q[x] = least(least(here[x], here[x + 1]), least(next[x], next[x + 1])) * swirl[x];
}

/* As model/film.c has it. */
static double edge_pull(const struct paper_openmp *o)
{
    const struct paper_air *air = &o->config.air;
    const double length = edge_length(o);
    return air->edge * (0.05 * air->humidity * length * length + 0.004 * sqrt(length));
}

/* Over the faces of an axis (0: x) of row y; step fibers lie between both sides. */
INLINE void film_faces(const struct paper_openmp *o, int y, int axis, const float *eddies)
{
    const struct paper_air *air = &o->config.air;
    const int step = axis == 0, up = y + (axis == 1);
    const float *level = term_row(o, T_LEVEL, y), *level2 = term_row(o, T_LEVEL, up) + step,
                *deep = term_row(o, T_DEEP, y), *deep2 = term_row(o, T_DEEP, up) + step,
                *depth = term_row(o, T_DEPTH, y), *depth2 = term_row(o, T_DEPTH, up) + step,
                *inverse = term_row(o, T_INVERSE, y),
                *inverse2 = term_row(o, T_INVERSE, up) + step, *room = term_row(o, T_ROOM, y),
                *room2 = term_row(o, T_ROOM, up) + step, *wet = field_row(o, o->wet_next, y),
                *wet2 = field_row(o, o->wet_next, up) + step,
                *around = field_row(o, o->around_next, y),
                *around2 = field_row(o, o->around_next, up) + step,
                *ease_row = field_row(o, F_EASE_X + axis, y),
                *face = field_row(o, F_FACE_X + axis, y);
    float *speed = field_row(o, F_SPEED_X + axis, y),
          *water_out = term_row(o, T_FACES + 6 * axis, y),
          *water_in = term_row(o, T_FACES + 6 * axis + 1, y),
          *pigment_out = term_row(o, T_FACES + 6 * axis + 2, y),
          *pigment_in = term_row(o, T_FACES + 6 * axis + 3, y);
    const float gravity = (float)air->gravity[axis], pull = 0.3f,
                spread = (float)(2.0 * air->spread), edge = (float)edge_pull(o), bent = 12.0f,
                still = (float)(-4.0 * air->film), carries = (float)(0.5 / air->film);
#pragma omp simd
    for (int x = 0; x < o->config.width; x++) {
        float drive = (level[x] - level2[x] + gravity) * pull;
        float high = greatest(deep[x], deep2[x]);
        float ease = least(ease_row[x] * spread * high * high, 4.0f);
        high = high * 1.5f + 1.0f;
        float u = (speed[x] * high + drive) * ease / ((ease + pull) * high);
        u = greatest(least(u, 0.14f), -0.14f);
        float out = greatest(u * gate(wet[x], wet2[x]) + -1e-5f, 0.0f),
              in = least(u * gate(wet2[x], wet[x]) + 1e-5f, 0.0f);
        speed[x] = out + in;
        water_out[x] = out * room2[x];
        water_in[x] = in * room[x];
        float net = out * depth[x] + in * depth2[x];
        net *= within(greatest(depth[x], depth2[x]) * carries + -0.5f, 0.0f, 1.0f);
        net += eddies[x];
        float both = least(depth[x], depth2[x]);
        both = greatest(both + still, 0.0f);
        both *= least(face[x] * 1e6f, 1.0f);
        float within_edge = greatest(around[x] + around2[x] + -1.0f, 0.0f);
        net += (around[x] - around2[x]) * edge * within_edge *
               (within_edge * within_edge * bent + 1.0f) * both;
        float mixed = both * 0.06f;
        pigment_out[x] = least((greatest(net, 0.0f) + mixed) * inverse[x], 0.2f) * room2[x];
        pigment_in[x] = greatest((least(net, 0.0f) - mixed) * inverse2[x], -0.2f) * room[x];
    }
    margins_fill(speed, o->config.width, 1);
}

INLINE void fiber_faces(const struct paper_openmp *o, int y, int axis)
{
    const struct paper_air *air = &o->config.air;
    const int step = axis == 0, up = y + (axis == 1);
    const float *full = term_row(o, T_SATURATED, y),
                *full2 = term_row(o, T_SATURATED, up) + step,
                *threshold = term_row(o, T_THRESHOLD, y),
                *threshold2 = term_row(o, T_THRESHOLD, up) + step,
                *left = term_row(o, T_LEFT, y), *left2 = term_row(o, T_LEFT, up) + step,
                *thin = term_row(o, T_THIN, y), *thin2 = term_row(o, T_THIN, up) + step,
                *room = term_row(o, T_ROOM, y), *room2 = term_row(o, T_ROOM, up) + step,
                *water = field_row(o, F_WATER, y), *water2 = field_row(o, F_WATER, up) + step,
                *capacity = field_row(o, F_CAPACITY, y),
                *capacity2 = field_row(o, F_CAPACITY, up) + step,
                *face = field_row(o, F_FACE_X + axis, y);
    float *creep = term_row(o, T_CREEP_X + axis, y),
          *out_row = term_row(o, T_FACES + 6 * axis + 4, y),
          *in_row = term_row(o, T_FACES + 6 * axis + 5, y);
    const float seep = (float)(air->seep[axis] / 2), most = (float)(0.8 * UNIT),
                carried = (float)fmin(1, 3 * air->carry),
                spreading = (float)((1 - air->carry) * 0.05 / UNIT);
    const bool seeps = air->seep[axis] != 0;
#pragma omp simd
    for (int x = 0; x < o->config.width; x++) {
        float slope = full[x] - full2[x];
        slope = seeps ? slope + (full[x] + full2[x]) * seep : slope;
        float rise = within((full[x] - threshold2[x]) * 8.0f, 0.0f, 1.0f) * full[x],
              fall = within((full2[x] - threshold[x]) * 8.0f, 0.0f, 1.0f) * full2[x];
        float flow = rise * greatest(slope, 0.0f) + fall * least(slope, 0.0f);
        flow = flow * face[x] * (least(capacity2[x], capacity[x]) * most);
        flow = least(least(flow, left2[x]), water[x] * 0.125f);
        flow = greatest(greatest(flow, -left[x]), water2[x] * -0.125f);
        flow = whole(flow);
        creep[x] = flow;
        float spread = least(water[x], water2[x]) * spreading * face[x];
        out_row[x] =
            least(greatest(flow, 0.0f) * thin[x] * carried + spread, 0.125f) * room2[x];
        in_row[x] =
            greatest(least(flow, 0.0f) * thin2[x] * carried - spread, -0.125f) * room[x];
    }
}

static void faces_of(const struct paper_openmp *o, int y)
{
    const int width = o->config.width;
    float *q = term_row(o, T_CORNERS, y), *below = term_row(o, T_BELOW, y),
          *along = term_row(o, T_ALONG, y);
    corners_make(o, y, q);
    corners_make(o, y - 1, below);
#pragma omp simd
    for (int x = 0; x < width; x++)
        below[x] = q[x] - below[x];
#pragma omp simd
    for (int x = 0; x < width; x++)
        along[x] = q[x - 1] - q[x];
    film_faces(o, y, 0, below);
    film_faces(o, y, 1, along);
    fiber_faces(o, y, 0);
    fiber_faces(o, y, 1);
    for (int i = T_FACES; i < T_TERMS; i++)
        margins_fill(term_row(o, i, y), width, 1);
}

/* ---- flows ---- */

/* What goes over the faces of an axis of row y, and WHOLE more where it is made of parts. */
INLINE void over_make(const struct paper_openmp *o, int y, int axis, int q, float *over,
                      int first)
{
    const int step = axis == 0, up = y + (axis == 1), kind = q == 0 ? 0 : q % 2 ? 4 : 2;
    const float *amount = field_row(o, flow_field(q), y),
                *amount2 = field_row(o, flow_field(q), up) + step,
                *out = term_row(o, T_FACES + 6 * axis + kind, y),
                *in = term_row(o, T_FACES + 6 * axis + kind + 1, y);
    const float weight =
        q > 1 && q % 2 ? (float)o->config.pigments[(q - 2) / 2].weight[axis] : 1.0f;
    if (q == 1) {
        memcpy(over + first, term_row(o, T_CREEP_X + axis, y) + first,
               (size_t)(o->config.width - first) * sizeof *over);
        return;
    }
#pragma omp simd
    for (int x = first; x < o->config.width; x++)
        over[x] = greatest(amount[x] + -4.0f, 0.0f) * (out[x] * weight) +
                  greatest(amount2[x] + -4.0f, 0.0f) * (in[x] * weight) + WHOLE;
}

static void amount_take(const struct paper_openmp *o, int y, int q, float *along)
{
    float *amount = field_row(o, flow_field(q), y);
    const float *up = term_row(o, T_UP + q, y), *down = term_row(o, T_UP + q, y - 1);
    over_make(o, y, 0, q, along, -1);
#pragma omp simd
    for (int x = 0; x < o->config.width; x++)
        amount[x] += (down[x] - up[x]) + (along[x - 1] - along[x]);
}

static void step(struct paper_openmp *o)
{
    const int height = o->config.height;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; y++)
        own_part(o, y);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; y++)
        faces_of(o, y);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; y++)
        for (int q = 0; q < o->flowing; q++)
            over_make(o, y, 1, q, term_row(o, T_UP + q, y), 0);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; y++)
        for (int q = 0; q < o->flowing; q++)
            amount_take(o, y, q, term_row(o, T_CORNERS, y));
    int wet = o->wet_now, around = o->around_now;
    o->wet_now = o->wet_next;
    o->wet_next = wet;
    o->around_now = o->around_next;
    o->around_next = around;
}

void paper_openmp_steps(struct paper_openmp *o, int steps_count)
{
    for (int i = 0; i < steps_count; i++)
        step(o);
}

/* ---- what does not change ---- */

/* Each fiber as wet as its water says; faces and corners. */
void paper_openmp_flow_start(struct paper_openmp *o)
{
    const int width = o->config.width, height = o->config.height;
    const float wetted = (float)(1 / (0.04 * UNIT));
    for (int y = 0; y < height; y++) {
        const float *surface = field_row(o, F_SURFACE_WATER, y);
        for (int x = 0; x < width; x++) {
            float wet = least(surface[x] * wetted, 1.0f);
            field_row(o, o->wet_now, y)[x] = wet;
            field_row(o, o->around_now, y)[x] = wet;
        }
        margins_fill(field_row(o, o->wet_now, y), width, 1);
        margins_fill(field_row(o, o->around_now, y), width, FAR);
    }
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int x2 = (x + 1) % width, y2 = (y + 1) % height;
            const float *face_x = field_row(o, F_FACE_X, y),
                        *face_y = field_row(o, F_FACE_Y, y),
                        *face_x2 = field_row(o, F_FACE_X, y2),
                        *sizing = field_row(o, F_SIZING, y),
                        *sizing2 = field_row(o, F_SIZING, y2),
                        *current = field_row(o, F_CURRENT, y),
                        *current2 = field_row(o, F_CURRENT, y2);
            field_row(o, F_EASE_X, y)[x] =
                least(face_x[x] * 1e6f, 1.0f) / (sizing[x] + sizing[x2]);
            field_row(o, F_EASE_Y, y)[x] =
                least(face_y[x] * 1e6f, 1.0f) / (sizing[x] + sizing2[x]);
            float sum = (current[x] + current2[x2]) + (current2[x] + current[x2]);
            sum *= (float)(1.5 / 4);
            sum *= least(face_y[x] * 1e6f, 1.0f) * least(face_y[x2] * 1e6f, 1.0f) *
                   least(face_x[x] * 1e6f, 1.0f) * least(face_x2[x] * 1e6f, 1.0f);
            field_row(o, F_SWIRL, y)[x] = sum;
        }
    for (int y = 0; y < height; y++) {
        margins_fill(field_row(o, F_SWIRL, y), width, 1);
        margins_fill(field_row(o, F_CAPACITY, y), width, 1);
    }
}
