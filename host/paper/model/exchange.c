/* exchange.c - what passes between bristles and fibers, as a program on the bristles' own
 * processors.
 *
 * A place is a bristle on a fiber. It looks at whether the fiber is barred, its water s and
 * pigments by CM_get, and at its own water w. With
 *
 *     level   = load * gives * takes * f (2 - f), f = w / full what the bristle would leave on
 *             a fiber
 *     touch   = steeply from 0 to 1 where reach + WET_REACH f is above 0: reach comes from the
 *             fiber's tooth and the force (stroke.c), and a dry brush skips the hollows
 *     part    = contact * touch / sharers
 *     given   = part * (max (level - s, 0) + mixing * min (level, s))
 *     taken   = part * (max (s - level, 0) + mixing * min (level, s))
 *
 * the same part of water and of each pigment moves: given / w of the bristle's, at most 1 /
 * places of it; taken / s of the fiber's, at most 1 / sharers. Each is cut to whole grains, so
 * neither side gives more than it has, whoever else is there, and the sums that
 * CM_send_with_f_add and the shifts along a bristle's places make are exact in any order. */
#include "model/brush_internal.h"

enum { D_S = 52, D_E = 11, D_BITS = 64, GRAINS_BITS = 31, BRUSH_ROWS_LOG2 = 5 };
#define D D_S, D_E

#define WET_REACH 1.5 /* on the scale of heights: a full bristle touches all fibers */
#define TOUCH_STEEPNESS 4.0
/* A fiber gets up to this of water and of each pigment from a brush. */
#define GIVE_MOST 4.0

static void d_whole(const struct bristle_set *b, CM_field_id_t d)
{
    CM_u_f_truncate_2_2L(b->count, d, GRAINS_BITS, D);
    CM_f_u_float_2_2L(d, b->count, GRAINS_BITS, D);
}

/* dest = the float of the fiber at each place. */
static void get(const struct bristle_set *b, CM_field_id_t dest, CM_field_id_t source)
{
    CM_get_1L(b->gotten, b->address, source, KIT_FLOAT_BITS);
    CM_f_move_2L(dest, b->gotten, D, KIT_F);
}

static void contacts_write(const struct bristle_set *b, const struct sheet_contacts *contacts)
{
    const struct {
        CM_field_id_t field;
        const float *values;
    } rows[] = {{b->contact, contacts->contact},
                {b->reach, contacts->reach},
                {b->sharers, contacts->sharers},
                {b->places, contacts->places}};
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {0, 1};
    int end[2] = {BRUSH_ROWS, b->bristles}, size[2] = {BRUSH_ROWS, PAPER_BRISTLES_MAX};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        CM_f_write_to_news_array_1L(rows[i].values, offset, start, end, axes, rows[i].field,
                                    KIT_F, 2, size, CM_float_single);
    CM_u_write_to_news_array_1L(contacts->address, offset, start, end, axes, b->address, 32, 2,
                                size, CM_32_bit);
}

/* fullness = w / full, and level from it; other is free. */
static void level_make(const struct paper_sheet *p, const struct bristle_set *b,
                       const struct sheet_brush *brush, CM_field_id_t level,
                       CM_field_id_t fullness, CM_field_id_t other)
{
    CM_f_multiply_constant_3_1L(fullness, brush->held[0], 1 / brush->full, D);
    CM_f_min_constant_2_1L(fullness, 1.0, D);
    CM_f_subfrom_constant_3_1L(level, fullness, 2.0, D);
    CM_f_multiply_2_1L(level, fullness, D);
    CM_f_multiply_2_1L(level, brush->gives, D);
    CM_f_multiply_constant_2_1L(level, brush->brush.load * p->unit, D);
    get(b, other, p->grip);
    CM_f_multiply_2_1L(level, other, D);
}

/* part = contact * touch / sharers; other is free. */
static void part_make(struct paper_sheet *p, const struct bristle_set *b, CM_field_id_t part,
                      CM_field_id_t fullness, CM_field_id_t other)
{
    CM_f_multiply_constant_3_1L(part, fullness, WET_REACH, D);
    CM_f_move_2L(other, b->reach, D, KIT_F);
    CM_f_add_2_1L(part, other, D);
    CM_f_multiply_constant_2_1L(part, TOUCH_STEEPNESS, D);
    CM_f_max_constant_2_1L(part, 0.0, D);
    CM_f_min_constant_2_1L(part, 1.0, D);
    get(b, other, p->barred);
    CM_f_subfrom_constant_2_1L(other, 1.0, D);
    CM_f_max_constant_2_1L(other, 0.0, D);
    CM_f_multiply_2_1L(part, other, D);
    CM_f_move_2L(other, b->contact, D, KIT_F);
    CM_f_multiply_2_1L(part, other, D);
    CM_f_move_2L(other, b->sharers, D, KIT_F);
    CM_f_divide_2_1L(part, other, D);
}

