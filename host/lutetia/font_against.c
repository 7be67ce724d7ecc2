/* font_against.c - `lutetia font BEFORE --against AFTER`: two versions of a font, each in lines
 * of type, both over each other, and the glyphs that are others. What only the first has is
 * red, what only the second has is blue. */
#include "font_verb.h"
#include "lutetia.h"
#include "type_common.h"

#include <own.h>
#include <visible_text.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEFT = 90, EDGE = 24, CELL = 64, SHOWN_MAX = 160, NAMES_MAX = 40 };
static const double sizes[] = {72, 36, 18};
enum { SIZES = sizeof sizes / sizeof *sizes };

struct against {
    const struct font_verb *v;
    struct font_face *faces[2];
    struct font_shaper *shapers[2];
    struct font_painter *painter;
    struct type_labels *labels;
    struct display_image image;
    double y, width;
    uint32_t (*changed)[2]; /* glyphs of both faces that are others */
    int changed_count, gone, come;
    bool starved; /* there was no memory here */
};

/* ---- glyphs ---- */

static bool outlines_same(const struct font_outline *a, const struct font_outline *b)
{
    double scale = a->units_per_em / b->units_per_em, near = 1e-6 * a->units_per_em;
    if (a->segments_count != b->segments_count || fabs(a->advance - b->advance * scale) > near)
        return false;
    for (int i = 0; i < a->segments_count; i++) {
        const struct font_segment *p = &a->segments[i], *q = &b->segments[i];
        if (p->degree != q->degree || p->contour != q->contour)
            return false;
        for (int k = 0; k <= p->degree; k++)
            if (fabs(p->p[k].x - q->p[k].x * scale) > near ||
                fabs(p->p[k].y - q->p[k].y * scale) > near)
                return false;
    }
    return true;
}

/* Whether a glyph is drawn as the other face's. What cannot be read is the same as what cannot
 * be read either. */
static bool glyph_same(struct font_face *const faces[2], const uint32_t glyphs[2])
{
    struct font_outline o[2] = {{0}, {0}};
    enum font_status status[2];
    for (int i = 0; i < 2; i++)
        status[i] = font_face_outline_raw(faces[i], glyphs[i], &o[i]);
    bool same = (status[0] == FONT_OK) == (status[1] == FONT_OK) &&
                (status[0] != FONT_OK || outlines_same(&o[0], &o[1]));
    for (int i = 0; i < 2; i++)
        font_outline_finish(&o[i]);
    return same;
}

/* The other face's glyph of that name; where names are numbers, that number. */
static bool glyph_find(struct font_face *from, uint32_t glyph, struct font_face *in,
                       uint32_t *found)
{
    char name[FONT_GLYPH_NAME_BYTES];
    font_face_glyph_name(from, glyph, name);
    return font_face_glyph_named(in, name, found) == FONT_OK;
}

static void name_print(struct font_face *face, uint32_t glyph, int *printed)
{
    char name[FONT_GLYPH_NAME_BYTES];
    if ((*printed)++ < NAMES_MAX)
        visible_print(" %s", font_face_glyph_name(face, glyph, name));
    else if (*printed == NAMES_MAX + 1)
        printf(" ..");
}

static enum font_status glyphs_compare(struct against *a)
{
    struct font_face_info info[2];
    for (int i = 0; i < 2; i++)
        font_face_describe(a->faces[i], &info[i]);
    a->changed = calloc((size_t)info[0].glyphs_count + 1, sizeof *a->changed);
    a->starved = !a->changed;
    if (!a->changed)
        return FONT_NO_MEMORY;
    int printed = 0;
    printf("changed:");
    for (uint32_t g = 0; g < (uint32_t)info[0].glyphs_count; g++) {
        uint32_t both[2] = {g, 0};
        if (!glyph_find(a->faces[0], g, a->faces[1], &both[1]) || glyph_same(a->faces, both))
            continue;
        memcpy(a->changed[a->changed_count++], both, sizeof both);
        name_print(a->faces[0], g, &printed);
    }
    printf(a->changed_count ? "\n" : " none\n");
    for (int way = 0; way < 2; way++) {
        int count = 0;
        printed = 0;
        printf(way ? "only after:" : "only before:");
        for (uint32_t g = 0; g < (uint32_t)info[way].glyphs_count; g++) {
            uint32_t other;
            if (glyph_find(a->faces[way], g, a->faces[1 - way], &other))
                continue;
            count++;
            name_print(a->faces[way], g, &printed);
        }
        printf(count ? "\n" : " none\n");
        *(way ? &a->come : &a->gone) = count;
    }
    printf("%d of %d glyphs changed, %d only before, %d only after\n", a->changed_count,
           info[0].glyphs_count, a->gone, a->come);
    return FONT_OK;
}

