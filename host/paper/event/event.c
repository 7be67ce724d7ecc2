/* event.c - the table of events: their names, arguments, checks and functions. */
#include "event/event.h"

#include "arguments/forms.h"
#include "arguments/rows.h"
#include "model/model.h"

#include <scale.h>

#include <string.h>

static enum paper_status air_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    return paper_weather_check(&((const struct paper_air *)arguments)->thesis);
}

static enum paper_status air_set(struct paper_sheet *p, const void *arguments)
{
    p->air = *(const struct paper_air *)arguments;
    return PAPER_OK;
}

/* It is a name in the history, and nothing on the sheet. */
static enum paper_status bookmark_set(struct paper_sheet *p, const void *arguments)
{
    (void)p;
    (void)arguments;
    return PAPER_OK;
}

static const struct members nothing = {NULL, 0};

static const struct row {
    struct event_kind kind;
    enum paper_status (*check)(const struct paper_sheet *,
                               const void *); /* further checks; NULL: none */
    enum paper_status (*perform)(struct paper_sheet *, const void *arguments);
} rows[SHEET_EVENT_KINDS] = {
#define WITH(type, members) sizeof(struct type), &paper_##members##_members
    [SHEET_EVENT_STEP] = {{"step", "", 0, &nothing}, NULL, sheet_step},
    [SHEET_EVENT_AIR] = {{"air", "", WITH(paper_air, air)}, air_check, air_set},
    [SHEET_EVENT_PUT] = {{"put", "", WITH(event_put, put)}, sheet_put_check, sheet_put},
    [SHEET_EVENT_BLOT] = {{"blot", "blotting's ", WITH(event_blot, blot)},
                          sheet_blot_check,
                          sheet_blot},
    [SHEET_EVENT_RESIST] = {{"resist", "", WITH(event_resist, resist)},
                            sheet_resist_check,
                            sheet_resist},
    [SHEET_EVENT_DRY] = {{"dry", "", 0, &nothing}, NULL, sheet_dry},
    [SHEET_EVENT_SEAL] = {{"seal", "", 0, &nothing}, NULL, sheet_seal},
    [SHEET_EVENT_LAYER] = {{"layer", "", WITH(event_layer, layer)},
                           sheet_layer_check,
                           sheet_layer},
    [SHEET_EVENT_BRUSH] = {{"brush", "a brush's ", WITH(paper_brush, brush)},
                           sheet_brush_check,
                           sheet_brush},
    [SHEET_EVENT_DIP] = {{"dip", "a dip's ", WITH(paper_dip, dip)}, sheet_dip_check, sheet_dip},
    [SHEET_EVENT_STROKE] = {{"stroke", "a stroke's ", WITH(paper_stroke, stroke)},
                            sheet_stroke_check,
                            sheet_stroke},
    [SHEET_EVENT_SALT] = {{"salt", "salt's ", WITH(paper_salt, salt)},
                          sheet_salt_check,
                          sheet_salt},
    [SHEET_EVENT_WASH] = {{"wash", "a wash's ", WITH(paper_wash, wash)},
                          sheet_wash_check,
                          sheet_wash},
    [SHEET_EVENT_PRINT] = {{"print", "", WITH(paper_print, print)},
                           sheet_print_check,
                           sheet_print},
    [SHEET_EVENT_LIFT] = {{"lift", "lift's ", WITH(paper_lift, lift)},
                          sheet_lift_check,
                          sheet_lift},
    [SHEET_EVENT_VARNISH] = {{"varnish", "varnish's ", WITH(paper_varnish, varnish)},
                             sheet_varnish_check,
                             sheet_varnish},
    [SHEET_EVENT_BOOKMARK] = {{"bookmark", "", WITH(paper_bookmark, bookmark)},
                              NULL,
                              bookmark_set},
#undef WITH
};

const struct event_kind *sheet_event_kind(enum sheet_event_kind kind)
{
    return &rows[kind].kind;
}

const char *sheet_event_name(enum sheet_event_kind kind)
{
    return rows[kind].kind.name;
}

int sheet_event_find(const char *name, size_t length)
{
    for (int i = 0; i < SHEET_EVENT_KINDS; i++)
        if (strlen(rows[i].kind.name) == length && memcmp(rows[i].kind.name, name, length) == 0)
            return i;
    return -1;
}

enum paper_status sheet_event_check(const struct paper_sheet *p, enum sheet_event_kind kind,
                                    const void *arguments)
{
    const struct row *row = &rows[kind];
    enum paper_status status =
        paper_members_check(row->kind.members, arguments, row->kind.whose, "");
    return status == PAPER_OK && row->check ? row->check(p, arguments) : status;
}

enum paper_status sheet_event_perform(struct paper_sheet *p, enum sheet_event_kind kind,
                                      const void *arguments)
{
    return rows[kind].perform(p, arguments);
}

enum paper_status sheet_event_decoded(enum event_decoded decoded, enum sheet_event_kind kind)
{
    const char *name = sheet_event_name(kind);
    switch (decoded) {
    case EVENT_DAMAGED:
        return paper_fail(PAPER_BAD_FILE, "an event (%s) is damaged", name);
    case EVENT_NO_MEMORY:
        return paper_fail(PAPER_NO_MEMORY, "no memory for an event (%s)", name);
    case EVENT_DECODED:
        break;
    }
    return PAPER_OK;
}

enum paper_status sheet_event_scale(enum sheet_event_kind kind, void *arguments,
                                    const struct event_scaling *scaling)
{
    if (!members_scale(rows[kind].kind.members, arguments, scaling))
        return paper_fail(PAPER_NO_MEMORY, "no memory for an event (%s) at another resolution",
                          sheet_event_name(kind));
    return PAPER_OK;
}
