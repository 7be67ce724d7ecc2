/* verb_read.c - `lutetia read`: Markdown as pages: headings, lists, notes, tables, code, formulas. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "type_common.h"
#include "type_pages.h"

#include <display.h>
#include <paint.h>
#include <reader_document.h>
#include <reader_pages.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct read {
    struct type_pages pages;
    const char *font, *mono, *math;
    double size_px, leading, margin_px, gap_px, notes_px;
    int columns;
    bool ragged, plain;
};

static int read_options(struct read *r, int argc, char **argv, struct option_words *words)
{
    const struct option_row rows[] = {
        TYPE_PAGES_OPTIONS(&r->pages, "read", "read.pdf"),
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
        {0}};
    if (!options_parse("read", rows, argc, argv, words))
        return EXIT_USAGE;
    if (words->help)
        return help_print("read", rows, NULL);
    if (words->count < 1)
        return fail_usage("read", "give a Markdown file, or several, or -%s", "");
    return type_pages_check(&r->pages);
}

static int fail_reader(const char *path)
{
    return path ? fail("read", "%s: %s", path, reader_error())
                : fail("read", "%s", reader_error());
}

/* A PNG in the folder of the document's file, or below it. Others, and what cannot be read, are told by their names. */
static bool picture_find(void *user, int source, const char *target, struct reader_picture *out)
{
    const double bytes_max = 512e6;
    const struct option_words *words = user;
    const char *file = words->words[source], *slash = strrchr(file, '/');
    size_t n = strlen(target);
    struct display_image image;
    char *path;
    if (n < 5 || strcmp(target + n - 4, ".png") != 0 || target[0] == '/' ||
        strstr(target, "..") || strchr(target, ':'))
        return false;
    if (asprintf(&path, "%.*s%s", slash ? (int)(slash + 1 - file) : 0, file, target) < 0)
        return false;
    bool found = display_png_bytes(path, 3) <= bytes_max &&
                 display_png_read_rgb(path, &image) == DISPLAY_OK;
    free(path);
    if (found)
        *out = (struct reader_picture){image.width_px, image.height_px, image.pixels};
    return found;
}

/* All files as one document; how many of their sequences are not UTF-8. */
static int document_read(const struct option_words *words, struct reader_document **document,
                         int *damaged)
{
    *damaged = 0;
    if (reader_document_create(document) != READER_OK)
        return fail_reader(NULL);
    for (int i = 0; i < words->count; i++) {
        char *text = NULL;
        size_t bytes = 0;
        int status = type_text_read("read", words->words[i], &text, &bytes);
        if (status == EXIT_SUCCESS && reader_document_add(*document, text, bytes) != READER_OK)
            status = fail_reader(words->words[i]);
        if (status == EXIT_SUCCESS)
            *damaged += font_utf8_damaged(text, bytes);
        free(text);
        if (status != EXIT_SUCCESS)
            return status;
    }
    return EXIT_SUCCESS;
}

static void told(const struct reader_pages *pages)
{
    int unknown;
    const char *first = reader_pages_unknown(pages, &unknown);
    if (unknown)
        tell("read",
             "'%s' is no command of mathematics that is known%s: it stands as it is written",
             first, unknown > 1 ? ", and others are not" : "");
    if (reader_pages_lacks_math(pages))
        tell("read",
             "there is no font with a table MATH (package fonts-dejavu-extra): formulas "
             "stand as they are written");
}

static int pages_write(struct read *r, const struct reader_pages_setup *setup,
                       const struct reader_document *document, int damaged)
{
    struct reader_pages *pages;
    if (reader_pages_make(document, setup, &pages) != READER_OK)
        return fail_reader(NULL);
    int status = type_pages_write(&r->pages, reader_pages_text(pages));
    if (status == EXIT_SUCCESS) {
        told(pages);
        type_pages_tell(&r->pages, setup->font, damaged, setup->language);
    }
    type_left_out_tell("read");
    reader_pages_destroy(pages);
    return status;
}

int verb_read(int argc, char **argv)
{
    struct option_words words;
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct read r = {.pages = {.verb = "read",
                               .out_path = "read.pdf",
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
    if (status != EXIT_SUCCESS || words.help)
        return status;
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
    setup.picture = picture_find;
    setup.picture_user = &words;
    if (r.ragged)
        setup.align = FONT_ALIGN_START;
    status = document_read(&words, &document, &damaged);
    if (status == EXIT_SUCCESS)
        status = pages_write(&r, &setup, document, damaged);
    reader_document_destroy(document);
    return status;
}
