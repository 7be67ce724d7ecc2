/* verb_voice.c - `lutetia voice`: letters that a voice plays: poster, moments, frames, film. */
#include "help.h"
#include "live.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"
#include "voice_live.h"
#include "voice_poster.h"
#include "voice_table.h"
#include <visible_text.h>

#include <display.h>
#include <output_file.h>
#include <video.h>
#include <voice.h>
#include <voice_align.h>
#include <voice_cry.h>
#include <voice_picture.h>
#include <voice_sound.h>

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { SHEET_COLUMNS = 5, SHEET_ROWS = 4, LABEL_PX = 11 };

struct voice_work {
    const char *sound_path, *text, *font, *edits, *axes, *map;
    const char *poster, *sheet, *envelope, *still, *frames, *video;
    const char *microphone, *transcript, *features, *screen, *stream, *osc_to;
    double seconds;
    bool cry;
    double size_px[2], rise_em, slant, paper[3], inks[9], second_px, line_px, at_s;
    int picture[2], fps;
    struct voice_type_def def;
    struct voice_def hearing;
    /* made */
    struct voice_sound sound;
    struct voice_frame *heard;
    int heard_count;
    struct voice_score score;
    struct voice_words words;
    struct voice_transcript cues;
    struct voice_timing timing;
    struct font_face *face;
};

static bool pictures_wanted(const struct voice_work *w)
{
    return w->poster || w->sheet || w->envelope || w->still || w->frames || w->video;
}

/* How many words the command line has: a sound, unless another is given; a text, unless there
 * is a transcript. */
static int words_take(struct voice_work *w, const struct option_words *words)
{
    const bool heard = !w->cry && !w->microphone, written = !w->transcript,
               needed = written && (pictures_wanted(w) || !w->features);
    if (w->cry && w->microphone)
        return fail_usage("voice", "--cry or --microphone, not both");
    if (w->transcript && !heard)
        return fail_usage("voice", "a transcript is of a sound in a file: give that");
    if (words->count < heard + needed)
        return fail_usage("voice", !heard    ? "give a text"
                                   : !needed ? "give a sound"
                                             : "give a sound and a text");
    if (words->count > heard + written)
        return fail_usage("voice", "there is one %s; put it in quotes (then came '%.60s')",
                          !heard     ? "text, and no sound with --cry or --microphone"
                          : !written ? "sound, and its text is in the transcript"
                                     : "sound and one text",
                          words->words[words->count - 1]);
    w->sound_path = heard ? words->words[0] : NULL;
    w->text = written && words->count > heard ? words->words[words->count - 1] : NULL;
    if (w->picture[0] % 2 || w->picture[1] % 2)
        return fail_usage("voice", "--picture must be even (got %dx%d)", w->picture[0],
                          w->picture[1]);
    if (w->size_px[1] > 0 && w->size_px[1] < w->size_px[0])
        return fail_usage("voice", "--size is the least and the most (got %g,%g)",
                          w->size_px[0], w->size_px[1]);
    char why[200];
    if (w->map && !voice_mapping_read(&w->def.mapping, w->map, why, sizeof why))
        return fail_usage("voice", "--map: %s", why);
    if (!w->microphone && !w->features && !pictures_wanted(w))
        w->poster = "out.png";
    return EXIT_SUCCESS;
}

#define POSTER "poster|!sheet+!envelope+!still+!frames+!video+!features+!microphone"
#define HEARD "microphone+!poster+!sheet+!envelope+!still+!frames+!video+!features"

/* With what an option has an effect. The poster is made where no other picture is asked for. */
static const struct option_need needs[] = {{"at", "still"},
                                           {"fps", "video|frames"},
                                           {"seconds", "microphone"},
                                           {"rise", "map"},
                                           {"slant", "map"},
                                           {"second", POSTER},
                                           {"line", POSTER},
                                           {"screen", HEARD},
                                           {"stream", HEARD},
                                           {"osc-to", HEARD},
                                           {0}};

