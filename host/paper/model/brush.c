/* brush.c - a sheet's brushes: making, dipping, counting. The stroke is in model/stroke.c, what
 * passes between bristles and fibers in model/exchange.c. */
#include "model/brush_internal.h"
#include "model/clouds.h"
#include "model/felt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { D_S = 52, D_E = 11, D_BITS = 64 };

struct paper_brush paper_brush_default(void)
{
    return (struct paper_brush){
        .bristles = 160,
        .width = 20,
        .depth = 14,
        .point = 0.7,
        .uneven = 0.25,
        .splay = 0.3,
        .bend = 0.3,
        .thickness = 1.5,
        .reach = 600,
        .load = 0.7,
        .flow = 150,
        .mixing = 0.15,
        .seed = 1,
    };
}

/* ---- life ---- */

/* Sizes of the clouds, in fibers, and how far they go. */
#define CLOUD_FINEST 4.0
#define CLOUD_COARSEST 128.0
#define CLOUD_STEP 0.9
#define CLOUD_STRENGTH 0.275

static struct clouds clouds_of(const struct paper_sheet *p)
{
    const double scale = felt_scale(&p->config);
    return (struct clouds){.finest = CLOUD_FINEST * scale,
                           .coarsest = CLOUD_COARSEST * scale,
                           .step = CLOUD_STEP,
                           .seed = clouds_word(p->config.seed, 77)};
}

/* How much of its level a bristle leaves, on each fiber, in a layer of the sheet: no sheet is
 * sized, and no hand presses, alike everywhere. A sheet whose layers are mirrored takes a
 * mirrored stroke as the mirror image. */
enum paper_status sheet_grip_make(struct paper_sheet *p)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    const size_t count = (size_t)width * (size_t)height;
    const struct clouds of = clouds_of(p);
    float *grip = malloc(count * sizeof *grip);
    if (!grip || !clouds_make(grip, width, height, p->config.torus, &of)) {
        free(grip);
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", width, height);
    }
    for (size_t i = 0; i < count; i++)
        grip[i] = fminf(PAPER_GRIP_MOST,
                        fmaxf(PAPER_GRIP_LEAST, 1 + (float)CLOUD_STRENGTH * grip[i]));
    kit_grid_f_write(&p->page.grid, p->grip, grip);
    free(grip);
    return PAPER_OK;
}

/* What all brushes share. */
static enum paper_status brushes_make(struct paper_sheet *p)
{
    struct sheet_brushes *b = calloc(1, sizeof *b);
    if (!b)
        return paper_fail(PAPER_NO_MEMORY, "no memory for brushes");
    b->touched =
        calloc((size_t)p->page.grid.width * (size_t)p->page.grid.height, sizeof *b->touched);
    if (!b->touched) {
        free(b);
        return paper_fail(PAPER_NO_MEMORY, "no memory for brushes");
    }
    for (int i = 0; i < BRUSH_SETS; i++)
        b->sets[i].bristles = PAPER_BRISTLES_MAX >> i;
    p->brushes = b;
    return PAPER_OK;
}

/* The smallest VP set that has so many bristles; it is current then. */
static int set_make(struct paper_sheet *p, int bristles)
{
    int number = BRUSH_SETS - 1;
    while (p->brushes->sets[number].bristles < bristles)
        number--;
    struct bristle_set *b = &p->brushes->sets[number];
    if (b->vp_set) {
        CM_set_vp_set(b->vp_set);
        CM_set_context();
        return number;
    }
    int dimensions[2] = {BRUSH_ROWS, b->bristles};
    b->geometry = CM_create_geometry(dimensions, 2);
    b->vp_set = CM_allocate_vp_set(b->geometry);
    CM_set_vp_set(b->vp_set);
    CM_set_context();
    b->address = CM_allocate_heap_field(32);
    b->count = CM_allocate_heap_field(32);
    CM_field_id_t *const floats[] = {&b->contact, &b->reach,  &b->sharers,
                                     &b->places,  &b->gotten, &b->sent};
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        *floats[i] = CM_allocate_heap_field(KIT_FLOAT_BITS);
    for (int i = 0; i < BRUSH_TEMPORARIES; i++)
        b->t[i] = CM_allocate_heap_field(D_BITS);
    for (int i = 0; i <= p->config.pigments_count; i++)
        b->give[i] = CM_allocate_heap_field(D_BITS);
    return number;
}

