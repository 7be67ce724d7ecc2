/* verb_set.c - `lutetia set`: a text as pages: columns, notes, words divided, text around and inside shapes, vertical lines. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"

#include <document.h>
#include <input_file.h>
#include <output_file.h>
#include <setup.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_BYTES_MAX = 64 << 20, ROUND_CORNERS = 72 };

struct set {
    const char *out_path, *font, *edits, *italic, *bold, *language, *features, *filter, *align,
        *title, *head;
    double size_px, leading, margin_px, gap_px, notes_px, indent_em, protrude, expand,
        tolerance;
    double ink[3], darken_px;
    int page_px[2], columns, page;
    struct option_list around, inside;
    bool all, hyphenate, vertical, statistics, folios, grid;
    struct font_layout lacking; /* only its missing characters: of all pages that were drawn */
    struct page_setup setup;
    struct option_texts filters;
    struct page_shape shapes[PAGE_SHAPES_MAX];
    double corners[PAGE_SHAPES_MAX][2 * ROUND_CORNERS];
};

static int set_options(struct set *s, int argc, char **argv, const char **path, bool *help)
{
    const struct option_row rows[] = {
        {"out", 'o', OPTION_TEXT, "FILE",
         "a page as picture, .png or .svg, or all of them as one .pdf (page.png)", &s->out_path,
         0, 0, 0},
        {"page", 0, OPTION_INTEGER, "N", "which page is drawn (1; of a PDF all)", &s->page, 1,
         99999, 0},
        {"all", 0, OPTION_FLAG, NULL,
         "draw all pages, each in a file: page-1.png, page-2.png, ..", &s->all, 0, 0, 0},
        {"title", 0, OPTION_TEXT, "T", "title of a PDF (the first heading)", &s->title, 0, 0,
         0},
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (DejaVuSerif)", &s->font, 0, 0, 0},
        TYPE_EDITS_OPTION(&s->edits),
        {"italic", 0, OPTION_TEXT, "F", "font of *slanted* words (the family's)", &s->italic, 0,
         0, 0},
        {"bold", 0, OPTION_TEXT, "F",
         "font of `**bold**` words (the family's, where it has one)", &s->bold, 0, 0, 0},
        {"size", 0, OPTION_NUMBER, "PX", "size of the em (16)", &s->size_px, 1, 1000, 0},
        {"leading", 0, OPTION_NUMBER, "L", "distance of lines, of the size (the font's)",
         &s->leading, 0.1, 10, 0},
        {"paper", 0, OPTION_SIZE, "WxH", "size of the page (600x840)", s->page_px, 16, 16384,
         0},
        {"margin", 0, OPTION_NUMBER, "PX", "margin around the page's text (60)", &s->margin_px,
         0, 8000, 0},
        {"columns", 0, OPTION_INTEGER, "N", "number of columns (1)", &s->columns, 1,
         PAGE_FRAMES_MAX, 0},
        {"gap", 0, OPTION_NUMBER, "PX", "space between columns (24)", &s->gap_px, 0, 8000, 0},
        {"notes", 0, OPTION_NUMBER, "PX",
         "width of the margin for [>notes], at the right or below vertical lines (0: at the "
         "foot)",
         &s->notes_px, 0, 8000, 0},
        {"align", 0, OPTION_TEXT, "A", "left, right, center or justify (justify)", &s->align, 0,
         0, 0},
        {"indent", 0, OPTION_NUMBER, "EM", "indent of paragraphs' first lines (1.2)",
         &s->indent_em, 0, 20, 0},
        {"hyphenate", 0, OPTION_FLAG, NULL,
         "divide words, by the rules of --language; without it by those of English",
         &s->hyphenate, 0, 0, 0},
        {"language", 0, OPTION_TEXT, "L", "language of the text, such as fr", &s->language, 0,
         0, 0},
        {"features", 0, OPTION_TEXT, "F,..", "OpenType features to switch: onum,-liga",
         &s->features, 0, 0, 0},
        {"protrude", 0, OPTION_NUMBER, "P", "how far signs stand in the margins, 0..1 (0)",
         &s->protrude, 0, 1, 0},
        {"expand", 0, OPTION_NUMBER, "P", "how far letters are widened, 0..0.05 (0)",
         &s->expand, 0, 0.05, 0},
        {"tolerance", 0, OPTION_NUMBER, "B", "the badness that a line may have (200)",
         &s->tolerance, 0, 10000, 0},
        {"folios", 0, OPTION_FLAG, NULL, "page numbers in the lower margin", &s->folios, 0, 0,
         0},
        {"head", 0, OPTION_TEXT, "T",
         "running head in the upper margin; %h: the last heading, %p: the page", &s->head, 0, 0,
         0},
        {"grid", 0, OPTION_FLAG, NULL, "lines of columns beside each other are level", &s->grid,
         0, 0, 0},
        {"vertical", 0, OPTION_FLAG, NULL, "lines go down, from the right to the left",
         &s->vertical, 0, 0, 0},
        {"around", 0, OPTION_LIST, "X,Y,RX,RY",
         "text goes around this ellipse; as often as wanted", &s->around, -16384, 16384, 4},
        {"inside", 0, OPTION_LIST, "X,Y,RX,RY", "text stays inside of this ellipse", &s->inside,
         -16384, 16384, 4},
        {"ink", 0, OPTION_NUMBERS, "R,G,B", "colour of the ink, each 0..1 (0,0,0)", s->ink, 0,
         1, 3},
        {"filter", 0, OPTION_TEXT, "F", "filter of the letters (gaussian-fast)", &s->filter, 0,
         0, 0},
        {"filter-of", 0, OPTION_TEXTS, "PART=F",
         "filter of the text, of italic or bold words, of a head or a note: note=cone",
         &s->filters, 0, 0, 0},
        {"darken", 0, OPTION_NUMBER, "PX",
         "widens the stems of small type; 0: does not (as their width needs)", &s->darken_px, 0,
         2, 0},
        {"statistics", 0, OPTION_FLAG, NULL, "also print what was set", &s->statistics, 0, 0,
         0},
        {0}};
    struct option_words words;
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
    if (type_out_of(s->out_path) == TYPE_OUT_NONE)
        return fail_usage("set", "-o names a picture: FILE.png, .svg or .pdf (got '%.80s')",
                          s->out_path);
    return EXIT_SUCCESS;
}

