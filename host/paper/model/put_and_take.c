/* put_and_take.c - what every operation on a place needs: the part of each fiber that a screen
 * covers, and amounts that come and go. */
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

static int clip(int64_t at, int length)
{
    return at < 0 ? 0 : at > length ? length : (int)at;
}

enum paper_status sheet_place_check(const struct paper_place *place)
{
    const struct paper_screen *screen = place->screen;
    if (screen && (!screen->gray || screen->width_px < 1 || screen->height_px < 1))
        return paper_fail(PAPER_BAD_ARGUMENT, "the screen is empty");
    return PAPER_OK;
}

enum paper_status sheet_share_make(struct paper_sheet *p, const struct paper_place *place,
                                   CM_field_id_t share)
{
    const struct paper_screen *screen = place->screen;
    int x = place->x, y = place->y;
    if (!screen) {
        kit_f_set(share, 1.0);
        return PAPER_OK;
    }
    int width = p->page.grid.width, height = p->page.grid.height;
    uint8_t *gray = calloc((size_t)height, (size_t)width);
    if (!gray)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a screen of %dx%d", width, height);
    int x1 = clip(x, width), x2 = clip((int64_t)x + screen->width_px, width);
    int y1 = clip(y, height), y2 = clip((int64_t)y + screen->height_px, height);
    for (int row = y1; row < y2 && x1 < x2; row++)
        memcpy(gray + (size_t)row * (size_t)width + x1,
               screen->gray + (size_t)(row - y) * (size_t)screen->width_px + (x1 - x),
               (size_t)(x2 - x1));
    kit_grid_u_write(&p->page.grid, p->mask, 8, gray, CM_8_bit);
    CM_f_u_float_2_2L(share, p->mask, 8, KIT_F);
    kit_f_times(share, share, 1 / 255.0);
    free(gray);
    return PAPER_OK;
}

void sheet_resist_heed(struct paper_sheet *p, CM_field_id_t share, CM_field_id_t open)
{
    kit_f_from(open, 1.0, p->barred);
    kit_f_least(open, open, 0.0);
    kit_f_mul(share, share, open);
}

void sheet_paper_heed(struct paper_sheet *p, CM_field_id_t q)
{
    CM_field_id_t there = p->t[0];
    kit_f_times(there, p->thickness, SHEET_THIN_SCALE);
    kit_f_most(there, there, 1.0);
    kit_f_mul(q, q, there);
    kit_f_whole(q);
}

/* Depth of water, units, that was laid on all of a fiber: what a brush that is nearly dry
 * leaves. Water of fibers that are wet in part stands as high as it must be to come forward,
 * and where all are, each draws in what its neighbours have, or loses its own: with a greater
 * depth thin strokes became rows of dots. */
#define WETTED 0.04

/* A fiber that a brush has touched is all wet where the water around it has 1 / this of the
 * most that there is. Gaps up to two fibers wide between bristles do not count (a closing: the
 * least of the most): only fibers at the edge of a stroke are wet in part. */
#define TOUCHED 2.0

#define SHARE_LEAST (1 / 255.0)

/* By its surface water alone. Uses t[0]. */
static void wet_part_make(struct paper_sheet *p)
{
    kit_f_times(p->t[0], p->surface_water, 1 / (WETTED * p->unit));
    kit_f_most(p->t[0], p->t[0], 1.0);
    kit_f_max(p->wet_part, p->wet_part, p->t[0]);
    kit_f_max(p->wet_around, p->wet_around, p->t[0]);
    kit_f_max(p->stained, p->stained, p->wet_part);
}

void sheet_wet_around_make(struct paper_sheet *p)
{
    if (sheet_has(p, PAPER_PART_SURFACE))
        wet_part_make(p);
}

