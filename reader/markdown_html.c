/* markdown_html.c - HTML in Markdown: tags that mean what can be shown are read so, others
 * stand as they are written. See markdown_internal.h.
 *
 * Tags of blocks that are open over several blocks (<div align="center">, <details>) put what
 * is between them in its place; <details> is an item of a list whose sign is a triangle, and
 * what is in it is open. What has no meaning that can be shown (<script>, <video>)
 * makes the block of lines that it is in be shown as it is written. Nothing is run, nothing
 * fetched. */
#include "markdown_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char summary_sign[] = "\xe2\x96\xbe";

/* ---- looks ---- */

static int *look_count(struct html_tags *h, unsigned look)
{
    return look == READER_HEAVY     ? &h->heavy
           : look == READER_SLANTED ? &h->slanted
           : look == READER_STRUCK  ? &h->struck
           : look == READER_CODE    ? &h->code
           : look == READER_RAISED  ? &h->raised
                                    : &h->lowered;
}

static void look_turn(struct walk *w, const struct tag *tag)
{
    int *count = look_count(&w->html, tag->look);
    *count += tag->closing ? -1 : 1;
    *count = *count < 0 ? 0 : *count;
}

void html_looks_end(struct walk *w)
{
    struct html_tags *h = &w->html;
    h->heavy = h->slanted = h->struck = h->code = h->raised = h->lowered = 0;
    free(h->link);
    h->link = NULL;
}

/* ---- links and labels ---- */

/* A name that links may lead to. */
static void label_read(struct walk *w, const struct tag *tag)
{
    const struct reader_document *d = w->b.document;
    char *name = tag_attribute(tag, "id");
    if (!name && tag->kind == TAG_LINK)
        name = tag_attribute(tag, "name");
    const size_t bytes = name ? strlen(name) : 0;
    if (bytes >= 1 && bytes <= READER_LABEL_BYTES && !strpbrk(name, " \t\n\"'<>=`#") &&
        d->labels_count + d->note_labels_count < READER_LABELS_MAX)
        reader_label_set(&w->b, name, bytes);
    free(name);
}

static void link_turn(struct walk *w, const struct tag *tag)
{
    free(w->html.link);
    w->html.link = tag->closing ? NULL : tag_attribute(tag, "href");
}

/* ---- pictures ---- */

/* Text flows around a picture at a side. */
static struct reader_beside beside_of(const struct tag *tag)
{
    enum { LEAST = 10, MOST = 90 };
    const enum reader_align align = tag_align(tag);
    const int percent = tag_asked(tag).percent;
    return (struct reader_beside){
        .side = align == READER_ALIGN_LEFT    ? READER_SIDE_LEFT
                : align == READER_ALIGN_RIGHT ? READER_SIDE_RIGHT
                                              : READER_SIDE_USUAL,
        .percent =
            align != READER_ALIGN_CENTER && percent >= LEAST && percent <= MOST ? percent : 0};
}

/* A block of its own. */
static void picture_block(struct walk *w, const struct tag *tag, const char *target,
                          const char *caption, int line)
{
    reader_block_open(&w->b, READER_PICTURE, line, line);
    w->b.block.target = walk_copy(w, target);
    w->b.block.beside = beside_of(tag);
    if (w->b.block.beside.side == READER_SIDE_USUAL)
        w->b.block.beside.percent = 0;
    w->b.block.asked = tag_asked(tag);
    if (w->b.block.beside.percent) /* which says it already */
        w->b.block.asked.percent = 0;
    reader_text_add(&w->b, caption, walk_look(w) | READER_SLANTED, walk_link(w));
    reader_block_close(&w->b);
}

