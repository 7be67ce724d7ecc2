/* rows.c - the rows of arguments/rows.h. */
#include "arguments/rows.h"

#include "arguments/forms.h"
#include "base/base.h"

#define PLACE_MAX 1e6
#define DEGREES 57.295779513082323 /* for one radian */
#define TURN_MAX (36000 / DEGREES)

static const struct member air_rows[] = {
    MEMBER(paper_air, gravity[0], DOUBLE, 1, PULL, "gravity along x", -1, 1, .field = "gravity",
           .element = 1, .usual = "0", .help = "pull on the water on the surface"),
    MEMBER(paper_air, gravity[1], DOUBLE, 1, PULL, "gravity along y", -1, 1, .field = "gravity",
           .element = 2),
    MEMBER(paper_air, seep[0], DOUBLE, 1, PULL, "seep along x", -1, 1, .field = "seep",
           .element = 1, .usual = "0", .help = "and in the fibers"),
    MEMBER(paper_air, seep[1], DOUBLE, 1, PULL, "seep along y", -1, 1, .field = "seep",
           .element = 2),
    MEMBER(paper_air, spread, DOUBLE, 1, SPREAD, "spread", 0, 1, .field = "spread",
           .usual = "1", .help = "how fast it levels out"),
    MEMBER(paper_air, relief, DOUBLE, 1, NOT, "relief", 0, 1, .field = "relief",
           .usual = "0.05", .help = "how it feels the paper's hills"),
    MEMBER(paper_air, film, DOUBLE, 1, NOT, "film", 0.001, 1, .field = "film", .usual = "0.02",
           .help = "thinner water flows slower"),
    MEMBER(paper_air, pinning, DOUBLE, 1, NOT, "pinning", 0, 2, .field = "pinning",
           .usual = "0.8", .help = "height of water that enters dry fibers; 0: flows anywhere"),
    MEMBER(paper_air, absorption, DOUBLE, 1, RATE, "absorption", 0, 4, .field = "absorption",
           .usual = "0.02", .help = "how fast it sinks in"),
    MEMBER(paper_air, carry, DOUBLE, 1, NOT, "carry", 0, 1, .field = "carry", .usual = "0.3",
           .help = "part of pigments' way in fibers that is with the flow, not along their own "
                   "gradient"),
    MEMBER(paper_air, humidity, DOUBLE, 1, RATE, "humidity", 0, 1, .field = "humidity",
           .usual = "0.0004", .help = "water that dries in a step"),
    MEMBER(paper_air, edge, DOUBLE, 1, NOT, "edge", 0, 200, .field = "edge", .usual = "15",
           .help = "how much faster the edge of what is wet dries: pigment is drawn there"),
    MEMBER(paper_air, edge_width, DOUBLE, 1, LENGTH, "edge_width", 1, 32, .field = "edge_width",
           .usual = "8", .help = "of that edge, fibers"),
    MEMBER(paper_air, settling, DOUBLE, 1, RATE, "settling", 0, 10, .field = "settling",
           .usual = "0.1", .help = "factor on density, and on lifting"),
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
    MEMBER(paper_stock, color_variation, DOUBLE, 1, NOT, "color_variation", 0, 1,
           .field = "color_variation", .usual = "the stock's",
           .help = "how far the colours of fibers differ"),
    MEMBER(paper_stock, absorbency, DOUBLE, 1, SPREAD, "absorbency", 0, PAPER_ABSORBENCY_MAX,
           .field = "absorbency", .usual = "〃",
           .help = "part of a gradient that flows across a face"),
    MEMBER(paper_stock, absorbency_variation, DOUBLE, 1, NOT, "absorbency_variation", 0, 1,
           .field = "absorbency_variation", .usual = "〃",
           .help = "how far fibers differ in it"),
    MEMBER(paper_stock, absorbency_along[0], DOUBLE, 1, NOT, "absorbency_along x", 0, 1,
           .field = "absorbency_along", .element = 1, .usual = "〃",
           .help = "factors along x and along y"),
    MEMBER(paper_stock, absorbency_along[1], DOUBLE, 1, NOT, "absorbency_along y", 0, 1,
           .field = "absorbency_along", .element = 2),
    MEMBER(paper_stock, capacity[0], DOUBLE, 1, NOT, "least capacity", 0.01, 1,
           .field = "capacity", .element = 1, .usual = "〃",
           .help = "water that fibers hold, in hollows and on hills"),
    MEMBER(paper_stock, capacity[1], DOUBLE, 1, NOT, "most capacity", 0.01, 1,
           .field = "capacity", .element = 2),
    MEMBER(paper_stock, roughness, DOUBLE, 1, NOT, "roughness", 0, 1, .field = "roughness",
           .usual = "〃", .help = "deviation of the height"),
    MEMBER(paper_stock, grain_px, DOUBLE, 1, LENGTH, "grain", 1, 64, .field = "grain",
           .usual = "〃", .help = "size of its hills"),
    MEMBER(paper_stock, fiber_length[0], INT, 1, LENGTH, "fiber length along x", 1, 64,
           .field = "fibers", .element = 1, .usual = "〃",
           .help = "lengths along x and along y"),
    MEMBER(paper_stock, fiber_length[1], INT, 1, LENGTH, "fiber length along y", 1, 64,
           .field = "fibers", .element = 2),
};

