/* marks.c - places that stay at their letters: see page.h. Paragraphs hold them and move them
 * when they change. */
#include "page_internal.h"

enum font_status page_mark_add(struct page_text *t, struct page_place place, bool after,
                               int *mark)
{
    struct paragraph *p = story_paragraph(t, place.paragraph);
    *mark = -1;
    if (!p || place.byte < 0 || place.byte > p->bytes)
        return font_fail(FONT_BAD_ARGUMENT, "there is no byte %d of a paragraph %d", place.byte,
                         place.paragraph);
    if (!array_reserve(&t->marks_of, &t->marks_capacity, t->marks_count + 1,
                       sizeof *t->marks_of) ||
        !array_reserve(&p->marks, &p->marks_capacity, p->marks_count + 1, sizeof *p->marks))
        return font_fail(FONT_NO_MEMORY, "no memory for a mark");
    p->marks[p->marks_count++] = (struct mark){t->marks_count, place.byte, after};
    t->marks_of[t->marks_count] = p->id;
    *mark = t->marks_count++;
    return FONT_OK;
}

bool page_mark_get(const struct page_text *t, int mark, struct page_place *place)
{
    if (mark < 0 || mark >= t->marks_count || t->marks_of[mark] < 0)
        return false;
    const struct paragraph *p = t->by_id[t->marks_of[mark]];
    for (int i = 0; i < p->marks_count; i++)
        if (p->marks[i].id == mark) {
            *place = (struct page_place){p->id, p->marks[i].byte};
            return true;
        }
    return false;
}
