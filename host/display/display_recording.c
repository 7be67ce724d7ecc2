/* display_recording.c - screens out of pieces of a recording. */
#include "display_recording.h"
#include "display_internal.h"

#include <stdlib.h>
#include <string.h>

enum { KIND_SIZE = 1, KIND_PIXELS, KIND_CLEAR, KIND_MAP, KIND_VIEW, KIND_END, KIND_ROOM };
enum { LINE_BYTES = sizeof DISPLAY_RECORDING_LINE - 1, MAP_BYTES = 3 * 256 };

struct piece {
    unsigned kind, number, buffer, pixel_bytes;
    uint32_t bytes, x, y;
    uint64_t time_us;
    const uint8_t *more;
};

static uint64_t number_of(const uint8_t *at, int bytes)
{
    uint64_t n = 0;
    for (int i = 0; i < bytes; i++)
        n |= (uint64_t)at[i] << 8 * i;
    return n;
}

static struct piece piece_of(const uint8_t *head)
{
    return (struct piece){.kind = head[0],
                          .number = head[1],
                          .buffer = head[2],
                          .pixel_bytes = head[3],
                          .bytes = (uint32_t)number_of(head + 4, 4),
                          .time_us = number_of(head + 8, 8),
                          .x = (uint32_t)number_of(head + 16, 4),
                          .y = (uint32_t)number_of(head + 20, 4),
                          .more = head + DISPLAY_PIECE_HEAD};
}

/* ---- what a piece may say ---- */

/* By the head alone, before the rest is waited for. NULL: it may be. */
static const char *head_wrong(const struct display_reader *reader, const struct piece *p)
{
    if (p->kind < KIND_SIZE ||
        p->kind > (reader->shared && reader->shared->at ? KIND_ROOM : KIND_END))
        return "there is no such piece";
    if (p->number < 1 || p->number > DISPLAY_SCREENS || p->buffer > 1)
        return "there is no such display or buffer";
    if (p->kind != KIND_SIZE && !reader->screens[p->number - 1].there)
        return "the display has no size";
    const uint64_t most = 4 + 4ull * DISPLAY_SCREEN_SIDE_MAX * DISPLAY_SCREEN_SIDE_MAX;
    static const struct {
        uint64_t least, most;
    } bytes[] = {[KIND_SIZE] = {0, 64}, [KIND_PIXELS] = {4, UINT32_MAX},
                 [KIND_CLEAR] = {0, 0}, [KIND_MAP] = {MAP_BYTES, MAP_BYTES},
                 [KIND_VIEW] = {8, 8},  [KIND_END] = {0, 0},
                 [KIND_ROOM] = {12, 12}};
    if (p->bytes < bytes[p->kind].least || p->bytes > bytes[p->kind].most || p->bytes > most)
        return "a piece of that kind has not so many bytes";
    if (p->kind == KIND_SIZE &&
        (p->x < 1 || p->x > DISPLAY_SCREEN_SIDE_MAX || p->y < 1 ||
         p->y > DISPLAY_SCREEN_SIDE_MAX || (p->pixel_bytes != 1 && p->pixel_bytes != 4)))
        return "no display has such a size";
    return NULL;
}

/* ---- screens ---- */

static void pixels_free(const struct display_reader *reader, struct display_screen *s,
                        unsigned buffer)
{
    if (s->slot[buffer] && s->slot[buffer] != s->kept)
        picture_room_give(reader->shared, s->slot[buffer] - 1);
    else if (!s->slot[buffer])
        free(s->pixels[buffer]);
    s->pixels[buffer] = NULL;
    s->slot[buffer] = 0;
}

static void screen_free(const struct display_reader *reader, struct display_screen *s)
{
    pixels_free(reader, s, 0);
    pixels_free(reader, s, 1);
    *s = (struct display_screen){.kept = s->kept};
}

void display_reader_keep(struct display_reader *reader, int number, bool shown)
{
    struct display_screen *s = &reader->screens[number - 1];
    const int now = shown ? s->slot[s->seen] : 0;
    if (s->kept && s->kept != now && s->kept != s->slot[0] && s->kept != s->slot[1])
        picture_room_give(reader->shared, s->kept - 1);
    s->kept = now;
}

static void screen_begin(const struct display_reader *reader, struct display_screen *s,
                         const struct piece *p)
{
    screen_free(reader, s);
    s->there = true;
    s->width_px = (int)p->x;
    s->height_px = (int)p->y;
    s->pixel_bytes = (int)p->pixel_bytes;
    s->zoom[0] = s->zoom[1] = 1;
    memcpy(s->title, p->more, p->bytes);
    for (int i = 0; i < 256; i++)
        memset(s->map[i], i, 3);
}

static uint8_t *buffer_of(struct display_screen *s, unsigned buffer)
{
    if (!s->pixels[buffer])
        s->pixels[buffer] =
            calloc((size_t)s->width_px * (size_t)s->height_px, (size_t)s->pixel_bytes);
    return s->pixels[buffer];
}

