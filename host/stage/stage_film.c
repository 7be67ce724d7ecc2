/* stage_film.c - see stage_film.h. */
#include "stage_film.h"

#include "exact.h"
#include "renderer.h"
#include "stage_loop.h"

#include <video.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOMENTS_MAX = 100, LEAD_HZ = 60 };

static const double side_usual_px =
    720; /* of a picture whose lines are as wide as the theme says */

struct film {
    struct stage *stage;
    const struct stage_film_def *def;
    struct stage_exact *exact; /* or */
    struct stage_renderer *renderer;
    struct stage_draw_list list;
    struct display_image image;
    struct display_image strip; /* the strip's moments so far; no pixels: no strip */
    struct display_image
        flat; /* for a film without alpha beside pictures with it; else no pixels */
    double px;
    int moments;
    int64_t led; /* the number of the next sixtieth of a second at which it is led */
    struct video *video;
    struct stage_loop loop, flat_loop; /* of `image` and of `flat`; loop 0: none */
};

struct stage_film_def stage_film_def_default(void)
{
    return (struct stage_film_def){.sound = -1,
                                   .strip = {1, 1},
                                   .width_px = 1280,
                                   .height_px = 720,
                                   .fps = 30,
                                   .seconds = 5,
                                   .filter = "gaussian-fast"};
}

static enum stage_status fail_display(enum display_status status)
{
    return stage_fail(status == DISPLAY_NO_MEMORY ? STAGE_NO_MEMORY : STAGE_BAD_FILE, "%s",
                      display_error());
}

static int moments_wanted(const struct stage_film_def *def)
{
    return def->still ? def->strip[0] * def->strip[1] : 0;
}

static enum stage_status image_make(struct display_image *image, int width_px, int height_px,
                                    int channels)
{
    *image = (struct display_image){
        .width_px = width_px, .height_px = height_px, .channels = channels};
    enum display_status status = display_image_create(image);
    return status == DISPLAY_OK ? STAGE_OK : fail_display(status);
}

/* Makes the video; the pictures' size and channels are known. */
static enum stage_status video_begin(struct film *f)
{
    const struct stage_film_def *def = f->def;
    const struct video_def video = {.path = def->video,
                                    .width_px = f->image.width_px,
                                    .height_px = f->image.height_px,
                                    .fps = def->fps,
                                    .sound = def->sound,
                                    .alpha = f->image.channels == 4 && video_alpha(def->video)};
    enum stage_status status = STAGE_OK;
    if (f->image.channels == 4 && !video.alpha)
        status = image_make(&f->flat, video.width_px, video.height_px, 3);
    if (status != STAGE_OK)
        return status;
    const enum display_status made = video_create_as(&video, &f->video);
    return made == DISPLAY_OK ? STAGE_OK : fail_display(made);
}

static enum stage_status film_begin(struct film *f)
{
    const struct stage_film_def *def = f->def;
    int width = def->width_px, height = def->height_px;
    if (def->strip[0] < 1 || def->strip[1] < 1 || def->strip[0] * def->strip[1] > MOMENTS_MAX)
        return stage_fail(STAGE_BAD_ARGUMENT, "a strip has 1..%d moments (got %dx%d)",
                          MOMENTS_MAX, def->strip[0], def->strip[1]);
    const int channels =
        stage_background(f->stage).a < 1 && !def->over && def->way == STAGE_FILM_EXACT ? 4 : 3;
    enum stage_status status = STAGE_OK;
    if (moments_wanted(def) > 1) {
        width /= def->strip[0];
        height /= def->strip[1];
        status = image_make(&f->strip, width * def->strip[0], height * def->strip[1], channels);
    }
    f->px = def->px > 0 ? def->px : fmax(1, fmin(width, height) / side_usual_px);
    if (status == STAGE_OK)
        status = image_make(&f->image, width, height, channels);
    if (status == STAGE_OK && def->way == STAGE_FILM_EXACT)
        status = stage_exact_create(def->filter, &f->exact);
    else if (status == STAGE_OK)
        status = stage_renderer_offscreen(def->way == STAGE_FILM_EGL ? STAGE_BY_EGL
                                                                     : STAGE_BY_OSMESA,
                                          width, height, &f->renderer);
    if (status == STAGE_OK && def->loop_s > 0)
        status = stage_loop_begin(&f->loop, def->loop_s, def->seconds, def->fps);
    if (status == STAGE_OK && def->loop_s > 0)
        status = stage_loop_begin(&f->flat_loop, def->loop_s, def->seconds, def->fps);
    return status == STAGE_OK && def->video ? video_begin(f) : status;
}

