/* verb_read.c - `lutetia read`: Markdown as pages, in a window or as HTML: headings, lists,
 * notes, tables, code, formulas. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "read_html.h"
#include "read_left.h"
#include "read_manual.h"
#include "read_small.h"
#include "type_common.h"
#include "type_pages.h"

#include <beside.h>
#include <display.h>
#include <input_file.h>
#include <paint.h>
#include <program.h>
#include <reader_document.h>
#include <reader_files.h>
#include <reader_pages.h>
#include <reader_template.h>

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

struct read {
    struct type_pages pages;
    const char *font, *mono, *math, *theme, *play, *template;
    struct reader_template look; /* where there is a template */
    double size_px, leading, margin_px, gap_px, notes_px;
    int columns, small_px; /* small_px: of miniatures; 0: none */
    bool ragged, plain, remarks;
    bool manual; /* no file was named */
};

static bool is_html(const struct read *r)
{
    const char *path = r->pages.out_path, *ending = path ? strrchr(path, '.') : NULL;
    return ending && (strcasecmp(ending, ".html") == 0 || strcasecmp(ending, ".htm") == 0);
}

/* It says something that pages have. */
static bool template_has_pages(const struct reader_template *t)
{
    const struct reader_colours *usual = reader_colours_of(false), *own = &t->colours[0];
    bool has = t->texts_count > 1 || t->beside.side != READER_SIDE_USUAL ||
               memcmp(own->link, usual->link, sizeof own->link) != 0 ||
               memcmp(own->struck, usual->struck, sizeof own->struck) != 0;
    for (int i = 0; i < READER_SIZES; i++)
        has = has || t->sizes[i] > 0;
    return has;
}

/* What is to be written, and that each option has an effect on it. */
static int out_check(const struct read *r, const struct option_row *rows,
                     const struct option_words *words)
{
    static const char *const of_pages[] = {
        "page",  "all",    "paper", "leading", "margin",     "columns",   "gap",
        "notes", "ragged", "plain", "mono",    "statistics", "miniatures"};
    if (!r->pages.out_path)
        return EXIT_SUCCESS;
    if (!is_html(r)) {
        if (type_out_of(r->pages.out_path) == TYPE_OUT_NONE)
            return fail_usage("read", "-o names FILE.html, .pdf, .svg or .png (got '%.80s')",
                              r->pages.out_path);
        if (r->theme)
            return fail_usage("read", "--theme has no effect on pages: it is for %s", ".html");
        if (r->template && !template_has_pages(&r->look))
            return fail_usage("read",
                              "--template: '%.60s' says nothing that pages have, as columns of "
                              "text, sizes and links' colours; they have --columns "
                              "and --notes",
                              r->template);
        if (r->small_px && (type_out_of(r->pages.out_path) != TYPE_OUT_PNG || r->pages.page ||
                            r->pages.all || r->pages.statistics))
            return fail_usage("read", "--miniatures has all pages in one picture: -o %s",
                              "FILE.png, without --page, --all and --statistics");
        return r->remarks && type_out_of(r->pages.out_path) == TYPE_OUT_PNG
                   ? fail_usage("read", "--remarks has no effect on pictures: it is for %s",
                                ".html, .pdf and .svg")
                   : EXIT_SUCCESS;
    }
    for (int i = 0; rows[i].name; i++)
        for (size_t k = 0; words->given[i] && k < sizeof of_pages / sizeof *of_pages; k++)
            if (strcmp(rows[i].name, of_pages[k]) == 0)
                return fail_usage("read", "--%s has no effect on .html: it is for pages",
                                  rows[i].name);
    return EXIT_SUCCESS;
}

enum { WORDS_MAX = OPTION_WORDS_MAX + 16 }; /* of the window's program */