static void row_copied(uint8_t *to, const uint8_t *from, uint64_t bytes)
{
    memcpy(to, from, bytes);
}

/* Pixels of red, green, blue and 0, as pieces have them, blue first. */
static void row_turned(uint8_t *to, const uint8_t *from, uint64_t bytes)
{
    for (uint64_t i = 0; i < bytes; i += 4) {
        const uint8_t pixel[4] = {from[i + 2], from[i + 1], from[i], 0};
        memcpy(to + i, pixel, sizeof pixel);
    }
}

/* The pixels of a piece, so many bytes at `from`. */
static enum display_status pixels_put(struct display_screen *s, const struct piece *p,
                                      const uint8_t *from, uint64_t bytes)
{
    const uint64_t columns = number_of(p->more, 4), each = (uint64_t)s->pixel_bytes;
    const int64_t x = (int32_t)p->x, y = (int32_t)p->y;
    if (!columns || bytes % (columns * each))
        return display_fail(DISPLAY_BAD_FILE, "pixels that fill no rows of %llu",
                            (unsigned long long)columns);
    const int64_t rows = (int64_t)(bytes / (columns * each));
    const int64_t left = x < 0 ? -x : 0;
    const int64_t right =
        x + (int64_t)columns > s->width_px ? s->width_px - x : (int64_t)columns;
    uint8_t *to = buffer_of(s, p->buffer);
    if (!to)
        return display_fail(DISPLAY_NO_MEMORY, "not enough memory for a display of %d x %d",
                            s->width_px, s->height_px);
    void (*const put)(uint8_t *, const uint8_t *, uint64_t) =
        each == 4 && p->kind == KIND_PIXELS ? row_turned : row_copied;
    for (int64_t row = 0; row < rows && left < right; row++)
        if (y + row >= 0 && y + row < s->height_px)
            put(to + (uint64_t)((y + row) * s->width_px + x + left) * each,
                from + ((uint64_t)row * columns + (uint64_t)left) * each,
                (uint64_t)(right - left) * each);
    return DISPLAY_OK;
}

/* Whether a screen's pixels lie in that slot already: a program fills none of those. */
static bool slot_held(const struct display_reader *reader, int slot)
{
    bool held = false;
    for (int i = 0; i < DISPLAY_SCREENS; i++)
        held = held || reader->screens[i].slot[0] == slot + 1 ||
               reader->screens[i].slot[1] == slot + 1 || reader->screens[i].kept == slot + 1;
    return held;
}

/* Pixels in the room. Where they are the whole screen they stay there, and the screen gives its
 * slot of before. */
static enum display_status slot_take(struct display_reader *reader, struct display_screen *s,
                                     const struct piece *p)
{
    const uint64_t slot = number_of(p->more + 4, 4), bytes = number_of(p->more + 8, 4),
                   width = (uint64_t)s->width_px;
    if (slot >= PICTURE_ROOM_SLOTS || bytes > PICTURE_ROOM_SLOT_BYTES ||
        slot_held(reader, (int)slot))
        return display_fail(DISPLAY_BAD_FILE, "pixels in slot %llu that are not there",
                            (unsigned long long)slot);
    uint8_t *from = picture_room_slot(reader->shared, (int)slot);
    if (number_of(p->more, 4) == width && !p->x && !p->y &&
        bytes == width * (uint64_t)s->height_px * (uint64_t)s->pixel_bytes) {
        pixels_free(reader, s, p->buffer);
        s->pixels[p->buffer] = from;
        s->slot[p->buffer] = (int)slot + 1;
        return DISPLAY_OK;
    }
    const enum display_status status = pixels_put(s, p, from, bytes);
    picture_room_give(reader->shared, (int)slot);
    return status;
}

static enum display_status clear(struct display_screen *s, const struct piece *p)
{
    const size_t count = (size_t)s->width_px * (size_t)s->height_px;
    if (!p->x && !s->pixels[p->buffer])
        return DISPLAY_OK;
    uint8_t *to = buffer_of(s, p->buffer);
    if (!to)
        return display_fail(DISPLAY_NO_MEMORY, "not enough memory for a display of %d x %d",
                            s->width_px, s->height_px);
    if (s->pixel_bytes == 1) {
        memset(to, (int)(p->x & 255), count);
        return DISPLAY_OK;
    }
    const uint8_t pixel[4] = {(uint8_t)(p->x >> 16), (uint8_t)(p->x >> 8), (uint8_t)p->x, 0};
    for (size_t i = 0; i < count; i++)
        memcpy(to + 4 * i, pixel, 4);
    return DISPLAY_OK;
}

static enum display_status view(struct display_screen *s, const struct piece *p)
{
    const uint64_t zoom[2] = {number_of(p->more, 4), number_of(p->more + 4, 4)};
    if (!zoom[0] || zoom[0] > 256 || !zoom[1] || zoom[1] > 256)
        return display_fail(DISPLAY_BAD_FILE, "a zoom of %llu x %llu",
                            (unsigned long long)zoom[0], (unsigned long long)zoom[1]);
    s->seen = (int)p->buffer;
    for (int i = 0; i < 2; i++)
        s->zoom[i] = (uint32_t)zoom[i];
    s->pan[0] = (int32_t)p->x;
    s->pan[1] = (int32_t)p->y;
    return DISPLAY_OK;
}

