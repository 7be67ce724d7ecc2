/* picture.c - the picture of a sheet or of a part of it: made where the numbers are, read once,
 * and taken to display values.
 *
 * While steps go on in boxes, boxes know better than the sheet what is in them, and beyond them
 * nothing has changed since they were opened. So a picture takes boxes' insides from the boxes,
 * and the rest from the sheet's own fields, if the area has any of it; nothing is copied back.
 * A box is a torus, and a fiber's picture looks SHEET_LOOK_REACH fibers aside: its inside is
 * what is so far from its sides. Fibers on the rim that is left are at rest, and so are those
 * they look at (boxes.c): their picture is that of the sheet's fields, too. */
#include "model/boxes_parts.h"

#include <math.h>
#include <stdlib.h>

enum { SHADES = 1 << SHEET_SHADE_BITS, BAND_PIXELS = 1 << 18 };

/* A picture while it is read. */
struct look {
    struct paper_sheet *sheet;
    const struct paper_sheet_view *view;
    int channels;
    const uint16_t *table; /* of display values; NULL: they are what they are */
    const uint16_t *covers;
    bool boxes; /* what is shown is also in boxes */
};

/* From roots of linear light to display values: made once. Threads: the one that has the
 * machine. */
static const uint16_t *table_of(bool linear)
{
    static uint16_t table[SHADES];
    if (linear && table[SHADES - 1] == 0)
        for (int i = 0; i < SHADES; i++) {
            const double value = (double)i / (SHADES - 1);
            table[i] = (uint16_t)lround(paper_light_display(value * value) * (SHADES - 1));
        }
    return linear ? table : NULL;
}

/* ---- making ---- */

/* Calls `use` for each block of the area that lies inside an open box: in the box, and in the
 * area's rows. */
typedef void (*block_use)(void *context, struct part *part, const struct kit_block *block);

static void blocks_of(const struct paper_sheet *p, struct part *part,
                      const struct paper_area *area, block_use use, void *context)
{
    struct box inside;
    part_inside(part, &inside);
    const int width = p->page.grid.width, height = p->page.grid.height;
    /* a box over the sheet's edge lies there twice along an axis */
    for (int y = inside.y - height; y < height; y += height)
        for (int x = inside.x - width; x < width; x += width) {
            const int left = x > area->x ? x : area->x, top = y > area->y ? y : area->y,
                      right = x + inside.width < area->x + area->width ? x + inside.width
                                                                       : area->x + area->width,
                      bottom = y + inside.height < area->y + area->height
                                   ? y + inside.height
                                   : area->y + area->height;
            if (left >= right || top >= bottom)
                continue;
            const struct kit_block block = {
                left - x + part->rim[0], top - y + part->rim[1], right - left, bottom - top,
                left - area->x,          top - area->y,          area->width,  area->height};
            use(context, part, &block);
        }
}

