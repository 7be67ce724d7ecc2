/* frame_buffer_pixels.c - fields to pixels.
 *
 * A VP set's picture has a column for each processor along its x axis and a row for each along
 * its y axis. The machine gives a field's values in row-major order; where the last axis is the
 * columns and the one before the rows, that is the picture. In the frame buffer's order the
 * pixels are those of the processors by their send addresses. Sets of NEWS order live in
 * blocks, by Gray code, so the picture must be shuffled first: CMFB_shuffle_from_news_always
 * does it alone, the writes of NEWS order hide it.
 *
 *     picture (x, y) --place--> index (row-major) --order--> rank of its send address
 */
#include <endian.h>
#include <stdlib.h>
#include <string.h>

#include "frame_buffer.h"
#include "machine_rows.h"

/* ---- places ---- */

struct picture {
    struct machine *m;
    int vpset;
    uint64_t count;
    uint32_t width, height;
    uint64_t x_stride, y_stride; /* in row-major order */
};

static bool straight(const struct picture *p)
{
    return p->x_stride == 1 && p->y_stride == p->width;
}

static inline uint64_t place(const struct picture *p, uint64_t pixel)
{
    return pixel / p->width * p->y_stride + pixel % p->width * p->x_stride;
}

static bool picture_of(struct picture *p, const struct frame_buffer *d, struct machine *m)
{
    const int set = machine_vpset_current(m), rank = machine_vpset_rank(m, set);
    const unsigned int x = d->axes_given ? d->axes[0] : (unsigned int)rank - 1;
    const unsigned int y =
        d->axes_given ? d->axes[1] : (unsigned int)rank - 2; /* may be none */
    uint64_t stride = 1;
    *p = (struct picture){
        .m = m, .vpset = set, .count = machine_vpset_count(m, set), .width = 1, .height = 1};
    if (x >= (unsigned int)rank) {
        paris_fail("x_axis: this VP set has axes 0..%d (CMFB_set_axes gave %u)", rank - 1, x);
        return false;
    }
    for (int axis = rank - 1; axis >= 0; axis--) {
        const int length = machine_vpset_length(m, set, axis);
        if ((unsigned int)axis == x) {
            p->width = (uint32_t)length;
            p->x_stride = stride;
        } else if ((unsigned int)axis == y) {
            p->height = (uint32_t)length;
            p->y_stride = stride;
        } else if (length > 1) {
            paris_fail("a picture has two axes, and axis %d of this VP set, of length %d, is a "
                       "third: copy a plane into a set of two",
                       axis, length);
            return false;
        }
        stride *= (uint64_t)length;
    }
    if (p->height == 1)
        p->y_stride = p->width;
    return true;
}

/* The processors' row-major indices in the order of their send addresses, for the set asked for
 * last. */
static struct {
    struct machine_layout layout;
    int dimensions[MACHINE_AXES_MAX], rank;
    uint32_t *of;
} order;

static void order_forget(void)
{
    free(order.of);
    order.of = NULL;
}

static const uint32_t *order_of(const struct picture *p)
{
    const struct paris_geometry *g = paris_geometry_current();
    static bool registered;
    if (order.of && order.rank == g->rank &&
        memcmp(order.dimensions, g->dimensions, sizeof *g->dimensions * (size_t)g->rank) == 0 &&
        memcmp(&order.layout, &g->layout, sizeof g->layout) == 0)
        return order.of;
    order_forget();
    order.of = malloc(p->count * sizeof *order.of);
    if (!order.of) {
        paris_fail_memory("not enough memory for the order of %llu processors",
                          (unsigned long long)p->count);
        return NULL;
    }
    if (!registered)
        registered = atexit(order_forget) == 0;
    uint64_t found = 0;
    for (uint64_t address = 0; found < p->count; address++) {
        const uint64_t index = machine_layout_index(&g->layout, address);
        if (index != UINT64_MAX)
            order.of[found++] = (uint32_t)index;
    }
    order.rank = g->rank;
    memcpy(order.dimensions, g->dimensions, sizeof g->dimensions);
    order.layout = g->layout;
    return order.of;
}

