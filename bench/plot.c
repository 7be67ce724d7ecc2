/* plot.c - the rows of a benchmark as a picture: a bar for each, those of a case and unit
 * together on an axis of their own.
 *
 *     1024x1024, ns/fiber-step
 *     listing             ##############       1.520
 *     hand time-tiled     ######               0.650
 *     numpy               ########//######### 46.000    longer than the axis: broken
 */
#include "options.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "display.h"

enum {
    WIDTH_PX = 960,
    EDGE_PX = 24,
    TEXT_PX = 15,
    TITLE_PX = 19,
    ROW_PX = 26,
    BAR_PX = 16,
    HEADING_PX = 46,
    TOP_PX = 70,
    LABELS_PX = 250, /* the bars begin here */
    VALUES_PX = 110  /* beside the bars */
};

struct colour {
    uint8_t red, green, blue;
};

static const struct colour paper = {255, 255, 255}, ink = {32, 36, 44}, faint = {116, 122, 134},
                           ours = {31, 98, 158}, theirs = {163, 175, 190};

/* ---- text ---- */

static const char *const fonts[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/local/share/fonts/DejaVuSans.ttf",
};

struct plot {
    struct display_image image;
    FT_Library library;
    FT_Face face;
};

static bool face_open(struct plot *p)
{
    if (FT_Init_FreeType(&p->library))
        return bench_fail("--plot: FreeType does not start");
    for (size_t i = 0; i < sizeof fonts / sizeof *fonts; i++)
        if (!access(fonts[i], R_OK) && !FT_New_Face(p->library, fonts[i], 0, &p->face))
            return true;
    return bench_fail("--plot needs the typeface DejaVu Sans (install fonts-dejavu-core)");
}

static void mix(struct plot *p, int x, int y, struct colour c, int cover)
{
    if (x < 0 || y < 0 || x >= p->image.width_px || y >= p->image.height_px)
        return;
    uint8_t *pixel = p->image.pixels + 3 * ((size_t)y * (size_t)p->image.width_px + (size_t)x);
    const uint8_t to[3] = {c.red, c.green, c.blue};
    for (int i = 0; i < 3; i++)
        pixel[i] = (uint8_t)((pixel[i] * (255 - cover) + to[i] * cover + 127) / 255);
}

/* Returns the text's width; draws it from x on, on the base line y, if c is given. */
static int text(struct plot *p, const char *s, int size_px, int x, int y,
                const struct colour *c)
{
    int pen = 0; /* 1/64 px */
    FT_Set_Pixel_Sizes(p->face, 0, (FT_UInt)size_px);
    for (; *s; s++) {
        if (FT_Load_Char(p->face, (unsigned char)*s, FT_LOAD_RENDER))
            continue;
        const FT_GlyphSlot glyph = p->face->glyph;
        const FT_Bitmap *b = &glyph->bitmap;
        for (int row = 0; c && row < (int)b->rows; row++)
            for (int column = 0; column < (int)b->width; column++)
                mix(p, x + pen / 64 + glyph->bitmap_left + column, y - glyph->bitmap_top + row,
                    *c, b->buffer[row * b->pitch + column]);
        pen += (int)glyph->advance.x;
    }
    return (pen + 63) / 64;
}

static void text_right(struct plot *p, const char *s, int x, int y, struct colour c)
{
    text(p, s, TEXT_PX, x - text(p, s, TEXT_PX, 0, 0, NULL), y, &c);
}

/* ---- bars ---- */

static bool is_ours(const char *what)
{
    static const char *const peers[] = {"hand",          "openmp",      "halide",
                                        "numpy",         "plain C",     "copy bandwidth",
                                        "traffic bound", "small sheet,"};
    for (size_t i = 0; i < sizeof peers / sizeof *peers; i++)
        if (!strncmp(what, peers[i], strlen(peers[i])))
            return false;
    return true;
}

/* left and right in 1/256 px. */
static void bar(struct plot *p, int left, int right, int top, struct colour c)
{
    for (int x = left / 256; x * 256 < right; x++) {
        int from = x * 256 > left ? x * 256 : left,
            to = (x + 1) * 256 < right ? (x + 1) * 256 : right;
        for (int y = top; y < top + BAR_PX; y++)
            mix(p, x, y, c, (to - from) * 255 / 256);
    }
}

