/* model.h - the fields of a sheet with pigments, and what the files of this folder do with
 * them. */
#ifndef LUTETIA_PAPER_MODEL_H
#define LUTETIA_PAPER_MODEL_H

#include "base/page.h"
#include "model/operations.h"
#include "picture.h"
#include "sheet.h"

enum { SHEET_TEMPORARIES = 56, SHEET_TERMS = 7, SHEET_DRIED_BITS = 31 };
/* Of a picture: of a channel, from the lowest, and of all three. */
enum { SHEET_SHADE_BITS = 16, SHEET_SHADES_BITS = 3 * SHEET_SHADE_BITS };
/* How many fibers aside the picture of a fiber looks. */
enum { SHEET_LOOK_REACH = 1 };

/* What a fiber holds at most: more does not flow in. */
#define SHEET_LOAD_MAX 15.0
/* What a fiber gets of a pigment in all layers, or of water in one, by putting it there; more
 * may flow in. */
#define SHEET_PUT_MOST 4.0
/* The absorbency of a stock above which it is not sized, or less than others. */
#define SHEET_SIZED_MOST 0.12
/* ... of a stock without size at all. */
#define SHEET_UNSIZED_LEAST 0.2
/* The roughness of what is smooth. */
#define SHEET_SMEARS 0.09
/* A stained part times this is 1 or more unless it is 0. */
#define SHEET_STAINED_SCALE 1e30
/* Thickness times this is 1 or more wherever there is paper. */
#define SHEET_THIN_SCALE 1e6

struct sheet_history;

struct sheet_areas {
    int count;
    struct paper_area at[PAPER_AREAS_MAX];
};

struct paper_sheet {
    struct paper_sheet_config config;
    struct paper_air air;
    struct sheet_history
        *history; /* history/; nothing in this folder looks at it. NULL: nothing is recorded */
    long steps;   /* that were computed */
    long exchanges; /* with brushes, since the sheet was made */
    bool touched;   /* something was done, and not recorded */
    /* how many times finer than its stock is known the sheet is, 1 or more; a render at 2 is
     * 2 */
    double finer;
    double unit; /* of amounts: PAPER_GRAINS, or 1 without parts */
    /* VP set, contexts, coordinates, and what the thesis's cycle needs: water and absorbency
     * are in the fibers */
    struct paper page;
    /* [axis]: coordinates of the sheet's first and last fibers; 0 of a box that does not have
     * them */
    int ends[2][2];
    CM_field_id_t height, capacity, resist;
    CM_field_id_t thickness; /* of the paper, 0..1; 0 where there is none. Only with a deckle */
    /* Where nothing can be put and nothing flows: resist, and, with a deckle, where there is no
     * paper (sheet_faces_make()) */
    CM_field_id_t barred;
    CM_field_id_t face
        [2]; /* [axis]: part of a gradient that flows to the neighbour above; 0: none, closed */
    CM_field_id_t substrate[3]; /* what the pigments lie on */
    CM_field_id_t surface_water;
    CM_field_id_t dried; /* grains, SHEET_DRIED_BITS */
    CM_field_id_t wet_around;
    /* Where water flows (model/film.c): how hard fibers are to wet, and eddies; what part of
     * each fiber is wet; how fast water flows to the neighbour above, [axis]. */
    CM_field_id_t sizing, current, wet_part, speed[2];
    CM_field_id_t ease[2]; /* [axis]: how easily it flows over the face; 0: closed */
    CM_field_id_t swirl;   /* of current, at the corner above on both axes */
    CM_field_id_t grip;    /* how willingly the paper takes what a bristle leaves */
    /* What part of each fiber its paint lies on, 0..1: the most that was wet since there is
     * paint on it; 0 where none has come with surface water, so that it lies everywhere. */
    CM_field_id_t stained;
    CM_field_id_t relief; /* what light of strength 1 makes of the relief, about 0 (light.c) */
    bool relief_made;     /* of the heights as they are */
    int16_t *tooth;       /* tooth.c; NULL: not made of the heights as they are */
    double tooth_deviation; /* of it, on the scale of heights */
    CM_field_id_t varnish, salt, brine;
    bool varnished, salted; /* there may be some */
    double salt_reach, salt_strength;
    CM_field_id_t surface[PAPER_PIGMENTS_MAX], infused[PAPER_PIGMENTS_MAX],
        fixed[PAPER_PIGMENTS_MAX];
    CM_field_id_t mask; /* 8 bits */
    CM_field_id_t shades, shade,
        shifted; /* a picture's channels, one, and where it goes (view.c) */
    CM_field_id_t t[SHEET_TEMPORARIES];
    CM_field_id_t term[SHEET_TERMS]; /* struct sheet_terms; 0 between steps */
    struct sheet_areas changed;      /* since they were asked for (areas.c) */
    struct sheet_areas unkept;       /* touched since the planes were copied (areas.c) */
    uint16_t *covers;                /* ground.c; NULL: not made */
    double covers_light;             /* by which they were */
    struct sheet_boxes *boxes;       /* model/boxes.c; NULL: there was none */
    int boxes_unit;                  /* their sides are multiples of it; 0: no boxes */
    double parted_from;              /* fibers from which steps are computed in parts; step.c */
    struct sheet_growing *growing;   /* model/growing.c; NULL: no stroke grows */
    struct sheet_brushes *brushes;   /* model/brush_internal.h; NULL: there is none */
    bool (*due)(void *context);      /* paper_sheet_stop_when() */
    void *due_context;
};

