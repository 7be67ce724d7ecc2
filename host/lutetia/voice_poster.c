/* voice_poster.c - see voice_poster.h. */
#include "voice_poster.h"

#include "lutetia.h"
#include "type_common.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE_MOST_PX 9600.0 /* a poster of one line is no longer */
#define LINE_PX 4800.0      /* nor are several */
#define PAGE_PIXELS 24e6    /* the most of a page */

/* Crops rows at the top and bottom, up to `margin` pixels from the ink. */
static void rows_cut(struct display_image *image, int margin)
{
    size_t row = 3 * (size_t)image->width_px;
    int top = 0, bottom = image->height_px;
    while (top < bottom && memcmp(image->pixels + row * (size_t)top, image->pixels, row) == 0)
        top++;
    while (bottom > top &&
           memcmp(image->pixels + row * (size_t)(bottom - 1), image->pixels, row) == 0)
        bottom--;
    if (top == bottom)
        return;
    top = top > margin ? top - margin : 0;
    bottom = bottom + margin < image->height_px ? bottom + margin : image->height_px;
    memmove(image->pixels, image->pixels + row * (size_t)top, row * (size_t)(bottom - top));
    image->height_px = bottom - top;
}

/* A page of the poster: lines from `first` on, as many as it has room for. */
struct poster {
    const struct voice_line *lines;
    int count;
    double margin, above, pitch,
        width; /* of a line: from its top to its baseline, and to the next */
};

static int page_draw(const struct voice_poster_def *def, struct voice_type *type,
                     const struct poster *p, int first, int end, struct display_image *image)
{
    int status = type_image_create("voice", ceil(p->width + 2 * p->margin),
                                   ceil(2 * p->margin + p->pitch * (end - first)), image);
    struct font_picture picture = type_picture(image);
    if (status == EXIT_SUCCESS)
        voice_type_paper(type, &picture);
    for (int i = first; i < end && status == EXIT_SUCCESS; i++) {
        const double x = voice_type_to_left(type) ? picture.width_px - p->margin : p->margin;
        if (voice_type_line(type, def->second_px, &p->lines[i], x,
                            p->margin + p->above + p->pitch * (i - first), &picture) != FONT_OK)
            status = fail_font("voice");
    }
    if (status == EXIT_SUCCESS)
        rows_cut(image, (int)p->margin);
    return status;
}

/* poster.png, then poster-2.png, ... */
static void page_path(const char *path, int page, char *out, size_t room)
{
    const char *name = strrchr(path, '/'), *dot = strrchr(name ? name : path, '.');
    const int stem = (int)(dot && dot != name ? dot - path : (long)strlen(path));
    if (page == 0)
        snprintf(out, room, "%s", path);
    else
        snprintf(out, room, "%.*s-%d%s", stem, path, page + 1, path + stem);
}

static int pages_write(const struct voice_poster_def *def, struct voice_type *type,
                       const struct poster *p)
{
    const double most = fmin(DISPLAY_SIDE_MAX, PAGE_PIXELS / (p->width + 2 * p->margin));
    const int lines = (int)fmax(1, floor((most - 2 * p->margin) / p->pitch));
    int status = EXIT_SUCCESS, page = 0;
    for (int first = 0; first < p->count && status == EXIT_SUCCESS; first += lines, page++) {
        struct display_image image = {0};
        char path[PATH_MAX];
        const int end = first + lines < p->count ? first + lines : p->count;
        page_path(def->path, page, path, sizeof path);
        status = interrupted() ? EXIT_INTERRUPTED : page_draw(def, type, p, first, end, &image);
        if (status == EXIT_SUCCESS)
            status = type_image_write("voice", path, &image);
        display_image_destroy(&image);
    }
    if (status == EXIT_SUCCESS && page > 1)
        tell("voice", "the poster has %d pages: %s and so on", page, def->path);
    return status;
}

/* One line where it is not too long, else lines of a page's width. */
int voice_poster_write(struct voice_type *type, const struct voice_poster_def *def)
{
    struct voice_line *lines = NULL;
    int status = EXIT_SUCCESS, count = 0;
    enum font_status made = voice_type_lines(
        type, def->second_px, def->line_px > 0 ? def->line_px : LINE_MOST_PX, &lines, &count);
    if (made == FONT_OK && count > 1 && def->line_px == 0) {
        free(lines);
        made = voice_type_lines(type, def->second_px, LINE_PX, &lines, &count);
    }
    struct poster poster = {.lines = lines,
                            .count = count,
                            .margin = ceil(0.25 * def->size_px),
                            .above = 1.1 * def->size_px + def->rise_px,
                            .pitch = 1.7 * def->size_px + def->rise_px};
    for (int i = 0; i < count; i++)
        poster.width = fmax(poster.width, lines[i].width_px);
    status = made == FONT_OK ? pages_write(def, type, &poster) : fail_font("voice");
    free(lines);
    return status;
}
