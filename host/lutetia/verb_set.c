/* verb_set.c - `lutetia set`: a text as pages: columns, notes, words divided, text around and
 * inside shapes, vertical lines. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"
#include "type_pages.h"

#include <paint.h>
#include <setup.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUND_CORNERS = 72 };

struct set {
    struct type_pages pages;
    const char *edits, *align;
    struct option_list around, inside;
    struct page_setup setup;
    struct option_texts filters;
    struct page_shape shapes[PAGE_SHAPES_MAX];
    double corners[PAGE_SHAPES_MAX][2 * ROUND_CORNERS];
};

/* A row without a target is that number of the setup. */
static void number_bind(struct option_row *row, struct page_setup *setup)
{
    for (int i = 0; i < page_numbers_count && !row->target; i++)
        if (strcmp(row->name, page_numbers[i].name) == 0) {
            row->target = (char *)setup + page_numbers[i].at;
            row->least = page_numbers[i].least;
            row->most = page_numbers[i].most;
        }
}

static int set_options(struct set *s, int argc, char **argv, const char **path, bool *help)
{
    struct option_row rows[] = {
        TYPE_PAGES_OPTIONS(&s->pages, "page", "page.png"),
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (DejaVuSerif)", &s->setup.font, 0, 0,
         0},
        TYPE_EDITS_OPTION(&s->edits),
        {"italic", 0, OPTION_TEXT, "F", "font of *slanted* words (the family's)",
         &s->setup.italic, 0, 0, 0},
        {"bold", 0, OPTION_TEXT, "F",
         "font of `**bold**` words (the family's, where it has one)", &s->setup.bold, 0, 0, 0},
        {"size", 0, OPTION_NUMBER, "PX", "size of the em (16)", NULL, 0, 0, 0},
        {"leading", 0, OPTION_NUMBER, "L", "distance of lines, of the size (the font's)", NULL,
         0, 0, 0},
        {"margin", 0, OPTION_NUMBER, "PX", "margin around the page's text (60)", NULL, 0, 0, 0},
        {"columns", 0, OPTION_INTEGER, "N", "number of columns (1)", NULL, 0, 0, 0},
        {"gap", 0, OPTION_NUMBER, "PX", "space between columns (24)", NULL, 0, 0, 0},
        {"notes", 0, OPTION_NUMBER, "PX",
         "width of the margin for [>notes], at the right or below vertical lines (0: at the "
         "foot)",
         NULL, 0, 0, 0},
        {"align", 0, OPTION_TEXT, "A", "left, right, center or justify (justify)", &s->align, 0,
         0, 0},
        {"indent", 0, OPTION_NUMBER, "EM", "indent of paragraphs' first lines (1.2)", NULL, 0,
         0, 0},
        {"hyphenate", 0, OPTION_FLAG, NULL,
         "divide words, by the rules of --language; without it by those of English",
         &s->setup.hyphenate, 0, 0, 0},
        {"language", 0, OPTION_TEXT, "L", "language of the text, such as fr",
         &s->setup.language, 0, 0, 0},
        {"features", 0, OPTION_TEXT, "F,..", "OpenType features to switch: onum,-liga",
         &s->setup.features, 0, 0, 0},
        {"protrude", 0, OPTION_NUMBER, "P", "how far signs stand in the margins, 0..1 (0)",
         NULL, 0, 0, 0},
        {"expand", 0, OPTION_NUMBER, "P", "how far letters are widened, 0..0.05 (0)", NULL, 0,
         0, 0},
        {"tolerance", 0, OPTION_NUMBER, "B", "the badness that a line may have (200)", NULL, 0,
         0, 0},
        {"folios", 0, OPTION_FLAG, NULL, "page numbers in the lower margin", &s->setup.folios,
         0, 0, 0},
        {"head", 0, OPTION_TEXT, "T",
         "running head in the upper margin; %h: the last heading, %p: the page", &s->setup.head,
         0, 0, 0},
        {"grid", 0, OPTION_FLAG, NULL, "lines of columns beside each other are level",
         &s->setup.grid, 0, 0, 0},
        {"vertical", 0, OPTION_FLAG, NULL, "lines go down, from the right to the left",
         &s->setup.vertical, 0, 0, 0},
        {"around", 0, OPTION_LIST, "X,Y,RX,RY",
         "text goes around this ellipse; as often as wanted", &s->around, -16384, 16384, 4},
        {"inside", 0, OPTION_LIST, "X,Y,RX,RY", "text stays inside of this ellipse", &s->inside,
         -16384, 16384, 4},
        {"ink", 0, OPTION_NUMBERS, "R,G,B", "colour of the ink, each 0..1 (0,0,0)",
         s->pages.ink, 0, 1, 3},
        {"filter", 0, OPTION_TEXT, "F", "filter of the letters (gaussian-fast)",
         &s->pages.filter, 0, 0, 0},
        {"filter-of", 0, OPTION_TEXTS, "PART=F",
         "filter of the text, of italic or bold words, of a head or a note: note=cone",
         &s->filters, 0, 0, 0},
        {"darken", 0, OPTION_NUMBER, "PX",
         "widens the stems of small type; 0: does not (as their width needs)",
         &s->pages.darken_px, 0, 2, 0},
        {0}};
    struct option_words words;
    for (struct option_row *row = rows; row->name; row++)
        number_bind(row, &s->setup);
    if (!options_parse("set", rows, argc, argv, &words))
        return EXIT_USAGE;
    *help = words.help;
    if (words.help)
        return help_print("set", rows, NULL);
    if (words.count != 1)
        return fail_usage("set",
                          words.count ? "there is one text (then came '%.60s')"
                                      : "give a file with the text, or -%s",
                          words.count ? words.words[1] : "");
    *path = words.words[0];
    return type_pages_check(&s->pages);
}