static enum stage_status picture_draw(struct film *f)
{
    struct stage_color background = stage_background(f->stage);
    stage_picture(f->stage, f->image.width_px, f->image.height_px, f->px, &f->list);
    if (f->exact) {
        enum stage_status drawn = stage_exact_draw(f->exact, &f->list, background, &f->image);
        return drawn == STAGE_OK && f->flat.pixels
                   ? stage_exact_draw(f->exact, &f->list, background, &f->flat)
                   : drawn;
    }
    enum stage_status status = stage_renderer_draw(f->renderer, &f->list, background);
    return status == STAGE_OK ? stage_renderer_read(f->renderer, &f->image) : status;
}

static enum stage_status png_write(const char *path, const struct display_image *image)
{
    enum display_status status = display_png_write(path, image);
    return status == DISPLAY_OK ? STAGE_OK : fail_display(status);
}

/* Adds the next moment to the strip, from left to right and then below. */
static void strip_add(struct film *f)
{
    const int columns = f->def->strip[0], h = f->image.height_px;
    const size_t row_bytes = (size_t)f->image.width_px * (size_t)f->image.channels,
                 x = (size_t)(f->moments % columns) * row_bytes,
                 y = (size_t)(f->moments / columns) * (size_t)h;
    for (size_t row = 0; row < (size_t)h; row++)
        memcpy(f->strip.pixels + (y + row) * row_bytes * (size_t)columns + x,
               f->image.pixels + row * row_bytes, row_bytes);
    f->moments++;
}

/* Of frames 0..last: whether moment `moments` of the strip is this one. */
static bool is_moment(const struct film *f, int frame, int last)
{
    int wanted = moments_wanted(f->def);
    if (wanted < 1 || f->moments >= wanted)
        return false;
    return wanted == 1 ? frame == last
                       : frame == (int)lround((double)last * f->moments / (wanted - 1));
}

/* Writes a picture of film and frames; of a loop the first are kept instead, and the last faded
 * into them. */
static enum stage_status picture_write(struct film *f, int frame)
{
    const struct stage_film_def *def = f->def;
    enum stage_status status = STAGE_OK;
    char path[4096];
    if (f->loop.loop) {
        const bool written = stage_loop_take(&f->loop, frame, &f->image, &status);
        if (status == STAGE_OK && f->flat.pixels)
            stage_loop_take(&f->flat_loop, frame, &f->flat, &status);
        if (status != STAGE_OK || !written)
            return status;
        frame -= f->loop.loop;
    }
    if (f->video &&
        video_add(f->video, f->flat.pixels ? f->flat.pixels : f->image.pixels) != DISPLAY_OK)
        return stage_fail(STAGE_BAD_FILE, "%s", display_error());
    if (!def->frames)
        return STAGE_OK;
    const int length = snprintf(path, sizeof path, "%s/frame-%06d.png", def->frames, frame);
    return length > 0 && (size_t)length < sizeof path
               ? png_write(path, &f->image)
               : stage_fail(STAGE_BAD_FILE, "the folder's name is too long");
}

static enum stage_status frame_put(struct film *f, int frame, int last)
{
    const struct stage_film_def *def = f->def;
    bool moment = is_moment(f, frame, last);
    if (!moment && !def->video && !def->frames && !def->over &&
        frame > 0) /* the first one has the view made */
        return STAGE_OK;
    enum stage_status status = picture_draw(f);
    if (status == STAGE_OK && def->over)
        status = def->over(def->context, f->stage, &f->list, &f->image);
    while (status == STAGE_OK && f->strip.pixels && is_moment(f, frame, last))
        strip_add(f);
    if (status == STAGE_OK && moment && !f->strip.pixels) {
        f->moments++;
        status = png_write(def->still, &f->image);
    }
    if (status == STAGE_OK && (def->video || def->frames)) /* last: a loop changes it */
        status = picture_write(f, frame);
    return status;
}