/* d = the most of a, or the least, in a fiber and its eight neighbours. Uses t[4..5]. */
static void extreme_around(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t a, bool most)
{
    CM_field_id_t before = p->t[4], behind = p->t[5];
    kit_f_copy(d, a);
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_previous(before, d, axis);
        kit_f_next(behind, d, axis);
        if (most) {
            kit_f_max(before, before, behind);
            kit_f_max(d, d, before);
        } else {
            kit_f_min(before, before, behind);
            kit_f_min(d, d, before);
        }
    }
}

/* d = what part of a fiber was wetted by water put on it through `share`: the share of the most
 * that fibers around got. Of an edge as sharp as type's a part is wet, but where a shape fades
 * all of each fiber is, under less water. A film on parts of fibers everywhere breaks up: where
 * it comes to close over some, it draws in the water of all around them. Uses t[3..5]. */
static void wetted_make(struct paper_sheet *p, CM_field_id_t d, CM_field_id_t share)
{
    CM_field_id_t most = p->t[3];
    kit_f_most(d, p->surface_water, 1.0);
    kit_f_mul(d, d, share);
    extreme_around(p, most, share, true);
    kit_f_least(most, most, SHARE_LEAST);
    kit_f_div(d, d, most);
}

void sheet_wet_put(struct paper_sheet *p, bool water, CM_field_id_t share)
{
    if (!water || !sheet_has(p, PAPER_PART_SURFACE))
        return;
    wetted_make(p, p->t[0], share);
    kit_f_max(p->wet_part, p->wet_part, p->t[0]);
    kit_f_max(p->wet_around, p->wet_around, p->t[0]);
    kit_f_max(p->stained, p->stained, p->wet_part);
}

void sheet_wet_touched(struct paper_sheet *p, CM_field_id_t before)
{
    CM_field_id_t part = p->t[0], most = p->t[2], gained = p->t[3];
    if (!sheet_has(p, PAPER_PART_SURFACE))
        return;
    extreme_around(p, most, p->surface_water, true);
    extreme_around(p, part, most, false);
    kit_f_least(most, most, 1.0);
    kit_f_div(part, part, most);
    kit_f_times(part, part, TOUCHED);
    kit_f_most(part, part, 1.0);
    kit_f_sub(gained, p->surface_water, before);
    kit_f_least(gained, gained, 0.0);
    kit_f_most(gained, gained, 1.0);
    kit_f_mul(part, part, gained);
    kit_f_max(p->stained, p->stained,
              part); /* a brush that is nearly dry stains all that it touches */
    kit_f_times(most, p->surface_water, 1 / (WETTED * p->unit));
    kit_f_min(part, part, most);
    kit_f_max(p->wet_part, p->wet_part, part);
    kit_f_max(p->wet_around, p->wet_around, part);
}

CM_field_id_t sheet_amount_field(const struct paper_sheet *p, int substance)
{
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    if (substance == 0)
        return surface ? p->surface_water : p->page.water;
    return surface ? p->surface[substance - 1] : p->infused[substance - 1];
}

void sheet_amount_put(struct paper_sheet *p, int substance, CM_field_id_t part)
{
    CM_field_id_t q = sheet_amount_field(p, substance), left = p->t[3], fields[3] = {q};
    int count = substance == 0 ? 1 : sheet_pigment_fields(p, substance - 1, fields);
    if (p->unit != 1)
        kit_f_whole(part);
    kit_f_from(left, (p->unit == 1 ? 1 : SHEET_PUT_MOST) * p->unit, fields[0]);
    for (int i = 1; i < count; i++)
        kit_f_sub(left, left, fields[i]);
    kit_f_least(left, left, 0.0);
    kit_f_min(part, part, left);
    kit_f_add(q, q, part);
}

void sheet_amount_lose(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t share, double part,
                       CM_field_id_t lost)
{
    kit_f_times(lost, share, part);
    kit_f_mul(lost, lost, q);
    if (p->unit != 1)
        sheet_whole_of(lost, q);
    kit_f_sub(q, q, lost);
}