static int read_options(struct read *r, int argc, char **argv, struct option_words *words)
{
    const struct option_row rows[] = {
        TYPE_PAGES_OPTIONS(&r->pages, "read", "all of it as .html; without -o a window opens"),
        {"font", 0, OPTION_TEXT, "F",
         "the font: a file, the name of one, or a family (EB Garamond)", &r->font, 0, 0, 0},
        {"mono", 0, OPTION_TEXT, "F", "font of code (DejaVuSansMono)", &r->mono, 0, 0, 0},
        {"math", 0, OPTION_TEXT, "F",
         "font of formulas, which needs a table MATH (DejaVu Math TeX Gyre)", &r->math, 0, 0,
         0},
        {"size", 0, OPTION_NUMBER, "PX", "size of the em (17)", &r->size_px, 1, 1000, 0},
        {"leading", 0, OPTION_NUMBER, "L", "distance of lines, of the size (1.3)", &r->leading,
         0.5, 10, 0},
        {"margin", 0, OPTION_NUMBER, "PX", "margin around the page's text (64)", &r->margin_px,
         0, 8000, 0},
        {"columns", 0, OPTION_INTEGER, "N", "number of columns (1)", &r->columns, 1, 12, 0},
        {"gap", 0, OPTION_NUMBER, "PX", "space between columns (24)", &r->gap_px, 0, 8000, 0},
        {"notes", 0, OPTION_NUMBER, "PX",
         "width of a margin at the right for notes [^margin:..] (0: at the foot)", &r->notes_px,
         0, 8000, 0},
        {"language", 0, OPTION_TEXT, "L", "language of the text, such as fr (en)",
         &r->pages.language, 0, 0, 0},
        {"ragged", 0, OPTION_FLAG, NULL, "lines end where their words do", &r->ragged, 0, 0, 0},
        {"plain", 0, OPTION_FLAG, NULL, "no page numbers, and no chapter over the page",
         &r->plain, 0, 0, 0},
        {"theme", 0, OPTION_TEXT, "NAME",
         "of the window, of .html: light or dark (as the desktop is)", &r->theme, 0, 0, 0},
        {"template", 0, OPTION_TEXT, "T",
         "layout, colours and sizes: screen, book, two-columns, or a file (screen)",
         &r->template, 0, 0, 0},
        {"miniatures", 0, OPTION_INTEGER, "PX",
         "all pages small in one .png, each so many pixels wide, by the filters of such sizes",
         &r->small_px, 16, 1000, 0},
        {"remarks", 0, OPTION_FLAG, NULL,
         "what readers left in FILE.md.notes: highlights, notes, ink (not in .png)",
         &r->remarks, 0, 0, 0},
        {"play", 0, OPTION_TEXT, "FILE",
         "recorded input in place of a hand in the window: lines of docs/reader.md", &r->play,
         0, 0, 0},
        {0}};
    /* What a window has in its own way, and what pages have not. */
    static const struct option_need needs[] = {
        {"page", "out"},       {"all", "out"},        {"title", "out"},
        {"paper", "out"},      {"leading", "out"},    {"margin", "out"},
        {"columns", "out"},    {"gap", "out"},        {"notes", "out"},
        {"plain", "out"},      {"statistics", "out"}, {"remarks", "out"},
        {"miniatures", "out"}, {"play", "!out"},      {0}};
    if (!options_parse("read", rows, argc, argv, words))
        return EXIT_USAGE;
    if (words->help)
        return help_print("read", rows, NULL);
    if (!options_effects("read", rows, needs, words))
        return EXIT_USAGE;
    if (r->theme && strcmp(r->theme, "light") != 0 && strcmp(r->theme, "dark") != 0)
        return fail_usage("read", "--theme must be light or dark (got '%.40s')", r->theme);
    if (r->template && reader_template_open(r->template, &r->look) != READER_OK)
        return fail_usage("read", "--template: %s", reader_error());
    const int status = out_check(r, rows, words);
    r->manual = words->count == 0;
    return status == EXIT_SUCCESS && r->manual ? read_manual_words(words) : status;
}

