/* leds_window.c - pictures of the front at their turn. */
#include "leds_window.h"
#include "lutetia.h"

#include <math.h>
#include <string.h>

static enum display_status draw(struct leds_window *window)
{
    double began_s = clock_s();
    enum display_status status =
        front_panel_draw(window->panel, window->lights, &window->image);
    if (status == DISPLAY_OK)
        status = window_show(window->window, &window->image);
    memcpy(window->drawn, window->lights, sizeof window->drawn);
    double now_s = clock_s();
    window->due_s = fmax(began_s + window->least_s, now_s + (now_s - began_s));
    return status;
}

enum display_status leds_window_open(const char *title, int width_px, int height_px, double fps,
                                     struct leds_window *window)
{
    struct window_config config = window_config_default();
    *window = (struct leds_window){.least_s = 1 / fps};
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

enum display_status leds_window_turn(struct leds_window *window, double wait_s, bool *open)
{
    struct window_event event;
    double until_s = clock_s() + wait_s;
    do {
        double left_s = until_s - clock_s();
        bool waiting = memcmp(window->lights, window->drawn, sizeof window->lights) != 0;
        if (waiting && clock_s() >= window->due_s) {
            enum display_status status = draw(window);
            if (status != DISPLAY_OK)
                return status;
            left_s = until_s - clock_s();
        } else if (waiting) {
            left_s = fmin(left_s, window->due_s - clock_s());
        }
        if (window_event_take(window->window, fmax(left_s, 0), &event) &&
            event.kind == WINDOW_EVENT_KEY && event.key == WINDOW_KEY_ESCAPE)
            window_close(window->window);
        *open = !window_closing(window->window);
    } while (*open && clock_s() < until_s);
    return DISPLAY_OK;
}
