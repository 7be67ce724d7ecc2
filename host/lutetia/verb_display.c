/* verb_display.c - `lutetia display`: the frame buffer's displays, in windows, stills, frames
 * and films.
 *
 * A recording comes from a program, a file or the standard input (shown.h), and
 * display_recording.h makes screens of it. Each change of what is seen is a picture. Where a
 * window alone is wanted, a thread reads, and the newest picture is drawn; where pictures are
 * written, each is, and the program waits for it.
 *
 * The first display's files have the names that are given. Those of display N have -N before
 * the ending, and its frames are frame-N-000001.png. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "shown.h"
#include "shown_window.h"

#include <display_recording.h>
#include <video.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct displays;
struct screen {
    struct displays *all;
    int number;
    struct shown_window window;
    bool opened, stale;         /* a window is wanted; there is something new to be drawn */
    struct display_image image; /* the last picture, where pictures are written */
    bool pictured;              /* there is one */
    struct video *film;
    int written; /* frames */
};

struct displays {
    const char *out_path, *frames_dir, *film_path;
    int every, pictures_most;
    double fps; /* 0: each picture */
    bool window_wanted, close_at_end;

    struct shown source;
    struct display_reader reader;
    struct shown_clock clock;
    struct screen screens[DISPLAY_SCREENS];
    bool windowed; /* windows are opened for displays */
    bool closed;   /* the user closed one */
    bool paced;    /* pictures wait for their times */
    uint64_t pictures;
    int status;
    struct progress progress;
    double drawn_s;
};

enum { FILM_FPS = 30, WINDOW_FPS = 60 };

#define OPENING_S 0.004 /* how often it is looked whether a window is wanted */

static bool go_on(void *context)
{
    const struct displays *d = context;
    return d->status == EXIT_SUCCESS && !d->closed && !interrupted();
}

/* ---- files ---- */

/* PATH, and for display 2 PATH with -2 before its ending. */
static const char *path_of(const struct screen *s, const char *path, char *room, size_t bytes)
{
    const char *base = strrchr(path, '/'), *dot = strrchr(path, '.');
    if (s->number == 1)
        return path;
    if (!dot || (base && dot < base))
        dot = path + strlen(path);
    snprintf(room, bytes, "%.*s-%d%s", (int)(dot - path), path, s->number, dot);
    return room;
}

static int still_write(struct screen *s, const char *path)
{
    char room[4096];
    if (display_screen_picture(&s->all->reader.screens[s->number - 1], &s->image) !=
            DISPLAY_OK ||
        display_png_write(path_of(s, path, room, sizeof room), &s->image) != DISPLAY_OK)
        return fail("display", "%s", display_error());
    return EXIT_SUCCESS;
}

static int frame_write(struct screen *s)
{
    char path[4096], number[16] = "";
    if (s->number > 1)
        snprintf(number, sizeof number, "%d-", s->number);
    const int length = snprintf(path, sizeof path, "%s/frame-%s%06d.png", s->all->frames_dir,
                                number, s->written);
    if (length < 0 || (size_t)length >= sizeof path)
        return fail("display", "--frames: the folder's name is too long");
    return display_png_write(path, &s->image) == DISPLAY_OK
               ? EXIT_SUCCESS
               : fail("display", "%s", display_error());
}

/* The picture with a last column and row of black where a side is odd: films have even
 * sides. */
static uint8_t *even_picture(const struct display_image *image, int width, int height)
{
    uint8_t *even = calloc((size_t)width * (size_t)height, 3);
    for (int y = 0; even && y < image->height_px; y++)
        memcpy(even + 3 * (size_t)y * (size_t)width,
               image->pixels + 3 * (size_t)y * (size_t)image->width_px,
               3 * (size_t)image->width_px);
    return even;
}

static int film_add(struct screen *s)
{
    const int width = s->image.width_px + (s->image.width_px & 1),
              height = s->image.height_px + (s->image.height_px & 1);
    const double fps = s->all->fps > 0 ? s->all->fps : FILM_FPS;
    char room[4096];
    if (!s->film && video_create(path_of(s, s->all->film_path, room, sizeof room), width,
                                 height, (int)lround(fps), &s->film) != DISPLAY_OK)
        return fail("display", "%s", display_error());
    uint8_t *even = even_picture(&s->image, width, height);
    if (!even)
        return fail("display", "not enough memory for a picture of %d x %d", width, height);
    const enum display_status status = video_add(s->film, even);
    free(even);
    return status == DISPLAY_OK ? EXIT_SUCCESS : fail("display", "%s", display_error());
}

