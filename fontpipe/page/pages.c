/* pages.c - which pages are to be filled: see page_internal.h.
 *
 * A page is what its starts give, the ends of the page before it, and the paragraphs that it
 * looks at: those between its starts and its ends, and a few behind them. So it is filled again
 * where its starts are others, where one of those paragraphs has changed, and where another
 * page has broken one of them anew: a paragraph has one set of lines, whichever page asked
 * last. */
#include "page_internal.h"

#include <string.h>

/* Pages that looked at number `at` of a flow are to be filled anew; all_behind: those that
 * looked at any behind it, too. */
static void pages_forget(struct page_text *t, int flow, int at, bool all_behind)
{
    for (int k = 0; k < t->pages_count; k++) {
        struct page *page = &t->pages[k];
        if (!page->filled || page->ends[flow].at + FLOW_CHAIN_MAX < at ||
            (!all_behind && page->starts[flow].at > at))
            continue;
        page->filled = false;
        t->pages_good = k < t->pages_good ? k : t->pages_good;
    }
}

void flow_changed(struct page_text *t, const struct paragraph *p)
{
    if (p->flow < 0 && p->owner >= 0 && t->by_id[p->owner])
        p = t->by_id[p->owner];
    if (p->flow >= 0)
        pages_forget(t, p->flow, p->at, false);
}

void flow_moved(struct page_text *t, int flow, int at)
{
    pages_forget(t, flow, at, true);
}

void flow_changed_all(struct page_text *t)
{
    for (int k = 0; k < t->pages_count; k++)
        t->pages[k].filled = false;
    t->pages_good = 0;
}

static bool cursors_same(const struct cursor *a, const struct cursor *b)
{
    for (int i = 0; i < FLOWS_MAX; i++)
        if (a[i].at != b[i].at || a[i].line != b[i].line || a[i].letter != b[i].letter)
            return false;
    return true;
}

static const struct cursor *page_starts(const struct page_text *t, int number)
{
    static const struct cursor first[FLOWS_MAX];
    return number > 0 ? t->pages[number - 1].ends : first;
}

/* Whether it is still what it would be if it were filled now. */
static bool page_holds(const struct page_text *t, int number)
{
    const struct page *page = &t->pages[number];
    if (!page->filled || !cursors_same(page->starts, page_starts(t, number)))
        return false;
    for (int i = 0; i < page->pieces_count; i++) {
        struct piece *piece = &page->pieces[i];
        const struct paragraph *p = piece->paragraph;
        if (piece->breakings == p->breakings)
            continue;
        if (piece->end > p->lines_count ||
            flow_lines_hash(p, piece->begin, piece->end) != piece->lines_hash)
            return false;
        piece->breakings = p->breakings;
    }
    return true;
}

static enum font_status page_fill(struct page_text *t, int number)
{
    struct page *page = &t->pages[number];
    struct cursor ends[FLOWS_MAX];
    memcpy(page->starts, page_starts(t, number), sizeof page->starts);
    memcpy(ends, page->starts, sizeof ends);
    page->filled = false;
    t->last_filled = -1;
    enum font_status status = flow_frames_fill(t, page, number, ends);
    if (status != FONT_OK)
        return status;
    bool over = true;
    for (int i = 0; i < FLOWS_MAX; i++)
        over = over && ends[i].at >= t->flows[i].count;
    memcpy(page->ends, ends, sizeof ends);
    /* A page on which nothing fits is followed by others like it: it is the last. */
    page->last = over || (number >= t->templates_count - 1 && cursors_same(page->starts, ends));
    page->filled = true;
    t->last_filled = number;
    t->stats.pages_filled++;
    return FONT_OK;
}

/* The page to begin at, so that this one can be filled. What goes on from page to page may be
 * broken anew on each of them, for what is left of it, where lines differ: then it is done
 * again from the page on which it begins, so that it never matters what was looked at
 * before. */
static int page_begin(const struct page_text *t, int number)
{
    if (t->last_filled == number - 1)
        return number;
    const struct cursor *starts = page_starts(t, number);
    for (int i = 0; number > 0 && i < FLOWS_MAX; i++) {
        double width;
        if (starts[i].line && !flow_uniform(t, i, &width)) {
            starts = page_starts(t, --number);
            i = -1;
        }
    }
    return number;
}

enum font_status flow_fill(struct page_text *t, int number)
{
    if (number < 0 || number >= PAGES_MAX || !t->templates_count)
        return font_fail(FONT_BAD_ARGUMENT,
                         t->templates_count ? "there is no page %d"
                                            : "there is no template for page %d",
                         number + 1);
    while (t->pages_good <= number) {
        int next = t->pages_good;
        if (next > 0 && t->pages[next - 1].last)
            return font_fail(FONT_BAD_ARGUMENT, "there is no page %d: the text has %d",
                             number + 1, next);
        if (next >= t->pages_count) {
            if (!array_reserve(&t->pages, &t->pages_capacity, next + 1, sizeof *t->pages))
                return font_fail(FONT_NO_MEMORY, "no memory for pages");
            t->pages[t->pages_count++] = (struct page){0};
        }
        if (!page_holds(t, next)) {
            int begin = page_begin(t, next);
            if (begin < next) {
                for (int k = begin; k < next; k++)
                    t->pages[k].filled = false;
                t->pages_good = begin;
                continue;
            }
            enum font_status status = page_fill(t, next);
            if (status != FONT_OK)
                return status;
        }
        t->pages_good = next + 1;
    }
    return FONT_OK;
}