static int text_read(const char *path, char **text, size_t *bytes)
{
    const char *why = "";
    bool piped = strcmp(path, "-") == 0;
    FILE *file = piped ? stdin : input_file_open(path, &why);
    size_t room = 0;
    *text = NULL;
    *bytes = 0;
    if (!file)
        return fail("set", "%s: %s", path, why);
    for (;;) {
        if (*bytes == room) {
            room = room ? 2 * room : 65536;
            char *more = room <= TEXT_BYTES_MAX ? realloc(*text, room) : NULL;
            if (!more)
                break;
            *text = more;
        }
        size_t got = fread(*text + *bytes, 1, room - *bytes, file);
        *bytes += got;
        if (!got)
            break;
    }
    bool good = *text && *bytes < room && !ferror(file);
    if (!piped)
        fclose(file);
    return good ? EXIT_SUCCESS
                : fail("set", "%s cannot be read whole; a text has up to %d MB", path,
                       TEXT_BYTES_MAX >> 20);
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
                                               .distance_px = k ? 0 : s->size_px / 2};
            s->setup.shapes_count++;
        }
    s->setup.shapes = s->shapes;
    return EXIT_SUCCESS;
}

static void lacking_add(struct set *s, const struct font_layout *layout)
{
    for (int i = 0; i < layout->missing_count && i < FONT_MISSING_MAX; i++)
        font_layout_missing_add(&s->lacking, layout->missing[i]);
    s->lacking.missing_count += layout->missing_count > FONT_MISSING_MAX; /* more than named */
}

/* What PDF and SVG are made of. Owns: the caller finishes both. */
static int page_said(struct set *s, struct page_text *text, int page,
                     struct font_layout *layout, struct page_said *said,
                     struct font_drawing *drawing)
{
    if (page_layout_said(text, page, layout, said) != FONT_OK)
        return fail_font("set");
    lacking_add(s, layout);
    *drawing = (struct font_drawing){.width_px = s->page_px[0],
                                     .height_px = s->page_px[1],
                                     .ink = {s->ink[0], s->ink[1], s->ink[2]},
                                     .text = said->utf8,
                                     .bytes = said->bytes,
                                     .passages = said->passages,
                                     .passages_count = said->passages_count,
                                     .language = s->language    ? s->language
                                                 : s->hyphenate ? "en"
                                                                : NULL};
    return EXIT_SUCCESS;
}

/* The title of a PDF: what was asked for, else the first heading. Owns: the caller frees it; NULL: there is none. */
static char *title_of(const struct set *s, const struct page_said *said)
{
    for (int i = 0; !s->title && i < said->passages_count; i++) {
        const struct font_passage *p = &said->passages[i];
        if (p->role == FONT_ROLE_HEADING) /* without the end of its line */
            return strndup(said->utf8 + p->begin, p->end - p->begin - 1);
    }
    return s->title ? strdup(s->title) : NULL;
}

