/* voice_live.c - see voice_live.h.
 *
 * The last seconds that were heard are a score like a file's, made anew when frames have come,
 * and the picture is its last moment. So what is loudest is the loudest of these seconds. */
#include "voice_live.h"

#include "lutetia.h"
#include "type_common.h"
#include "voice_osc.h"
#include "voice_stream.h"

#include <input.h>
#include <window.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FRAMES_MAX = 1000, PIECE = 4096, WORDS_MAX = 64 };

static const double QUIET =
    0.04; /* of full scale: a room's noise is not made as large as a cry */
static const double FRAME_S = 1 / 60.0;

struct word {
    char *text; /* one of the text's */
    struct voice_words words;
    struct voice_type *type;
};

struct voice_live {
    const struct voice_live_def *def;
    struct microphone *microphone; /* NULL: there is none, and it is looked for */
    double look_s;                 /* when */
    struct voice *voice;
    struct voice_frame frames[FRAMES_MAX];
    int frames_count, attacks;
    bool changed;
    struct voice_score score;
    struct word words[WORDS_MAX];
    int words_count;
    struct voice_type_def type;
    struct display_image image;
    int size_px[2]; /* of a picture */
    struct voice_stream stream;
    struct osc_port *osc; /* NULL: nobody is told */
};

/* ---- what is heard ---- */

static const char *source_of(const char *name)
{
    return strcmp(name, "any") ? name : NULL;
}

static int microphone_begin(const char *source, struct microphone **out)
{
    char why[500];
    return microphone_open(source_of(source), out, why, sizeof why) ? EXIT_SUCCESS
                                                                    : fail("voice", "%s", why);
}

/* Of the microphone that is there now; one that was before may have had another rate. False: no
 * memory. */
static bool hearing_begin(struct voice_live *v)
{
    voice_destroy(v->voice);
    v->voice = NULL;
    v->frames_count = 0;
    return voice_create(&v->def->hearing, microphone_rate_hz(v->microphone), &v->voice);
}

/* A microphone that has gone is told once; one that is not there is looked for once a second.
 * False: no memory. */
static bool microphone_keep(struct voice_live *v)
{
    enum { APART_S = 1 };
    char why[500];
    if (v->microphone && microphone_gone(v->microphone)) {
        tell("voice", "the sound server is gone; it is looked for");
        microphone_close(v->microphone);
        v->microphone = NULL;
        v->look_s = input_now_s() + APART_S;
    }
    if (v->microphone || input_now_s() < v->look_s)
        return true;
    v->look_s = input_now_s() + APART_S;
    if (!microphone_open(source_of(v->def->source), &v->microphone, why, sizeof why))
        return true;
    tell("voice", "a microphone is heard");
    return hearing_begin(v);
}

static bool frames_take(struct voice_live *v)
{
    static float samples[PIECE];
    struct voice_frame f;
    size_t count;
    v->changed = false;
    if (!v->microphone)
        return true;
    while ((count = microphone_take(v->microphone, samples, PIECE)) > 0)
        if (!voice_hear(v->voice, samples, count))
            return false;
    while (voice_next(v->voice, &f)) {
        if (v->frames_count == FRAMES_MAX) { /* the older half is forgotten */
            v->frames_count /= 2;
            memmove(v->frames, v->frames + FRAMES_MAX - v->frames_count,
                    (size_t)v->frames_count * sizeof *v->frames);
        }
        v->frames[v->frames_count++] = f;
        v->attacks += f.attack;
        if (v->osc)
            voice_osc_send(v->osc, &f);
        v->changed = true;
    }
    return true;
}

/* False: no memory. Where nothing is heard the score has no frames. */
static bool score_make(struct voice_live *v)
{
    bool empty;
    voice_score_finish(&v->score);
    if (!voice_score_make(v->frames, v->frames_count, v->def->type.silence, &v->score,
                          &empty)) {
        v->score = (struct voice_score){0};
        return empty;
    }
    v->score.loudest = fmax(v->score.loudest, QUIET);
    v->score.loudest_level = fmax(v->score.loudest_level, QUIET);
    return true;
}

/* ---- words ---- */

