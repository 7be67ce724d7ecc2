/* members.c - the rows of arguments/members.h, and checking by them. */
#include "arguments/members.h"

#include "arguments/arguments.h"
#include "base/base.h"

#define PLACE_MAX 1e6
#define TIME_MAX 1e5
#define TILT_MAX 1.5

static const struct member air_rows[] = {
    MEMBER(paper_air, gravity[0], DOUBLE, 1, PULL, "gravity along x", -1, 1),
    MEMBER(paper_air, gravity[1], DOUBLE, 1, PULL, "gravity along y", -1, 1),
    MEMBER(paper_air, seep[0], DOUBLE, 1, PULL, "seep along x", -1, 1),
    MEMBER(paper_air, seep[1], DOUBLE, 1, PULL, "seep along y", -1, 1),
    MEMBER(paper_air, spread, DOUBLE, 1, SPREAD, "spread", 0, 1),
    MEMBER(paper_air, tension, DOUBLE, 1, NOT, "tension", 0, 0.1),
    MEMBER(paper_air, relief, DOUBLE, 1, NOT, "relief", 0, 1),
    MEMBER(paper_air, film, DOUBLE, 1, NOT, "film", 0.001, 1),
    MEMBER(paper_air, pinning, DOUBLE, 1, NOT, "pinning", 0, 2),
    MEMBER(paper_air, damp, DOUBLE, 1, NOT, "damp", 0, 1),
    MEMBER(paper_air, absorption, DOUBLE, 1, RATE, "absorption", 0, 4),
    MEMBER(paper_air, carry, DOUBLE, 1, NOT, "carry", 0, 1),
    MEMBER(paper_air, humidity, DOUBLE, 1, RATE, "humidity", 0, 1),
    MEMBER(paper_air, edge, DOUBLE, 1, NOT, "edge", 0, 200),
    MEMBER(paper_air, edge_width, DOUBLE, 1, LENGTH, "edge_width", 1, 32),
    MEMBER(paper_air, settling, DOUBLE, 1, RATE, "settling", 0, 10),
    HELD(paper_air, thesis.gravity_x, DOUBLE, 1), /* paper_weather_check() */
    HELD(paper_air, thesis.gravity_y, DOUBLE, 1),
    MEMBER(paper_air, thesis.humidity, DOUBLE, 1, RATE, NULL, 0, 1),
    HELD(paper_air, thesis.molecular_weight, DOUBLE, 3),
};

static const struct member stock_rows[] = {
    HELD(paper_stock, name, TEXT, PAPER_NAME_MAX),
    MEMBER(paper_stock, color[0], DOUBLE, 1, NOT, "red", 0, 1),
    MEMBER(paper_stock, color[1], DOUBLE, 1, NOT, "green", 0, 1),
    MEMBER(paper_stock, color[2], DOUBLE, 1, NOT, "blue", 0, 1),
    MEMBER(paper_stock, color_variation, DOUBLE, 1, NOT, "color_variation", 0, 1),
    MEMBER(paper_stock, absorbency, DOUBLE, 1, SPREAD, "absorbency", 0, PAPER_ABSORBENCY_MAX),
    MEMBER(paper_stock, absorbency_variation, DOUBLE, 1, NOT, "absorbency_variation", 0, 1),
    MEMBER(paper_stock, absorbency_along[0], DOUBLE, 1, NOT, "absorbency_along x", 0, 1),
    MEMBER(paper_stock, absorbency_along[1], DOUBLE, 1, NOT, "absorbency_along y", 0, 1),
    MEMBER(paper_stock, capacity[0], DOUBLE, 1, NOT, "least capacity", 0.01, 1),
    MEMBER(paper_stock, capacity[1], DOUBLE, 1, NOT, "most capacity", 0.01, 1),
    MEMBER(paper_stock, roughness, DOUBLE, 1, NOT, "roughness", 0, 1),
    MEMBER(paper_stock, grain_px, DOUBLE, 1, LENGTH, "grain", 1, 64),
    MEMBER(paper_stock, fiber_length[0], INT, 1, LENGTH, "fiber length along x", 1, 64),
    MEMBER(paper_stock, fiber_length[1], INT, 1, LENGTH, "fiber length along y", 1, 64),
};

