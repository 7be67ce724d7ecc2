/* support.h - functions that the pipeline's tests share. Include after cmocka's headers. */
#ifndef LUTETIA_TESTS_FONTPIPE_SUPPORT_H
#define LUTETIA_TESTS_FONTPIPE_SUPPORT_H

#include <face.h>
#include <filter.h>
#include <text.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <stdio.h>

/* URW's Type 1 files are opened by their paths: newer fontconfigs leave Type 1 fonts out. */
#define TYPE_1_FOLDER "/usr/share/fonts/type1/urw-base35/"
#define TYPE_1_FONT TYPE_1_FOLDER "NimbusSans-Regular.t1"

/* Fails the test with font_error(). */
#define assert_font(call)                                                                      \
    do {                                                                                       \
        if ((call) != FONT_OK)                                                                 \
            fail_msg("%s: %s", #call, font_error());                                           \
    } while (0)

static inline struct font_face *face_open(const char *name)
{
    struct font_face *face;
    assert_font(font_face_open(name, 0, &face));
    return face;
}

static inline struct font_shaper *shaper_make(struct font_face *face)
{
    struct font_shaper *shaper;
    assert_font(font_shaper_create(face, &shaper));
    return shaper;
}

static inline struct font_filter *filter_make(const char *name)
{
    struct font_filter *filter;
    assert_font(font_filter_create_named(name, &filter));
    return filter;
}

/* The place of the pen after the glyph's advance. */
static inline double glyph_end(const struct font_placed *g)
{
    struct font_face_info info;
    double advance;
    font_face_describe(g->face, &info);
    assert_font(font_face_advance(g->face, g->glyph, &advance));
    return g->x_px + advance * (double)g->size_px / info.units_per_em;
}

static inline uint32_t random_next(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static inline double random_unit(uint32_t *state)
{
    return (random_next(state) >> 8) / 16777216.0;
}

static inline uint32_t random_below(uint32_t *seed, size_t bound)
{
    return (uint32_t)(random_unit(seed) * (double)bound);
}

#endif
