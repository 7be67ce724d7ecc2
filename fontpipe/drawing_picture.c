/* drawing_picture.c - glyphs that are pictures, in drawings: see drawing_internal.h. */
#include "drawing_internal.h"

#include <stdlib.h>
#include <string.h>

#include <zlib.h>

enum font_status drawn_tile(struct drawn *drawn, const struct font_drawing *d,
                            const struct font_layout *layout, int i, const struct font_map *map,
                            double x, double y, struct font_tile *out)
{
    enum { SIDE_MAX = 30000 };
    struct font_map finer = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
    const struct font_map scale = {FONT_AFFINE, {DRAWN_FINER, 0, 0, 0, DRAWN_FINER, 0}};
    struct font_painter_def def = font_painter_def_default();
    enum font_status status =
        drawn->painter ? FONT_OK : font_painter_create(&def, &drawn->painter);
    *out = (struct font_tile){0};
    if (!(d->width_px * DRAWN_FINER <= SIDE_MAX && d->height_px * DRAWN_FINER <= SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a drawing with pictures in its text can have %d pixels a side",
                         SIDE_MAX / DRAWN_FINER);
    finer = font_map_then(map ? *map : finer, scale);
    return status == FONT_OK
               ? font_painter_tile(drawn->painter, layout, i, &finer, x * DRAWN_FINER,
                                   y * DRAWN_FINER, d->ink, (int)(d->width_px * DRAWN_FINER),
                                   (int)(d->height_px * DRAWN_FINER), out)
               : status;
}

enum font_status drawn_ink_tile(const struct font_ink *ink, struct font_tile *out)
{
    size_t width = (size_t)ink->width_px, height = (size_t)ink->height_px;
    *out = (struct font_tile){.width_px = ink->width_px, .height_px = ink->height_px};
    uint8_t *to = out->rgba = malloc(4 * width * height);
    if (!to)
        return font_fail(FONT_NO_MEMORY, "no memory for a drawing");
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++, to += 4) {
            memcpy(to, ink->rgb + (ptrdiff_t)y * ink->pitch + 3 * x, 3);
            to[3] = 255;
        }
    return FONT_OK;
}

static void put32(uint8_t *at, uint32_t value)
{
    for (int k = 0; k < 4; k++)
        at[k] = (uint8_t)(value >> (24 - 8 * k));
}

uint8_t *drawn_deflated(const uint8_t *bytes, size_t count, size_t *out_count)
{
    uLongf bound = compressBound((uLong)count);
    uint8_t *out = malloc(bound);
    if (out && compress2(out, &bound, bytes, (uLong)count, Z_BEST_COMPRESSION) != Z_OK) {
        free(out);
        out = NULL;
    }
    *out_count = bound;
    return out;
}

/* ---- PNG, as text ---- */

/* Bytes as Base64, three at a time. */
struct letters {
    FILE *f;
    uint8_t bytes[3];
    int count;
};

static void letters_flush(struct letters *l)
{
    static const char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t n = (uint32_t)l->bytes[0] << 16 | (uint32_t)l->bytes[1] << 8 | l->bytes[2];
    for (int k = 0; k < 4 && l->count; k++)
        fputc(k <= l->count ? digits[n >> (18 - 6 * k) & 63] : '=', l->f);
    memset(l->bytes, 0, sizeof l->bytes);
    l->count = 0;
}

static void letters_put(struct letters *l, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        l->bytes[l->count++] = bytes[i];
        if (l->count == 3)
            letters_flush(l);
    }
}

static void chunk_put(struct letters *l, const char name[5], const uint8_t *bytes, size_t count)
{
    uint8_t number[4];
    uLong sum = crc32(crc32(0, NULL, 0), (const Bytef *)name, 4);
    put32(number, (uint32_t)count);
    letters_put(l, number, 4);
    letters_put(l, (const uint8_t *)name, 4);
    letters_put(l, bytes, count);
    put32(number, (uint32_t)(count ? crc32(sum, bytes, (uInt)count) : sum));
    letters_put(l, number, 4);
}

enum font_status drawn_png(const struct font_tile *tile, FILE *f)
{
    static const uint8_t begin[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    uint8_t header[13] = {0};
    size_t row = 4 * (size_t)tile->width_px, rows = (size_t)tile->height_px, count = 0;
    uint8_t *raw = malloc((row + 1) * rows), *packed = NULL;
    for (size_t y = 0; raw && y < rows; y++) {
        raw[y * (row + 1)] = 0; /* no filter */
        memcpy(raw + y * (row + 1) + 1, tile->rgba + y * row, row);
    }
    if (raw)
        packed = drawn_deflated(raw, (row + 1) * rows, &count);
    free(raw);
    if (!packed)
        return font_fail(FONT_NO_MEMORY, "no memory for a drawing");
    put32(header, (uint32_t)tile->width_px);
    put32(header + 4, (uint32_t)tile->height_px);
    header[8] = 8; /* bits */
    header[9] = 6; /* colours and cover */
    struct letters l = {.f = f};
    letters_put(&l, begin, sizeof begin);
    chunk_put(&l, "IHDR", header, sizeof header);
    chunk_put(&l, "IDAT", packed, count);
    chunk_put(&l, "IEND", NULL, 0);
    letters_flush(&l);
    free(packed);
    return FONT_OK;
}
