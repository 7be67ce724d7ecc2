/* poster.c - see poster.h. */
#include "poster.h"

#include "lutetia.h"
#include "type_common.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PAGE_PIXELS 24e6 /* the most of a page */

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

/* Draws lines from `first` on. */
static int page_draw(const struct poster *p, int first, int end, struct display_image *image)
{
    int status = type_image_create(p->verb, ceil(p->width_px + 2 * p->margin_px),
                                   ceil(2 * p->margin_px + p->pitch_px * (end - first)), image);
    struct font_picture picture = type_picture(image);
    if (status == EXIT_SUCCESS)
        p->paper(p->of, &picture);
    for (int i = first; i < end && status == EXIT_SUCCESS; i++)
        status = interrupted()
                     ? EXIT_INTERRUPTED
                     : p->draw(p->of, i, p->margin_px + p->pitch_px * (i - first), &picture);
    if (status == EXIT_SUCCESS)
        rows_cut(image, (int)p->margin_px);
    return status;
}

int poster_write(const struct poster *p)
{
    const double most = fmin(DISPLAY_SIDE_MAX, PAGE_PIXELS / (p->width_px + 2 * p->margin_px));
    const int lines = (int)fmax(1, floor((most - 2 * p->margin_px) / p->pitch_px));
    int status = EXIT_SUCCESS, page = 0;
    for (int first = 0; first < p->lines && status == EXIT_SUCCESS; first += lines, page++) {
        struct display_image image = {0};
        char path[PATH_MAX];
        const int end = first + lines < p->lines ? first + lines : p->lines;
        page_path(p->path, page, path, sizeof path);
        status = page_draw(p, first, end, &image);
        if (status == EXIT_SUCCESS)
            status = type_image_write(p->verb, path, &image);
        display_image_destroy(&image);
    }
    if (status == EXIT_SUCCESS && page > 1)
        tell(p->verb, "the poster has %d pages: %s and so on", page, p->path);
    return status;
}
