/* verb_spring.c - `lutetia spring`: words on springs, in a window, in stills and in films. */
#include "help.h"
#include "live.h"
#include "lutetia.h"
#include "options.h"
#include "spring_scene.h"
#include "spring_sound.h"
#include "spring_wet.h"
#include "type_common.h"
#include <visible_text.h>

#include <cues_file.h>
#include <live_sound.h>
#include <stage_film.h>
#include <stage_window.h>
#include <word.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct spring {
    struct spring_scene_def scene;
    struct stage_film_def film;
    struct stage_window_def window;
    struct option_texts sets;
    const char *way, *edits, *frames, *save, *session, *replay, *sound_path;
    int size[2];
    const char *song_path;
    bool controls, silent, is_wet;
    struct spring_wet_def wet_def;
    struct spring_wet *wet;
    struct progress progress;
    struct live_options live_options;
    struct midi_song *song;
    struct midi_song *silence; /* of a film that a map leads without a song */
    struct live live;
    const char *play;
    struct live_sound *sound;
    double recording_s; /* when the window's recording began */
    double usual_s;     /* of a film of which nothing else says how long it lasts */
};

static int fail_stage(void)
{
    return fail("spring", "%s", stage_error());
}

/* ---- the command line ---- */

static const char *const ways[] = {"exact", "egl", "osmesa"};

static int spring_check(struct spring *s, const struct option_words *words)
{
    int way = -1;
    for (int i = 0; i < 3; i++)
        if (strcmp(s->way, ways[i]) == 0)
            way = i;
    if (way < 0)
        return fail_usage("spring", "--way must be exact, egl or osmesa (got '%.60s')", s->way);
    s->film.way = (enum stage_film_way)way;
    if (words->count > 1)
        return fail_usage("spring", "one word or text, please: \"%.40s %.40s ...\" in quotes",
                          words->words[0], words->words[1]);
    if (!words->count && !s->scene.network && !s->controls)
        return fail_usage("spring",
                          "a word, or --network FILE; `lutetia spring --help` says more");
    if (words->count && s->scene.network)
        return fail_usage("spring", "a word or --network FILE, not both");
    if ((s->film.strip[0] != 1 || s->film.strip[1] != 1) && !s->film.still)
        return fail_usage("spring", "--strip is for a --still");
    const bool film = s->film.still || s->film.video || s->frames;
    const bool played = s->live_options.map || s->live_options.knobs.count;
    s->live_options.knobs_alone = !s->live_options.map;
    s->live_options.no_go = film;
    if ((played || s->live_options.cues) && s->replay)
        return fail_usage(
            "spring", "a session says what is done: --replay has no --map, --knobs or --cues");
    if (!played && (s->song_path || (s->live_options.server && !s->play)))
        return fail_usage("spring",
                          "what is played goes through a --map FILE.lua, or --knobs FILE");
    if (!s->live_options.map && s->live_options.params.count)
        return fail_usage("spring", "--param is for a --map FILE.lua");
    if (s->live_options.knobs.count && !s->song_path && !s->live_options.cues && film)
        return fail_usage("spring", "a film through --knobs is of a --song FILE.mid");
    const struct spring_wet_def usual = spring_wet_def_default();
    if (!s->is_wet &&
        (s->wet_def.pigment != usual.pigment || s->wet_def.every_s != usual.every_s))
        return fail_usage("spring", "--pigment and --every are for --wet");
    if (s->is_wet && !s->film.still && !s->film.video && !s->frames)
        return fail_usage("spring", "--wet goes with --still, --video or --frames");
    if (s->sound_path && !s->film.still && !s->film.video && !s->frames)
        return fail_usage("spring", "--sound goes with --video, --frames or --still");
    const double *v = s->scene.view;
    if (!isnan(v[0]) && !(v[2] > v[0] && v[3] > v[1]))
        return fail_usage("spring", "--view must be X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1");
    if (words->count)
        s->scene.text = words->words[0];
    else if (!s->scene.network)
        s->scene.text = "a"; /* --controls alone: every word has the same ones */
    if (s->scene.network && s->scene.preset)
        return fail_usage("spring", "--preset is for a word");
    s->film.width_px = s->window.width_px = s->size[0];
    s->film.height_px = s->window.height_px = s->size[1];
    if (s->film.video && (s->size[0] % 2 || s->size[1] % 2))
        return fail_usage("spring", "a film has even sides (got --size %dx%d)", s->size[0],
                          s->size[1]);
    return EXIT_SUCCESS;
}

