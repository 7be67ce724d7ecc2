/* miniatures.c - see reader_miniatures.h. A page's layout is drawn through a map that makes it
 * small: letters are filtered at the size that they then have, and kept by the painter. */
#include "pages_internal.h"
#include "reader_colours.h"
#include "reader_miniatures.h"

#include <array.h>
#include <paint.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A pixel is divided into so many where letters stand: they are drawn once for each, and then
 * kept. */
enum { PLACES = 3 };

struct mark_box {
    int page, order;
    struct page_box box;
    double rgb[3];
};

struct reader_miniatures {
    struct reader_pages *pages;
    struct font_painter *painter;
    const struct reader_colours *colours;
    double page_width, page_height, scale;
    int width_px, height_px, count;
    struct mark_box *boxes; /* by pages */
    int boxes_count, boxes_capacity;
    const struct reader_mark *marking; /* whose boxes are being found */
    bool full;
};

/* ---- making ---- */

enum reader_status reader_miniatures_resize(struct reader_miniatures *m, int width_px)
{
    if (width_px < READER_MINIATURE_LEAST || width_px > READER_MINIATURE_MOST)
        return reader_fail(READER_BAD_ARGUMENT, "miniatures are %d..%d pixels wide (got %d)",
                           READER_MINIATURE_LEAST, READER_MINIATURE_MOST, width_px);
    m->width_px = width_px;
    m->scale = width_px / m->page_width;
    m->height_px = (int)fmax(1, ceil(m->page_height * m->scale - 1e-6));
    return READER_OK;
}

enum reader_status reader_miniatures_make(const struct reader_document *document,
                                          const struct reader_miniatures_def *def,
                                          struct reader_miniatures **out)
{
    struct reader_pages_setup setup = *def->setup;
    struct font_painter_def painter = font_painter_def_default();
    struct reader_miniatures *m = calloc(1, sizeof *m);
    *out = NULL;
    if (!m)
        return pages_no_memory();
    setup.places = true;
    setup.stage_strip_px = 0; /* what lives is seen as its text */
    m->colours = reader_colours_of(def->dark);
    m->page_width = setup.width_px;
    m->page_height = setup.height_px;
    memcpy(painter.ink, m->colours->ink, sizeof painter.ink);
    painter.darken_px = def->dark ? 0 : FONT_DARKEN_BY_STEM;
    painter.places = PLACES;
    enum reader_status status = reader_miniatures_resize(m, def->width_px);
    if (status == READER_OK)
        status = reader_pages_make(document, &setup, &m->pages);
    if (status == READER_OK && (page_count(m->pages->text, &m->count) != FONT_OK ||
                                font_painter_create(&painter, &m->painter) != FONT_OK))
        status = pages_failed();
    if (status == READER_OK)
        *out = m;
    else
        reader_miniatures_destroy(m);
    return status;
}

void reader_miniatures_destroy(struct reader_miniatures *m)
{
    if (!m)
        return;
    font_painter_destroy(m->painter);
    reader_pages_destroy(m->pages);
    free(m->boxes);
    free(m);
}

int reader_miniatures_count(const struct reader_miniatures *m)
{
    return m->count;
}

void reader_miniatures_size(const struct reader_miniatures *m, int *width_px, int *height_px)
{
    *width_px = m->width_px;
    *height_px = m->height_px;
}

/* ---- marks ---- */

static void box_add(void *user, int page, const struct page_box *box)
{
    struct reader_miniatures *m = user;
    m->full = m->full || !array_reserve(&m->boxes, &m->boxes_capacity, m->boxes_count + 1,
                                        sizeof *m->boxes);
    if (m->full)
        return;
    struct mark_box *to = &m->boxes[m->boxes_count];
    *to = (struct mark_box){.page = page, .order = m->boxes_count++, .box = *box};
    memcpy(to->rgb, m->marking->rgb, sizeof to->rgb);
}

static int by_page(const void *a, const void *b)
{
    const struct mark_box *x = a, *y = b;
    return x->page != y->page ? (x->page > y->page) - (x->page < y->page)
                              : (x->order > y->order) - (x->order < y->order);
}

enum reader_status reader_miniatures_mark(struct reader_miniatures *m,
                                          const struct reader_mark *marks, int count)
{
    enum reader_status status = READER_OK;
    m->boxes_count = 0;
    m->full = false;
    for (int i = 0; i < count && status == READER_OK; i++) {
        m->marking = &marks[i];
        status = reader_pages_find(m->pages, marks[i].begin, marks[i].end, box_add, m);
    }
    m->marking = NULL;
    if (m->boxes_count)
        qsort(m->boxes, (size_t)m->boxes_count, sizeof *m->boxes, by_page);
    return status == READER_OK && m->full ? pages_no_memory() : status;
}

/* The first box of a page or of a later one. */
static int first_box(const struct reader_miniatures *m, int page)
{
    int low = 0, high = m->boxes_count;
    while (low < high) {
        const int half = (low + high) / 2;
        if (m->boxes[half].page < page)
            low = half + 1;
        else
            high = half;
    }
    return low;
}

int reader_miniatures_marks(const struct reader_miniatures *m, int page)
{
    return first_box(m, page + 1) - first_box(m, page);
}

/* ---- painting ---- */

static void fill(const struct reader_miniatures *m, uint8_t *rgb, size_t row_bytes,
                 const double from[2], const double to[2], const double colour[3])
{
    const int left = (int)fmax(0, round(from[0])), right = (int)fmin(m->width_px, round(to[0])),
              top = (int)fmax(0, round(from[1])),
              bottom = (int)fmin(m->height_px, round(to[1]));
    uint8_t byte[3];
    for (int k = 0; k < 3; k++)
        byte[k] = (uint8_t)lrint(255 * colour[k]);
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++)
            memcpy(rgb + (size_t)y * row_bytes + 3 * (size_t)x, byte, 3);
}