/* ---- pictures ---- */

/* Two layouts over each other: a pixel lacks green by either, red by the second, blue by the
 * first. */
static enum font_status both_draw(struct against *a, const struct font_layout layouts[2],
                                  double x, double y)
{
    size_t count = (size_t)a->image.width_px * (size_t)a->image.height_px;
    enum font_status status = FONT_OK;
    struct font_box box = {1, 1, -1, -1}, one;
    uint8_t *gray = NULL;
    for (int i = 0; i < 2 && status == FONT_OK; i++) {
        status = font_painter_measure(a->painter, &layouts[i], NULL, x, y, &one);
        if (status == FONT_OK && one.x1 > one.x0)
            box = box.x1 < box.x0
                      ? one
                      : (struct font_box){fmin(box.x0, one.x0), fmin(box.y0, one.y0),
                                          fmax(box.x1, one.x1), fmax(box.y1, one.y1)};
    }
    int x0 = (int)fmax(0, box.x0), y0 = (int)fmax(0, box.y0);
    int x1 = (int)fmin(a->image.width_px, box.x1), y1 = (int)fmin(a->image.height_px, box.y1);
    if (status != FONT_OK || x1 <= x0 || y1 <= y0)
        return status;
    size_t wide = (size_t)(x1 - x0), part = wide * (size_t)(y1 - y0);
    gray = part <= count ? calloc(2, part) : NULL;
    a->starved = !gray;
    if (!gray)
        return FONT_NO_MEMORY;
    for (int i = 0; i < 2 && status == FONT_OK; i++) {
        struct font_cover cover = {x1 - x0, y1 - y0, x1 - x0, gray + (size_t)i * part};
        status = font_painter_cover(a->painter, &layouts[i], NULL, x - x0, y - y0, &cover);
    }
    for (size_t i = 0; i < part && status == FONT_OK; i++) {
        uint8_t *to =
            a->image.pixels +
            3 * (((size_t)y0 + i / wide) * (size_t)a->image.width_px + (size_t)x0 + i % wide);
        const double before = gray[i] / 255.0, after = gray[part + i] / 255.0;
        const double light[3] = {1 - after, 1 - fmax(before, after), 1 - before};
        for (int c = 0; c < 3; c++)
            to[c] = (uint8_t)fmin(to[c], rint(255 * font_number(light[c], 0)));
    }
    free(gray);
    return status;
}

/* Before, after, and both, at a size; only how large it is, as long as there is no picture. */
static enum font_status size_set(struct against *a, double size_px)
{
    static const char usual[] = "Hamburgefonstiv 0123 &?";
    static const char *const heads[] = {"before", "after", "both"};
    const char *text = a->v->text ? a->v->text : usual;
    struct font_layout layouts[2] = {{0}, {0}};
    enum font_status status = FONT_OK;
    double up = 0, down = 0;
    for (int i = 0; i < 2 && status == FONT_OK; i++) {
        status =
            font_shaper_layout(a->shapers[i], text, strlen(text), size_px, NULL, &layouts[i]);
        up = fmax(up, layouts[i].ascent_px);
        down = fmax(down, layouts[i].descent_px);
        a->width = fmax(a->width, LEFT + layouts[i].width_px + EDGE);
    }
    for (int line = 0; line < 3 && status == FONT_OK; line++) {
        struct font_picture picture = type_picture(&a->image);
        const double base = ceil(a->y + up);
        if (a->image.pixels) {
            type_label(a->labels, &a->image, EDGE, base, "%s", heads[line]);
            status = line < 2 ? font_painter_layout(a->painter, &layouts[line], NULL, LEFT,
                                                    base, &picture)
                              : both_draw(a, layouts, LEFT, base);
        }
        a->y = base + ceil(down) + 6;
    }
    a->y += 10;
    for (int i = 0; i < 2; i++)
        font_layout_finish(&layouts[i]);
    return status;
}

