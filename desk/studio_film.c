/* studio_film.c - see studio_film.h.
 *
 *     operations   brush dip stroke----------> step step step  wash~~~  dry~~~
 *     film, s      0         its samples' times   1/60 each    0.4      0.4        + 2
 *     frames       | | | | | | | | | | | | | | |     each is the sheet at its moment */
#include "studio_film.h"

#include "studio_session_internal.h"

#include <arguments.h>
#include <picture.h>
#include <video.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEPS_A_SECOND 60.0
#define HELD_S 0.4
#define END_S 2.0
#define TYPE_PX 15.0
enum { LINE_PX = 28, MARGIN_PX = 8, BASELINE_PX = 19, TEXT_ROOM = 400 };

struct film {
    const struct studio_film_def *def;
    const struct paper_sheet_config *config;
    struct paper_sheet *sheet; /* on which all is done again */
    struct video *video;
    uint8_t *rgb;
    int width, height;
    double time_s, total_s, speed;
    long frames;
    bool ring; /* a brush is on the paper */
    double ring_x, ring_y, ring_radius;
    struct paper_brush brushes[PAPER_BRUSHES_MAX];
    struct paper_dip dips[PAPER_BRUSHES_MAX];
    struct paper_screen text;
    char said[TEXT_ROOM];
};

/* ---- how long it takes ---- */

static double operation_seconds(const struct paper_sheet *sheet, int number, long steps)
{
    struct paper_moment moment;
    void *arguments;
    double seconds = 0;
    paper_history_moment(sheet, number, &moment);
    if (strcmp(moment.what, "step") == 0)
        return (double)steps / STEPS_A_SECOND;
    if (strcmp(moment.what, "brush") == 0 || strcmp(moment.what, "dip") == 0 ||
        strcmp(moment.what, "air") == 0 || strcmp(moment.what, "bookmark") == 0)
        return 0;
    if (strcmp(moment.what, "resist") == 0 && studio_selection_ends(sheet, number))
        return 0; /* it was told with the one before */
    if (strcmp(moment.what, "stroke") != 0)
        return HELD_S;
    if (paper_history_arguments(sheet, number, &arguments) == PAPER_OK) {
        const struct paper_stroke *stroke = arguments;
        seconds = stroke->samples[stroke->samples_count - 1].time_s - stroke->samples[0].time_s;
    }
    paper_history_arguments_free(moment.what, arguments);
    return seconds;
}

/* Of the last steps some may be undone. */
static long steps_of(const struct paper_sheet *sheet, int number)
{
    struct paper_moment moment;
    paper_history_moment(sheet, number, &moment);
    const long left = paper_sheet_steps(sheet) - moment.time;
    return moment.steps < left ? moment.steps : left;
}

/* ---- a frame ---- */

static void mix(uint8_t *pixel, const double color[3], double part)
{
    for (int i = 0; i < 3; i++)
        pixel[i] = (uint8_t)lrint(pixel[i] + part * (255 * color[i] - pixel[i]));
}

static void ring_draw(struct film *f)
{
    static const double dark[3] = {0.05, 0.05, 0.05}, light[3] = {1, 1, 1};
    const double radius = fmax(2, f->ring_radius), reach = radius + 3;
    for (int y = (int)fmax(0, f->ring_y - reach);
         y < f->config->height && y <= f->ring_y + reach; y++)
        for (int x = (int)fmax(0, f->ring_x - reach);
             x < f->config->width && x <= f->ring_x + reach; x++) {
            const double away = fabs(hypot(x + 0.5 - f->ring_x, y + 0.5 - f->ring_y) - radius);
            uint8_t *pixel = f->rgb + 3 * ((size_t)y * (size_t)f->width + (size_t)x);
            mix(pixel, light, 0.7 * fmin(1, fmax(0, 2.1 - away)));
            mix(pixel, dark, 0.9 * fmin(1, fmax(0, 1.1 - away)));
        }
}

static void line_draw(struct film *f)
{
    static const double ground[3] = {0.16, 0.16, 0.16}, letters[3] = {0.92, 0.92, 0.9};
    uint8_t *line = f->rgb + 3 * (size_t)f->config->height * (size_t)f->width;
    const struct paper_screen *text = &f->text;
    for (size_t i = 0; i < (size_t)f->width * (size_t)(f->height - f->config->height); i++)
        mix(line + 3 * i, ground, 1);
    for (int y = 0; y < text->height_px; y++)
        for (int x = 0; x < text->width_px; x++) {
            const int to_x = MARGIN_PX - text->origin_x_px + x,
                      to_y = BASELINE_PX - text->baseline_y_px + y;
            if (to_x >= 0 && to_y >= 0 && to_x < f->width && to_y < LINE_PX)
                mix(line + 3 * ((size_t)to_y * (size_t)f->width + (size_t)to_x), letters,
                    text->gray[(size_t)y * (size_t)text->width_px + (size_t)x] / 255.0);
        }
}