#define WINDOW "!still+!video+!frames"
#define FILM "still|video|frames"

/* With what an option has an effect. */
static const struct option_need needs[] = {{"record", WINDOW},
                                           {"play", WINDOW},
                                           {"screen", WINDOW},
                                           {"stream", WINDOW},
                                           {"session", "replay|!still+!video+!frames"},
                                           {"fps", "video|frames|sound|song|map|wet|strip"},
                                           {"watch", "!network+!still+!video+!frames"},
                                           {"osc", WINDOW},
                                           {"osc-from", "osc"},
                                           {"osc-to", WINDOW},
                                           {"silent", "video|!still+!frames"},
                                           {"loop", "video|frames"},
                                           {"settle", "loop"},
                                           {"way", FILM},
                                           {"filter", FILM},
                                           {"seconds", FILM},
                                           {0}};

static int spring_options(struct spring *s, int argc, char **argv, bool *help)
{
    const struct option_row rows[] = {
        {"preset", 'p', OPTION_TEXT, "NAME", "masses, springs and controls by a name",
         &s->scene.preset, 0, 0, 0},
        {"set", 's', OPTION_TEXTS, "NAME=VALUE", "a control and its value; as often as wanted",
         &s->sets, 0, 0, 0},
        {"controls", 0, OPTION_FLAG, NULL, "print the table of controls, and end", &s->controls,
         0, 0, 0},
        {"network", 0, OPTION_TEXT, "FILE", "masses and springs from a file, instead of a word",
         &s->scene.network, 0, 0, 0},
        {"font", 0, OPTION_TEXT, "FONT",
         "the font: a file, the name of one, or a family (DejaVuSans)", &s->scene.font, 0, 0,
         0},
        TYPE_EDITS_OPTION(&s->edits),
        {"at", 0, OPTION_NUMBERS, "X,Y",
         "where the baseline begins, in ems above the floor (0,2)", s->scene.at, -1000, 1000,
         2},
        {"turn", 0, OPTION_NUMBER, "DEGREES", "turns the baseline counterclockwise",
         &s->scene.turn, -360, 360, 0},
        {"column", 0, OPTION_NUMBER, "EMS", "break lines to be at most that long",
         &s->scene.column, 0, 1000, 0},
        {"circle", 0, OPTION_NUMBER, "RADIUS",
         "bend the baseline around a circle of this radius, in ems", &s->scene.circle, 0, 1000,
         0},
        {"script", 0, OPTION_TEXT, "FILE", "a file of clamps that lead masses",
         &s->scene.script, 0, 0, 0},
        {"map", 0, OPTION_TEXT, "FILE.lua", "a script that turns what is played into controls",
         &s->live_options.map, 0, 0, 0},
        {"knobs", 0, OPTION_TEXTS, "FILE",
         "knobs that are learnt in the window, and scenes; kept there; as often as wanted",
         &s->live_options.knobs, 0, 0, 0},
        {"watch", 0, OPTION_TEXT, "FILE",
         "a text file whose words are the window's, as soon as it changes",
         &s->live_options.text, 0, 0, 0},
        {"cues", 0, OPTION_TEXT, "FILE",
         "a list of cues: other words, controls and scenes, at times or when G is pressed",
         &s->live_options.cues, 0, 0, 0},
        LIVE_OSC_OPTIONS(&s->live_options),
        {"param", 0, OPTION_TEXTS, "KEY=VALUE",
         "a parameter of the --map's script; as often as wanted", &s->live_options.params, 0, 0,
         0},
        {"song", 0, OPTION_TEXT, "FILE.mid",
         "the song that is played (what the MIDI server hears)", &s->song_path, 0, 0, 0},
        {"server", 0, OPTION_TEXT, "ADDRESS", "the MIDI server's socket (the user's own)",
         &s->live_options.server, 0, 0, 0},
        LIVE_SCREEN_OPTION(&s->window.screen),
        LIVE_STREAM_OPTION(&s->window.stream),
        {"theme", 0, OPTION_TEXT, "light|dark|FILE", "colours and widths: a name, or a file",
         &s->scene.theme, 0, 0, 0},
        {"size", 0, OPTION_SIZE, "WxH", "size of the window or the picture (1280x720)", s->size,
         16, 8192, 0},
        {"view", 0, OPTION_NUMBERS, "X0,Y0,X1,Y1", "the part of the world that is seen, in ems",
         s->scene.view, -1e6, 1e6, 4},
        {"still", 0, OPTION_PNG, "FILE", "write a picture of the moment after --seconds",
         &s->film.still, 0, 0, 0},
        {"strip", 0, OPTION_SIZE, "CxR", "the still has so many columns and rows of moments",
         s->film.strip, 1, 100, 0},
        {"video", 0, OPTION_TEXT, "FILE", "write a film (.mp4 with ffmpeg; .y4m)",
         &s->film.video, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR", "write numbered pictures into this folder",
         &s->frames, 0, 0, 0},
        {"seconds", 0, OPTION_NUMBER, "S",
         "how long it moves (what is replayed or played, or 5)", &s->film.seconds, 0, 3600, 0},
        {"loop", 0, OPTION_NUMBER, "S",
         "film and frames can be repeated: their end goes over into their beginning for so "
         "long; "
         "a film is silent then",
         &s->film.loop_s, 0, 60, 0},
        {"settle", 0, OPTION_NUMBER, "S",
         "how long it moves before the first picture of --loop (0)", &s->film.settle_s, 0, 3600,
         0},
        {"fps", 0, OPTION_INTEGER, "N", "pictures a second (30)", &s->film.fps, 1, 240, 0},
        {"way", 0, OPTION_TEXT, "exact|egl|osmesa",
         "how pictures are drawn: filtered, or by OpenGL (exact)", &s->way, 0, 0, 0},
        {"wet", 0, OPTION_FLAG, NULL,
         "hang the word over wet paper, on which letters leave tracks", &s->is_wet, 0, 0, 0},
        {"pigment", 0, OPTION_TEXT, "NAME", "pigment of the tracks (french ultramarine)",
         &s->wet_def.pigment, 0, 0, 0},
        {"every", 0, OPTION_NUMBER, "S", "time between a track's prints (0.1)",
         &s->wet_def.every_s, 0.001, 60, 0},
        {"filter", 0, OPTION_TEXT, "NAME", "filter of exact pictures (gaussian-fast)",
         &s->film.filter, 0, 0, 0},
        {"sound", 0, OPTION_TEXT, "FILE.wav", "write what is heard in the film", &s->sound_path,
         0, 0, 0},
        {"silent", 0, OPTION_FLAG, NULL, "the window or the film has no sound", &s->silent, 0,
         0, 0},
        {"play", 0, OPTION_TEXT, "DEVICE",
         "send what is heard in the window to this device of the MIDI server", &s->play, 0, 0,
         0},
        {"save", 0, OPTION_TEXT, "FILE", "write masses and springs at the end, or at Control S",
         &s->save, 0, 0, 0},
        {"session", 0, OPTION_TEXT, "FILE", "record what is done in the window", &s->session, 0,
         0, 0},
        {"replay", 0, OPTION_TEXT, "FILE", "do a session again, in a window or a film",
         &s->replay, 0, 0, 0},
        {"record", 0, OPTION_TEXT, "FILE", "the film that V in the window records (spring.mp4)",
         &s->window.record_path, 0, 0, 0},
        {0}};
    struct option_words words;
    if (!options_parse("spring", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("spring", rows, NULL);
    return options_effects("spring", rows, needs, &words) ? spring_check(s, &words)
                                                          : EXIT_USAGE;
}

/* ---- what is done ---- */

static int controls_print(struct stage *stage)
{
    int count;
    const struct control *rows = stage_controls(stage, &count);
    for (int i = 0; i < count; i++) {
        char value[64], range[96];
        control_text(&rows[i], control_read(&rows[i], stage), value, sizeof value);
        if (rows[i].curve == CONTROL_SWITCH)
            snprintf(range, sizeof range, "on, off");
        else if (rows[i].curve == CONTROL_CHOICE)
            snprintf(range, sizeof range, "%s", rows[i].choices);
        else
            snprintf(range, sizeof range, "%g..%g%s%s", rows[i].least, rows[i].most,
                     rows[i].unit[0] ? " " : "", rows[i].unit);
        printf("%-13s %-11s %-26s %s\n", rows[i].name, value, range, rows[i].does);
    }
    return EXIT_SUCCESS;
}

/* ---- what is played ---- */

static int map_begin(struct spring *s, struct stage *stage)
{
    enum { LOWEST = 48 };
    const struct live_options *o = &s->live_options;
    if ((!o->map && !o->knobs.count && !o->osc && !o->osc_to && !o->text && !o->cues) ||
        s->live.source)
        return EXIT_SUCCESS;
    const bool film = s->film.still || s->film.video || s->frames;
    const struct midi_song_def silence = midi_song_def_default();
    if (film && !s->song && !s->silence && midi_song_create(&silence, &s->silence) != MIDI_OK)
        return fail("spring", "%s", midi_error());
    const int status =
        live_begin("spring", o, s->song ? s->song : s->silence, LOWEST, stage, &s->live);
    if (status == EXIT_SUCCESS && film && !s->song && !live_player_leads(s->live.player))
        return fail("spring",
                    "a film through a --map without frame(time) is of a --song FILE.mid");
    return status;
}

static enum stage_status frame_before(void *context, struct stage *stage, double now_s)
{
    const struct spring *s = context;
    return s->live.player ? live_player_before(s->live.player, stage, now_s) : STAGE_OK;
}

static double frame_due_s(void *context)
{
    const struct spring *s = context;
    return s->live.player ? live_player_due_s(s->live.player) : INFINITY;
}

static enum stage_status frame_over(void *context, struct stage *stage,
                                    const struct stage_draw_list *list,
                                    struct display_image *image)
{
    const struct spring *s = context;
    (void)stage;
    return spring_wet_picture(s->wet, list, image);
}

static int wet_begin(struct spring *s)
{
    if (!s->is_wet)
        return EXIT_SUCCESS;
    s->wet_def.width = s->size[0] / s->film.strip[0];
    s->wet_def.height = s->size[1] / s->film.strip[1];
    s->wet_def.fps = s->film.fps;
    s->film.over = frame_over;
    return spring_wet_create(&s->wet_def, &s->wet);
}

static bool frame_after(void *context, int frame, int frames)
{
    struct spring *s = context;
    if (frame == 1)
        s->progress = progress_begin("spring", frames);
    progress_show(&s->progress, frame);
    return interrupted();
}

/* The sound must exist before the film's first picture: another stage runs ahead without
 * drawing. */
static int sound_make(struct spring *s)
{
    struct spring_scene ahead;
    struct spring_sound *sound = NULL;
    s->silent = s->silent || s->film.loop_s > 0;
    if (!s->sound_path && (!s->film.video || s->silent))
        return EXIT_SUCCESS;
    if (spring_scene_make(&s->scene, &ahead) != STAGE_OK ||
        (s->replay && stage_session_replay(ahead.stage, s->replay) != STAGE_OK)) {
        spring_scene_finish(&ahead);
        return fail_stage();
    }
    if (map_begin(s, ahead.stage) != EXIT_SUCCESS) {
        spring_scene_finish(&ahead);
        return EXIT_FAILED;
    }
    enum midi_status status = spring_sound_hear(ahead.stage, s->film.fps, s->film.seconds,
                                                frame_before, s, s->song, &sound);
    live_end(&s->live); /* another one plays the film */
    spring_scene_finish(&ahead);
    if (status == MIDI_OK && s->film.video && !s->silent)
        status = spring_sound_open(sound, &s->film.sound);
    if (status == MIDI_OK && s->sound_path)
        status = spring_sound_write(sound, s->sound_path);
    if (status == MIDI_OK && s->sound_path)
        visible_print("%d sounds in %s\n", spring_sound_count(sound), s->sound_path);
    spring_sound_destroy(sound);
    if (status == MIDI_OK)
        return EXIT_SUCCESS;
    if (s->sound_path)
        return fail("spring", "--sound: %s", midi_error());
    visible_say("lutetia spring: the film is silent: %s", midi_error());
    return EXIT_SUCCESS;
}

/* A film of what is played or replayed lasts as long, and a second for its last sound. */
static int film_seconds(struct spring *s, struct stage *stage)
{
    const double last_s = 1, most_s = 3600;
    if (!isnan(s->film.seconds))
        return EXIT_SUCCESS;
    double cues_s = 0;
    if (s->live_options.cues) {
        struct cues_text cues;
        const enum stage_status read = cues_file_read(s->live_options.cues, &cues);
        cues_s = cues_text_seconds(&cues) + last_s;
        cues_text_finish(&cues);
        if (read != STAGE_OK)
            return fail_stage();
    }
    s->film.seconds = s->replay    ? stage_replay_seconds(stage) + last_s
                      : s->song    ? (double)midi_song_info(s->song).end_ns / 1e9 + last_s
                      : cues_s > 0 ? cues_s
                                   : s->usual_s;
    return s->film.seconds <= most_s
               ? EXIT_SUCCESS
               : fail("spring", "%s takes %.0f s: say by --seconds S how many are wanted",
                      s->replay      ? s->replay
                      : s->song_path ? s->song_path
                                     : s->live_options.cues,
                      s->film.seconds);
}

static int film_make(struct spring *s, struct stage *stage)
{
    if (film_seconds(s, stage) != EXIT_SUCCESS)
        return EXIT_FAILED;
    if ((s->frames && folder_make("spring", s->frames) != EXIT_SUCCESS) ||
        output_check("spring", s->film.still) != EXIT_SUCCESS ||
        output_check("spring", s->save) != EXIT_SUCCESS)
        return EXIT_FAILED;
    s->film.frames = s->frames;
    s->film.before = frame_before;
    s->film.due_s = frame_due_s;
    s->film.after = frame_after;
    s->film.context = s;
    if (sound_make(s) != EXIT_SUCCESS || map_begin(s, stage) != EXIT_SUCCESS)
        return EXIT_FAILED;
    int wet = wet_begin(s);
    if (wet != EXIT_SUCCESS)
        return wet;
    enum stage_status status = stage_film(stage, &s->film);
    progress_end(&s->progress);
    if (s->film.sound >= 0)
        close(s->film.sound);
    if (status == STAGE_OK && interrupted())
        return EXIT_FAILED; /* the error is printed at the end */
    return status == STAGE_OK ? EXIT_SUCCESS : fail_stage();
}

static void sounds_play(void *context, struct stage *stage)
{
    struct spring *s = context;
    live_sound_take(s->sound, stage);
    const char *said = live_sound_said(s->sound);
    if (said && s->live.window)
        stage_window_say(s->live.window, said);
}

static void song_heard(void *context, const struct midi_message *m, double late_s)
{
    const struct spring *s = context;
    live_sound_song(s->sound, m, late_s);
}

static void sound_told(void *context, const struct stage_sound *sound)
{
    const struct spring *s = context;
    if (s->live.player)
        live_player_heard(s->live.player, sound);
}

static void recording_sounds(void *context, double now_s)
{
    struct spring *s = context;
    s->recording_s = now_s;
    live_sound_record(s->sound);
}

static int recording_heard(void *context, double now_s, const char **why)
{
    struct spring *s = context;
    int file;
    (void)now_s; /* which is when it ends */
    if (live_sound_recorded(s->sound, s->song, s->recording_s, &file) != MIDI_OK)
        *why = midi_error();
    return file;
}

/* A window without sound is a window, and its recordings may have some; a device that is asked
 * for must be there. */
static int window_sound(struct spring *s)
{
    const struct live_sound_def def = {.synth = !s->silent,
                                       .song = s->song != NULL,
                                       .server = s->live_options.server,
                                       .device = s->play,
                                       .waits = true,
                                       .heard = s->live_options.osc_to ? sound_told : NULL,
                                       .context = s};
    if (s->silent && !s->play && !s->live_options.osc_to)
        return EXIT_SUCCESS;
    enum midi_status status = live_sound_open(&def, &s->sound);
    if (status != MIDI_OK && s->play)
        return fail("spring", "--play: %s", midi_error());
    if (status != MIDI_OK) {
        snprintf(s->live.note, sizeof s->live.note, "the window is silent: %s", midi_error());
        status = live_sound_open(&(struct live_sound_def){.heard = def.heard, .context = s},
                                 &s->sound);
    }
    if (status != MIDI_OK)
        return EXIT_SUCCESS;
    if (live_sound_silent(s->sound))
        snprintf(s->live.note, sizeof s->live.note, "the window is silent: %s",
                 live_sound_silent(s->sound));
    s->window.after = sounds_play;
    s->window.after_context = s;
    if (!s->silent) {
        s->window.sound_begin = recording_sounds;
        s->window.sound_end = recording_heard;
    }
    return EXIT_SUCCESS;
}

static int window_run(struct spring *s, struct stage *stage)
{
    s->window.save_path = s->save ? s->save : "spring.springs";
    s->live.verb = "spring";
    s->live_options.played = song_heard;
    s->live_options.played_context = s;
    if (map_begin(s, stage) != EXIT_SUCCESS || window_sound(s) != EXIT_SUCCESS)
        return EXIT_FAILED;
    if (s->session && stage_session_follow(stage, s->session) != STAGE_OK)
        return fail_stage();
    return live_window(&s->live, stage, &s->window,
                       "run it where there is a desktop, or take --still FILE or --video FILE");
}

static int spring_run(struct spring *s, struct stage *stage)
{
    if (s->controls)
        return controls_print(stage);
    if (s->replay && stage_session_replay(stage, s->replay) != STAGE_OK)
        return fail_stage();
    interrupt_catch();
    bool film = s->film.still || s->film.video || s->frames;
    if (s->song_path && midi_song_read(s->song_path, &s->song) != MIDI_OK)
        return fail("spring", "--song: %s", midi_error());
    int status = film ? film_make(s, stage) : window_run(s, stage);
    if (status == EXIT_SUCCESS && film && s->save && stage_save(stage, s->save) != STAGE_OK)
        status = fail_stage();
    enum stage_status kept = STAGE_OK;
    if (!film)
        kept = stage_session_end(stage);
    else if (status == EXIT_SUCCESS && s->session)
        kept = stage_session_save(stage, s->session);
    if (kept != STAGE_OK && status == EXIT_SUCCESS)
        status = fail_stage();
    return interrupt_report("spring", status, "what was written before is whole");
}

int verb_spring(int argc, char **argv)
{
    return verb_spring_lasting(argc, argv, 5);
}

int verb_spring_lasting(int argc, char **argv, double seconds)
{
    static struct spring s;
    struct spring_scene scene;
    bool help = false;
    s = (struct spring){.film = stage_film_def_default(),
                        .window = stage_window_def_default(),
                        .scene = spring_scene_def_default(),
                        .way = "exact",
                        .usual_s = seconds,
                        .wet_def = spring_wet_def_default(),
                        .size = {1280, 720}};
    s.window.title = "springs";
    s.window.record_path = "spring.mp4";
    s.film.seconds = NAN; /* until it is known what lasts */
    const char *usual = s.scene.font;
    s.scene.font = s.scene.theme = NULL;
    int status = spring_options(&s, argc, argv, &help);
    char *font = NULL, *filter = NULL;
    if (status == EXIT_SUCCESS && !help && s.film.filter)
        status = type_filter_read("spring", s.film.filter, &filter);
    if (filter)
        s.film.filter = filter;
    if (status == EXIT_SUCCESS && !help)
        status = type_font_name("spring", s.scene.font, s.edits, usual, &font);
    if (status != EXIT_SUCCESS || help) {
        free(filter);
        return status;
    }
    s.scene.font = font;
    if (!s.scene.theme)
        s.scene.theme = live_theme(&s.live_options);
    if (!s.scene.theme)
        s.scene.theme = spring_scene_def_default().theme;
    s.live_options.theme = s.scene.theme;
    s.scene.sets = s.sets.texts;
    s.scene.sets_count = s.sets.count;
    s.scene.forgets = !s.session;
    enum stage_status made = spring_scene_make(&s.scene, &scene);
    if (made != STAGE_OK) {
        free(font);
        free(filter);
        return made == STAGE_BAD_ARGUMENT ? fail_usage("spring", "%s", stage_error())
                                          : fail_stage();
    }
    type_edits_tell("spring");
    if (scene.face && s.scene.text)
        type_text_check("spring", s.scene.font, scene.face, s.scene.text);
    status = spring_run(&s, scene.stage);
    live_end(&s.live);
    live_sound_close(s.sound);
    spring_wet_destroy(s.wet);
    midi_song_destroy(s.song);
    midi_song_destroy(s.silence);
    spring_scene_finish(&scene);
    free(font);
    free(filter);
    return status;
}
