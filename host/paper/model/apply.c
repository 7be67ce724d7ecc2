/* apply.c - what is put on a sheet and taken from it: through screens, or everywhere. What the public functions ask
 * for are events (event/event.h); the sheet_...() below perform them, when they happen and when they are replayed. */
#include "event/event.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a fiber gets of a pigment in all layers, or of water in one, by putting it there; more may flow in. */
#define PUT_MOST 4.0

static int clip(int64_t at, int length)
{
    return at < 0 ? 0 : at > length ? length : (int)at;
}

static enum paper_status place_check(const struct paper_place *place)
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
        f_set(share, 1.0);
        return PAPER_OK;
    }
    int width = p->page.width, height = p->page.height;
    uint8_t *gray = calloc((size_t)height, (size_t)width);
    if (!gray)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a screen of %dx%d", width, height);
    int x1 = clip(x, width), x2 = clip((int64_t)x + screen->width_px, width);
    int y1 = clip(y, height), y2 = clip((int64_t)y + screen->height_px, height);
    for (int row = y1; row < y2 && x1 < x2; row++)
        memcpy(gray + (size_t)row * (size_t)width + x1,
               screen->gray + (size_t)(row - y) * (size_t)screen->width_px + (x1 - x),
               (size_t)(x2 - x1));
    u_array_write(p, p->mask, 8, gray, CM_8_bit);
    CM_f_u_float_2_2L(share, p->mask, 8, SHEET_F);
    f_times(share, share, 1 / 255.0);
    free(gray);
    return PAPER_OK;
}

void sheet_resist_heed(struct paper_sheet *p, CM_field_id_t share, CM_field_id_t open)
{
    f_from(open, 1.0, p->resist);
    f_least(open, open, 0.0);
    f_mul(share, share, open);
}

void sheet_wet_around_make(struct paper_sheet *p)
{
    if (!sheet_has(p, PAPER_PART_EDGE))
        return;
    f_most(p->t[0], p->surface_water, 1.0);
    f_max(p->wet_around, p->wet_around, p->t[0]);
}

/* Where water (0) or a pigment (1 + its number) is put. */
static CM_field_id_t amount_field(const struct paper_sheet *p, int substance)
{
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    if (substance == 0)
        return surface ? p->surface_water : p->page.water;
    return surface ? p->surface[substance - 1] : p->infused[substance - 1];
}

void sheet_amount_put(struct paper_sheet *p, int substance, CM_field_id_t part)
{
    CM_field_id_t q = amount_field(p, substance), left = p->t[3], fields[3] = {q};
    int count = substance == 0 ? 1 : sheet_pigment_fields(p, substance - 1, fields);
    if (p->unit != 1)
        f_whole(part);
    f_from(left, (p->unit == 1 ? 1 : PUT_MOST) * p->unit, fields[0]);
    for (int i = 1; i < count; i++)
        f_sub(left, left, fields[i]);
    f_least(left, left, 0.0);
    f_min(part, part, left);
    f_add(q, q, part);
}

enum paper_status paper_sheet_put(struct paper_sheet *p, const struct paper_screen *screen,
                                  int x, int y, const double *amount)
{
    struct event_put put = {.place = {screen, x, y}};
    for (int i = 0; i <= p->config.pigments_count; i++)
        put.amount[i] = amount[i];
    return sheet_event(p, SHEET_EVENT_PUT, &put);
}

enum paper_status sheet_put_check(const struct paper_sheet *p, const void *arguments)
{
    const struct event_put *put = arguments;
    for (int i = 0; i <= p->config.pigments_count; i++)
        if (!(fabs(put->amount[i]) <= PUT_MOST))
            return paper_fail(PAPER_BAD_ARGUMENT, "the amount of %.*s must be %g..%g (got %g)",
                              PAPER_NAME_MAX, i == 0 ? "water" : p->config.pigments[i - 1].name,
                              -PUT_MOST, PUT_MOST, put->amount[i]);
    return place_check(&put->place);
}

enum paper_status sheet_put(struct paper_sheet *p, const void *arguments)
{
    const struct event_put *put = arguments;
    const double *amount = put->amount;
    paper_enter(&p->page);
    CM_set_context();
    CM_field_id_t share = p->t[1], part = p->t[2];
    enum paper_status status = sheet_share_make(p, &put->place, share);
    if (status != PAPER_OK)
        return status;
    sheet_resist_heed(p, share, part);
    for (int i = 0; i <= p->config.pigments_count; i++) {
        if (amount[i] == 0)
            continue;
        f_times(part, share, amount[i] * p->unit);
        if (amount[i] > 0) {
            sheet_amount_put(p, i, part);
        } else {
            CM_field_id_t q = amount_field(p, i);
            if (p->unit != 1)
                f_whole(part);
            f_add(q, q, part);
            f_least(q, q, 0.0);
        }
    }
    sheet_wet_around_make(p);
    return paper_leave(&p->page);
}

void sheet_amount_lose(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t share, double part,
                       CM_field_id_t lost)
{
    f_times(lost, share, part);
    f_mul(lost, lost, q);
    if (p->unit != 1)
        f_whole_of(lost, q);
    f_sub(q, q, lost);
}

