/* stage_recording.c - see stage_recording.h. */
#include "stage_recording.h"

#include <input.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { RECORDING_FPS = 30 };

__attribute__((format(printf, 2, 3))) static void tell(struct stage_recording *r,
                                                       const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->said, sizeof r->said, format, arguments);
    va_end(arguments);
}

/* ---- its end ---- */

static void *ending_run(void *context)
{
    struct stage_ending *e = context;
    e->whole = video_finish_with_sound(e->video, e->sound) == DISPLAY_OK;
    if (!e->whole)
        snprintf(e->why, sizeof e->why, "%s", display_error());
    if (e->sound >= 0)
        close(e->sound);
    e->ended = true;
    return NULL;
}

/* Takes what came of the film that is being ended, which is waited for. */
static void ending_take(struct stage_recording *r)
{
    struct stage_ending *e = &r->ending;
    if (!e->runs)
        return;
    pthread_join(e->thread, NULL);
    e->runs = false;
    if (e->whole)
        tell(r, "%ld pictures in %s%s%s", e->pictures, e->path,
             e->silent[0] ? ", silent: " : "", e->silent);
    else
        tell(r, "%s", e->why);
    snprintf(r->recorded, sizeof r->recorded, "%s", e->whole ? e->path : "");
}

/* -1: there is none; *why: why not, or NULL. */
static int sound_take(struct stage_recording *r, const char **why)
{
    *why = NULL;
    return r->def->sound_end ? r->def->sound_end(r->def->after_context, input_now_s(), why)
                             : -1;
}

static void film_end(struct stage_recording *r)
{
    const char *silent;
    if (!r->video)
        return;
    ending_take(r);
    struct stage_ending *e = &r->ending;
    *e = (struct stage_ending){.video = r->video, .pictures = video_frames(r->video)};
    snprintf(e->path, sizeof e->path, "%s", video_path(r->video));
    e->sound = sound_take(r, &silent);
    snprintf(e->silent, sizeof e->silent, "%s", silent ? silent : "");
    r->video = NULL;
    tell(r, "%s is being ended", e->path);
    e->runs = pthread_create(&e->thread, NULL, ending_run, e) == 0;
    if (!e->runs) { /* no thread: the stage waits */
        ending_run(e);
        tell(r, "%s", e->whole ? e->path : e->why);
        snprintf(r->recorded, sizeof r->recorded, "%s", e->whole ? e->path : "");
    }
}

static void film_abandon(struct stage_recording *r)
{
    const char *why;
    const int sound = sound_take(r, &why);
    if (sound >= 0)
        close(sound);
    video_abandon(r->video);
    r->video = NULL;
}

/* ---- a film ---- */

static void film_begin(struct stage_recording *r, struct stage_renderer *renderer)
{
    struct video_def def = {.path = r->def->record_path,
                            .fps = RECORDING_FPS,
                            .sound = -1,
                            .sounds_later = r->def->sound_end != NULL};
    ending_take(r); /* it may have the same name */
    stage_renderer_size(renderer, &def.width_px, &def.height_px);
    def.width_px &= ~1;
    def.height_px &= ~1;
    if (video_create_as(&def, &r->video) != DISPLAY_OK) {
        tell(r, "%s", display_error());
        return;
    }
    r->began_s = r->next_s = input_now_s();
    if (r->def->sound_begin)
        r->def->sound_begin(r->def->after_context, r->began_s);
    tell(r, "recording to %s", video_path(r->video));
}

void stage_recording_toggle(struct stage_recording *r, const struct stage_window_def *def,
                            struct stage_renderer *renderer)
{
    r->def = def;
    if (r->video)
        film_end(r);
    else
        film_begin(r, renderer);
}

void stage_recording_add(struct stage_recording *r, struct stage_renderer *renderer,
                         double now_s)
{
    if (!r->video || now_s < r->next_s)
        return;
    const int width = r->image.width_px, height = r->image.height_px;
    bool failed = stage_renderer_read(renderer, &r->image) != STAGE_OK;
    if (!failed)
        display_image_make_even(&r->image); /* as films are */
    if (!failed && video_frames(r->video) > 0 &&
        (width != r->image.width_px || height != r->image.height_px)) {
        film_end(r); /* a film has one size */
        return;
    }
    for (; !failed && r->next_s <= now_s; r->next_s += 1.0 / RECORDING_FPS)
        failed = video_add(r->video, r->image.pixels) != DISPLAY_OK;
    if (failed) {
        tell(r, "%s", display_error());
        film_abandon(r);
    }
}

const char *stage_recording_told(struct stage_recording *r)
{
    static char told[sizeof r->said];
    if (r->ending.runs && r->ending.ended)
        ending_take(r);
    if (!r->said[0])
        return NULL;
    memcpy(told, r->said, sizeof told);
    r->said[0] = '\0';
    return told;
}

void stage_recording_end(struct stage_recording *r)
{
    film_end(r);
    ending_take(r);
}

void stage_recording_finish(struct stage_recording *r)
{
    stage_recording_end(r);
    display_image_destroy(&r->image);
}
