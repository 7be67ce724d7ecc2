/* type_pages.h - a text as pages in files: pictures, drawings, one PDF. For the verbs that set pages. */
#ifndef LUTETIA_TYPE_PAGES_H
#define LUTETIA_TYPE_PAGES_H

#include <page.h>

#include <stdbool.h>
#include <stddef.h>

struct type_pages {
    const char *verb, *out_path, *title; /* title: of a PDF; NULL: the first heading */
    const char *language;                /* NULL: not told */
    const char *filter;
    double ink[3], darken_px;
    int page_px[2];
    int page; /* which page is drawn, from 1; 0: not said */
    bool all, statistics;
    struct font_layout lacking; /* only its missing characters: of all pages that were drawn */
};

/* Draws the page, or all of them. EXIT_SUCCESS, or prints why not. */
int type_pages_write(struct type_pages *pages, struct page_text *text);

/* All of a file, or of the standard input (-). EXIT_SUCCESS, or prints why not. The caller frees *text. */
int type_text_read(const char *verb, const char *path, char **text, size_t *bytes);

#endif
