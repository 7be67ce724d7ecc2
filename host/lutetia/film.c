/* film.c - frames by the sheet's own time: frame n is after n * every steps. So pictures of
 * a resumed run continue the numbers of the run before. */
#include "film.h"

#include "lutetia.h"

#include <display.h>
#include <history.h>
#include <video.h>

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AMOUNT_WHITE 4.0 /* the amount of water that is shown white */

static bool film_fail(struct film *film, const char *text)
{
    film->failed = true;
    snprintf(film->error, sizeof film->error, "%s", text);
    return false;
}

/* The part of the sheet that the camera shows, clipped to the sheet: whole fibers. */
struct window {
    int x, y, width, height;
};

static struct window window_of(const struct film *film, const struct paper_sheet_config *config)
{
    struct window w = {0, 0, config->width, config->height};
    if (film->camera[2] > 0) {
        w.x = (int)fmax(0, fmin(config->width - 2, film->camera[0]));
        w.y = (int)fmax(0, fmin(config->height - 2, film->camera[1]));
        w.width = (int)fmax(2, fmin(config->width - w.x, film->camera[2]));
        w.height = (int)fmax(2, fmin(config->height - w.y, film->camera[3]));
    }
    return w;
}

/* Draws by bilinear interpolation between the fibers' middles; a window as large as the
 * picture is copied fiber by fiber. */
static void window_draw(const uint16_t *rgb, int sheet_width, const struct window *w,
                        uint8_t *out, int width, int height)
{
    double sx = (double)w->width / width, sy = (double)w->height / height;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double fx = fmin(w->width - 1, fmax(0, (x + 0.5) * sx - 0.5));
            double fy = fmin(w->height - 1, fmax(0, (y + 0.5) * sy - 0.5));
            int ix = (int)fmin(fx, w->width - 2), iy = (int)fmin(fy, w->height - 2);
            double ax = fx - ix, ay = fy - iy;
            for (int c = 0; c < 3; c++) {
                size_t at =
                    3 * ((size_t)(w->y + iy) * (size_t)sheet_width + (size_t)(w->x + ix)) +
                    (size_t)c;
                size_t below = at + 3 * (size_t)sheet_width;
                double top = (1 - ax) * rgb[at] + ax * rgb[at + 3];
                double bottom = (1 - ax) * rgb[below] + ax * rgb[below + 3];
                out[3 * ((size_t)y * (size_t)width + (size_t)x) + (size_t)c] =
                    (uint8_t)lround(((1 - ay) * top + ay * bottom) / 257);
            }
        }
}

static bool video_step(struct film *film, const struct paper_sheet_config *config,
                       const uint16_t *rgb)
{
    struct window w = window_of(film, config);
    if (!film->file) {
        film->width = w.width & ~1;
        film->height = w.height & ~1;
        if (video_create(film->video, film->width, film->height, film->fps, &film->file) !=
            DISPLAY_OK)
            return film_fail(film, display_error());
    }
    if (w.width - film->width == 1)
        w.width--;
    if (w.height - film->height == 1)
        w.height--;
    uint8_t *picture = malloc(3 * (size_t)film->width * (size_t)film->height);
    if (!picture)
        return film_fail(film, "no memory for a frame");
    window_draw(rgb, config->width, &w, picture, film->width, film->height);
    enum display_status status = video_add(film->file, picture);
    free(picture);
    return status == DISPLAY_OK || film_fail(film, display_error());
}

static bool picture_write(struct film *film, const char *what, long number,
                          const struct paper_sheet_config *config, int channels,
                          const uint16_t *pixels)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s-%06ld.png", film->folder, what, number);
    if (display_png_write_16(path, config->width, config->height, channels, pixels) !=
        DISPLAY_OK)
        return film_fail(film, display_error());
    return true;
}

/* Writes gray = the sum of two layers (or one layer twice), relative to the amount that is
 * white. */
static bool gray_write(struct film *film, const char *what, long number,
                       struct paper_sheet *sheet, enum paper_layer first,
                       enum paper_layer second, double white)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    size_t count = (size_t)config->width * (size_t)config->height;
    float *one = malloc(count * sizeof *one), *two = calloc(count, sizeof *two);
    uint16_t *gray = malloc(count * sizeof *gray);
    bool done = one && two && gray;
    if (!done)
        film_fail(film, "no memory for a frame");
    else if (paper_sheet_layer_read(sheet, first, 0, one) != PAPER_OK ||
             (second != first && paper_sheet_layer_read(sheet, second, 0, two) != PAPER_OK))
        done = film_fail(film, paper_error());
    for (size_t i = 0; done && i < count; i++)
        gray[i] = (uint16_t)lround(65535 *
                                   fmin(1, fmax(0, ((double)one[i] + (double)two[i]) / white)));
    done = done && picture_write(film, what, number, config, 1, gray);
    free(one);
    free(two);
    free(gray);
    return done;
}

bool film_step(struct film *film, int paper, struct paper_sheet *sheet)
{
    if (!film_on(film) || paper != film->paper)
        return !film->failed;
    long time = paper_sheet_now(sheet);
    bool repeats = paper_history_following(sheet) > 0;
    /* the saved run has already written the frame of the moment at which it was saved */
    bool there = repeats || (film->filmed_before && time == paper_history_resumed(sheet));
    film->filmed_before = repeats;
    if (there)
        film->after = time + 1;
    if (there || film->failed || time % film->every != 0 || time + 1 == film->after)
        return !film->failed;
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    uint16_t *rgb = malloc(3 * sizeof *rgb * (size_t)config->width * (size_t)config->height);
    if (!rgb)
        return film_fail(film, "no memory for a frame");
    bool done = true;
    struct paper_sheet_view view = paper_sheet_view_default(config);
    view.show = film->show;
    if (paper_sheet_view(sheet, &view, rgb) != PAPER_OK)
        done = film_fail(film, paper_error());
    if (done && film->video)
        done = video_step(film, config, rgb);
    if (done && film->folder)
        done = picture_write(film, "color", time / film->every, config, 3, rgb) &&
               gray_write(film, "water", time / film->every, sheet, PAPER_LAYER_SURFACE_WATER,
                          PAPER_LAYER_INFUSED_WATER, AMOUNT_WHITE) &&
               gray_write(film, "mask", time / film->every, sheet, PAPER_LAYER_RESIST,
                          PAPER_LAYER_RESIST, 1);
    free(rgb);
    film->after = time + 1;
    return done;
}

bool film_end(struct film *film)
{
    struct video *file = film->file;
    film->file = NULL;
    if (!file)
        return !film->failed;
    if (film->failed) {
        video_abandon(file);
        return false;
    }
    if (strcmp(video_path(file), film->video) != 0)
        tell("run", "ffmpeg is not installed; the film is %s", video_path(file));
    return video_finish(file) == DISPLAY_OK || film_fail(film, display_error());
}