/* ---- writing ---- */

/* Fields' values on their way to pixels. The memory is kept for the next picture: new memory
 * costs more than what is done with it. */
static struct {
    uint8_t *at;
    uint64_t bytes;
} values;

static void values_forget(void)
{
    free(values.at);
    values.at = NULL;
    values.bytes = 0;
}

/* NULL: no memory; said. */
static uint8_t *values_room(const struct picture *p, uint64_t bytes)
{
    static bool registered;
    if (bytes <= values.bytes)
        return values.at;
    values_forget();
    values.at = malloc(bytes);
    if (!values.at) {
        paris_fail_memory("not enough memory for a picture of %u x %u", p->width, p->height);
        return NULL;
    }
    values.bytes = bytes;
    if (!registered)
        registered = atexit(values_forget) == 0;
    return values.at;
}

struct writing {
    struct frame_buffer_pixels to;
    struct picture picture;
    struct machine *m;
    unsigned int bits;
};

/* Checks all. False: an error, which has been said, or nobody looks on. */
static bool writing_begin(struct writing *w, const char *name, CMFB_display_id_t display,
                          unsigned int buffer, const CM_field_id_t *sources, int count, int x,
                          int y)
{
    static const char *const roles[] = {"red", "green", "blue"};
    w->m = paris_inquire(name);
    const struct frame_buffer *d = frame_buffer_of(display);
    if (!d || !frame_buffer_good_buffer(buffer))
        return false;
    w->bits = d->bits;
    if (count == 3 && d->bits != 24) {
        paris_fail("display: %d has 8 bits; red, green and blue want a display of 24", display);
        return false;
    }
    for (int i = 0; i < count; i++)
        if (!paris_check_field_wholly(sources[i], d->bits / (unsigned int)count,
                                      count == 3 ? roles[i] : "source"))
            return false;
    if (!picture_of(&w->picture, d, w->m) || !frame_buffer_watched())
        return false;
    w->to = (struct frame_buffer_pixels){.piece = {.display = display,
                                                   .buffer = buffer,
                                                   .pixel_bytes = d->bits == 8 ? 1 : 4,
                                                   .x = (uint32_t)x,
                                                   .y = (uint32_t)y},
                                         .columns = w->picture.width};
    const uint64_t bytes = w->picture.count * w->to.piece.pixel_bytes;
    if (4 + bytes > UINT32_MAX) {
        paris_fail("a picture of %u x %u is too large for a display", w->picture.width,
                   w->picture.height);
        return false;
    }
    w->m = paris_begin(name); /* calls that were only noted come first */
    return frame_buffer_pixels_make(&w->to, bytes);
}

static inline void pixel_put(uint8_t *at, uint32_t first, uint32_t second, uint32_t third)
{
    const uint32_t pixel = htole32(first | second << 8 | third << 16);
    memcpy(at, &pixel, sizeof pixel);
}

/* In the memory that is shared with a window blue is first: see frame_buffer.h. */
static bool blue_is_first(const struct writing *w)
{
    return w->bits == 24 && w->to.slot >= 0;
}

/* Rows of pixels of three of bytes, turned in their places. Compilers make vectors of it. */
static void rows_turn(void *writing, size_t first, size_t end)
{
    const struct writing *w = writing;
    const size_t width = w->picture.width;
    uint8_t *pixels = w->to.pixels + 4 * width * first;
    for (size_t k = width * first; k < width * end; k++, pixels += 4)
        pixel_put(pixels, pixels[2], pixels[1], pixels[0]);
}

static size_t row_bytes(const struct writing *w)
{
    return (size_t)w->picture.width * w->to.piece.pixel_bytes;
}

/* Pixel k becomes value from[k]'s place. */
static void pixels_permute(const struct writing *w, const uint8_t *from, const uint32_t *by)
{
    uint8_t *pixels = w->to.pixels;
    for (uint64_t k = 0; k < w->picture.count; k++) {
        const uint64_t index = by ? by[k] : place(&w->picture, k);
        if (w->to.piece.pixel_bytes == 1)
            pixels[k] = from[index];
        else
            memcpy(pixels + 4 * k, from + 4 * index, 4);
    }
}

