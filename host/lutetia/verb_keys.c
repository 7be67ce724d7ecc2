/* verb_keys.c - `lutetia keys`: letters that the keys of a song play, as a sheet of moments, a
 * line, frames or a film. */
#include "help.h"
#include "keys_live.h"
#include "lutetia.h"
#include "options.h"
#include "poster.h"
#include "type_common.h"
#include <visible_text.h>

#include <display.h>
#include <keys_poster.h>
#include <sound.h>
#include <video.h>

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    SHEET_COLUMNS = 5,
    SHEET_ROWS = 4,
    LABEL_PX = 11,
    POSTER_MARGIN_PX = 24,
    POSTER_EM_PX = 240
};

struct keys_work {
    const char *text, *map, *font, *edits, *axes;
    const char *poster, *sheet, *still, *frames, *video, *sound;
    double size_px[2], second_px, line_px, at_s, seconds; /* seconds 0: as long as the song */
    int picture[2], fps, range[2];
    bool silent, wet, played; /* played: on a stage, by a map in Lua or on wet paper */
    bool sized;               /* --size says how large letters are */
    const char *stock;
    struct option_texts pigments;
    const char *range_text, *theme;
    struct option_texts sets;
    struct live_options live;
    struct keys_def def;
    struct keys_type_def type;
    /* made */
    struct midi_song *song;
    struct keys_score score;
    struct keys_letters letters;
    struct font_face *face;
};

static bool is_script(const char *map)
{
    const size_t length = map ? strlen(map) : 0;
    return length > 4 && strcmp(map + length - 4, ".lua") == 0;
}

static bool pictures_wanted(const struct keys_work *w)
{
    return w->poster || w->sheet || w->still || w->frames || w->video || w->sound;
}

static int options_check(struct keys_work *w, const struct option_words *words,
                         const char **song)
{
    *song = words->count ? words->words[0] : NULL;
    if (words->count > 1)
        return fail_usage("keys", "it takes one Standard MIDI File, or none for a window");
    if (w->picture[0] % 2 || w->picture[1] % 2)
        return fail_usage("keys", "--picture must be even (got %dx%d)", w->picture[0],
                          w->picture[1]);
    if (w->size_px[1] > 0 && w->size_px[1] < w->size_px[0])
        return fail_usage("keys", "--size is the least and the most (got %g,%g)", w->size_px[0],
                          w->size_px[1]);
    if (!keys_live_range(w->range_text, w->range))
        return fail_usage("keys",
                          "--range must be two notes, an octave or more: c3-c5 (got '%.40s')",
                          w->range_text);
    w->played = w->wet || w->live.knobs.count || w->live.cues || w->sets.count;
    w->live.no_go = *song != NULL;
    if (is_script(w->map)) {
        w->played = true;
        w->live.map = w->map;
        w->map = NULL;
    }
    if (!w->wet && (w->stock || w->pigments.count))
        return fail_usage("keys", "--stock and --pigment go with --wet");
    if (!*song)
        return pictures_wanted(w)
                   ? fail_usage("keys",
                                "pictures and films are of a song: lutetia keys SONG.mid")
                   : EXIT_SUCCESS;
    if (w->played && (w->poster || w->sheet || !(w->still || w->frames || w->video)))
        return fail_usage(
            "keys",
            "what a map in Lua, knobs, cues, --set or wet paper make of a song is seen by "
            "--still, --frames and --video");
    if (!pictures_wanted(w))
        w->poster = "out.png";
    return EXIT_SUCCESS;
}

#define MOMENTS "sheet|still|frames|video|sound|!WORD"
#define POSTER "poster|WORD+!sheet+!still+!frames+!video+!sound"

/* With what an option has an effect. The poster is made of a song where nothing else is asked
 * for. */
static const struct option_need needs[] = {
    {"param", "map"},
    {"set", "!WORD|map|wet|knobs|cues|still|frames|video"},
    {"range", "!WORD|map|wet|knobs"},
    {"watch", "!WORD"},
    {"server", "!WORD"},
    {"device", "!WORD"},
    {"filter", "!WORD"},
    {"theme", "!WORD|map|knobs|cues|set"},
    {"osc", "!WORD"},
    {"osc-from", "osc"},
    {"osc-to", "!WORD"},
    {"screen", "!WORD"},
    {"stream", "!WORD"},
    {"picture", "!WORD|sheet|still|frames|video"},
    {"at", "still"},
    {"fps", "video|frames|sound"},
    {"seconds", "video|frames|sound"},
    {"silent", "video"},
    {"second", POSTER},
    {"line", POSTER},
    {"attack", MOMENTS},
    {"release", MOMENTS},
    {"step", POSTER},
    {0}};