/* Two slanted gaps in a bar that is longer than the axis. */
static void bar_break(struct plot *p, int x, int top)
{
    for (int gap = 0; gap < 2; gap++)
        for (int y = 0; y < BAR_PX; y++)
            for (int i = 0; i < 3; i++)
                mix(p, x + 9 * gap + i + (BAR_PX - y) / 2, top + y, paper, 255);
}

static int doubles_compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value at the axis's end: the longest, unless a few are far longer than most. */
static double axis_end(const double *values, int count)
{
    double sorted[BENCH_ROWS_MAX];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, doubles_compare);
    int most = count - 1 - count / 4;
    return sorted[count - 1] > 4 * sorted[most] ? 1.5 * sorted[most] : sorted[count - 1];
}

static bool same_group(const struct bench_row *a, const struct bench_row *b)
{
    return !strcmp(a->of_case, b->of_case) && !strcmp(a->unit, b->unit);
}

static bool begins_group(const struct bench_report *r, int i)
{
    for (int k = 0; k < i; k++)
        if (same_group(&r->rows[k], &r->rows[i]))
            return false;
    return true;
}

static void value_text(char *out, size_t size, double value)
{
    int decimals = value >= 1000 ? 0 : value >= 100 ? 1 : value >= 10 ? 2 : 3;
    snprintf(out, size, "%.*f", decimals, value);
}

/* Draws the bars of the group that begins with row `first`; returns y for the next group. */
static int group_draw(struct plot *p, const struct bench_report *r, int first, int y)
{
    double values[BENCH_ROWS_MAX];
    char line[128];
    int count = 0;
    for (int i = first; i < r->rows_count; i++)
        if (same_group(&r->rows[first], &r->rows[i]))
            values[count++] = r->rows[i].value;
    double end = axis_end(values, count);
    snprintf(line, sizeof line, "%s, %s", r->rows[first].of_case, r->rows[first].unit);
    text(p, line, TEXT_PX, EDGE_PX, y + HEADING_PX - 14, &faint);
    y += HEADING_PX;
    for (int i = first; i < r->rows_count; i++) {
        const struct bench_row *row = &r->rows[i];
        if (!same_group(&r->rows[first], row))
            continue;
        bool broken = row->value > end;
        double share = broken ? 1 : end > 0 && row->value > 0 ? row->value / end : 0;
        int top = y + (ROW_PX - BAR_PX) / 2, width = WIDTH_PX - LABELS_PX - VALUES_PX - EDGE_PX;
        int right = LABELS_PX * 256 + (int)(share * width * 256);
        text_right(p, row->what, LABELS_PX - 12, y + 18, ink);
        bar(p, LABELS_PX * 256, right, top, is_ours(row->what) ? ours : theirs);
        if (broken)
            bar_break(p, LABELS_PX + width * 4 / 5, top);
        value_text(line, sizeof line, row->value);
        text(p, line, TEXT_PX, right / 256 + 8, y + 18, &ink);
        y += ROW_PX;
    }
    return y;
}

bool bench_plot(const struct bench_report *r, const char *path)
{
    struct plot p = {0};
    char line[256];
    int height = TOP_PX + EDGE_PX + r->rows_count * ROW_PX;
    for (int i = 0; i < r->rows_count; i++)
        height += begins_group(r, i) ? HEADING_PX : 0;
    p.image = (struct display_image){.width_px = WIDTH_PX, .height_px = height, .channels = 3};
    bool ok = face_open(&p);
    if (ok && display_image_create(&p.image) != DISPLAY_OK)
        ok = bench_fail("--plot: %s", display_error());
    if (ok) {
        memset(p.image.pixels, 255, (size_t)WIDTH_PX * (size_t)height * 3);
        text(&p, r->name, TITLE_PX, EDGE_PX, 36, &ink);
        snprintf(line, sizeof line, "%s, %d threads; medians", r->device, r->threads_count);
        text(&p, line, TEXT_PX, EDGE_PX, 60, &faint);
        int y = TOP_PX;
        for (int i = 0; i < r->rows_count; i++)
            if (begins_group(r, i))
                y = group_draw(&p, r, i, y);
        if (display_png_write(path, &p.image) != DISPLAY_OK)
            ok = bench_fail("%s", display_error());
    }
    display_image_destroy(&p.image);
    FT_Done_Face(p.face);
    FT_Done_FreeType(p.library);
    return ok;
}
