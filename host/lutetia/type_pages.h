/* type_pages.h - a text as pages in files: pictures, drawings, one PDF. For the verbs that set
 * pages. */
#ifndef LUTETIA_TYPE_PAGES_H
#define LUTETIA_TYPE_PAGES_H

#include <drawing.h>
#include <page.h>

#include <stdbool.h>
#include <stddef.h>

/* What a verb's options say of them, and what was met. */
struct type_pages {
    const char *verb, *out_path, *title; /* title: of a PDF; NULL: the first heading */
    const char *language;                /* NULL: not told */
    const char *filter;
    double ink[3], darken_px;
    int page_px[2];
    int page; /* which page is drawn, from 1; 0: not said */
    bool all, statistics;
    /* what a page has beside its letters; false: an error was printed. NULL: nothing */
    bool (*beside)(void *user, int page, struct font_drawing *drawing);
    void *beside_user;
    struct font_layout lacking; /* only its missing characters: of all pages that were drawn */
};

/* Rows of such a verb's options; `stem` is the stem of its usual files' names, "page". */
#define TYPE_PAGES_OPTIONS(pages, stem, usual)                                                 \
    {"out",                                                                                    \
     'o',                                                                                      \
     OPTION_TEXT,                                                                              \
     "FILE",                                                                                   \
     "a page as picture, .png or .svg, or all of them as one .pdf (" usual ")",                \
     &(pages)->out_path,                                                                       \
     0,                                                                                        \
     0,                                                                                        \
     0},                                                                                       \
        {"page",         0, OPTION_INTEGER, "N", "which page is drawn (1; of a PDF all)",      \
         &(pages)->page, 1, 99999,          0},                                                \
        {"all",                                                                                \
         0,                                                                                    \
         OPTION_FLAG,                                                                          \
         NULL,                                                                                 \
         "draw all pages, each in a file: " stem "-1.png, " stem "-2.png, ..",                 \
         &(pages)->all,                                                                        \
         0,                                                                                    \
         0,                                                                                    \
         0},                                                                                   \
        {"title",         0, OPTION_TEXT, "T", "title of a PDF (the first heading)",           \
         &(pages)->title, 0, 0,           0},                                                  \
        {"paper",          0,  OPTION_SIZE, "WxH", "size of the page (600x840)",               \
         (pages)->page_px, 16, 16384,       0},                                                \
    {                                                                                          \
        "statistics", 0, OPTION_FLAG, NULL, "also print what was set", &(pages)->statistics,   \
            0, 0, 0                                                                            \
    }
/* EXIT_SUCCESS, or says that the file's ending is of no kind that pages have. */
int type_pages_check(const struct type_pages *pages);

/* Draws the page, or all of them. EXIT_SUCCESS, or prints why not. */
int type_pages_write(struct type_pages *pages, struct page_text *text);

/* Tells what was not as asked: places (damaged) that are not UTF-8, no patterns for the
 * language whose words are divided (NULL: none are), characters that neither the font nor
 * others have. */
void type_pages_tell(const struct type_pages *pages, const char *font, int damaged,
                     const char *divided);

/* All of a file, or of the standard input (-). EXIT_SUCCESS, or prints why not. The caller
 * frees *text. */
int type_text_read(const char *verb, const char *path, char **text, size_t *bytes);

#endif