static int options_read(struct keys_work *w, int argc, char **argv, const char **song,
                        bool *help)
{
    const struct option_row rows[] = {
        {"text", 't', OPTION_TEXT, "TEXT",
         "its letters go to the keys played, from the lowest (note names)", &w->text, 0, 0, 0},
        {"map", 0, OPTION_TEXT, "FILE",
         "what a key plays: lines like 'c4 A'; or a script, .lua", &w->map, 0, 0, 0},
        {"param", 0, OPTION_TEXTS, "KEY=VALUE",
         "a parameter of the --map's script; as often as wanted", &w->live.params, 0, 0, 0},
        {"knobs", 0, OPTION_TEXTS, "FILE",
         "knobs that are learnt in the window, and scenes; kept there; as often as wanted",
         &w->live.knobs, 0, 0, 0},
        {"watch", 0, OPTION_TEXT, "FILE",
         "a text file whose letters are the window's, as soon as it changes", &w->live.text, 0,
         0, 0},
        {"cues", 0, OPTION_TEXT, "FILE",
         "a list of cues: other words, controls and scenes, at times or when Control G says so",
         &w->live.cues, 0, 0, 0},
        LIVE_OSC_OPTIONS(&w->live),
        {"set", 's', OPTION_TEXTS, "NAME=VALUE",
         "a control and its value, in a window and on a film's stage; as often as wanted",
         &w->sets, 0, 0, 0},
        {"range", 0, OPTION_TEXT, "C3-C5", "the keys that have places in a window (c3-c5)",
         &w->range_text, 0, 0, 0},
        {"server", 0, OPTION_TEXT, "ADDRESS", "a MIDI server's socket (the user's own)",
         &w->live.server, 0, 0, 0},
        {"device", 0, OPTION_TEXT, "NAME", "the server's device that is heard (all)",
         &w->live.device, 0, 0, 0},
        {"filter", 0, OPTION_TEXT, "WORDS",
         "filters of what is heard: channels=1, transpose=12, ...", &w->live.filters, 0, 0, 0},
        {"wet", 0, OPTION_FLAG, NULL, "print the letters on wet paper, in ink", &w->wet, 0, 0,
         0},
        {"stock", 0, OPTION_TEXT, "NAME", "the kind of paper, with --wet (cold press)",
         &w->stock, 0, 0, 0},
        {"pigment", 0, OPTION_TEXTS, "NAME",
         "a pigment of the ink, with --wet; of several a map chooses (french ultramarine, ...)",
         &w->pigments, 0, 0, 0},
        LIVE_SCREEN_OPTION(&w->live.screen),
        LIVE_STREAM_OPTION(&w->live.stream),
        {"theme", 0, OPTION_TEXT, "light|dark|FILE", "colours of a window: a name, or a file",
         &w->theme, 0, 0, 0},
        {"poster", 'o', OPTION_PNG, "FILE", "lines along which time runs, PNG (out.png)",
         &w->poster, 0, 0, 0},
        {"sheet", 0, OPTION_PNG, "FILE", "twenty moments of it, PNG", &w->sheet, 0, 0, 0},
        {"still", 0, OPTION_PNG, "FILE", "the moment --at, PNG", &w->still, 0, 0, 0},
        {"at", 0, OPTION_NUMBER, "S", "the moment of --still (0)", &w->at_s, 0, 36000, 0},
        {"frames", 0, OPTION_TEXT, "DIR", "all moments as numbered pictures in this folder",
         &w->frames, 0, 0, 0},
        {"video", 0, OPTION_TEXT, "FILE", "a film with its sound in it (.mp4, .webm, ...)",
         &w->video, 0, 0, 0},
        {"silent", 0, OPTION_FLAG, NULL, "the film has no sound", &w->silent, 0, 0, 0},
        {"sound", 0, OPTION_TEXT, "FILE.wav", "write the song as sound, as long as the film",
         &w->sound, 0, 0, 0},
        {"fps", 0, OPTION_INTEGER, "N", "frames a second of the film (30)", &w->fps, 1, 240, 0},
        {"seconds", 0, OPTION_NUMBER, "S",
         "how long film and sound are (as long as the song, if that takes an hour at most)",
         &w->seconds, 0.001, 36000, 0},
        {"picture", 0, OPTION_SIZE, "WxH", "size of a moment or a window, even (960x360)",
         w->picture, 2, 8192, 0},
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (EBGaramond12-Regular)", &w->font, 0,
         0, 0},
        TYPE_EDITS_OPTION(&w->edits),
        {"axes", 0, OPTION_TEXT, "A=V,..", "positions of a variable font's axes: wght=700",
         &w->axes, 0, 0, 0},
        {"size", 0, OPTION_NUMBERS, "PX,PX", "least and most size of the em (0, and as fits)",
         w->size_px, 0, 4000, 2},
        {"second", 0, OPTION_NUMBER, "PX", "length of a second on the poster (160)",
         &w->second_px, 10, 20000, 0},
        {"line", 0, OPTION_NUMBER, "PX", "the longest line of the poster (as fits)",
         &w->line_px, 100, 60000, 0},
        {"step", 0, OPTION_NUMBER, "PX", "distance from key to key on the poster, upwards (12)",
         &w->type.step_px, 0, 1000, 0},
        {"attack", 0, OPTION_NUMBER, "S",
         "time until a letter is as large as its velocity says (0.03)", &w->def.attack_s, 0, 10,
         0},
        {"release", 0, OPTION_NUMBER, "S",
         "time until a letter is a third of it, once the key is let go (0.25)",
         &w->def.release_s, 0, 60, 0},
        {"pressure", 0, OPTION_NUMBER, "P", "how much aftertouch adds, 0..1 (1)",
         &w->def.pressure, 0, 1, 0},
        {0}};
    struct option_words words;
    if (!options_parse("keys", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("keys", rows, NULL);
    return options_effects("keys", rows, needs, &words) ? options_check(w, &words, song)
                                                        : EXIT_USAGE;
}

/* ---- what is played ---- */

/* Says which of the keys' letters no font has. */
static void letters_check(const struct keys_work *w)
{
    char all[MIDI_NOTES * KEYS_LETTER_BYTES] = "";
    size_t used = 0;
    for (int key = 0; key < MIDI_NOTES; key++)
        used += (size_t)snprintf(all + used, sizeof all - used, "%s", w->letters.of[key]);
    type_text_check("keys", w->font, w->face, all);
}

static int song_take(struct keys_work *w, const char *path)
{
    char why[300];
    bool empty;
    if (midi_song_read(path, &w->song) != MIDI_OK)
        return fail("keys", "%s", midi_error());
    if (!keys_score_make(&w->def, w->song, &w->score, &empty))
        return empty ? fail("keys", "%s: there is no note in it", path)
                     : fail("keys", "%s: no memory for its notes", path);
    keys_letters_names(&w->letters);
    if (w->text && !keys_letters_text(&w->score, w->text, &w->letters))
        return fail_usage("keys", "--text: there is no letter in it");
    if (w->map && !keys_letters_file(w->map, &w->letters, why, sizeof why))
        return fail("keys", "--map: %s", why);
    int status = type_face_open("keys", w->font, 0, w->axes, false, &w->face);
    if (status != EXIT_SUCCESS)
        return status;
    letters_check(w);
    w->sized = w->size_px[1] > 0;
    if (!w->sized && keys_type_fit(w->face, &w->score, &w->letters, w->picture[0],
                                   w->picture[1], &w->size_px[1]) != FONT_OK)
        return fail_font("keys");
    w->size_px[0] = fmin(w->size_px[0], w->size_px[1]);
    return EXIT_SUCCESS;
}

/* How long film and sound are: until the last letter has nearly vanished. */
static double seconds_of(const struct keys_work *w)
{
    return w->seconds > 0 ? w->seconds : w->score.seconds + 3 * w->def.release_s;
}

/* A song of a kilobyte may claim that it takes years. */
static int seconds_check(const struct keys_work *w, const char *song)
{
    const double most_s = 3600;
    if (w->seconds > 0 || seconds_of(w) <= most_s || !(w->frames || w->video || w->sound))
        return EXIT_SUCCESS;
    return fail("keys", "%s takes %.0f s: say by --seconds S how many are wanted", song,
                seconds_of(w));
}

static int type_make(const struct keys_work *w, double scale, struct keys_type **out)
{
    struct keys_type_def def = w->type;
    def.size_px[0] = w->size_px[0] * scale;
    def.size_px[1] = w->size_px[1] * scale;
    return keys_type_create(&def, w->face, &w->score, &w->letters, out) == FONT_OK
               ? EXIT_SUCCESS
               : fail_font("keys");
}

/* ---- pictures ---- */

static void gray_fill(struct display_image *image, int x, int y, int width, int height)
{
    enum { GRAY = 205 };
    for (int i = 0; i < height; i++)
        memset(image->pixels + 3 * ((size_t)(y + i) * (size_t)image->width_px + (size_t)x),
               GRAY, 3 * (size_t)width);
}

/* A thin frame around a part of an image. */
static void frame_draw(struct display_image *image, int x, int y, int width, int height)
{
    gray_fill(image, x - 1, y - 1, width + 2, 1);
    gray_fill(image, x - 1, y + height, width + 2, 1);
    gray_fill(image, x - 1, y, 1, height);
    gray_fill(image, x + width, y, 1, height);
}

struct song_poster {
    struct keys_type *type;
    struct keys_poster *poster;
};

static void poster_paper(void *of, struct font_picture *picture)
{
    const struct song_poster *p = of;
    keys_type_paper(p->type, picture);
}

static int poster_draw(void *of, int line, double top_px, struct font_picture *picture)
{
    const struct song_poster *p = of;
    return keys_poster_draw(p->poster, line, POSTER_MARGIN_PX, top_px, picture) == FONT_OK
               ? EXIT_SUCCESS
               : fail_font("keys");
}

/* One line where it is not too long, else lines of a page's width. */
static int song_poster_write(const struct keys_work *w)
{
    struct song_poster of = {0};
    const double half_second_px = 0.55 * w->second_px; /* a letter is about as wide as high */
    const double most = fmin(w->sized ? w->size_px[1] : POSTER_EM_PX, half_second_px);
    int status = type_make(w, most / w->size_px[1], &of.type);
    double line_px = w->line_px > 0 ? w->line_px : POSTER_LINE_MOST_PX;
    for (int i = 0; i < 2 && status == EXIT_SUCCESS; i++) {
        keys_poster_destroy(of.poster);
        if (keys_poster_create(of.type, w->second_px, line_px, &of.poster) != FONT_OK)
            status = fail_font("keys");
        if (w->line_px > 0 || !of.poster || keys_poster_lines(of.poster) == 1)
            break;
        line_px = POSTER_LINE_PX;
    }
    if (status == EXIT_SUCCESS) {
        const struct poster poster = {.verb = "keys",
                                      .path = w->poster,
                                      .lines = keys_poster_lines(of.poster),
                                      .margin_px = POSTER_MARGIN_PX,
                                      .pitch_px = keys_poster_height(of.poster) + 0.4 * most,
                                      .width_px = keys_poster_width(of.poster),
                                      .of = &of,
                                      .paper = poster_paper,
                                      .draw = poster_draw};
        status = poster_write(&poster);
    }
    keys_poster_destroy(of.poster);
    keys_type_destroy(of.type);
    return status;
}

static int moments_write(const struct keys_work *w)
{
    enum { CELL = 256, GAP = 16, COUNT = SHEET_COLUMNS * SHEET_ROWS };
    struct keys_type *type;
    struct display_image image = {0};
    struct type_labels *labels = type_labels_create(LABEL_PX);
    const int height = (int)fmax(2, round((double)CELL * w->picture[1] / w->picture[0]));
    const int pitch = height + GAP + LABEL_PX;
    int status = type_make(w, (double)CELL / w->picture[0], &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("keys", GAP + SHEET_COLUMNS * (CELL + GAP),
                                   GAP + SHEET_ROWS * pitch, &image);
    for (int i = 0; i < COUNT && status == EXIT_SUCCESS; i++) {
        const int x = GAP + i % SHEET_COLUMNS * (CELL + GAP),
                  y = GAP + i / SHEET_COLUMNS * pitch;
        const double time_s = (i + 0.5) / COUNT * seconds_of(w);
        struct font_picture picture = {
            CELL, height, 3 * image.width_px,
            image.pixels + 3 * ((size_t)y * (size_t)image.width_px + (size_t)x)};
        if (keys_type_moment(type, time_s, &picture) != FONT_OK)
            status = fail_font("keys");
        frame_draw(&image, x, y, CELL, height);
        type_label(labels, &image, x, y + height + LABEL_PX + 3, "%.2f s", time_s);
    }
    if (status == EXIT_SUCCESS)
        status = type_image_write("keys", w->sheet, &image);
    type_labels_destroy(labels);
    display_image_destroy(&image);
    keys_type_destroy(type);
    return status;
}

static int still_write(const struct keys_work *w)
{
    struct keys_type *type;
    struct display_image image = {0};
    int status = type_make(w, 1, &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("keys", w->picture[0], w->picture[1], &image);
    struct font_picture picture = type_picture(&image);
    if (status == EXIT_SUCCESS && keys_type_moment(type, w->at_s, &picture) != FONT_OK)
        status = fail_font("keys");
    if (status == EXIT_SUCCESS)
        status = type_image_write("keys", w->still, &image);
    display_image_destroy(&image);
    keys_type_destroy(type);
    return status;
}

/* ---- a film ---- */

static int moment_keep(const struct keys_work *w, struct video *video, int number,
                       const struct display_image *image)
{
    char path[PATH_MAX];
    if (video && video_add(video, image->pixels) != DISPLAY_OK)
        return fail("keys", "%s", display_error());
    if (!w->frames)
        return EXIT_SUCCESS;
    snprintf(path, sizeof path, "%s/keys-%06d.png", w->frames, number);
    return type_image_write("keys", path, image);
}

/* If there can be no sound, a line says so, and the film is silent. */
static int film_begin(const struct keys_work *w, double seconds, struct video **out)
{
    struct sound_def def = sound_def_default();
    int sound = -1;
    def.room = true;
    if (!w->silent && sound_render_open(&def, w->song, seconds, &sound) != MIDI_OK)
        visible_say("lutetia keys: the film is silent: %s", midi_error());
    const enum display_status status =
        video_create_with_sound(w->video, w->picture[0], w->picture[1], w->fps, sound, out);
    if (sound >= 0)
        close(sound);
    if (status != DISPLAY_OK)
        return fail("keys", "%s", display_error());
    if (sound >= 0 && !video_sounds(*out) && !w->sound)
        visible_say("lutetia keys: %s has no sound in it; --sound FILE.wav writes that",
                    video_path(*out));
    return EXIT_SUCCESS;
}

static int film_write(const struct keys_work *w)
{
    struct keys_type *type = NULL;
    struct display_image image = {0};
    struct video *video = NULL;
    const int count = (int)ceil(seconds_of(w) * w->fps) + 1;
    int status = w->frames ? folder_make("keys", w->frames) : EXIT_SUCCESS;
    if (status == EXIT_SUCCESS)
        status = type_make(w, 1, &type);
    if (status == EXIT_SUCCESS)
        status = type_image_create("keys", w->picture[0], w->picture[1], &image);
    if (status == EXIT_SUCCESS && w->video)
        status = film_begin(w, (double)count / w->fps, &video);
    struct font_picture picture = type_picture(&image);
    struct progress progress = progress_begin("keys", count);
    for (int i = 0; i < count && status == EXIT_SUCCESS; i++) {
        if (interrupted())
            status = EXIT_FAILED;
        else if (keys_type_moment(type, (double)i / w->fps, &picture) != FONT_OK)
            status = fail_font("keys");
        else
            status = moment_keep(w, video, i, &image);
        progress_show(&progress, i + 1);
    }
    progress_end(&progress);
    if (status != EXIT_SUCCESS)
        video_abandon(video);
    else if (video && video_finish(video) != DISPLAY_OK)
        status = fail("keys", "%s", display_error());
    display_image_destroy(&image);
    keys_type_destroy(type);
    return status;
}

static int all_write(struct keys_work *w)
{
    int status = EXIT_SUCCESS;
    if (w->poster)
        status = song_poster_write(w);
    if (status == EXIT_SUCCESS && w->sheet)
        status = moments_write(w);
    if (status == EXIT_SUCCESS && w->still)
        status = still_write(w);
    if (status == EXIT_SUCCESS && w->sound) {
        struct sound_def def = sound_def_default();
        def.room = true;
        if (sound_render(&def, w->song, seconds_of(w), w->sound) != MIDI_OK)
            status = fail("keys", "--sound: %s", midi_error());
    }
    if (status == EXIT_SUCCESS && (w->frames || w->video))
        status = film_write(w);
    return status;
}

/* ---- on a stage ---- */

static struct keys_live live_of(const struct keys_work *w)
{
    return (struct keys_live){.face = w->face,
                              .letters = w->map ? &w->letters : NULL,
                              .text = w->text,
                              .theme = w->theme,
                              .wet = w->wet,
                              .stock = w->stock,
                              .pigments = w->pigments,
                              .range = {w->range[0], w->range[1]},
                              .keys = w->def,
                              .sets = w->sets,
                              .live = w->live,
                              .size = {w->picture[0], w->picture[1]}};
}

static int window_open(struct keys_work *w)
{
    char why[300];
    if (w->map && !keys_letters_file(w->map, &w->letters, why, sizeof why))
        return fail("keys", "--map: %s", why);
    int status = type_face_open("keys", w->font, 0, w->axes, false, &w->face);
    const struct keys_live live = live_of(w);
    return status == EXIT_SUCCESS ? keys_live_window(&live) : status;
}

/* A song through a map in Lua. */
static int played_write(struct keys_work *w)
{
    struct keys_live live = live_of(w);
    struct sound_def sound = sound_def_default();
    live.letters = &w->letters;
    live.text = NULL; /* its letters are given already */
    live.score = &w->score;
    live.song = w->song;
    live.film = stage_film_def_default();
    live.film.width_px = w->picture[0];
    live.film.height_px = w->picture[1];
    live.film.fps = w->fps;
    live.film.seconds = w->still && !w->frames && !w->video ? w->at_s : seconds_of(w);
    live.film.still = w->still;
    live.film.frames = w->frames;
    live.film.video = w->video;
    sound.room = true;
    if ((w->frames && folder_make("keys", w->frames) != EXIT_SUCCESS) ||
        output_check("keys", w->still) != EXIT_SUCCESS)
        return EXIT_FAILED;
    if (w->video && !w->silent &&
        sound_render_open(&sound, w->song, seconds_of(w), &live.film.sound) != MIDI_OK)
        visible_say("lutetia keys: the film is silent: %s", midi_error());
    int status = keys_live_film(&live);
    if (live.film.sound >= 0)
        close(live.film.sound);
    if (status == EXIT_SUCCESS && w->sound &&
        sound_render(&sound, w->song, seconds_of(w), w->sound) != MIDI_OK)
        status = fail("keys", "--sound: %s", midi_error());
    return status;
}

int verb_keys(int argc, char **argv)
{
    static struct keys_work w;
    const char *song = NULL;
    bool help = false;
    w = (struct keys_work){.second_px = 160,
                           .picture = {960, 360},
                           .range_text = "c3-c5",
                           .fps = 30,
                           .def = keys_def_default(),
                           .type = keys_type_def_default()};
    int status = options_read(&w, argc, argv, &song, &help);
    char *font = NULL;
    if (status == EXIT_SUCCESS && !help)
        status = type_font_name("keys", w.font, w.edits, "EBGaramond12-Regular", &font);
    if (status != EXIT_SUCCESS || help)
        return status;
    w.font = font;
    interrupt_catch();
    if (song)
        status = song_take(&w, song);
    if (status == EXIT_SUCCESS && song)
        status = seconds_check(&w, song);
    if (status == EXIT_SUCCESS)
        status = !song ? window_open(&w) : w.played ? played_write(&w) : all_write(&w);
    font_face_close(w.face);
    free(font);
    keys_score_finish(&w.score);
    midi_song_destroy(w.song);
    return interrupt_report("keys", status, "what was written before is whole");
}
