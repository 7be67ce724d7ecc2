/* rows.c - the rows of arguments/rows.h. */
#include "arguments/rows.h"

#include "arguments/forms.h"
#include "base/base.h"

#define PLACE_MAX 1e6

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
    KEPT(paper_air, thesis.gravity_x, DOUBLE, 1), /* paper_weather_check() */
    KEPT(paper_air, thesis.gravity_y, DOUBLE, 1),
    MEMBER(paper_air, thesis.humidity, DOUBLE, 1, RATE, NULL, 0, 1),
    KEPT(paper_air, thesis.molecular_weight, DOUBLE, 3),
};

static const struct member stock_rows[] = {
    KEPT(paper_stock, name, TEXT, PAPER_NAME_MAX),
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
    KEPT(paper_pigment, name, TEXT, PAPER_NAME_MAX),
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
    FORM(event_put, place, place_form),
    KEPT(event_put, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member blot_rows[] = {
    FORM(event_blot, place, place_form),
    MEMBER(event_blot, part, DOUBLE, 1, NOT, "part", 0, 1),
    MEMBER(event_blot, lift, DOUBLE, 1, NOT, "lift", 0, 1),
};
static const struct member resist_rows[] = {
    FORM(event_resist, place, place_form),
    KEPT(event_resist, on, FLAG, 1),
};
static const struct member layer_rows[] = {
    KEPT(event_layer, layer, INT, 1),
    KEPT(event_layer, pigment, INT, 1),
    FORM(event_layer, values, plane_form),
};

static const struct member brush_rows[] = {
    MEMBER(paper_brush, number, INT, 1, NOT, "number", 0, PAPER_BRUSHES_MAX - 1),
    MEMBER(paper_brush, bristles, INT, 1, NOT, "bristles", 1, PAPER_BRISTLES_MAX),
    MEMBER(paper_brush, width, DOUBLE, 1, LENGTH, "width", 1, 1000),
    MEMBER(paper_brush, depth, DOUBLE, 1, LENGTH, "depth", 1, 1000),
    MEMBER(paper_brush, angle, DOUBLE, 1, NOT, "angle", -1000, 1000),
    KEPT(paper_brush, follows, FLAG, 1),
    KEPT(paper_brush, flat, FLAG, 1),
    MEMBER(paper_brush, point, DOUBLE, 1, NOT, "point", 0, 1),
    MEMBER(paper_brush, uneven, DOUBLE, 1, NOT, "uneven", 0, 1),
    MEMBER(paper_brush, splay, DOUBLE, 1, NOT, "splay", 0, 2),
    MEMBER(paper_brush, bend, DOUBLE, 1, NOT, "bend", 0, 2),
    MEMBER(paper_brush, thickness, DOUBLE, 1, LENGTH, "thickness", 0, 100),
    MEMBER(paper_brush, reach, DOUBLE, 1, LENGTH, "reach", 1, 1e6),
    MEMBER(paper_brush, load, DOUBLE, 1, NOT, "load", 0.01, 2),
    MEMBER(paper_brush, flow, DOUBLE, 1, NOT, "flow", 0, 1e6),
    MEMBER(paper_brush, mixing, DOUBLE, 1, NOT, "mixing", 0, 1),
    KEPT(paper_brush, seed, WORD, 1),
    KEPT(paper_brush, mirrored, FLAG, 1),
};
static const struct member dip_rows[] = {
    KEPT(paper_dip, number, INT, 1),
    MEMBER(paper_dip, part, DOUBLE, 1, NOT, "part", 0, 1),
    MEMBER(paper_dip, side, DOUBLE, 2, NOT, "side", -1, 1),
    KEPT(paper_dip, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member stroke_rows[] = {
    KEPT(paper_stroke, number, INT, 1),
    MEMBER(paper_stroke, pace, DOUBLE, 1, PACE, "pace", 0, 10000),
    FORM(paper_stroke, samples, samples_form),
};
static const struct member salt_rows[] = {
    FORM(paper_salt, place, place_form),
    MEMBER(paper_salt, x, DOUBLE, 1, LENGTH, "x", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_salt, y, DOUBLE, 1, LENGTH, "y", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_salt, radius, DOUBLE, 1, LENGTH, "radius", 0, 1e5),
    MEMBER(paper_salt, grains, INT, 1, NOT, "grains", 1, 100000),
    MEMBER(paper_salt, size[0], DOUBLE, 1, LENGTH, "least size", 0.1, 50),
    MEMBER(paper_salt, size[1], DOUBLE, 1, LENGTH, "most size", 0.1, 50),
    MEMBER(paper_salt, strength, DOUBLE, 1, NOT, "strength", 0, 4),
    MEMBER(paper_salt, reach, DOUBLE, 1, LENGTH, "reach", 1, 100),
    KEPT(paper_salt, seed, WORD, 1),
};
static const struct member wash_rows[] = {
    FORM(paper_wash, place, place_form),
    MEMBER(paper_wash, from, DOUBLE, 2, LENGTH, "beginning", -PLACE_MAX, PLACE_MAX),
    MEMBER(paper_wash, to, DOUBLE, 2, LENGTH, "end", -PLACE_MAX, PLACE_MAX),
    KEPT(paper_wash, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
    KEPT(paper_wash, end, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member print_rows[] = {FORM(paper_print, amount, amounts_form)};
static const struct member lift_rows[] = {
    FORM(paper_lift, place, place_form),
    MEMBER(paper_lift, part, DOUBLE, 1, NOT, "part", 0, 1),
};
static const struct member varnish_rows[] = {
    FORM(paper_varnish, place, place_form),
    MEMBER(paper_varnish, amount, DOUBLE, 1, NOT, "amount", 0, 1),
};

const struct members paper_air_members = MEMBERS_OF(air_rows),
                     paper_stock_members = MEMBERS_OF(stock_rows),
                     paper_pigment_members = MEMBERS_OF(pigment_rows),
                     paper_put_members = MEMBERS_OF(put_rows),
                     paper_blot_members = MEMBERS_OF(blot_rows),
                     paper_resist_members = MEMBERS_OF(resist_rows),
                     paper_layer_members = MEMBERS_OF(layer_rows),
                     paper_brush_members = MEMBERS_OF(brush_rows),
                     paper_dip_members = MEMBERS_OF(dip_rows),
                     paper_stroke_members = MEMBERS_OF(stroke_rows),
                     paper_salt_members = MEMBERS_OF(salt_rows),
                     paper_wash_members = MEMBERS_OF(wash_rows),
                     paper_print_members = MEMBERS_OF(print_rows),
                     paper_lift_members = MEMBERS_OF(lift_rows),
                     paper_varnish_members = MEMBERS_OF(varnish_rows);

enum paper_status paper_members_check(const struct members *members, const void *of,
                                      const char *whose, const char *where)
{
    char text[256];
    return members_check(members, of, whose, where, text, sizeof text)
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT, "%s", text);
}