/* A box that would be smaller is as large as can be seen. */
static void mark_fill(const struct reader_miniatures *m, uint8_t *rgb, size_t row_bytes,
                      const struct mark_box *mark)
{
    const double least_px = 4, s = m->scale, x = (mark->box.x + mark->box.width / 2) * s,
                 y = (mark->box.y + mark->box.height / 2) * s,
                 half_x = fmax(least_px, mark->box.width * s) / 2,
                 half_y = fmax(least_px, mark->box.height * s) / 2;
    fill(m, rgb, row_bytes, (const double[]){x - half_x, y - half_y},
         (const double[]){x + half_x, y + half_y}, mark->rgb);
}

/* The mean of a part of a picture's pixels, of their numbers: so small, nobody sees how it
 * differs from that of their light. */
static void mean_put(const struct font_ink *from, int x0, int x1, int y0, int y1, uint8_t *to)
{
    for (int k = 0; k < 3; k++) {
        long sum = 0;
        for (int y = y0; y < y1; y++)
            for (int x = x0; x < x1; x++)
                sum += from->rgb[(ptrdiff_t)y * from->pitch + 3 * (ptrdiff_t)x + k];
        to[k] = (uint8_t)(sum / ((long)(x1 - x0) * (y1 - y0)));
    }
}

/* A picture of the page is an ink, which has pixels of the page: as many as it is small. Owns:
 * the caller frees the pixels; NULL: no memory. */
static uint8_t *picture_small(struct font_ink *ink, double scale)
{
    const int width = (int)fmax(1, round(ink->width_px * scale)),
              height = (int)fmax(1, round(ink->height_px * scale));
    uint8_t *to = malloc(3 * (size_t)width * (size_t)height);
    for (int y = 0; y < height && to; y++)
        for (int x = 0; x < width; x++) {
            const int x0 = (int)((long)x * ink->width_px / width),
                      x1 = (int)((long)(x + 1) * ink->width_px / width),
                      y0 = (int)((long)y * ink->height_px / height),
                      y1 = (int)((long)(y + 1) * ink->height_px / height);
            mean_put(ink, x0, x1 > x0 ? x1 : x0 + 1, y0, y1 > y0 ? y1 : y0 + 1,
                     to + 3 * ((size_t)y * (size_t)width + (size_t)x));
        }
    ink->rgb = to;
    ink->width_px = width;
    ink->height_px = height;
    ink->pitch = 3 * width;
    return to;
}

/* Inks have places of their own, which no map moves. Owns: the caller frees *pixels, and each
 * of them. False: no memory. */
static bool inks_small(struct font_layout *layout, double scale, uint8_t ***pixels)
{
    bool good = true;
    *pixels = calloc((size_t)layout->inks_count + 1, sizeof **pixels);
    for (int i = 0; i < layout->inks_count && *pixels && good; i++) {
        struct font_ink *ink = &layout->inks[i];
        ink->x0 = floor(ink->x0 * scale);
        ink->y0 = floor(ink->y0 * scale);
        if (ink->kind == FONT_INK_PICTURE)
            good = ((*pixels)[i] = picture_small(ink, scale)) != NULL;
    }
    return *pixels && good;
}

static enum reader_status layout_paint(struct reader_miniatures *m, struct font_layout *layout,
                                       struct font_picture *picture)
{
    const struct font_map map = {FONT_AFFINE, {m->scale, 0, 0, 0, m->scale, 0}};
    uint8_t **pixels = NULL;
    enum reader_status status =
        inks_small(layout, m->scale, &pixels) ? READER_OK : pages_no_memory();
    if (status == READER_OK &&
        font_painter_layout(m->painter, layout, &map, 0, 0, picture) != FONT_OK)
        status = pages_failed();
    for (int i = 0; i < layout->inks_count && pixels; i++)
        free(pixels[i]);
    free(pixels);
    return status;
}

enum reader_status reader_miniatures_paint(struct reader_miniatures *m, int page, uint8_t *rgb,
                                           size_t row_bytes)
{
    struct font_picture picture = {m->width_px, m->height_px, (int)row_bytes, rgb};
    struct font_layout layout = {0};
    if (page < 0 || page >= m->count)
        return reader_fail(READER_BAD_ARGUMENT, "there is no page %d", page + 1);
    fill(m, rgb, row_bytes, (const double[]){0, 0}, (const double[]){m->width_px, m->height_px},
         m->colours->paper);
    for (int i = first_box(m, page); i < m->boxes_count && m->boxes[i].page == page; i++)
        mark_fill(m, rgb, row_bytes, &m->boxes[i]);
    const enum reader_status status = page_layout(m->pages->text, page, &layout) == FONT_OK
                                          ? layout_paint(m, &layout, &picture)
                                          : pages_failed();
    font_layout_finish(&layout);
    return status;
}

/* ---- places ---- */

bool reader_miniatures_byte(struct reader_miniatures *m, int page, double x, double y,
                            size_t *byte)
{
    return page >= 0 && page < m->count &&
           reader_pages_byte(m->pages, page, x / m->scale, y / m->scale, byte);
}

static void page_note(void *user, int page, const struct page_box *box)
{
    int *first = user;
    (void)box;
    if (*first < 0)
        *first = page;
}

int reader_miniatures_page(struct reader_miniatures *m, size_t byte)
{
    int page = -1;
    reader_pages_find(m->pages, byte, byte + 1, page_note, &page);
    return page;
}
