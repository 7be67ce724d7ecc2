/* drawing.c - outlines as paths, and which glyphs there are: see drawing_internal.h. */
#include "colour.h"
#include "drawing_internal.h"

#include <math.h>
#include <stdlib.h>

void drawn_finish(struct drawn *d)
{
    free(d->glyphs);
    free(d->of);
    free(d->texts);
    font_painter_destroy(d->painter);
    *d = (struct drawn){0};
}

static int clusters_compare(const void *a, const void *b)
{
    size_t p = *(const size_t *)a, q = *(const size_t *)b;
    return (p > q) - (p < q);
}

/* A cluster's text goes up to the next cluster that stands anywhere: in lines that go to the
 * left, and where letters change places, that is none of its neighbours. */
static bool texts_find(const struct font_drawing *d, const struct font_layout *layout,
                       struct drawn *out)
{
    const struct font_placed *g = layout->glyphs;
    int n = layout->glyphs_count;
    size_t *clusters = malloc(((size_t)n + 1) * sizeof *clusters);
    out->texts = calloc((size_t)n + 1, sizeof *out->texts);
    for (int i = 0; clusters && i < n; i++)
        clusters[i] = (size_t)g[i].cluster;
    if (clusters)
        qsort(clusters, (size_t)n, sizeof *clusters, clusters_compare);
    for (int i = 0; clusters && out->texts && i < n; i++) {
        struct drawn_text *t = &out->texts[i];
        size_t begin = (size_t)g[i].cluster, end = d->bytes;
        int low = 0, high = n; /* the first that is behind it, by halves */
        while (low < high) {
            int half = (low + high) / 2;
            if (clusters[half] > begin)
                high = half;
            else
                low = half + 1;
        }
        if (low < n && clusters[low] < end)
            end = clusters[low];
        t->begins = i == 0 || g[i - 1].line != g[i].line || g[i - 1].cluster != g[i].cluster;
        t->ends = i + 1 == n || g[i + 1].line != g[i].line || g[i + 1].cluster != g[i].cluster;
        t->line_ends = i + 1 == n || g[i + 1].line != g[i].line;
        if (!d->text || begin >= d->bytes)
            continue;
        /* White space at a line's end is not seen, and belongs to no letter. */
        while (end > begin && (d->text[end - 1] == '\n' || d->text[end - 1] == '\r'))
            end--;
        while (end > begin + 1 && d->text[end - 1] == ' ')
            end--;
        t->begin = begin;
        t->end = end;
    }
    bool good = clusters && out->texts;
    for (int i = 0, first = 0; good && i < n; i++) {
        first = out->texts[i].begins ? i : first;
        for (int k = first; out->texts[i].ends && k <= i; k++) {
            out->texts[k].at = k - first;
            out->texts[k].of = i - first + 1;
        }
    }
    free(clusters);
    return good;
}

enum font_status drawn_find(const struct font_drawing *d, const struct font_layout *layout,
                            struct drawn *out)
{
    enum { BUCKETS = 1024 };
    int heads[BUCKETS], *next = malloc(((size_t)layout->glyphs_count + 1) * sizeof *next);
    *out = (struct drawn){0};
    out->of = malloc(((size_t)layout->glyphs_count + 1) * sizeof *out->of);
    bool good = next && out->of;
    for (int i = 0; i < BUCKETS; i++)
        heads[i] = -1;
    for (int i = 0; good && i < layout->glyphs_count; i++) {
        const struct font_placed *g = &layout->glyphs[i];
        uint64_t key[2] = {font_face_version(g->face), g->glyph};
        uint32_t bucket = font_hash(key, sizeof key) % BUCKETS;
        int k = heads[bucket];
        while (k >= 0 && (out->glyphs[k].face != g->face || out->glyphs[k].glyph != g->glyph))
            k = next[k];
        if (k < 0) {
            k = out->count;
            good = array_reserve(&out->glyphs, &out->capacity, k + 1, sizeof *out->glyphs);
            if (!good)
                break;
            out->glyphs[out->count++] = (struct drawn_glyph){
                .face = g->face, .glyph = g->glyph, .picture = font_painter_is_picture(g)};
            next[k] = heads[bucket];
            heads[bucket] = k;
        }
        out->of[i] = k;
    }
    free(next);
    if (good && texts_find(d, layout, out))
        return FONT_OK;
    drawn_finish(out);
    return font_fail(FONT_NO_MEMORY, "no memory for a drawing");
}

enum font_status drawn_map(const struct font_layout *layout, int i, const struct font_map *map,
                           double x_px, double y_px, struct font_map *out)
{
    const struct font_placed *g = &layout->glyphs[i];
    struct font_face_info info;
    struct font_map pixels;
    double x, y;
    font_face_describe(g->face, &info);
    struct font_map own = font_map_size(font_placed_size(layout, g), info.units_per_em);
    enum font_status status = font_placed_map(layout, i, map, x_px, y_px, &pixels, &x, &y);
    if (status == FONT_OK)
        status = font_map_compose(&own, &pixels, out);
    const struct font_map move = {FONT_AFFINE, {1, 0, x, 0, 1, y}};
    if (status == FONT_OK)
        *out = font_map_then(*out, move);
    return status;
}

