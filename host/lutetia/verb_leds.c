/* verb_leds.c - `lutetia leds`: the machine's lights, in a window and in pictures.
 *
 * Frames come from one of three sources: a program, whose libparis writes them into a pipe
 * (LUTETIA_LEDS); a recording, in a file or from the standard input; the system's patterns.
 * frame_take() handles all of them.
 *
 * A program is shown as it runs: all frames are read, and the window shows the newest. A
 * recording and a pattern wait until each frame's time has come (pace()).
 */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "shown.h"
#include "shown_window.h"

#include <front_panel.h>
#include <light_recording.h>
#include <paris_internal.h>
#include <window.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct leds {
    const char *out_path, *frames_dir, *view, *pattern;
    int size[2], every, count; /* count 0: until the window is closed */
    int pictures_most;         /* that a recording's times may ask for; 0: by its lights */
    double fps, brightness;    /* fps 0: a picture for each latch */
    double pattern_fps;        /* steps in a window */
    bool window_wanted, close_at_end;

    struct shown_window the_window, *window; /* NULL: no window */
    struct shown_clock clock;
    bool closed; /* there was a window, and the user closed it */
    bool paced;  /* frames wait for their times */
    struct shown source;
    struct light_reader reader;

    struct front_panel *panel;
    struct display_image image;
    struct light_frame last;          /* the last frame taken */
    uint8_t drawn[FRONT_PANEL_BYTES]; /* in the window */
    uint64_t taken;
    int written, status;
    struct progress progress;
    double drawn_s;
};

/* ---- pictures ---- */

static int picture_write(struct leds *leds, const char *path)
{
    if (front_panel_draw(leds->panel, leds->last.lights, &leds->image) != DISPLAY_OK ||
        display_png_write(path, &leds->image) != DISPLAY_OK)
        return fail("leds", "%s", display_error());
    return EXIT_SUCCESS;
}

static int frame_write(struct leds *leds)
{
    char path[4096];
    int length =
        snprintf(path, sizeof path, "%s/frame-%06d.png", leds->frames_dir, leds->written);
    if (length < 0 || (size_t)length >= sizeof path)
        return fail("leds", "--frames: the folder's name is too long");
    if (leds->written == SHOWN_PICTURES_MOST)
        return fail("leds", "a million pictures are enough; take --every or a lower --fps");
    leds->written++;
    return picture_write(leds, path);
}

static void progress_line(struct leds *leds)
{
    double now = seconds_now();
    if (!leds->progress.shown || now - leds->drawn_s < 0.1)
        return;
    leds->drawn_s = now;
    fprintf(stderr, "\rlights: %llu latched, %d pictures \033[K",
            (unsigned long long)leds->taken, leds->written);
    fflush(stderr);
}

static int go_on(const struct leds *leds)
{
    return leds->status == EXIT_SUCCESS && !leds->closed && !interrupted();
}

/* ---- the window ---- */

enum { WINDOW_FPS = 30, PATTERN_FPS = 10 };

static void turn(struct leds *leds, double wait_s)
{
    bool open = true;
    if (!leds->window) {
        usleep((useconds_t)(wait_s * 1e6));
        return;
    }
    if (shown_window_turn(leds->window, wait_s, &open) != DISPLAY_OK)
        leds->status = fail("leds", "%s", display_error());
    if (!open)
        leds->closed = true;
}

/* Waits until the window's clock has reached that time since the first frame. */
static void pace(struct leds *leds, double time_s)
{
    for (double left_s; go_on(leds) && (left_s = shown_clock_wait_s(&leds->clock, time_s)) > 0;)
        turn(leds, left_s < 0.1 ? left_s : 0.1);
}

static bool lights_stale(void *context)
{
    const struct leds *leds = context;
    return memcmp(leds->last.lights, leds->drawn, sizeof leds->drawn) != 0;
}

static enum display_status lights_draw(void *context, struct display_image *image)
{
    struct leds *leds = context;
    memcpy(leds->drawn, leds->last.lights, sizeof leds->drawn);
    return front_panel_draw(leds->panel, leds->drawn, image);
}

