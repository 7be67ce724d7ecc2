/* html.c - see reader_html.h. */
#include "html_internal.h"

#include "reader_colours.h"

#include <stdlib.h>
#include <string.h>

/* ---- the style ---- */

static const char style_begin[] =
    "html{background:var(--paper);color:var(--ink);line-height:1.4}\n"
    "body{max-width:34rem;margin:2rem auto;padding:0 1rem;overflow-wrap:break-word}\n"
    "h1,h2,h3{line-height:1.2;text-wrap:balance}\n"
    "h1,h2{font-weight:normal}\n"
    "p{margin:.5em 0;hyphens:auto}\n"
    "a{color:var(--link)}\n"
    "s{color:var(--struck)}\n"
    "pre,code{font-family:'DejaVu Sans Mono',monospace;font-size:.82em}\n"
    "pre{overflow-x:auto;margin:.6em 1em}\n"
    "pre code{font-size:1em}\n"
    "ul,ol{list-style:none;margin:.3em 0;padding-left:1.5em}\n"
    ".marker{display:inline-block;min-width:1.2em;margin-left:-1.5em;padding-right:.3em}\n"
    "blockquote{margin:.4em 1.5em}\n"
    "figure{margin:1em 0;text-align:center}\n"
    "img{max-width:100%}\n"
    "img.among{vertical-align:baseline}\n"
    "figcaption{font-size:.92em}\n" HTML_BESIDE_STYLE ".math{text-align:center}\n"
    ".formula{filter:var(--formula)}\n"
    "caption{font-style:italic;text-align:left}\n"
    "table{border-collapse:collapse;font-size:.92em;margin:.6em 0}\n"
    "td,th{padding:.1em .6em;vertical-align:top;border-top:1px solid var(--struck)}\n"
    "sup,sub{line-height:0}\n"
    "sup a,.sign{text-decoration:none}\n"
    "mark{background:var(--marked);color:inherit}\n"
    "mark.noted{background:var(--noted)}\n"
    "aside{font-size:.85em;margin:.5em 1.5em;padding-left:.6em;border-left:2px solid "
    "var(--struck)}\n"
    "aside>a:first-child{float:left;margin-right:.4em}\n"
    "aside p{margin:0 0 .3em}\n"
    "aside.remark{border-color:var(--link)}\n"
    ".typed{white-space:pre-wrap}\n"
    ".ink{display:inline-block;position:relative;width:0;height:0;vertical-align:text-top}\n"
    ".ink svg{position:absolute;width:1rem;height:1rem;overflow:visible;pointer-events:none}\n"
    ".around{position:relative;shape-margin:.5em}\n"
    ".around.l{float:left;clear:left}\n"
    ".around.r{float:right;clear:right}\n"
    ".around svg{position:absolute;width:1rem;height:1rem;overflow:visible;"
    "pointer-events:none;stroke-linecap:round;stroke-linejoin:round}\n"
    ".around.r svg{margin-left:100%}\n"
    ":has(.around)~:is(h1,h2,pre,table,hr,figure,.math){clear:both}\n"
    ".alone{display:block;stroke-linecap:round;stroke-linejoin:round}\n"
    ".ink{stroke-linecap:round;stroke-linejoin:round}\n"
    "@media(min-width:64rem){aside.remark,aside.margin{float:right;clear:right;width:11rem;"
    "margin:0 -13.5rem .5rem 0}}\n"
    "@media print{.ink svg{print-color-adjust:exact}mark{print-color-adjust:exact}}\n";

static void colour_put(struct html *h, const char *name, const double rgb[3])
{
    char text[8];
    reader_colour_text(rgb, text);
    fprintf(h->f, "--%s:%s;", name, text);
}

static void theme_put(struct html *h, bool dark)
{
    const struct reader_template *t = h->setup->template;
    const struct reader_colours *c = t ? &t->colours[dark] : reader_colours_of(dark);
    fputs(":root{", h->f);
    colour_put(h, "paper", c->paper);
    colour_put(h, "ink", c->ink);
    colour_put(h, "link", c->link);
    colour_put(h, "struck", c->struck);
    colour_put(h, "marked", c->marked);
    colour_put(h, "noted", c->noted);
    /* formulas are black pictures */
    fprintf(h->f, "--formula:%s;color-scheme:%s}\n", dark ? "invert(.85)" : "none",
            dark ? "dark" : "light");
}

