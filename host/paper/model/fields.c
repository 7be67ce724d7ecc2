/* fields.c - a sheet's life: its fields, its layers in and out, its totals. */
#include "arguments/members.h"
#include "history/history_internal.h"
#include "model/model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct paper_sheet_config paper_sheet_config_default(void)
{
    struct paper_sheet_config config = {.width = 512,
                                        .height = 512,
                                        .parts = PAPER_PARTS_ALL,
                                        .rule = PAPER_RULE_KUBELKA_MUNK,
                                        .stock = *paper_stock_number(0),
                                        .seed = 1990};
    return config;
}

/* ---- checking ---- */

/* Of what kind it is, and its name, go before what is wrong. */
static enum paper_status named_check(const struct members *members, const void *of,
                                     const char *what, const char *name)
{
    char whose[PAPER_NAME_MAX + 16];
    snprintf(whose, sizeof whose, "%s%s%.*s's ", what, *name ? " " : "", PAPER_NAME_MAX, name);
    return event_members_check(members, of, whose, "");
}

static enum paper_status config_check(const struct paper_sheet_config *c)
{
    if (c->width < PAPER_SIDE_MIN || c->width > PAPER_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper width must be %d..%d (got %d)",
                          PAPER_SIDE_MIN, PAPER_SIDE_MAX, c->width);
    if (c->height < PAPER_SIDE_MIN || c->height > PAPER_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper height must be %d..%d (got %d)",
                          PAPER_SIDE_MIN, PAPER_SIDE_MAX, c->height);
    if (c->parts > PAPER_PARTS_ALL)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper has no parts 0x%x", c->parts);
    if (c->pigments_count < 0 || c->pigments_count > PAPER_PIGMENTS_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper takes 0..%d pigments (got %d)",
                          PAPER_PIGMENTS_MAX, c->pigments_count);
    if (c->rule > PAPER_RULE_LUMINOUS)
        return paper_fail(PAPER_BAD_ARGUMENT, "there is no rule %d", (int)c->rule);
    enum paper_status status =
        named_check(&event_stock_members, &c->stock, "paper", c->stock.name);
    for (int i = 0; i < c->pigments_count && status == PAPER_OK; i++)
        status = named_check(&event_pigment_members, &c->pigments[i], "pigment",
                             c->pigments[i].name);
    return status;
}

/* ---- life ---- */

static int coordinate_bits(int length)
{
    int bits = 1;
    while (bits < 31 && (1 << bits) < length)
        bits++;
    return bits;
}

static CM_field_id_t field_make(unsigned bits)
{
    return CM_allocate_heap_field(bits);
}

static void fields_make(struct paper_sheet *p)
{
    CM_field_id_t *const floats[] = {
        &p->page.absorbency, &p->page.water,   &p->page.inflow,   &p->page.inward,
        &p->page.outward,    &p->page.scratch, &p->height,        &p->capacity,
        &p->resist,          &p->face[0],      &p->face[1],       &p->substrate[0],
        &p->substrate[1],    &p->substrate[2], &p->surface_water, &p->wet_around,
        &p->varnish,         &p->salt,         &p->brine};
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        *floats[i] = field_make(PAPER_FLOAT_BITS);
    for (int i = 0; i < p->config.pigments_count; i++) {
        p->surface[i] = field_make(PAPER_FLOAT_BITS);
        p->infused[i] = field_make(PAPER_FLOAT_BITS);
        p->fixed[i] = field_make(PAPER_FLOAT_BITS);
    }
    for (int i = 0; i < SHEET_TEMPORARIES; i++)
        p->t[i] = field_make(PAPER_FLOAT_BITS);
    for (int i = 0; i < 3; i++)
        p->shown[i] = field_make(16);
    p->dried = field_make(SHEET_DRIED_BITS);
    p->mask = field_make(8);
    p->page.context = field_make(1);
    p->page.inner_context = field_make(1);
    p->page.x_coord = field_make((unsigned)p->page.x_bits);
    p->page.y_coord = field_make((unsigned)p->page.y_bits);
    CM_set_context();
    CM_my_news_coordinate_1L(p->page.x_coord, PAPER_AXIS_X, (unsigned)p->page.x_bits);
    CM_my_news_coordinate_1L(p->page.y_coord, PAPER_AXIS_Y, (unsigned)p->page.y_bits);
}

/* Fills with zeros what changes from step to step. The machine knows that a field is 0 until it is written, and makes
 * other kernels for that; numbers that come from outside it takes as they are, so the first steps are like all others. */