static inline bool sheet_has(const struct paper_sheet *p, unsigned part)
{
    return (p->config.parts & part) != 0;
}

/* With the parts that others imply. */
static inline unsigned sheet_parts_whole(unsigned parts)
{
    if (parts & PAPER_PART_EDGE)
        parts |= PAPER_PART_SURFACE;
    return parts ? parts | PAPER_PART_INFUSED : 0;
}

/* ---- a sheet's life (sheet.c) ---- */

/* Errors: BAD_ARGUMENT, NO_DEVICE, NO_MEMORY, MACHINE_FAILED; *out is then NULL. Owns: the
 * caller gives it to sheet_destroy(). */
enum paper_status sheet_create(const struct paper_sheet_config *config,
                               struct paper_sheet **out);
void sheet_destroy(struct paper_sheet *p);
/* All that was asked for is computed. */
enum paper_status sheet_finish(struct paper_sheet *p);
/* The sheet is as it was made. */
enum paper_status sheet_reset(struct paper_sheet *p);
/* No brush, no salt, no varnish. */
void sheet_extras_reset(struct paper_sheet *p);

/* ---- steps (step.c, boxes.c) ---- */

/* A step of all of the VP set's fibers. Between paper_enter() and paper_leave(). */
void sheet_step_everywhere(struct paper_sheet *p);
/* Whether its steps are computed in parts. */
static inline bool sheet_parted(const struct paper_sheet *p)
{
    return (double)p->page.grid.width * p->page.grid.height >= p->parted_from;
}
/* Steps go on in boxes around what can change, away from the sheet's own fields. So who looks
 * at these begins with sheet_look(), who changes some of them with sheet_change(), or with
 * sheet_change_area() or sheet_change_place() where all that can be seen of the change is
 * there, and who writes all that steps change with sheet_change_all(): paper_enter(), and
 * more. */
void sheet_look(struct paper_sheet *p);
void sheet_change(struct paper_sheet *p);
void sheet_change_area(struct paper_sheet *p, int x, int y, int width, int height);
void sheet_change_place(struct paper_sheet *p, const struct paper_place *place);
void sheet_change_all(struct paper_sheet *p);
/* What was computed in boxes is dropped, for who writes all that it changed. paper_enter(), and
 * more. */
void sheet_parts_forget(struct paper_sheet *p);
void sheet_boxes_init(struct paper_sheet *p);
void sheet_boxes_destroy(struct paper_sheet *p);
/* Boxes whose steps are used up are looked at, when all that was asked for is computed: so the
 * next step is computed as every other. A step that finds them used up looks at them itself,
 * and what waits is then computed in other parts, by kernels that are seldom needed. */
enum paper_status sheet_boxes_finish(struct paper_sheet *p);
/* A stroke is going to touch fibers x1..x2 - 1, y1..y2 - 1, or nothing (x1 = x2) from now on:
 * boxes have room for it. */
enum paper_status sheet_boxes_expect(struct paper_sheet *p, int x1, int y1, int x2, int y2);
/* For who changes these fibers: the sheet whose fields hold them, the sheet itself or a box of
 * it, and where its first fiber is on the sheet. Between paper_enter() and paper_leave(). */