void sheet_brushes_destroy(struct paper_sheet *p)
{
    struct sheet_brushes *b = p->brushes;
    if (!b)
        return;
    for (int i = 0; i < BRUSH_SETS; i++)
        if (b->sets[i].vp_set) {
            CM_deallocate_vp_set(b->sets[i].vp_set);
            CM_deallocate_geometry(b->sets[i].geometry);
        }
    free(b->touched);
    free(b);
    p->brushes = NULL;
}

/* grains[bristle] in all rows of the field. */
static enum paper_status held_write(const struct bristle_set *b, CM_field_id_t field,
                                    const double *grains, int bristles)
{
    double *all = calloc(BRUSH_PLACES, sizeof *all);
    if (!all)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a brush");
    for (int row = 0; row < BRUSH_ROWS; row++)
        memcpy(all + row * PAPER_BRISTLES_MAX, grains, (size_t)bristles * sizeof *grains);
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {0, 1};
    int end[2] = {BRUSH_ROWS, b->bristles}, size[2] = {BRUSH_ROWS, PAPER_BRISTLES_MAX};
    CM_set_vp_set(b->vp_set);
    CM_set_context();
    CM_f_write_to_news_array_1L(all, offset, start, end, axes, field, D_S, D_E, 2, size,
                                CM_float_double);
    free(all);
    return PAPER_OK;
}

static void held_read(const struct bristle_set *b, CM_field_id_t field, double *grains,
                      int bristles)
{
    double row[PAPER_BRISTLES_MAX];
    int offset[2] = {0, 0}, start[2] = {0, 0}, end[2] = {1, b->bristles}, axes[2] = {0, 1};
    CM_set_vp_set(b->vp_set);
    CM_set_context();
    CM_f_read_from_news_array_1L(row, offset, start, end, axes, field, D_S, D_E, 2, end,
                                 CM_float_double);
    memcpy(grains, row, (size_t)bristles * sizeof *grains);
}

enum paper_status sheet_brush_check(const struct paper_sheet *p, const void *arguments)
{
    (void)arguments;
    return p->config.parts ? PAPER_OK
                           : paper_fail(PAPER_BAD_ARGUMENT, "the thesis's paper takes no "
                                                            "brush; choose a paper with parts");
}

enum paper_status sheet_brush(struct paper_sheet *p, const void *arguments)
{
    const struct paper_brush *brush = arguments;
    paper_enter(&p->page);
    enum paper_status status = p->brushes ? PAPER_OK : brushes_make(p);
    if (status != PAPER_OK) {
        paper_leave(&p->page);
        return status;
    }
    struct sheet_brush *own = &p->brushes->brush[brush->number];
    const int set = set_make(p, brush->bristles);
    const struct bristle_set *b = &p->brushes->sets[set];
    own->set = set;
    if (!own->gives_in[set]) {
        own->gives_in[set] = CM_allocate_heap_field(D_BITS);
        for (int i = 0; i <= p->config.pigments_count; i++)
            own->held_in[set][i] = CM_allocate_heap_field(D_BITS);
    }
    own->gives = own->gives_in[set];
    memcpy(own->held, own->held_in[set], sizeof own->held);
    own->brush = *brush;
    /* what a stroke of the tuft's width and a full brush's reach takes, shared by its
     * bristles */
    own->full = floor(fmin(brush->reach * brush->width * brush->load / brush->bristles, 1e6) *
                      PAPER_GRAINS);
    sheet_brush_bristles_make(own);
    double numbers[PAPER_BRISTLES_MAX] = {0};
    for (int i = 0; i <= p->config.pigments_count && status == PAPER_OK; i++)
        status = held_write(b, own->held[i], numbers, brush->bristles);
    for (int i = 0; i < brush->bristles; i++)
        numbers[i] = own->bristles[i].gives;
    if (status == PAPER_OK)
        status = held_write(b, own->gives, numbers, brush->bristles);
    own->there = status == PAPER_OK;
    CM_set_vp_set(p->page.grid.vp_set);
    enum paper_status left = paper_leave(&p->page);
    return status == PAPER_OK ? left : status;
}

