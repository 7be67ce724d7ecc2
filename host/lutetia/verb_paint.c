/* verb_paint.c - `lutetia paint`: type or a bitmap in ink on wet paper. */
#include "lutetia.h"
#include "options.h"

#include <display.h>
#include <face.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct paint {
    const char *text, *image_path, *font, *filter, *view, *frames_dir, *out_path;
    double angle_deg;
    double size_px; /* 0: the line is fitted to the paper */
    double ink[3], water, wet;
    int size[2], steps, every, seed;
    double gravity, gravity_x, humidity, weights[3], absorbency;
    struct option_list pools;
    struct paper_screen screen;
};

static const char *const fonts[] = {"EBGaramond12-Regular", "DejaVuSerif", NULL};

static struct paint paint_default(void)
{
    struct paper_config config = paper_config_default();
    struct paper_weather weather = paper_weather_default();
    return (struct paint){
        .view = "color",
        .out_path = "out.png",
        .ink = {0.93, 0.76, 0.38},
        .water = 0.8,
        .wet = 0.25,
        .size = {1024, 640},
        .steps = 200,
        .every = 10,
        .seed = (int)config.seed,
        .gravity = weather.gravity_y,
        .gravity_x = weather.gravity_x,
        .humidity = weather.humidity,
        .weights = {weather.molecular_weight[0], weather.molecular_weight[1],
                    weather.molecular_weight[2]},
        .absorbency = config.absorbency,
    };
}

