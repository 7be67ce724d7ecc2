/* pdf_program.c - fonts cut down to the glyphs that are used, by HarfBuzz's subsetter: see
 * pdf_internal.h.
 *
 * Only the tables that PDF asks for are left, and no hints: outlines are drawn as they are
 * everywhere in the pipeline. Axes are pinned to where they are set. What comes out is looked
 * at again: each glyph must have the box and the advance that it had. */
#include "face_internal.h"
#include "pdf_internal.h"

#include <library.h>

#include <hb-ot.h>
#include <hb-subset.h>

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* The subsetter, loaded when the first font is cut: most programs cut none. */
/* clang-format off */
#define SUBSET_NAMES(X)                                                                        \
    X(input_create_or_fail) X(input_destroy) X(input_glyph_set) X(input_pin_axis_location)     \
    X(input_set) X(input_set_flags) X(plan_create_or_fail) X(plan_destroy)                     \
    X(plan_execute_or_fail) X(plan_old_to_new_glyph_mapping)
/* clang-format on */
#define SUBSET_MEMBER(name) __typeof__(hb_subset_##name) *name;
#define SUBSET_ROW(name) {"hb_subset_" #name, offsetof(struct subset_library, name)},
static struct subset_library {
    SUBSET_NAMES(SUBSET_MEMBER)
} subset;
static bool subset_loaded;

static void subset_load(void)
{
    static const struct library_function functions[] = {SUBSET_NAMES(SUBSET_ROW)};
    const char *missing;
    subset_loaded = library_load("libharfbuzz-subset.so.0", functions,
                                 sizeof functions / sizeof *functions, &subset, &missing);
}

static bool subset_there(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, subset_load);
    return subset_loaded;
}

/* What is cut, or is needed to pin axes. */
static bool is_cut(hb_tag_t tag)
{
    static const char kept[][5] = {"head", "hhea", "hmtx", "maxp", "loca", "glyf", "CFF ",
                                   "fvar", "gvar", "avar", "HVAR", "MVAR", "OS/2", "cvar"};
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++)
        if (tag == HB_TAG(kept[i][0], kept[i][1], kept[i][2], kept[i][3]))
            return true;
    return false;
}

static bool has_table(hb_face_t *face, hb_tag_t tag)
{
    hb_blob_t *blob = hb_face_reference_table(face, tag);
    bool there = hb_blob_get_length(blob) > 0;
    hb_blob_destroy(blob);
    return there;
}

static void tables_drop(hb_face_t *face, hb_set_t *dropped)
{
    enum { MANY = 64 };
    hb_tag_t tags[MANY];
    unsigned begin = 0, count = MANY;
    while (hb_face_get_table_tags(face, begin, &count, tags), count) {
        for (unsigned i = 0; i < count; i++)
            if (!is_cut(tags[i]))
                hb_set_add(dropped, tags[i]);
        begin += count;
        count = MANY;
    }
}

static hb_subset_input_t *input_make(const struct font_document *p, const struct pdf_font *font,
                                     hb_face_t *face)
{
    hb_subset_input_t *input = subset.input_create_or_fail();
    if (!input)
        return NULL;
    hb_set_t *glyphs = subset.input_glyph_set(input);
    for (int i = 0; i < font->count; i++)
        hb_set_add(glyphs, p->letters[font->letters[i]].glyph);
    tables_drop(face, subset.input_set(input, HB_SUBSET_SETS_DROP_TABLE_TAG));
    subset.input_set_flags(input, HB_SUBSET_FLAGS_NO_HINTING);
    const struct font_face *of = font->face;
    bool good = true;
    for (int i = 0; i < of->axes_count; i++)
        good =
            good && subset.input_pin_axis_location(input, face, (hb_tag_t)of->axes->axis[i].tag,
                                                   (float)((double)of->values[i] / 65536));
    if (good)
        return input;
    subset.input_destroy(input);
    return NULL;
}

/* Whether glyph `cut` of the font that was cut is a glyph of the font: its box and its advance,
 * to a unit or two, which rounding takes. */
static bool is_same(hb_font_t *of, hb_codepoint_t glyph, hb_font_t *cut_of, hb_codepoint_t cut)
{
    enum { NEAR = 2 };
    hb_glyph_extents_t a = {0, 0, 0, 0}, b = {0, 0, 0, 0};
    (void)hb_font_get_glyph_extents(of, glyph, &a);
    (void)hb_font_get_glyph_extents(cut_of, cut, &b);
    return abs(a.x_bearing - b.x_bearing) <= NEAR && abs(a.y_bearing - b.y_bearing) <= NEAR &&
           abs(a.width - b.width) <= NEAR && abs(a.height - b.height) <= NEAR &&
           abs(hb_font_get_glyph_h_advance(of, glyph) -
               hb_font_get_glyph_h_advance(cut_of, cut)) <= NEAR;
}