enum paper_status paper_sheet_blot(struct paper_sheet *p, const struct paper_screen *screen,
                                   int x, int y, double part, double lift)
{
    return sheet_event(p, SHEET_EVENT_BLOT, &(struct event_blot){{screen, x, y}, part, lift});
}

enum paper_status sheet_blot_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    const struct event_blot *blot = arguments;
    return place_check(&blot->place);
}

enum paper_status sheet_blot(struct paper_sheet *p, const void *arguments)
{
    const struct event_blot *blot = arguments;
    double part = blot->part, lift = blot->lift;
    paper_enter(&p->page);
    CM_set_context();
    CM_field_id_t share = p->t[1], lost = p->t[2];
    enum paper_status status = sheet_share_make(p, &blot->place, share);
    if (status != PAPER_OK)
        return status;
    sheet_resist_heed(p, share, lost);
    sheet_amount_lose(p, p->page.water, share, part, lost);
    if (sheet_has(p, PAPER_PART_SURFACE))
        sheet_amount_lose(p, p->surface_water, share, part, lost);
    for (int i = 0; i < p->config.pigments_count; i++) {
        sheet_amount_lose(p, p->infused[i], share, part, lost);
        if (sheet_has(p, PAPER_PART_SURFACE))
            sheet_amount_lose(p, p->surface[i], share, part, lost);
        if (sheet_has(p, PAPER_PART_FIXING) && lift > 0)
            sheet_amount_lose(p, p->fixed[i], share, lift, lost);
    }
    return paper_leave(&p->page);
}

enum paper_status paper_sheet_resist(struct paper_sheet *p, const struct paper_screen *screen,
                                     int x, int y, bool on)
{
    return sheet_event(p, SHEET_EVENT_RESIST, &(struct event_resist){{screen, x, y}, on});
}

enum paper_status sheet_resist_check(const struct paper_sheet *p, const void *arguments)
{
    const struct event_resist *resist = arguments;
    enum paper_status status = place_check(&resist->place);
    if (status == PAPER_OK && p->config.parts == 0)
        return paper_fail(
            PAPER_BAD_ARGUMENT,
            "the thesis's paper takes no masking fluid; choose a paper with parts");
    return status;
}

enum paper_status sheet_resist(struct paper_sheet *p, const void *arguments)
{
    const struct event_resist *resist = arguments;
    paper_enter(&p->page);
    CM_set_context();
    CM_field_id_t share = p->t[2];
    enum paper_status status = sheet_share_make(p, &resist->place, share);
    if (status != PAPER_OK)
        return status;
    if (resist->on) {
        f_max(p->resist, p->resist, share);
    } else {
        f_from(share, 1.0, share);
        f_min(p->resist, p->resist, share);
    }
    sheet_faces_make(p);
    return paper_leave(&p->page);
}

enum paper_status paper_sheet_dry(struct paper_sheet *p)
{
    return sheet_event(p, SHEET_EVENT_DRY, NULL);
}

enum paper_status paper_sheet_seal(struct paper_sheet *p)
{
    return sheet_event(p, SHEET_EVENT_SEAL, NULL);
}

enum paper_status sheet_dry(struct paper_sheet *p, const void *arguments)
{
    (void)arguments;
    paper_enter(&p->page);
    CM_set_context();
    CM_field_id_t water[2] = {p->page.water, p->surface_water}, count = p->t[0];
    for (int i = 0; i < (sheet_has(p, PAPER_PART_SURFACE) ? 2 : 1); i++) {
        if (p->unit != 1) {
            CM_u_f_truncate_2_2L(count, water[i], SHEET_DRIED_BITS, SHEET_F);
            CM_u_add_2_1L(p->dried, count, SHEET_DRIED_BITS);
        }
        f_set(water[i], 0.0);
    }
    for (int i = 0; i < p->config.pigments_count; i++) {
        CM_field_id_t at = sheet_has(p, PAPER_PART_FIXING) ? p->fixed[i] : p->infused[i];
        if (sheet_has(p, PAPER_PART_SURFACE)) {
            f_add(at, at, p->surface[i]);
            f_set(p->surface[i], 0.0);
        }
        if (sheet_has(p, PAPER_PART_FIXING)) {
            f_add(at, at, p->infused[i]);
            f_set(p->infused[i], 0.0);
        }
    }
    if (sheet_has(p, PAPER_PART_EDGE))
        f_set(p->wet_around, 0.0);
    if (p->salted) { /* brushed off */
        f_set(p->salt, 0.0);
        f_set(p->brine, 0.0);
        p->salted = false;
    }
    return paper_leave(&p->page);
}

enum paper_status sheet_seal(struct paper_sheet *p, const void *arguments)
{
    enum paper_status status = sheet_dry(p, arguments);
    if (status != PAPER_OK)
        return status;
    paper_enter(&p->page);
    CM_field_id_t color[3] = {p->t[8], p->t[9], p->t[10]}, fields[3];
    sheet_color_make(p, color);
    for (int i = 0; i < 3; i++)
        f_copy(p->substrate[i], color[i]);
    for (int i = 0; i < p->config.pigments_count; i++)
        for (int j = sheet_pigment_fields(p, i, fields) - 1; j >= 0; j--)
            f_set(fields[j], 0.0);
    return paper_leave(&p->page);
}
