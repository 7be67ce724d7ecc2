/* model.h - the fields of a sheet with pigments, and short names of the Paris calls on its floats. */
#ifndef LUTETIA_PAPER_SHEET_INTERNAL_H
#define LUTETIA_PAPER_SHEET_INTERNAL_H

#include "base/page.h"
#include "sheet.h"
#include "techniques.h"

enum { SHEET_TEMPORARIES = 24, SHEET_DRIED_BITS = 31 };

/* What a fiber holds at most: more does not flow in. */
#define SHEET_LOAD_MAX 15.0

struct sheet_history;

struct paper_sheet {
    struct paper_sheet_config config;
    struct paper_air air;
    struct sheet_history *history; /* NULL: nothing is recorded */
    long steps;                    /* without a history */
    bool touched;                  /* something was done, and not recorded */
    double unit;                   /* of amounts: PAPER_GRAINS, or 1 without parts */
    /* VP set, contexts, coordinates, and what the thesis's cycle needs: water and absorbency are in the fibers */
    struct paper page;
    CM_field_id_t height, capacity, resist;
    CM_field_id_t face
        [2]; /* [axis]: part of a gradient that flows to the neighbour above; 0: none, closed */
    CM_field_id_t substrate[3]; /* what the pigments lie on */
    CM_field_id_t surface_water;
    CM_field_id_t dried; /* grains, SHEET_DRIED_BITS */
    CM_field_id_t wet_around;
    CM_field_id_t varnish, salt, brine;
    bool varnished, salted; /* there may be some */
    double salt_reach, salt_strength;
    CM_field_id_t surface[PAPER_PIGMENTS_MAX], infused[PAPER_PIGMENTS_MAX],
        fixed[PAPER_PIGMENTS_MAX];
    CM_field_id_t mask;     /* 8 bits */
    CM_field_id_t shown[3]; /* 16 bits */
    CM_field_id_t t[SHEET_TEMPORARIES];
    struct sheet_brushes *brushes; /* model/brush_internal.h; NULL: there is none */
    bool (*due)(void *context);    /* paper_sheet_stop_when() */
    void *due_context;
};

/* NULL is fine. */
void sheet_brushes_destroy(struct paper_sheet *p);

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

/* Fields of each pigment that the parts use, in the order surface, infused, fixed; how many. */
int sheet_pigment_fields(const struct paper_sheet *p, int pigment, CM_field_id_t fields[3]);
/* The field of a layer; 0 where there is none. */
CM_field_id_t sheet_layer_field(const struct paper_sheet *p, enum paper_layer layer,
                                int pigment);

/* A fresh sheet: its stock from the seed, nothing on it. Between paper_enter() and paper_leave(). */
enum paper_status sheet_fresh_make(struct paper_sheet *p);
/* Absorbency, capacity, height and colour from the seed. */
void sheet_stock_make(struct paper_sheet *p);
/* Faces from absorbency, resist and the edges; call it when these change. */
void sheet_faces_make(struct paper_sheet *p);
/* share = the place's gray (1 where there is no screen) as 0..1; then 0 where there is resist. `open` is free. */
enum paper_status sheet_share_make(struct paper_sheet *p, const struct paper_place *place,
                                   CM_field_id_t share);
void sheet_resist_heed(struct paper_sheet *p, CM_field_id_t share, CM_field_id_t open);
/* q gets whole grains of part (the same field is free afterwards), up to what may be put in a fiber. Uses t[3]. */
void sheet_amount_put(struct paper_sheet *p, int substance, CM_field_id_t part);
/* q loses whole grains of share * part. */
void sheet_amount_lose(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t share, double part,
                       CM_field_id_t lost);

/* room = 1 to 0 as a fiber fills up; see model/step.c. */
void sheet_room_make(struct paper_sheet *p, CM_field_id_t room);
/* Salt dissolves and pushes: a part of a step. Uses t[0..15]. */
void sheet_salt_step(struct paper_sheet *p);
/* Varnish over the colours. Uses t[0..3]. */
void sheet_varnish_shine(struct paper_sheet *p, const CM_field_id_t color[3]);

/* The wet area is as it is now: its edge begins to dry faster from here. Uses t[0]. */
void sheet_wet_around_make(struct paper_sheet *p);
/* dest (three fields) = the sheet's colour as it lies, in the terms of substrate. Uses t[0..7]. */
void sheet_color_make(struct paper_sheet *p, const CM_field_id_t dest[3]);