static int words_make(struct voice_live *v)
{
    const char *at = v->def->text;
    bool empty;
    while (*(at += strspn(at, " \t\n")) && v->words_count < WORDS_MAX) {
        struct word *w = &v->words[v->words_count];
        const size_t length = strcspn(at, " \t\n");
        w->text = strndup(at, length);
        at += length;
        if (!w->text || !voice_words_make(w->text, &w->words, &empty))
            return fail("voice", "no memory for a text");
        v->words_count++;
    }
    return v->words_count ? EXIT_SUCCESS
                          : fail_usage("voice", "the text is empty: there is nothing to play");
}

/* The most size at which the widest word fits. */
static int size_fit(struct voice_live *v)
{
    struct font_shaper *shaper;
    double widest = 0.1;
    if (v->type.size_px[1] > 0)
        return EXIT_SUCCESS;
    if (font_shaper_create(v->def->face, &shaper) != FONT_OK)
        return fail_font("voice");
    for (int i = 0; i < v->words_count; i++) {
        struct font_layout layout = {0};
        if (font_shaper_layout(shaper, v->words[i].text, strlen(v->words[i].text), 100, NULL,
                               &layout) == FONT_OK)
            widest = fmax(widest, layout.width_px / 100);
        font_layout_finish(&layout);
    }
    font_shaper_destroy(shaper);
    const bool rises = v->type.mapping.feature[TYPE_BASELINE] != VOICE_NOTHING;
    v->type.size_px[1] = fmin(0.92 * v->size_px[0] / widest,
                              v->size_px[1] / (1.15 + (rises ? v->type.rise_em : 0)));
    v->type.size_px[0] = fmin(v->type.size_px[0], v->type.size_px[1]);
    return EXIT_SUCCESS;
}

static int types_make(struct voice_live *v)
{
    int status = size_fit(v);
    for (int i = 0; i < v->words_count && status == EXIT_SUCCESS; i++)
        if (voice_type_create(&v->type, v->def->face, &v->words[i].words, NULL, &v->score,
                              &v->words[i].type) != FONT_OK)
            status = fail_font("voice");
    return status;
}

/* ---- a window ---- */

static int moment_draw(struct voice_live *v)
{
    struct font_picture picture = type_picture(&v->image);
    const int word = v->attacks > 0 ? (v->attacks - 1) % v->words_count : 0;
    if (!score_make(v))
        return fail("voice", "no memory for what is heard");
    if (v->score.count == 0) { /* paper alone */
        for (int y = 0; y < picture.height_px; y++)
            for (int x = 0; x < picture.width_px; x++)
                for (int c = 0; c < 3; c++)
                    picture.rgb[y * picture.pitch + 3 * x + c] =
                        (uint8_t)lround(255 * v->type.paper[c]);
        return EXIT_SUCCESS;
    }
    return voice_type_moment(v->words[word].type, v->frames[v->frames_count - 1].time_s,
                             &picture) == FONT_OK
               ? EXIT_SUCCESS
               : fail_font("voice");
}

static int window_run(struct voice_live *v, struct window *window)
{
    struct input_event event;
    int status = EXIT_SUCCESS;
    while (status == EXIT_SUCCESS && !window_closing(window) && !interrupted()) {
        const double due_s =
            input_now_s() + (v->stream.stream ? fmin(FRAME_S, 1 / v->stream.def.fps) : FRAME_S);
        if (!microphone_keep(v) || !frames_take(v))
            status = fail("voice", "no memory for what is heard");
        if (status == EXIT_SUCCESS && v->changed)
            status = moment_draw(v);
        if (status == EXIT_SUCCESS && v->changed &&
            window_show(window, &v->image) != DISPLAY_OK)
            status = fail("voice", "%s", display_error());
        if (status == EXIT_SUCCESS)
            status = voice_stream_take(&v->stream, &v->image, input_now_s());
        while (window_input_take(window, fmax(0, due_s - input_now_s()), &event))
            if (event.kind == INPUT_KEY_DOWN && event.key == INPUT_KEY_ESCAPE)
                window_close(window);
    }
    return status;
}

/* One that is not there yet is told, and looked for. */
static int microphone_first(struct voice_live *v)
{
    char why[500];
    if (!microphone_open(source_of(v->def->source), &v->microphone, why, sizeof why)) {
        tell("voice", "%s; it is looked for", why);
        return EXIT_SUCCESS;
    }
    return hearing_begin(v) ? EXIT_SUCCESS : fail("voice", "no memory for a voice");
}