static int shapes_make(struct set *s)
{
    const struct option_list *lists[2] = {&s->around, &s->inside};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < lists[k]->count; i++) {
            const double *e = lists[k]->numbers[i];
            int n = s->setup.shapes_count;
            if (n == PAGE_SHAPES_MAX)
                return fail_usage("set", "there are at most %d shapes", PAGE_SHAPES_MAX);
            if (!(e[2] > 0 && e[3] > 0))
                return fail_usage("set", "an ellipse's radii must be above 0 (got %g, %g)",
                                  e[2], e[3]);
            for (int c = 0; c < ROUND_CORNERS; c++) {
                double a = 2 * M_PI * c / ROUND_CORNERS;
                s->corners[n][2 * c] = e[0] + e[2] * cos(a);
                s->corners[n][2 * c + 1] = e[1] + e[3] * sin(a);
            }
            s->shapes[n] = (struct page_shape){.points = s->corners[n],
                                               .points_count = ROUND_CORNERS,
                                               .inside = k == 1,
                                               .distance_px = k ? 0 : s->setup.size_px / 2};
            s->setup.shapes_count++;
        }
    s->setup.shapes = s->shapes;
    return EXIT_SUCCESS;
}

/* note=cone */
static int filters_read(struct set *s)
{
    for (int i = 0; i < s->filters.count; i++) {
        const char *text = s->filters.texts[i], *equals = strchr(text, '=');
        int part = 0;
        while (equals && part < PAGE_PARTS &&
               (strncmp(text, page_part_name((enum page_part)part), (size_t)(equals - text)) !=
                    0 ||
                page_part_name((enum page_part)part)[equals - text]))
            part++;
        if (!equals || part == PAGE_PARTS)
            return fail_usage(
                "set",
                "--filter-of must be text, italic, bold, head or note, and = and a "
                "filter (got '%.60s')",
                text);
        s->setup.filters[part] = equals + 1;
    }
    return EXIT_SUCCESS;
}

int verb_set(int argc, char **argv)
{
    static struct set s; /* its lists are large */
    const char *path = NULL;
    char *text = NULL, *font = NULL, *filter = NULL;
    size_t bytes = 0;
    bool help = false;
    const char *const usual_font = page_setup_default().font;
    s = (struct set){.pages = {.verb = "set",
                               .out_path = "page.png",
                               .page_px = {600, 840},
                               .darken_px = FONT_DARKEN_BY_STEM},
                     .setup = page_setup_default()};
    s.setup.font = NULL;
    s.setup.colour = true;
    int status = set_options(&s, argc, argv, &path, &help);
    if (status == EXIT_SUCCESS && !help)
        status = type_font_name("set", s.setup.font, s.edits, usual_font, &font);
    if (status != EXIT_SUCCESS || help)
        return status;
    s.setup.font = font;
    if (s.pages.filter) {
        status = type_filter_read("set", s.pages.filter, &filter);
        s.pages.filter = filter;
    }
    const char *divided = s.setup.language ? s.setup.language : s.setup.hyphenate ? "en" : NULL;
    s.pages.language = divided;
    s.setup.width_px = s.pages.page_px[0];
    s.setup.height_px = s.pages.page_px[1];
    if (status == EXIT_SUCCESS && s.align && !font_align_named(s.align, &s.setup.align))
        status = fail_usage(
            "set", "--align must be left, right, center or justify (got '%.60s')", s.align);
    if (status == EXIT_SUCCESS)
        status = filters_read(&s);
    if (status == EXIT_SUCCESS)
        status = shapes_make(&s);
    if (status == EXIT_SUCCESS)
        status = type_text_read("set", path, &text, &bytes);
    struct page_text *pages = NULL;
    if (status == EXIT_SUCCESS && page_setup_make(&s.setup, text, bytes, &pages) != FONT_OK)
        status = fail_font("set");
    if (status == EXIT_SUCCESS)
        status = type_pages_write(&s.pages, pages);
    if (status == EXIT_SUCCESS)
        type_pages_tell(&s.pages, s.setup.font, font_utf8_damaged(text, bytes),
                        s.setup.hyphenate ? divided : NULL);
    type_left_out_tell("set");
    page_text_destroy(pages);
    free(text);
    free(font);
    free(filter);
    return status;
}
