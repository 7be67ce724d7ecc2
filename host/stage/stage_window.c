/* stage_window.c - see stage_window.h. */
#include "stage_window.h"

#include "renderer.h"
#include "stage_recording.h"
#include "stage_stream.h"
#include "typed_words.h"

#include <window.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_S = 4 };
#define EARLY 0.25 /* of the time between pictures, where something is played meanwhile */

struct stage_window {
    struct stage *stage;
    struct stage_window_def def;
    struct window *window;
    struct stage_renderer *renderer;
    struct stage_panel *panel;
    struct stage_stream *stream; /* NULL: none */
    struct stage_draw_list list;
    struct frame_pace pace;
    double soonest_s; /* when the next picture may begin of which something is waited for */
    bool open, drawn; /* drawn: at least once */
    struct help_sheet help;
    struct typed_words words;
    char message[240];
    double message_s; /* when it was said */
    struct stage_recording recording;
};

struct stage_window_def stage_window_def_default(void)
{
    return (struct stage_window_def){.title = "stage",
                                     .width_px = 1280,
                                     .height_px = 800,
                                     .record_path = "stage.mp4",
                                     .save_path = "stage.net",
                                     .font = "DejaVuSans",
                                     .fps = 60};
}

__attribute__((format(printf, 2, 3))) static void say(struct stage_window *w,
                                                      const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(w->message, sizeof w->message, format, arguments);
    va_end(arguments);
    w->message_s = input_now_s();
}

/* ---- keys ---- */

static void key_pause(struct stage_window *w)
{
    struct frame_clock *clock = stage_clock(w->stage);
    clock->paused = !clock->paused;
}

static void key_single(struct stage_window *w)
{
    frame_clock_single(stage_clock(w->stage));
}

static void rate_times(struct stage_window *w, double factor)
{
    char text[64];
    struct frame_clock *clock = stage_clock(w->stage);
    snprintf(text, sizeof text, "rate=%.9g", fmin(10, fmax(0.01, clock->rate * factor)));
    stage_mark(w->stage);
    stage_set(w->stage, text);
    say(w, "rate %.3g", clock->rate);
}

static void key_slower(struct stage_window *w)
{
    rate_times(w, 0.5);
}

static void key_faster(struct stage_window *w)
{
    rate_times(w, 2);
}

static void key_reset(struct stage_window *w)
{
    if (stage_reset(w->stage) != STAGE_OK)
        say(w, "%s", stage_error());
}

static void key_undo(struct stage_window *w)
{
    if (!stage_undo(w->stage))
        say(w, "nothing to undo");
}

static void key_panel(struct stage_window *w)
{
    stage_panel_show(w->panel, !stage_panel_shown(w->panel));
}

static void key_record(struct stage_window *w)
{
    stage_recording_toggle(&w->recording, &w->def, w->renderer);
}

static void key_save(struct stage_window *w)
{
    if (stage_save(w->stage, w->def.save_path) == STAGE_OK)
        say(w, "saved in %s", w->def.save_path);
    else
        say(w, "%s", stage_error());
}

static void load(struct stage_window *w, const char *path)
{
    if (stage_load(w->stage, path) == STAGE_OK)
        say(w, "loaded from %s", path);
    else
        say(w, "%s", stage_error());
}

static void key_load(struct stage_window *w)
{
    load(w, w->def.save_path);
}

static void key_words(struct stage_window *w)
{
    typed_words_begin(&w->words, stage_actor(w->stage).kind->text != NULL);
}

static void key_full(struct stage_window *w)
{
    window_fullscreen_set(w->window, !window_fullscreen(w->window));
}

static void key_help(struct stage_window *w)
{
    w->help.shown = !w->help.shown;
    w->help.scrolled_px = 0;
}

static void key_end(struct stage_window *w)
{
    if (w->help.shown)
        w->help.shown = false;
    else
        window_close(w->window);
}

/* What a row is of use with. */
enum need { ALWAYS, HANDS, SAVES, LOADS, WORDS, PLAYED };

/* shift: pressed with Shift; control: with Control. Rows without a function describe the
 * pointer. */