struct paper_sheet *sheet_boxes_touch(struct paper_sheet *p, int x1, int y1, int x2, int y2,
                                      int origin[2]);
/* As paper_sheet_confine(). */
enum paper_status sheet_confine(struct paper_sheet *p, int unit);
/* As paper_sheet_share(). */
double sheet_share(const struct paper_sheet *p);

/* ---- its fields (fields.c) and layers (layers.c) ---- */

/* Between paper_enter() and paper_leave(), like all below that return nothing. */
void sheet_fields_make(struct paper_sheet *p);
enum paper_status sheet_amounts_clear(struct paper_sheet *p);
/* What is left in temporaries is a value like any other: the machine would have to be able to
 * tell it, keep for that what it is made of, and store what it cannot have as an expression. So
 * they are cleared before anybody looks, and at the end by sheet_leave(), which is
 * paper_leave() otherwise. */
void sheet_temporaries_clear(struct paper_sheet *p);
/* A part of a step ends, after which temporaries are needed no more: where steps are computed
 * in parts, what waits is computed. */
void sheet_step_part_end(struct paper_sheet *p);
/* Narrows the context to fibers at the sheet's end on an axis: its last ones, or its first. Of
 * a box without such fibers those along its side are taken for them. */
void sheet_end_narrow(const struct paper_sheet *p, unsigned axis, bool last);
enum paper_status sheet_leave(struct paper_sheet *p);
/* Fields of each pigment that the parts use, in the order surface, infused, fixed; how many. */
int sheet_pigment_fields(const struct paper_sheet *p, int pigment, CM_field_id_t fields[3]);
/* The field of a layer; 0 where there is none. */
CM_field_id_t sheet_layer_field(const struct paper_sheet *p, enum paper_layer layer,
                                int pigment);
/* Whether it is kept in grains. */
bool sheet_layer_amount(enum paper_layer layer);
/* As paper_sheet_layer_read() and paper_sheet_total(), of the sheet as it is. */
enum paper_status sheet_layer_read(struct paper_sheet *p, enum paper_layer layer, int pigment,
                                   float *values);
enum paper_status sheet_total(struct paper_sheet *p, int substance, double *total);

/* ---- its planes (saved_planes.c): all that changes in it, to the bit ---- */

/* As the fields hold it. */
enum paper_status sheet_plane_fetch(struct paper_sheet *p, int number, void *words);
/* Between paper_enter() and paper_leave(). */
void sheet_plane_write(struct paper_sheet *p, int number, const void *words);
/* The same of fibers of the sheet. Shape of words: the area's. */
enum paper_status sheet_plane_part_fetch(struct paper_sheet *p, int number,
                                         const struct paper_area *area, void *words);
void sheet_plane_part_write(struct paper_sheet *p, int number, const struct paper_area *area,
                            const void *words);
/* Whether something follows from the plane that sheet_planes_written() makes. */
bool sheet_plane_is_followed(const struct paper_sheet *p, int number);
/* Whether the words are what that plane of a sheet can hold. Errors: BAD_FILE. */
enum paper_status sheet_plane_check(const struct paper_sheet *p, int number, const void *words);
/* After all have been written: what follows from them. */
void sheet_planes_written(struct paper_sheet *p);

/* ---- the paper (stock.c) ---- */

/* Absorbency, capacity, height and colour from the seed. Errors: NO_MEMORY. */
enum paper_status sheet_stock_make(struct paper_sheet *p);
/* Faces from absorbency, resist, thickness and the edges; call it when these change. */
void sheet_faces_make(struct paper_sheet *p);

/* Light and brushes see the heights anew (tooth.c). */
void sheet_heights_changed(struct paper_sheet *p);
/* The place `by` from i of `count`: beyond the edges that of the last fiber, or on a torus of
 * the other side. */
static inline int sheet_place_beside(int i, int by, int count, bool torus)
{
    const int at = i + by;
    if (torus)
        return (at % count + count) % count;
    return at < 0 ? 0 : at < count ? at : count - 1;
}

/* ---- amounts (put_and_take.c) ---- */