/* The table as bytes of our own. */
static bool table_take(hb_face_t *face, hb_tag_t tag, struct pdf_program *out)
{
    hb_blob_t *blob = hb_face_reference_table(face, tag);
    unsigned count;
    const char *bytes = hb_blob_get_data(blob, &count);
    out->bytes = count ? malloc(count) : NULL;
    out->count = count;
    if (out->bytes)
        memcpy(out->bytes, bytes, count);
    hb_blob_destroy(blob);
    return out->bytes != NULL;
}

/* A TrueType file of what PDF asks for. */
static bool truetype_take(hb_face_t *face, struct pdf_program *out)
{
    static const char tags[][5] = {"head", "hhea", "hmtx", "maxp", "loca", "glyf"};
    hb_face_t *builder = hb_face_builder_create();
    bool good = true;
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        hb_tag_t tag = HB_TAG(tags[i][0], tags[i][1], tags[i][2], tags[i][3]);
        hb_blob_t *blob = hb_face_reference_table(face, tag);
        good = good && (i == 5 || hb_blob_get_length(blob)) &&
               hb_face_builder_add_table(builder, tag, blob);
        hb_blob_destroy(blob);
    }
    hb_blob_t *whole = hb_face_reference_blob(builder);
    unsigned count;
    const char *bytes = hb_blob_get_data(whole, &count);
    out->truetype = true;
    out->bytes = good && count ? malloc(count) : NULL;
    out->count = count;
    if (out->bytes)
        memcpy(out->bytes, bytes, count);
    hb_blob_destroy(whole);
    hb_face_destroy(builder);
    return out->bytes != NULL;
}

/* The glyphs of letters in the font that was cut. */
static bool glyphs_take(const struct font_document *p, const struct pdf_font *font,
                        const hb_subset_plan_t *plan, hb_face_t *cut, struct pdf_program *out)
{
    const hb_map_t *map = subset.plan_old_to_new_glyph_mapping(plan);
    hb_font_t *of = hb_font_create(font_face_harfbuzz(font->face)),
              *cut_of = hb_font_create(cut);
    bool good = true;
    font_face_harfbuzz_variations(font->face, of);
    out->glyphs = calloc((size_t)font->count + 1, sizeof *out->glyphs);
    for (int i = 0; out->glyphs && good && i < font->count; i++) {
        hb_codepoint_t glyph = p->letters[font->letters[i]].glyph, at = hb_map_get(map, glyph);
        out->glyphs[i] = at;
        good = at < 0xffff && is_same(of, glyph, cut_of, at);
    }
    hb_font_destroy(cut_of);
    hb_font_destroy(of);
    return good && out->glyphs;
}

/* Whether all of it is in the font's file as it is drawn. */
static bool is_own(const struct font_document *p, const struct pdf_font *font)
{
    for (int i = 0; i < font->count; i++)
        if (font_face_is_replaced(font->face, p->letters[font->letters[i]].glyph))
            return false;
    return true;
}

/* Of a CFF that was cut a glyph has one width, whatever its codes. */
static bool has_parts(const struct font_document *p, const struct pdf_font *font)
{
    for (int i = 0; i < font->count; i++)
        if (p->letters[font->letters[i]].parts > 1)
            return true;
    return false;
}

bool pdf_program_subset(const struct font_document *p, const struct pdf_font *font,
                        struct pdf_program *out)
{
    hb_face_t *face = font_face_harfbuzz(font->face), *cut = NULL;
    bool truetype = has_table(face, HB_TAG('g', 'l', 'y', 'f'));
    *out = (struct pdf_program){0};
    if (!subset_there() || font->version != font_face_version(font->face) || !is_own(p, font) ||
        (!truetype && (has_parts(p, font) || !has_table(face, HB_TAG('C', 'F', 'F', ' ')))))
        return false;
    hb_subset_input_t *input = input_make(p, font, face);
    hb_subset_plan_t *plan = input ? subset.plan_create_or_fail(face, input) : NULL;
    if (plan)
        cut = subset.plan_execute_or_fail(plan);
    bool good = cut && glyphs_take(p, font, plan, cut, out) &&
                (truetype ? truetype_take(cut, out)
                          : table_take(cut, HB_TAG('C', 'F', 'F', ' '), out) &&
                                !pdf_cff_keyed(out->bytes, out->count));
    hb_face_destroy(cut);
    if (plan)
        subset.plan_destroy(plan);
    subset.input_destroy(input);
    if (!good)
        pdf_program_finish(out);
    return good;
}
