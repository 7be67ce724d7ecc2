/* running.c - what each page has besides its text: page numbers, running heads. See page.h. */
#include "page_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void running_finish(struct page_text *t)
{
    for (int i = 0; i < t->running_count; i++)
        free((char *)(uintptr_t)t->running[i].text);
    t->running_count = 0;
}

enum font_status page_running_set(struct page_text *t, const struct page_running *running,
                                  int count)
{
    if (count < 0 || count > PAGE_RUNNING_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a page has at most %d running lines (got %d)",
                         PAGE_RUNNING_MAX, count);
    for (int i = 0; i < count; i++)
        if (!running[i].text || running[i].style < 0 || running[i].style >= t->styles_count ||
            !(running[i].x1 > running[i].x0))
            return font_fail(FONT_BAD_ARGUMENT,
                             "a running line needs a text, a style and a place");
    running_finish(t);
    for (int i = 0; i < count; i++) {
        t->running[i] = running[i];
        t->running[i].text = strdup(running[i].text);
        if (!t->running[i].text)
            return font_fail(FONT_NO_MEMORY, "no memory for a page");
        t->running_count++;
    }
    return FONT_OK;
}

static bool is_head(const struct paragraph *p)
{
    return p->flow >= 0 && p->manner.role == FONT_ROLE_HEADING && p->manner.level <= 1;
}

/* The last heading of level 1 that a page, or one before it, has. */
static const struct paragraph *head_of(const struct page_text *t, int page)
{
    for (int k = page; k >= 0; k--)
        for (int i = t->pages[k].pieces_count - 1; i >= 0; i--)
            if (is_head(t->pages[k].pieces[i].paragraph))
                return t->pages[k].pieces[i].paragraph;
    return NULL;
}

bool running_text(const struct page_text *t, int page, const struct page_running *running,
                  char **text, size_t *bytes)
{
    const struct page *on = &t->pages[page];
    *text = NULL;
    *bytes = 0;
    if (running->not_opening &&
        (page == 0 || (on->pieces_count && is_head(on->pieces[0].paragraph))))
        return true;
    FILE *f = open_memstream(text, bytes);
    if (!f)
        return false;
    for (const char *at = running->text; *at; at++) {
        const struct paragraph *head;
        if (*at != '%' || !at[1] || !strchr("ph%", at[1])) {
            fputc(*at, f);
        } else if (*++at == 'p') {
            fprintf(f, "%d", page + 1);
        } else if (*at == '%') {
            fputc('%', f);
        } else if ((head = head_of(t, page)) != NULL) {
            for (int i = 0; i < head->bytes; i++) /* in one line */
                fputc(head->text[i] == '\n' ? ' ' : head->text[i], f);
        }
    }
    return fclose(f) == 0;
}
