/* fonts_contest.c - see fonts_contest.h. */
#include "fonts_contest.h"

#include <math.h>
#include <stdlib.h>

const char *const fonts_faces[FONTS_FACES] = {"DejaVuSans", "DejaVuSerif-Bold",
                                              "EBGaramond12-Italic", "NimbusSans-Regular.otf",
                                              "C059-Roman.otf"};

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

/* ---- ways ---- */

bool fonts_outline_draw(struct fonts_contest *c, int filter, int i)
{
    const struct font_filter *f = c->filters[filter];
    return (font_edges_build(&c->scratch, &c->outlines[i], &c->map, f) == FONT_OK &&
            font_gray_draw(&c->gray, &c->scratch, f, c->x[i], c->y[i]) == FONT_OK) ||
           font_wrong();
}

bool fonts_kept_draw(struct fonts_contest *c, int filter, int i)
{
    return font_gray_draw(&c->gray, &c->kept[filter][i], c->filters[filter], c->x[i],
                          c->y[i]) == FONT_OK ||
           font_wrong();
}

bool fonts_file_draw(struct fonts_contest *c, int filter, int i)
{
    const struct font_filter *f = c->filters[filter];
    struct font_outline outline;
    bool ok = font_face_outline(c->face, c->glyphs[i], &outline) == FONT_OK &&
              font_edges_build(&c->scratch, &outline, &c->map, f) == FONT_OK &&
              font_gray_draw(&c->gray, &c->scratch, f, c->x[i], c->y[i]) == FONT_OK;
    font_outline_finish(&outline);
    return ok || font_wrong();
}

bool fonts_freetype_draw(struct fonts_contest *c, int filter, int i)
{
    (void)filter;
    return peer_freetype_draw(c->freetype, c->glyphs[i], c->x[i], c->y[i], &c->picture) ||
           bench_fail("FreeType failed");
}

bool fonts_raster_draw(struct fonts_contest *c, int filter, int i)
{
    (void)filter;
    return peer_freetype_raster(c->freetype, i, &c->picture) || bench_fail("FreeType failed");
}

bool fonts_stb_draw(struct fonts_contest *c, int filter, int i)
{
    (void)filter;
    return peer_stb_draw(c->stb, c->glyphs[i], c->x[i], c->y[i], &c->picture) ||
           bench_fail("stb_truetype failed");
}

/* ---- faces, sizes, filters ---- */

static void face_finish(struct fonts_contest *c)
{
    for (int i = 0; i < FONTS_LETTERS; i++) {
        font_outline_finish(&c->outlines[i]);
        c->outlines[i] = (struct font_outline){0};
    }
    font_face_close(c->face);
    c->face = NULL;
}

bool fonts_contest_open(struct fonts_contest *c, const char *name)
{
    struct font_face_info info;
    face_finish(c);
    if (font_face_open(name, 0, &c->face) != FONT_OK)
        return font_wrong();
    font_face_describe(c->face, &info);
    c->units = info.units_per_em;
    for (int i = 0; i < FONTS_LETTERS; i++) {
        c->glyphs[i] = font_face_glyph(c->face, 33 + (uint32_t)i);
        c->x[i] = i * 7 % 16 / 16.0;
        c->y[i] = i * 5 % 16 / 16.0;
        if (font_face_outline(c->face, c->glyphs[i], &c->outlines[i]) != FONT_OK)
            return font_wrong();
    }
    return true;
}

bool fonts_contest_size(struct fonts_contest *c, double px)
{
    size_t bytes_count;
    const void *bytes = font_face_bytes(c->face, &bytes_count);
    c->map = font_map_size(px, c->units);
    peer_freetype_destroy(c->freetype);
    peer_stb_destroy(c->stb);
    c->freetype = peer_freetype_create(bytes, bytes_count, px);
    c->stb = peer_stb_create(bytes, px);
    if (!c->freetype || !c->stb)
        return bench_fail("FreeType or stb_truetype cannot read the font");
    for (int i = 0; i < FONTS_LETTERS; i++)
        if (!peer_freetype_keep(c->freetype, i, c->glyphs[i], c->x[i], c->y[i]))
            return bench_fail("FreeType failed");
    for (int f = 0; f < c->filters_count; f++)
        for (int i = 0; i < FONTS_LETTERS; i++)
            if (font_edges_build(&c->kept[f][i], &c->outlines[i], &c->map, c->filters[f]) !=
                FONT_OK)
                return font_wrong();
    return true;
}

bool fonts_contest_filter(struct fonts_contest *c, const char *name)
{
    if (c->filters_count == FONTS_FILTERS_MAX)
        return bench_fail("more than %d filters", FONTS_FILTERS_MAX);
    return font_filter_create_named(name, &c->filters[c->filters_count++]) == FONT_OK ||
           font_wrong();
}

void fonts_contest_destroy(struct fonts_contest *c)
{
    if (!c)
        return;
    face_finish(c);
    for (int f = 0; f < c->filters_count; f++) {
        for (int i = 0; i < FONTS_LETTERS; i++)
            font_edges_finish(&c->kept[f][i]);
        font_filter_destroy(c->filters[f]);
    }
    font_edges_finish(&c->scratch);
    font_gray_finish(&c->gray);
    peer_freetype_destroy(c->freetype);
    peer_stb_destroy(c->stb);
    free(c);
}

/* ---- the contest ---- */

static bool turn(struct fonts_contest *c, struct fonts_contender *k, int rounds,
                 double *seconds)
{
    double began_s = bench_thread_s();
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < FONTS_LETTERS; i++)
            if (!k->draw(c, k->filter, i))
                return false;
    *seconds = (bench_thread_s() - began_s) / rounds;
    return true;
}

bool fonts_contend(struct fonts_contest *c, struct fonts_contender *all, int count)
{
    int turns = bench_many(FONTS_TURNS, 1);
    for (int k = 0; k < count; k++) {
        double seconds;
        if (!turn(c, &all[k], 1, &seconds) || !turn(c, &all[k], 1, &seconds))
            return false;
        all[k].rounds = 1 + (int)fmin(20, 1e-3 / fmax(seconds, 1e-6));
    }
    for (int i = 0; i < turns; i++)
        for (int k = 0; k < count; k++)
            if (!turn(c, &all[k], all[k].rounds, &all[k].turns[i]))
                return false;
    for (int k = 0; k < count; k++)
        all[k].seconds = bench_sample_of(all[k].turns, turns);
    return true;
}