static enum paper_status amounts_clear(struct paper_sheet *p)
{
    CM_field_id_t fields[5 + 3 * PAPER_PIGMENTS_MAX];
    int count = 0;
    fields[count++] = p->page.water;
    if (p->config.parts)
        fields[count++] = p->resist;
    if (sheet_has(p, PAPER_PART_SURFACE))
        fields[count++] = p->surface_water;
    if (sheet_has(p, PAPER_PART_EDGE))
        fields[count++] = p->wet_around;
    for (int i = 0; i < p->config.pigments_count; i++)
        count += sheet_pigment_fields(p, i, fields + count);
    float *zeros = calloc((size_t)p->page.width * (size_t)p->page.height, sizeof *zeros);
    if (!zeros)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", p->page.width,
                          p->page.height);
    for (int i = 0; i < count; i++)
        f_array_write(p, fields[i], zeros);
    if (p->config.parts)
        u_array_write(p, p->dried, SHEET_DRIED_BITS, zeros, CM_32_bit);
    free(zeros);
    return PAPER_OK;
}

enum paper_status sheet_fresh_make(struct paper_sheet *p)
{
    sheet_stock_make(p);
    return amounts_clear(p);
}

enum paper_status paper_sheet_create(const struct paper_sheet_config *config,
                                     struct paper_sheet **out)
{
    *out = NULL;
    enum paper_status status = config_check(config);
    if (status != PAPER_OK)
        return status;
    struct paper_sheet *p = calloc(1, sizeof *p);
    if (!p)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet");
    p->config = *config;
    p->config.parts = sheet_parts_whole(config->parts);
    p->unit = p->config.parts ? PAPER_GRAINS : 1;
    p->air = paper_air_default();
    p->salt_reach = 10;
    p->salt_strength = 1;
    p->page.width = config->width;
    p->page.height = config->height;
    p->page.x_bits = coordinate_bits(config->width);
    p->page.y_bits = coordinate_bits(config->height);
    status = paper_attach();
    if (status != PAPER_OK) {
        free(p);
        return status;
    }
    int dimensions[2] = {config->height, config->width};
    p->page.geometry = CM_create_geometry(dimensions, 2);
    p->page.vp_set = CM_allocate_vp_set(p->page.geometry);
    paper_enter(&p->page);
    fields_make(p);
    status = sheet_fresh_make(p);
    if (status == PAPER_OK)
        status = paper_leave(&p->page);
    if (status == PAPER_OK)
        status = paper_sheet_finish(p);
    if (status != PAPER_OK) {
        paper_sheet_destroy(p);
        return status;
    }
    *out = p;
    return PAPER_OK;
}

void paper_sheet_destroy(struct paper_sheet *p)
{
    if (!p)
        return;
    if (p->history)
        history_free(p->history);
    sheet_brushes_destroy(p);
    CM_deallocate_vp_set(p->page.vp_set); /* its fields go too */
    CM_deallocate_geometry(p->page.geometry);
    free(p);
}

const struct paper_sheet_config *paper_sheet_get_config(const struct paper_sheet *p)
{
    return &p->config;
}

enum paper_status paper_sheet_finish(struct paper_sheet *p)
{
    return paper_finish(&p->page);
}

/* ---- layers ---- */

int sheet_pigment_fields(const struct paper_sheet *p, int i, CM_field_id_t fields[3])
{
    int count = 0;
    if (sheet_has(p, PAPER_PART_SURFACE))
        fields[count++] = p->surface[i];
    fields[count++] = p->infused[i];
    if (sheet_has(p, PAPER_PART_FIXING))
        fields[count++] = p->fixed[i];
    return count;
}

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

static enum paper_status layer_check(const struct paper_sheet *p, enum paper_layer layer,
                                     int pigment, CM_field_id_t *field)
{
    *field = sheet_layer_field(p, layer, pigment);
    if (*field)
        return PAPER_OK;
    return paper_fail(PAPER_BAD_ARGUMENT,
                      "the sheet has no layer %d of pigment %d (it has %d pigments)",
                      (int)layer, pigment, p->config.pigments_count);
}

enum paper_status paper_sheet_layer_write(struct paper_sheet *p, enum paper_layer layer,
                                          int pigment, const float *values)
{
    return sheet_event(p, SHEET_EVENT_LAYER,
                       &(struct event_layer){(int)layer, pigment, values});
}