static const struct member pigment_rows[] = {
    HELD(paper_pigment, name, TEXT, PAPER_NAME_MAX),
    MEMBER(paper_pigment, weight[0], DOUBLE, 1, NOT, "weight along x", 0, 1),
    MEMBER(paper_pigment, weight[1], DOUBLE, 1, NOT, "weight along y", 0, 1),
    MEMBER(paper_pigment, density, DOUBLE, 1, NOT, "density", 0, 1),
    MEMBER(paper_pigment, staining, DOUBLE, 1, NOT, "staining", 0.5, 100),
    MEMBER(paper_pigment, granulation, DOUBLE, 1, NOT, "granulation", 0, 1),
    MEMBER(paper_pigment, k[0], DOUBLE, 1, NOT, "red absorption", 0, 100),
    MEMBER(paper_pigment, k[1], DOUBLE, 1, NOT, "green absorption", 0, 100),
    MEMBER(paper_pigment, k[2], DOUBLE, 1, NOT, "blue absorption", 0, 100),
    MEMBER(paper_pigment, s[0], DOUBLE, 1, NOT, "red scattering", 0, 100),
    MEMBER(paper_pigment, s[1], DOUBLE, 1, NOT, "green scattering", 0, 100),
    MEMBER(paper_pigment, s[2], DOUBLE, 1, NOT, "blue scattering", 0, 100),
    MEMBER(paper_pigment, takes[0], DOUBLE, 1, NOT, "part of red", -1, 1),
    MEMBER(paper_pigment, takes[1], DOUBLE, 1, NOT, "part of green", -1, 1),
    MEMBER(paper_pigment, takes[2], DOUBLE, 1, NOT, "part of blue", -1, 1),
};