static const struct {
    int key;
    bool shift, control;
    const char *name, *does;
    void (*press)(struct stage_window *w);
    enum need need;
} keys[] = {
    {' ', false, false, "Space", "stop, go on", key_pause, ALWAYS},
    {'.', false, false, ".", "one step", key_single, ALWAYS},
    {'-', false, false, "-", "half as fast", key_slower, ALWAYS},
    {'=', false, false, "=", "twice as fast", key_faster, ALWAYS},
    {'R', false, false, "R", "as it was in the beginning", key_reset, ALWAYS},
    {'Z', false, true, "Control Z", "undo", key_undo, ALWAYS},
    {'U', false, false, "U", "undo", key_undo, ALWAYS},
    {INPUT_KEY_TAB, false, false, "Tab", "the panel of controls", key_panel, ALWAYS},
    {'V', false, false, "V", "record a film, and end it", key_record, ALWAYS},
    {'V', false, true, "Control V", "record, where keys play letters", key_record, PLAYED},
    {'S', false, true, "Control S", "save", key_save, SAVES},
    {'O', false, true, "Control O", "load what was saved", key_load, LOADS},
    {'T', false, true, "Control T", "type other words; Enter shows them", key_words, WORDS},
    {'F', false, false, "F", "fill the screen", key_full, ALWAYS},
    {INPUT_KEY_F1 + 10, false, false, "F11", "fill the screen", key_full, ALWAYS},
    {'/', true, false, "?", "these keys", key_help, ALWAYS},
    {INPUT_KEY_ESCAPE, false, false, "Esc", "end", key_end, ALWAYS},
    {0, false, false, "drag", "pull a mass, or a whole letter", NULL, HANDS},
    {0, false, false, "Shift, or press hard", "tack it where it is", NULL, HANDS},
    {0, false, false, "Shift and click", "tack a mass, or take the tack out", NULL, HANDS},
    {0, false, false, "drag with the right", "cut springs", NULL, HANDS},
    {0, false, false, "drop a file", "load it", NULL, LOADS},
};
enum { KEYS = sizeof keys / sizeof *keys, HELP_ROWS = KEYS + 1 + STAGE_WINDOW_KEYS_MAX };

const char *stage_window_key(int row, const char **does)
{
    if (row < 0 || row >= KEYS)
        return NULL;
    *does = keys[row].does;
    return keys[row].name;
}

static void key_take(struct stage_window *w, const struct input_event *e)
{
    for (int i = 0; i < KEYS; i++)
        if (keys[i].press && keys[i].key == e->key &&
            keys[i].shift == ((e->modifiers & INPUT_SHIFT) != 0) &&
            keys[i].control == ((e->modifiers & INPUT_CONTROL) != 0)) {
            keys[i].press(w);
            return;
        }
}

/* ---- hands ---- */

static void hand_take(struct stage_window *w, const struct input_event *e)
{
    static const enum stage_event_kind kinds[] = {[INPUT_POINTER_DOWN] = STAGE_POINTER_DOWN,
                                                  [INPUT_POINTER_MOVE] = STAGE_POINTER_MOVE,
                                                  [INPUT_POINTER_UP] = STAGE_POINTER_UP};
    bool down = e->kind == INPUT_POINTER_DOWN;
    if (down)
        stage_mark(w->stage);
    bool taken = stage_hand(w->stage, kinds[e->kind], e->x_px, e->y_px,
                            e->pen ? e->pressure : 0, e->button, e->modifiers);
    if (down && !taken)
        stage_mark_drop(w->stage);
}

static void event_take(struct stage_window *w, const struct input_event *e)
{
    enum stage_status typed;
    if (typed_words_input(&w->words, w->stage, e, &typed)) {
        if (typed != STAGE_OK)
            say(w, "%s", stage_error());
        return;
    }
    const bool typing = stage_panel_typing(w->panel) &&
                        (e->kind == INPUT_KEY_DOWN || e->kind == INPUT_KEY_REPEAT);
    const bool key = e->kind == INPUT_KEY_DOWN || e->kind == INPUT_KEY_UP ||
                     e->kind == INPUT_KEY_REPEAT || e->kind == INPUT_FOCUS_LOST;
    if (key && !typing && w->def.key && w->def.key(w->def.context, e))
        return;
    if (help_sheet_input(&w->help, e))
        return;
    if (stage_panel_input(w->panel, w->stage, e)) {
        if (stage_panel_message(w->panel)[0])
            say(w, "%s", stage_panel_message(w->panel));
        return;
    }
    if (e->kind == INPUT_KEY_DOWN)
        key_take(w, e);
    else if (e->kind == INPUT_POINTER_DOWN || e->kind == INPUT_POINTER_MOVE ||
             e->kind == INPUT_POINTER_UP)
        hand_take(w, e);
    else if (e->kind == INPUT_FOCUS_LOST)
        stage_hand(w->stage, STAGE_POINTER_CANCEL, e->x_px, e->y_px, 0, 0, 0);
    else if (e->kind == INPUT_DROP)
        load(w, e->path);
    else if (e->kind == INPUT_CLOSE)
        w->open = false;
}