/* ---- Paris, for single floats ---- */

#define SHEET_F PAPER_S, PAPER_E

static inline void f_add(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_add_3_1L(d, a, b, SHEET_F);
}

static inline void f_sub(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_subtract_3_1L(d, a, b, SHEET_F);
}

static inline void f_mul(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_multiply_3_1L(d, a, b, SHEET_F);
}

static inline void f_div(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_divide_3_1L(d, a, b, SHEET_F);
}

static inline void f_min(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_min_3_1L(d, a, b, SHEET_F);
}

static inline void f_max(CM_field_id_t d, CM_field_id_t a, CM_field_id_t b)
{
    CM_f_max_3_1L(d, a, b, SHEET_F);
}

static inline void f_plus(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_add_constant_3_1L(d, a, n, SHEET_F);
}

static inline void f_times(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_multiply_constant_3_1L(d, a, n, SHEET_F);
}

/* d = n - a */
static inline void f_from(CM_field_id_t d, double n, CM_field_id_t a)
{
    CM_f_subfrom_constant_3_1L(d, a, n, SHEET_F);
}

static inline void f_most(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_min_constant_3_1L(d, a, n, SHEET_F);
}

static inline void f_least(CM_field_id_t d, CM_field_id_t a, double n)
{
    CM_f_max_constant_3_1L(d, a, n, SHEET_F);
}

/* Rounds to a whole number: adding 3 * 2^22 leaves no place for a fraction. To the nearest up to 2^22, to an even one near
 * it up to 2^24; nothing is rounded away from that. */
#define SHEET_WHOLE 12582912.0
static inline void f_whole(CM_field_id_t d)
{
    CM_f_add_constant_2_1L(d, SHEET_WHOLE, SHEET_F);
    CM_f_subtract_constant_2_1L(d, SHEET_WHOLE, SHEET_F);
}

/* d becomes whole and is at most q, which is whole. */
static inline void f_whole_of(CM_field_id_t d, CM_field_id_t q)
{
    f_whole(d);
    f_min(d, d, q);
}

static inline void f_copy(CM_field_id_t d, CM_field_id_t a)
{
    CM_f_move_1L(d, a, SHEET_F);
}

static inline void f_set(CM_field_id_t d, double n)
{
    CM_f_move_constant_1L(d, n, SHEET_F);
}

/* Whole sheets in and out: rows from the top; unsigned numbers of `bits`, of `type` in the array. */
static inline void f_array_write(const struct paper_sheet *p, CM_field_id_t d,
                                 const void *floats)
{
    int zeros[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X},
        size[2] = {p->page.height, p->page.width};
    CM_f_write_to_news_array_1L(floats, zeros, zeros, size, axes, d, SHEET_F, 2, size,
                                CM_float_single);
}

static inline void f_array_read(const struct paper_sheet *p, void *floats, CM_field_id_t a)
{
    int zeros[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X},
        size[2] = {p->page.height, p->page.width};
    CM_f_read_from_news_array_1L(floats, zeros, zeros, size, axes, a, SHEET_F, 2, size,
                                 CM_float_single);
}

static inline void u_array_write(const struct paper_sheet *p, CM_field_id_t d, unsigned bits,
                                 const void *numbers, unsigned type)
{
    int zeros[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X},
        size[2] = {p->page.height, p->page.width};
    CM_u_write_to_news_array_1L(numbers, zeros, zeros, size, axes, d, bits, 2, size, type);
}

static inline void u_array_read(const struct paper_sheet *p, void *numbers, CM_field_id_t a,
                                unsigned bits, unsigned type)
{
    int zeros[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X},
        size[2] = {p->page.height, p->page.width};
    CM_u_read_from_news_array_1L(numbers, zeros, zeros, size, axes, a, bits, 2, size, type);
}

/* d = the neighbour's whose coordinate is one greater (less) */
static inline void f_next(CM_field_id_t d, CM_field_id_t a, unsigned axis)
{
    CM_get_from_news_1L(d, a, axis, CM_upward, PAPER_FLOAT_BITS);
}

static inline void f_previous(CM_field_id_t d, CM_field_id_t a, unsigned axis)
{
    CM_get_from_news_1L(d, a, axis, CM_downward, PAPER_FLOAT_BITS);
}

#endif