static enum paper_status frame_make(struct film *f)
{
    const struct paper_area all = {0, 0, f->config->width, f->config->height};
    const enum paper_status status =
        paper_sheet_view_area(f->sheet, f->def->view, &all, f->rgb, 3 * (size_t)f->width);
    if (status != PAPER_OK)
        return status;
    for (int y = 0; y < f->config->height && f->width > f->config->width; y++) {
        uint8_t *end = f->rgb + 3 * ((size_t)y * (size_t)f->width + (size_t)f->config->width);
        memcpy(end, end - 3, 3); /* films are as wide as an even number */
    }
    if (f->ring)
        ring_draw(f);
    line_draw(f);
    return PAPER_OK;
}

/* All frames up to this moment of what is told show the sheet as it is now. */
static enum paper_status frames_to(struct film *f, double time_s)
{
    const long wanted = (long)floor(time_s / f->speed * STUDIO_FILM_FPS + 1e-6);
    if (f->frames >= wanted)
        return PAPER_OK;
    if (f->def->watch &&
        !f->def->watch(f->def->context, (long)(1000 * time_s), (long)(1000 * f->total_s) + 1))
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the film was stopped");
    const enum paper_status status = frame_make(f);
    for (; status == PAPER_OK && f->frames < wanted; f->frames++)
        if (video_add(f->video, f->rgb) != DISPLAY_OK)
            return studio_session_failed(PAPER_BAD_ARGUMENT, "%s", display_error());
    return status;
}

static enum paper_status time_pass(struct film *f, double seconds)
{
    f->time_s += seconds;
    return frames_to(f, f->time_s);
}

/* ---- what is said below ---- */

static void amounts_say(const struct film *f, const double *amount, char *text, size_t room)
{
    size_t used = strlen(text);
    for (int i = 0; i <= f->config->pigments_count && used < room; i++)
        if (amount[i] > 0)
            used += (size_t)snprintf(text + used, room - used, " · %s %.2g",
                                     i ? f->config->pigments[i - 1].name : "water", amount[i]);
}

/* A font that is missing is no reason to have no film: then nothing is said. */
static void say(struct film *f, const char *text)
{
    if (strcmp(text, f->said) == 0)
        return;
    snprintf(f->said, sizeof f->said, "%s", text);
    paper_screen_destroy(&f->text);
    const struct paper_line line = {.text = text, .font = "DejaVu Sans", .size_px = TYPE_PX};
    if (paper_line_screen(&line, &f->text, NULL) != PAPER_OK)
        f->text = (struct paper_screen){0};
}

static void operation_say(struct film *f, const char *what, const void *arguments)
{
    char text[TEXT_ROOM];
    const struct paper_stroke *stroke = arguments;
    const struct event_put *put = arguments;
    const struct paper_wash *wash = arguments;
    snprintf(text, sizeof text, "%s", what);
    if (strcmp(what, "stroke") == 0) {
        snprintf(text, sizeof text, "brush %.3g", f->brushes[stroke->number].width);
        amounts_say(f, f->dips[stroke->number].amount, text, sizeof text);
    } else if (strcmp(what, "put") == 0) {
        snprintf(text, sizeof text, "ink");
        amounts_say(f, put->amount, text, sizeof text);
    } else if (strcmp(what, "wash") == 0)
        amounts_say(f, wash->amount, text, sizeof text);
    else if (strcmp(what, "resist") == 0)
        snprintf(text, sizeof text, "masking fluid");
    else if (strcmp(what, "print") == 0)
        snprintf(text, sizeof text, "picture");
    say(f, text);
}

/* ---- operations, again ---- */