static const struct member deckle_rows[] = {
    MEMBER(paper_deckle, margin, DOUBLE, 1, LENGTH, "margin", 2, 4096, .field = "margin",
           .usual = "22", .help = "from the picture's border to the mean edge"),
    MEMBER(paper_deckle, waves, DOUBLE, 1, LENGTH, "waves", 0, 256, .field = "waves",
           .usual = "2.5", .help = "how far the edge wanders: its deviation"),
    MEMBER(paper_deckle, thin, DOUBLE, 1, LENGTH, "thin", 1, 1024, .field = "thin",
           .usual = "14", .help = "over how many fibers the sheet gets as thick as it is"),
    MEMBER(paper_deckle, fringe, DOUBLE, 1, LENGTH, "fringe", 0, 256, .field = "fringe",
           .usual = "5", .help = "how far single fibers reach over the edge"),
};

static const struct member pigment_rows[] = {
    KEPT(paper_pigment, name, TEXT, PAPER_NAME_MAX),
    MEMBER(paper_pigment, weight[0], DOUBLE, 1, NOT, "weight along x", 0, 1, .field = "weight",
           .element = 1, .usual = "like's",
           .help = "how easily it moves with water in the fibers, along x and along y"),
    MEMBER(paper_pigment, weight[1], DOUBLE, 1, NOT, "weight along y", 0, 1, .field = "weight",
           .element = 2),
    MEMBER(paper_pigment, density, DOUBLE, 1, NOT, "density", 0, 1, .field = "density",
           .usual = "〃", .help = "part that settles in a step"),
    MEMBER(paper_pigment, staining, DOUBLE, 1, NOT, "staining", 0.5, 100, .field = "staining",
           .usual = "〃", .help = "resistance to being lifted again"),
    MEMBER(paper_pigment, granulation, DOUBLE, 1, NOT, "granulation", 0, 1.6,
           .field = "granulation", .usual = "〃", .help = "how far it settles in hollows"),
    MEMBER(paper_pigment, k[0], DOUBLE, 1, NOT, "red absorption", 0, 100, .field = "K",
           .element = 1, .usual = "〃",
           .help = "Kubelka and Munk: absorption of red, green, blue"),
    MEMBER(paper_pigment, k[1], DOUBLE, 1, NOT, "green absorption", 0, 100, .field = "K",
           .element = 2),
    MEMBER(paper_pigment, k[2], DOUBLE, 1, NOT, "blue absorption", 0, 100, .field = "K",
           .element = 3),
    MEMBER(paper_pigment, s[0], DOUBLE, 1, NOT, "red scattering", 0, 100, .field = "S",
           .element = 1, .usual = "〃", .help = "and scattering"),
    MEMBER(paper_pigment, s[1], DOUBLE, 1, NOT, "green scattering", 0, 100, .field = "S",
           .element = 2),
    MEMBER(paper_pigment, s[2], DOUBLE, 1, NOT, "blue scattering", 0, 100, .field = "S",
           .element = 3),
    MEMBER(paper_pigment, takes[0], DOUBLE, 1, NOT, "part of red", -1, 1, .field = "takes",
           .element = 1, .usual = "〃",
           .help = "by the other rules: what a unit takes from red, green, blue"),
    MEMBER(paper_pigment, takes[1], DOUBLE, 1, NOT, "part of green", -1, 1, .field = "takes",
           .element = 2),
    MEMBER(paper_pigment, takes[2], DOUBLE, 1, NOT, "part of blue", -1, 1, .field = "takes",
           .element = 3),
};

