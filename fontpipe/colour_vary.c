/* colour_vary.c - what a variable font's axes add to the numbers of its paints: OpenType's item
 * variation store. */
#include "colour_read.h"

#include <math.h>

enum { HEADER_INDEX_MAP = 26, HEADER_STORE = 30, AXIS = 6, REGIONS_MAX = 4096 };
static const uint32_t NOTHING = 0xffffffff;

/* How much of a region holds at the axes' settings. */
static double region_part(const struct font_colr *c, uint64_t regions, uint32_t region)
{
    uint32_t axes = font_colr_u(c, regions, 2);
    double part = 1;
    if (region >= font_colr_u(c, regions + 2, 2))
        return 0;
    for (uint32_t i = 0; i < axes && part > 0; i++) {
        uint64_t at = regions + 4 + ((uint64_t)region * axes + i) * AXIS;
        double start = font_colr_s(c, at, 2) / 16384.0,
               peak = font_colr_s(c, at + 2, 2) / 16384.0,
               end = font_colr_s(c, at + 4, 2) / 16384.0;
        double value = i < (uint32_t)c->axes_count ? c->axes[i] : 0;
        if (peak == 0 || start > peak || peak > end || (start < 0 && end > 0) || value == peak)
            continue;
        if (value <= start || value >= end)
            return 0;
        part *= value < peak ? (value - start) / (peak - start) : (end - value) / (end - peak);
    }
    return part;
}

/* Which row of which part of the store it is. */
static void row_find(const struct font_colr *c, uint32_t index, uint32_t *outer,
                     uint32_t *inner)
{
    uint64_t map = font_colr_u(c, HEADER_INDEX_MAP, 4);
    if (!map) {
        *outer = index >> 16;
        *inner = index & 0xffff;
        return;
    }
    bool large = font_colr_u(c, map, 1) == 1;
    uint32_t format = font_colr_u(c, map + 1, 1),
             count = font_colr_u(c, map + 2, large ? 4 : 2);
    int bytes = (int)(format >> 4 & 3) + 1, bits = (int)(format & 15) + 1;
    if (count && index >= count)
        index = count - 1;
    uint32_t entry =
        font_colr_u(c, map + (large ? 6 : 4) + (uint64_t)index * (unsigned)bytes, bytes);
    *outer = entry >> bits;
    *inner = entry & ((1u << bits) - 1);
}

double font_colr_delta(const struct font_colr *c, uint32_t base, uint32_t n)
{
    uint64_t store = font_colr_u(c, HEADER_STORE, 4);
    uint32_t outer, inner;
    if (base == NOTHING || base > NOTHING - n || !store || !c->axes_count)
        return 0;
    row_find(c, base + n, &outer, &inner);
    if (outer >= font_colr_u(c, store + 6, 2))
        return 0;
    uint64_t regions = store + font_colr_u(c, store + 2, 4),
             data = store + font_colr_u(c, store + 8 + 4 * (uint64_t)outer, 4);
    uint32_t words = font_colr_u(c, data + 2, 2), count = font_colr_u(c, data + 4, 2);
    int small = words & 0x8000 ? 2 : 1;
    words &= 0x7fff;
    if (inner >= font_colr_u(c, data, 2) || words > count || count > REGIONS_MAX)
        return 0;
    uint64_t row =
        data + 6 + 2 * (uint64_t)count + (uint64_t)inner * (words + count) * (unsigned)small;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        int bytes = i < words ? 2 * small : small;
        double part = region_part(c, regions, font_colr_u(c, data + 6 + 2 * (uint64_t)i, 2));
        sum += part > 0 ? part * font_colr_s(c, row, bytes) : 0;
        row += (unsigned)bytes;
    }
    return sum;
}
