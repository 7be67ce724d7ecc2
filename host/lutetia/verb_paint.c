/* verb_paint.c - `lutetia paint`: type or a bitmap in ink on wet paper. */
#include "verb_paint.h"
#include "help.h"
#include "type_common.h"

#include <display.h>
#include <face.h>
#include <sheet.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const fonts[] = {"EBGaramond12-Regular", "DejaVuSerif", NULL};

static struct paint paint_default(void)
{
    return (struct paint){
        .view = "color",
        .out_path = "out.png",
        .model = "full",
        .ink = {NAN, NAN, NAN},
        .water = NAN,
        .wet = NAN,
        .size = {1024, 640},
        .steps = -1,
        .every = 10,
        .seed = (int)paper_config_default().seed,
        .gravity = NAN,
        .gravity_x = NAN,
        .humidity = NAN,
        .weights = {NAN, NAN, NAN},
        .absorbency = NAN,
        .light = NAN,
        .ground = {NAN, NAN, NAN},
    };
}

static double or_else(double given, double otherwise)
{
    return isnan(given) ? otherwise : given;
}

static int gravity_check(const char *name, double given, double least, double most)
{
    return given >= least && given <= most
               ? EXIT_SUCCESS
               : fail_usage("paint", "--%s must be %g..%g with this model (got %g)", name,
                            least, most, given);
}

static int full_take(struct paint *paint)
{
    const struct paper_air air = paper_air_default();
    if (!isnan(paint->absorbency) || !isnan(paint->weights[0]))
        return fail_usage("paint", "--%s is the thesis's model's; add --model thesis",
                          isnan(paint->absorbency) ? "weights" : "absorbency");
    if (!paint->deckled && !isnan(paint->ground[0]))
        return fail_usage("paint", "--ground is what a sheet with --deckle lies on");
    if (paint->pigments.count && !isnan(paint->ink[0]))
        return fail_usage("paint", "give --ink or --pigment, one of them");
    paint->light = or_else(paint->light, PAPER_LIGHT_USUAL);
    paint->water = or_else(paint->water, 0.75);
    paint->wet = or_else(paint->wet, 0);
    paint->steps = paint->steps < 0 ? 400 : paint->steps;
    paint->gravity = or_else(paint->gravity, air.gravity[1]);
    paint->gravity_x = or_else(paint->gravity_x, air.gravity[0]);
    paint->humidity = or_else(paint->humidity, air.humidity);
    struct paper_sheet_config config;
    double amount[1 + PAPER_PIGMENTS_MAX];
    int status = gravity_check("gravity", paint->gravity, -1, 1);
    if (status == EXIT_SUCCESS)
        status = gravity_check("gravity-x", paint->gravity_x, -1, 1);
    return status == EXIT_SUCCESS ? paint_sheet_config(paint, &config, amount) : status;
}

static int thesis_take(struct paint *paint)
{
    static const double ink[3] = {0.93, 0.76, 0.38};
    const struct paper_weather weather = paper_weather_default();
    if (paint->stock)
        return fail_usage("paint", "--stock is the full model's; the thesis has one paper");
    if (paint->deckled || !isnan(paint->ground[0]))
        return fail_usage("paint", "--%s is the full model's; the thesis's paper is cut",
                          paint->deckled ? "deckle" : "ground");
    if (paint->pigments.count)
        return fail_usage("paint", "--pigment is the full model's; the thesis has --ink");
    if (!isnan(paint->light) || strcmp(paint->view, "wet") == 0)
        return fail_usage("paint", "%s is the full model's; the thesis's paper is flat",
                          isnan(paint->light) ? "--view wet" : "--light");
    for (int i = 0; i < 3; i++) {
        paint->ink[i] = or_else(paint->ink[i], ink[i]);
        paint->weights[i] = or_else(paint->weights[i], weather.molecular_weight[i]);
    }
    paint->water = or_else(paint->water, 0.8);
    paint->wet = or_else(paint->wet, 0.25);
    paint->steps = paint->steps < 0 ? 200 : paint->steps;
    paint->gravity = or_else(paint->gravity, weather.gravity_y);
    paint->gravity_x = or_else(paint->gravity_x, weather.gravity_x);
    paint->humidity = or_else(paint->humidity, weather.humidity);
    paint->absorbency = or_else(paint->absorbency, paper_config_default().absorbency);
    const double pull = PAPER_GRAVITY_MAX;
    const int status = gravity_check("gravity", paint->gravity, 1 / pull, pull);
    return status == EXIT_SUCCESS ? gravity_check("gravity-x", paint->gravity_x, 1 / pull, pull)
                                  : status;
}