/* What a template says of letters, and of the column. */
static void template_put(struct html *h)
{
    static const char *const of_size[READER_SIZES] = {"h1",    "h2",       "h3,h4,h5,h6",
                                                      "aside", "pre,code", "table"};
    const struct reader_template *t = h->setup->template;
    if (!t)
        return;
    if (reader_template_text_em(t) > 0) /* else it takes what there is */
        fprintf(h->f, "body{max-width:%.4grem}\n", reader_template_text_em(t));
    for (int i = 0; i < READER_SIZES; i++)
        if (t->sizes[i] > 0)
            fprintf(h->f, "%s{font-size:%.4gem}\n", of_size[i], t->sizes[i]);
    if (t->sizes[READER_SIZE_CODE] > 0) /* it is in another that has the size */
        fputs("pre code{font-size:1em}\n", h->f);
}

static void style_put(struct html *h)
{
    const enum reader_html_theme theme = h->setup->theme;
    fputs("<style>\n", h->f);
    theme_put(h, theme == READER_HTML_DARK);
    if (theme == READER_HTML_BOTH) {
        fputs("@media(prefers-color-scheme:dark){", h->f);
        theme_put(h, true);
        fputs("}\n", h->f);
    }
    fputs("html{font-family:", h->f);
    for (const char *c = h->setup->font ? h->setup->font : ""; *c; c++) {
        if (c == h->setup->font)
            fputs("'", h->f);
        if (strchr("'\\<>", *c) == NULL && (unsigned char)*c >= 0x20)
            fputc(*c, h->f); /* a style has no names for letters */
        if (!c[1])
            fputs("',", h->f);
    }
    fputs("'EB Garamond','EB Garamond 12',Georgia,serif", h->f);
    if (h->setup->size_px > 0)
        fprintf(h->f, ";font-size:%gpx", h->setup->size_px);
    fputs("}\n", h->f);
    fputs(style_begin, h->f);
    template_put(h);
    fputs("</style>\n", h->f);
}

static void title_put(struct html *h)
{
    const struct reader_document *d = h->document;
    const struct reader_block *heading = NULL;
    for (int i = 0; i < d->blocks_count && !heading; i++)
        heading = d->blocks[i].kind == READER_HEADING ? &d->blocks[i] : NULL;
    fputs("<title>", h->f);
    if (h->setup->title)
        html_puts(h, h->setup->title);
    else if (heading)
        html_put(h, heading->text, (size_t)heading->bytes);
    fputs("</title>\n", h->f);
}

static void head_put(struct html *h)
{
    fputs("<!DOCTYPE html>\n<html", h->f);
    if (h->setup->language) {
        fputs(" lang=\"", h->f);
        html_puts(h, h->setup->language);
        fputs("\"", h->f);
    }
    fputs(">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
          "img-src data:; style-src 'unsafe-inline'\">\n",
          h->f);
    title_put(h);
    style_put(h);
    fputs("</head>\n<body>\n", h->f);
}

/* ---- lists and quotes ---- */

static void quotes_to(struct html *h, int quotes)
{
    for (; h->nest.quotes > quotes; h->nest.quotes--)
        fputs("</blockquote>\n", h->f);
    for (; h->nest.quotes < quotes; h->nest.quotes++)
        fputs("<blockquote>\n", h->f);
}

static void lists_to(struct html *h, int depth)
{
    while (h->nest.count > depth)
        fputs(h->nest.numbered[--h->nest.count] ? "</li></ol>\n" : "</li></ul>\n", h->f);
}

/* Opens what a block stands in, and closes what it does not. */
static void nest(struct html *h, const struct reader_block *block)
{
    const int items = block->items < READER_DEPTH_MAX ? block->items : READER_DEPTH_MAX,
              quotes = block->quotes < READER_DEPTH_MAX ? block->quotes : READER_DEPTH_MAX;
    const bool numbered = block->marker && block->marker[0] >= '0' && block->marker[0] <= '9';
    if (items != h->nest.count || block->marker || quotes < h->nest.quotes)
        quotes_to(h, 0);
    lists_to(h, items);
    if (block->marker && items && h->nest.count == items) {
        if (h->nest.numbered[items - 1] == numbered)
            fputs("</li>\n<li>", h->f);
        else
            lists_to(h, items - 1);
    }
    while (h->nest.count < items) {
        fputs(numbered ? "<ol><li>" : "<ul><li>", h->f);
        h->nest.numbered[h->nest.count++] = numbered;
    }
    quotes_to(h, quotes);
}

