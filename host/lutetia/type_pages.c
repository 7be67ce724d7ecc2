/* type_pages.c - see type_pages.h. */
#include "type_pages.h"

#include "lutetia.h"
#include "type_common.h"

#include <document.h>
#include <input_file.h>
#include <output_file.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_BYTES_MAX = 64 << 20 };

int type_text_read(const char *verb, const char *path, char **text, size_t *bytes)
{
    const char *why;
    *text = strcmp(path, "-") == 0 ? input_stream_read(stdin, TEXT_BYTES_MAX, bytes, &why)
                                   : input_file_read(path, TEXT_BYTES_MAX, bytes, &why);
    if (*text)
        return EXIT_SUCCESS;
    return errno == EFBIG ? fail(verb, "%s cannot be read whole; a text has up to %d MB", path,
                                 TEXT_BYTES_MAX >> 20)
                          : fail(verb, "%s: %s", path, why);
}

static void lacking_add(struct type_pages *s, const struct font_layout *layout)
{
    for (int i = 0; i < layout->missing_count && i < FONT_MISSING_MAX; i++)
        font_layout_missing_add(&s->lacking, layout->missing[i]);
    s->lacking.missing_count += layout->missing_count > FONT_MISSING_MAX; /* more than named */
}

/* What PDF and SVG are made of. Owns: the caller finishes both. */
static int page_said(struct type_pages *s, struct page_text *text, int page,
                     struct font_layout *layout, struct page_said *said,
                     struct font_drawing *drawing)
{
    if (page_layout_said(text, page, layout, said) != FONT_OK)
        return fail_font(s->verb);
    lacking_add(s, layout);
    *drawing = (struct font_drawing){.width_px = s->page_px[0],
                                     .height_px = s->page_px[1],
                                     .ink = {s->ink[0], s->ink[1], s->ink[2]},
                                     .text = said->utf8,
                                     .bytes = said->bytes,
                                     .passages = said->passages,
                                     .passages_count = said->passages_count,
                                     .language = s->language};
    if (!s->beside || s->beside(s->beside_user, page, drawing))
        return EXIT_SUCCESS;
    font_layout_finish(layout);
    page_said_finish(said);
    return EXIT_FAILED;
}

/* The title of a PDF: what was asked for, else the first heading. Owns: the caller frees it;
 * NULL: there is none. */
static char *title_of(const struct type_pages *s, const struct page_said *said)
{
    for (int i = 0; !s->title && i < said->passages_count; i++) {
        const struct font_passage *p = &said->passages[i];
        if (p->role == FONT_ROLE_HEADING) /* without the end of its line */
            return strndup(said->utf8 + p->begin, p->end - p->begin - 1);
    }
    return s->title ? strdup(s->title) : NULL;
}

static int page_write(struct type_pages *s, struct page_text *text, int page, const char *path)
{
    struct font_layout layout;
    struct page_said said;
    struct font_drawing drawing;
    int status = page_said(s, text, page, &layout, &said, &drawing);
    if (status != EXIT_SUCCESS)
        return status;
    char *title = title_of(s, &said);
    drawing.title = title;
    status = type_drawing_write(s->verb, path, &drawing, &layout, NULL, 0, 0);
    font_layout_finish(&layout);
    page_said_finish(&said);
    free(title);
    return status;
}

/* All pages as one PDF, its title the first one's. */
static int book_make(struct type_pages *s, struct page_text *text, int count,
                     struct font_document **book)
{
    int status = EXIT_SUCCESS;
    for (int i = 0; i < count && status == EXIT_SUCCESS; i++) {
        struct font_layout layout;
        struct page_said said;
        struct font_drawing drawing;
        if (interrupted()) {
            fail(s->verb, "interrupted at page %d of %d", i + 1, count);
            return EXIT_INTERRUPTED;
        }
        status = page_said(s, text, i, &layout, &said, &drawing);
        if (status != EXIT_SUCCESS)
            return status;
        if (!*book) {
            char *title = title_of(s, &said);
            const struct font_document_def def = {.title = title, .language = drawing.language};
            if (font_document_create(&def, book) != FONT_OK)
                status = fail_font(s->verb);
            free(title);
        }
        if (status == EXIT_SUCCESS &&
            font_document_page(*book, &drawing, &layout, NULL, 0, 0) != FONT_OK)
            status = fail_font(s->verb);
        font_layout_finish(&layout);
        page_said_finish(&said);
    }
    return status;
}

static int book_write(struct type_pages *s, struct page_text *text, int count)
{
    struct font_document *book = NULL;
    struct output_file out;
    int status = book_make(s, text, count, &book);
    if (status == EXIT_SUCCESS && !output_file_open(&out, s->out_path)) {
        status = fail(s->verb, "%s: cannot write: %s", s->out_path, out.why);
    } else if (status == EXIT_SUCCESS && font_document_write(book, out.stream) != FONT_OK) {
        output_file_abandon(&out);
        status = fail_font(s->verb);
    } else if (status == EXIT_SUCCESS && !output_file_commit(&out)) {
        status = fail(s->verb, "%s: cannot write: %s", s->out_path, out.why);
    }
    font_document_destroy(book);
    return status;
}

static int page_draw(struct type_pages *s, struct page_text *text, int page, const char *path)
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
        status = fail_font(s->verb);
    lacking_add(s, &layout);
    if (status == EXIT_SUCCESS)
        status = type_image_create(s->verb, s->page_px[0], s->page_px[1], &image);
    struct font_picture picture = type_picture(&image);
    if (status == EXIT_SUCCESS &&
        font_painter_layout(painter, &layout, NULL, 0, 0, &picture) != FONT_OK)
        status = fail_font(s->verb);
    if (status == EXIT_SUCCESS)
        status = type_image_write(s->verb, path, &image);
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
static int pages_draw_each(struct type_pages *s, struct page_text *text, int count)
{
    int status = EXIT_SUCCESS;
    interrupt_catch(); /* no page is left half written */
    for (int i = 0; i < count && status == EXIT_SUCCESS; i++) {
        if (interrupted()) {
            fail(s->verb, "interrupted before page %d of %d", i + 1, count);
            return EXIT_INTERRUPTED;
        }
        char *name = numbered(s->out_path, i + 1);
        status = name ? page_draw(s, text, i, name) : fail(s->verb, "no memory");
        free(name);
    }
    return status;
}

int type_pages_write(struct type_pages *s, struct page_text *text)
{
    bool book = type_out_of(s->out_path) == TYPE_OUT_PDF && !s->page && !s->all;
    int count = 0, status = EXIT_SUCCESS;
    if ((s->all || s->statistics || book) && page_count(text, &count) != FONT_OK)
        return fail_font(s->verb);
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

int type_pages_check(const struct type_pages *s)
{
    return type_out_of(s->out_path) != TYPE_OUT_NONE
               ? EXIT_SUCCESS
               : fail_usage(s->verb, "-o names a picture: FILE.png, .svg or .pdf (got '%.80s')",
                            s->out_path);
}

void type_pages_tell(const struct type_pages *s, const char *font, int damaged,
                     const char *divided)
{
    type_damaged_tell(s->verb, damaged);
    if (divided && !page_language_divides(divided))
        tell(s->verb,
             "there are no patterns to divide words of '%.20s' by (packages hyphen-..., as "
             "hyphen-fr): none is divided",
             divided);
    type_missing_tell(s->verb, font, &s->lacking);
}