/* Sends what was read, or nothing. */
static void writing_end(struct writing *w, bool read)
{
    if (read)
        frame_buffer_pixels_add(&w->to);
    else
        frame_buffer_pixels_drop(&w->to);
}

/* Where the machine has the fields' values as rows of the picture. rows->at is NULL: nowhere.
 * False: an error, which has been said. */
static bool rows_look(const struct writing *w, const CM_field_id_t *sources, int count,
                      unsigned int bits, struct machine_rows *rows)
{
    for (int i = 0; i < count; i++)
        rows[i] = (struct machine_rows){NULL, 0};
    if (!straight(&w->picture))
        return true;
    if (machine_fields_look(w->m, sources, count, MACHINE_UINT((int)bits), rows) == MACHINE_OK)
        return true;
    paris_fail_machine();
    return false;
}

static bool downloaded(const struct writing *w, CM_field_id_t source, unsigned int bits,
                       uint8_t *to)
{
    if (machine_field_download(w->m, source, MACHINE_UINT((int)bits), to) == MACHINE_OK)
        return true;
    paris_fail_machine();
    return false;
}

/* Rows on their way to pixels: of one field, or of three channels. */
struct rows_read {
    const struct writing *w;
    struct machine_rows from[3];
};

static void rows_copy(void *rows_read, size_t first, size_t end)
{
    const struct rows_read *r = rows_read;
    const size_t bytes = row_bytes(r->w);
    for (size_t y = first; y < end; y++)
        memcpy(r->w->to.pixels + y * bytes, r->from[0].at + y * r->from[0].pitch, bytes);
}

/* A picture that lies as it is, from the machine's memory where that is this computer's. */
static bool straight_read(struct writing *w, CM_field_id_t source)
{
    struct rows_read r = {.w = w};
    if (!rows_look(w, &source, 1, w->bits, r.from))
        return false;
    if (!r.from[0].at)
        return downloaded(w, source, w->bits, w->to.pixels);
    machine_rows_share(w->m, w->picture.height, row_bytes(w), rows_copy, &r);
    return true;
}

/* The field's values as they lie, or by their places or addresses. */
static bool values_read(struct writing *w, CM_field_id_t source, bool raw)
{
    const uint32_t *by = NULL;
    if (raw && !(by = order_of(&w->picture)))
        return false;
    if (!raw && straight(&w->picture))
        return straight_read(w, source);
    uint8_t *to = values_room(&w->picture, w->picture.count * w->to.piece.pixel_bytes);
    if (!to || !downloaded(w, source, w->bits, to))
        return false;
    pixels_permute(w, to, by);
    return true;
}

static bool field_read(struct writing *w, CM_field_id_t source, bool raw)
{
    const bool read = values_read(w, source, raw);
    if (read && blue_is_first(w))
        machine_rows_share(w->m, w->picture.height, row_bytes(w), rows_turn, w);
    return read;
}

void CMFB_write_news_always(CMFB_display_id_t display, unsigned int buffer,
                            CM_field_id_t source, int x_offset, int y_offset)
{
    struct writing w;
    if (writing_begin(&w, "CMFB_write_news_always", display, buffer, &source, 1, x_offset,
                      y_offset))
        writing_end(&w, field_read(&w, source, false));
}

void CMFB_write_always(CMFB_display_id_t display, unsigned int buffer, CM_field_id_t source,
                       int x_offset, int y_offset)
{
    struct writing w;
    if (writing_begin(&w, "CMFB_write_always", display, buffer, &source, 1, x_offset, y_offset))
        writing_end(&w, field_read(&w, source, true));
}

/* A row of pixels of three of bytes. Compilers make vectors of it. */
static void row_join(const uint8_t *restrict first, const uint8_t *restrict second,
                     const uint8_t *restrict third, uint8_t *restrict pixels, uint32_t width)
{
    for (uint32_t x = 0; x < width; x++)
        pixel_put(pixels + 4 * (size_t)x, first[x], second[x], third[x]);
}