static int picture_write(struct screen *s)
{
    int status = EXIT_SUCCESS;
    if (s->written == SHOWN_PICTURES_MOST)
        return fail("display", "a million pictures are enough; take --every or a lower --fps");
    if (s->all->frames_dir)
        status = frame_write(s);
    if (status == EXIT_SUCCESS && s->all->film_path)
        status = film_add(s);
    s->written++;
    return status;
}

static void progress_line(struct displays *d)
{
    const double now = seconds_now();
    if (!d->progress.shown || now - d->drawn_s < 0.1)
        return;
    d->drawn_s = now;
    fprintf(stderr, "\rdisplay: %llu pictures \033[K", (unsigned long long)d->pictures);
    fflush(stderr);
}

/* With --fps: writes the last picture for the times before the next. */
static int time_fill(struct screen *s, uint64_t until_us)
{
    struct displays *d = s->all;
    int status = EXIT_SUCCESS;
    if (!shown_times_good(&d->source, until_us, d->fps, d->pictures_most, d->pictures,
                          "picture"))
        return EXIT_FAILED;
    while (status == EXIT_SUCCESS && !interrupted() &&
           (double)s->written / d->fps * 1e6 < (double)until_us)
        status = picture_write(s);
    return status;
}

/* ---- windows ---- */

static bool screen_stale(void *context)
{
    struct screen *s = context;
    pthread_mutex_lock(&s->all->source.lock);
    const bool stale = s->stale;
    pthread_mutex_unlock(&s->all->source.lock);
    return stale;
}

static enum display_status screen_draw(void *context, struct display_image *image)
{
    struct screen *s = context;
    const struct display_screen *screen = &s->all->reader.screens[s->number - 1];
    pthread_mutex_lock(&s->all->source.lock);
    enum display_status status = DISPLAY_OK;
    if (screen->there)
        status = display_screen_picture(screen, image);
    else
        display_image_destroy(image);
    s->stale = false;
    pthread_mutex_unlock(&s->all->source.lock);
    return status;
}

static bool screen_paint(void *context, struct window *window)
{
    struct screen *s = context;
    window_settle(window);
    pthread_mutex_lock(&s->all->source.lock);
    const bool there = s->all->reader.screens[s->number - 1].there,
               painted = there && shown_window_paint(window, &s->all->reader, s->number);
    s->stale = s->stale && there && !painted;
    pthread_mutex_unlock(&s->all->source.lock);
    return painted || !there; /* of a display that has gone, what was seen stays */
}

static void title_of(const struct screen *s, const char *after, char *title, size_t bytes)
{
    const char *name = s->all->reader.screens[s->number - 1].title;
    snprintf(title, bytes, "%s - display%s", *name ? name : s->all->source.name, after);
}

/* A window cannot be opened. A watched program goes on. */
static void window_missing(struct displays *d)
{
    pthread_mutex_lock(&d->source.lock);
    d->windowed = false;
    if (d->window_wanted && !d->source.watched)
        d->status = fail("display",
                         "--window: %s; run it where there is a desktop, or take -o FILE, "
                         "--frames DIR or --film FILE for pictures",
                         display_error());
    else
        tell("display", "%s%s", display_error(),
             d->source.watched || d->out_path ? "" : "; the last picture goes to display.png");
    if (!d->window_wanted && !d->out_path)
        d->out_path = "display.png";
    pthread_mutex_unlock(&d->source.lock);
}

/* Opens the windows of displays that are new. Where none can be opened, what comes is read all
 * the same. */
