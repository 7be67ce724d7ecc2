/* own.c - filters and gray that belong to a face: see own.h. */
#include "own.h"
#include "face_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Filters that were made, each once. */
struct table {
    char *words;
    struct font_filter *filter;
};

/* A glyph's, in the order of glyphs, and of one glyph as they came. */
struct own_filter {
    uint32_t glyph;
    int setting; /* 0: any */
    double from_px, to_px;
    const struct font_filter *filter;
};

struct own_gray {
    uint32_t glyph;
    int setting;
    double size_px;
    struct font_gray gray;
};

struct font_own {
    struct table tables[FONT_OWN_FILTERS_MAX];
    int tables_count;
    struct own_filter *filters;
    int filters_count, filters_capacity;
    struct own_gray *grays;
    int grays_count, grays_capacity;
};

void font_own_finish(struct font_face *face)
{
    struct font_own *own = face->own;
    if (!own)
        return;
    for (int i = 0; i < own->tables_count; i++) {
        font_filter_destroy(own->tables[i].filter);
        free(own->tables[i].words);
    }
    for (int i = 0; i < own->grays_count; i++)
        font_gray_finish(&own->grays[i].gray);
    free(own->filters);
    free(own->grays);
    free(own);
    face->own = NULL;
}

bool font_own_any(const struct font_face *face)
{
    return face->own != NULL;
}

static enum font_status begin(struct font_face *face, uint32_t glyph, bool every, bool here,
                              int *setting)
{
    *setting = here ? font_face_own_setting(face) : 0;
    if (glyph >= (uint32_t)face->ft->num_glyphs && !(every && glyph == FONT_EVERY_GLYPH))
        return font_fail(FONT_NO_GLYPH, "%s has no glyph %u", face->path, (unsigned)glyph);
    if (!face->own)
        face->own = calloc(1, sizeof *face->own);
    return face->own && (*setting || !here)
               ? FONT_OK
               : font_fail(FONT_NO_MEMORY, "no memory for a glyph");
}

/* The filter of these words, made once. */
static enum font_status table_find(struct font_own *own, const char *words,
                                   const struct font_filter **out)
{
    for (int i = 0; i < own->tables_count; i++)
        if (strcmp(own->tables[i].words, words) == 0) {
            *out = own->tables[i].filter;
            return FONT_OK;
        }
    if (own->tables_count == FONT_OWN_FILTERS_MAX)
        return font_fail(FONT_TOO_LARGE, "a font has at most %d filters of its own",
                         FONT_OWN_FILTERS_MAX);
    struct table t = {.words = strdup(words)};
    if (!t.words)
        return font_fail(FONT_NO_MEMORY, "no memory for a filter");
    enum font_status status = font_filter_create_named(words, &t.filter);
    if (status != FONT_OK) {
        free(t.words);
        return status;
    }
    own->tables[own->tables_count++] = t;
    *out = t.filter;
    return FONT_OK;
}