static int fail_reader(const char *path)
{
    return path ? fail("read", "%s: %s", path, reader_error())
                : fail("read", "%s", reader_error());
}

static bool picture_find(void *user, int source, const char *target, struct reader_picture *out)
{
    const struct reader_files *files = user;
    struct display_image image;
    uint8_t *alpha;
    if (source >= files->count ||
        !display_beside_read_alpha(files->paths[source], target, &image, &alpha))
        return false;
    *out = (struct reader_picture){image.width_px, image.height_px, image.pixels, alpha};
    return true;
}

/* All files as one document; how many of their sequences are not UTF-8. */
static int document_read(const struct option_words *words, struct reader_document **document,
                         struct reader_files *files, int *damaged)
{
    *damaged = 0;
    if (reader_document_create(document) != READER_OK)
        return fail_reader(NULL);
    for (int i = 0; i < words->count; i++) {
        char *text = NULL;
        size_t bytes = 0;
        int status = type_text_read("read", words->words[i], &text, &bytes);
        if (status == EXIT_SUCCESS &&
            reader_files_add(files, *document, words->words[i], text, bytes) != READER_OK)
            status = fail_reader(words->words[i]);
        if (status == EXIT_SUCCESS)
            *damaged += font_utf8_damaged(text, bytes);
        free(text);
        if (status != EXIT_SUCCESS)
            return status;
    }
    return reader_files_refer(files, *document) == READER_OK ? EXIT_SUCCESS : fail_reader(NULL);
}

/* Files that are not included, and references that lead nowhere, one a line. */
static void lost_tell(const struct reader_files *files, const struct reader_document *document)
{
    for (int i = 0; i < files->refused_count; i++)
        tell("read", "%s", files->refused[i]);
    if (files->refused_all > files->refused_count)
        tell("read", "and %ld other files", files->refused_all - files->refused_count);
    for (int i = 0; i < document->lost_count; i++)
        tell("read", "%s:%d: there is no label #%s: it stands as it is written",
             files->paths[document->lost[i].source], document->lost[i].line,
             document->lost[i].label);
    if (document->lost_all > document->lost_count)
        tell("read", "and %ld other labels", document->lost_all - document->lost_count);
}

/* What formulas lacked: unknown commands, of which `first` is one, and a font (no_font). */
static void formulas_tell(int unknown, const char *first, bool no_font)
{
    if (unknown)
        tell("read",
             "'%s' is no command of mathematics that is known%s: it stands as it is written",
             first, unknown > 1 ? ", and others are not" : "");
    if (no_font)
        tell("read",
             "there is no font with a table MATH (package fonts-dejavu-extra): formulas "
             "stand as they are written");
}

/* What readers left on a page. */
static bool left_put(void *user, int page, struct font_drawing *drawing)
{
    return reader_pages_left(user, page, drawing) == READER_OK ||
           fail_reader(NULL) == EXIT_SUCCESS;
}

static int pages_write(struct read *r, const struct reader_pages_setup *setup,
                       const struct reader_document *document, int damaged)
{
    struct reader_pages *pages;
    if (reader_pages_make(document, setup, &pages) != READER_OK)
        return fail_reader(NULL);
    if (setup->remarks) {
        r->pages.beside = left_put;
        r->pages.beside_user = pages;
    }
    int status = type_pages_write(&r->pages, reader_pages_text(pages));
    if (status == EXIT_SUCCESS) {
        int unknown;
        const char *first = reader_pages_unknown(pages, &unknown);
        formulas_tell(unknown, first, reader_pages_lacks_math(pages));
        type_pages_tell(&r->pages, setup->font, damaged, setup->language);
    }
    type_left_out_tell("read");
    reader_pages_destroy(pages);
    return status;
}