static void windows_open(struct displays *d)
{
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        struct screen *s = &d->screens[i];
        char title[100];
        pthread_mutex_lock(&d->source.lock);
        const bool wanted = s->opened;
        const int width = d->reader.screens[i].width_px,
                  height = d->reader.screens[i].height_px;
        title_of(s, "", title, sizeof title);
        s->opened = false;
        pthread_mutex_unlock(&d->source.lock);
        if (!wanted || !d->windowed || s->window.window)
            continue;
        s->window.stale = screen_stale;
        s->window.draw = screen_draw;
        s->window.paint = screen_paint;
        s->window.context = s;
        s->window.clock = &d->clock;
        if (shown_window_open(&s->window, title,
                              width < WINDOW_SIDE_MIN ? WINDOW_SIDE_MIN : width,
                              height < WINDOW_SIDE_MIN ? WINDOW_SIDE_MIN : height,
                              d->fps > 0 ? d->fps : WINDOW_FPS) == DISPLAY_OK)
            continue;
        window_missing(d);
    }
}

/* Draws what is due, and takes the windows' events. The lock is not held. */
static void windows_draw(struct displays *d)
{
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        struct shown_window *window = &d->screens[i].window;
        bool open = true;
        if (!window->window)
            continue;
        const enum display_status status = shown_window_turn(window, 0, &open);
        if (status == DISPLAY_OK && open)
            continue;
        pthread_mutex_lock(&d->source.lock);
        if (status != DISPLAY_OK)
            d->status = fail("display", "%s", display_error());
        d->closed = d->closed || !open;
        pthread_mutex_unlock(&d->source.lock);
    }
}

/* The seconds until a window is to be drawn, so many at most; negative: there is no window. */
static double windows_due_s(const struct displays *d, double most_s)
{
    double due_s = -1;
    for (int i = 0; i < DISPLAY_SCREENS; i++)
        if (d->screens[i].window.window)
            due_s = fmin(due_s < 0 ? most_s : due_s, shown_window_due_s(&d->screens[i].window));
    return due_s;
}

/* Waits until something happens, so many seconds at most. Events are asked for once: asking
 * takes as many calls of the system as all else. */
static void windows_turn(struct displays *d, double wait_s)
{
    windows_open(d);
    const double left_s = windows_due_s(d, wait_s);
    if (left_s < 0)
        usleep((useconds_t)(fmin(wait_s, OPENING_S) * 1e6));
    else
        window_wait(left_s);
    windows_draw(d);
}

static bool windows_stale(const struct displays *d)
{
    const double due_s = windows_due_s(d, INFINITY);
    return due_s >= 0 && due_s < INFINITY;
}

static void source_turn(void *context, double wait_s)
{
    windows_turn(context, wait_s);
}

/* Waits until the clock has reached that time. The lock is held, and given away meanwhile. */
static void pace(struct displays *d, double time_s)
{
    for (double left_s; go_on(d) && (left_s = shown_clock_wait_s(&d->clock, time_s)) > 0;) {
        pthread_mutex_unlock(&d->source.lock);
        windows_turn(d, left_s < 0.1 ? left_s : 0.1);
        pthread_mutex_lock(&d->source.lock);
    }
}

/* ---- the recording ---- */

/* There is something new to be drawn, by a thread that may be waiting. */
static void screen_changed(struct screen *s)
{
    if (!s->stale && s->all->source.apart)
        window_wake();
    s->stale = true;
}

/* Another picture is seen. */
static int picture_take(struct displays *d, struct screen *s, uint64_t time_us)
{
    int status = EXIT_SUCCESS;
    const bool writes = d->frames_dir || d->film_path;
    if (writes && d->fps > 0 && s->pictured)
        status = time_fill(s, time_us);
    if (d->paced && d->windowed)
        pace(d, (double)time_us * 1e-6);
    screen_changed(s);
    if (status == EXIT_SUCCESS && writes && d->pictures % (uint64_t)d->every == 0) {
        if (display_screen_picture(&d->reader.screens[s->number - 1], &s->image) != DISPLAY_OK)
            status = fail("display", "%s", display_error());
        s->pictured = true;
        if (status == EXIT_SUCCESS && d->fps <= 0)
            status = picture_write(s);
    }
    d->pictures++;
    progress_line(d);
    return status;
}

static int size_take(struct screen *s)
{
    const struct display_screen *screen = &s->all->reader.screens[s->number - 1];
    s->opened = true;
    screen_changed(s);
    if (s->film && s->pictured &&
        (s->image.width_px != screen->width_px || s->image.height_px != screen->height_px))
        return fail("display", "display %d got another size, and a film has one: take --frames",
                    s->number);
    return EXIT_SUCCESS;
}