/* The first of the glyph's, or where one would be: the items begin with their glyph. */
static int first_of(const void *items, size_t size, int count, uint32_t glyph)
{
    int from = 0, to = count;
    while (from < to) {
        int middle = from + (to - from) / 2;
        uint32_t there;
        memcpy(&there, (const char *)items + (size_t)middle * size, sizeof there);
        if (there < glyph)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

enum font_status font_own_filter_set(struct font_face *face, uint32_t glyph, double from_px,
                                     double to_px, const char *filter, bool here)
{
    struct own_filter made = {.glyph = glyph, .from_px = from_px, .to_px = to_px};
    if (!(from_px >= 0 && to_px > from_px))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a filter is for sizes from least to most (got %g..%g)", from_px,
                         to_px);
    enum font_status status = begin(face, glyph, true, here, &made.setting);
    if (status == FONT_OK)
        status = table_find(face->own, filter, &made.filter);
    struct font_own *own = face->own;
    if (status == FONT_OK && !array_reserve(&own->filters, &own->filters_capacity,
                                            own->filters_count + 1, sizeof *own->filters))
        status = font_fail(FONT_NO_MEMORY, "no memory for a filter");
    if (status != FONT_OK)
        return status;
    int i = first_of(own->filters, sizeof *own->filters, own->filters_count, glyph);
    while (i < own->filters_count && own->filters[i].glyph == glyph)
        i++;
    memmove(&own->filters[i + 1], &own->filters[i],
            (size_t)(own->filters_count - i) * sizeof *own->filters);
    own->filters[i] = made;
    own->filters_count++;
    font_face_version_renew(face);
    return FONT_OK;
}

static struct own_gray *gray_at(const struct font_face *face, uint32_t glyph, int setting,
                                double size_px)
{
    struct font_own *own = face->own;
    for (int i = first_of(own->grays, sizeof *own->grays, own->grays_count, glyph);
         i < own->grays_count && own->grays[i].glyph == glyph; i++)
        if (own->grays[i].setting == setting &&
            fabs(own->grays[i].size_px - size_px) <= 1e-6 * size_px)
            return &own->grays[i];
    return NULL;
}

enum font_status font_own_gray_set(struct font_face *face, uint32_t glyph, double size_px,
                                   const struct font_gray *gray, bool here)
{
    struct own_gray made = {.glyph = glyph, .size_px = size_px};
    if (!(size_px >= 0.1 && size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, size_px);
    enum font_status status = begin(face, glyph, false, here, &made.setting);
    if (status == FONT_OK)
        status = font_gray_copy(gray, &made.gray);
    if (status != FONT_OK)
        return status;
    struct font_own *own = face->own;
    struct own_gray *there = gray_at(face, glyph, made.setting, size_px);
    if (there) {
        font_gray_finish(&there->gray);
        *there = made;
    } else if (!array_reserve(&own->grays, &own->grays_capacity, own->grays_count + 1,
                              sizeof *own->grays)) {
        font_gray_finish(&made.gray);
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    } else {
        int i = first_of(own->grays, sizeof *own->grays, own->grays_count, glyph);
        memmove(&own->grays[i + 1], &own->grays[i],
                (size_t)(own->grays_count - i) * sizeof *own->grays);
        own->grays[i] = made;
        own->grays_count++;
    }
    font_face_version_renew(face);
    return FONT_OK;
}

/* The glyph's first one for the size in a setting. */
static const struct font_filter *filter_at(const struct font_own *own, uint32_t glyph,
                                           int setting, double size_px)
{
    for (int i = first_of(own->filters, sizeof *own->filters, own->filters_count, glyph);
         i < own->filters_count && own->filters[i].glyph == glyph; i++)
        if (own->filters[i].setting == setting && size_px >= own->filters[i].from_px &&
            size_px < own->filters[i].to_px)
            return own->filters[i].filter;
    return NULL;
}

const struct font_filter *font_own_filter(const struct font_face *face, uint32_t glyph,
                                          double size_px)
{
    const uint32_t glyphs[] = {glyph, FONT_EVERY_GLYPH};
    const int settings[] = {face->own_setting, 0};
    if (!face->own || !face->own->filters_count)
        return NULL;
    for (int i = 0; i < 4; i++) {
        const struct font_filter *f =
            filter_at(face->own, glyphs[i / 2], settings[i % 2], size_px);
        if (f)
            return f;
    }
    return NULL;
}

const struct font_gray *font_own_gray(const struct font_face *face, uint32_t glyph,
                                      double size_px)
{
    if (!face->own || !face->own->grays_count)
        return NULL;
    const struct own_gray *g =
        face->own_setting ? gray_at(face, glyph, face->own_setting, size_px) : NULL;
    g = g ? g : gray_at(face, glyph, 0, size_px);
    return g ? &g->gray : NULL;
}