const struct paper_brush *sheet_brush_get(const struct paper_sheet *p, int number)
{
    return p->brushes && number >= 0 && number < PAPER_BRUSHES_MAX &&
                   p->brushes->brush[number].there
               ? &p->brushes->brush[number].brush
               : NULL;
}

/* ---- what it holds ---- */

static enum paper_status held_check(const struct paper_sheet *p, int number, int substance)
{
    if (!sheet_brush_get(p, number))
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no brush %d", number);
    if (substance < 0 || substance > p->config.pigments_count)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has %d pigments (asked for number %d)",
                          p->config.pigments_count, substance);
    return PAPER_OK;
}

enum paper_status sheet_brush_read(struct paper_sheet *p, int number, int substance,
                                   double *grains)
{
    enum paper_status status = held_check(p, number, substance);
    if (status != PAPER_OK)
        return status;
    paper_enter(&p->page);
    const struct sheet_brush *own = &p->brushes->brush[number];
    held_read(&p->brushes->sets[own->set], own->held[substance], grains, own->brush.bristles);
    CM_set_vp_set(p->page.grid.vp_set);
    return paper_leave(&p->page);
}

bool sheet_bristle_may_hold(double grains)
{
    return paper_within(grains, 0, 0x1p45) && floor(grains) == grains;
}

enum paper_status sheet_brush_write(struct paper_sheet *p, int number, int substance,
                                    const double *grains)
{
    enum paper_status status = held_check(p, number, substance);
    if (status != PAPER_OK)
        return status;
    const struct sheet_brush *own = &p->brushes->brush[number];
    for (int i = 0; i < own->brush.bristles; i++)
        if (!sheet_bristle_may_hold(grains[i]))
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "a bristle holds whole grains, 0 to 2^45 (got %g)", grains[i]);
    paper_enter(&p->page);
    status = held_write(&p->brushes->sets[own->set], own->held[substance], grains,
                        own->brush.bristles);
    CM_set_vp_set(p->page.grid.vp_set);
    return status == PAPER_OK ? paper_leave(&p->page) : status;
}

enum paper_status sheet_brush_total(struct paper_sheet *p, int number, int substance,
                                    double *total)
{
    double grains[PAPER_BRISTLES_MAX];
    enum paper_status status = sheet_brush_read(p, number, substance, grains);
    *total = 0;
    if (status != PAPER_OK)
        return status;
    const struct sheet_brush *own = &p->brushes->brush[number];
    for (int i = 0; i < own->brush.bristles; i++)
        *total += grains[i];
    *total /= p->unit;
    return PAPER_OK;
}

enum paper_status sheet_brush_number_check(int number)
{
    return number >= 0 && number < PAPER_BRUSHES_MAX
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no brush %d", number);
}

enum paper_status sheet_dip_check(const struct paper_sheet *p, const void *arguments)
{
    const struct paper_dip *dip = arguments;
    for (int i = 0; i <= p->config.pigments_count; i++)
        if (!paper_within(dip->amount[i], 0, i == 0 ? 1 : 4))
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "the amount of %.*s in a brush must be 0..%d (got %g)",
                              PAPER_NAME_MAX, i == 0 ? "water" : p->config.pigments[i - 1].name,
                              i == 0 ? 1 : 4, dip->amount[i]);
    return sheet_brush_number_check(dip->number);
}

enum paper_status sheet_dip(struct paper_sheet *p, const void *arguments)
{
    const struct paper_dip *dip = arguments;
    enum paper_status status = held_check(p, dip->number, 0);
    if (status != PAPER_OK)
        return status;
    const struct sheet_brush *own = &p->brushes->brush[dip->number];
    for (int i = 0; i <= p->config.pigments_count && status == PAPER_OK; i++) {
        double grains[PAPER_BRISTLES_MAX];
        double full = i == 0 ? own->full : own->full / own->brush.load;
        status = sheet_brush_read(p, dip->number, i, grains);
        for (int j = 0; j < own->brush.bristles; j++) {
            double across = own->bristles[j].across * (own->brush.mirrored ? -1 : 1);
            if (across < dip->side[0] || across > dip->side[1])
                continue;
            grains[j] = floor((1 - dip->part) * grains[j] + dip->part * dip->amount[i] * full);
        }
        if (status == PAPER_OK)
            status = sheet_brush_write(p, dip->number, i, grains);
    }
    return status;
}