static int change_take(void *context, const struct display_change *change)
{
    struct displays *d = context;
    struct screen *s = &d->screens[change->number - 1];
    const uint64_t time_us = shown_time_us(&d->source, change->time_us);
    if (change->opened)
        d->status = size_take(s);
    else if (change->seen)
        d->status = picture_take(d, s, time_us);
    else if (change->closed && d->out_path && go_on(d))
        d->status = still_write(s, d->out_path);
    return go_on(d);
}

static bool source_has_window(void *context)
{
    return ((struct displays *)context)->windowed;
}

static bool source_taken(void *context)
{
    return ((struct displays *)context)->pictures > 0;
}

static enum display_status source_feed(void *context, const uint8_t *bytes, size_t count)
{
    return display_reader_feed(&((struct displays *)context)->reader, bytes, count);
}

static enum display_status source_end(void *context)
{
    return display_reader_end(&((struct displays *)context)->reader);
}

/* ---- the end ---- */

/* The last pictures with --fps, stills, films. */
static int files_end(struct displays *d, int status)
{
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        struct screen *s = &d->screens[i];
        if (status == EXIT_SUCCESS && s->pictured && d->fps > 0)
            status = picture_write(s); /* show the last picture, however short */
        if (status == EXIT_SUCCESS && d->reader.screens[i].there && d->out_path)
            status = still_write(s, d->out_path);
        if (s->film && status != EXIT_SUCCESS)
            video_abandon(s->film);
        else if (s->film && video_finish(s->film) != DISPLAY_OK)
            status = fail("display", "%s", display_error());
        s->film = NULL;
    }
    return status;
}

/* The source has ended; shows the last pictures until the user closes a window. */
static void windows_linger(struct displays *d)
{
    bool any = false;
    if (!d->windowed || !go_on(d))
        return;
    const double until_s = seconds_now() + 0.1;
    do /* show the last picture, however short */
        windows_turn(d, 0.02);
    while (windows_stale(d) && go_on(d) && seconds_now() < until_s);
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        struct screen *s = &d->screens[i];
        char title[100];
        if (!s->window.window)
            continue;
        any = true;
        title_of(s, " (ended)", title, sizeof title);
        if (!d->close_at_end)
            shown_window_title(&s->window, title);
    }
    while (any && !d->close_at_end && go_on(d))
        windows_turn(d, 0.1);
}

static int displays_run(struct displays *d, int argc, char **argv)
{
    int status = d->frames_dir ? folder_make("display", d->frames_dir) : EXIT_SUCCESS;
    if (status == EXIT_SUCCESS)
        status = output_check("display", d->out_path);
    if (status != EXIT_SUCCESS)
        return status;
    interrupt_catch();
    shown_name(&d->source, argv[0]);
    const bool writes = d->out_path || d->frames_dir || d->film_path;
    d->windowed = d->window_wanted || (!writes && window_possible());
    if (d->windowed && !window_possible())
        return fail("display", "--window: no display: neither DISPLAY nor WAYLAND_DISPLAY is "
                               "set; take -o FILE, --frames DIR or --film FILE for pictures");
    if (!writes && !d->windowed)
        d->out_path = "display.png";
    if (!shown_ready(&d->source))
        return EXIT_FAILED; /* the program has gone */
    d->paced =
        argc == 1 && shown_is_recording(&d->source, argv[0]) && strcmp(argv[0], "-") != 0;
    d->source.apart = d->source.room_wanted = !writes && !d->paced;
    if (writes)
        d->progress = progress_begin("display", 0);
    status = shown_source(&d->source, argc, argv);
    if (status == EXIT_SUCCESS)
        status = d->status;
    progress_end(&d->progress);
    status = files_end(d, interrupted() ? EXIT_INTERRUPTED : status);
    if (status == EXIT_SUCCESS)
        windows_linger(d);
    if (d->closed)
        shown_interrupt(&d->source);
    if (interrupted())
        return EXIT_INTERRUPTED;
    if (status != EXIT_SUCCESS || d->status != EXIT_SUCCESS)
        return status != EXIT_SUCCESS ? status : d->status;
    if (!d->reader.pieces && !d->closed)
        return fail("display",
                    "%s: no display: the program never called CMFB_initialize_display",
                    argv[0]);
    return EXIT_SUCCESS;
}