enum paper_status sheet_layer_check(const struct paper_sheet *p, const void *arguments)
{
    const struct event_layer *event = arguments;
    CM_field_id_t field;
    enum paper_status status =
        layer_check(p, (enum paper_layer)event->layer, event->pigment, &field);
    if (status == PAPER_OK && event->layer == PAPER_LAYER_DRIED_WATER)
        return paper_fail(PAPER_BAD_ARGUMENT, "what has dried is counted, not written");
    unsigned part = event->layer == PAPER_LAYER_SURFACE_PIGMENT ? PAPER_PART_SURFACE
                    : event->layer == PAPER_LAYER_FIXED_PIGMENT ? PAPER_PART_FIXING
                                                                : 0;
    if (status == PAPER_OK && part && !sheet_has(p, part))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "pigments have no such layer in this model of the paper");
    size_t width = (size_t)p->page.width, count = width * (size_t)p->page.height;
    for (size_t i = 0; i < count && status == PAPER_OK; i++)
        if (isnan(event->values[i]))
            return paper_fail(PAPER_BAD_ARGUMENT, "the value at %zu, %zu is not a number",
                              i % width, i / width);
    return status;
}

enum paper_status sheet_layer(struct paper_sheet *p, const void *arguments)
{
    const struct event_layer *event = arguments;
    enum paper_layer layer = (enum paper_layer)event->layer;
    const float *values = event->values;
    CM_field_id_t field = sheet_layer_field(p, layer, event->pigment);
    enum paper_status status = PAPER_OK;
    size_t count = (size_t)p->page.width * (size_t)p->page.height;
    double unit = layers[layer].amount ? p->unit : 1;
    double high = layers[layer].amount && p->unit == 1 ? 1 : layers[layer].high;
    float *cut = malloc(count * sizeof *cut);
    if (!cut)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a layer of %dx%d", p->page.width,
                          p->page.height);
    for (size_t i = 0; i < count; i++) {
        double value = fmin(high, fmax(layers[layer].low, values[i])) * unit;
        cut[i] = (float)(unit > 1 ? floor(value) : value);
    }
    paper_enter(&p->page);
    CM_set_context();
    f_array_write(p, field, cut);
    p->varnished = p->varnished || layer == PAPER_LAYER_VARNISH;
    p->salted = p->salted || layer == PAPER_LAYER_SALT || layer == PAPER_LAYER_BRINE;
    if (layer == PAPER_LAYER_ABSORBENCY || layer == PAPER_LAYER_RESIST)
        sheet_faces_make(p);
    if (layer == PAPER_LAYER_SURFACE_WATER || layer == PAPER_LAYER_INFUSED_WATER)
        sheet_wet_around_make(p);
    status = paper_leave(&p->page);
    free(cut);
    return status;
}

enum paper_status paper_sheet_layer_read(struct paper_sheet *p, enum paper_layer layer,
                                         int pigment, float *values)
{
    CM_field_id_t field;
    enum paper_status status = layer_check(p, layer, pigment, &field);
    if (status == PAPER_OK)
        status = sheet_ready(p);
    if (status != PAPER_OK)
        return status;
    paper_enter(&p->page);
    CM_set_context();
    if (layer == PAPER_LAYER_DRIED_WATER) {
        CM_f_u_float_2_2L(p->t[0], field, SHEET_DRIED_BITS, SHEET_F);
        field = p->t[0];
    }
    f_array_read(p, values, field);
    status = paper_leave(&p->page);
    size_t count = (size_t)p->page.width * (size_t)p->page.height;
    if (layers[layer].amount && p->unit != 1)
        for (size_t i = 0; i < count; i++)
            values[i] *= (float)(1 / p->unit);
    return status;
}

/* Sum of whole numbers, in doubles: exact up to 2^53 grains. */
static double field_total(CM_field_id_t field, CM_field_id_t wide)
{
    CM_f_move_2L(wide, field, 52, 11, SHEET_F);
    return CM_global_f_add_1L(wide, 52, 11);
}

enum paper_status paper_sheet_total(struct paper_sheet *p, int substance, double *total)
{
    if (substance < -1 || substance > p->config.pigments_count)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has %d pigments (asked for number %d)",
                          p->config.pigments_count, substance);
    enum paper_status status = sheet_ready(p);
    if (status != PAPER_OK)
        return status;
    paper_enter(&p->page);
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
    return paper_leave(&p->page);
}