/* The glyphs that are others, both over each other. */
static enum font_status changed_set(struct against *a)
{
    const double size_px = 40;
    int across = (int)fmax(1, (a->width - 2 * EDGE) / CELL);
    int shown = a->changed_count < SHOWN_MAX ? a->changed_count : SHOWN_MAX;
    enum font_status status = FONT_OK;
    for (int i = 0; i < shown && a->image.pixels && status == FONT_OK; i++) {
        struct font_placed placed[2];
        struct font_layout layouts[2];
        double advance = 0, x = EDGE + i % across * CELL, y = a->y + i / across * CELL;
        for (int k = 0; k < 2; k++) {
            placed[k] = (struct font_placed){.face = a->faces[k], .glyph = a->changed[i][k]};
            layouts[k] = (struct font_layout){
                .glyphs = &placed[k], .glyphs_count = 1, .size_px = size_px};
        }
        struct font_face_info info;
        font_face_describe(a->faces[0], &info);
        (void)font_face_advance(a->faces[0], a->changed[i][0], &advance);
        x += (CELL - advance * size_px / info.units_per_em) / 2;
        status = both_draw(a, layouts, floor(x), floor(y + CELL * 0.7));
    }
    a->y += (shown + across - 1) / across * CELL;
    return status;
}

static enum font_status all_set(struct against *a)
{
    enum font_status status = FONT_OK;
    a->y = 44;
    for (int i = 0; i < SIZES && status == FONT_OK; i++)
        status = size_set(a, sizes[i]);
    return status == FONT_OK ? changed_set(a) : status;
}

static int failed(const struct against *a)
{
    return a->starved ? fail("font", "no memory") : fail_font("font");
}

static int picture_make(struct against *a)
{
    struct font_painter_def def = font_painter_def_default();
    int status = EXIT_SUCCESS;
    def.filter = a->v->filter;
    if (font_painter_create(&def, &a->painter) != FONT_OK ||
        font_shaper_create(a->faces[0], &a->shapers[0]) != FONT_OK ||
        font_shaper_create(a->faces[1], &a->shapers[1]) != FONT_OK ||
        glyphs_compare(a) != FONT_OK || all_set(a) != FONT_OK)
        status = failed(a);
    if (status == EXIT_SUCCESS)
        status = type_image_create("font", fmax(a->width, 560), a->y + EDGE, &a->image);
    a->labels = type_labels_create(13);
    if (status == EXIT_SUCCESS) {
        type_label(a->labels, &a->image, EDGE, 24,
                   "red: only before, blue: only after. %d glyphs changed, %d gone, %d new",
                   a->changed_count, a->gone, a->come);
        if (all_set(a) != FONT_OK)
            status = failed(a);
    }
    if (status == EXIT_SUCCESS)
        status = type_image_write("font", a->v->out_path, &a->image);
    return status;
}

int font_against_show(const struct font_verb *v, struct font_face *face)
{
    struct against a = {.v = v, .faces = {face, NULL}};
    int status = type_face_open("font", v->against, v->face, v->axes, false, &a.faces[1]);
    if (status == EXIT_SUCCESS)
        status = picture_make(&a);
    type_left_out_tell("font");
    display_image_destroy(&a.image);
    type_labels_destroy(a.labels);
    free(a.changed);
    font_painter_destroy(a.painter);
    for (int i = 0; i < 2; i++)
        font_shaper_destroy(a.shapers[i]);
    font_face_close(a.faces[1]);
    return status;
}
