/* frame_buffer_record.c - pieces of the recording of LUTETIA_DISPLAY: see frame_buffer.h. */
#include <stdlib.h>
#include <string.h>

#include "frame_buffer.h"
#include "recording.h"

static void finish(void);
static struct paris_recording displays_recording = {.variable = "LUTETIA_DISPLAY",
                                                    .verb = "display",
                                                    .line = "lutetia display 1\n",
                                                    .room_wanted = true,
                                                    .finish = finish};
static uint8_t *room; /* the head, and what follows it */
static size_t room_bytes;

static void finish(void)
{
    paris_recording_finish(&displays_recording);
    free(room);
    room = NULL;
    room_bytes = 0;
}

bool frame_buffer_watched(void)
{
    return paris_recording_wanted(&displays_recording);
}

bool frame_buffer_piece_make(struct frame_buffer_piece *piece, size_t bytes)
{
    if (FRAME_BUFFER_HEAD + bytes > room_bytes) {
        uint8_t *more = realloc(room, FRAME_BUFFER_HEAD + bytes);
        if (!more) {
            paris_fail_memory("not enough memory for a picture of %zu bytes", bytes);
            return false;
        }
        room = more;
        room_bytes = FRAME_BUFFER_HEAD + bytes;
    }
    piece->bytes = (uint32_t)bytes;
    piece->more = room + FRAME_BUFFER_HEAD;
    return true;
}

static void number_put(uint8_t *at, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++)
        at[i] = (uint8_t)(number >> 8 * i);
}

void frame_buffer_piece_add(struct frame_buffer_piece *piece)
{
    const uint64_t us = paris_recording_us(&displays_recording);
    if (!frame_buffer_watched())
        return;
    room[0] = (uint8_t)piece->kind;
    room[1] = (uint8_t)piece->display;
    room[2] = (uint8_t)piece->buffer;
    room[3] = (uint8_t)piece->pixel_bytes;
    number_put(room + 4, piece->bytes, 4);
    number_put(room + 8, us, 8);
    number_put(room + 16, piece->x, 4);
    number_put(room + 20, piece->y, 4);
    paris_recording_add(&displays_recording, room, FRAME_BUFFER_HEAD + piece->bytes);
}

/* ---- pixels ---- */

bool frame_buffer_pixels_make(struct frame_buffer_pixels *p, size_t bytes)
{
    struct picture_room *shared = &displays_recording.room;
    p->bytes = bytes;
    p->slot = bytes <= PICTURE_ROOM_SLOT_BYTES ? picture_room_take(shared) : -1;
    if (p->slot >= 0) {
        p->pixels = picture_room_slot(shared, p->slot);
        return true;
    }
    p->piece.kind = FRAME_BUFFER_PIXELS;
    if (!frame_buffer_piece_make(&p->piece, 4 + bytes))
        return false;
    number_put(p->piece.more, p->columns, 4);
    p->pixels = p->piece.more + 4;
    return true;
}

void frame_buffer_pixels_add(struct frame_buffer_pixels *p)
{
    if (p->slot >= 0) {
        p->piece.kind = FRAME_BUFFER_ROOM;
        if (!frame_buffer_piece_make(&p->piece, 12)) {
            frame_buffer_pixels_drop(p);
            return;
        }
        number_put(p->piece.more, p->columns, 4);
        number_put(p->piece.more + 4, (uint64_t)p->slot, 4);
        number_put(p->piece.more + 8, p->bytes, 4);
    }
    frame_buffer_piece_add(&p->piece);
}

void frame_buffer_pixels_drop(struct frame_buffer_pixels *p)
{
    if (p->slot >= 0)
        picture_room_give(&displays_recording.room, p->slot);
}