#define BAND(of, number)                                                                       \
    MEMBER(paper_pigment, of[number - 1], DOUBLE, 1, NOT, #of " of band " #number, 0, 100,     \
           .field = #of, .element = number)
static const struct member bands_rows[] = {
    MEMBER(paper_pigment, absorption[0], DOUBLE, 1, NOT, "absorption of band 1", 0, 100,
           .field = "absorption", .element = 1, .usual = "like's",
           .help = "in ten bands of 35 nm, from 380 to 730 nm, in place of `K`"),
    BAND(absorption, 2),
    BAND(absorption, 3),
    BAND(absorption, 4),
    BAND(absorption, 5),
    BAND(absorption, 6),
    BAND(absorption, 7),
    BAND(absorption, 8),
    BAND(absorption, 9),
    BAND(absorption, 10),
    MEMBER(paper_pigment, scattering[0], DOUBLE, 1, NOT, "scattering of band 1", 0, 100,
           .field = "scattering", .element = 1, .usual = "〃",
           .help = "and scattering, in place of `S`"),
    BAND(scattering, 2),
    BAND(scattering, 3),
    BAND(scattering, 4),
    BAND(scattering, 5),
    BAND(scattering, 6),
    BAND(scattering, 7),
    BAND(scattering, 8),
    BAND(scattering, 9),
    BAND(scattering, 10),
    MEMBER(paper_pigment, shift, DOUBLE, 1, NOT, "shift", 0, 2, .field = "shift", .usual = "〃",
           .help = "how much more it absorbs while it is wet"),
};

/* Amounts of water and pigments are checked elsewhere, where messages can name the pigment. */
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

static const struct member bookmark_rows[] = {
    KEPT(paper_bookmark, name, TEXT, PAPER_NAME_MAX),
};

static const struct member brush_rows[] = {
    MEMBER(paper_brush, number, INT, 1, NOT, "number", 0, PAPER_BRUSHES_MAX - 1),
    MEMBER(paper_brush, bristles, INT, 1, NOT, "bristles", 1, PAPER_BRISTLES_MAX,
           .field = "bristles", .usual = "by width", .help = "how many"),
    MEMBER(paper_brush, width, DOUBLE, 1, LENGTH, "width", 1, 1000, .field = "width",
           .usual = "20", .help = "of the tuft"),
    MEMBER(paper_brush, depth, DOUBLE, 1, LENGTH, "depth", 1, 1000, .field = "depth",
           .usual = "a part of the width", .help = "of the tuft, the other way"),
    MEMBER(paper_brush, angle, DOUBLE, 1, NOT, "angle", -TURN_MAX, TURN_MAX, .field = "angle",
           .usual = "0", .per_unit = DEGREES,
           .help = "degrees that the tuft's width is turned"),
    KEPT(paper_brush, follows, FLAG, 1, .field = "follows",
         .usual = "flat, fan and bristle ones, unless they have an `angle`",
         .help = "whether it turns with the stroke"),
    KEPT(paper_brush, flat, FLAG, 1),
    MEMBER(paper_brush, point, DOUBLE, 1, NOT, "point", 0, 1, .field = "point",
           .usual = "by kind",
           .help = "outer bristles are shorter, so light pressure draws a thin line"),
    MEMBER(paper_brush, uneven, DOUBLE, 1, NOT, "uneven", 0, 1, .field = "uneven",
           .usual = "〃", .help = "how far bristles differ in length and in what they give"),
    MEMBER(paper_brush, splay, DOUBLE, 1, NOT, "splay", 0, 2, .field = "splay", .usual = "〃",
           .help = "how far pressure spreads them"),
    MEMBER(paper_brush, bend, DOUBLE, 1, NOT, "bend", 0, 2, .field = "bend", .usual = "〃",
           .help = "how far they trail behind"),
    MEMBER(paper_brush, thickness, DOUBLE, 1, LENGTH, "thickness", 0, 100, .field = "thickness",
           .usual = "〃", .help = "of a bristle"),
    MEMBER(paper_brush, reach, DOUBLE, 1, LENGTH, "reach", 1, 1e6, .field = "reach",
           .usual = "〃", .help = "about how far a full brush paints"),
    MEMBER(paper_brush, load, DOUBLE, 1, NOT, "load", 0.01, 2, .field = "load", .usual = "〃",
           .help = "water that it lays on a fiber"),
    MEMBER(paper_brush, flow, DOUBLE, 1, NOT, "flow", 0, 1e6, .field = "flow", .usual = "150",
           .help = "how fast bristles and fibers exchange, 1/s"),
    MEMBER(paper_brush, mixing, DOUBLE, 1, NOT, "mixing", 0, 1, .field = "mixing",
           .usual = "by kind", .help = "how much of it where both are as wet"),
    KEPT(paper_brush, seed, WORD, 1),
    KEPT(paper_brush, mirrored, FLAG, 1, .field = "mirrored", .usual = "false",
         .help = "left for right"),
};
static const struct member dip_rows[] = {
    KEPT(paper_dip, number, INT, 1),
    MEMBER(paper_dip, part, DOUBLE, 1, NOT, "part", 0, 1, .field = "part", .usual = "1",
           .help = "of what the bristles held that is exchanged"),
    MEMBER(paper_dip, side, DOUBLE, 2, NOT, "side", -1, 1, .field = "side", .usual = "{-1, 1}",
           .help = "which bristles, from the left to the right"),
    KEPT(paper_dip, amount, DOUBLE, 1 + PAPER_PIGMENTS_MAX),
};
static const struct member stroke_rows[] = {
    KEPT(paper_stroke, number, INT, 1),
    MEMBER(paper_stroke, pace, DOUBLE, 1, PACE, "pace", 0, 10000, .field = "pace",
           .usual = "30", .help = "steps of the paper in a second; 0: it waits"),
    FORM(paper_stroke, samples, samples_form),
};
static const struct member salt_rows[] = {
    FORM(paper_salt, place, place_form),
    MEMBER(paper_salt, x, DOUBLE, 1, LENGTH, "x", -PLACE_MAX, PLACE_MAX, .field = "x",
           .usual = "the middle", .help = "where"),
    MEMBER(paper_salt, y, DOUBLE, 1, LENGTH, "y", -PLACE_MAX, PLACE_MAX, .field = "y",
           .usual = "the middle"),
    MEMBER(paper_salt, radius, DOUBLE, 1, LENGTH, "radius", 0, 1e5, .field = "radius",
           .usual = "all of the paper", .help = "how far grains fall"),
    MEMBER(paper_salt, grains, INT, 1, NOT, "grains", 1, 100000, .field = "grains",
           .usual = "100", .help = "how many"),
    MEMBER(paper_salt, size[0], DOUBLE, 1, LENGTH, "least size", 0.1, 50, .field = "size",
           .element = 1, .usual = "{0.7, 1.6}", .help = "least and most, fibers"),
    MEMBER(paper_salt, size[1], DOUBLE, 1, LENGTH, "most size", 0.1, 50, .field = "size",
           .element = 2),
    MEMBER(paper_salt, strength, DOUBLE, 1, NOT, "strength", 0, 4, .field = "strength",
           .usual = "1", .help = "how far brine pushes pigments away"),
    MEMBER(paper_salt, reach, DOUBLE, 1, LENGTH, "reach", 1, 100, .field = "reach",
           .usual = "10", .help = "about how many fibers far"),
    KEPT(paper_salt, seed, WORD, 1),
};
static const struct member splatter_rows[] = {
    MEMBER(paper_splatter, x, DOUBLE, 1, NOT, "x", -1e6, 1e6, .field = "x",
           .usual = "the middle", .help = "where"),
    MEMBER(paper_splatter, y, DOUBLE, 1, NOT, "y", -1e6, 1e6, .field = "y",
           .usual = "the middle"),
    MEMBER(paper_splatter, radius, DOUBLE, 1, NOT, "radius", 0, 1e5, .field = "radius",
           .usual = "80", .help = "most drops fall within it"),
    MEMBER(paper_splatter, toward, DOUBLE, 1, NOT, "direction", -TURN_MAX, TURN_MAX,
           .field = "angle", .usual = "0", .per_unit = DEGREES,
           .help = "degrees of the direction that they are thrown in"),
    MEMBER(paper_splatter, thrown, DOUBLE, 1, NOT, "throw", 0, 4, .field = "thrown",
           .usual = "0", .help = "how far they fly"),
    MEMBER(paper_splatter, drops, INT, 1, NOT, "drops", 1, 100000, .field = "drops",
           .usual = "60", .help = "how many"),
    MEMBER(paper_splatter, size[0], DOUBLE, 1, NOT, "least size", 0.1, 500, .field = "size",
           .element = 1, .usual = "{0.6, 4}", .help = "least and most, fibers"),
    MEMBER(paper_splatter, size[1], DOUBLE, 1, NOT, "most size", 0.1, 500, .field = "size",
           .element = 2),
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
                     paper_deckle_members = MEMBERS_OF(deckle_rows),
                     paper_pigment_members = MEMBERS_OF(pigment_rows),
                     paper_bands_members = MEMBERS_OF(bands_rows),
                     paper_put_members = MEMBERS_OF(put_rows),
                     paper_blot_members = MEMBERS_OF(blot_rows),
                     paper_resist_members = MEMBERS_OF(resist_rows),
                     paper_bookmark_members = MEMBERS_OF(bookmark_rows),
                     paper_layer_members = MEMBERS_OF(layer_rows),
                     paper_brush_members = MEMBERS_OF(brush_rows),
                     paper_dip_members = MEMBERS_OF(dip_rows),
                     paper_stroke_members = MEMBERS_OF(stroke_rows),
                     paper_salt_members = MEMBERS_OF(salt_rows),
                     paper_splatter_members = MEMBERS_OF(splatter_rows),
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