const struct font_ink *drawn_ink(const struct font_drawing *d, const struct font_layout *layout,
                                 int i, struct font_ink *own)
{
    int number = layout->glyphs[i].ink;
    *own = font_ink_plain(d->ink[0], d->ink[1], d->ink[2], 1);
    return number > 0 ? &layout->inks[number - 1] : own;
}

enum font_status drawn_inks_check(const struct font_layout *layout)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < layout->inks_count && status == FONT_OK; i++)
        status = font_ink_check(&layout->inks[i]);
    return status;
}

bool drawn_flat(const struct font_ink *ink, double rgba[4])
{
    float anywhere[4];
    bool flat = ink->kind == FONT_INK_PLAIN ||
                (ink->kind == FONT_INK_LINEAR && ink->x0 == ink->x1 && ink->y0 == ink->y1) ||
                (ink->kind == FONT_INK_RADIAL && !(ink->x1 > 0)) ||
                (ink->kind != FONT_INK_PICTURE && ink->stops_count == 1);
    if (flat) {
        font_ink_at(ink, 0, 0, anywhere);
        for (int c = 0; c < 4; c++)
            rgba[c] = (double)anywhere[c];
    }
    return flat;
}

/* ---- paths ---- */

static bool point_of(const struct font_map *map, struct font_point p, struct font_point *out)
{
    double jacobian[4];
    *out = p;
    return !map || font_map_point(map, p, out, jacobian);
}

static void point_put(FILE *f, bool pdf, const char *before, struct font_point p)
{
    if (pdf) /* which has no exponents */
        fprintf(f, "%s%.7g %.7g", before, fabs(p.x) < 1e-4 ? 0 : p.x,
                fabs(p.y) < 1e-4 ? 0 : p.y);
    else
        fprintf(f, "%s%.7g,%.7g", before, p.x, p.y);
}

/* One curve, from where the pen is. A curve of degree 2 is one of degree 3 in PDF. */
static bool curve_put(const struct font_segment *s, const struct font_map *map, bool pdf,
                      FILE *f)
{
    struct font_point p[4];
    for (int i = 0; i <= s->degree; i++)
        if (!point_of(map, s->p[i], &p[i]))
            return false;
    if (s->degree == 1) {
        point_put(f, pdf, pdf ? "" : "L", p[1]);
        fputs(pdf ? " l\n" : "", f);
    } else if (s->degree == 2 && !pdf) {
        point_put(f, pdf, "Q", p[1]);
        point_put(f, pdf, " ", p[2]);
    } else {
        struct font_point a = p[1], b = p[2];
        if (s->degree == 2) {
            a = (struct font_point){p[0].x + (p[1].x - p[0].x) * 2 / 3,
                                    p[0].y + (p[1].y - p[0].y) * 2 / 3};
            b = (struct font_point){p[2].x + (p[1].x - p[2].x) * 2 / 3,
                                    p[2].y + (p[1].y - p[2].y) * 2 / 3};
        }
        point_put(f, pdf, pdf ? "" : "C", a);
        point_put(f, pdf, " ", b);
        point_put(f, pdf, " ", p[s->degree]);
        fputs(pdf ? " c\n" : "", f);
    }
    return true;
}

enum font_status drawn_path(const struct font_outline *o, const struct font_map *map, bool pdf,
                            FILE *f)
{
    enum { PIECES = 16 }; /* of a curve that is distorted: it is none of its kind any more */
    bool distorted = map && map->kind != FONT_AFFINE;
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        bool begins = i == 0 || s[-1].contour != s->contour;
        bool ends = i + 1 == o->segments_count || s[1].contour != s->contour;
        struct font_point start;
        bool good = point_of(map, s->p[0], &start);
        if (good && begins) {
            point_put(f, pdf, pdf ? "" : "M", start);
            fputs(pdf ? " m\n" : "", f);
        }
        int pieces = distorted ? PIECES : 1;
        for (int k = 0; good && k < pieces; k++) {
            struct font_segment part =
                font_segment_part(s, (double)k / pieces, (double)(k + 1) / pieces);
            part.contour = s->contour;
            good = curve_put(&part, map, pdf, f);
        }
        if (!good)
            return font_fail(FONT_BAD_ARGUMENT,
                             "a distortion sends a letter beyond the horizon");
        if (ends)
            fputs(pdf ? "h\n" : "Z", f);
    }
    return FONT_OK;
}

enum font_status drawn_spread(const struct font_drawing *d, const struct font_layout *layout,
                              const struct font_map *map, double x, double y, FILE *file,
                              drawn_put *put)
{
    struct font_layout spread;
    enum font_status status = drawn_inks_check(layout);
    if (status == FONT_OK)
        status = font_colour_spread(layout, &spread);
    if (status != FONT_OK)
        return status;
    status = put(d, &spread, map, x, y, file);
    font_layout_finish(&spread);
    return status;
}

int drawn_run(const struct font_drawing_stroke *stroke, int i)
{
    const double alike = 0.05; /* of the width */
    const double width = stroke->points[i].width_px;
    int end = i + 1;
    while (end < stroke->points_count &&
           fabs(stroke->points[end].width_px - width) <= alike * width)
        end++;
    return end;
}
