/* layers.c - what a sheet is made of and what is in it, layer by layer, in and out; and its
 * totals. */
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    size_t member; /* of the field's id in struct paper_sheet */
    bool each;     /* one for each pigment */
    bool amount;   /* in grains */
    double low, high;
} layers[PAPER_LAYERS_COUNT] = {
#define LAYER(name, member, each, amount, low, high)                                           \
    [PAPER_LAYER_##name] = {offsetof(struct paper_sheet, member), each, amount, low, high}
    LAYER(HEIGHT, height, false, false, 0, 1),
    LAYER(ABSORBENCY, page.absorbency, false, false, 0, PAPER_ABSORBENCY_MAX),
    LAYER(CAPACITY, capacity, false, false, 0.01, 1),
    LAYER(RESIST, resist, false, false, 0, 1),
    LAYER(VARNISH, varnish, false, false, 0, 1),
    LAYER(SALT, salt, false, false, 0, 4),
    LAYER(BRINE, brine, false, false, 0, 4),
    LAYER(RED, substrate[0], false, false, 0, 1),
    LAYER(GREEN, substrate[1], false, false, 0, 1),
    LAYER(BLUE, substrate[2], false, false, 0, 1),
    LAYER(SURFACE_WATER, surface_water, false, true, 0, 4),
    LAYER(INFUSED_WATER, page.water, false, true, 0, 4),
    LAYER(DRIED_WATER, dried, false, true, 0, 0),
    LAYER(SURFACE_PIGMENT, surface, true, true, 0, 4),
    LAYER(INFUSED_PIGMENT, infused, true, true, 0, 4),
    LAYER(FIXED_PIGMENT, fixed, true, true, 0, 4),
    LAYER(SIZING, sizing, false, false, 0.01, 100),
    LAYER(CURRENT, current, false, false, -10, 10),
    LAYER(WET_PART, wet_part, false, false, 0, 1),
    LAYER(GRIP, grip, false, false, PAPER_GRIP_LEAST, PAPER_GRIP_MOST),
    LAYER(THICKNESS, thickness, false, false, 0, 1),
    LAYER(STAINED_PART, stained, false, false, 0, 1),
#undef LAYER
};

CM_field_id_t sheet_layer_field(const struct paper_sheet *p, enum paper_layer layer,
                                int pigment)
{
    CM_field_id_t field;
    if ((unsigned)layer >= PAPER_LAYERS_COUNT ||
        (layers[layer].each && (pigment < 0 || pigment >= p->config.pigments_count)))
        return 0;
    size_t at =
        layers[layer].member + (layers[layer].each ? (size_t)pigment : 0) * sizeof field;
    memcpy(&field, (const char *)p + at, sizeof field);
    return field;
}

bool sheet_layer_amount(enum paper_layer layer)
{
    return layers[layer].amount;
}

static enum paper_status layer_check(const struct paper_sheet *p, enum paper_layer layer,
                                     int pigment, CM_field_id_t *field)
{
    *field = sheet_layer_field(p, layer, pigment);
    if (*field)
        return PAPER_OK;
    if (layer == PAPER_LAYER_THICKNESS)
        return paper_fail(PAPER_BAD_ARGUMENT, "only paper with a deckle has a thickness");
    return paper_fail(PAPER_BAD_ARGUMENT,
                      "the sheet has no layer %d of pigment %d (it has %d pigments)",
                      (int)layer, pigment, p->config.pigments_count);
}

enum paper_status sheet_layer_check(const struct paper_sheet *p, const void *arguments)
{
    const struct event_layer *event = arguments;
    CM_field_id_t field;
    enum paper_status status =
        layer_check(p, (enum paper_layer)event->layer, event->pigment, &field);
    if (status == PAPER_OK && event->layer == PAPER_LAYER_DRIED_WATER)
        return paper_fail(PAPER_BAD_ARGUMENT, "what has dried is counted, not written");
    if (status == PAPER_OK && event->layer == PAPER_LAYER_WET_PART)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "what part of a fiber is wet follows its water and is not written");
    if (status == PAPER_OK && event->layer == PAPER_LAYER_STAINED_PART)
        return paper_fail(
            PAPER_BAD_ARGUMENT,
            "what part of a fiber is stained follows its paint and is not written");
    bool film = event->layer == PAPER_LAYER_SIZING || event->layer == PAPER_LAYER_CURRENT;
    if (status == PAPER_OK && film && !sheet_has(p, PAPER_PART_SURFACE))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "paper has sizing and currents where water flows: with a surface");
    if (status == PAPER_OK && event->layer == PAPER_LAYER_GRIP && !p->config.parts)
        return paper_fail(PAPER_BAD_ARGUMENT, "the thesis's paper has no grip");
    unsigned part = event->layer == PAPER_LAYER_SURFACE_PIGMENT ? PAPER_PART_SURFACE
                    : event->layer == PAPER_LAYER_FIXED_PIGMENT ? PAPER_PART_FIXING
                                                                : 0;
    if (status == PAPER_OK && part && !sheet_has(p, part))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "pigments have no such layer in this model of the paper");
    size_t width = (size_t)p->page.grid.width, count = width * (size_t)p->page.grid.height;
    for (size_t i = 0; i < count && status == PAPER_OK; i++)
        if (isnan(event->values[i]))
            return paper_fail(PAPER_BAD_ARGUMENT, "the value at %zu, %zu is not a number",
                              i % width, i / width);
    return status;
}