/* ---- blocks ---- */

/* What links call it. */
static void name_put(struct html *h, const struct reader_block *block)
{
    const struct reader_document *d = h->document;
    if (block < d->blocks || block >= d->blocks + d->blocks_count)
        return;
    fprintf(h->f, " id=\"b.%d\"", (int)(block - d->blocks));
}

/* Where its lines stand, if the document says so. */
static void align_put(struct html *h, const struct reader_block *block)
{
    static const char *const names[] = {"", "left", "center", "right"};
    if (block->align != READER_ALIGN_USUAL)
        fprintf(h->f, " style=\"text-align:%s\"", names[block->align]);
}

static void marker_put(struct html *h, const struct reader_block *block)
{
    if (!block->marker)
        return;
    fputs("<span class=\"marker\">", h->f);
    html_puts(h, block->marker);
    fputs("</span>", h->f);
}

static void whole_put(struct html *h, const struct reader_block *block)
{
    html_block_text(h, block, 0, block->bytes);
    html_events_put(h, block, block->bytes);
}

static void simple_put(struct html *h, const struct reader_block *block, const char *tag)
{
    fprintf(h->f, "<%s", tag);
    name_put(h, block);
    align_put(h, block);
    fputs(">", h->f);
    html_around_put(h, block);
    marker_put(h, block);
    whole_put(h, block);
    fprintf(h->f, "</%s>\n", tag);
}

static void code_put(struct html *h, const struct reader_block *block)
{
    fputs("<pre", h->f);
    name_put(h, block);
    fputs("><code>", h->f);
    marker_put(h, block);
    whole_put(h, block);
    fputs("</code></pre>\n", h->f);
}

static void math_put(struct html *h, const struct reader_block *block)
{
    fputs("<div class=\"math\"", h->f);
    name_put(h, block);
    fputs(">", h->f);
    marker_put(h, block);
    html_events_put(h, block, 0);
    if (!html_formula_put(h, block->text, block->bytes, true)) {
        fputs("<code>", h->f);
        html_put(h, block->text, (size_t)block->bytes);
        fputs("</code>", h->f);
    }
    if (block->number)
        fprintf(h->f, "\xe2\x80\x83(%d)", block->number);
    html_events_put(h, block, block->bytes);
    fputs("</div>\n", h->f);
}

static void picture_put(struct html *h, const struct reader_block *block)
{
    const bool beside = html_beside_put(h, block);
    if (!beside) {
        fputs("<figure", h->f);
        name_put(h, block);
        align_put(h, block);
    }
    fputs(">", h->f);
    const bool found = html_picture_put(h, block);
    fputs("<figcaption", h->f);
    if (beside) /* such a figure has no box of its own */
        name_put(h, block);
    fputs(">", h->f);
    marker_put(h, block);
    whole_put(h, block);
    if (!found && block->target) {
        fputs(" <code>[", h->f);
        html_puts(h, block->target);
        fputs("]</code>", h->f);
    }
    fputs("</figcaption></figure>\n", h->f);
}

static void row_put(struct html *h, const struct reader_block *row)
{
    static const char *const aligns[] = {"", " style=\"text-align:center\"",
                                         " style=\"text-align:right\""};
    const char *tag = row->head ? "th" : "td";
    fputs("<tr", h->f);
    name_put(h, row);
    fputs(">", h->f);
    for (int at = 0, column = 0; at <= row->bytes; column++) {
        const char *tab = memchr(row->text + at, '\t', (size_t)(row->bytes - at));
        const int end = tab ? (int)(tab - row->text) : row->bytes;
        const char align =
            column < row->columns && column < READER_COLUMNS_MAX ? row->aligns[column] : 'l';
        fprintf(h->f, "<%s%s>", tag, aligns[align == 'c' ? 1 : align == 'r' ? 2 : 0]);
        html_block_text(h, row, at, end);
        html_events_put(h, row, end);
        fprintf(h->f, "</%s>", tag);
        at = end + 1;
    }
    fputs("</tr>\n", h->f);
}

