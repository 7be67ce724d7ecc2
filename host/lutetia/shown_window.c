/* shown_window.c - draws pictures when they are due. */
#include "shown_window.h"
#include "lutetia.h"

#include <math.h>

double shown_clock_wait_s(struct shown_clock *c, double time_s)
{
    if (!c->began) {
        c->clock = frame_clock_begin(0.001, seconds_now());
        c->clock.frame_max_s = INFINITY; /* a recording that is late catches up */
        c->began = true;
    }
    frame_clock_advance(&c->clock, seconds_now());
    if (c->next_wanted)
        frame_clock_skip(&c->clock, time_s);
    c->next_wanted = false;
    return frame_clock_wait_s(&c->clock, time_s);
}

enum display_status shown_window_draw(struct shown_window *window)
{
    double began_s = seconds_now();
    enum display_status status = DISPLAY_OK;
    if (!window->paint || !window->paint(window->context, window->window)) {
        status = window->draw(window->context, &window->image);
        if (status == DISPLAY_OK && window->image.pixels)
            status = window_show(window->window, &window->image);
    }
    frame_pace_drawn(&window->pace, began_s, seconds_now());
    return status;
}

enum display_status shown_window_open(struct shown_window *window, const char *title,
                                      int width_px, int height_px, double fps)
{
    struct window_config config = window_config_default();
    window->pace = (struct frame_pace){.least_s = 1 / fps};
    config.title = title;
    config.width_px = width_px;
    config.height_px = height_px;
    return window_create(&config, &window->window);
}

void shown_window_close(struct shown_window *window)
{
    if (!window || !window->window)
        return;
    window_destroy(window->window);
    display_image_destroy(&window->image);
    window->window = NULL;
}

void shown_window_title(struct shown_window *window, const char *title)
{
    window_title_set(window->window, title);
}

/* Handles a key. True: the clock was changed; the caller must wait anew. */
static bool key_take(struct shown_window *window, int key)
{
    struct shown_clock *c = window->clock;
    if (key == INPUT_KEY_ESCAPE)
        window_close(window->window);
    if (!c || !c->began)
        return false;
    if (key == ' ')
        c->clock.paused = !c->clock.paused;
    else if (key == '.')
        c->clock.paused = c->next_wanted = true;
    else if (key == '-' || key == '=')
        frame_clock_rate_set(&c->clock, c->clock.rate * (key == '-' ? 0.5 : 2));
    else
        return false;
    return true;
}

double shown_window_due_s(const struct shown_window *window)
{
    return window->stale(window->context) ? fmax(window->pace.due_s - seconds_now(), 0)
                                          : INFINITY;
}

enum display_status shown_window_turn(struct shown_window *window, double wait_s, bool *open)
{
    struct input_event event;
    double until_s = seconds_now() + wait_s;
    bool taken;
    *open = true;
    do {
        const double due_s = shown_window_due_s(window);
        if (due_s <= 0) {
            enum display_status status = shown_window_draw(window);
            if (status != DISPLAY_OK)
                return status;
        }
        const double left_s = fmin(until_s - seconds_now(), due_s > 0 ? due_s : INFINITY);
        taken = window_input_take(window->window, fmax(left_s, 0), &event);
        if (taken && event.kind == INPUT_KEY_DOWN && key_take(window, event.key))
            return DISPLAY_OK;
        *open = !window_closing(window->window);
    } while (*open && (taken || seconds_now() < until_s));
    return DISPLAY_OK;
}

bool shown_window_paint(struct window *window, struct display_reader *reader, int number)
{
    const struct display_screen *screen = &reader->screens[number - 1];
    const uint8_t *as_is = display_screen_as_is(screen);
    struct display_room room;
    if (as_is && window_shared_show(window, reader->shared, as_is, screen->width_px,
                                    screen->height_px)) {
        display_reader_keep(reader, number, true);
        return true;
    }
    const bool painted = window_room_begin(window, screen->width_px, screen->height_px, &room);
    if (painted) {
        display_screen_paint(screen, &room);
        window_room_show(window);
        display_reader_keep(reader, number, false);
    }
    return painted;
}