void paper_sheet_layer_range(const struct paper_sheet *p, enum paper_layer layer,
                             double range[2])
{
    range[0] = layers[layer].low;
    range[1] = layers[layer].amount && p->unit == 1 ? 1 : layers[layer].high;
}

enum paper_status sheet_layer(struct paper_sheet *p, const void *arguments)
{
    const struct event_layer *event = arguments;
    enum paper_layer layer = (enum paper_layer)event->layer;
    const float *values = event->values;
    CM_field_id_t field = sheet_layer_field(p, layer, event->pigment);
    enum paper_status status = PAPER_OK;
    size_t count = (size_t)p->page.grid.width * (size_t)p->page.grid.height;
    double unit = layers[layer].amount ? p->unit : 1;
    double range[2];
    paper_sheet_layer_range(p, layer, range);
    float *cut = malloc(count * sizeof *cut);
    if (!cut)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a layer of %dx%d", p->page.grid.width,
                          p->page.grid.height);
    for (size_t i = 0; i < count; i++) {
        double value = fmin(range[1], fmax(range[0], values[i])) * unit;
        cut[i] = (float)(unit > 1 ? floor(value) : value);
    }
    sheet_change(p);
    CM_set_context();
    kit_grid_f_write(&p->page.grid, field, cut);
    if (p->config.deckled && layers[layer].amount)
        sheet_paper_heed(p, field);
    if (layer == PAPER_LAYER_HEIGHT)
        sheet_heights_changed(p);
    p->varnished = p->varnished || layer == PAPER_LAYER_VARNISH;
    p->salted = p->salted || layer == PAPER_LAYER_SALT || layer == PAPER_LAYER_BRINE;
    if (layer == PAPER_LAYER_ABSORBENCY || layer == PAPER_LAYER_RESIST ||
        layer == PAPER_LAYER_SIZING || layer == PAPER_LAYER_CURRENT ||
        layer == PAPER_LAYER_THICKNESS)
        sheet_faces_make(p);
    if (layers[layer].each) { /* paint lies on all of each fiber */
        sheet_paint_sum(p, p->t[0]);
        kit_f_most(p->stained, p->t[0], 1.0);
    }
    if (layer == PAPER_LAYER_SURFACE_WATER || layer == PAPER_LAYER_INFUSED_WATER)
        sheet_wet_around_make(p);
    status = sheet_leave(p);
    free(cut);
    return status;
}

enum paper_status sheet_layer_read(struct paper_sheet *p, enum paper_layer layer, int pigment,
                                   float *values)
{
    CM_field_id_t field;
    enum paper_status status = layer_check(p, layer, pigment, &field);
    if (status != PAPER_OK)
        return status;
    sheet_look(p);
    CM_set_context();
    if (layer == PAPER_LAYER_DRIED_WATER) {
        CM_f_u_float_2_2L(p->t[0], field, SHEET_DRIED_BITS, KIT_F);
        field = p->t[0];
    }
    kit_grid_f_read(&p->page.grid, values, field);
    status = sheet_leave(p);
    size_t count = (size_t)p->page.grid.width * (size_t)p->page.grid.height;
    if (layers[layer].amount && p->unit != 1)
        for (size_t i = 0; i < count; i++)
            values[i] *= (float)(1 / p->unit);
    return status;
}

/* Sum of whole numbers, in doubles: exact up to 2^53 grains. */
static double field_total(CM_field_id_t field, CM_field_id_t wide)
{
    CM_f_move_2L(wide, field, 52, 11, KIT_F);
    return CM_global_f_add_1L(wide, 52, 11);
}

enum paper_status sheet_total(struct paper_sheet *p, int substance, double *total)
{
    if (substance < -1 || substance > p->config.pigments_count)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has %d pigments (asked for number %d)",
                          p->config.pigments_count, substance);
    sheet_look(p);
    CM_set_context();
    CM_field_id_t wide = CM_allocate_heap_field(64), fields[3];
    *total = 0;
    if (substance < 0) {
        CM_f_u_float_2_2L(wide, p->dried, SHEET_DRIED_BITS, 52, 11);
        *total = CM_global_f_add_1L(wide, 52, 11);
    } else if (substance == 0) {
        *total = field_total(p->page.water, wide);
        if (sheet_has(p, PAPER_PART_SURFACE))
            *total += field_total(p->surface_water, wide);
    } else {
        for (int j = sheet_pigment_fields(p, substance - 1, fields) - 1; j >= 0; j--)
            *total += field_total(fields[j], wide);
    }
    *total /= p->unit;
    CM_deallocate_heap_field(wide);
    return sheet_leave(p);
}
