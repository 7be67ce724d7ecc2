/* event.c - the table of events: what each is called, of what it consists, how it is checked and performed.
 *
 * Its bytes are made in event/bytes.c, other resolutions in event/scale.c, both from the rows of arguments/members.c. */
#include "event/event.h"

#include "arguments/members.h"
#include "model/model.h"

#include <stdlib.h>
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

static const struct members nothing = {NULL, 0};

static const struct kind {
    const char *name;  /* in files: never changed */
    const char *whose; /* in messages, its members */
    size_t size;
    const struct members *members;
    enum paper_status (*check)(const struct paper_sheet *,
                               const void *); /* what else; NULL: nothing */
    enum paper_status (*perform)(struct paper_sheet *, const void *);
} kinds[SHEET_EVENT_KINDS] = {
#define WITH(type, members) sizeof(struct type), &event_##members##_members
    [SHEET_EVENT_STEP] = {"step", "", 0, &nothing, NULL, sheet_step},
    [SHEET_EVENT_AIR] = {"air", "", WITH(paper_air, air), air_check, air_set},
    [SHEET_EVENT_PUT] = {"put", "", WITH(event_put, put), sheet_put_check, sheet_put},
    [SHEET_EVENT_BLOT] = {"blot", "blotting's ", WITH(event_blot, blot), sheet_blot_check,
                          sheet_blot},
    [SHEET_EVENT_RESIST] = {"resist", "", WITH(event_resist, resist), sheet_resist_check,
                            sheet_resist},
    [SHEET_EVENT_DRY] = {"dry", "", 0, &nothing, NULL, sheet_dry},
    [SHEET_EVENT_SEAL] = {"seal", "", 0, &nothing, NULL, sheet_seal},
    [SHEET_EVENT_LAYER] = {"layer", "", WITH(event_layer, layer), sheet_layer_check,
                           sheet_layer},
    [SHEET_EVENT_BRUSH] = {"brush", "a brush's ", WITH(paper_brush, brush), sheet_brush_check,
                           sheet_brush},
    [SHEET_EVENT_DIP] = {"dip", "a dip's ", WITH(paper_dip, dip), sheet_dip_check, sheet_dip},
    [SHEET_EVENT_STROKE] = {"stroke", "a stroke's ", WITH(paper_stroke, stroke),
                            sheet_stroke_check, sheet_stroke},
    [SHEET_EVENT_SALT] = {"salt", "salt's ", WITH(paper_salt, salt), sheet_salt_check,
                          sheet_salt},
    [SHEET_EVENT_WASH] = {"wash", "a wash's ", WITH(paper_wash, wash), sheet_wash_check,
                          sheet_wash},
    [SHEET_EVENT_PRINT] = {"print", "", WITH(paper_print, print), sheet_print_check,
                           sheet_print},
    [SHEET_EVENT_LIFT] = {"lift", "lift's ", WITH(paper_lift, lift), sheet_lift_check,
                          sheet_lift},
    [SHEET_EVENT_VARNISH] = {"varnish", "varnish's ", WITH(paper_varnish, varnish),
                             sheet_varnish_check, sheet_varnish},
#undef WITH
};

const char *event_name(enum sheet_event_kind kind)
{
    return kinds[kind].name;
}

const struct members *event_members(enum sheet_event_kind kind)
{
    return kinds[kind].members;
}

int event_find(const char *name, size_t length)
{
    for (int i = 0; i < SHEET_EVENT_KINDS; i++)
        if (strlen(kinds[i].name) == length && memcmp(kinds[i].name, name, length) == 0)
            return i;
    return -1;
}

enum paper_status event_check(const struct paper_sheet *p, enum sheet_event_kind kind,
                              const void *arguments)
{
    const struct kind *k = &kinds[kind];
    enum paper_status status = event_members_check(k->members, arguments, k->whose, "");
    return status == PAPER_OK && k->check ? k->check(p, arguments) : status;
}

enum paper_status event_perform(struct paper_sheet *p, enum sheet_event_kind kind,
                                const void *arguments)
{
    return kinds[kind].perform(p, arguments);
}

/* ---- arguments of our own ---- */

void *event_blank(enum sheet_event_kind kind)
{
    return calloc(1, kinds[kind].size);
}

static void place_free(const struct paper_place *place)
{
    if (place->screen)
        free(place->screen->gray);
    free(event_owned(place->screen));
}

void event_free(enum sheet_event_kind kind, void *arguments)
{
    const struct members *members = kinds[kind].members;
    for (size_t i = 0; arguments && i < members->count; i++) {
        const struct member *m = &members->first[i];
        const void *start = (const char *)arguments + m->offset;
        if (m->kind == MEMBER_PLACE)
            place_free(start);
        else if (m->kind == MEMBER_PLANE)
            free(event_owned(*(const float *const *)start));
        else if (m->kind == MEMBER_SAMPLES)
            free(event_owned(((const struct paper_stroke *)arguments)->samples));
        else if (m->kind == MEMBER_AMOUNTS)
            for (int j = 0; j <= PAPER_PIGMENTS_MAX; j++)
                free(event_owned(((const struct paper_print *)arguments)->amount[j]));
    }
    free(arguments);
}