static enum paper_status stroke_again(struct film *f, const struct paper_stroke *stroke)
{
    const struct paper_brush *brush = &f->brushes[stroke->number];
    const double begins_s = f->time_s;
    enum paper_status status = paper_sheet_stroke_begin(f->sheet, stroke->number, stroke->pace);
    f->ring = true;
    for (int i = 0; i < stroke->samples_count && status == PAPER_OK; i++) {
        const struct paper_stroke_sample *at = &stroke->samples[i];
        f->time_s = begins_s + at->time_s - stroke->samples[0].time_s;
        f->ring_x = at->x;
        f->ring_y = at->y;
        f->ring_radius =
            studio_tuft_radius(brush->width, brush->point, brush->splay, at->pressure);
        status = paper_sheet_stroke_add(f->sheet, at, 1, NULL);
        if (status == PAPER_OK)
            status = frames_to(f, f->time_s);
    }
    f->ring = false;
    if (status == PAPER_OK)
        return paper_sheet_stroke_end(f->sheet, NULL);
    paper_sheet_stroke_drop(f->sheet);
    return status;
}

static enum paper_status bytes_again(struct film *f, const struct paper_sheet *from, int number)
{
    uint8_t *bytes;
    size_t count;
    enum paper_status status = paper_history_operation(from, number, &bytes, &count);
    if (status != PAPER_OK)
        return status;
    status = paper_sheet_again(f->sheet, bytes, count);
    free(bytes);
    return status;
}

static enum paper_status operation_again(struct film *f, const struct paper_sheet *from,
                                         int number)
{
    struct paper_moment moment;
    void *arguments;
    paper_history_moment(from, number, &moment);
    if (strcmp(moment.what, "step") == 0) {
        enum paper_status status = PAPER_OK;
        for (long i = steps_of(from, number); i > 0 && status == PAPER_OK; i--) {
            status = paper_sheet_step(f->sheet);
            if (status == PAPER_OK)
                status = time_pass(f, 1 / STEPS_A_SECOND);
        }
        return status;
    }
    enum paper_status status = paper_history_arguments(from, number, &arguments);
    if (status != PAPER_OK)
        return status;
    const struct paper_brush *brush = arguments;
    const struct paper_dip *dip = arguments;
    const double seconds = operation_seconds(from, number, 0);
    if (strcmp(moment.what, "brush") == 0)
        f->brushes[brush->number] = *brush;
    else if (strcmp(moment.what, "dip") == 0)
        f->dips[dip->number] = *dip;
    if (seconds > 0 || strcmp(moment.what, "stroke") == 0)
        operation_say(f, moment.what, arguments);
    if (strcmp(moment.what, "stroke") == 0)
        status = stroke_again(f, arguments);
    else {
        status = bytes_again(f, from, number);
        if (status == PAPER_OK)
            status = time_pass(f, seconds);
    }
    paper_history_arguments_free(moment.what, arguments);
    return status;
}

/* ---- the film ---- */

static enum paper_status film_begin(struct film *f, struct paper_sheet *sheet)
{
    f->width = (f->config->width + 1) / 2 * 2;
    f->height = (f->config->height + LINE_PX + 1) / 2 * 2;
    f->rgb = calloc((size_t)f->width * (size_t)f->height, 3);
    if (!f->rgb)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a film's picture");
    for (int i = 0; i < paper_history_done(sheet); i++)
        f->total_s += operation_seconds(sheet, i, steps_of(sheet, i));
    f->speed = fmax(1, f->total_s / f->def->seconds_most);
    if (video_create(f->def->path, f->width, f->height, STUDIO_FILM_FPS, &f->video) !=
        DISPLAY_OK)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "%s", display_error());
    return paper_sheet_create(f->config, &f->sheet);
}

enum paper_status studio_film_write(struct paper_sheet *sheet,
                                    const struct studio_film_def *def, char *written,
                                    size_t room)
{
    struct film *f = calloc(1, sizeof *f);
    if (!f)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a film");
    f->def = def;
    f->config = paper_sheet_get_config(sheet);
    const int count = paper_history_done(sheet);
    enum paper_status status =
        count > 0 ? film_begin(f, sheet)
                  : studio_session_failed(PAPER_BAD_ARGUMENT, "nothing has been painted yet");
    for (int i = 0; i < count && status == PAPER_OK; i++)
        status = operation_again(f, sheet, i);
    say(f, "");
    if (status == PAPER_OK)
        status = time_pass(f, END_S * f->speed);
    if (f->video)
        snprintf(written, room, "%s", video_path(f->video));
    if (status != PAPER_OK)
        video_abandon(f->video);
    else if (video_finish(f->video) != DISPLAY_OK)
        status = studio_session_failed(PAPER_BAD_ARGUMENT, "%s", display_error());
    paper_sheet_destroy(f->sheet);
    paper_screen_destroy(&f->text);
    free(f->rgb);
    free(f);
    return status;
}