/* Checks the options together. 0: they can be combined; else the exit status. */
static int words_check(const struct displays *d, int argc, char **argv)
{
    const bool writes = d->frames_dir || d->film_path;
    if (!argc)
        return fail_usage("display", "give a program or a recording");
    if (d->every != 1 && (!writes || d->fps > 0))
        return fail_usage("display", "--every is for --frames or --film, without --fps");
    if (d->pictures_most && (!writes || d->fps <= 0))
        return fail_usage("display", "--pictures is for a recording, with --fps");
    if (d->film_path && d->fps > 240)
        return fail_usage("display", "--fps: a film has 240 pictures a second at most");
    if (d->film_path && d->fps > 0 && d->fps < 1)
        return fail_usage("display", "--fps: a film has a picture a second at least");
    if (argc > 1 && (shown_is_recording(&d->source, argv[0]) || strcmp(argv[0], "-") == 0))
        return fail_usage(
            "display", "options stand before the recording (after it came '%.60s')", argv[1]);
    return 0;
}

static void displays_finish(struct displays *d)
{
    display_reader_finish(&d->reader);
    for (int i = 0; i < DISPLAY_SCREENS; i++) {
        shown_window_close(&d->screens[i].window);
        display_image_destroy(&d->screens[i].image);
    }
    picture_room_end(&d->source.room);
}

static void source_prepare(struct displays *d)
{
    d->reader =
        (struct display_reader){.take = change_take, .context = d, .shared = &d->source.room};
    d->source = (struct shown){.verb = "display",
                               .variable = "LUTETIA_DISPLAY",
                               .line = DISPLAY_RECORDING_LINE,
                               .context = d,
                               .go_on = go_on,
                               .turn = source_turn,
                               .wake = window_wake,
                               .has_window = source_has_window,
                               .taken = source_taken,
                               .feed = source_feed,
                               .end = source_end,
                               .lock = PTHREAD_MUTEX_INITIALIZER};
    for (int i = 0; i < DISPLAY_SCREENS; i++)
        d->screens[i] = (struct screen){.all = d, .number = i + 1};
}

int verb_display(int argc, char **argv)
{
    static struct displays d = {.every = 1};
    const struct option_row rows[] = {
        {"window", 0, OPTION_FLAG, NULL,
         "show the displays as they change; without -o, --frames and --film it is so where "
         "windows can be",
         &d.window_wanted, 0, 0, 0},
        {"close", 0, OPTION_FLAG, NULL, "the windows close when the program has ended",
         &d.close_at_end, 0, 0, 0},
        {"out", 'o', OPTION_PNG, "FILE",
         "the last picture (display.png, where no window shows it); of display 2 it has -2 in "
         "its name",
         &d.out_path, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR",
         "write a numbered picture for each change into this "
         "folder",
         &d.frames_dir, 0, 0, 0},
        {"film", 0, OPTION_TEXT, "FILE", "a film of the pictures, 30 a second", &d.film_path, 0,
         0, 0},
        {"every", 0, OPTION_INTEGER, "N", "write only each Nth picture (1)", &d.every, 1, 1e9,
         0},
        {"fps", 0, OPTION_NUMBER, "F",
         "instead, write so many for each second that the program ran; in a window the most a "
         "second (60)",
         &d.fps, 0.001, 1000, 0},
        {"pictures", 0, OPTION_INTEGER, "N",
         "with --fps: the most pictures that the times in a recording may ask for (3000, and "
         "100 for each picture)",
         &d.pictures_most, 1, SHOWN_PICTURES_MOST, 0},
        {0}};
    int own = options_own(rows, argc, argv);
    struct option_words words;
    if (!options_parse("display", rows, own, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("display", rows, NULL);
    argc -= own;
    argv += own;
    if (argc > 0 && strcmp(argv[0], "--") == 0) {
        argc--;
        argv++;
    }
    source_prepare(&d);
    const int bad = words_check(&d, argc, argv);
    if (bad)
        return bad;
    const int status = displays_run(&d, argc, argv);
    displays_finish(&d);
    if (d.source.watched)
        return status; /* the program was interrupted, not this command */
    return interrupt_report("display", status, "pictures that were written are");
}