/* Options that were not given get the model's values; those of the other model are refused. */
static int model_take(struct paint *paint)
{
    if (strcmp(paint->model, "full") == 0)
        return full_take(paint);
    if (strcmp(paint->model, "thesis") == 0)
        return thesis_take(paint);
    return fail_usage("paint", "--model must be full or thesis (got '%.60s')", paint->model);
}

/* What is painted and how it is shown; then the model's values. */
static int words_take(struct paint *paint, const struct option_words *words)
{
    if (words->count > 1)
        return fail_usage("paint", "there is one text; put it in quotes (then came '%.60s')",
                          words->words[1]);
    paint->text = words->count ? words->words[0] : NULL;
    if (!paint->text == !paint->image_path)
        return fail_usage("paint", "give a text or --image FILE, one of them");
    if (strcmp(paint->view, "color") != 0 && strcmp(paint->view, "water") != 0 &&
        strcmp(paint->view, "wet") != 0)
        return fail_usage("paint", "--view must be color, water or wet (got '%.60s')",
                          paint->view);
    return model_take(paint);
}

static int paint_options(struct paint *paint, int argc, char **argv, bool *help)
{
    const double side = PAPER_SIDE_MAX, pull = PAPER_GRAVITY_MAX;
    const struct option_row rows[] = {
        {"out", 'o', OPTION_PNG, "FILE", "the picture, PNG (out.png)", &paint->out_path, 0, 0,
         0},
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (EBGaramond12-Regular)", &paint->font,
         0, 0, 0},
        TYPE_EDITS_OPTION(&paint->edits),
        {"size", 0, OPTION_NUMBER, "PX", "size of the em (so that the line fills the paper)",
         &paint->size_px, 1, 8192, 0},
        {"filter", 0, OPTION_TEXT, "F", "filter of the type (box)", &paint->filter, 0, 0, 0},
        {"angle", 0, OPTION_NUMBER, "DEG", "turns the type counterclockwise (0)",
         &paint->angle_deg, -3600, 3600, 0},
        {"model", 0, OPTION_TEXT, "MODEL", "the model of paper, full or thesis (full)",
         &paint->model, 0, 0, 0},
        {"stock", 0, OPTION_TEXT, "NAME", "full: the kind of paper (cold press)", &paint->stock,
         0, 0, 0},
        {"deckle", 0, OPTION_FLAG, NULL,
         "full: give the sheet the edges of handmade paper, on a ground", &paint->deckled, 0, 0,
         0},
        {"ground", 0, OPTION_NUMBERS, "R,G,B", "full: colour of the ground, each 0..1",
         paint->ground, 0, 1, 3},
        {"pigment", 0, OPTION_TEXTS, "NAME=A",
         "full: a pigment of the type and how much, -4..4 (0.5 without a number); as often as "
         "wanted (french ultramarine=1.2)",
         &paint->pigments, 0, 0, 0},
        {"ink", 0, OPTION_NUMBERS, "C,M,Y",
         "cyan, magenta and yellow of the type, each 0..1; instead of pigments", paint->ink, 0,
         1, 3},
        {"water", 0, OPTION_NUMBER, "W",
         "water put on with the type, 0..1 (full 0.75; thesis 0.8)", &paint->water, 0, 1, 0},
        {"wet", 0, OPTION_NUMBER, "W",
         "water on the whole sheet before, 0..1 (full 0; thesis 0.25)", &paint->wet, 0, 1, 0},
        {"pool", 0, OPTION_LIST, "X,Y,W,H,A",
         "puts water of amount A/100 into a rectangle, X,Y its upper left corner in fibers; as "
         "often as wanted",
         &paint->pools, -side, side, 5},
        {"image", 0, OPTION_TEXT, "FILE",
         "print a gray PNG instead of type, in its middle; black is ink", &paint->image_path, 0,
         0, 0},
        {"paper", 0, OPTION_SIZE, "WxH", "fibers of the sheet (1024x640)", paint->size,
         PAPER_SIDE_MIN, side, 0},
        {"absorbency", 0, OPTION_NUMBER, "A", "thesis: absorbency of the paper, 0..0.25 (0.18)",
         &paint->absorbency, 0, PAPER_ABSORBENCY_MAX, 0},
        {"steps", 0, OPTION_INTEGER, "N",
         "cycles to compute: how long water flows and dries (full 400; thesis 200)",
         &paint->steps, 0, 1e6, 0},
        {"gravity", 0, OPTION_NUMBER, "G",
         "pull downwards: full -1..1 (0); thesis 0.5..2, where 1 is none", &paint->gravity, -1,
         pull, 0},
        {"gravity-x", 0, OPTION_NUMBER, "G", "pull to the right, as --gravity",
         &paint->gravity_x, -1, pull, 0},
        {"humidity", 0, OPTION_NUMBER, "H", "water that dries in a cycle, 0..1 (0.0004)",
         &paint->humidity, 0, 1, 0},
        {"weights", 0, OPTION_NUMBERS, "C,M,Y",
         "thesis: how easily pigments move, 0..1 (1,0.35,0.7)", paint->weights, 0, 1, 3},
        {"seed", 0, OPTION_INTEGER, "S",
         "seed of the paper: another number, another sheet (1990)", &paint->seed, 0, 2147483647,
         0},
        {"light", 0, OPTION_NUMBER, "L",
         "full: strength of the light on the paper's relief, 0..4 (1.2)", &paint->light, 0, 4,
         0},
        {"view", 0, OPTION_TEXT, "VIEW",
         "what is seen: color, water, or (full) wet, with light on the water (color)",
         &paint->view, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR",
         "also write numbered pictures into this folder while it dries", &paint->frames_dir, 0,
         0, 0},
        {"every", 0, OPTION_INTEGER, "N",
         "cycles from one picture of --frames to the next (10)", &paint->every, 1, 1e6, 0},
        {0}};
    struct option_words words;
    if (!options_parse("paint", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("paint", rows, NULL);
    return words_take(paint, &words);
}

/* The size at which the line takes four fifths of the width, or three fifths of the height. */
static enum paper_status line_fit(const struct paint *paint, struct paper_line *line)
{
    struct paper_screen trial;
    line->size_px = 100;
    enum paper_status status = paper_line_screen(line, &trial, NULL);
    if (status != PAPER_OK)
        return status;
    const struct paper_sheet_config config = {.deckled = paint->deckled,
                                              .deckle = paper_deckle_default()};
    const double margins = 2 * paper_sheet_margin(&config);
    double by_width = 100 * 0.8 * (paint->size[0] - margins) / trial.width_px;
    double by_height = 100 * 0.6 * (paint->size[1] - margins) / trial.height_px;
    line->size_px = fmax(1, fmin(8192, fmin(by_width, by_height)));
    paper_screen_destroy(&trial);
    return PAPER_OK;
}

static int screen_from_text(struct paint *paint)
{
    char *font, *filter = NULL;
    if (paint->filter && type_filter_read("paint", paint->filter, &filter) != EXIT_SUCCESS)
        return EXIT_FAILED;
    if (type_font_name("paint", paint->font, paint->edits, font_face_first(fonts), &font) !=
        EXIT_SUCCESS) {
        free(filter);
        return EXIT_FAILED;
    }
    struct paper_line line = {.text = paint->text,
                              .font = font,
                              .filter = filter,
                              .angle_deg = paint->angle_deg,
                              .size_px = paint->size_px};
    uint32_t missing = 0;
    int status = EXIT_SUCCESS;
    if ((paint->size_px == 0 && line_fit(paint, &line) != PAPER_OK) ||
        paper_line_screen(&line, &paint->screen, &missing) != PAPER_OK)
        status = fail_paper("paint");
    paint->letter_px = line.size_px;
    if (status == EXIT_SUCCESS && missing)
        tell("paint", "no font has a glyph for U+%04X; %s's sign for that is set instead",
             (unsigned)missing, line.font);
    free(font);
    free(filter);
    if (status == EXIT_SUCCESS)
        type_left_out_tell("paint");
    return status;
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
    if (status == EXIT_SUCCESS)
        status = output_check("paint", paint.out_path);
    interrupt_catch();
    if (status == EXIT_SUCCESS)
        status = strcmp(paint.model, "full") == 0 ? paint_sheet(&paint) : paint_thesis(&paint);
    paper_screen_destroy(&paint.screen);
    if (status == EXIT_SUCCESS && isatty(STDERR_FILENO))
        tell("paint", "wrote %s%s%s", paint.out_path,
             paint.frames_dir ? ", and pictures in " : "",
             paint.frames_dir ? paint.frames_dir : "");
    return interrupt_report("paint", status, "the picture is");
}