/* Errors: BAD_ARGUMENT (a screen of nothing). */
enum paper_status sheet_place_check(const struct paper_place *place);
/* share = the place's gray (1 where there is no screen) as 0..1; then 0 where there is resist,
 * or no paper. `open` is free. */
enum paper_status sheet_share_make(struct paper_sheet *p, const struct paper_place *place,
                                   CM_field_id_t share);
void sheet_resist_heed(struct paper_sheet *p, CM_field_id_t share, CM_field_id_t open);
/* On a sheet with a deckle: q, in grains, becomes 0 where there is no paper. Uses t[0]. */
void sheet_paper_heed(struct paper_sheet *p, CM_field_id_t q);
/* Where water (0) or a pigment (1 + its number) is put. */
CM_field_id_t sheet_amount_field(const struct paper_sheet *p, int substance);
/* q gets whole grains of part (the same field is free afterwards), up to what may be put in a
 * fiber. Uses t[3]. */
void sheet_amount_put(struct paper_sheet *p, int substance, CM_field_id_t part);
/* q loses whole grains of share * part. */
void sheet_amount_lose(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t share, double part,
                       CM_field_id_t lost);
/* The wet area is as it is now: its edge begins to dry faster from here. Uses t[0]. */
void sheet_wet_around_make(struct paper_sheet *p);

/* ... where a brush or a print has left water; before: what was there. Uses t[0], t[2..5]. */
void sheet_wet_touched(struct paper_sheet *p, CM_field_id_t before);

/* ... where amounts were put through `share`, water among them or not: of a fiber that part is
 * wet. Uses t[0], t[3..5]. */
void sheet_wet_put(struct paper_sheet *p, bool water, CM_field_id_t share);

/* ---- water that flows (sizing.c, soak.c, film.c, capillary.c) ---- */

/* Grip from the seed. Errors: NO_MEMORY. */
enum paper_status sheet_grip_make(struct paper_sheet *p);
/* How uneven sizing is, 0..1. */
double sheet_sizing_strength(const struct paper_sheet *p);
/* 0: the stock is sized; 1: not at all. */
double sheet_unsized(const struct paper_sheet *p);
/* Sizing and currents from the seed. Errors: NO_MEMORY. */
enum paper_status sheet_sizing_make(struct paper_sheet *p);
/* What a step needs of them at faces and corners; after sheet_faces_make(). Uses t[0..4]. */
void sheet_film_faces_make(struct paper_sheet *p);

/* What a fiber's own part of a step leaves for its faces: the sheet's `term`s. */
struct sheet_terms {
    CM_field_id_t room;      /* 1 to 0 as it fills up */
    CM_field_id_t saturated; /* infused water to capacity */
    CM_field_id_t depth;     /* of surface water, units */
    /* of its surface where the fiber is wet; where it is dry, what water must stand above to
     * come in */
    CM_field_id_t level;
    CM_field_id_t deep;    /* depth of the part that is wet */
    CM_field_id_t inverse; /* 1 / depth */
    CM_field_id_t swirled; /* depth that eddies move: none at the edge of what is wet */
};
/* How far apart the fibers are among which wet_around spreads in a step. */
int sheet_around_reach(const struct paper_sheet *p);
/* How many fibers away are those on whose heights it depends what salt does in a fiber; 0:
 * there is no salt. */
int sheet_salt_reach(const struct paper_sheet *p);
/* How fast a pigment settles, with surface water: a part of it in a step. */
double sheet_settling_pace(const struct paper_sheet *p, int pigment);
/* How much more water presses for its height where edges are near; see soak.c. */
#define SHEET_ROUND 1.0
/* Water in which pigments do not mix, times air.film. */
#define SHEET_STILL 4.0
/* Fibers over which the nearness of an edge falls to 1/e. */
double sheet_edge_length(const struct paper_sheet *p);
/* d = all of the pigments, in all layers, in grains. */
void sheet_paint_sum(struct paper_sheet *p, CM_field_id_t d);
/* Uses t[7..15]. */
void sheet_soak(struct paper_sheet *p, struct sheet_terms *terms);
/* What part of a pigment of that weight goes with water in fibers, 0..1. */
double sheet_weight_within(const struct paper_sheet *p, double weight);
/* How often in a step water creeps from a fiber to the next. */
int sheet_capillary_passes(const struct paper_sheet *p);
/* All passes of a step. Uses t[7..15], t[32..44]. */
void sheet_capillary_flow(struct paper_sheet *p, const struct sheet_terms *terms);
/* Parts of a gradient at the four faces of a fiber, as step.c explains them: out and in at that
 * above a fiber on the axis, and at that below. */
