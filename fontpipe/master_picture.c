/* master_picture.c - masters as pictures in bytes and back: for retouching in a painting
 * program. */
#include "internal.h"
#include "master.h"

#include <stdlib.h>

void font_master_to_picture(const struct font_master *m, int margin_px, uint8_t *gray)
{
    int width = m->width_px + 2 * margin_px, height = m->height_px + 2 * margin_px;
    for (int r = 0; r < height; r++)
        for (int c = 0; c < width; c++)
            gray[(size_t)r * (size_t)width + (size_t)c] =
                font_master_at(m, m->left_px - margin_px + c, m->top_px - margin_px + r) ? 0
                                                                                         : 255;
}

enum font_status font_master_from_picture(struct font_master *m,
                                          const struct font_master_frame *frame,
                                          const uint8_t *gray)
{
    enum { SIDE_MAX = 1 << 16 };
    font_master_finish(m);
    if (frame->em_px < 1 || frame->em_px > FONT_MASTER_EM_MAX || frame->width_px < 1 ||
        frame->height_px < 1 || frame->width_px > SIDE_MAX || frame->height_px > SIDE_MAX ||
        abs(frame->left_px) > SIDE_MAX || abs(frame->top_px) > SIDE_MAX)
        return font_fail(
            FONT_BAD_ARGUMENT, "a master of %dx%d pixels at (%d, %d), %d to the em, cannot be",
            frame->width_px, frame->height_px, frame->left_px, frame->top_px, frame->em_px);
    int words = (frame->width_px + 63) / 64;
    uint64_t *bits = calloc((size_t)words * (size_t)frame->height_px, sizeof *bits);
    if (!bits)
        return font_fail(FONT_NO_MEMORY, "no memory for a master of %dx%d pixels",
                         frame->width_px, frame->height_px);
    for (int r = 0; r < frame->height_px; r++)
        for (int c = 0; c < frame->width_px; c++)
            if (gray[(size_t)r * (size_t)frame->width_px + (size_t)c] < 128)
                bits[(size_t)r * (size_t)words + (size_t)(c / 64)] |= 1ull << (c % 64);
    *m = (struct font_master){.em_px = frame->em_px,
                              .left_px = frame->left_px,
                              .top_px = frame->top_px,
                              .width_px = frame->width_px,
                              .height_px = frame->height_px,
                              .row_words = words,
                              .bits = bits,
                              .advance_px = frame->advance_px};
    return FONT_OK;
}

enum font_status font_master_copy(const struct font_master *from, struct font_master *to)
{
    size_t words = (size_t)from->row_words * (size_t)from->height_px;
    uint64_t *bits = words ? malloc(words * sizeof *bits) : NULL;
    if (words && !bits)
        return font_fail(FONT_NO_MEMORY, "no memory for a master");
    for (size_t i = 0; i < words; i++)
        bits[i] = from->bits[i];
    *to = *from;
    to->bits = bits;
    return FONT_OK;
}

long font_master_differs(const struct font_master *a, const struct font_master *b)
{
    long count = 0;
    const struct font_master *both[2] = {a, b};
    /* The pixels of each that the other has not; those outside its box are white. */
    for (int k = 0; k < 2; k++) {
        const struct font_master *here = both[k], *there = both[1 - k];
        for (int r = 0; r < here->height_px; r++)
            for (int c = 0; c < here->width_px; c++)
                count += font_master_at(here, here->left_px + c, here->top_px + r) &&
                         !font_master_at(there, here->left_px + c, here->top_px + r);
    }
    return count;
}