static void block_put(struct html *h, const struct reader_block *block)
{
    static const char *const headings[] = {"h1", "h2", "h3", "h4", "h5", "h6"};
    html_events_begin(h, block);
    switch (block->kind) {
    case READER_PARAGRAPH:
        simple_put(h, block, "p");
        break;
    case READER_HEADING:
        simple_put(h, block,
                   headings[block->level < 1   ? 0
                            : block->level > 6 ? 5
                                               : block->level - 1]);
        break;
    case READER_CODE_BLOCK:
    case READER_LIVE:
    case READER_HTML:
        code_put(h, block);
        break;
    case READER_MATH:
        math_put(h, block);
        break;
    case READER_RULE:
        fputs("<hr", h->f);
        name_put(h, block);
        fputs(">\n", h->f);
        html_events_put(h, block, block->bytes);
        break;
    case READER_ROW:
        row_put(h, block);
        break;
    case READER_PICTURE:
        picture_put(h, block);
        break;
    }
}

/* ---- notes ---- */

static void blocks_put(struct html *h, const struct reader_block *blocks, int count,
                       bool margin);

static void note_put(struct html *h, int note, const char *class)
{
    const struct reader_note *n = &h->document->notes[note];
    h->noted[note] = true;
    fprintf(h->f, "<aside class=\"%s\" id=\"n.%d\"><a href=\"#c.%d\">%d</a>\n", class, note + 1,
            note + 1, note + 1);
    blocks_put(h, h->document->note_blocks + n->first_block, n->blocks_count, false);
    fputs("</aside>\n", h->f);
}

/* Those of the margin that a block calls first. */
static void margin_put(struct html *h, const struct reader_block *block)
{
    for (int i = 0; i < block->spans_count; i++) {
        const struct reader_span *s = &block->spans[i];
        if (s->look & READER_NOTE && s->note >= 0 && !h->noted[s->note] &&
            strcmp(h->document->notes[s->note].class, "margin") == 0)
            note_put(h, s->note, "margin");
    }
}

static void blocks_put(struct html *h, const struct reader_block *blocks, int count,
                       bool margin)
{
    const struct html_nest around = h->nest;
    h->nest = (struct html_nest){0};
    for (int i = 0; i < count; i++) {
        const struct reader_block *block = &blocks[i];
        const bool row = block->kind == READER_ROW,
                   first = row && (i == 0 || block[-1].kind != READER_ROW ||
                                   block[-1].table != block->table),
                   last = row && (i + 1 == count || block[1].kind != READER_ROW ||
                                  block[1].table != block->table);
        if (!row || first)
            nest(h, block);
        fputs(first ? "<table>\n" : "", h->f);
        if (first && block->number)
            fprintf(h->f, "<caption>Table %d</caption>\n", block->number);
        block_put(h, block);
        fputs(last ? "</table>\n" : "", h->f);
        if (!row || last)
            html_asides_put(h);
        for (int k = i; margin && last && k >= 0 && blocks[k].kind == READER_ROW &&
                        blocks[k].table == block->table;
             k--)
            margin_put(h, &blocks[k]);
        if (margin && !row)
            margin_put(h, block);
    }
    quotes_to(h, 0);
    lists_to(h, 0);
    h->nest = around;
}

static void notes_put(struct html *h)
{
    const struct reader_document *d = h->document;
    bool any = false;
    for (int i = 0; i < d->notes_count; i++) {
        if (h->noted[i])
            continue;
        if (!any)
            fputs("<section class=\"notes\">\n<hr>\n", h->f);
        any = true;
        note_put(h, i, "note");
    }
    if (any)
        fputs("</section>\n", h->f);
}

/* ---- the file ---- */

static void document_put(struct html *h)
{
    head_put(h);
    blocks_put(h, h->document->blocks, h->document->blocks_count, true);
    notes_put(h);
    html_orphans_put(h);
    fputs("</body>\n</html>\n", h->f);
}

enum reader_status reader_html_write(const struct reader_document *document,
                                     const struct reader_html_setup *setup, FILE *file)
{
    struct html h = {.document = document, .setup = setup, .f = file};
    if (!document->plain)
        return reader_fail(READER_BAD_ARGUMENT, "the document's plain text is not made");
    h.noted = calloc((size_t)document->notes_count + 1, sizeof *h.noted);
    h.called = calloc((size_t)document->notes_count + 1, sizeof *h.called);
    h.status = h.noted && h.called ? html_remarks_begin(&h)
                                   : reader_fail(READER_NO_MEMORY, "no memory for a document");
    if (h.status == READER_OK)
        h.status = html_around_begin(&h);
    if (h.status == READER_OK)
        document_put(&h);
    html_picture_finish(&h);
    free(h.obstacles);
    free(h.events);
    free(h.waiting);
    free(h.noted);
    free(h.called);
    return h.status;
}