struct sheet_faces {
    CM_field_id_t out[2], in[2], out_below[2], in_below[2];
};
/* The faces below from those above. */
void sheet_faces_below(struct sheet_faces *faces);
/* q gets what flows through its four faces, all parts times weight[axis] (x, y). Uses
 * t[8..15]. */
void sheet_flow_through(struct paper_sheet *p, CM_field_id_t q, const struct sheet_faces *faces,
                        const double weight[2]);
/* A step of a sheet whose water flows. Between paper_enter() and paper_leave(). */
void sheet_film_step(struct paper_sheet *p);

/* ---- flows (flow.c, flow_rounding.c) ---- */

/* room = 1 to 0 as a fiber fills up; see model/step.c. */
void sheet_room_make(struct paper_sheet *p, CM_field_id_t room);
/* flow becomes whole grains. */
void sheet_flow_round(CM_field_id_t flow);
/* flow = out * lower + in * upper in whole grains, and KIT_WHOLE more: the difference of two
 * such sums is exact. part: a temporary. */
void sheet_flow_sum(CM_field_id_t flow, CM_field_id_t out, CM_field_id_t lower,
                    CM_field_id_t in, CM_field_id_t upper, CM_field_id_t part);
/* flow = whole grains of up * q(x) - down * q(x+1). Uses t[14]. */
void sheet_flow_make(struct paper_sheet *p, CM_field_id_t flow, CM_field_id_t up,
                     CM_field_id_t down, CM_field_id_t q, unsigned axis);
/* What flows up through each face of q is `flow`. Uses t[14]. */
void sheet_flow_take(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t flow, unsigned axis);
/* Salt dissolves and pushes: a part of a step. Uses t[0..15]. */
void sheet_salt_step(struct paper_sheet *p);

/* ---- brushes (brush.c, tooth.c) ---- */

/* What a brush feels of the heights, if they have changed since it was made. Between
 * paper_enter() and paper_leave(). Errors: NO_MEMORY. */
enum paper_status sheet_tooth_make(struct paper_sheet *p);
/* How far a fiber, by row-major number, stands above the paper around it: -1..1, on the scale
 * of heights. */
double sheet_tooth_at(const struct paper_sheet *p, int fiber);

void sheet_brushes_destroy(struct paper_sheet *p);
/* NULL: there is none. */
const struct paper_brush *sheet_brush_get(const struct paper_sheet *p, int number);
/* Whether it is a number that a brush can have. Errors: BAD_ARGUMENT. */
enum paper_status sheet_brush_number_check(int number);
/* Whether a bristle can hold so many grains. */
bool sheet_bristle_may_hold(double grains);
/* What a brush holds of a substance in each bristle, in grains, to be kept and put back. Shape:
 * as many numbers as bristles. */
enum paper_status sheet_brush_read(struct paper_sheet *p, int number, int substance,
                                   double *grains);
enum paper_status sheet_brush_write(struct paper_sheet *p, int number, int substance,
                                    const double *grains);
/* As paper_sheet_brush_total(), of the sheet as it is. */
enum paper_status sheet_brush_total(struct paper_sheet *p, int number, int substance,
                                    double *total);

/* ---- where the picture has changed (areas.c) ---- */

/* Fibers have changed there, some of which may not be on the sheet. */
void sheet_area_change(struct paper_sheet *p, int x, int y, int width, int height);
/* The picture has changed there; the sheet is taken for a torus. */
void sheet_area_mark(struct paper_sheet *p, int x, int y, int width, int height);
/* What planes hold may have changed there, seen or not; the sheet is taken for a torus. */
void sheet_area_touch(struct paper_sheet *p, int x, int y, int width, int height);
/* Both, everywhere. */
void sheet_area_mark_all(struct paper_sheet *p);

/* ---- a stroke that grows (growing.c) ---- */

/* A stroke of no samples yet is on its way: the sheet's brush is there, and nothing else is
 * painted until it has ended. `painted` false: samples are gathered only. Errors: NO_MEMORY. */
enum paper_status sheet_growing_begin(struct paper_sheet *p, int number, double pace,
                                      bool painted);
