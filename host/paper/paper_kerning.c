/* paper_kerning.c - pair kerning from GPOS.
 *
 * FreeType reads the old `kern` table only, and OpenType fonts with PostScript outlines have none.  What is
 * needed of GPOS for a line of type is small (OpenType 1.9, "GPOS", lookup type 2):
 *
 *     header -> FeatureList -> every feature `kern` -> its lookups
 *     lookup type 2 (pairs), or 9 (a pointer to one) -> subtables
 *       format 1: coverage of left glyphs -> a sorted list of (right glyph, values) for each
 *       format 2: class of left x class of right -> values
 *     in a lookup the first subtable that covers the pair decides; lookups add up
 *
 * Of the values only the left glyph's advance along x is used.  Scripts and languages are not told apart: all
 * `kern` features of a text font name the same lookups, and each lookup is taken once.
 *
 * Every read is checked against the table's length: a font file is not to be trusted. */
#include "paper_kerning.h"

#include FT_TRUETYPE_TABLES_H
#include FT_TRUETYPE_TAGS_H
#include <stdbool.h>
#include <stdlib.h>

enum { VALUE_X_ADVANCE = 4, LOOKUP_PAIR = 2, LOOKUP_EXTENSION = 9, LOOKUPS_MAX = 64 };

void paper_kerning_create(struct paper_kerning *k, FT_Face face)
{
    *k = (struct paper_kerning){0};
    FT_ULong bytes = 0;
    if (FT_Load_Sfnt_Table(face, TTAG_GPOS, 0, NULL, &bytes) != 0 || bytes == 0 ||
        bytes > (1u << 26))
        return;
    uint8_t *table = malloc(bytes);
    if (table && FT_Load_Sfnt_Table(face, TTAG_GPOS, 0, table, &bytes) == 0) {
        k->gpos = table;
        k->bytes = bytes;
    } else {
        free(table);
    }
}

void paper_kerning_destroy(struct paper_kerning *k)
{
    free(k->gpos);
    *k = (struct paper_kerning){0};
}

/* Big-endian; 0 beyond the table's end, which ends every search below. */
static unsigned u16(const struct paper_kerning *k, size_t at)
{
    return at + 2 <= k->bytes ? (unsigned)(k->gpos[at] << 8 | k->gpos[at + 1]) : 0;
}

static size_t u32(const struct paper_kerning *k, size_t at)
{
    return (size_t)u16(k, at) << 16 | u16(k, at + 2);
}

static int s16(const struct paper_kerning *k, size_t at)
{
    return (int16_t)u16(k, at);
}

/* The glyph's place in a coverage table, or -1. */
static int coverage_index(const struct paper_kerning *k, size_t at, unsigned glyph)
{
    unsigned format = u16(k, at), count = u16(k, at + 2);
    for (unsigned i = 0; format == 1 && i < count; i++)
        if (u16(k, at + 4 + 2 * i) == glyph)
            return (int)i;
    for (unsigned i = 0; format == 2 && i < count; i++) {
        size_t range = at + 4 + 6 * (size_t)i;
        if (glyph >= u16(k, range) && glyph <= u16(k, range + 2))
            return (int)(u16(k, range + 4) + glyph - u16(k, range));
    }
    return -1;
}

static unsigned glyph_class(const struct paper_kerning *k, size_t at, unsigned glyph)
{
    unsigned format = u16(k, at);
    if (format == 1) {
        unsigned first = u16(k, at + 2), count = u16(k, at + 4);
        return glyph >= first && glyph - first < count ? u16(k, at + 6 + 2 * (glyph - first))
                                                       : 0;
    }
    unsigned count = u16(k, at + 2);
    for (unsigned i = 0; format == 2 && i < count; i++) {
        size_t range = at + 4 + 6 * (size_t)i;
        if (glyph >= u16(k, range) && glyph <= u16(k, range + 2))
            return u16(k, range + 4);
    }
    return 0;
}

static size_t value_bytes(unsigned format)
{
    return 2 * (size_t)__builtin_popcount(format & 0xffu);
}

/* A value record holds only the values that its format names, in the order of the bits. */
static int value_x_advance(const struct paper_kerning *k, size_t at, unsigned format)
{
    if (!(format & VALUE_X_ADVANCE))
        return 0;
    return s16(k, at + value_bytes(format & (VALUE_X_ADVANCE - 1)));
}

/* True where the subtable decides about the pair, with the amount in *kern. */
static bool pair_subtable(const struct paper_kerning *k, size_t at, unsigned left,
                          unsigned right, int *kern)
{
    int covered = coverage_index(k, at + u16(k, at + 2), left);
    if (covered < 0)
        return false;
    unsigned format1 = u16(k, at + 4), format2 = u16(k, at + 6);
    size_t record = value_bytes(format1) + value_bytes(format2);
    if (u16(k, at) == 1) {
        size_t set = at + u16(k, at + 10 + 2 * (size_t)covered);
        unsigned count = u16(k, set);
        for (unsigned i = 0; i < count; i++) {
            size_t pair = set + 2 + i * (2 + record);
            if (u16(k, pair) == right) {
                *kern = value_x_advance(k, pair + 2, format1);
                return true;
            }
        }
        return false;
    }
    if (u16(k, at) != 2)
        return false;
    unsigned class1 = glyph_class(k, at + u16(k, at + 8), left);
    unsigned class2 = glyph_class(k, at + u16(k, at + 10), right);
    unsigned count1 = u16(k, at + 12), count2 = u16(k, at + 14);
    if (class1 >= count1 || class2 >= count2)
        return false;
    *kern = value_x_advance(k, at + 16 + (class1 * (size_t)count2 + class2) * record, format1);
    return true;
}

static int lookup_kern(const struct paper_kerning *k, size_t lookup, unsigned left,
                       unsigned right)
{
    unsigned type = u16(k, lookup), count = u16(k, lookup + 4);
    for (unsigned i = 0; i < count; i++) {
        size_t subtable = lookup + u16(k, lookup + 6 + 2 * (size_t)i);
        unsigned actual = type;
        if (type == LOOKUP_EXTENSION) {
            actual = u16(k, subtable + 2);
            subtable += u32(k, subtable + 4);
        }
        int kern;
        if (actual == LOOKUP_PAIR && pair_subtable(k, subtable, left, right, &kern))
            return kern;
    }
    return 0;
}

int paper_kerning_between(const struct paper_kerning *k, unsigned left, unsigned right)
{
    if (!k->gpos)
        return 0;
    size_t features = u16(k, 6), lookups = u16(k, 8);
    unsigned feature_count = u16(k, features), lookup_count = u16(k, lookups);
    unsigned seen[LOOKUPS_MAX], seen_count = 0;
    int kern = 0;
    for (unsigned f = 0; f < feature_count; f++) {
        size_t record = features + 2 + 6 * (size_t)f;
        if (u32(k, record) != FT_MAKE_TAG('k', 'e', 'r', 'n'))
            continue;
        size_t feature = features + u16(k, record + 4);
        unsigned count = u16(k, feature + 2);
        for (unsigned i = 0; i < count; i++) {
            unsigned number = u16(k, feature + 4 + 2 * (size_t)i), before = 0;
            while (before < seen_count && seen[before] != number)
                before++;
            if (before < seen_count || seen_count == LOOKUPS_MAX || number >= lookup_count)
                continue;
            seen[seen_count++] = number;
            kern +=
                lookup_kern(k, lookups + u16(k, lookups + 2 + 2 * (size_t)number), left, right);
        }
    }
    return kern;
}