/* If no window can be opened, and none was requested, writes pictures instead. */
static int window_open(struct leds *leds)
{
    char title[sizeof leds->source.name + 16];
    if (!leds->window_wanted && (leds->out_path || leds->frames_dir || !window_possible()))
        return EXIT_SUCCESS;
    snprintf(title, sizeof title, "%s - lights", leds->source.name);
    double fps = leds->fps > 0 ? leds->fps : fmax(WINDOW_FPS, leds->pattern_fps);
    leds->the_window = (struct shown_window){
        .stale = lights_stale, .draw = lights_draw, .context = leds, .clock = &leds->clock};
    enum display_status status =
        shown_window_open(&leds->the_window, title, leds->size[0], leds->size[1], fps);
    if (status == DISPLAY_OK)
        leds->window = &leds->the_window;
    if (status != DISPLAY_OK && leds->window_wanted)
        return fail(
            "leds",
            "--window: %s; run it where there is a desktop, or take -o FILE or --frames "
            "DIR for pictures",
            display_error());
    if (status != DISPLAY_OK)
        tell("leds", "%s; the last lights go to leds.png", display_error());
    return EXIT_SUCCESS;
}

/* The source has ended; shows the last picture until the user closes the window. */
static void window_linger(struct leds *leds)
{
    char title[sizeof leds->source.name + 32];
    if (!leds->window || !leds->taken)
        return;
    if (leds->close_at_end) { /* show the last frame, however short */
        turn(leds, 0.1);
        return;
    }
    snprintf(title, sizeof title, "%s - lights (ended)", leds->source.name);
    shown_window_title(leds->window, title);
    while (go_on(leds))
        turn(leds, 0.1);
}

/* With --fps: writes the previous frame for the times before this frame. */
static void time_fill(struct leds *leds, uint64_t until_us)
{
    if (!shown_times_good(&leds->source, until_us, leds->fps, leds->pictures_most, leds->taken,
                          "light")) {
        leds->status = EXIT_FAILED;
        return;
    }
    while (go_on(leds) && (double)leds->written / leds->fps * 1e6 < (double)until_us) {
        leds->status = frame_write(leds);
        progress_line(leds);
    }
}

static int frame_take(void *context, const struct light_frame *frame)
{
    struct leds *leds = context;
    const uint64_t time_us = shown_time_us(&leds->source, frame->time_us);
    if (leds->frames_dir && leds->fps > 0 && leds->taken)
        time_fill(leds, time_us);
    if (leds->window && leds->paced)
        pace(leds, (double)time_us * 1e-6);
    leds->last = *frame;
    if (go_on(leds) && leds->frames_dir && leds->fps <= 0 &&
        leds->taken % (uint64_t)leds->every == 0)
        leds->status = frame_write(leds);
    leds->taken++;
    progress_line(leds);
    return go_on(leds);
}

/* ---- sources ---- */

static int from_pattern(struct leds *leds)
{
    static const struct {
        const char *name;
        unsigned int mode;
    } patterns[] = {{"random", PARIS_PATTERN_RANDOM},
                    {"noise", PARIS_PATTERN_NOISE},
                    {"on", PARIS_PATTERN_ON}};
    unsigned int mode = 0;
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++)
        if (strcmp(leds->pattern, patterns[i].name) == 0)
            mode = patterns[i].mode;
    struct paris_pattern pattern = paris_pattern_begin(mode);
    for (uint64_t i = 0; (!leds->count || i < (uint64_t)leds->count) && go_on(leds); i++) {
        struct light_frame frame = {.number = i,
                                    .time_us = (uint64_t)((double)i * 1e6 / leds->pattern_fps)};
        paris_pattern_step(&pattern, frame.lights);
        frame_take(leds, &frame);
    }
    return leds->status;
}

static bool source_goes_on(void *context)
{
    return go_on(context);
}

static void source_turn(void *context, double wait_s)
{
    turn(context, wait_s);
}

static bool source_has_window(void *context)
{
    return ((struct leds *)context)->window != NULL;
}

static bool source_taken(void *context)
{
    return ((struct leds *)context)->taken > 0;
}

static enum display_status source_feed(void *context, const uint8_t *bytes, size_t count)
{
    return light_reader_feed(&((struct leds *)context)->reader, bytes, count);
}

