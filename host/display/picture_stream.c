/* picture_stream.c - see picture_stream.h.
 *
 * There are three images: the caller's, the one that waits, and the one that is being sent.
 * Putting exchanges the first two, sending the last two, so that a lock is held for as long as
 * a pointer is exchanged. */
#include "picture_stream_internal.h"

#include "display_internal.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RETRY_S = 1, USUAL_FPS = 30, LINE_BYTES = 300 };

struct picture_stream {
    struct picture_stream_def def;
    const struct picture_way *way;
    void *own; /* NULL: interrupted */
    pthread_t thread;
    bool begun; /* the thread and what it shares are there */
    struct display_image sent;
    double retry_s;

    pthread_mutex_t lock;
    pthread_cond_t come;
    /* under the lock */
    struct display_image waiting;
    bool fresh, over;
    char said[LINE_BYTES];
    bool said_is_new;

    char told[LINE_BYTES]; /* the caller's copy */
};

/* ---- words ---- */

/* WIDTHxHEIGHT, or FPS. False: neither. */
static bool part_read(const char *part, struct picture_stream_def *def)
{
    int width, height, end = 0;
    double fps;
    if (sscanf(part, "%5dx%5d%n", &width, &height, &end) == 2 && !part[end]) {
        def->width_px = width;
        def->height_px = height;
        return width > 0 && height > 0;
    }
    if (sscanf(part, "%lf%n", &fps, &end) == 1 && !part[end] && fps > 0) {
        def->fps = fps;
        return true;
    }
    return false;
}

static enum display_status def_check(const struct picture_stream_def *def)
{
    if (def->width_px > PICTURE_STREAM_SIDE_MAX || def->height_px > PICTURE_STREAM_SIDE_MAX ||
        def->width_px % 2 || def->height_px % 2)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "a stream's sides are even, 2..%d pixels (got %dx%d)",
                            PICTURE_STREAM_SIDE_MAX, def->width_px, def->height_px);
    if (!(def->fps >= 1 && def->fps <= PICTURE_STREAM_FPS_MAX))
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "a stream has 1..%d pictures a second (got %g)",
                            PICTURE_STREAM_FPS_MAX, def->fps);
    return DISPLAY_OK;
}

enum display_status picture_stream_read(const char *text, struct picture_stream_def *def)
{
    char copy[200], *rest = copy;
    *def = (struct picture_stream_def){.fps = USUAL_FPS};
    snprintf(copy, sizeof copy, "%s", text);
    const char *to = strsep(&rest, ",");
    bool ok = strlen(text) < sizeof copy && strlen(to) < sizeof def->to &&
              (to[0] == '/' || strcmp(to, "pipewire") == 0);
    for (int i = 0; ok && rest; i++)
        ok = i < 2 && part_read(strsep(&rest, ","), def);
    if (!ok)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "a stream goes to pipewire, or to a device's path, "
                            "with ,WIDTHxHEIGHT and ,FPS where wanted: "
                            "/dev/video9,1280x720,30 (got '%.60s')",
                            text);
    snprintf(def->to, sizeof def->to, "%s", to);
    return def_check(def);
}

/* ---- the thread ---- */

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void say(struct picture_stream *s, const char *what, const char *why)
{
    pthread_mutex_lock(&s->lock);
    snprintf(s->said, sizeof s->said, "%.40s: %.200s", what, why);
    s->said_is_new = true;
    pthread_mutex_unlock(&s->lock);
}

static void picture_send(struct picture_stream *s)
{
    char why[LINE_BYTES] = "";
    if (!s->own) {
        if (now_s() < s->retry_s)
            return;
        s->retry_s = now_s() + RETRY_S;
        if (!s->way->open(&s->def, &s->own, why, sizeof why))
            return;
        say(s, "the stream goes on", s->def.to);
    }
    if (s->way->send(s->own, &s->sent, why, sizeof why))
        return;
    s->way->close(s->own);
    s->own = NULL;
    s->retry_s = now_s() + RETRY_S;
    say(s, "the stream is interrupted", why);
}