/* share = part * (max (here - there, 0) + both) / here, but at most 1 / among, so that all
 * sharers together take no more than there is. */
static void share_make(CM_field_id_t share, CM_field_id_t part, CM_field_id_t here,
                       CM_field_id_t there, CM_field_id_t both, CM_field_id_t among,
                       CM_field_id_t held, CM_field_id_t other)
{
    CM_f_subtract_3_1L(share, here, there, D);
    CM_f_max_constant_2_1L(share, 0.0, D);
    CM_f_add_2_1L(share, both, D);
    CM_f_multiply_2_1L(share, part, D);
    CM_f_max_constant_3_1L(other, held, 1.0, D);
    CM_f_divide_2_1L(share, other, D);
    CM_f_move_2L(other, among, D, KIT_F);
    CM_f_divinto_constant_2_1L(other, 1.0, D);
    CM_f_min_2_1L(share, other, D);
}

/* held loses what all places of its bristle give. The rows form a ring: after shifts by 16, 8,
 * 4, 2 and 1 rows each row has the sum of all. */
static void held_change(CM_field_id_t held, CM_field_id_t give, CM_field_id_t sum,
                        CM_field_id_t other)
{
    CM_f_move_1L(sum, give, D);
    for (int log2_distance = BRUSH_ROWS_LOG2 - 1; log2_distance >= 0; log2_distance--) {
        CM_get_from_power_two_1L(other, sum, 0, (unsigned)log2_distance, CM_upward, D_BITS);
        CM_f_add_2_1L(sum, other, D);
    }
    CM_f_subtract_2_1L(held, sum, D);
}

void sheet_brush_exchange(struct paper_sheet *p, const struct sheet_brushes *brushes,
                          const struct sheet_brush *brush)
{
    const struct bristle_set *b = &brushes->sets[brush->set];
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    int substances = 1 + p->config.pigments_count;
    CM_field_id_t level = b->t[0], fullness = b->t[1], part = b->t[2], water = b->t[3],
                  both = b->t[4], give = b->t[5], take = b->t[6], other = b->t[7],
                  there = b->t[8], room = b->t[9];
    CM_set_vp_set(p->page.grid.vp_set);
    CM_set_context();
    if (surface)
        kit_f_copy(p->t[1], p->surface_water);
    CM_set_vp_set(b->vp_set);
    CM_set_context();
    contacts_write(b, &brushes->contacts);
    level_make(p, b, brush, level, fullness, other);
    part_make(p, b, part, fullness, other);
    get(b, water, surface ? p->surface_water : p->page.water);
    CM_f_min_3_1L(both, level, water, D);
    CM_f_multiply_constant_2_1L(both, brush->brush.mixing, D);
    share_make(give, part, level, water, both, b->places, brush->held[0], other);
    share_make(take, part, water, level, both, b->sharers, water, other);
    for (int i = 0; i < substances; i++) {
        CM_field_id_t change = b->give[i];
        if (i == 0)
            CM_f_move_1L(there, water, D);
        else
            get(b, there, surface ? p->surface[i - 1] : p->infused[i - 1]);
        CM_f_subfrom_constant_3_1L(room, there, GIVE_MOST * p->unit, D);
        CM_f_max_constant_2_1L(room, 0.0, D);
        CM_f_move_2L(other, b->sharers, D, KIT_F);
        CM_f_divide_2_1L(room, other, D);
        CM_f_multiply_3_1L(change, give, brush->held[i], D);
        CM_f_min_2_1L(change, room, D);
        d_whole(b, change);
        CM_f_multiply_3_1L(other, take, there, D);
        d_whole(b, other);
        CM_f_subtract_2_1L(change, other, D);
    }
    for (int i = 0; i < substances; i++)
        held_change(brush->held[i], b->give[i], b->t[3], b->t[4]);
    for (int i = 0; i < substances; i++) {
        CM_field_id_t dest = i == 0    ? surface ? p->surface_water : p->page.water
                             : surface ? p->surface[i - 1]
                                       : p->infused[i - 1];
        CM_f_move_2L(b->sent, b->give[i], KIT_F, D);
        CM_f_gt_constant_1L(b->contact, 0.0, KIT_F);
        CM_logand_context_with_test();
        CM_send_with_f_add_1L(dest, b->address, b->sent, KIT_F, CM_no_field);
        CM_set_context();
    }
    CM_set_vp_set(p->page.grid.vp_set);
    CM_set_context();
    sheet_wet_touched(p, p->t[1]);
    for (int i = 0; i < 6; i++)
        kit_f_set(p->t[i], 0.0);
    CM_warm_boot(); /* so the next operation starts from the same kind of values as any other,
                     * and a step after it needs no kernels of its own */
}