static enum display_status source_end(void *context)
{
    return light_reader_end(&((struct leds *)context)->reader);
}

/* ---- the verb ---- */

/* Makes the front panel, once it is known where it is shown. */
static int panel_make(struct leds *leds, bool window_only)
{
    struct front_panel_config config = front_panel_config_default();
    config.width_px = leds->size[0];
    config.height_px = leds->size[1];
    config.brightness = leds->brightness;
    config.view = strcmp(leds->view, "door") == 0    ? FRONT_PANEL_DOOR
                  : strcmp(leds->view, "front") == 0 ? FRONT_PANEL_FRONT
                                                     : FRONT_PANEL_CUBE;
    if (window_only) { /* no more pixels than a small screen has, which would only be scaled
                        * down */
        int width, height;
        window_size(leds->window->window, &width, &height);
        if (width < config.width_px && width >= FRONT_PANEL_SIDE_MIN &&
            height >= FRONT_PANEL_SIDE_MIN) {
            config.width_px = width;
            config.height_px = height;
        }
    }
    if (front_panel_create(&config, &leds->panel) != DISPLAY_OK ||
        (leds->window && shown_window_draw(leds->window) != DISPLAY_OK))
        return fail("leds", "%s", display_error());
    if (leds->window && !shown_ready(&leds->source))
        return EXIT_FAILED; /* the program has gone */
    return EXIT_SUCCESS;
}

static int leds_run(struct leds *leds, int argc, char **argv)
{
    int status = leds->frames_dir ? folder_make("leds", leds->frames_dir) : EXIT_SUCCESS;
    if (status != EXIT_SUCCESS)
        return status;
    if (leds->pattern) { /* a pattern has no times: each step is a picture */
        leds->pattern_fps = leds->fps > 0 ? leds->fps : PATTERN_FPS;
        leds->fps = 0;
    }
    interrupt_catch();
    shown_name(&leds->source, leds->pattern ? leds->pattern : argv[0]);
    status = window_open(leds);
    bool window_only = leds->window && !leds->out_path && !leds->frames_dir;
    if (status == EXIT_SUCCESS)
        status = panel_make(leds, window_only);
    if (status != EXIT_SUCCESS)
        return status;
    leds->paced = leds->pattern || (argc == 1 && shown_is_recording(&leds->source, argv[0]));
    if (leds->pattern && !leds->count && !window_only)
        leds->count = 64;
    if (!window_only)
        leds->progress = progress_begin("lights", 0);
    status = leds->pattern ? from_pattern(leds) : shown_source(&leds->source, argc, argv);
    if (status == EXIT_SUCCESS && leds->frames_dir && leds->fps > 0 && leds->taken &&
        go_on(leds))
        status = frame_write(leds); /* show the last frame, however short */
    progress_end(&leds->progress);
    window_linger(leds);
    if (leds->closed)
        shown_interrupt(&leds->source);
    if (interrupted())
        return EXIT_INTERRUPTED;
    if (status != EXIT_SUCCESS || leds->status != EXIT_SUCCESS)
        return status != EXIT_SUCCESS ? status : leds->status;
    if (!leds->taken)
        return leds->closed
                   ? EXIT_SUCCESS
                   : fail("leds", "%s: no lights: the program never called CM_latch_leds",
                          argv[0]);
    if (leds->window && !leds->out_path)
        return EXIT_SUCCESS;
    return picture_write(leds, leds->out_path ? leds->out_path : "leds.png");
}

/* Checks the options together. 0: they can be combined; else the exit status. */
static int words_check(const struct leds *leds, int argc, char **argv)
{
    if (strcmp(leds->view, "cube") != 0 && strcmp(leds->view, "front") != 0 &&
        strcmp(leds->view, "door") != 0)
        return fail_usage("leds", "--view must be cube, front or door (got '%.60s')",
                          leds->view);
    if (leds->pattern && strcmp(leds->pattern, "random") != 0 &&
        strcmp(leds->pattern, "noise") != 0 && strcmp(leds->pattern, "on") != 0)
        return fail_usage("leds", "--pattern must be random, noise or on (got '%.60s')",
                          leds->pattern);
    if (leds->pictures_most && (!leds->frames_dir || leds->fps <= 0 || leds->pattern))
        return fail_usage("leds", "--pictures is for a recording, with --frames and --fps");
    if (!leds->pattern == !argc)
        return fail_usage("leds",
                          "give a program, a recording, or --pattern random: one of them");
    if (argc > 1 && (shown_is_recording(&leds->source, argv[0]) || strcmp(argv[0], "-") == 0))
        return fail_usage("leds", "options stand before the recording (after it came '%.60s')",
                          argv[1]);
    return 0;
}

