/* leds_window.c - draws pictures of the front panel when they are due. */
#include "leds_window.h"
#include "lutetia.h"

#include <math.h>
#include <string.h>

static enum display_status draw(struct leds_window *window)
{
    double began_s = seconds_now();
    enum display_status status =
        front_panel_draw(window->panel, window->lights, &window->image);
    if (status == DISPLAY_OK)
        status = window_show(window->window, &window->image);
    memcpy(window->drawn, window->lights, sizeof window->drawn);
    frame_pace_drawn(&window->pace, began_s, seconds_now());
    return status;
}

enum display_status leds_window_open(const char *title, int width_px, int height_px, double fps,
                                     struct leds_window *window)
{
    struct window_config config = window_config_default();
    *window = (struct leds_window){.pace.least_s = 1 / fps};
    config.title = title;
    config.width_px = width_px;
    config.height_px = height_px;
    return window_create(&config, &window->window);
}

enum display_status leds_window_panel(struct leds_window *window, struct front_panel *panel)
{
    window->panel = panel;
    return draw(window);
}

void leds_window_close(struct leds_window *window)
{
    if (!window)
        return;
    window_destroy(window->window);
    display_image_destroy(&window->image);
}

void leds_window_title(struct leds_window *window, const char *title)
{
    window_title_set(window->window, title);
}

void leds_window_light(struct leds_window *window, const uint8_t lights[FRONT_PANEL_BYTES])
{
    memcpy(window->lights, lights, sizeof window->lights);
}

/* Handles a key. True: the clock was changed; the caller must wait anew. */
static bool key_take(struct leds_window *window, int key)
{
    struct frame_clock *clock = &window->clock;
    if (key == INPUT_KEY_ESCAPE)
        window_close(window->window);
    if (!window->clock_began)
        return false;
    if (key == ' ')
        clock->paused = !clock->paused;
    else if (key == '.')
        clock->paused = window->next_wanted = true;
    else if (key == '-' || key == '=')
        frame_clock_rate_set(clock, clock->rate * (key == '-' ? 0.5 : 2));
    else
        return false;
    return true;
}

double leds_window_wait_s(struct leds_window *window, double time_s)
{
    struct frame_clock *clock = &window->clock;
    if (!window->clock_began) {
        *clock = frame_clock_begin(0.001, seconds_now());
        clock->frame_max_s = INFINITY; /* a recording that is late catches up */
        window->clock_began = true;
    }
    frame_clock_advance(clock, seconds_now());
    if (window->next_wanted)
        frame_clock_skip(clock, time_s);
    window->next_wanted = false;
    return frame_clock_wait_s(clock, time_s);
}

enum display_status leds_window_turn(struct leds_window *window, double wait_s, bool *open)
{
    struct input_event event;
    double until_s = seconds_now() + wait_s;
    *open = true;
    do {
        double left_s = until_s - seconds_now();
        bool waiting = memcmp(window->lights, window->drawn, sizeof window->lights) != 0;
        if (waiting && seconds_now() >= window->pace.due_s) {
            enum display_status status = draw(window);
            if (status != DISPLAY_OK)
                return status;
            left_s = until_s - seconds_now();
        } else if (waiting) {
            left_s = fmin(left_s, window->pace.due_s - seconds_now());
        }
        if (window_input_take(window->window, fmax(left_s, 0), &event) &&
            event.kind == INPUT_KEY_DOWN && key_take(window, event.key))
            return DISPLAY_OK;
        *open = !window_closing(window->window);
    } while (*open && seconds_now() < until_s);
    return DISPLAY_OK;
}
