/* html_text.c - letters of a block as HTML: see html_internal.h. */
#include "html_internal.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <text.h>

/* ---- links ---- */

/* The first block of a file; -1: it has none. */
static int source_begin(const struct reader_document *d, int source)
{
    for (int i = 0; i < d->blocks_count; i++)
        if (d->blocks[i].source == source)
            return i;
    return -1;
}

/* The block of the document that a link leads to; -1: it leads out of it. */
static int link_block(const struct html *h, const char *target, int source)
{
    const struct reader_document *d = h->document;
    const char *mark = strchr(target, '#');
    int to = source;
    if (target != mark) {
        to = strchr(target, ':') || *target == '/' || !*target
                 ? -1
                 : reader_files_source(h->setup->files, source, target,
                                       mark ? (size_t)(mark - target) : strlen(target));
        if (to < 0)
            return -1;
    }
    const struct reader_block *block = mark ? reader_document_label(d, mark + 1, to) : NULL;
    if (!block && mark && target == mark)
        block = reader_document_label(d, mark + 1, -1);
    if (block && reader_document_note(d, block) < 0)
        return (int)(block - d->blocks);
    return target == mark ? -1 : source_begin(d, to);
}

/* The note that a link leads to; -1: it leads elsewhere. */
static int link_note(const struct html *h, const char *target, int source)
{
    const struct reader_block *place =
        reader_place_find(h->document, h->setup->files, target, source);
    return place ? reader_document_note(h->document, place) : -1;
}

/* Whether a browser would read it as another address than it looks like: it leaves out control
 * characters, and blanks at the beginning. */
static bool is_disguised(const char *target)
{
    const char *at = target, *const end = target + strlen(target);
    if (*target == ' ')
        return true;
    while (at < end) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        if (c < 0x20 || (c >= 0x7f && c < 0xa0))
            return true;
    }
    return false;
}

/* Whether a browser may follow it: nothing that runs, and no file by its whole path. */
static bool is_followed(const char *target)
{
    if (is_disguised(target))
        return false;
    return strncmp(target, "https://", 8) == 0 || strncmp(target, "http://", 7) == 0 ||
           strncmp(target, "mailto:", 7) == 0 ||
           (*target && *target != '/' && *target != '\\' && *target != '#' &&
            !strchr(target, ':'));
}

static bool link_begin(struct html *h, const struct reader_block *block,
                       const struct reader_span *span)
{
    const int note = span->target ? link_note(h, span->target, block->source) : -1,
              to = span->target ? link_block(h, span->target, block->source) : -1;
    if (note >= 0) {
        fprintf(h->f, "<a href=\"#n.%d\">", note + 1);
    } else if (to >= 0) {
        fprintf(h->f, "<a href=\"#b.%d\">", to);
    } else if (span->target && is_followed(span->target)) {
        fputs("<a href=\"", h->f);
        html_puts(h, span->target);
        fputs("\">", h->f);
    } else {
        return false;
    }
    return true;
}

/* ---- looks ---- */

static const struct {
    unsigned look;
    const char *begin, *end;
} tags[] = {{READER_HEAVY, "<strong>", "</strong>"}, {READER_SLANTED, "<em>", "</em>"},
            {READER_STRUCK, "<s>", "</s>"},          {READER_RAISED, "<sup>", "</sup>"},
            {READER_LOWERED, "<sub>", "</sub>"},     {READER_CODE, "<code>", "</code>"}};
enum { TAGS = sizeof tags / sizeof *tags };

static void note_call(struct html *h, const struct reader_span *span, const char *text)
{
    const bool first = span->note >= 0 && !h->called[span->note];
    fputs("<sup>", h->f);
    if (span->note >= 0) {
        h->called[span->note] = true;
        fprintf(h->f, "<a href=\"#n.%d\"", span->note + 1);
        if (first)
            fprintf(h->f, " id=\"c.%d\"", span->note + 1);
        fputs(">", h->f);
    }
    html_put(h, text + span->begin, (size_t)(span->end - span->begin));
    fputs(span->note >= 0 ? "</a></sup>" : "</sup>", h->f);
}

/* Lines that end in a text end in a browser, too; those of code do without a tag. */
static void lines_put(struct html *h, const char *text, int bytes, bool in_code)
{
    const char *const end = text + bytes;
    for (const char *next; !in_code && (next = memchr(text, '\n', (size_t)(end - text)));
         text = next + 1) {
        html_put(h, text, (size_t)(next - text));
        fputs("<br>\n", h->f);
    }
    html_put(h, text, (size_t)(end - text));
}

/* Letters of one span, all marked or none. */
static void piece_put(struct html *h, const struct reader_block *block,
                      const struct reader_span *span, int from, int to)
{
    const char *text = block->text;
    const bool marked = h->marks || h->typed;
    const bool in_code = block->kind == READER_CODE_BLOCK || block->kind == READER_LIVE ||
                         block->kind == READER_HTML;
    const unsigned look = (span ? span->look : 0) & ~(in_code ? (unsigned)READER_CODE : 0);
    bool linked = false;
    if (marked)
        fputs(h->typed ? "<mark class=\"noted\">" : "<mark>", h->f);
    if (look & READER_NOTE) {
        note_call(h, span, text);
    } else if (look & READER_IMAGE && html_image_put(h, block, span)) {
        linked = false; /* all of it is seen */
    } else {
        linked = look & READER_LINK && link_begin(h, block, span);
        for (int i = 0; i < TAGS; i++)
            if (look & tags[i].look)
                fputs(tags[i].begin, h->f);
        if (!(look & READER_FORMULA) || !html_formula_put(h, text + from, to - from, false))
            lines_put(h, text + from, to - from, in_code);
        for (int i = TAGS - 1; i >= 0; i--)
            if (look & tags[i].look)
                fputs(tags[i].end, h->f);
    }
    fputs(linked ? "</a>" : "", h->f);
    fputs(marked ? "</mark>" : "", h->f);
}

void html_block_text(struct html *h, const struct reader_block *block, int from, int to)
{
    const unsigned whole = READER_NOTE | READER_FORMULA | READER_IMAGE;
    int k = 0;
    for (int at = from; at < to;) {
        html_events_put(h, block, at);
        while (k < block->spans_count && block->spans[k].end <= at)
            k++;
        const struct reader_span *span =
            k < block->spans_count && block->spans[k].begin <= at ? &block->spans[k] : NULL;
        int end = k < block->spans_count ? (span ? span->end : block->spans[k].begin) : to;
        end = end < to ? end : to;
        if (!span || !(span->look & whole))
            end = html_event_next(h, block, end);
        while (end < to && ((unsigned char)block->text[end] & 0xc0) == 0x80)
            end++; /* what begins within a letter begins behind it */
        piece_put(h, block, span, at, end);
        at = end;
    }
}