/* As blocks_of(), for all boxes. */
static void blocks_each(const struct look *l, const struct paper_area *area, block_use use,
                        void *context)
{
    const struct sheet_boxes *b = l->sheet->boxes;
    for (int i = 0; l->boxes && b && b->confined && i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            blocks_of(l->sheet, b->parts[i], area, use, context);
}

static void block_make(void *context, struct part *part, const struct kit_block *block)
{
    const struct look *l = context;
    (void)block;
    if (part->shown)
        return;
    part_look(l->sheet, part);
    CM_set_vp_set(part->sheet.page.grid.vp_set);
    sheet_shades_make(&part->sheet, l->view);
    part->shown = true;
}

static void block_count(void *context, struct part *part, const struct kit_block *block)
{
    (void)part;
    *(double *)context += (double)block->width * block->height;
}

/* Whether boxes show the whole area. */
static bool covered(const struct look *l, const struct paper_area *area)
{
    double pixels = 0;
    blocks_each(l, area, block_count, &pixels);
    return pixels >= (double)area->width * area->height;
}

static void shades_make(struct look *l, const struct paper_area *area)
{
    struct sheet_boxes *b = l->sheet->boxes;
    for (int i = 0; b && i < PARTS_MOST; i++)
        if (b->parts[i])
            b->parts[i]->shown = false;
    blocks_each(l, area, block_make, l);
    CM_set_vp_set(l->sheet->page.grid.vp_set);
    if (!covered(l, area))
        sheet_shades_make(l->sheet, l->view);
}

/* ---- reading ---- */

static void block_read(void *context, struct part *part, const struct kit_block *block)
{
    CM_set_vp_set(part->sheet.page.grid.vp_set);
    kit_grid_block_read(block, context, part->sheet.shades, SHEET_SHADES_BITS);
}

/* words = the shades of a band of what has been made. */
static void shades_read(const struct look *l, const struct paper_area *band, uint64_t *words)
{
    struct paper_sheet *p = l->sheet;
    const struct kit_block block = {band->x, band->y, band->width, band->height,
                                    0,       0,       band->width, band->height};
    CM_set_vp_set(p->page.grid.vp_set);
    if (!covered(l, band))
        kit_grid_block_read(&block, words, p->shades, SHEET_SHADES_BITS);
    blocks_each(l, band, block_read, words);
    CM_set_vp_set(p->page.grid.vp_set);
}

static void row_show(const struct look *l, const uint64_t *words, int width, uint16_t *rgb)
{
    for (int x = 0; x < width; x++)
        for (int channel = 0; channel < 3; channel++) {
            const int from = channel < l->channels ? channel : 0;
            const uint16_t shade = (uint16_t)(words[x] >> SHEET_SHADE_BITS * from);
            rgb[3 * x + channel] = l->table ? l->table[shade] : shade;
        }
}

/* What becomes of the words of row y of the sheet. */
typedef void (*row_use)(void *context, const struct look *l, int y, const uint64_t *words);

static enum paper_status bands_read(struct look *l, const struct paper_area *area, row_use use,
                                    void *context)
{
    const int most = BAND_PIXELS / area->width > 1 ? BAND_PIXELS / area->width : 1;
    struct paper_area band = *area;
    band.height = area->height < most ? area->height : most;
    uint64_t *words = calloc((size_t)band.width * (size_t)band.height, sizeof *words);
    if (!words)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", area->width,
                          area->height);
    paper_enter(&l->sheet->page);
    const enum paper_status status = sheet_view_colored(l->view) && l->view->light > 0
                                         ? sheet_relief_make(l->sheet)
                                         : PAPER_OK;
    if (status != PAPER_OK) {
        free(words);
        sheet_leave(l->sheet);
        return status;
    }
    shades_make(l, area);
    const int end = area->y + area->height;
    for (; band.y < end; band.y += band.height) {
        band.height = band.height < end - band.y ? band.height : end - band.y;
        shades_read(l, &band, words);
        for (int row = 0; row < band.height; row++)
            use(context, l, band.y + row, words + (size_t)row * (size_t)band.width);
    }
    free(words);
    CM_set_context();
    CM_u_move_constant_1L(l->sheet->shades, 0, SHEET_SHADES_BITS); /* takes no memory */
    return sheet_leave(l->sheet);
}

/* Colours are in boxes, and of layers those that steps of this sheet change. */
static bool in_boxes(const struct paper_sheet *p, const struct paper_sheet_view *view)
{
    const bool surface = sheet_has(p, PAPER_PART_SURFACE);
    if (view->show != PAPER_SHOW_LAYER)
        return true;
    switch (view->layer) {
    case PAPER_LAYER_SALT:
    case PAPER_LAYER_BRINE:
        return p->salted;
    case PAPER_LAYER_SURFACE_WATER:
    case PAPER_LAYER_SURFACE_PIGMENT:
    case PAPER_LAYER_WET_PART:
    case PAPER_LAYER_STAINED_PART:
        return surface;
    case PAPER_LAYER_FIXED_PIGMENT:
        return sheet_has(p, PAPER_PART_FIXING);
    case PAPER_LAYER_INFUSED_WATER:
    case PAPER_LAYER_DRIED_WATER:
    case PAPER_LAYER_INFUSED_PIGMENT:
        return true;
    case PAPER_LAYER_HEIGHT:
    case PAPER_LAYER_ABSORBENCY:
    case PAPER_LAYER_CAPACITY:
    case PAPER_LAYER_RESIST:
    case PAPER_LAYER_VARNISH:
    case PAPER_LAYER_RED:
    case PAPER_LAYER_GREEN:
    case PAPER_LAYER_BLUE:
    case PAPER_LAYER_SIZING:
    case PAPER_LAYER_CURRENT:
    case PAPER_LAYER_GRIP:
    case PAPER_LAYER_THICKNESS:
    case PAPER_LAYERS_COUNT:
        break;
    }
    return false;
}

static struct look look_make(struct paper_sheet *p, const struct paper_sheet_view *view)
{
    return (struct look){.sheet = p,
                         .view = view,
                         .channels = sheet_view_colored(view) ? 3 : 1,
                         .table = table_of(sheet_view_linear(p, view)),
                         .boxes = in_boxes(p, view)};
}