/* ---- what lies over the stage ---- */

static bool is_of_use(const struct stage_window *w, int row)
{
    const struct stage_actor_kind *kind = stage_actor(w->stage).kind;
    const bool letter = keys[row].key >= 'A' && keys[row].key <= 'Z' && !keys[row].control;
    switch (keys[row].need) {
    case HANDS:
        return kind->event != NULL;
    case SAVES:
        return kind->save != NULL;
    case LOADS:
        return kind->load != NULL;
    case WORDS:
        return kind->text != NULL;
    case PLAYED:
        return w->def.played != NULL;
    case ALWAYS:
        break;
    }
    return !(letter && w->def.played);
}

/* The keys and hands that this window has. */
static int help_rows(const struct stage_window *w, struct help_row rows[HELP_ROWS])
{
    int count = 0;
    if (w->def.played)
        rows[count++] = (struct help_row){"letters, digits", w->def.played};
    for (int i = 0; i < KEYS; i++)
        if (is_of_use(w, i))
            rows[count++] = (struct help_row){keys[i].name, keys[i].does};
    for (int i = 0; i < w->def.keys_count && i < STAGE_WINDOW_KEYS_MAX; i++)
        rows[count++] = w->def.keys[i];
    return count;
}

/* Draws the frame rate beside the panel. */
static void frames_draw(struct stage_window *w, int width, double px)
{
    const struct stage_theme *theme = stage_theme(w->stage);
    const struct frame_clock *clock = stage_clock(w->stage);
    const double text = px * theme->sizes[STAGE_SIZE_PANEL_TEXT_SIZE];
    char line[80];
    if (!(clock->frame_s > 0))
        return;
    snprintf(line, sizeof line, "%.0f pictures a second, %.1f s", 1 / clock->frame_s,
             frame_clock_time_s(clock));
    stage_panel_text(w->panel, &w->list, line,
                     width - px * theme->sizes[STAGE_SIZE_PANEL_WIDTH] - text, 1.6 * text, text,
                     true, theme->colors[STAGE_COLOR_PANEL_TEXT]);
}

static void overlay_draw(struct stage_window *w, int width, int height, double px, double now_s)
{
    const struct stage_color *colors = stage_theme(w->stage)->colors;
    const double text = px * stage_theme(w->stage)->sizes[STAGE_SIZE_PANEL_TEXT_SIZE];
    stage_draw_view(&w->list, STAGE_VIEW_PIXELS);
    stage_panel_draw(w->panel, w->stage, width, height, px, &w->list);
    stage_draw_view(&w->list, STAGE_VIEW_PIXELS);
    struct help_row rows[HELP_ROWS];
    help_sheet_draw(&w->help, rows, help_rows(w, rows), w->panel, stage_theme(w->stage), width,
                    height, px, &w->list);
    if (stage_panel_shown(w->panel))
        frames_draw(w, width, px);
    const bool words = typed_words_draw(&w->words, w->panel, w->stage, height, px, &w->list);
    if (!words && w->message[0] && now_s < w->message_s + MESSAGE_S)
        stage_panel_text(w->panel, &w->list, w->message, text, height - text, text, false,
                         colors[STAGE_COLOR_PANEL_TEXT]);
    /* the first text takes some milliseconds longer, which a played letter must not */
    if (!w->drawn)
        stage_panel_text(w->panel, &w->list, "A", text, height - text, text, false,
                         stage_background(w->stage));
    if (w->recording.video)
        stage_draw_disc(&w->list, text, text, 0.5 * text, colors[STAGE_COLOR_RECORDING]);
}

/* The stage alone, of that size. */
static enum stage_status stream_take(struct stage_window *w, int width, int height,
                                     double now_s)
{
    if (!w->stream)
        return STAGE_OK;
    const char *said = stage_stream_said(w->stream);
    if (said)
        say(w, "%s", said);
    return stage_stream_take(w->stream, w->renderer, &w->list, width, height,
                             stage_background(w->stage), now_s);
}

static enum stage_status frame_draw(struct stage_window *w, double now_s)
{
    const char *told = stage_recording_told(&w->recording);
    if (told)
        say(w, "%s", told);
    int width, height;
    double px = window_scale(w->window);
    stage_renderer_size(w->renderer, &width, &height);
    if (width < 1 || height < 1)
        return STAGE_OK; /* an icon now */
    const int beside = stage_panel_beside(w->panel, w->stage, width, px);
    stage_picture(w->stage, beside, height, px, &w->list);
    const enum stage_status streamed = stream_take(w, beside, height, now_s);
    if (streamed != STAGE_OK)
        return streamed;
    overlay_draw(w, width, height, px, now_s);
    w->drawn = true;
    return stage_renderer_draw(w->renderer, &w->list, stage_background(w->stage));
}

