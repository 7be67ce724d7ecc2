/* gray_picture.c - gray that comes from elsewhere: see gray.h. */
#include "gray.h"
#include "internal.h"

#include <stdlib.h>
#include <string.h>

enum font_status font_gray_put(struct font_gray *gray, const struct font_gray_frame *frame,
                               const uint8_t *cover, size_t pitch)
{
    *gray = (struct font_gray){0};
    if (frame->width_px < 0 || frame->width_px > FONT_SIDE_MAX || frame->height_px < 0 ||
        frame->height_px > FONT_SIDE_MAX)
        return font_fail(FONT_TOO_LARGE, "gray of %dx%d pixels is too large", frame->width_px,
                         frame->height_px);
    gray->left_px = frame->left_px;
    gray->top_px = frame->top_px;
    if (!frame->width_px || !frame->height_px)
        return FONT_OK;
    size_t row = ((size_t)frame->width_px + 15) / 16 * 16;
    size_t bytes = (row * (size_t)frame->height_px + 63) / 64 * 64;
    gray->memory = aligned_alloc(64, bytes);
    if (!gray->memory)
        return font_fail(FONT_NO_MEMORY, "no memory for gray of %dx%d pixels", frame->width_px,
                         frame->height_px);
    memset(gray->memory, 0, bytes);
    gray->memory_bytes = bytes;
    gray->pixels = gray->memory;
    gray->pitch = (int)row;
    gray->width_px = frame->width_px;
    gray->height_px = frame->height_px;
    for (int r = 0; r < frame->height_px; r++)
        memcpy(gray->pixels + (size_t)r * row, cover + (size_t)r * pitch,
               (size_t)frame->width_px);
    return FONT_OK;
}

enum font_status font_gray_copy(const struct font_gray *from, struct font_gray *to)
{
    const struct font_gray_frame frame = {from->left_px, from->top_px,
                                          from->pixels ? from->width_px : 0,
                                          from->pixels ? from->height_px : 0};
    return font_gray_put(to, &frame, from->pixels, (size_t)from->pitch);
}
