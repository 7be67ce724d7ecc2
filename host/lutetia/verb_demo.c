/* verb_demo.c - `lutetia demo`: paints the demonstration page, with a strip of its stages and a
 * view of its water. */
#include "demo_page.h"
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "sheet_picture.h"

#include <display.h>
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The strip: a section of the page at several moments, side by side. */
enum {
    STAGES = 5,
    STAGE_X = 420,
    STAGE_Y = 380,
    STAGE_WIDTH = 390,
    STAGE_HEIGHT = 520,
    STAGE_GAP = 12
};

struct demo {
    const char *dir;
    struct paper_sheet *sheet;
    struct demo_page *page;
    struct display_image strip, view;
    int stages_count;
};

static const struct paper_sheet_view color = {.show = PAPER_SHOW_COLOR,
                                              .light = PAPER_LIGHT_USUAL},
                                     water = {.show = PAPER_SHOW_WATER, .high = 1};

static int stage_step(int stage)
{
    return DEMO_STEPS * stage / (STAGES - 1);
}

static int stage_take(struct demo *demo)
{
    const int status = sheet_picture_read("demo", demo->sheet, &color, &demo->view);
    if (status != EXIT_SUCCESS)
        return status;
    size_t strip_row = 3 * (size_t)demo->strip.width_px, page_row = 3 * (size_t)DEMO_WIDTH;
    size_t left = 3 * (size_t)(demo->stages_count * (STAGE_WIDTH + STAGE_GAP));
    for (size_t y = 0; y < STAGE_HEIGHT; y++)
        memcpy(demo->strip.pixels + y * strip_row + left,
               demo->view.pixels + (STAGE_Y + y) * page_row + 3 * STAGE_X, 3 * STAGE_WIDTH);
    demo->stages_count++;
    return EXIT_SUCCESS;
}

static int demo_run(struct demo *demo)
{
    int status = EXIT_SUCCESS;
    if (demo_page_begin(demo->page, demo->sheet) != PAPER_OK)
        status = fail_paper("demo");
    struct progress progress = progress_begin("painting", DEMO_STEPS);
    for (int step = 0; step <= DEMO_STEPS && status == EXIT_SUCCESS && !interrupted(); step++) {
        if (step == stage_step(demo->stages_count))
            status = stage_take(demo);
        if (step == DEMO_STEPS || status != EXIT_SUCCESS)
            break;
        if (demo_page_step(demo->page, demo->sheet, step) != PAPER_OK)
            status = fail_paper("demo");
        if ((step + 1) % DEMO_MOMENT == 0)
            progress_show(&progress, step + 1);
    }
    progress_end(&progress);
    return interrupted() ? EXIT_INTERRUPTED : status;
}

static int demo_write(struct demo *demo)
{
    static const char *const names[] = {"page.png", "stages.png", "water.png"};
    int status = EXIT_SUCCESS;
    for (int i = 0; i < 3 && status == EXIT_SUCCESS; i++) {
        char path[4096];
        int length = snprintf(path, sizeof path, "%s/%s", demo->dir, names[i]);
        if (length < 0 || (size_t)length >= sizeof path)
            return fail("demo", "the folder's name is too long");
        if (i == 1)
            status = display_png_write(path, &demo->strip) == DISPLAY_OK
                         ? EXIT_SUCCESS
                         : fail("demo", "%s", display_error());
        else
            status = sheet_picture_write("demo", demo->sheet, i == 0 ? &color : &water, path);
        if (status == EXIT_SUCCESS)
            visible_print("%s\n", path);
    }
    return status;
}

static int demo_prepare(struct demo *demo)
{
    demo->strip =
        (struct display_image){.width_px = STAGES * (STAGE_WIDTH + STAGE_GAP) - STAGE_GAP,
                               .height_px = STAGE_HEIGHT,
                               .channels = 3};
    demo->view =
        (struct display_image){.width_px = DEMO_WIDTH, .height_px = DEMO_HEIGHT, .channels = 3};
    if (display_image_create(&demo->strip) != DISPLAY_OK ||
        display_image_create(&demo->view) != DISPLAY_OK)
        return fail("demo", "%s", display_error());
    memset(demo->strip.pixels, 255, 3 * (size_t)demo->strip.width_px * STAGE_HEIGHT);
    int status = folder_make("demo", demo->dir);
    if (status != EXIT_SUCCESS)
        return status;
    if (demo_page_create(&demo->page) != PAPER_OK)
        return fail_paper("demo");
    struct paper_sheet_config config = demo_page_config();
    status =
        machine_prepare("demo", config.width, config.height,
                        paper_sheet_bytes(config.width, config.height, config.pigments_count));
    if (status != EXIT_SUCCESS)
        return status;
    if (paper_sheet_create(&config, &demo->sheet) != PAPER_OK)
        return fail_paper("demo");
    return EXIT_SUCCESS;
}

int verb_demo(int argc, char **argv)
{
    struct demo demo = {.dir = "demo"};
    const struct option_row rows[] = {{"out", 'o', OPTION_TEXT, "DIR",
                                       "folder that the pictures are written to (demo)",
                                       &demo.dir, 0, 0, 0},
                                      {0}};
    struct option_words words;
    if (!options_parse("demo", rows, argc, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("demo", rows, NULL);
    if (words.count)
        return fail_usage("demo", "there is nothing to do with '%.60s'", words.words[0]);

    double began_s = seconds_now();
    interrupt_catch();
    int status = demo_prepare(&demo);
    if (status == EXIT_SUCCESS)
        status = demo_run(&demo);
    double painted_s = seconds_now();
    if (status == EXIT_SUCCESS)
        status = demo_write(&demo);
    if (status == EXIT_SUCCESS)
        printf("%dx%d fibers, %d cycles: painted in %.1f s, written in %.1f s\n", DEMO_WIDTH,
               DEMO_HEIGHT, DEMO_STEPS, painted_s - began_s, seconds_now() - painted_s);
    paper_sheet_destroy(demo.sheet);
    demo_page_destroy(demo.page);
    display_image_destroy(&demo.strip);
    display_image_destroy(&demo.view);
    return interrupt_report("demo", status, "unfinished pictures are");
}