/* Until the next picture is due, which it is sooner if something is played meanwhile. */
static void turn_wait(struct stage_window *w)
{
    struct input_event event;
    int descriptor = w->def.readable ? w->def.readable(w->def.context) : -1;
    for (;;) {
        const double wait_s = fmax(0, w->pace.due_s - input_now_s());
        const bool came = window_input_take_or(w->window, wait_s, descriptor, &event);
        if (came)
            event_take(w, &event);
        const bool played = came ? w->def.played && event.kind == INPUT_KEY_DOWN
                                 : input_now_s() < w->pace.due_s;
        if (!came && !played)
            return;
        if (played) {
            w->pace.due_s = fmin(w->pace.due_s, w->soonest_s);
            descriptor = -1;
        }
    }
}

enum stage_status stage_window_turn(struct stage_window *w)
{
    turn_wait(w);
    double began_s = input_now_s();
    enum stage_status status =
        w->def.before ? w->def.before(w->def.context, w->stage, began_s) : STAGE_OK;
    if (status == STAGE_OK)
        status = stage_frame(w->stage, began_s, NULL);
    if (status == STAGE_OK && w->def.after)
        w->def.after(w->def.after_context, w->stage);
    if (status == STAGE_OK)
        status = frame_draw(w, began_s);
    stage_recording_add(&w->recording, w->renderer, began_s);
    w->pace.due_s = began_s + w->pace.least_s;
    w->soonest_s = fmax(began_s + EARLY * w->pace.least_s, 2 * input_now_s() - began_s);
    return status;
}

/* ---- a window ---- */

enum stage_status stage_window_create(struct stage *stage, const struct stage_window_def *def,
                                      struct stage_window **out)
{
    struct window_config config = window_config_default();
    *out = NULL;
    struct stage_window *w = calloc(1, sizeof *w);
    if (!w)
        return stage_fail(STAGE_NO_MEMORY, "no memory for a window");
    w->stage = stage;
    w->def = *def;
    w->open = true;
    w->pace.least_s = 1 / def->fps;
    config.title = def->title;
    config.width_px = def->width_px;
    config.height_px = def->height_px;
    config.drawn_by_caller = true;
    config.screen = def->screen;
    enum stage_status status = STAGE_OK;
    const enum display_status opened = window_create(&config, &w->window);
    if (opened != DISPLAY_OK)
        status =
            stage_fail(opened == DISPLAY_BAD_ARGUMENT ? STAGE_BAD_ARGUMENT : STAGE_NO_DISPLAY,
                       "%s", display_error());
    if (status == STAGE_OK)
        status = stage_renderer_window(w->window, &w->renderer);
    if (status == STAGE_OK)
        status = stage_panel_create(def->font, &w->panel);
    if (status == STAGE_OK)
        stage_panel_knobs_set(w->panel, &def->knobs);
    if (status == STAGE_OK && def->stream) {
        int width, height;
        stage_renderer_size(w->renderer, &width, &height);
        status = stage_stream_open(def->stream, width, height, stage_background(stage).a < 1,
                                   &w->stream);
    }
    if (status == STAGE_OK) /* pointer events may come at once, and need a view */
        status = frame_draw(w, input_now_s());
    if (status == STAGE_OK)
        *out = w;
    else
        stage_window_destroy(w);
    return status;
}

void stage_window_destroy(struct stage_window *w)
{
    if (!w)
        return;
    stage_recording_finish(&w->recording);
    stage_stream_close(w->stream);
    stage_panel_destroy(w->panel);
    stage_renderer_destroy(w->renderer);
    window_destroy(w->window);
    stage_draw_finish(&w->list);
    free(w);
}

void stage_window_record_end(struct stage_window *w)
{
    stage_recording_end(&w->recording);
}

bool stage_window_open(const struct stage_window *w)
{
    return w->open;
}

const char *stage_window_recorded(const struct stage_window *w)
{
    return w->recording.recorded[0] ? w->recording.recorded : NULL;
}

const char *stage_window_message(const struct stage_window *w)
{
    return w->message;
}

enum stage_status stage_window_picture(struct stage_window *w, struct display_image *image)
{
    return stage_renderer_read(w->renderer, image);
}

void stage_window_say(struct stage_window *w, const char *text)
{
    say(w, "%s", text);
}

struct stage_panel *stage_window_panel(struct stage_window *w)
{
    return w->panel;
}
