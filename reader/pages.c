/* pages.c - see reader_pages.h. */
#include "pages_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reader_pages_setup reader_pages_setup_default(void)
{
    static const char *const serif[] = {"EBGaramond12-Regular", "DejaVuSerif", NULL};
    return (struct reader_pages_setup){.font = font_face_first(serif),
                                       .mono = "DejaVuSansMono",
                                       .size_px = 17,
                                       .leading = 1.3,
                                       .width_px = 600,
                                       .height_px = 840,
                                       .margin_px = 64,
                                       .gap_px = 24,
                                       .columns = 1,
                                       .align = FONT_ALIGN_JUSTIFY,
                                       .hyphenate = true,
                                       .running = true,
                                       .ink_link = {0.08, 0.22, 0.45},
                                       .ink_struck = {0.55, 0.55, 0.55}};
}

struct page_text *reader_pages_text(struct reader_pages *pages)
{
    return pages->text;
}

bool reader_pages_lacks_math(const struct reader_pages *pages)
{
    return pages->math_missing;
}

const char *reader_pages_unknown(const struct reader_pages *pages, int *count)
{
    *count = pages->unknown_count;
    return pages->unknown;
}

void reader_pages_destroy(struct reader_pages *p)
{
    if (!p)
        return;
    page_text_destroy(p->text);
    pages_left_destroy(p->left);
    for (int i = 0; i < p->kept.count; i++)
        free(p->kept.paragraphs[i].spans);
    free(p->kept.paragraphs);
    pages_pictures_free(p);
    pages_fonts_close(p);
    free(p->noted);
    free(p->obstacles);
    free(p);
}

/* ---- kinds of blocks ---- */

/* The item's number or bullet hangs before the first line. */
static enum reader_status marker_add(struct reader_pages *p, const struct reader_block *block,
                                     struct paragraph_text *t, struct page_manner *manner)
{
    double width;
    if (!block->marker)
        return READER_OK;
    if (!pages_text_add(t, block->marker, (int)strlen(block->marker), 0) ||
        !pages_text_add(t, "\xe2\x80\x82", 3, 0))
        return pages_no_memory();
    enum reader_status status = pages_width(p, t, CONTEXT_TEXT, &width);
    manner->indent_px = -width;
    return status;
}

/* A quote stands apart from what is before and behind it, an item of a list too. */
static void quote_part(const struct reader_pages *p, const struct reader_block *block,
                       struct page_manner *manner)
{
    const struct reader_document *d = p->document;
    const bool first = block == d->blocks, last = block + 1 == d->blocks + d->blocks_count;
    const double gap = 0.4 * p->setup.size_px;
    if (block->quotes && (first || block[-1].quotes < block->quotes))
        manner->before_px = gap;
    if (block->quotes && (last || block[1].quotes < block->quotes))
        manner->after_px = gap;
}

/* What is parted stands as one: only its first line is moved in, and its last one ends it. */
static enum reader_status piece_add(struct reader_pages *p, void *user,
                                    struct paragraph_text *piece,
                                    const struct pages_piece_place *place)
{
    const struct page_manner *all = user;
    const double gap = 0.35 * p->setup.size_px;
    struct page_manner manner = *all;
    if (!place->first) {
        manner.indent_px = 0;
        manner.before_px = place->picture ? gap : 0;
    }
    if (!place->last)
        manner.after_px = place->picture ? gap : 0;
    if (place->picture && manner.align == FONT_ALIGN_JUSTIFY)
        manner.align = FONT_ALIGN_START;
    return pages_paragraph_add(p, piece, CONTEXT_TEXT, &manner, false);
}

static enum reader_status text_add(struct reader_pages *p, const struct reader_block *block)
{
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_TEXT);
    const double em = p->setup.size_px;
    bool nested = block->items || block->quotes;
    pages_nest(p, block, &manner);
    if (nested)
        manner.after_px = 0.2 * em;
    else if (!p->behind_head && !block->continues)
        manner.indent_px = 1.2 * em;
    quote_part(p, block, &manner);
    if (block->number) { /* a table's caption */
        manner.keep_with_next = true;
        manner.indent_px = 0;
        manner.before_px = 0.5 * em;
    }
    pages_align(block, &manner);
    if (block->align != READER_ALIGN_USUAL)
        manner.after_px = fmax(manner.after_px, 0.4 * em);
    enum reader_status status = marker_add(p, block, &t, &manner);
    if (status == READER_OK && !pages_block_add(&t, block, 0, block->bytes, 0))
        status = pages_no_memory();
    if (status == READER_OK)
        status = pages_pieces(p, &t, CONTEXT_TEXT,
                              pages_column(p) - manner.left_px - manner.right_px, piece_add,
                              &manner);
    pages_text_finish(&t);
    return status;
}