static int page_write(struct set *s, struct page_text *text, int page, const char *path)
{
    struct font_layout layout;
    struct page_said said;
    struct font_drawing drawing;
    int status = page_said(s, text, page, &layout, &said, &drawing);
    if (status != EXIT_SUCCESS)
        return status;
    char *title = title_of(s, &said);
    drawing.title = title;
    status = type_drawing_write("set", path, &drawing, &layout, NULL, 0, 0);
    font_layout_finish(&layout);
    page_said_finish(&said);
    free(title);
    return status;
}

/* All pages as one PDF, its title the first one's. */
static int book_make(struct set *s, struct page_text *text, int count,
                     struct font_document **book)
{
    int status = EXIT_SUCCESS;
    for (int i = 0; i < count && status == EXIT_SUCCESS; i++) {
        struct font_layout layout;
        struct page_said said;
        struct font_drawing drawing;
        if (interrupted()) {
            fail("set", "interrupted at page %d of %d", i + 1, count);
            return EXIT_INTERRUPTED;
        }
        status = page_said(s, text, i, &layout, &said, &drawing);
        if (status != EXIT_SUCCESS)
            return status;
        if (!*book) {
            char *title = title_of(s, &said);
            const struct font_document_def def = {.title = title, .language = drawing.language};
            if (font_document_create(&def, book) != FONT_OK)
                status = fail_font("set");
            free(title);
        }
        if (status == EXIT_SUCCESS &&
            font_document_page(*book, &drawing, &layout, NULL, 0, 0) != FONT_OK)
            status = fail_font("set");
        font_layout_finish(&layout);
        page_said_finish(&said);
    }
    return status;
}

static int book_write(struct set *s, struct page_text *text, int count)
{
    struct font_document *book = NULL;
    struct output_file out;
    int status = book_make(s, text, count, &book);
    if (status == EXIT_SUCCESS && !output_file_open(&out, s->out_path)) {
        status = fail("set", "%s: cannot write: %s", s->out_path, out.why);
    } else if (status == EXIT_SUCCESS && font_document_write(book, out.stream) != FONT_OK) {
        output_file_abandon(&out);
        status = fail_font("set");
    } else if (status == EXIT_SUCCESS && !output_file_commit(&out)) {
        status = fail("set", "%s: cannot write: %s", s->out_path, out.why);
    }
    font_document_destroy(book);
    return status;
}

static int page_draw(struct set *s, struct page_text *text, int page, const char *path)
{
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter = NULL;
    struct font_layout layout = {0};
    struct display_image image = {0};
    if (type_out_of(path) != TYPE_OUT_PNG)
        return page_write(s, text, page, path);
    def.filter = s->filter;
    def.darken_px = s->darken_px;
    memcpy(def.ink, s->ink, sizeof def.ink);
    int status = EXIT_SUCCESS;
    if (page_layout(text, page, &layout) != FONT_OK ||
        font_painter_create(&def, &painter) != FONT_OK)
        status = fail_font("set");
    lacking_add(s, &layout);
    if (status == EXIT_SUCCESS)
        status = type_image_create("set", s->page_px[0], s->page_px[1], &image);
    struct font_picture picture = type_picture(&image);
    if (status == EXIT_SUCCESS &&
        font_painter_layout(painter, &layout, NULL, 0, 0, &picture) != FONT_OK)
        status = fail_font("set");
    if (status == EXIT_SUCCESS)
        status = type_image_write("set", path, &image);
    display_image_destroy(&image);
    font_layout_finish(&layout);
    font_painter_destroy(painter);
    return status;
}

/* page.png becomes page-12.png. */
static char *numbered(const char *path, int number)
{
    const char *base = strrchr(path, '/'), *ending = strrchr(base ? base : path, '.');
    size_t stem = ending ? (size_t)(ending - path) : strlen(path), room = strlen(path) + 16;
    char *name = malloc(room);
    if (name)
        snprintf(name, room, "%.*s-%d%s", (int)stem, path, number, ending ? ending : "");
    return name;
}

/* Each in a file of its own. */
static int pages_draw_each(struct set *s, struct page_text *text, int count)
{
    int status = EXIT_SUCCESS;
    interrupt_catch(); /* no page is left half written */
    for (int i = 0; i < count && status == EXIT_SUCCESS; i++) {
        if (interrupted()) {
            fail("set", "interrupted before page %d of %d", i + 1, count);
            return EXIT_INTERRUPTED;
        }
        char *name = numbered(s->out_path, i + 1);
        status = name ? page_draw(s, text, i, name) : fail("set", "no memory");
        free(name);
    }
    return status;
}