/* All of it as one file that a browser shows. */
static int html_write(const struct read *r, const struct reader_document *document,
                      const struct reader_files *files, const struct reader_remarks *remarks,
                      int damaged)
{
    struct reader_html_lacks lacks = {0};
    const struct reader_html_setup setup = {.title = r->pages.title,
                                            .language = r->pages.language,
                                            .theme = !r->theme ? READER_HTML_BOTH
                                                     : strcmp(r->theme, "dark") == 0
                                                         ? READER_HTML_DARK
                                                         : READER_HTML_LIGHT,
                                            .size_px = r->size_px,
                                            .font = r->font,
                                            .math = r->math,
                                            .template = r->template ? &r->look : NULL,
                                            .files = files,
                                            .remarks = remarks,
                                            .lacks = &lacks};
    const int status = read_html_write(r->pages.out_path, document, &setup);
    if (status == EXIT_SUCCESS) {
        formulas_tell(lacks.unknown_count, lacks.unknown, lacks.math);
        type_damaged_tell("read", damaged);
        type_missing_tell("read", r->math ? r->math : "the formulas' font", &lacks.letters);
    }
    type_left_out_tell("read");
    return status;
}

/* Columns of text beside each other are those of the template, where the page has room for them
 * and no others are asked for. */
static void template_columns(const struct read *r, const struct reader_document *document,
                             struct reader_pages_setup *setup)
{
    struct reader_grid grid;
    bool notes = false;
    if (!r->template || r->look.texts_count < 2 || r->columns != 1 || r->notes_px > 0)
        return;
    for (int i = 0; i < document->notes_count; i++)
        notes = notes || strcmp(document->notes[i].class, "margin") == 0;
    reader_template_grid(&r->look, setup->width_px, setup->size_px, notes, &grid);
    if (grid.texts > 1)
        setup->grid = grid;
}

/* Sizes and colours on pages. */
static void template_set(const struct read *r, struct reader_pages_setup *setup)
{
    const struct reader_colours *colours = &r->look.colours[0];
    if (!r->template)
        return;
    memcpy(setup->sizes, r->look.sizes, sizeof setup->sizes);
    memcpy(setup->ink_link, colours->link, sizeof setup->ink_link);
    memcpy(setup->ink_struck, colours->struck, sizeof setup->ink_struck);
    setup->beside = r->look.beside;
}

/* HTML or pages, with what readers left where that is asked for. */
static int document_write(struct read *r, const struct option_words *words,
                          struct reader_pages_setup *setup, struct reader_document *document,
                          const struct reader_files *files, int damaged)
{
    struct reader_remarks *remarks = NULL;
    int status = EXIT_SUCCESS;
    if ((r->remarks || r->small_px || is_html(r)) &&
        reader_document_plain(document) != READER_OK)
        status = fail_reader(NULL);
    if (status == EXIT_SUCCESS && r->remarks)
        status =
            read_left_open(r->manual ? READ_LEFT_MANUAL : words->words[0], document, &remarks);
    setup->remarks = remarks;
    if (status == EXIT_SUCCESS)
        status = is_html(r) ? html_write(r, document, files, remarks, damaged)
                 : r->small_px
                     ? read_small_write(r->pages.out_path, document, setup, r->small_px)
                     : pages_write(r, setup, document, damaged);
    reader_remarks_close(remarks);
    return status;
}

/* ---- the window ---- */

static void here(void)
{
}

struct line {
    char *words[WORDS_MAX];
    int count;
    bool good;
};

__attribute__((format(printf, 2, 3))) static void word_add(struct line *line,
                                                           const char *format, ...)
{
    va_list values;
    va_start(values, format);
    char *word = NULL;
    line->good =
        line->good && line->count + 1 < WORDS_MAX && vasprintf(&word, format, values) >= 0;
    va_end(values);
    if (line->good)
        line->words[line->count++] = word;
}