static void picture_among(struct walk *w, const struct tag *tag, const char *target,
                          const char *caption)
{
    const char *slash = strrchr(target, '/'), *says = *caption            ? caption
                                                      : slash && slash[1] ? slash + 1
                                                                          : target;
    const unsigned look = walk_look(w) | READER_SLANTED | READER_LINK;
    walk_ends_add(w);
    if (picture_may_be_shown(target) && !strstr(says, READER_MASK_SIGN))
        reader_image_add(&w->b, says, look, target, tag_asked(tag));
    else
        reader_text_add(&w->b, says, look, walk_link(w) ? walk_link(w) : target);
}

/* alone: nothing but pictures stands in its paragraph. */
static void picture_read(struct walk *w, const struct tag *tag, bool alone, int line)
{
    struct reader_block *block = &w->b.block;
    char *target = tag_attribute(tag, "src"), *caption = tag_attribute(tag, "alt");
    const char *says = caption ? caption : "";
    const bool shown = target && picture_may_be_shown(target),
               aside = shown && beside_of(tag).side != READER_SIDE_USUAL && !w->b.in_note,
               before = aside && w->b.open && !block->bytes && !block->marker &&
                        (block->kind == READER_PARAGRAPH || block->kind == READER_HEADING);
    if (target && !w->b.in_note && (alone || (aside && !w->b.open))) {
        picture_block(w, tag, target, says, line);
    } else if (target && before) {
        const enum reader_kind kind = block->kind;
        const int level = block->level, first_line = block->first_line,
                  last_line = block->last_line;
        reader_block_finish(block); /* it has nothing yet: the picture stands before it */
        w->b.open = false;
        picture_block(w, tag, target, says, line);
        reader_block_open(&w->b, kind, first_line, last_line);
        block->level = level;
    } else if (target && (shown || !caption || *caption)) { /* none: it says nothing */
        if (!w->b.open)
            reader_block_open(&w->b, READER_PARAGRAPH, line, line);
        picture_among(w, tag, target, says);
    }
    free(target);
    free(caption);
}

/* Whether there are only pictures from here to what ends their paragraph, and one of them can
 * be shown. */
static bool only_pictures(const char *text)
{
    bool shown = false;
    while (*text) {
        struct tag tag;
        text += strspn(text, " \t\r\n");
        if (!*text)
            break;
        if (!tag_read(text, &tag) || !tag.bytes)
            return false;
        if (tag_is_block(&tag))
            break;
        if (tag.kind == TAG_PICTURE) {
            char *target = tag_attribute(&tag, "src");
            shown = shown || picture_may_be_shown(target);
            free(target);
        }
        text += tag.bytes;
    }
    return shown;
}

bool html_is_pictures(cmark_node *paragraph)
{
    bool shown = false;
    for (cmark_node *child = cmark.node_first_child(paragraph); child;
         child = cmark.node_next(child)) {
        struct tag tag;
        const char *text = cmark.node_get_literal(child);
        if (cmark.node_get_type(child) == CMARK_NODE_SOFTBREAK ||
            (cmark.node_get_type(child) == CMARK_NODE_TEXT && !text[strspn(text, " ")]))
            continue;
        if (!walk_is_html(child) || !tag_read(text, &tag) || tag.kind == TAG_UNKNOWN ||
            tag_is_block(&tag))
            return false;
        shown = shown || only_pictures(text);
    }
    return shown;
}

/* ---- tags that hold blocks ---- */

static void close_one(struct walk *w)
{
    struct html_tags *h = &w->html;
    const struct html_open *open = &h->open[--h->opened];
    const bool list = open->kind == TAG_LIST || open->kind == TAG_DETAILS;
    if (list && w->b.marker) { /* it has nothing in it */
        reader_block_open(&w->b, READER_PARAGRAPH, h->line, h->line);
        reader_block_close(&w->b);
    }
    w->b.align = open->align;
    w->b.items -= list;
    w->b.quotes -= open->kind == TAG_QUOTE;
}

void html_close_to(struct walk *w, int opened)
{
    while (w->html.opened > opened)
        close_one(w);
}

