/* travelling_water.c - a line of pigment, and water that moves over it from the left: five
 * moments, one above the other.
 *
 *     build/examples/example_travelling_water out.png
 *
 * The line stays crisp where the water has not arrived yet. */
#include <display.h>
#include <paper.h>

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 640, HEIGHT = 160, MOMENTS = 5, STEPS_BETWEEN = 80 };

static int stop(const char *message)
{
    fprintf(stderr, "travelling_water: %s\n", message);
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return stop("usage: travelling_water out.png");
    struct paper_config config = paper_config_default();
    config.width = WIDTH;
    config.height = HEIGHT;
    struct display_image series = {
        .width_px = WIDTH, .height_px = MOMENTS * HEIGHT, .channels = 3};
    if (display_image_create(&series) != DISPLAY_OK)
        return stop(display_error());
    struct paper *sheet;
    if (paper_create(&config, &sheet) != PAPER_OK)
        return stop(paper_error());

    const struct paper_ink line = {.cyan = 0.9, .magenta = 0.8, .yellow = 0.2};
    const struct paper_ink water = {.water = 1};
    struct paper_weather weather = paper_weather_default();
    weather.gravity_x = 2;
    weather.humidity = 0.0005;
    enum paper_status status = paper_rectangle(sheet, 20, HEIGHT / 2 - 4, WIDTH - 40, 8, &line);
    for (int moment = 0; moment < MOMENTS && status == PAPER_OK; moment++) {
        status = paper_view_read(sheet, PAPER_VIEW_COLOR,
                                 series.pixels + (size_t)moment * 3 * WIDTH * HEIGHT);
        for (int step = 0; step < STEPS_BETWEEN && status == PAPER_OK; step++) {
            /* Each time the water is poured a little further to the right. */
            int front = WIDTH * (moment * STEPS_BETWEEN + step) / (MOMENTS * STEPS_BETWEEN);
            if (step % 8 == 0)
                status = paper_rectangle(sheet, front - 40, 20, 40, HEIGHT - 40, &water);
            if (status == PAPER_OK)
                status = paper_disperse(sheet, &weather);
            if (status == PAPER_OK && step % 2)
                status = paper_finish(sheet);
        }
    }
    paper_destroy(sheet);
    if (status != PAPER_OK)
        return stop(paper_error());
    if (display_png_write(argv[1], &series) != DISPLAY_OK)
        return stop(display_error());
    display_image_destroy(&series);
    return EXIT_SUCCESS;
}