static enum reader_status heading_add(struct reader_pages *p, const struct reader_block *block)
{
    struct paragraph_text t = {0};
    enum context context = block->level == 1   ? CONTEXT_HEAD_1
                           : block->level == 2 ? CONTEXT_HEAD_2
                                               : CONTEXT_HEAD_3;
    struct page_manner manner = pages_manner(p, context);
    const double em = p->setup.size_px;
    pages_nest(p, block, &manner);
    manner.before_px = em * (block->level == 1 ? 1.6 : block->level == 2 ? 1.3 : 0.9);
    manner.after_px = em * (block->level <= 2 ? 0.5 : 0.3);
    manner.keep_with_next = manner.keep_together = manner.balance = true;
    manner.role = FONT_ROLE_HEADING;
    manner.level = block->level;
    pages_align(block, &manner);
    enum reader_status status = marker_add(p, block, &t, &manner);
    if (status == READER_OK && !pages_block_add(&t, block, 0, block->bytes, 0))
        status = pages_no_memory();
    if (status == READER_OK)
        status = pages_paragraph_add(p, &t, context, &manner, false);
    pages_text_finish(&t);
    return status;
}

/* Its picture's room, where somebody will draw it, and its text. */
static enum reader_status live_add(struct reader_pages *p, const struct reader_block *block)
{
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    if (p->setup.stage_strip_px <= 0 || !block->stage_width)
        return pages_code_add(p, block);
    pages_nest(p, block, &manner);
    manner.before_px = 0.6 * p->setup.size_px;
    manner.keep_with_next = true;
    enum reader_status status = pages_stage_add(p, block, &manner);
    return status == READER_OK ? pages_code_add(p, block) : status;
}

static enum reader_status math_add(struct reader_pages *p, const struct reader_block *block)
{
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_TEXT);
    pages_nest(p, block, &manner);
    manner.align = FONT_ALIGN_CENTER;
    manner.keep_together = true;
    manner.hyphenate = false;
    manner.before_px = manner.after_px = 0.5 * p->setup.size_px;
    char number[24];
    enum reader_status status = pages_no_memory();
    if (pages_text_add(&t, block->text, block->bytes, READER_FORMULA)) {
        if (t.spans_count)
            t.spans[0].at = (long)block->at;
        for (int i = 0; i < t.bytes; i++)
            if (t.text[i] == '\n' || t.text[i] == '\t')
                t.text[i] = ' ';
        snprintf(number, sizeof number, "\xe2\x80\x83(%d)", block->number);
        if (block->number && !pages_text_add(&t, number, (int)strlen(number), 0))
            status = pages_no_memory();
        else
            status = pages_paragraph_add(p, &t, CONTEXT_TEXT, &manner, true);
    }
    pages_text_finish(&t);
    return status;
}

static enum reader_status rule_add(struct reader_pages *p)
{
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_TEXT);
    manner.align = FONT_ALIGN_CENTER;
    manner.role = FONT_ROLE_ARTIFACT;
    manner.before_px = manner.after_px = 0.6 * p->setup.size_px;
    enum reader_status status = pages_text_add(&t, "* * *", 5, 0)
                                    ? pages_paragraph_add(p, &t, CONTEXT_TEXT, &manner, false)
                                    : pages_no_memory();
    pages_text_finish(&t);
    return status;
}

/* The picture, where it is found, and its caption; else its caption and where it lies. */
static enum reader_status picture_add(struct reader_pages *p, const struct reader_block *block)
{
    struct paragraph_text t = {0};
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    const double gap = 0.6 * p->setup.size_px;
    bool shown = false;
    pages_nest(p, block, &manner);
    manner.align = FONT_ALIGN_CENTER;
    pages_align(block, &manner);
    manner.before_px = gap;
    manner.keep_with_next = block->bytes > 0;
    enum reader_status status = pages_picture_add(p, block, &manner, &shown);
    if (status != READER_OK || (shown && !block->bytes))
        return status;
    manner.keep_with_next = false;
    manner.before_px = shown ? gap / 3 : gap;
    manner.after_px = gap;
    status = pages_caption(&t, block, shown)
                 ? pages_paragraph_add(p, &t, CONTEXT_TABLE, &manner, false)
                 : pages_no_memory();
    pages_text_finish(&t);
    return status;
}