static void line_fill(struct line *line, const struct read *r, const struct option_words *words)
{
    const struct {
        const char *name, *value;
    } texts[] = {{"font", r->font},        {"mono", r->mono}, {"math", r->math},
                 {"theme", r->theme},      {"play", r->play}, {"language", r->pages.language},
                 {"template", r->template}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (texts[i].value)
            word_add(line, "%s=%s", texts[i].name, texts[i].value);
    word_add(line, "size=%g", r->size_px);
    if (r->ragged)
        word_add(line, "ragged=1");
    if (r->manual)
        word_add(line, "manual=1");
    for (int i = 0; i < words->count; i++)
        word_add(line, "file=%s", words->words[i]);
}

/* What cannot be read is said before a window opens. */
static int files_check(const struct option_words *words)
{
    for (int i = 0; i < words->count; i++) {
        const char *why;
        if (strcmp(words->words[i], "-") == 0)
            return fail_usage("read", "what is piped in has no window: give -o FILE%s", "");
        FILE *file = input_file_open(words->words[i], &why);
        if (!file)
            return fail("read", "%s: %s", words->words[i], why);
        fclose(file);
    }
    return EXIT_SUCCESS;
}

/* The window is a program of its own (desk/reader/read_main.c): so no other verb loads GTK. */
static int window_run(const struct read *r, const struct option_words *words)
{
    char path[PATH_MAX];
    struct line line = {.count = 1, .good = true};
    int status = files_check(words);
    if (status != EXIT_SUCCESS)
        return status;
    if (!program_find(path, here, LUTETIA_LIBEXECDIR "/lutetia/lutetia-reader",
                      "desk/reader/lutetia-reader"))
        return fail("read",
                    "this lutetia was built without GTK 4, which the window needs: "
                    "install libgtk-4-dev and build again, or write pages with -o FILE");
    line.words[0] = path;
    line_fill(&line, r, words);
    if (line.good)
        execv(path, line.words);
    status = line.good ? fail("read", "%s cannot be run: %s", path, strerror(errno))
                       : fail("read", "a document has up to %d files", WORDS_MAX - 16);
    for (int i = 1; i < line.count; i++)
        free(line.words[i]);
    return status;
}

int verb_read(int argc, char **argv)
{
    struct option_words words;
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct read r = {.pages = {.verb = "read",
                               .language = "en",
                               .filter = font_painter_def_default().filter,
                               .darken_px = FONT_DARKEN_BY_STEM,
                               .page_px = {(int)setup.width_px, (int)setup.height_px}},
                     .size_px = setup.size_px,
                     .leading = setup.leading,
                     .margin_px = setup.margin_px,
                     .gap_px = setup.gap_px,
                     .columns = setup.columns};
    int status = read_options(&r, argc, argv, &words), damaged = 0;
    struct reader_document *document = NULL;
    struct reader_files files = {0};
    if (status != EXIT_SUCCESS || words.help)
        return status;
    if (!r.pages.out_path)
        return window_run(&r, &words);
    setup.font = r.font ? r.font : setup.font;
    setup.mono = r.mono ? r.mono : setup.mono;
    setup.math = r.math;
    setup.language = r.pages.language;
    setup.size_px = r.size_px;
    setup.leading = r.leading;
    setup.width_px = r.pages.page_px[0];
    setup.height_px = r.pages.page_px[1];
    setup.margin_px = r.margin_px;
    setup.gap_px = r.gap_px;
    setup.notes_px = r.notes_px;
    setup.columns = r.columns;
    setup.running = !r.plain;
    template_set(&r, &setup);
    setup.picture = picture_find;
    setup.picture_user = &files;
    if (r.ragged)
        setup.align = FONT_ALIGN_START;
    status = document_read(&words, &document, &files, &damaged);
    if (status == EXIT_SUCCESS)
        template_columns(&r, document, &setup);
    if (status == EXIT_SUCCESS)
        status = document_write(&r, &words, &setup, document, &files, damaged);
    if (status == EXIT_SUCCESS)
        lost_tell(&files, document);
    reader_document_destroy(document);
    reader_files_finish(&files);
    return status;
}