static void source_prepare(struct leds *leds)
{
    leds->reader = (struct light_reader){.take = frame_take, .context = leds};
    leds->source = (struct shown){.verb = "leds",
                                  .variable = "LUTETIA_LEDS",
                                  .line = LIGHT_RECORDING_LINE,
                                  .context = leds,
                                  .go_on = source_goes_on,
                                  .turn = source_turn,
                                  .has_window = source_has_window,
                                  .taken = source_taken,
                                  .feed = source_feed,
                                  .end = source_end,
                                  .lock = PTHREAD_MUTEX_INITIALIZER};
}

int verb_leds(int argc, char **argv)
{
    struct leds leds = {.view = "cube", .size = {960, 960}, .every = 1, .brightness = 1};
    source_prepare(&leds);
    const struct option_row rows[] = {
        {"window", 0, OPTION_FLAG, NULL,
         "show the lights as they change; without -o and --frames it is so where there is a "
         "display",
         &leds.window_wanted, 0, 0, 0},
        {"close", 0, OPTION_FLAG, NULL, "the window closes when the program has ended",
         &leds.close_at_end, 0, 0, 0},
        {"out", 'o', OPTION_PNG, "FILE",
         "the picture of the last lights (leds.png, where no window shows them)",
         &leds.out_path, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR",
         "write a numbered picture for each latch into this folder", &leds.frames_dir, 0, 0, 0},
        {"every", 0, OPTION_INTEGER, "N", "write only each Nth latch (1)", &leds.every, 1, 1e9,
         0},
        {"fps", 0, OPTION_NUMBER, "F",
         "instead, write so many for each second that the program ran; in a window the most a "
         "second (30)",
         &leds.fps, 0.001, 1000, 0},
        {"pictures", 0, OPTION_INTEGER, "N",
         "with --fps: the most pictures that the times in a recording may ask for (3000, and "
         "100 for each light)",
         &leds.pictures_most, 1, SHOWN_PICTURES_MOST, 0},
        {"size", 0, OPTION_SIZE, "WxH", "size of a picture (960x960)", leds.size,
         FRONT_PANEL_SIDE_MIN, FRONT_PANEL_SIDE_MAX, 0},
        {"view", 0, OPTION_TEXT, "VIEW",
         "what is seen: cube, front (its four doors), or door, the first of them (cube)",
         &leds.view, 0, 0, 0},
        {"brightness", 0, OPTION_NUMBER, "B", "brightness of the lights, 0..10 (1)",
         &leds.brightness, 0, 10, 0},
        {"pattern", 0, OPTION_TEXT, "NAME",
         "the machine's own pattern instead of a program: random, noise or on", &leds.pattern,
         0, 0, 0},
        {"count", 0, OPTION_INTEGER, "N",
         "steps of the pattern, in a window --fps a second (64; there until it is closed)",
         &leds.count, 1, 1e6, 0},
        {0}};
    int own = options_own(rows, argc, argv);
    struct option_words words;
    if (!options_parse("leds", rows, own, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("leds", rows, NULL);
    argc -= own;
    argv += own;
    if (argc > 0 && strcmp(argv[0], "--") == 0) {
        argc--;
        argv++;
    }
    int bad = words_check(&leds, argc, argv);
    if (bad)
        return bad;
    int status = leds_run(&leds, argc, argv);
    shown_window_close(leds.window);
    display_image_destroy(&leds.image);
    front_panel_destroy(leds.panel);
    if (leds.window && leds.source.watched)
        return status; /* the program was interrupted, not this command */
    if (leds.window && !leds.out_path && status == EXIT_INTERRUPTED) {
        fail("leds", "interrupted");
        return status;
    }
    return interrupt_report("leds", status, "the last picture is");
}
