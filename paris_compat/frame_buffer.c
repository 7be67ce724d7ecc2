/* frame_buffer.c - displays, and what is seen of them: zoom, pan, two buffers, colour maps. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "frame_buffer.h"

static struct frame_buffer displays[CMFB_displays_most];

/* ---- displays ---- */

static struct frame_buffer *attached(CMFB_display_id_t display)
{
    if (display >= 1 && display <= CMFB_displays_most && displays[display - 1].attached)
        return &displays[display - 1];
    paris_fail("display: %d is not attached: CMFB_attach_display returns one that is", display);
    return NULL;
}

struct frame_buffer *frame_buffer_of(CMFB_display_id_t display)
{
    struct frame_buffer *d = attached(display);
    if (!d || d->bits)
        return d;
    paris_fail("display: %d has no size yet: call CMFB_initialize_display first", display);
    return NULL;
}

bool frame_buffer_good_buffer(unsigned int buffer)
{
    if (buffer < 2)
        return true;
    paris_fail("buffer: must be 0 or 1 (got %u)", buffer);
    return false;
}

CMFB_display_id_t CMFB_attach_display(const char *name)
{
    paris_inquire("CMFB_attach_display");
    for (int i = 0; i < CMFB_displays_most; i++) {
        struct frame_buffer *d = &displays[i];
        if (d->attached)
            continue;
        *d = (struct frame_buffer){.attached = true};
        snprintf(d->name, sizeof d->name, "%s",
                 name && *name ? name : program_invocation_short_name);
        return i + 1;
    }
    paris_fail("%d displays are attached, which is all there are: detach one first",
               CMFB_displays_most);
    return CMFB_no_display;
}

void CMFB_detach_display(CMFB_display_id_t display)
{
    paris_inquire("CMFB_detach_display");
    struct frame_buffer *d = attached(display);
    if (!d)
        return;
    d->attached = false;
    struct frame_buffer_piece end = {.kind = FRAME_BUFFER_END, .display = display};
    if (d->bits && frame_buffer_watched() && frame_buffer_piece_make(&end, 0))
        frame_buffer_piece_add(&end);
}

int CMFB_attached(CMFB_display_id_t display)
{
    return display >= 1 && display <= CMFB_displays_most && displays[display - 1].attached;
}

void CMFB_initialize_display(CMFB_display_id_t display, unsigned int bits, unsigned int width,
                             unsigned int height)
{
    paris_inquire("CMFB_initialize_display");
    struct frame_buffer *d = attached(display);
    if (!d)
        return;
    if (bits != 8 && bits != 24) {
        paris_fail("bits: must be 8 or 24 (got %u)", bits);
        return;
    }
    if (width < 1 || width > CMFB_side_most || height < 1 || height > CMFB_side_most) {
        paris_fail("width, height: must be 1..%d (got %u, %u)", CMFB_side_most, width, height);
        return;
    }
    d->bits = bits;
    d->width = (int)width;
    d->height = (int)height;
    d->seen = 0;
    d->zoom[0] = d->zoom[1] = 1;
    d->pan[0] = d->pan[1] = 0;
    for (int i = 0; i < CMFB_colors; i++)
        memset(d->map[i], i, 3);
    struct frame_buffer_piece size = {.kind = FRAME_BUFFER_SIZE,
                                      .display = display,
                                      .pixel_bytes = bits == 8 ? 1 : 4,
                                      .x = width,
                                      .y = height};
    if (frame_buffer_watched() && frame_buffer_piece_make(&size, strlen(d->name))) {
        memcpy(size.more, d->name, strlen(d->name));
        frame_buffer_piece_add(&size);
    }
}