static int pages_draw(struct set *s, struct page_text *text)
{
    bool book = type_out_of(s->out_path) == TYPE_OUT_PDF && !s->page && !s->all;
    int count = 0, status = EXIT_SUCCESS;
    if ((s->all || s->statistics || book) && page_count(text, &count) != FONT_OK)
        return fail_font("set");
    if (book) {
        interrupt_catch();
        status = book_write(s, text, count);
    } else if (s->all) {
        status = pages_draw_each(s, text, count);
    } else {
        status = page_draw(s, text, s->page ? s->page - 1 : 0, s->out_path);
    }
    if (status == EXIT_SUCCESS && s->statistics) {
        struct page_stats stats;
        page_stats_get(text, &stats);
        printf("%d pages; %ld paragraphs; %d lines that nothing fits; %.1f MB\n", count,
               stats.paragraphs_broken, stats.lines_overfull, (double)stats.bytes * 1e-6);
    }
    return status;
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

static int align_read(const char *word, enum font_align *align)
{
    static const char *const words[] = {[FONT_ALIGN_LEFT] = "left",
                                        [FONT_ALIGN_RIGHT] = "right",
                                        [FONT_ALIGN_CENTER] = "center",
                                        [FONT_ALIGN_JUSTIFY] = "justify"};
    for (int i = FONT_ALIGN_LEFT; i <= FONT_ALIGN_JUSTIFY; i++)
        if (strcmp(word, words[i]) == 0) {
            *align = (enum font_align)i;
            return EXIT_SUCCESS;
        }
    return fail_usage("set", "--align must be left, right, center or justify (got '%.60s')",
                      word);
}

static struct page_setup setup_of(const struct set *s)
{
    return (struct page_setup){.font = s->font,
                               .italic = s->italic,
                               .bold = s->bold,
                               .features = s->features,
                               .language = s->language,
                               .size_px = s->size_px,
                               .leading = s->leading,
                               .width_px = s->page_px[0],
                               .height_px = s->page_px[1],
                               .margin_px = s->margin_px,
                               .gap_px = s->gap_px,
                               .columns = s->columns,
                               .notes_px = s->notes_px,
                               .indent_em = s->indent_em,
                               .hyphenate = s->hyphenate,
                               .vertical = s->vertical,
                               .grid = s->grid,
                               .folios = s->folios,
                               .head = s->head,
                               .colour = true,
                               .protrude = s->protrude,
                               .expand = s->expand,
                               .tolerance = s->tolerance};
}

int verb_set(int argc, char **argv)
{
    static struct set s; /* its lists are large */
    const char *path = NULL;
    char *text = NULL, *font = NULL, *filter = NULL;
    size_t bytes = 0;
    bool help = false;
    const struct page_setup usual = page_setup_default();
    s = (struct set){.out_path = "page.png",
                     .align = "justify",
                     .size_px = usual.size_px,
                     .margin_px = usual.margin_px,
                     .gap_px = usual.gap_px,
                     .indent_em = usual.indent_em,
                     .tolerance = usual.tolerance,
                     .page_px = {600, 840},
                     .darken_px = FONT_DARKEN_BY_STEM,
                     .columns = 1};
    int status = set_options(&s, argc, argv, &path, &help);
    if (status == EXIT_SUCCESS && !help)
        status = type_font_name("set", s.font, s.edits, usual.font, &font);
    if (status != EXIT_SUCCESS || help)
        return status;
    s.font = font;
    if (s.filter) {
        status = type_filter_read("set", s.filter, &filter);
        s.filter = filter;
    }
    s.setup = setup_of(&s);
    if (status == EXIT_SUCCESS)
        status = align_read(s.align, &s.setup.align);
    if (status == EXIT_SUCCESS)
        status = filters_read(&s);
    if (status == EXIT_SUCCESS)
        status = shapes_make(&s);
    if (status == EXIT_SUCCESS)
        status = text_read(path, &text, &bytes);
    struct page_text *pages = NULL;
    if (status == EXIT_SUCCESS && page_setup_make(&s.setup, text, bytes, &pages) != FONT_OK)
        status = fail_font("set");
    if (status == EXIT_SUCCESS)
        status = pages_draw(&s, pages);
    int damaged = status == EXIT_SUCCESS ? font_utf8_damaged(text, bytes) : 0;
    if (damaged)
        tell("set", "the text is not UTF-8 in %d places; U+FFFD stands there", damaged);
    if (status == EXIT_SUCCESS && s.hyphenate && !page_language_divides(s.language))
        tell("set",
             "there are no patterns to divide words of '%.20s' by (packages hyphen-..., as "
             "hyphen-fr): none is divided",
             s.language ? s.language : "en");
    if (status == EXIT_SUCCESS)
        type_missing_tell("set", s.font, &s.lacking);
    type_left_out_tell("set");
    page_text_destroy(pages);
    free(text);
    free(font);
    free(filter);
    return status;
}
