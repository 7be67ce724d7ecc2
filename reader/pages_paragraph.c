/* pages_paragraph.c - paragraphs of the text: see pages_internal.h. */
#include "pages_internal.h"

#include <string.h>

enum reader_status pages_paragraph_put(struct reader_pages *p, const char *text, size_t bytes,
                                       int style, const struct page_manner *manner, int *id)
{
    struct page_manner own = *manner;
    own.below = p->below;
    if (p->made) { /* each passage is a column of its own */
        const int template = p->wide < 0 ? 0 : p->wide_templates[p->wide];
        const bool first = p->made->count == 0, paged = p->templates_count > 1;
        own.begins_column = first && !paged;
        own.begins_page = first && paged ? template + 1 : 0;
        own.keep_with_next = paged && p->wide < 0 && manner->keep_with_next;
        if (first) {
            p->made->before_px = manner->before_px;
            p->made->manner = own;
        }
        p->made->after_px = manner->after_px;
    }
    if (page_paragraph_add(p->text, 0, p->at, text, bytes, style, &own, id) != FONT_OK)
        return pages_failed();
    if (p->made && !p->made->count)
        p->made->first = *id;
    p->at += p->made != NULL;
    return p->placed(p, *id);
}

enum reader_status pages_inset_put(struct reader_pages *p, const char *text, int plain,
                                   int style, const struct page_manner *manner)
{
    struct paragraph_text none = {0};
    const size_t bytes = strlen(text);
    int id;
    enum reader_status status = pages_paragraph_put(p, text, bytes, plain, manner, &id);
    if (status == READER_OK &&
        page_paragraph_style(p->text, id, 0, (int)bytes, style) != FONT_OK)
        status = pages_failed();
    if (status == READER_OK)
        status = pages_made_keep(p, id, -1, &none);
    p->insets++;
    return status;
}

enum reader_status pages_paragraph_add(struct reader_pages *p, struct paragraph_text *t,
                                       enum context context, const struct page_manner *manner,
                                       bool display)
{
    int style, id;
    const double most = pages_column(p) - manner->left_px - manner->right_px;
    enum reader_status status = pages_style(p, context, 0, &style);
    if (status == READER_OK)
        status = pages_paragraph_put(p, t->text ? t->text : "", (size_t)t->bytes, style, manner,
                                     &id);
    if (status == READER_OK)
        status = pages_styles_apply(p, id, t, context, display, most);
    if (status == READER_OK)
        status = pages_notes_add(p, id, t, -1);
    return status == READER_OK ? pages_made_keep(p, id, -1, t) : status;
}