static int options_read(struct voice_work *w, int argc, char **argv, bool *help)
{
    const struct option_row rows[] = {
        {"poster", 'o', OPTION_PNG, "FILE", "lines along which time runs, PNG (out.png)",
         &w->poster, 0, 0, 0},
        {"sheet", 0, OPTION_PNG, "FILE", "twenty moments of it, PNG", &w->sheet, 0, 0, 0},
        {"envelope", 0, OPTION_PNG, "FILE", "a plot of how loud it is, PNG", &w->envelope, 0, 0,
         0},
        {"still", 0, OPTION_PNG, "FILE", "the moment --at, PNG", &w->still, 0, 0, 0},
        {"at", 0, OPTION_NUMBER, "S", "the moment of --still (where it is loudest)", &w->at_s,
         0, VOICE_SECONDS_MAX, 0},
        {"frames", 0, OPTION_TEXT, "DIR", "all moments as numbered pictures in this folder",
         &w->frames, 0, 0, 0},
        {"video", 0, OPTION_TEXT, "FILE", "a film with the voice in it (.mp4, .webm, ...)",
         &w->video, 0, 0, 0},
        {"fps", 0, OPTION_INTEGER, "N", "frames a second of the film (30)", &w->fps, 1, 240, 0},
        {"picture", 0, OPTION_SIZE, "WxH", "size of a moment, even (960x540)", w->picture, 2,
         8192, 0},
        {"cry", 0, OPTION_FLAG, NULL,
         "hear a cry of the program's own making, in place of a file", &w->cry, 0, 0, 0},
        {"microphone", 0, OPTION_TEXT, "jack|pulse|any",
         "hear a microphone, in place of a file: in a window, or for --seconds", &w->microphone,
         0, 0, 0},
        LIVE_SCREEN_OPTION(&w->screen),
        LIVE_STREAM_OPTION(&w->stream),
        {"osc-to", 0, OPTION_TEXT, "ADDRESS:PORT",
         "send what is heard in the window there by OSC, or to a PORT", &w->osc_to, 0, 0, 0},
        {"features", 0, OPTION_TEXT, "FILE.csv", "what is heard, as a table; needs no text",
         &w->features, 0, 0, 0},
        {"seconds", 0, OPTION_NUMBER, "S", "how long a microphone is heard (5)", &w->seconds,
         0.5, 1800, 0},
        {"transcript", 0, OPTION_TEXT, "FILE",
         "the text, with its times in the sound: subtitles, SRT or WebVTT", &w->transcript, 0,
         0, 0},
        {"map", 0, OPTION_TEXT, "P=F,..",
         "which property is tied to which feature (size=envelope)", &w->map, 0, 0, 0},
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (EBGaramond12-Regular)", &w->font, 0,
         0, 0},
        TYPE_EDITS_OPTION(&w->edits),
        {"axes", 0, OPTION_TEXT, "A=V,..", "positions of a variable font's axes: wght=700",
         &w->axes, 0, 0, 0},
        {"size", 0, OPTION_NUMBERS, "PX,PX", "least and most size of the em (as fits)",
         w->size_px, 0, 4000, 2},
        {"rise", 0, OPTION_NUMBER, "EM", "how far the baseline is played (0.6)", &w->rise_em, 0,
         10, 0},
        {"slant", 0, OPTION_NUMBER, "S",
         "the most slant, pixels to the right for each up (0.4)", &w->slant, -2, 2, 0},
        {"second", 0, OPTION_NUMBER, "PX", "length of a second on the poster (480)",
         &w->second_px, 10, 20000, 0},
        {"line", 0, OPTION_NUMBER, "PX", "the longest line of the poster (as fits)",
         &w->line_px, 100, DISPLAY_SIDE_MAX, 0},
        {"paper", 0, OPTION_NUMBERS, "R,G,B", "colour of the paper, each 0..1 (1,1,1)",
         w->paper, 0, 1, 3},
        {"inks", 0, OPTION_NUMBERS, "R,G,B,R,G,B",
         "colour of the ink, and of the one at a feature's end", w->inks, 0, 1, 6},
        {0}};
    struct option_words words;
    if (!options_parse("voice", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("voice", rows, NULL);
    return options_effects("voice", rows, needs, &words) ? words_take(w, &words) : EXIT_USAGE;
}

/* ---- hearing ---- */

static int sound_take(struct voice_work *w)
{
    char why[300];
    if (w->microphone)
        return voice_live_record(w->microphone, w->seconds, &w->sound);
    if (!w->cry)
        return voice_sound_read(w->sound_path, &w->sound, why, sizeof why)
                   ? EXIT_SUCCESS
                   : fail("voice", "%s", why);
    struct voice_cry cry = voice_cry_default();
    w->sound.rate_hz = cry.rate_hz;
    w->sound.samples = voice_cry_make(&cry, &w->sound.count);
    return w->sound.samples ? EXIT_SUCCESS : fail("voice", "no memory for a cry");
}

/* Finds when the text's words are said. */
static int text_hear(struct voice_work *w)
{
    bool empty;
    if (!voice_words_make(w->text, &w->words, &empty))
        return empty ? fail_usage("voice", "the text is empty: there is nothing to play")
                     : fail("voice", "no memory");
    const bool known = w->transcript != NULL;
    return (known ? voice_align_cues(&w->words, &w->cues, w->heard, w->heard_count,
                                     w->hearing.silence, &w->timing)
                  : voice_align(&w->words, w->heard, w->heard_count, w->hearing.silence,
                                &w->timing))
               ? EXIT_SUCCESS
               : fail("voice", "no memory for the times of words");
}

static int transcript_take(struct voice_work *w)
{
    char why[300];
    if (!w->transcript)
        return EXIT_SUCCESS;
    if (!voice_transcript_read(w->transcript, &w->cues, why, sizeof why))
        return fail("voice", "%s", why);
    w->text = w->cues.text;
    return EXIT_SUCCESS;
}

static int hear(struct voice_work *w)
{
    bool empty;
    int status = transcript_take(w);
    if (status == EXIT_SUCCESS)
        status = sound_take(w);
    if (status != EXIT_SUCCESS)
        return status;
    if (!voice_frames(&w->hearing, w->sound.samples, w->sound.count, w->sound.rate_hz,
                      &w->heard, &w->heard_count))
        return fail("voice", "no memory for the sound");
    if (w->features)
        status = voice_table_write(w->features, w->heard, w->heard_count);
    if (status != EXIT_SUCCESS || !pictures_wanted(w))
        return status;
    if (!voice_score_make(w->heard, w->heard_count, w->def.silence, &w->score, &empty))
        return empty ? fail("voice", "%s: nothing can be heard in it",
                            w->sound_path ? w->sound_path : "the microphone")
                     : fail("voice", "no memory for the sound");
    return text_hear(w);
}

/* ---- type ---- */

/* The largest size at which the widest text fits the picture. */
static int size_fit(struct voice_work *w)
{
    struct font_shaper *shaper;
    double widest = 0.1;
    if (font_shaper_create(w->face, &shaper) != FONT_OK)
        return fail_font("voice");
    for (int i = 0; i < w->words.count; i++) {
        struct font_layout layout = {0};
        int begin, end;
        voice_word_bytes(&w->words, i, &begin, &end);
        if (font_shaper_layout(shaper, w->text + begin, (size_t)(end - begin), 100, NULL,
                               &layout) == FONT_OK)
            widest = fmax(widest, layout.width_px / 100);
        font_layout_finish(&layout);
    }
    font_shaper_destroy(shaper);
    double rise = w->def.mapping.feature[TYPE_BASELINE] != VOICE_NOTHING ? w->rise_em : 0;
    w->size_px[1] = fmin(0.92 * w->picture[0] / widest, w->picture[1] / (1.15 + rise));
    w->size_px[0] = fmin(w->size_px[0], w->size_px[1]);
    return EXIT_SUCCESS;
}

static void type_def_take(struct voice_work *w)
{
    memcpy(w->def.size_px, w->size_px, sizeof w->size_px);
    w->def.rise_em = w->rise_em;
    w->def.slant = w->slant;
    memcpy(w->def.paper, w->paper, sizeof w->paper);
    memcpy(w->def.inks, w->inks, 6 * sizeof *w->inks);
}

static int face_take(struct voice_work *w)
{
    int status = type_face_open("voice", w->font, 0, w->axes, false, &w->face);
    if (status != EXIT_SUCCESS)
        return status;
    if (w->def.mapping.feature[TYPE_WEIGHT] != VOICE_NOTHING &&
        !type_axis_there(w->face, "wght"))
        return fail_usage("voice",
                          "%s has no axis of weight to play; choose a variable font with wght",
                          w->font);
    if (w->def.mapping.feature[TYPE_WIDTH] != VOICE_NOTHING &&
        !type_axis_there(w->face, "wdth"))
        return fail_usage("voice",
                          "%s has no axis of width to play; choose a variable font with wdth",
                          w->font);
    type_text_check("voice", w->font, w->face, w->text);
    return EXIT_SUCCESS;
}

static int type_prepare(struct voice_work *w)
{
    int status = face_take(w);
    if (status == EXIT_SUCCESS && w->size_px[1] == 0)
        status = size_fit(w);
    type_def_take(w);
    return status;
}

/* While it is heard. */
static int live_play(struct voice_work *w)
{
    struct voice_live_def def = {.source = w->microphone,
                                 .text = w->text,
                                 .hearing = w->hearing,
                                 .picture = {w->picture[0], w->picture[1]},
                                 .screen = w->screen,
                                 .stream = w->stream,
                                 .osc_to = w->osc_to};
    int status = face_take(w);
    type_def_take(w);
    def.face = w->face;
    def.type = w->def;
    return status == EXIT_SUCCESS ? voice_live_window(&def) : status;
}

static int player_make(const struct voice_work *w, double scale, struct voice_type **out)
{
    struct voice_type_def def = w->def;
    def.size_px[0] *= scale;
    def.size_px[1] *= scale;
    return voice_type_create(&def, w->face, &w->words, &w->timing, &w->score, out) == FONT_OK
               ? EXIT_SUCCESS
               : fail_font("voice");
}

/* ---- pictures ---- */

static int poster_write(const struct voice_work *w)
{
    const bool rises = w->def.mapping.feature[TYPE_BASELINE] != VOICE_NOTHING;
    const struct voice_poster_def def = {.path = w->poster,
                                         .size_px = w->size_px[1],
                                         .rise_px = rises ? w->rise_em * w->size_px[1] : 0,
                                         .second_px = w->second_px,
                                         .line_px = w->line_px};
    struct voice_type *type;
    int status = player_make(w, 1, &type);
    if (status == EXIT_SUCCESS)
        status = voice_poster_write(type, &def);
    voice_type_destroy(type);
    return status;
}

/* A part of an image as a picture of its own. */
static struct font_picture part_of(const struct display_image *image, int x, int y, int width,
                                   int height)
{
    return (struct font_picture){width, height, 3 * image->width_px,
                                 image->pixels +
                                     3 * ((size_t)y * (size_t)image->width_px + (size_t)x)};
}

static int sheet_write_moments(const struct voice_work *w)
{
    enum { CELL = 256, GAP = 16, COUNT = SHEET_COLUMNS * SHEET_ROWS };
    struct voice_type *type;
    struct display_image image = {0};
    struct type_labels *labels = type_labels_create(LABEL_PX);
    int height = (int)fmax(2, round((double)CELL * w->picture[1] / w->picture[0]));
    int pitch = height + GAP + LABEL_PX;
    int status = player_make(w, (double)CELL / w->picture[0], &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("voice", GAP + SHEET_COLUMNS * (CELL + GAP),
                                   GAP + SHEET_ROWS * pitch, &image);
    for (int i = 0; i < COUNT && status == EXIT_SUCCESS; i++) {
        int x = GAP + i % SHEET_COLUMNS * (CELL + GAP), y = GAP + i / SHEET_COLUMNS * pitch;
        double begin_s = w->score.begin_s[0],
               time_s = begin_s + (i + 0.5) / COUNT * (w->score.end_s - begin_s);
        struct font_picture picture = part_of(&image, x, y, CELL, height);
        if (voice_type_moment(type, time_s, &picture) != FONT_OK)
            status = fail_font("voice");
        type_label(labels, &image, x, y + height + LABEL_PX, "%.2f s", time_s);
    }
    if (status == EXIT_SUCCESS)
        status = type_image_write("voice", w->sheet, &image);
    type_labels_destroy(labels);
    display_image_destroy(&image);
    voice_type_destroy(type);
    return status;
}

static int envelope_write(const struct voice_work *w)
{
    enum { WIDTH = 1200, HEIGHT = 320, MARGIN = 28 };
    struct voice_type *type;
    struct display_image image = {0};
    struct type_labels *labels = type_labels_create(LABEL_PX);
    int status = player_make(w, 1, &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("voice", WIDTH, HEIGHT, &image);
    if (status == EXIT_SUCCESS) {
        struct font_picture picture = type_picture(&image);
        voice_type_envelope(type, MARGIN, &picture);
        double seconds = w->score.seconds, step = seconds > 20 ? 5 : seconds > 4 ? 1 : 0.25;
        for (double t = 0; t <= seconds; t += step)
            type_label(labels, &image, MARGIN + (WIDTH - 2 * MARGIN) * t / seconds,
                       HEIGHT - MARGIN / 2, "%g s", t);
        status = type_image_write("voice", w->envelope, &image);
    }
    type_labels_destroy(labels);
    display_image_destroy(&image);
    voice_type_destroy(type);
    return status;
}

static double loudest_at(const struct voice_score *score)
{
    double time_s = 0, loudest = -1;
    for (int i = 0; i < score->count; i++)
        if (score->frames[i].envelope > loudest) {
            loudest = score->frames[i].envelope;
            time_s = score->frames[i].time_s;
        }
    return time_s;
}

/* ---- a film ---- */

/* The sound as a WAV file in memory; -1: none. */
static int sound_in_memory(const struct voice_work *w)
{
    int descriptor = memfd_create("voice", MFD_CLOEXEC);
    if (descriptor >= 0 && voice_sound_write(descriptor, &w->sound))
        return descriptor;
    if (descriptor >= 0)
        close(descriptor);
    return -1;
}

static int film_begin(const struct voice_work *w, struct video **out)
{
    *out = NULL;
    if (!w->video)
        return EXIT_SUCCESS;
    int sound = sound_in_memory(w);
    if (sound < 0)
        return fail("voice", "no memory for the sound of a film");
    enum display_status status =
        video_create_with_sound(w->video, w->picture[0], w->picture[1], w->fps, sound, out);
    close(sound);
    return status == DISPLAY_OK ? EXIT_SUCCESS : fail("voice", "%s", display_error());
}

/* If the film's format has no sound, the sound is a file beside it: film.y4m and film.wav. */
static int film_end_sound(const struct voice_work *w, const char *film)
{
    char path[PATH_MAX];
    struct output_file out;
    const char *dot = strrchr(film, '.');
    snprintf(path, sizeof path, "%.*s.wav", (int)(dot ? dot - film : (long)strlen(film)), film);
    if (!output_file_open(&out, path))
        return fail("voice", "%s: cannot write: %s", path, out.why);
    if (!voice_sound_write(fileno(out.stream), &w->sound)) {
        int error = errno;
        output_file_abandon(&out);
        return fail("voice", "%s: cannot write: %s", path, output_file_explain(error));
    }
    if (!output_file_commit(&out))
        return fail("voice", "%s: cannot write: %s", path, out.why);
    visible_say("lutetia voice: %s has no sound in it; that is %s", film, path);
    return EXIT_SUCCESS;
}

static int film_end(const struct voice_work *w, struct video *video, int status)
{
    if (!video)
        return status;
    if (status != EXIT_SUCCESS) {
        video_abandon(video);
        return status;
    }
    char path[PATH_MAX];
    bool sounds = video_sounds(video);
    snprintf(path, sizeof path, "%s", video_path(video));
    if (video_finish(video) != DISPLAY_OK)
        return fail("voice", "%s", display_error());
    return sounds ? EXIT_SUCCESS : film_end_sound(w, path);
}

static int frame_write(const struct voice_work *w, long number,
                       const struct display_image *image)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/voice-%06ld.png", w->frames, number);
    return type_image_write("voice", path, image);
}

static int moments_film(const struct voice_work *w)
{
    struct voice_type *type = NULL;
    struct display_image image = {0};
    struct video *video = NULL;
    int count = (int)floor((double)w->sound.count / w->sound.rate_hz * w->fps) + 1;
    int status = w->frames ? folder_make("voice", w->frames) : EXIT_SUCCESS;
    if (status == EXIT_SUCCESS)
        status = player_make(w, 1, &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("voice", w->picture[0], w->picture[1], &image);
    if (status == EXIT_SUCCESS)
        status = film_begin(w, &video);
    struct font_picture picture = type_picture(&image);
    struct progress progress = progress_begin("frame", count);
    for (int i = 0; i < count && status == EXIT_SUCCESS; i++) {
        progress_show(&progress, i);
        if (interrupted())
            status = EXIT_INTERRUPTED;
        else if (voice_type_moment(type, (i + 0.5) / w->fps, &picture) != FONT_OK)
            status = fail_font("voice");
        if (status == EXIT_SUCCESS && w->frames)
            status = frame_write(w, i, &image);
        if (status == EXIT_SUCCESS && video && video_add(video, image.pixels) != DISPLAY_OK)
            status = fail("voice", "%s", display_error());
    }
    progress_end(&progress);
    status = film_end(w, video, status);
    display_image_destroy(&image);
    voice_type_destroy(type);
    return status;
}

static int still_write(const struct voice_work *w)
{
    struct voice_type *type = NULL;
    struct display_image image = {0};
    int status = player_make(w, 1, &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("voice", w->picture[0], w->picture[1], &image);
    struct font_picture picture = type_picture(&image);
    if (status == EXIT_SUCCESS &&
        voice_type_moment(type, w->at_s < 0 ? loudest_at(&w->score) : w->at_s, &picture) !=
            FONT_OK)
        status = fail_font("voice");
    if (status == EXIT_SUCCESS)
        status = type_image_write("voice", w->still, &image);
    display_image_destroy(&image);
    voice_type_destroy(type);
    return status;
}

static int pictures_write(struct voice_work *w)
{
    int status = hear(w);
    if (status != EXIT_SUCCESS || !pictures_wanted(w)) /* a table alone */
        return status;
    status = type_prepare(w);
    const struct {
        const char *path;
        int (*write)(const struct voice_work *);
    } pictures[] = {{w->poster, poster_write},
                    {w->sheet, sheet_write_moments},
                    {w->envelope, envelope_write},
                    {w->still, still_write},
                    {w->frames ? w->frames : w->video, moments_film}};
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures && status == EXIT_SUCCESS; i++)
        if (pictures[i].path)
            status = pictures[i].write(w);
    return status;
}

int verb_voice(int argc, char **argv)
{
    static struct voice_work w;
    bool help = false;
    w = (struct voice_work){.size_px = {8, 0},
                            .rise_em = 0.6,
                            .slant = 0.4,
                            .paper = {1, 1, 1},
                            .second_px = 480,
                            .at_s = -1,
                            .seconds = 5,
                            .picture = {960, 540},
                            .fps = 30,
                            .def = voice_type_def_default(),
                            .hearing = voice_def_default()};
    memcpy(w.inks, w.def.inks, sizeof w.inks);
    int status = options_read(&w, argc, argv, &help);
    char *font = NULL;
    if (status == EXIT_SUCCESS && !help)
        status = type_font_name("voice", w.font, w.edits, "EBGaramond12-Regular", &font);
    if (status != EXIT_SUCCESS || help)
        return status;
    w.font = font;
    interrupt_catch();
    status = w.microphone && !w.features && !pictures_wanted(&w) ? live_play(&w)
                                                                 : pictures_write(&w);
    font_face_close(w.face);
    free(font);
    voice_words_finish(&w.words);
    voice_timing_finish(&w.timing);
    voice_transcript_finish(&w.cues);
    voice_score_finish(&w.score);
    free(w.heard);
    voice_sound_finish(&w.sound);
    return interrupt_report("voice", status, "the film is");
}