void html_container_end(struct walk *w)
{
    struct html_tags *h = &w->html;
    while (h->opened && h->open[h->opened - 1].depth == h->depth)
        close_one(w);
    h->depth--;
}

/* Of that kind, with what is open in it. False: it is not open. */
static bool close_kind(struct walk *w, enum tag_kind kind)
{
    const struct html_tags *h = &w->html;
    int at = h->opened - 1;
    while (at >= 0 && h->open[at].kind != kind)
        at--;
    if (at >= 0)
        html_close_to(w, at);
    return at >= 0;
}

static void open_one(struct walk *w, const struct tag *tag)
{
    struct html_tags *h = &w->html;
    const enum reader_align align = tag_align(tag);
    if (h->opened == HTML_DEPTH)
        return;
    h->open[h->opened++] = (struct html_open){.kind = tag->kind,
                                              .level = tag->level,
                                              .align = w->b.align,
                                              .next = tag->level ? 1 : -1,
                                              .depth = h->depth};
    w->b.align = align != READER_ALIGN_USUAL ? align : w->b.align;
    w->b.items += tag->kind == TAG_LIST || tag->kind == TAG_DETAILS;
    w->b.quotes += tag->kind == TAG_QUOTE;
}

/* What it holds, whether its block is shown so or as it is written. */
static void holder_turn(struct walk *w, const struct tag *tag)
{
    const bool holds = tag->kind == TAG_DIVISION || tag->kind == TAG_CENTER ||
                       tag->kind == TAG_QUOTE || tag->kind == TAG_DETAILS ||
                       tag->kind == TAG_LIST || tag->kind == TAG_PARAGRAPH ||
                       tag->kind == TAG_HEADING;
    if (tag_is_block(tag)) /* a paragraph ends with the next block */
        close_kind(w, TAG_PARAGRAPH);
    if (holds && tag->closing)
        close_kind(w, tag->kind);
    else if (holds)
        open_one(w, tag);
}

static void item_sign(struct walk *w, int line)
{
    struct html_tags *h = &w->html;
    char marker[32] = "\xe2\x80\xa2";
    int at = h->opened - 1;
    while (at >= 0 && h->open[at].kind != TAG_LIST)
        at--;
    if (at < 0)
        return;
    if (h->open[at].next > 0)
        snprintf(marker, sizeof marker, "%ld.", h->open[at].next++);
    reader_marker_set(&w->b, marker, line);
}

/* ---- tables ---- */

/* All rows of a table have as many columns as the one that has most. */
static void table_end(struct walk *w)
{
    struct reader_document *d = w->b.document;
    struct reader_block *blocks = w->b.in_note ? d->note_blocks : d->blocks;
    const int count = w->b.in_note ? d->note_blocks_count : d->blocks_count;
    int columns = 0;
    for (int i = count - 1; i >= count - w->html.rows && i >= 0; i--)
        columns = blocks[i].columns > columns ? blocks[i].columns : columns;
    for (int i = count - 1; i >= count - w->html.rows && i >= 0; i--)
        blocks[i].columns = columns;
    w->html.rows = 0;
}

static void row_open(struct walk *w, int line)
{
    reader_block_open(&w->b, READER_ROW, line, line);
    w->b.block.table = w->b.document->tables_count - 1;
    memset(w->b.block.aligns, 'l', sizeof w->b.block.aligns);
    w->html.rows++;
    w->html.cells = 0;
}

static void cell_open(struct walk *w, const struct tag *tag, int line)
{
    struct html_tags *h = &w->html;
    struct reader_block *block = &w->b.block;
    const enum reader_align align = tag_align(tag);
    if (!w->b.open)
        row_open(w, line);
    if (h->cells++)
        reader_cell_end(&w->b);
    block->columns = h->cells;
    block->last_line = line;
    block->head = h->rows == 1 && tag->level && (h->cells == 1 || block->head);
    h->heavy = tag->level;
    h->in_cell = true;
    if (h->cells <= READER_COLUMNS_MAX)
        block->aligns[h->cells - 1] = align == READER_ALIGN_CENTER  ? 'c'
                                      : align == READER_ALIGN_RIGHT ? 'r'
                                                                    : 'l';
}