static void rows_join(void *rows_read, size_t first, size_t end)
{
    const struct rows_read *r = rows_read;
    const struct machine_rows *from = r->from;
    for (size_t y = first; y < end; y++)
        row_join(from[0].at + y * from[0].pitch, from[1].at + y * from[1].pitch,
                 from[2].at + y * from[2].pitch, r->w->to.pixels + y * row_bytes(r->w),
                 r->w->picture.width);
}

/* Three planes of bytes to pixels, by their places. */
static void planes_join(const struct writing *w, const uint8_t *planes)
{
    const uint64_t count = w->picture.count;
    for (uint64_t k = 0; k < count; k++) {
        const uint64_t index = place(&w->picture, k);
        pixel_put(w->to.pixels + 4 * k, planes[index], planes[count + index],
                  planes[2 * count + index]);
    }
}

/* The channels as dense planes. NULL: an error, which has been said. */
static uint8_t *planes_read(const struct writing *w, const CM_field_id_t sources[3])
{
    uint8_t *planes = values_room(&w->picture, 3 * w->picture.count);
    for (uint64_t i = 0; planes && i < 3; i++)
        if (!downloaded(w, sources[i], 8, planes + i * w->picture.count))
            return NULL;
    return planes;
}

static bool channels_read(struct writing *w, const CM_field_id_t sources[3])
{
    struct rows_read r = {.w = w};
    if (!rows_look(w, sources, 3, 8, r.from))
        return false;
    if (!r.from[0].at || !r.from[1].at || !r.from[2].at) {
        const uint8_t *planes = planes_read(w, sources);
        if (planes && !straight(&w->picture))
            planes_join(w, planes);
        if (!planes || !straight(&w->picture))
            return planes != NULL;
        for (uint64_t i = 0; i < 3; i++)
            r.from[i] = (struct machine_rows){planes + i * w->picture.count, w->picture.width};
    }
    machine_rows_share(w->m, w->picture.height, row_bytes(w), rows_join, &r);
    return true;
}

void CMFB_write_rgb_news_always(CMFB_display_id_t display, unsigned int buffer,
                                CM_field_id_t red, CM_field_id_t green, CM_field_id_t blue,
                                int x_offset, int y_offset)
{
    const CM_field_id_t sources[3] = {red, green, blue}, turned[3] = {blue, green, red};
    struct writing w;
    if (writing_begin(&w, "CMFB_write_rgb_news_always", display, buffer, sources, 3, x_offset,
                      y_offset))
        writing_end(&w, channels_read(&w, blue_is_first(&w) ? turned : sources));
}

/* ---- the shuffle ---- */

void CMFB_shuffle_from_news_always(CMFB_display_id_t display, CM_field_id_t dest,
                                   CM_field_id_t source, unsigned int len)
{
    struct machine *m = paris_begin("CMFB_shuffle_from_news_always");
    const struct frame_buffer *d = frame_buffer_of(display);
    struct picture p;
    if (!d)
        return;
    if (len < 1 || len > 64) {
        paris_fail("len: must be 1..64 bits (got %u)", len);
        return;
    }
    if (!paris_check_field_wholly(source, len, "source") ||
        !paris_check_field_wholly(dest, len, "dest") || !picture_of(&p, d, m))
        return;
    const uint32_t *by = order_of(&p);
    if (!by)
        return;
    const struct machine_type type = MACHINE_UINT((int)len);
    const size_t bytes = machine_element_bytes(type);
    uint8_t *from = malloc(p.count * bytes), *to = malloc(p.count * bytes);
    if (!from || !to) {
        paris_fail_memory("not enough memory to shuffle %llu pixels",
                          (unsigned long long)p.count);
    } else if (machine_field_download(m, source, type, from) == MACHINE_OK) {
        for (uint64_t k = 0; k < p.count; k++)
            memcpy(to + by[k] * bytes, from + place(&p, k) * bytes, bytes);
        if (machine_field_upload(m, dest, type, to) != MACHINE_OK)
            paris_fail_machine();
    } else {
        paris_fail_machine();
    }
    free(from);
    free(to);
}