/* Its stage waits for what comes next: its own text, where that has room beside it. */
static enum reader_status live_beside(struct reader_pages *p, const struct reader_block *block)
{
    const struct reader_block *waiting[PAGES_WAITING_MAX];
    const int count = p->waiting_count;
    double stage;
    bool fits;
    pages_beside_host(&p->setup, p->document, (int)(block - p->document->blocks), &stage);
    enum reader_status status = pages_code_fits(
        p, block, pages_column(p) - fmin(stage, block->stage_width) - 2 * p->setup.size_px,
        &fits);
    p->below = true;
    if (status != READER_OK || (fits && count == 1))
        return status == READER_OK ? pages_code_add(p, block) : status;
    memcpy(waiting, p->waiting, sizeof waiting);
    p->waiting_count = 0;
    status = pages_code_add(p, block);
    memcpy(p->waiting, waiting, sizeof waiting);
    p->waiting_count = count;
    return status;
}

static enum reader_status block_add(struct reader_pages *p, const struct reader_block *block)
{
    bool waits;
    enum reader_status status = pages_beside_wait(p, block, &waits);
    if (status == READER_OK && waits && block->kind == READER_LIVE)
        return live_beside(p, block);
    if (status != READER_OK || waits)
        return status;
    p->below =
        block->kind != READER_PARAGRAPH && !(block->kind == READER_HEADING && block->level > 2);
    switch (block->kind) {
    case READER_PARAGRAPH:
        return text_add(p, block);
    case READER_HEADING:
        return heading_add(p, block);
    case READER_CODE_BLOCK:
    case READER_HTML:
        return pages_code_add(p, block);
    case READER_LIVE:
        return live_add(p, block);
    case READER_MATH:
        return math_add(p, block);
    case READER_RULE:
        return rule_add(p);
    case READER_PICTURE:
        return picture_add(p, block);
    case READER_ROW:
        return pages_table_add(p, block, 1);
    }
    return READER_OK;
}

int pages_passage_length(const struct reader_document *d, int first)
{
    const struct reader_block *block = &d->blocks[first];
    int n = 1;
    while (block->kind == READER_ROW && first + n < d->blocks_count &&
           block[n].kind == READER_ROW && block[n].table == block->table)
        n++;
    return n;
}

int pages_wide_of(const struct reader_pages_setup *setup,
                  const struct reader_document *document, int number)
{
    const struct reader_block *block = &document->blocks[number];
    double width;
    switch (block->kind) {
    case READER_HEADING:
        return block->level <= 2 ? READER_WIDE_HEADINGS : -1;
    case READER_PICTURE: /* of a list or a quote: with it */
        return block->items || block->quotes ||
                       pages_beside_host(setup, document, number, &width) >= 0
                   ? -1
                   : READER_WIDE_FIGURES;
    case READER_LIVE:
        return pages_beside_host(setup, document, number, &width) >= 0
                   ? -1
                   : READER_WIDE_DEMONSTRATIONS;
    case READER_ROW:
        return READER_WIDE_TABLES;
    case READER_PARAGRAPH:
    case READER_CODE_BLOCK:
    case READER_HTML:
    case READER_MATH:
    case READER_RULE:
        break;
    }
    return -1;
}

/* Figures that no text followed have their column. */
static enum reader_status waiting_end(struct reader_pages *p)
{
    enum reader_status status = READER_OK;
    const int count = p->waiting_count;
    p->waiting_count = 0;
    for (int i = 0; i < count && status == READER_OK; i++) {
        const struct reader_block *block = p->waiting[i];
        const struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
        status = block->kind == READER_LIVE ? pages_stage_add(p, block, &manner)
                                            : picture_add(p, block);
    }
    return status;
}