static int window_open(struct voice_live *v)
{
    struct window_config config = window_config_default();
    struct window *window;
    config.title = "voice";
    config.width_px = v->def->picture[0];
    config.height_px = v->def->picture[1];
    config.screen = v->def->screen;
    const enum display_status opened = window_create(&config, &window);
    if (opened == DISPLAY_BAD_ARGUMENT)
        return fail("voice", "%s", display_error());
    if (opened != DISPLAY_OK)
        return fail("voice",
                    "%s; run it where there is a desktop, or record: --seconds 5 --poster FILE",
                    display_error());
    int status = moment_draw(v);
    if (status == EXIT_SUCCESS && window_show(window, &v->image) != DISPLAY_OK)
        status = fail("voice", "%s", display_error());
    if (status == EXIT_SUCCESS && v->def->stream)
        status = voice_stream_open(&v->stream);
    if (status == EXIT_SUCCESS)
        status = microphone_first(v);
    if (status == EXIT_SUCCESS)
        status = window_run(v, window);
    voice_stream_close(&v->stream);
    window_destroy(window);
    return status;
}

int voice_live_window(const struct voice_live_def *def)
{
    struct voice_live *v = calloc(1, sizeof *v);
    if (!v)
        return fail("voice", "no memory for a voice");
    v->def = def;
    v->type = def->type;
    memcpy(v->size_px, def->picture, sizeof v->size_px);
    int status = words_make(v);
    if (status == EXIT_SUCCESS && def->stream)
        status = voice_stream_read(def->stream, v->size_px, &v->stream);
    if (status == EXIT_SUCCESS)
        status = types_make(v);
    if (status == EXIT_SUCCESS && !microphone_known(source_of(def->source)))
        status = microphone_begin(def->source, &v->microphone); /* says which there are */
    if (status == EXIT_SUCCESS)
        status = type_image_create("voice", v->size_px[0], v->size_px[1], &v->image);
    if (status == EXIT_SUCCESS && def->osc_to)
        status = voice_osc_open(def->osc_to, &v->osc);
    if (status == EXIT_SUCCESS)
        status = window_open(v);
    for (int i = 0; i < WORDS_MAX; i++) {
        voice_type_destroy(v->words[i].type);
        voice_words_finish(&v->words[i].words);
        free(v->words[i].text);
    }
    voice_score_finish(&v->score);
    voice_destroy(v->voice);
    display_image_destroy(&v->image);
    microphone_close(v->microphone);
    osc_port_close(v->osc);
    free(v);
    return status;
}

/* Whoever ends it early, or a server that goes away, leaves what was heard until then. */
static int record(struct microphone *microphone, double seconds, struct voice_sound *out)
{
    enum { WAIT_US = 10000 };
    const double least_s = 0.1;
    const char *why = NULL;
    const double began_s = seconds_now();
    out->rate_hz = microphone_rate_hz(microphone);
    const size_t wanted = (size_t)(seconds * out->rate_hz) + 1;
    out->samples = malloc(wanted * sizeof *out->samples);
    if (!out->samples)
        return fail("voice", "no memory for %g seconds of sound", seconds);
    while (out->count < wanted && !why) {
        const bool gone = microphone_gone(microphone);
        out->count +=
            microphone_take(microphone, out->samples + out->count, wanted - out->count);
        if (interrupted())
            why = "interrupted";
        else if (gone)
            why = "the sound server is gone";
        else if (seconds_now() > began_s + seconds + 5)
            why = "the microphone gives no sound";
        else
            usleep(WAIT_US);
    }
    const double heard_s = (double)out->count / out->rate_hz;
    if (!why || out->count >= wanted)
        return EXIT_SUCCESS;
    if (heard_s < least_s)
        return interrupted() ? EXIT_INTERRUPTED : fail("voice", "%s", why);
    interrupt_forget(); /* it ended the recording, and not what is made of it */
    tell("voice", "%s: %.1f of %g s were heard, and are kept", why, heard_s, seconds);
    return EXIT_SUCCESS;
}

int voice_live_record(const char *source, double seconds, struct voice_sound *out)
{
    struct microphone *microphone = NULL;
    int status = microphone_begin(source, &microphone);
    if (status == EXIT_SUCCESS)
        status = record(microphone, seconds, out);
    microphone_close(microphone);
    return status;
}