#define INQUIRY(type, name, member)                                                            \
    type name(CMFB_display_id_t display)                                                       \
    {                                                                                          \
        paris_inquire(#name);                                                                  \
        const struct frame_buffer *d = attached(display);                                      \
        return d ? (type)d->member : 0;                                                        \
    }
INQUIRY(unsigned int, CMFB_display_bits, bits)
INQUIRY(unsigned int, CMFB_display_width, width)
INQUIRY(unsigned int, CMFB_display_height, height)
INQUIRY(unsigned int, CMFB_buffer_seen, seen)

int CMFB_watched(void)
{
    return frame_buffer_watched();
}

void CMFB_set_axes(CMFB_display_id_t display, unsigned int x_axis, unsigned int y_axis)
{
    paris_inquire("CMFB_set_axes");
    struct frame_buffer *d = attached(display);
    if (!d)
        return;
    if (x_axis == y_axis || x_axis >= MACHINE_AXES_MAX || y_axis >= MACHINE_AXES_MAX) {
        paris_fail("x_axis, y_axis: must be two axes of 0..%d (got %u, %u)",
                   MACHINE_AXES_MAX - 1, x_axis, y_axis);
        return;
    }
    d->axes_given = true;
    d->axes[0] = x_axis;
    d->axes[1] = y_axis;
}

void CMFB_clear(CMFB_display_id_t display, unsigned int buffer, unsigned int value)
{
    paris_inquire("CMFB_clear");
    const struct frame_buffer *d = frame_buffer_of(display);
    if (!d || !frame_buffer_good_buffer(buffer))
        return;
    if (value >> d->bits) {
        paris_fail("value: %u does not fit into the display's %u bits", value, d->bits);
        return;
    }
    struct frame_buffer_piece clear = {
        .kind = FRAME_BUFFER_CLEAR, .display = display, .buffer = buffer, .x = value};
    if (frame_buffer_watched() && frame_buffer_piece_make(&clear, 0))
        frame_buffer_piece_add(&clear);
}

/* ---- what is seen ---- */

static void view_tell(CMFB_display_id_t display, const struct frame_buffer *d)
{
    struct frame_buffer_piece view = {.kind = FRAME_BUFFER_VIEW,
                                      .display = display,
                                      .buffer = d->seen,
                                      .x = (uint32_t)d->pan[0],
                                      .y = (uint32_t)d->pan[1]};
    if (!frame_buffer_watched() || !frame_buffer_piece_make(&view, 8))
        return;
    for (int i = 0; i < 8; i++)
        view.more[i] = (uint8_t)(d->zoom[i / 4] >> 8 * (i % 4));
    frame_buffer_piece_add(&view);
}

void CMFB_switch_buffer(CMFB_display_id_t display, unsigned int buffer)
{
    paris_inquire("CMFB_switch_buffer");
    struct frame_buffer *d = frame_buffer_of(display);
    if (!d || !frame_buffer_good_buffer(buffer))
        return;
    d->seen = buffer;
    view_tell(display, d);
}

void CMFB_spin(CMFB_display_id_t display)
{
    paris_inquire("CMFB_spin");
    struct frame_buffer *d = frame_buffer_of(display);
    if (!d)
        return;
    d->seen = !d->seen;
    view_tell(display, d);
}

void CMFB_set_zoom(CMFB_display_id_t display, unsigned int x_zoom, unsigned int y_zoom)
{
    paris_inquire("CMFB_set_zoom");
    struct frame_buffer *d = frame_buffer_of(display);
    if (!d)
        return;
    if (x_zoom < 1 || x_zoom > 256 || y_zoom < 1 || y_zoom > 256) {
        paris_fail("x_zoom, y_zoom: must be 1..256 (got %u, %u)", x_zoom, y_zoom);
        return;
    }
    d->zoom[0] = x_zoom;
    d->zoom[1] = y_zoom;
    view_tell(display, d);
}

void CMFB_set_pan(CMFB_display_id_t display, int x, int y)
{
    paris_inquire("CMFB_set_pan");
    struct frame_buffer *d = frame_buffer_of(display);
    if (!d)
        return;
    d->pan[0] = x;
    d->pan[1] = y;
    view_tell(display, d);
}

/* ---- colour maps ---- */

static struct frame_buffer *map_of(CMFB_display_id_t display, unsigned int first,
                                   unsigned int count)
{
    struct frame_buffer *d = frame_buffer_of(display);
    if (!d)
        return NULL;
    if (first <= CMFB_colors && count <= CMFB_colors - first)
        return d;
    paris_fail("first, count: must be within the map's %d rows (got %u, %u)", CMFB_colors,
               first, count);
    return NULL;
}

static bool columns_good(const void *red, const void *green, const void *blue)
{
    if (red && green && blue)
        return true;
    paris_fail("%s: is NULL", !red ? "red" : !green ? "green" : "blue");
    return false;
}

static void map_tell(CMFB_display_id_t display, const struct frame_buffer *d)
{
    struct frame_buffer_piece map = {.kind = FRAME_BUFFER_MAP, .display = display};
    if (!frame_buffer_watched() || !frame_buffer_piece_make(&map, sizeof d->map))
        return;
    memcpy(map.more, d->map, sizeof d->map);
    frame_buffer_piece_add(&map);
}

void CMFB_write_color_map(CMFB_display_id_t display, unsigned int first, unsigned int count,
                          const unsigned char *red, const unsigned char *green,
                          const unsigned char *blue)
{
    paris_inquire("CMFB_write_color_map");
    struct frame_buffer *d = map_of(display, first, count);
    if (!d || !columns_good(red, green, blue))
        return;
    for (unsigned int i = 0; i < count; i++) {
        uint8_t *row = d->map[first + i];
        row[0] = red[i];
        row[1] = green[i];
        row[2] = blue[i];
    }
    map_tell(display, d);
}

void CMFB_read_color_map(CMFB_display_id_t display, unsigned int first, unsigned int count,
                         unsigned char *red, unsigned char *green, unsigned char *blue)
{
    paris_inquire("CMFB_read_color_map");
    const struct frame_buffer *d = map_of(display, first, count);
    if (!d || !columns_good(red, green, blue))
        return;
    for (unsigned int i = 0; i < count; i++) {
        const uint8_t *row = d->map[first + i];
        red[i] = row[0];
        green[i] = row[1];
        blue[i] = row[2];
    }
}

void CMFB_cycle_color_map(CMFB_display_id_t display, unsigned int first, unsigned int count,
                          int steps)
{
    paris_inquire("CMFB_cycle_color_map");
    struct frame_buffer *d = map_of(display, first, count);
    uint8_t rows[CMFB_colors][3];
    if (!d || !count)
        return;
    const long turn = ((long)steps % (long)count + (long)count) % (long)count;
    for (unsigned int i = 0; i < count; i++)
        memcpy(rows[(i + (unsigned int)turn) % count], d->map[first + i], 3);
    memcpy(d->map[first], rows, 3ul * count);
    map_tell(display, d);
}