enum reader_status pages_passage_add(struct reader_pages *p, int first, int count)
{
    const struct reader_block *block = &p->document->blocks[first];
    enum reader_status status = READER_OK;
    p->wide = pages_wide_of(&p->setup, p->document, first);
    p->block = first;
    p->obstacled = p->made ? -1 : p->obstacled; /* it may be set again */
    if (block->kind == READER_ROW && count > 1) {
        p->below = true;
        status = pages_table_add(p, block, count);
        p->behind_head = true;
        return status;
    }
    for (int i = 0; i < count && status == READER_OK; i++) {
        p->block = first + i;
        status = block_add(p, &block[i]);
        if (!p->waiting_count) /* a figure beside text is not before it */
            p->behind_head = block[i].kind != READER_PARAGRAPH;
    }
    if (p->made && status == READER_OK)
        status = waiting_end(p);
    return status;
}

static enum reader_status blocks_add(struct reader_pages *p)
{
    enum reader_status status = READER_OK;
    p->behind_head = true; /* the first paragraph is not moved in */
    for (int i = 0; i < p->document->blocks_count && status == READER_OK;) {
        const int n = pages_passage_length(p->document, i);
        status = pages_passage_add(p, i, n);
        i += n;
    }
    return status == READER_OK ? waiting_end(p) : status;
}

/* ---- the page ---- */

static struct page_frame frame_of(const struct reader_region *r, double frame_px)
{
    return (struct page_frame){.x = r->x,
                               .width = r->width,
                               .height = frame_px,
                               .margin_x = r->notes_width > 0 ? r->notes_x : 0,
                               .margin_width = r->notes_width};
}

static bool same_region(const struct reader_region *a, const struct reader_region *b)
{
    return a->x == b->x && a->width == b->width && a->notes_x == b->notes_x &&
           a->notes_width == b->notes_width;
}

/* One template for text, and one for each place that is another: where all are alike, one. */
static enum reader_status grid_set(struct reader_pages *p, double frame_px)
{
    const struct reader_grid *g = &p->setup.grid;
    struct page_template t[1 + READER_WIDES] = {{0}};
    p->templates_count = 1;
    for (int i = 0; i < g->texts; i++)
        t[0].frames[t[0].frames_count++] = frame_of(&g->text[i], frame_px);
    for (int i = 0; i < READER_WIDES; i++) {
        int at = g->texts == 1 && same_region(&g->wide[i], &g->text[0]) ? 0 : -1;
        for (int k = 0; k < i && at < 0; k++)
            if (same_region(&g->wide[i], &g->wide[k]))
                at = p->wide_templates[k];
        p->wide_templates[i] = at < 0 ? p->templates_count : at;
        if (at >= 0)
            continue;
        t[p->templates_count].frames[0] = frame_of(&g->wide[i], frame_px);
        t[p->templates_count++].frames_count = 1;
    }
    for (int i = 0; i < p->templates_count; i++) {
        t[i].width_px = p->setup.width_px;
        t[i].height_px = frame_px;
    }
    return page_templates_set(p->text, t, p->templates_count) == FONT_OK ? READER_OK
                                                                         : pages_failed();
}

/* Pages whose columns are those of a grid, with their notes. */
static enum reader_status page_grid_set(struct reader_pages *p, double frame_px)
{
    const struct reader_pages_setup *s = &p->setup;
    struct page_template t = {.width_px = s->width_px, .height_px = s->height_px};
    if (!(frame_px >= 2 * s->size_px))
        return reader_fail(READER_BAD_ARGUMENT,
                           "columns %.0f pixels high are too small for letters of %g", frame_px,
                           s->size_px);
    for (int i = 0; i < s->grid.texts; i++) {
        struct page_frame frame = frame_of(&s->grid.text[i], frame_px);
        frame.y = s->margin_px;
        frame.foot_gap_px = 0.7 * s->size_px;
        t.frames[t.frames_count++] = frame;
    }
    return page_templates_set(p->text, &t, 1) == FONT_OK ? READER_OK : pages_failed();
}