/* ---- a part of it ---- */

/* 8 bits of an area. */
struct bytes {
    struct paper_area area;
    uint8_t *rgb;
    size_t pitch;
    uint16_t *row;
};

static void row_to_bytes(void *context, const struct look *l, int y, const uint64_t *words)
{
    const struct bytes *b = context;
    const size_t width = (size_t)b->area.width;
    uint8_t *out = b->rgb + (size_t)(y - b->area.y) * b->pitch;
    row_show(l, words, b->area.width, b->row);
    if (l->covers)
        sheet_ground_pixels(
            l->view,
            l->covers + 3 * ((size_t)y * (size_t)l->sheet->page.grid.width + (size_t)b->area.x),
            width, b->row);
    for (size_t i = 0; i < 3 * width; i++)
        out[i] = (uint8_t)(b->row[i] >> 8);
}

static enum paper_status area_check(const struct paper_sheet *p,
                                    const struct paper_sheet_view *view,
                                    const struct paper_area *area, size_t pitch_bytes)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    if (area->x < 0 || area->y < 0 || area->width < 1 || area->height < 1 ||
        area->width > width - area->x || area->height > height - area->y)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "an area of a picture must lie on its sheet of %dx%d "
                          "(got %dx%d at %d, %d)",
                          width, height, area->width, area->height, area->x, area->y);
    if (pitch_bytes < 3 * (size_t)area->width)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "rows of %d pixels are %zu bytes or more apart (got %zu)",
                          area->width, 3 * (size_t)area->width, pitch_bytes);
    if (view->scale < 0 || view->scale > 1 || view->alpha)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "an area is shown with one pixel a fiber and without alpha");
    return sheet_view_check(p, view);
}

enum paper_status sheet_view_area(struct paper_sheet *p, const struct paper_sheet_view *view,
                                  const struct paper_area *area, uint8_t *rgb,
                                  size_t pitch_bytes)
{
    enum paper_status status = area_check(p, view, area, pitch_bytes);
    if (status != PAPER_OK)
        return status;
    struct look l = look_make(p, view);
    if (p->config.deckled && sheet_view_colored(view))
        status = sheet_ground_covers(p, view->light, &l.covers);
    if (status != PAPER_OK)
        return status;
    struct bytes b = {*area, rgb, pitch_bytes, malloc(3 * sizeof *b.row * (size_t)area->width)};
    if (!b.row)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", area->width,
                          area->height);
    status = bands_read(&l, area, row_to_bytes, &b);
    free(b.row);
    return status;
}

/* ---- all of it ---- */

static void row_to_words(void *context, const struct look *l, int y, const uint64_t *words)
{
    const int width = l->sheet->page.grid.width;
    row_show(l, words, width, (uint16_t *)context + 3 * (size_t)y * (size_t)width);
}

/* One pixel a fiber. */
static enum paper_status fibers_view(struct paper_sheet *p, const struct paper_sheet_view *view,
                                     uint16_t *rgb)
{
    enum paper_status status = sheet_view_check(p, view);
    if (status != PAPER_OK)
        return status;
    struct look l = look_make(p, view);
    const struct paper_area all = {0, 0, p->page.grid.width, p->page.grid.height};
    return bands_read(&l, &all, row_to_words, rgb);
}

enum paper_status sheet_view(struct paper_sheet *p, const struct paper_sheet_view *view,
                             uint16_t *rgb)
{
    const int width = p->page.grid.width, height = p->page.grid.height, scale = view->scale;
    if (scale < 0 || scale == 3 || scale > 4)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "a picture's scale must be 1, 2 or 4 pixels a fiber (got %d)", scale);
    const bool lies = p->config.deckled && sheet_view_colored(view);
    if (scale < 2) {
        const enum paper_status seen = fibers_view(p, view, rgb);
        return seen == PAPER_OK && lies ? sheet_ground_lay(p, view, rgb) : seen;
    }
    uint16_t *coarse = malloc(3 * sizeof *coarse * (size_t)width * (size_t)height);
    if (!coarse)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a picture of %dx%d", width * scale,
                          height * scale);
    enum paper_status status = fibers_view(p, view, coarse);
    if (status == PAPER_OK && lies)
        status = sheet_color_spread(p, coarse);
    if (status == PAPER_OK)
        status = sheet_finer(coarse, width, height, p->config.torus, scale, rgb);
    free(coarse);
    if (status == PAPER_OK && lies)
        status = sheet_ground_lay(p, view, rgb);
    return status;
}