/* Paints what they settle. Errors: BAD_ARGUMENT (nothing has changed then), NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status sheet_growing_add(struct paper_sheet *p,
                                    const struct paper_stroke_sample *samples, int count);
/* Paints the rest. */
enum paper_status sheet_growing_finish(struct paper_sheet *p);
/* The stroke as it is, valid until it grows or ends; NULL: none grows. */
const struct paper_stroke *sheet_growing(const struct paper_sheet *p);
/* Whether any of it is on the paper. */
bool sheet_growing_painted(const struct paper_sheet *p);
/* None grows any more. Owns: the caller frees the samples; NULL: they are freed. */
void sheet_growing_end(struct paper_sheet *p, struct paper_stroke_sample **samples);

/* ---- looking (view.c, light.c, picture.c, varnish.c) ---- */

/* Whether a view can be shown, but for its scale. Errors: BAD_ARGUMENT. */
enum paper_status sheet_view_check(const struct paper_sheet *p,
                                   const struct paper_sheet_view *view);
/* It has three channels; they are roots of linear light. */
bool sheet_view_colored(const struct paper_sheet_view *view);
bool sheet_view_linear(const struct paper_sheet *p, const struct paper_sheet_view *view);
/* shades = each fiber's channels, the first of them lowest; of a gray view one. Of a sheet or
 * of a box of it. */
void sheet_shades_make(struct paper_sheet *p, const struct paper_sheet_view *view);

/* As paper_sheet_view(), of the sheet as it is. */
enum paper_status sheet_view(struct paper_sheet *p, const struct paper_sheet_view *view,
                             uint16_t *rgb);
/* As paper_sheet_view_area(). */
enum paper_status sheet_view_area(struct paper_sheet *p, const struct paper_sheet_view *view,
                                  const struct paper_area *area, uint8_t *rgb,
                                  size_t pitch_bytes);
/* rgb = the picture with `scale` pixels a fiber each way (finer.c), from the one with one.
 * Errors: NO_MEMORY. */
enum paper_status sheet_finer(const uint16_t *coarse, int width, int height, bool torus,
                              int scale, uint16_t *rgb);
/* The same sheet on its ground, where it has a deckle (ground.c); the picture is `scale` times
 * as fine as the sheet. Errors: NO_MEMORY, MACHINE_FAILED. */
enum paper_status sheet_ground_lay(struct paper_sheet *p, const struct paper_sheet_view *view,
                                   uint16_t *rgb);
/* covers: what the sheet and its shadow hide, 3 numbers a fiber, under a view's light. They are
 * the sheet's, until it gets another thickness or light. Errors: as above. */
enum paper_status sheet_ground_covers(struct paper_sheet *p, double light,
                                      const uint16_t **covers);
/* So many pixels of a picture on the ground, where these covers are. */
void sheet_ground_pixels(const struct paper_sheet_view *view, const uint16_t *covers,
                         size_t count, uint16_t *rgb);
/* Where there is no paper the colours next to it go on, so that a finer picture's edge is as
 * dark as the paint there. Errors: as above. */
enum paper_status sheet_color_spread(struct paper_sheet *p, uint16_t *rgb);
/* dest (three fields) = the sheet's colour as it lies, in the terms of substrate. Uses t[0..7],
 * t[11]. */
void sheet_color_make(struct paper_sheet *p, const CM_field_id_t dest[3]);
/* The shade of the relief, if the heights have changed since it was made. Errors: NO_MEMORY. */
enum paper_status sheet_relief_make(struct paper_sheet *p);
/* Light of that strength on the relief, after sheet_relief_make(). Uses t[0..1]. */
void sheet_relief_light(struct paper_sheet *p, const CM_field_id_t color[3], double strength);
/* Light on the water's surface. Uses t[0..2]. */
void sheet_water_shine(struct paper_sheet *p, const CM_field_id_t color[3]);
/* Varnish over the colours. Uses t[0..3]. */
void sheet_varnish_shine(struct paper_sheet *p, const CM_field_id_t color[3]);

/* d becomes whole and is at most q, which is whole. */
static inline void sheet_whole_of(CM_field_id_t d, CM_field_id_t q)
{
    kit_f_whole(d);
    kit_f_min(d, d, q);
}

#endif