/* Amounts of water and pigments are checked where messages can name the pigment. */
static const struct member put_rows[] = {
    HELD(event_put, place, PLACE, 1),
    HELD(event_put, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member blot_rows[] = {
    HELD(event_blot, place, PLACE, 1),
    MEMBER(event_blot, part, DOUBLE, 1, NOT, "part", 0, 1),
    MEMBER(event_blot, lift, DOUBLE, 1, NOT, "lift", 0, 1),
};
static const struct member resist_rows[] = {
    HELD(event_resist, place, PLACE, 1),
    HELD(event_resist, on, FLAG, 1),
};
static const struct member layer_rows[] = {
    HELD(event_layer, layer, INT, 1),
    HELD(event_layer, pigment, INT, 1),
    HELD(event_layer, values, PLANE, 1),
};

static const struct member brush_rows[] = {
    MEMBER(paper_brush, number, INT, 1, NOT, "number", 0, PAPER_BRUSHES_MAX - 1),
    MEMBER(paper_brush, bristles, INT, 1, NOT, "bristles", 1, PAPER_BRISTLES_MAX),
    MEMBER(paper_brush, width, DOUBLE, 1, LENGTH, "width", 1, 1000),
    MEMBER(paper_brush, depth, DOUBLE, 1, LENGTH, "depth", 1, 1000),
    MEMBER(paper_brush, angle, DOUBLE, 1, NOT, "angle", -1000, 1000),
    HELD(paper_brush, follows, FLAG, 1),
    HELD(paper_brush, flat, FLAG, 1),
    MEMBER(paper_brush, point, DOUBLE, 1, NOT, "point", 0, 1),
    MEMBER(paper_brush, uneven, DOUBLE, 1, NOT, "uneven", 0, 1),
    MEMBER(paper_brush, splay, DOUBLE, 1, NOT, "splay", 0, 2),
    MEMBER(paper_brush, bend, DOUBLE, 1, NOT, "bend", 0, 2),
    MEMBER(paper_brush, thickness, DOUBLE, 1, LENGTH, "thickness", 0, 100),
    MEMBER(paper_brush, reach, DOUBLE, 1, LENGTH, "reach", 1, 1e6),
    MEMBER(paper_brush, load, DOUBLE, 1, NOT, "load", 0.01, 2),
    MEMBER(paper_brush, flow, DOUBLE, 1, NOT, "flow", 0, 1e6),
    MEMBER(paper_brush, mixing, DOUBLE, 1, NOT, "mixing", 0, 1),
    HELD(paper_brush, seed, WORD, 1),
    HELD(paper_brush, mirrored, FLAG, 1),
};
static const struct member dip_rows[] = {
    HELD(paper_dip, number, INT, 1),
    MEMBER(paper_dip, part, DOUBLE, 1, NOT, "part", 0, 1),
    MEMBER(paper_dip, side, DOUBLE, 2, NOT, "side", -1, 1),
    HELD(paper_dip, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member stroke_rows[] = {
    HELD(paper_stroke, number, INT, 1),
    MEMBER(paper_stroke, pace, DOUBLE, 1, PACE, "pace", 0, 10000),
    HELD(paper_stroke, samples, SAMPLES, 1),
};
static const struct member sample_rows[] = {
    MEMBER(paper_stroke_sample, time_s, DOUBLE, 1, NOT, "time", 0, TIME_MAX),
    MEMBER(paper_stroke_sample, x, DOUBLE, 1, LENGTH, "x", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_stroke_sample, y, DOUBLE, 1, LENGTH, "y", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_stroke_sample, pressure, DOUBLE, 1, NOT, "pressure", 0, 1),
    MEMBER(paper_stroke_sample, tilt_x, DOUBLE, 1, NOT, "tilt along x", -TILT_MAX, TILT_MAX),
    MEMBER(paper_stroke_sample, tilt_y, DOUBLE, 1, NOT, "tilt along y", -TILT_MAX, TILT_MAX),
};
static const struct member salt_rows[] = {
    HELD(paper_salt, place, PLACE, 1),
    MEMBER(paper_salt, x, DOUBLE, 1, LENGTH, "x", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_salt, y, DOUBLE, 1, LENGTH, "y", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_salt, radius, DOUBLE, 1, LENGTH, "radius", 0, 1e5),
    MEMBER(paper_salt, grains, INT, 1, NOT, "grains", 1, 100000),
    MEMBER(paper_salt, size[0], DOUBLE, 1, LENGTH, "least size", 0.1, 50),
    MEMBER(paper_salt, size[1], DOUBLE, 1, LENGTH, "most size", 0.1, 50),
    MEMBER(paper_salt, strength, DOUBLE, 1, NOT, "strength", 0, 4),
    MEMBER(paper_salt, reach, DOUBLE, 1, LENGTH, "reach", 1, 100),
    HELD(paper_salt, seed, WORD, 1),
};
static const struct member wash_rows[] = {
    HELD(paper_wash, place, PLACE, 1),
    MEMBER(paper_wash, from, DOUBLE, 2, LENGTH, "beginning", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_wash, to, DOUBLE, 2, LENGTH, "end", -PLACE_MAX, PLACE_MAX),
    HELD(paper_wash, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
    HELD(paper_wash, end, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member print_rows[] = {HELD(paper_print, amount, AMOUNTS, 1)};
static const struct member lift_rows[] = {
    HELD(paper_lift, place, PLACE, 1),
    MEMBER(paper_lift, part, DOUBLE, 1, NOT, "part", 0, 1),
};
static const struct member varnish_rows[] = {
    HELD(paper_varnish, place, PLACE, 1),
    MEMBER(paper_varnish, amount, DOUBLE, 1, NOT, "amount", 0, 1),
};

const struct members event_air_members = MEMBERS_OF(air_rows),
                     event_stock_members = MEMBERS_OF(stock_rows),
                     event_pigment_members = MEMBERS_OF(pigment_rows),
                     event_put_members = MEMBERS_OF(put_rows),
                     event_blot_members = MEMBERS_OF(blot_rows),
                     event_resist_members = MEMBERS_OF(resist_rows),
                     event_layer_members = MEMBERS_OF(layer_rows),
                     event_brush_members = MEMBERS_OF(brush_rows),
                     event_dip_members = MEMBERS_OF(dip_rows),
                     event_stroke_members = MEMBERS_OF(stroke_rows),
                     event_sample_members = MEMBERS_OF(sample_rows),
                     event_salt_members = MEMBERS_OF(salt_rows),
                     event_wash_members = MEMBERS_OF(wash_rows),
                     event_print_members = MEMBERS_OF(print_rows),
                     event_lift_members = MEMBERS_OF(lift_rows),
                     event_varnish_members = MEMBERS_OF(varnish_rows);

enum paper_status event_members_check(const struct members *members, const void *of,
                                      const char *whose, const char *where)
{
    for (const struct member *m = members->first; m < members->first + members->count; m++) {
        const void *start = (const char *)of + m->offset;
        for (int i = 0; m->name && i < m->count; i++) {
            double value = m->kind == MEMBER_INT ? (double)((const int *)start)[i]
                                                 : ((const double *)start)[i];
            if (!paper_within(value, m->least, m->most))
                return paper_fail(PAPER_BAD_ARGUMENT, "%s%s must be %g..%g (got %g%s)", whose,
                                  m->name, m->least, m->most, value, where);
        }
    }
    return PAPER_OK;
}
