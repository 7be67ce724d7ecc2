/* door.c - the public functions of sheets. A function that changes a sheet is an event,
 * which sheet_event() checks, performs and records. A function that reads a sheet first
 * brings it to its present position in the history (sheet_ready()), and then asks the model. */
#include "history/history_internal.h"
#include "model/model.h"

#include <string.h>

/* ---- life ---- */

enum paper_status paper_sheet_create(const struct paper_sheet_config *config,
                                     struct paper_sheet **out)
{
    return sheet_create(config, out);
}

void paper_sheet_destroy(struct paper_sheet *p)
{
    history_sheet_destroy(p);
}

const struct paper_sheet_config *paper_sheet_get_config(const struct paper_sheet *p)
{
    return &p->config;
}

/* ---- time ---- */

enum paper_status paper_sheet_air(struct paper_sheet *p, const struct paper_air *air)
{
    return sheet_event(p, SHEET_EVENT_AIR, air);
}

enum paper_status paper_sheet_bookmark(struct paper_sheet *p,
                                       const struct paper_bookmark *bookmark)
{
    return sheet_event(p, SHEET_EVENT_BOOKMARK, bookmark);
}

const struct paper_air *paper_sheet_get_air(const struct paper_sheet *p)
{
    return history_air(p);
}

enum paper_status paper_sheet_step(struct paper_sheet *p)
{
    return sheet_event(p, SHEET_EVENT_STEP, NULL);
}

enum paper_status paper_sheet_confine(struct paper_sheet *p, int unit)
{
    return sheet_confine(p, unit);
}

enum paper_status paper_sheet_part_from(struct paper_sheet *p, double fibers)
{
    if (!(fibers >= 0))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "steps are computed in parts from 0 fibers or more (got %g)", fibers);
    p->parted_from = fibers;
    return PAPER_OK;
}

double paper_sheet_share(const struct paper_sheet *p)
{
    return sheet_share(p);
}

enum paper_status paper_sheet_finish(struct paper_sheet *p)
{
    return sheet_finish(p);
}

/* ---- water, pigments and what else comes on paper ---- */

enum paper_status paper_sheet_put(struct paper_sheet *p, const struct paper_screen *screen,
                                  int x, int y, const double *amount)
{
    struct event_put put = {.place = {screen, x, y}};
    for (int i = 0; i <= p->config.pigments_count; i++)
        put.amount[i] = amount[i];
    return sheet_event(p, SHEET_EVENT_PUT, &put);
}

enum paper_status paper_sheet_blot(struct paper_sheet *p, const struct paper_screen *screen,
                                   int x, int y, double part, double lift)
{
    return sheet_event(p, SHEET_EVENT_BLOT, &(struct event_blot){{screen, x, y}, part, lift});
}

enum paper_status paper_sheet_resist(struct paper_sheet *p, const struct paper_screen *screen,
                                     int x, int y, bool on)
{
    return sheet_event(p, SHEET_EVENT_RESIST, &(struct event_resist){{screen, x, y}, on});
}

enum paper_status paper_sheet_dry(struct paper_sheet *p)
{
    return sheet_event(p, SHEET_EVENT_DRY, NULL);
}

enum paper_status paper_sheet_seal(struct paper_sheet *p)
{
    return sheet_event(p, SHEET_EVENT_SEAL, NULL);
}

enum paper_status paper_sheet_layer_write(struct paper_sheet *p, enum paper_layer layer,
                                          int pigment, const float *values)
{
    return sheet_event(p, SHEET_EVENT_LAYER,
                       &(struct event_layer){(int)layer, pigment, values});
}

enum paper_status paper_sheet_wash(struct paper_sheet *p, const struct paper_wash *wash)
{
    return sheet_event(p, SHEET_EVENT_WASH, wash);
}

enum paper_status paper_sheet_print(struct paper_sheet *p, const struct paper_print *print)
{
    return sheet_event(p, SHEET_EVENT_PRINT, print);
}

enum paper_status paper_sheet_lift(struct paper_sheet *p, const struct paper_lift *lift)
{
    return sheet_event(p, SHEET_EVENT_LIFT, lift);
}