static int paint_options(struct paint *paint, int argc, char **argv, bool *help)
{
    const double side = PAPER_SIDE_MAX, pull = PAPER_GRAVITY_MAX;
    const struct option_row rows[] = {
        {"out", 'o', OPTION_TEXT, "FILE", "the picture, PNG (out.png)", &paint->out_path, 0, 0,
         0},
        {"font", 0, OPTION_TEXT, "F", "a font file, or a font file's name", &paint->font, 0, 0,
         0},
        {"size", 0, OPTION_NUMBER, "PX", "of the em (so that the line fills the paper)",
         &paint->size_px, 1, 8192, 0},
        {"filter", 0, OPTION_TEXT, "F", "of the type, as lutetia type has them (box)",
         &paint->filter, 0, 0, 0},
        {"angle", 0, OPTION_NUMBER, "DEG", "turns the type counterclockwise (0)",
         &paint->angle_deg, -3600, 3600, 0},
        {"ink", 0, OPTION_NUMBERS, "C,M,Y", "cyan, magenta, yellow of the type, 0..1",
         paint->ink, 0, 1, 3},
        {"water", 0, OPTION_NUMBER, "W", "water put on with the type, 0..1 (0.8)",
         &paint->water, 0, 1, 0},
        {"wet", 0, OPTION_NUMBER, "W", "water on the whole sheet before, 0..1 (0.25)",
         &paint->wet, 0, 1, 0},
        {"pool", 0, OPTION_LIST, "X,Y,W,H,A",
         "water of amount A/100 in a rectangle; any number", &paint->pools, -side, side, 5},
        {"image", 0, OPTION_TEXT, "FILE", "screen a gray PNG instead of type: black is ink",
         &paint->image_path, 0, 0, 0},
        {"paper", 0, OPTION_SIZE, "WxH", "fibers (1024x640)", paint->size, PAPER_SIDE_MIN, side,
         0},
        {"absorbency", 0, OPTION_NUMBER, "A", "of the paper, 0..0.25 (0.18)",
         &paint->absorbency, 0, PAPER_ABSORBENCY_MAX, 0},
        {"steps", 0, OPTION_INTEGER, "N", "cycles (200)", &paint->steps, 0, 1e6, 0},
        {"gravity", 0, OPTION_NUMBER, "G", "downwards, 0.5..2; 1 is none", &paint->gravity,
         1 / pull, pull, 0},
        {"gravity-x", 0, OPTION_NUMBER, "G", "to the right, 0.5..2; 1 is none",
         &paint->gravity_x, 1 / pull, pull, 0},
        {"humidity", 0, OPTION_NUMBER, "H", "water that dries in a cycle, 0..1 (0.0004)",
         &paint->humidity, 0, 1, 0},
        {"weights", 0, OPTION_NUMBERS, "C,M,Y", "how easily pigments move, 0..1 (1,0.35,0.7)",
         paint->weights, 0, 1, 3},
        {"seed", 0, OPTION_INTEGER, "S", "of the paper (1990)", &paint->seed, 0, 2147483647, 0},
        {"view", 0, OPTION_TEXT, "VIEW", "color or water", &paint->view, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR", "write pictures on the way there", &paint->frames_dir,
         0, 0, 0},
        {"every", 0, OPTION_INTEGER, "N", "cycles from one of them to the next (10)",
         &paint->every, 1, 1e6, 0},
        {0}};
    struct option_words words;
    if (!options_parse("paint", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help) {
        puts("usage: lutetia paint \"Text\" [options]\n       lutetia paint --image FILE "
             "[options]\n");
        options_help(rows);
        return EXIT_SUCCESS;
    }
    if (words.count > 1)
        return fail_usage("paint", "there is one text; put it in quotes (then came '%.60s')",
                          words.words[1]);
    paint->text = words.count ? words.words[0] : NULL;
    if (!paint->text == !paint->image_path)
        return fail_usage("paint", "give a text or --image FILE, one of them");
    if (strcmp(paint->view, "color") != 0 && strcmp(paint->view, "water") != 0)
        return fail_usage("paint", "--view must be color or water (got '%.60s')", paint->view);
    return EXIT_SUCCESS;
}

/* The size at which the line takes four fifths of the width, or three fifths of the height. */
static enum paper_status line_fit(const struct paint *paint, struct paper_line *line)
{
    struct paper_screen trial;
    line->size_px = 100;
    enum paper_status status = paper_line_screen(line, &trial, NULL);
    if (status != PAPER_OK)
        return status;
    double by_width = 100 * 0.8 * paint->size[0] / trial.width_px;
    double by_height = 100 * 0.6 * paint->size[1] / trial.height_px;
    line->size_px = fmax(1, fmin(8192, fmin(by_width, by_height)));
    paper_screen_destroy(&trial);
    return PAPER_OK;
}

static int screen_from_text(struct paint *paint)
{
    struct paper_line line = {.text = paint->text,
                              .font = paint->font ? paint->font : font_face_first(fonts),
                              .filter = paint->filter,
                              .angle_deg = paint->angle_deg,
                              .size_px = paint->size_px};
    uint32_t missing = 0;
    if ((paint->size_px == 0 && line_fit(paint, &line) != PAPER_OK) ||
        paper_line_screen(&line, &paint->screen, &missing) != PAPER_OK)
        return fail_paper("paint");
    if (missing)
        tell("paint", "no font has a glyph for U+%04X; %s's sign for that is set instead",
             (unsigned)missing, line.font);
    return EXIT_SUCCESS;
}

static int screen_from_image(struct paint *paint)
{
    struct display_image image;
    if (display_png_read_gray(paint->image_path, &image) != DISPLAY_OK)
        return fail("paint", "%s", display_error());
    size_t count = (size_t)image.width_px * (size_t)image.height_px;
    for (size_t i = 0; i < count; i++)
        image.pixels[i] = (uint8_t)(255 - image.pixels[i]);
    paint->screen = (struct paper_screen){
        .width_px = image.width_px, .height_px = image.height_px, .gray = image.pixels};
    return EXIT_SUCCESS;
}

static enum paper_status paint_apply(const struct paint *paint, struct paper *sheet)
{
    struct paper_ink ink = {paint->ink[0], paint->ink[1], paint->ink[2], paint->water};
    enum paper_status status = paper_rectangle(sheet, 0, 0, paint->size[0], paint->size[1],
                                               &(struct paper_ink){.water = paint->wet});
    for (int i = 0; i < paint->pools.count && status == PAPER_OK; i++) {
        const double *pool = paint->pools.numbers[i];
        status = paper_rectangle(sheet, (int)pool[0], (int)pool[1], (int)pool[2], (int)pool[3],
                                 &(struct paper_ink){.water = pool[4] / 100});
    }
    if (status == PAPER_OK)
        status = paper_screen_ink(sheet, &paint->screen,
                                  (paint->size[0] - paint->screen.width_px) / 2,
                                  (paint->size[1] - paint->screen.height_px) / 2, &ink);
    return status;
}

static int frame_write(const struct paint *paint, struct paper *sheet, enum paper_view view,
                       int step)
{
    char path[4096];
    int length = snprintf(path, sizeof path, "%s/frame-%06d.png", paint->frames_dir, step);
    if (length < 0 || (size_t)length >= sizeof path)
        return fail("paint", "--frames: the folder's name is too long");
    return sheet_write("paint", sheet, view, path);
}

static int paint_run(const struct paint *paint, struct paper *sheet)
{
    enum paper_view view =
        strcmp(paint->view, "water") == 0 ? PAPER_VIEW_WATER : PAPER_VIEW_COLOR;
    struct paper_weather weather = {
        .gravity_x = paint->gravity_x,
        .gravity_y = paint->gravity,
        .humidity = paint->humidity,
        .molecular_weight = {paint->weights[0], paint->weights[1], paint->weights[2]}};
    int status = EXIT_SUCCESS;
    if (paint_apply(paint, sheet) != PAPER_OK || paper_finish(sheet) != PAPER_OK)
        status = fail_paper("paint");
    struct progress progress = progress_begin("painting", paint->steps);
    for (int step = 0; step <= paint->steps && status == EXIT_SUCCESS; step++) {
        if (interrupted())
            break;
        if (paint->frames_dir && step % paint->every == 0)
            status = frame_write(paint, sheet, view, step);
        if (step == paint->steps || status != EXIT_SUCCESS)
            break;
        if (paper_disperse(sheet, &weather) != PAPER_OK ||
            ((step + 1) % STEPS_AT_ONCE == 0 && paper_finish(sheet) != PAPER_OK))
            status = fail_paper("paint");
        if ((step + 1) % STEPS_AT_ONCE == 0)
            progress_show(&progress, step + 1);
    }
    progress_end(&progress);
    if (interrupted())
        return EXIT_INTERRUPTED;
    return status == EXIT_SUCCESS ? sheet_write("paint", sheet, view, paint->out_path) : status;
}

int verb_paint(int argc, char **argv)
{
    struct paint paint = paint_default();
    bool help = false;
    int status = paint_options(&paint, argc, argv, &help);
    if (status != EXIT_SUCCESS || help)
        return status;

    /* Errors in the input are found before the machine starts. */
    status = paint.text ? screen_from_text(&paint) : screen_from_image(&paint);
    if (status == EXIT_SUCCESS && paint.frames_dir)
        status = folder_make("paint", paint.frames_dir);
    interrupt_catch();
    if (status == EXIT_SUCCESS)
        status = machine_prepare("paint", paint.size[0], paint.size[1]);
    struct paper *sheet = NULL;
    if (status == EXIT_SUCCESS) {
        struct paper_config config = paper_config_default();
        config.width = paint.size[0];
        config.height = paint.size[1];
        config.seed = (uint64_t)paint.seed;
        config.absorbency = paint.absorbency;
        if (paper_create(&config, &sheet) != PAPER_OK)
            status = fail_paper("paint");
        else
            status = paint_run(&paint, sheet);
    }
    paper_destroy(sheet);
    paper_screen_destroy(&paint.screen);
    return interrupt_report("paint", status, "the picture is");
}