static enum display_status piece_take(struct display_reader *reader, const struct piece *p)
{
    struct display_screen *s = &reader->screens[p->number - 1];
    struct display_change change = {.number = (int)p->number, .time_us = p->time_us};
    enum display_status status = DISPLAY_OK;
    if (p->kind == KIND_SIZE) {
        screen_begin(reader, s, p);
        change.opened = true;
    } else if (p->kind == KIND_PIXELS || p->kind == KIND_ROOM) {
        status = p->kind == KIND_ROOM ? slot_take(reader, s, p)
                                      : pixels_put(s, p, p->more + 4, p->bytes - 4);
        change.seen = s->seen == (int)p->buffer;
    } else if (p->kind == KIND_CLEAR) {
        status = clear(s, p);
        change.seen = s->seen == (int)p->buffer;
    } else if (p->kind == KIND_MAP) {
        memcpy(s->map, p->more, MAP_BYTES);
        change.seen = true;
    } else if (p->kind == KIND_VIEW) {
        status = view(s, p);
        change.seen = true;
    } else {
        change.closed = true;
    }
    if (status != DISPLAY_OK)
        return status;
    reader->pieces++;
    reader->stopped = !reader->take(reader->context, &change);
    if (change.closed)
        screen_free(reader, s);
    return DISPLAY_OK;
}

/* ---- the bytes ---- */

static bool room_make(struct display_reader *reader, size_t bytes)
{
    if (bytes <= reader->room)
        return true;
    const size_t room = bytes > 2 * reader->room ? bytes : 2 * reader->room;
    uint8_t *more = realloc(reader->bytes, room);
    if (!more)
        return false;
    reader->bytes = more;
    reader->room = room;
    return true;
}

static enum display_status not_here(const struct display_reader *reader, const char *why)
{
    return display_fail(DISPLAY_BAD_FILE, "no recording of displays at byte %llu: %s",
                        (unsigned long long)reader->read, why);
}

/* Bytes of the item that begins what is held; 0: more are needed to tell. *why: it is none. */
static size_t length_of(const struct display_reader *reader, struct piece *p, const char **why)
{
    const size_t looked = reader->held < LINE_BYTES ? reader->held : (size_t)LINE_BYTES;
    *why = NULL;
    if (!reader->begun || (looked && reader->bytes[0] == DISPLAY_RECORDING_LINE[0])) {
        if (memcmp(reader->bytes, DISPLAY_RECORDING_LINE, looked) != 0)
            *why = "it must be \"lutetia display 1\" there";
        return LINE_BYTES;
    }
    if (reader->held < DISPLAY_PIECE_HEAD)
        return 0;
    *p = piece_of(reader->bytes);
    *why = head_wrong(reader, p);
    return DISPLAY_PIECE_HEAD + p->bytes;
}

enum display_status display_reader_feed(struct display_reader *reader, const uint8_t *bytes,
                                        size_t count)
{
    size_t whole = 0; /* of what is held */
    struct piece p = {0};
    const char *why = NULL;
    if (reader->held)
        whole = length_of(reader, &p, &why);
    while (count > 0 && !reader->stopped) {
        const size_t wanted = whole ? whole : reader->begun ? (size_t)DISPLAY_PIECE_HEAD : 1;
        const size_t need = wanted > reader->held ? wanted - reader->held : 1;
        const size_t step = need < count ? need : count;
        if (!room_make(reader, reader->held + step))
            return display_fail(DISPLAY_NO_MEMORY, "not enough memory for a piece of %zu bytes",
                                wanted);
        memcpy(reader->bytes + reader->held, bytes, step);
        reader->held += step;
        bytes += step;
        count -= step;
        whole = length_of(reader, &p, &why);
        if (why)
            return not_here(reader, why);
        if (!whole || reader->held < whole)
            continue;
        enum display_status status = DISPLAY_OK;
        if (reader->bytes[0] == DISPLAY_RECORDING_LINE[0])
            reader->begun = true;
        else
            status = piece_take(reader, &p);
        if (status != DISPLAY_OK)
            return status;
        reader->read += reader->held;
        reader->held = whole = 0;
    }
    return DISPLAY_OK;
}

enum display_status display_reader_end(const struct display_reader *reader)
{
    if (reader->stopped || (reader->begun && !reader->held))
        return DISPLAY_OK;
    return reader->begun ? display_fail(DISPLAY_BAD_FILE, "ends within piece %llu",
                                        (unsigned long long)reader->pieces)
                         : display_fail(DISPLAY_BAD_FILE, "ends before its first line does");
}

void display_reader_finish(struct display_reader *reader)
{
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        display_reader_keep(reader, i + 1, false);
        screen_free(reader, &reader->screens[i]);
    }
    free(reader->bytes);
    reader->bytes = NULL;
    reader->held = reader->room = 0;
}
