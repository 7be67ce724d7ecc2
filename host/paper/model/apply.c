/* apply.c - what is put on a sheet and taken from it: through screens, or everywhere. What the
 * public functions ask for are events (event/event.h); the sheet_...() below perform them, when
 * they happen and when they are replayed. */
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum paper_status sheet_put_check(const struct paper_sheet *p, const void *arguments)
{
    const struct event_put *put = arguments;
    for (int i = 0; i <= p->config.pigments_count; i++)
        if (!(fabs(put->amount[i]) <= SHEET_PUT_MOST))
            return paper_fail(PAPER_BAD_ARGUMENT, "the amount of %.*s must be %g..%g (got %g)",
                              PAPER_NAME_MAX, i == 0 ? "water" : p->config.pigments[i - 1].name,
                              -SHEET_PUT_MOST, SHEET_PUT_MOST, put->amount[i]);
    return sheet_place_check(&put->place);
}

enum paper_status sheet_put(struct paper_sheet *p, const void *arguments)
{
    const struct event_put *put = arguments;
    const double *amount = put->amount;
    sheet_change_place(p, &put->place);
    CM_set_context();
    CM_field_id_t share = p->t[1], part = p->t[2];
    enum paper_status status = sheet_share_make(p, &put->place, share);
    if (status != PAPER_OK)
        return status;
    sheet_resist_heed(p, share, part);
    for (int i = 0; i <= p->config.pigments_count; i++) {
        if (amount[i] == 0)
            continue;
        kit_f_times(part, share, amount[i] * p->unit);
        if (amount[i] > 0) {
            sheet_amount_put(p, i, part);
        } else {
            CM_field_id_t q = sheet_amount_field(p, i);
            if (p->unit != 1)
                kit_f_whole(part);
            kit_f_add(q, q, part);
            kit_f_least(q, q, 0.0);
        }
    }
    sheet_wet_put(p, amount[0] > 0, share);
    return sheet_leave(p);
}

enum paper_status sheet_blot_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    const struct event_blot *blot = arguments;
    return sheet_place_check(&blot->place);
}

enum paper_status sheet_blot(struct paper_sheet *p, const void *arguments)
{
    const struct event_blot *blot = arguments;
    double part = blot->part, lift = blot->lift;
    sheet_change_place(p, &blot->place);
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
    return sheet_leave(p);
}

enum paper_status sheet_resist_check(const struct paper_sheet *p, const void *arguments)
{
    const struct event_resist *resist = arguments;
    enum paper_status status = sheet_place_check(&resist->place);
    if (status == PAPER_OK && p->config.parts == 0)
        return paper_fail(
            PAPER_BAD_ARGUMENT,
            "the thesis's paper takes no masking fluid; choose a paper with parts");
    return status;
}

enum paper_status sheet_resist(struct paper_sheet *p, const void *arguments)
{
    const struct event_resist *resist = arguments;
    sheet_change_place(p, &resist->place);
    CM_set_context();
    CM_field_id_t share = p->t[2];
    enum paper_status status = sheet_share_make(p, &resist->place, share);
    if (status != PAPER_OK)
        return status;
    if (resist->on) {
        kit_f_max(p->resist, p->resist, share);
    } else {
        kit_f_from(share, 1.0, share);
        kit_f_min(p->resist, p->resist, share);
    }
    sheet_faces_make(p);
    return sheet_leave(p);
}

enum paper_status sheet_dry(struct paper_sheet *p, const void *arguments)
{
    (void)arguments;
    sheet_change(p);
    CM_set_context();
    CM_field_id_t water[2] = {p->page.water, p->surface_water}, count = p->t[0];
    for (int i = 0; i < (sheet_has(p, PAPER_PART_SURFACE) ? 2 : 1); i++) {
        if (p->unit != 1) {
            CM_u_f_truncate_2_2L(count, water[i], SHEET_DRIED_BITS, KIT_F);
            CM_u_add_2_1L(p->dried, count, SHEET_DRIED_BITS);
        }
        kit_f_set(water[i], 0.0);
    }
    for (int i = 0; i < p->config.pigments_count; i++) {
        CM_field_id_t at = sheet_has(p, PAPER_PART_FIXING) ? p->fixed[i] : p->infused[i];
        if (sheet_has(p, PAPER_PART_SURFACE)) {
            kit_f_add(at, at, p->surface[i]);
            kit_f_set(p->surface[i], 0.0);
        }
        if (sheet_has(p, PAPER_PART_FIXING)) {
            kit_f_add(at, at, p->infused[i]);
            kit_f_set(p->infused[i], 0.0);
        }
    }
    if (p->config.parts) {
        kit_f_set(p->wet_around, 0.0);
        kit_f_set(p->wet_part, 0.0);
        kit_f_set(p->speed[0], 0.0);
        kit_f_set(p->speed[1], 0.0);
    }
    if (p->salted) { /* brushed off */
        kit_f_set(p->salt, 0.0);
        kit_f_set(p->brine, 0.0);
        p->salted = false;
    }
    return sheet_leave(p);
}

enum paper_status sheet_seal(struct paper_sheet *p, const void *arguments)
{
    enum paper_status status = sheet_dry(p, arguments);
    if (status != PAPER_OK)
        return status;
    sheet_change(p);
    CM_field_id_t color[3] = {p->t[8], p->t[9], p->t[10]}, fields[3];
    sheet_color_make(p, color);
    for (int i = 0; i < 3; i++)
        kit_f_copy(p->substrate[i], color[i]);
    for (int i = 0; i < p->config.pigments_count; i++)
        for (int j = sheet_pigment_fields(p, i, fields) - 1; j >= 0; j--)
            kit_f_set(fields[j], 0.0);
    kit_f_set(p->stained, 0.0);
    return sheet_leave(p);
}