enum paper_status paper_sheet_salt(struct paper_sheet *p, const struct paper_salt *salt)
{
    return sheet_event(p, SHEET_EVENT_SALT, salt);
}

enum paper_status paper_sheet_varnish(struct paper_sheet *p,
                                      const struct paper_varnish *varnish)
{
    return sheet_event(p, SHEET_EVENT_VARNISH, varnish);
}

/* ---- brushes ---- */

enum paper_status paper_sheet_brush(struct paper_sheet *p, const struct paper_brush *brush)
{
    return sheet_event(p, SHEET_EVENT_BRUSH, brush);
}

enum paper_status paper_sheet_dip(struct paper_sheet *p, const struct paper_dip *dip)
{
    return sheet_event(p, SHEET_EVENT_DIP, dip);
}

enum paper_status paper_sheet_stroke(struct paper_sheet *p, const struct paper_stroke *stroke,
                                     int *steps)
{
    long before = paper_sheet_steps(p);
    enum paper_status status = sheet_event(p, SHEET_EVENT_STROKE, stroke);
    if (steps)
        *steps = (int)(paper_sheet_steps(p) - before);
    return status;
}

enum paper_status paper_sheet_stroke_begin(struct paper_sheet *p, int number, double pace)
{
    return history_stroke_begin(p, number, pace);
}

enum paper_status paper_sheet_stroke_add(struct paper_sheet *p,
                                         const struct paper_stroke_sample *samples, int count,
                                         int *steps)
{
    const long before = p->steps;
    enum paper_status status = history_stroke_add(p, samples, count);
    if (steps)
        *steps = (int)(p->steps - before);
    return status;
}

enum paper_status paper_sheet_stroke_end(struct paper_sheet *p, int *steps)
{
    const long before = p->steps;
    enum paper_status status = history_stroke_end(p);
    if (steps)
        *steps = (int)(p->steps - before);
    return status;
}

void paper_sheet_stroke_drop(struct paper_sheet *p)
{
    history_stroke_drop(p);
}

bool paper_sheet_stroke_growing(const struct paper_sheet *p)
{
    return sheet_growing(p) != NULL;
}

void paper_sheet_stop_when(struct paper_sheet *p, bool (*due)(void *context), void *context)
{
    p->due = due;
    p->due_context = context;
}

enum paper_status paper_sheet_brush_total(struct paper_sheet *p, int number, int substance,
                                          double *total)
{
    *total = 0;
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_brush_total(p, number, substance, total) : status;
}

/* ---- looking ---- */

enum paper_status paper_sheet_layer_read(struct paper_sheet *p, enum paper_layer layer,
                                         int pigment, float *values)
{
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_layer_read(p, layer, pigment, values) : status;
}

enum paper_status paper_sheet_total(struct paper_sheet *p, int substance, double *total)
{
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_total(p, substance, total) : status;
}

enum paper_status paper_sheet_view(struct paper_sheet *p, const struct paper_sheet_view *view,
                                   uint16_t *rgb)
{
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_view(p, view, rgb) : status;
}

enum paper_status paper_sheet_view_area(struct paper_sheet *p,
                                        const struct paper_sheet_view *view,
                                        const struct paper_area *area, uint8_t *rgb,
                                        size_t pitch_bytes)
{
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_view_area(p, view, area, rgb, pitch_bytes) : status;
}

int paper_sheet_changed(struct paper_sheet *p, struct paper_area areas[PAPER_AREAS_MAX])
{
    if (sheet_ready(p) != PAPER_OK)
        sheet_area_mark_all(p);
    const int count = p->changed.count;
    memcpy(areas, p->changed.at, (size_t)count * sizeof *areas);
    p->changed.count = 0;
    return count;
}

enum paper_status paper_sheet_plane_read(struct paper_sheet *p, int number, void *words)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    int count = paper_sheet_planes(p, planes);
    if (number < 0 || number >= count)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has %d planes (asked for number %d)",
                          count, number);
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_plane_fetch(p, number, words) : status;
}