enum reader_status pages_template_set(struct reader_pages *p, double frame_px)
{
    p->wide = -1;
    p->templates_count = 1;
    if (p->made && p->setup.grid.texts)
        return grid_set(p, frame_px);
    const struct reader_pages_setup *s = &p->setup;
    const bool scrolled = p->made != NULL;
    if (!scrolled && s->grid.texts)
        return page_grid_set(p, frame_px);
    const double width = s->columns >= 1 ? pages_column(p) : 0, height = frame_px;
    struct page_template t = {.width_px = s->width_px,
                              .height_px = scrolled ? frame_px : s->height_px};
    if (s->columns < 1 || s->columns > PAGE_FRAMES_MAX)
        return reader_fail(READER_BAD_ARGUMENT, "a page has 1..%d columns (got %d)",
                           PAGE_FRAMES_MAX, s->columns);
    if (!(width >= 2 * s->size_px && height >= 2 * s->size_px))
        return reader_fail(READER_BAD_ARGUMENT,
                           "columns of %.0fx%.0f pixels are too small for letters of %g", width,
                           height, s->size_px);
    for (int i = 0; i < s->columns; i++)
        t.frames[t.frames_count++] = (struct page_frame){
            .x = s->margin_px + i * (width + s->gap_px),
            .y = scrolled ? 0 : s->margin_px,
            .width = width,
            .height = height,
            .margin_x = s->width_px - s->margin_px - s->notes_px + s->gap_px / 2,
            .margin_width = s->notes_px > 0 ? fmax(0, s->notes_px - s->gap_px / 2) : 0,
            .foot_gap_px = 0.7 * s->size_px};
    return page_templates_set(p->text, &t, 1) == FONT_OK ? READER_OK : pages_failed();
}

/* The chapter over the page, its number under it, in the middle of the margins. */
static enum reader_status running_set(struct reader_pages *p)
{
    const struct reader_pages_setup *s = &p->setup;
    int style;
    if (!s->running || s->margin_px < 1.5 * s->size_px)
        return READER_OK;
    enum reader_status status = pages_style(p, CONTEXT_NOTE, READER_SLANTED, &style);
    const double middle = s->margin_px / 2, half = 0.25 * s->size_px;
    const struct page_running line = {.style = style,
                                      .x0 = s->margin_px,
                                      .x1 = s->width_px - s->margin_px,
                                      .align = FONT_ALIGN_CENTER};
    struct page_running lines[2] = {line, line};
    lines[0].text = "%h";
    lines[0].not_opening = true;
    lines[0].y = middle + half;
    lines[1].text = "%p";
    lines[1].y = s->height_px - middle + half;
    if (status == READER_OK)
        status = pages_style(p, CONTEXT_NOTE, 0, &lines[1].style);
    if (status == READER_OK && page_running_set(p->text, lines, 2) != FONT_OK)
        status = pages_failed();
    return status;
}

enum reader_status pages_begin(const struct reader_document *document,
                               const struct reader_pages_setup *setup, double frame_px,
                               struct made_passage *made, struct reader_pages **out)
{
    struct reader_pages *p = calloc(1, sizeof *p);
    *out = NULL;
    if (!p)
        return pages_no_memory();
    p->setup = *setup;
    p->document = document;
    p->made = made;
    p->at = p->obstacled = -1;
    p->placed = pages_besides_put;
    p->noted = calloc((size_t)document->notes_count + 1, sizeof *p->noted);
    enum reader_status status = p->noted ? READER_OK : pages_no_memory();
    if (status == READER_OK && page_text_create(&p->text) != FONT_OK)
        status = pages_failed();
    if (status == READER_OK) {
        page_text_colour(p->text);
        status = pages_template_set(p, frame_px);
    }
    if (status == READER_OK)
        status = pages_fonts_open(p);
    if (status == READER_OK)
        status = running_set(p);
    if (status == READER_OK)
        *out = p;
    else
        reader_pages_destroy(p);
    return status;
}

enum reader_status reader_pages_make(const struct reader_document *document,
                                     const struct reader_pages_setup *setup,
                                     struct reader_pages **out)
{
    enum reader_status status =
        pages_begin(document, setup, setup->height_px - 2 * setup->margin_px, NULL, out);
    if (status == READER_OK && setup->remarks) {
        struct reader_pages *p = *out;
        status = reader_around_find(setup->remarks, document, &p->obstacles,
                                    &p->setup.obstacles_count);
        p->setup.obstacles = p->obstacles;
    }
    if (status == READER_OK)
        status = blocks_add(*out);
    if (status == READER_OK && (setup->remarks || setup->places))
        status = pages_left_make(*out);
    if (status != READER_OK) {
        reader_pages_destroy(*out);
        *out = NULL;
        return status;
    }
    (*out)->document = NULL;
    return status;
}