/* False: it is no tag of a table. */
static bool table_tag(struct walk *w, const struct tag *tag, int line)
{
    if (tag->kind != TAG_TABLE && tag->kind != TAG_ROW && tag->kind != TAG_CELL)
        return false;
    html_looks_end(w);
    w->ends = 0;
    if (w->html.in_cell)
        reader_blanks_drop(&w->b);
    w->html.in_cell = false;
    if (tag->kind != TAG_CELL)
        reader_block_close(&w->b);
    if (tag->kind == TAG_CELL && !tag->closing)
        cell_open(w, tag, line);
    else if (tag->kind == TAG_TABLE && tag->closing)
        table_end(w);
    else if (tag->kind == TAG_TABLE)
        w->b.document->tables_count++;
    if (!tag->closing)
        label_read(w, tag);
    return true;
}

/* Whether it is in its place: rows in a table, nothing but letters in cells. */
static bool table_is_meant(const struct tag *tag, bool *in_table)
{
    const bool is_table = tag->kind == TAG_TABLE,
               part = tag->kind == TAG_ROW || tag->kind == TAG_CELL,
               good = is_table ? *in_table == tag->closing : part == *in_table;
    if (is_table)
        *in_table = !tag->closing;
    return good || !tag_is_block(tag);
}

/* A tag that ends the paragraph before it. */
static void block_tag(struct walk *w, const struct tag *tag, int line)
{
    reader_block_close(&w->b);
    html_looks_end(w);
    w->ends = 0;
    holder_turn(w, tag);
    if (tag->closing)
        return;
    if (tag->kind == TAG_DETAILS)
        reader_marker_set(&w->b, summary_sign, line);
    if (tag->kind == TAG_ITEM)
        item_sign(w, line);
    if (tag->kind == TAG_SUMMARY)
        look_turn(w, tag);
    if (tag->kind == TAG_RULE) {
        reader_block_open(&w->b, READER_RULE, line, line);
        reader_block_close(&w->b);
    }
    label_read(w, tag);
}

/* ---- tags among letters ---- */

static void letter_tag(struct walk *w, const struct tag *tag, bool alone, int line)
{
    if (tag->kind == TAG_BREAK) {
        w->ends_look = w->ends++ ? w->ends_look : walk_look(w);
    } else if (tag->kind == TAG_PICTURE) {
        picture_read(w, tag, alone, line);
    } else if (tag->kind == TAG_LINK) {
        link_turn(w, tag);
        label_read(w, tag);
    } else if (tag->kind == TAG_LOOK) {
        look_turn(w, tag);
    }
}

void html_inline(struct walk *w, const char *text)
{
    struct tag tag;
    if (tag_read(text, &tag) && tag.kind != TAG_UNKNOWN && !tag_is_block(&tag)) {
        letter_tag(w, &tag, w->pictures > 0, w->pictures ? w->pictures : w->b.block.first_line);
        return;
    }
    if (w->pictures || (tag.closing && tag_is_block(&tag) && close_kind(w, tag.kind)))
        return;
    walk_ends_add(w);
    reader_text_add(&w->b, text, walk_look(w) | READER_CODE, NULL);
}

/* ---- blocks ---- */

/* Whether all of its tags have a meaning that can be shown. */
static bool is_meant(const char *text)
{
    struct tag tag;
    bool in_table = false;
    for (const char *at = text; (at = strchr(at, '<'));) {
        const bool read = tag_read(at, &tag);
        if (read && (tag.kind == TAG_UNKNOWN || !tag.bytes || !table_is_meant(&tag, &in_table)))
            return false;
        at += read ? tag.bytes : 1;
    }
    return !in_table;
}