static void images_swap(struct display_image *a, struct display_image *b)
{
    const struct display_image was = *a;
    *a = *b;
    *b = was;
}

static void *pictures_send(void *context)
{
    struct picture_stream *s = context;
    pthread_mutex_lock(&s->lock);
    for (;;) {
        while (!s->fresh && !s->over)
            pthread_cond_wait(&s->come, &s->lock);
        if (s->over)
            break;
        images_swap(&s->waiting, &s->sent);
        s->fresh = false;
        pthread_mutex_unlock(&s->lock);
        picture_send(s);
        pthread_mutex_lock(&s->lock);
    }
    pthread_mutex_unlock(&s->lock);
    return NULL;
}

/* ---- a stream ---- */

static enum display_status images_make(struct picture_stream *s)
{
    s->sent = s->waiting = (struct display_image){.width_px = s->def.width_px,
                                                  .height_px = s->def.height_px,
                                                  .channels = s->def.alpha ? 4 : 3};
    const enum display_status status = display_image_create(&s->sent);
    return status == DISPLAY_OK ? display_image_create(&s->waiting) : status;
}

enum display_status picture_stream_open(const struct picture_stream_def *def,
                                        struct picture_stream **out)
{
    char why[LINE_BYTES] = "";
    *out = NULL;
    enum display_status status = def_check(def);
    if (status == DISPLAY_OK && (def->width_px < 2 || def->height_px < 2))
        status = display_fail(DISPLAY_BAD_ARGUMENT, "a stream has a size");
    if (status != DISPLAY_OK)
        return status;
    struct picture_stream *s = calloc(1, sizeof *s);
    if (!s)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a stream");
    s->def = *def;
    s->way = def->to[0] == '/' ? &picture_way_v4l2 : &picture_way_pipewire;
    status = images_make(s);
    if (status == DISPLAY_OK && !s->way->open(def, &s->own, why, sizeof why))
        status = display_fail(DISPLAY_IO_FAILED, "%s", why);
    if (status == DISPLAY_OK) {
        pthread_mutex_init(&s->lock, NULL);
        pthread_cond_init(&s->come, NULL);
        s->begun = pthread_create(&s->thread, NULL, pictures_send, s) == 0;
        if (!s->begun)
            status = display_fail(DISPLAY_NO_MEMORY, "no thread for a stream");
    }
    if (status == DISPLAY_OK)
        *out = s;
    else
        picture_stream_close(s);
    return status;
}

void picture_stream_close(struct picture_stream *s)
{
    if (!s)
        return;
    if (s->begun) {
        pthread_mutex_lock(&s->lock);
        s->over = true;
        pthread_cond_signal(&s->come);
        pthread_mutex_unlock(&s->lock);
        pthread_join(s->thread, NULL);
        pthread_mutex_destroy(&s->lock);
        pthread_cond_destroy(&s->come);
    }
    if (s->own)
        s->way->close(s->own);
    display_image_destroy(&s->sent);
    display_image_destroy(&s->waiting);
    free(s);
}

enum display_status picture_stream_put(struct picture_stream *s, struct display_image *image)
{
    if (image->width_px != s->def.width_px || image->height_px != s->def.height_px ||
        image->channels != (s->def.alpha ? 4 : 3) || !image->pixels)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "the stream's pictures have %dx%d pixels with %d channels "
                            "(got %dx%d with %d)",
                            s->def.width_px, s->def.height_px, s->def.alpha ? 4 : 3,
                            image->width_px, image->height_px, image->channels);
    pthread_mutex_lock(&s->lock);
    images_swap(image, &s->waiting);
    s->fresh = true;
    pthread_cond_signal(&s->come);
    pthread_mutex_unlock(&s->lock);
    return DISPLAY_OK;
}

const char *picture_stream_said(struct picture_stream *s)
{
    pthread_mutex_lock(&s->lock);
    const bool is_new = s->said_is_new;
    if (is_new)
        memcpy(s->told, s->said, sizeof s->told);
    s->said_is_new = false;
    pthread_mutex_unlock(&s->lock);
    return is_new ? s->told : NULL;
}
