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

/* Whose it is, in which setting of the axes (0: any), and for which sizes; of gray both are its
 * own. */
struct key {
    uint32_t glyph;
    int setting;
    double from_px, to_px;
};

struct own_filter {
    struct key key;
    const struct font_filter *filter;
};

struct own_gray {
    struct key key;
    struct font_gray gray;
};

/* Items that begin with their key, in the order of glyphs, and of one glyph as they came. */
struct items {
    char *at;
    size_t size; /* of one */
    int count, capacity;
};

struct font_own {
    struct table tables[FONT_OWN_FILTERS_MAX];
    int tables_count;
    struct items filters, grays;
};

/* ---- items ---- */

static void *item_at(const struct items *items, int i)
{
    return items->at + (size_t)i * items->size;
}

static uint32_t glyph_at(const struct items *items, int i)
{
    return ((const struct key *)item_at(items, i))->glyph;
}

/* The first of the glyph's, or where one would be. */
static int first_of(const struct items *items, uint32_t glyph)
{
    int from = 0, to = items->count;
    while (from < to) {
        int middle = from + (to - from) / 2;
        if (glyph_at(items, middle) < glyph)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

/* The first of the glyph's in a setting that is for the size; NULL: none. */
static void *item_find(const struct items *items, uint32_t glyph, int setting, double size_px)
{
    for (int i = first_of(items, glyph); i < items->count && glyph_at(items, i) == glyph; i++) {
        const struct key *key = item_at(items, i);
        if (key->setting == setting && font_own_size_is(key->from_px, key->to_px, size_px))
            return item_at(items, i);
    }
    return NULL;
}

/* What is used for the glyph, as the axes are set now; NULL: nothing. */
static void *item_choose(const struct font_face *face, const struct items *items,
                         uint32_t glyph, double size_px)
{
    void *found = NULL;
    for (int i = 0; items->count && i < FONT_OWN_PLACES && !found; i++) {
        const struct font_own_place place = font_own_place(glyph, i);
        found = item_find(items, place.glyph, place.here ? face->own_setting : 0, size_px);
    }
    return found;
}

/* Puts it behind the others of its glyph. False: no memory. */
static bool item_add(struct items *items, const void *item)
{
    const uint32_t glyph = ((const struct key *)item)->glyph;
    int i = first_of(items, glyph);
    if (!array_reserve(&items->at, &items->capacity, items->count + 1, items->size))
        return false;
    while (i < items->count && glyph_at(items, i) == glyph)
        i++;
    memmove(item_at(items, i + 1), item_at(items, i), (size_t)(items->count - i) * items->size);
    memcpy(item_at(items, i), item, items->size);
    items->count++;
    return true;
}

struct font_own_place font_own_place(uint32_t glyph, int i)
{
    return (struct font_own_place){i < 2 ? glyph : FONT_EVERY_GLYPH, i % 2 == 0};
}

bool font_own_size_is(double from_px, double to_px, double size_px)
{
    return from_px == to_px ? fabs(from_px - size_px) <= 1e-6 * size_px
                            : size_px >= from_px && size_px < to_px;
}

/* ---- a face's own ---- */

void font_own_finish(struct font_face *face)
{
    struct font_own *own = face->own;
    if (!own)
        return;
    for (int i = 0; i < own->tables_count; i++) {
        font_filter_destroy(own->tables[i].filter);
        free(own->tables[i].words);
    }
    for (int i = 0; i < own->grays.count; i++)
        font_gray_finish(&((struct own_gray *)item_at(&own->grays, i))->gray);
    free(own->filters.at);
    free(own->grays.at);
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
    if (!face->own) {
        face->own = calloc(1, sizeof *face->own);
        if (face->own) {
            face->own->filters.size = sizeof(struct own_filter);
            face->own->grays.size = sizeof(struct own_gray);
        }
    }
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

enum font_status font_own_filter_set(struct font_face *face, uint32_t glyph, double from_px,
                                     double to_px, const char *filter, bool here)
{
    struct own_filter made = {{glyph, 0, from_px, to_px}, NULL};
    if (!(from_px >= 0 && to_px > from_px))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a filter is for sizes from least to most (got %g..%g)", from_px,
                         to_px);
    enum font_status status = begin(face, glyph, true, here, &made.key.setting);
    if (status == FONT_OK)
        status = table_find(face->own, filter, &made.filter);
    if (status == FONT_OK && !item_add(&face->own->filters, &made))
        status = font_fail(FONT_NO_MEMORY, "no memory for a filter");
    if (status == FONT_OK)
        font_face_version_renew(face);
    return status;
}

enum font_status font_own_gray_set(struct font_face *face, uint32_t glyph, double size_px,
                                   const struct font_gray *gray, bool here)
{
    struct own_gray made = {.key = {glyph, 0, size_px, size_px}};
    if (!(size_px >= 0.1 && size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, size_px);
    enum font_status status = begin(face, glyph, false, here, &made.key.setting);
    if (status == FONT_OK)
        status = font_gray_copy(gray, &made.gray);
    if (status != FONT_OK)
        return status;
    struct items *grays = &face->own->grays;
    struct own_gray *there = item_find(grays, glyph, made.key.setting, size_px);
    if (there) {
        font_gray_finish(&there->gray);
        *there = made;
    } else if (!item_add(grays, &made)) {
        font_gray_finish(&made.gray);
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    }
    font_face_version_renew(face);
    return FONT_OK;
}

const struct font_filter *font_own_filter(const struct font_face *face, uint32_t glyph,
                                          double size_px)
{
    const struct own_filter *f =
        face->own ? item_choose(face, &face->own->filters, glyph, size_px) : NULL;
    return f ? f->filter : NULL;
}

const struct font_gray *font_own_gray(const struct font_face *face, uint32_t glyph,
                                      double size_px)
{
    const struct own_gray *g =
        face->own ? item_choose(face, &face->own->grays, glyph, size_px) : NULL;
    return g ? &g->gray : NULL;
}