static void written_put(struct walk *w, cmark_node *node, const char *text)
{
    struct tag tag;
    walk_block_open(w, READER_HTML, node);
    reader_code_add(&w->b, text, READER_CODE);
    if (w->b.status == READER_OK)
        walk_line_end_drop(&w->b.block);
    reader_block_close(&w->b);
    for (const char *at = text; (at = strchr(at, '<'));) {
        const bool read = tag_read(at, &tag) && tag.bytes;
        if (read && tag.kind != TAG_UNKNOWN)
            holder_turn(w, &tag);
        at += read ? tag.bytes : 1;
    }
}

static int lines_in(const char *text, int bytes)
{
    int lines = 0;
    for (int i = 0; i < bytes; i++)
        lines += text[i] == '\n';
    return lines;
}

/* Letters between tags: a paragraph's, or a heading's. */
static void letters_put(struct walk *w, const char *text, int bytes, int line)
{
    struct html_tags *h = &w->html;
    const struct html_open *in = h->opened ? &h->open[h->opened - 1] : NULL;
    char *copy = strndup(text, (size_t)bytes);
    if (!copy) {
        reader_builder_fail(&w->b);
        return;
    }
    tag_entities(copy);
    for (char *c = copy; *c; c++)
        *c = (unsigned char)*c < 0x20 ? ' ' : *c;
    const bool blank = copy[strspn(copy, " ")] == '\0', heading = in && in->kind == TAG_HEADING;
    if (!w->b.open && !blank) {
        const int first = line + lines_in(text, (int)strspn(text, " \t\r\n"));
        reader_block_open(&w->b, heading ? READER_HEADING : READER_PARAGRAPH, first, first);
        w->b.block.level = heading ? in->level : 0;
    }
    if (w->b.open && !(blank && w->ends)) {
        walk_ends_add(w);
        reader_text_add(&w->b, copy, walk_look(w), walk_link(w));
        if (!blank)
            w->b.block.last_line = line + lines_in(text, bytes);
    }
    free(copy);
}

/* A heading that begins with a tag among letters begins with it. */
static void heading_begin(struct walk *w, int line)
{
    const struct html_tags *h = &w->html;
    if (w->b.open || !h->opened || h->open[h->opened - 1].kind != TAG_HEADING)
        return;
    reader_block_open(&w->b, READER_HEADING, line, line);
    w->b.block.level = h->open[h->opened - 1].level;
}

void html_block(struct walk *w, cmark_node *node)
{
    const char *text = cmark.node_get_literal(node);
    int line = cmark.node_get_start_line(node);
    text = text ? text : "";
    w->html.line = line;
    if (!is_meant(text)) {
        written_put(w, node, text);
        return;
    }
    html_looks_end(w);
    w->ends = 0;
    for (const char *at = text; *at && w->b.status == READER_OK;) {
        struct tag tag;
        const bool is_tag = tag_read(at, &tag);
        int bytes = is_tag ? tag.bytes : 1 + (int)strcspn(at + 1, "<");
        if (is_tag && tag_is_block(&tag)) {
            if (!table_tag(w, &tag, line))
                block_tag(w, &tag, line);
        } else if (is_tag && tag.kind != TAG_COMMENT) {
            const bool alone = !w->b.open && tag.kind == TAG_PICTURE && only_pictures(at);
            if (tag.kind == TAG_PICTURE && !alone)
                heading_begin(w, line);
            letter_tag(w, &tag, alone, line);
        } else if (!is_tag && (!w->html.rows || w->html.in_cell)) {
            letters_put(w, at, bytes, line);
        }
        line += lines_in(at, bytes);
        w->html.line = line;
        at += bytes;
    }
    reader_block_close(&w->b);
    html_looks_end(w);
    close_kind(w, TAG_PARAGRAPH);
    close_kind(w, TAG_HEADING);
}