/* A picture before those that are written: it is drawn only where something is made of it. */
static enum stage_status frame_pass(struct film *f, bool first)
{
    const struct stage_film_def *def = f->def;
    if (!def->over && !first) /* the first one has the view made */
        return STAGE_OK;
    const enum stage_status status = picture_draw(f);
    return status == STAGE_OK && def->over
               ? def->over(def->context, f->stage, &f->list, &f->image)
               : status;
}

/* The stage's steps until then. Whoever plays it leads it sixty times a second, as in a window,
 * so that a film of few pictures moves like one of many; what is due meanwhile comes at its own
 * time. */
static enum stage_status steps_run(struct film *f, double now_s)
{
    const struct stage_film_def *def = f->def;
    enum stage_status status = STAGE_OK;
    while (def->before && status == STAGE_OK) {
        const double lead_s = (double)f->led / LEAD_HZ,
                     due_s = def->due_s ? def->due_s(def->context) : INFINITY;
        if (due_s <= now_s && due_s <= lead_s) {
            status = stage_frame(f->stage, due_s, NULL);
            if (status == STAGE_OK)
                status = def->before(def->context, f->stage, due_s);
        } else if (lead_s < now_s) {
            status = def->before(def->context, f->stage, lead_s);
            if (status == STAGE_OK)
                status = stage_frame(f->stage, lead_s, NULL);
            f->led++;
        } else {
            break;
        }
    }
    if (status == STAGE_OK && def->before)
        status = def->before(def->context, f->stage, now_s);
    f->led = (int64_t)floor(now_s * LEAD_HZ * (1 + 1e-12)) + 1;
    return status == STAGE_OK ? stage_frame(f->stage, now_s, NULL) : status;
}

static enum stage_status frames_run(struct film *f)
{
    const struct stage_film_def *def = f->def;
    const int end = (int)lround(def->seconds * def->fps);
    /* a loop's last picture is followed by its first: it is not written twice */
    const int last = f->loop.loop ? f->loop.count + f->loop.loop - 1 : end;
    const int settling = (int)lround(def->settle_s * def->fps);
    enum stage_status status = STAGE_OK;
    for (int frame = -settling; frame <= last && status == STAGE_OK; frame++) {
        status = steps_run(f, (double)(frame + settling) / def->fps);
        if (status == STAGE_OK)
            status = frame < 0 ? frame_pass(f, frame == -settling) : frame_put(f, frame, last);
        if (status == STAGE_OK && def->after &&
            def->after(def->context, frame + settling + 1, last + settling + 1))
            break;
    }
    if (status == STAGE_OK && f->strip.pixels && f->moments == moments_wanted(def))
        status = png_write(def->still, &f->strip);
    return status;
}

enum stage_status stage_film(struct stage *stage, const struct stage_film_def *def)
{
    struct film f = {.stage = stage, .def = def};
    enum stage_status status = film_begin(&f);
    stage_clock(stage)->frame_max_s = INFINITY; /* no frame is too late */
    if (status == STAGE_OK)
        status = frames_run(&f);
    if (f.video && status != STAGE_OK)
        video_abandon(f.video);
    else if (f.video && video_finish(f.video) != DISPLAY_OK)
        status = stage_fail(STAGE_BAD_FILE, "%s", display_error());
    stage_exact_destroy(f.exact);
    stage_renderer_destroy(f.renderer);
    stage_draw_finish(&f.list);
    display_image_destroy(&f.image);
    display_image_destroy(&f.strip);
    display_image_destroy(&f.flat);
    stage_loop_finish(&f.loop);
    stage_loop_finish(&f.flat_loop);
    return status;
}
