/* pages_beside.c - figures that text flows around: which they are, and how they are put beside
 * the paragraph that follows. See pages_internal.h. */
#include "pages_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double usual_percent = 40;
static const double gap_em = 1, around_gap_em = 0.5;
static const double least_em = 8;   /* of a line beside a figure: two words */
static const double caption_em = 8; /* of a narrow picture's caption */

/* ---- which they are ---- */

/* The narrowest column of text. */
static double column_of(const struct reader_pages_setup *s)
{
    double width =
        s->grid.texts
            ? s->grid.text[0].width
            : (s->width_px - 2 * s->margin_px - s->notes_px - (s->columns - 1) * s->gap_px) /
                  fmax(1, s->columns);
    for (int i = 1; i < s->grid.texts; i++)
        width = fmin(width, s->grid.text[i].width);
    return width;
}

/* What the block says itself, or the setup of all. */
static struct reader_beside beside_of(const struct reader_pages_setup *s,
                                      const struct reader_block *b)
{
    return b->beside.side == READER_SIDE_USUAL && b->kind == READER_PICTURE ? s->beside
                                                                            : b->beside;
}

/* A picture, or a stage where somebody draws it. */
static bool is_figure(const struct reader_pages_setup *s, const struct reader_block *b)
{
    return (b->kind == READER_PICTURE && b->target) ||
           (b->kind == READER_LIVE && b->stage_width && s->stage_strip_px > 0);
}

/* How wide it may be; 0: it is no such figure, or a line beside it has no room. */
static double figure_px(const struct reader_pages_setup *s, const struct reader_block *b)
{
    const struct reader_beside beside = beside_of(s, b);
    const double column = column_of(s), em = s->size_px,
                 width =
                     floor(column * (beside.percent ? beside.percent : usual_percent) / 100);
    if (!is_figure(s, b) || b->items || b->quotes || b->marker ||
        (beside.side != READER_SIDE_LEFT && beside.side != READER_SIDE_RIGHT) ||
        column - width < (gap_em + least_em) * em || width < 2 * em)
        return 0;
    return width;
}

int pages_beside_host(const struct reader_pages_setup *s, const struct reader_document *d,
                      int block, double *width_px)
{
    int host = block;
    *width_px = figure_px(s, &d->blocks[block]);
    if (!(*width_px > 0))
        return -1;
    for (int n = 1; n <= PAGES_WAITING_MAX && ++host < d->blocks_count; n++) {
        if (reader_around_has(&d->blocks[host]))
            return host;
        if (!(figure_px(s, &d->blocks[host]) > 0))
            return -1;
    }
    return -1;
}

/* No block is lower than this, beside a figure. */
static double block_least(const struct reader_pages_setup *s, const struct reader_block *b,
                          double beside_px)
{
    const double letter_em = 0.3, line = s->leading * s->size_px,
                 letters = b->bytes * letter_em * s->size_px;
    return line * fmax(1, floor(letters / beside_px));
}

/* No figure is higher than that. */
static double figure_most(const struct reader_pages_setup *s, const struct reader_block *b,
                          double width_px)
{
    const double letter_em = 0.6, part = 0.6, line = s->leading * s->size_px;
    if (b->kind == READER_LIVE)
        return s->stage_strip_px + 2 * line +
               b->stage_height * fmin(1, width_px / b->stage_width);
    return part * fmax(1, s->height_px) + 3 * line +
           line * ceil(b->bytes * letter_em * s->size_px / fmin(width_px, 8 * s->size_px));
}

/* How many blocks from one on stand beside what is so high, and leaves so much of lines. */
static int blocks_beside(const struct reader_pages_setup *s, const struct reader_document *d,
                         int from, double need_px, double beside_px)
{
    enum { MOST = 64 };
    double all = 0, other;
    int next = from;
    for (; next < d->blocks_count && next - from < MOST && all < need_px; next++) {
        if (reader_around_has(&d->blocks[next]))
            all += block_least(s, &d->blocks[next], beside_px);
        else if (pages_beside_host(s, d, next, &other) < 0)
            break;
    }
    return next - from;
}

int pages_beside_length(const struct reader_pages_setup *s, const struct reader_document *d,
                        int block)
{
    double width;
    const int host = pages_beside_host(s, d, block, &width);
    if (host < 0)
        return 1;
    const double need = figure_most(s, &d->blocks[block], width) * (host - block);
    return host - block + blocks_beside(s, d, host, need, column_of(s) - width);
}

/* ---- obstacles ---- */

double pages_around_end(const struct reader_pages_setup *s, int block)
{
    double end = 0;
    for (int i = 0; i < s->obstacles_count; i++)
        if (s->obstacles[i].block == block)
            end = fmax(end, s->size_px * (s->obstacles[i].y + s->obstacles[i].height));
    return end;
}

int pages_around_length(const struct reader_pages_setup *s, const struct reader_document *d,
                        int block, double need_px)
{
    const int length =
        blocks_beside(s, d, block, need_px + s->leading * s->size_px, column_of(s));
    return length > 1 ? length : 1;
}

double pages_around_x(const struct reader_pages *p, enum reader_around side)
{
    return side == READER_AROUND_RIGHT ? column_of(&p->setup) : 0;
}

static enum reader_status obstacles_put(struct reader_pages *p, int id)
{
    enum { MOST = 16 };
    struct page_obstacle own[MOST];
    struct page_row rows[MOST][READER_OBSTACLE_ROWS];
    const double em = p->setup.size_px;
    int count = 0;
    if (p->obstacled == p->block)
        return READER_OK;
    p->obstacled = p->block;
    for (int i = 0; i < p->setup.obstacles_count && count < MOST; i++) {
        const struct reader_obstacle *o = &p->setup.obstacles[i];
        if (o->block != p->block)
            continue;
        for (int k = 0; k < o->rows_count; k++)
            rows[count][k] = (struct page_row){em * o->rows[k].from_px, em * o->rows[k].to_px};
        own[count] = (struct page_obstacle){.x_px = pages_around_x(p, o->side) + em * o->x,
                                            .y_px = em * o->y,
                                            .height_px = em * o->height,
                                            .gap_px = around_gap_em * em,
                                            .least_px = least_em * em,
                                            .rows = rows[count],
                                            .rows_count = o->rows_count};
        count++;
    }
    return !count || page_obstacles_set(p->text, id, own, count) == FONT_OK ? READER_OK
                                                                            : pages_failed();
}

/* ---- putting them there ---- */

enum reader_status pages_beside_wait(struct reader_pages *p, const struct reader_block *block,
                                     bool *waits)
{
    const struct reader_document *d = p->document;
    const struct pictured *picture;
    double width;
    *waits = false;
    if ((block->kind != READER_PICTURE && block->kind != READER_LIVE) || block < d->blocks ||
        block >= d->blocks + d->blocks_count || p->waiting_count == PAGES_WAITING_MAX ||
        pages_beside_host(&p->setup, d, (int)(block - d->blocks), &width) < 0)
        return READER_OK;
    enum reader_status status =
        block->kind == READER_LIVE
            ? READER_OK
            : pages_pictured(p, block->source, block->target, block->asked, width, &picture);
    *waits = status == READER_OK && (block->kind == READER_LIVE || picture);
    if (*waits)
        p->waiting[p->waiting_count++] = block;
    return status;
}

static void figure_kept(struct reader_pages *p)
{
    struct made_passage *made = p->made ? p->made : &p->kept;
    if (!made->count)
        return;
    made->paragraphs[made->count - 1].beside = true;
    made->paragraphs[made->count - 1].figure = true;
}

/* A stage: its room beside lines is a picture's. */
static enum reader_status stage_put(struct reader_pages *p, int id,
                                    const struct reader_block *block)
{
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    struct page_beside to = {.side = block->beside.side == READER_SIDE_LEFT ? PAGE_SIDE_LEFT
                                                                            : PAGE_SIDE_RIGHT,
                             .gap_px = gap_em * p->setup.size_px,
                             .least_px = least_em * p->setup.size_px};
    struct paragraph_text none = {0};
    double most;
    int style, plain, figure;
    pages_beside_host(&p->setup, p->document, (int)(block - p->document->blocks), &most);
    enum reader_status status = pages_style(p, CONTEXT_TABLE, 0, &plain);
    if (status == READER_OK)
        status = pages_stage_style(p, block, most, &style, &to.width_px);
    if (status != READER_OK)
        return status;
    manner.indent_px = 0;
    manner.before_px = manner.after_px = 0.3 * p->setup.size_px;
    if (page_beside_add(p->text, id, &to, "-", 1, plain, &manner, &figure) != FONT_OK ||
        page_paragraph_style(p->text, figure, 0, 1, style) != FONT_OK)
        return pages_failed();
    p->insets++;
    status = pages_made_keep(p, figure, -1, &none);
    if (status == READER_OK && (p->made || p->kept.count))
        figure_kept(p);
    return status;
}

/* What lines keep away from, of a picture in the middle of a box so wide. Returns the count of
 * rows; 0: all of it. */
static int rows_make(const struct pictured *picture, struct reader_beside beside, double box_px,
                     struct page_row *rows)
{
    enum { OPAQUE = 32, STEP = 2 };
    const double left = (box_px - picture->width) / 2, half = picture->width / 2.0;
    const int height = picture->height, width = picture->width,
              count = height / STEP < PAGE_ROWS_MAX ? (height / STEP > 0 ? height / STEP : 1)
                                                    : PAGE_ROWS_MAX;
    if (!(beside.round || (beside.shape && picture->alpha)))
        return 0;
    for (int i = 0; i < count; i++) {
        const int y0 = i * height / count, y1 = (i + 1) * height / count;
        int from = width, to = 0;
        if (beside.round) {
            const double y = fmin(fabs(2.0 * y0 / height - 1), fabs(2.0 * y1 / height - 1)),
                         reach = half * sqrt(fmax(0, 1 - y * y));
            rows[i] = (struct page_row){left + half - reach, left + half + reach};
            continue;
        }
        for (int y = y0; y < y1; y++)
            for (int x = 0; x < width; x++)
                if (picture->alpha[(size_t)y * (size_t)width + (size_t)x] > OPAQUE) {
                    from = x < from ? x : from;
                    to = x + 1 > to ? x + 1 : to;
                }
        rows[i] = (struct page_row){left + from, left + (to > from ? to : from)};
    }
    /* no line goes on at the other side of it */
    for (int i = 0; i < count; i++)
        if (rows[i].to_px > rows[i].from_px && beside.side == READER_SIDE_LEFT)
            rows[i].from_px = 0;
        else if (rows[i].to_px > rows[i].from_px)
            rows[i].to_px = box_px;
    return count;
}

static enum reader_status caption_put(struct reader_pages *p, int id,
                                      const struct reader_block *block,
                                      const struct page_beside *box, struct page_manner *manner)
{
    struct paragraph_text t = {0};
    struct page_beside own = *box;
    int style, caption;
    own.rows_count = 0;
    manner->before_px = 0.2 * p->setup.size_px;
    manner->after_px = 0.3 * p->setup.size_px;
    enum reader_status status = pages_caption(&t, block, true)
                                    ? pages_style(p, CONTEXT_TABLE, 0, &style)
                                    : pages_no_memory();
    if (status == READER_OK && page_beside_add(p->text, id, &own, t.text, (size_t)t.bytes,
                                               style, manner, &caption) != FONT_OK)
        status = pages_failed();
    if (status == READER_OK)
        status = pages_styles_apply(p, caption, &t, CONTEXT_TABLE, false, own.width_px);
    if (status == READER_OK)
        status = pages_notes_add(p, id, &t, 0);
    if (status == READER_OK)
        status = pages_made_keep(p, caption, -1, &t);
    if (status == READER_OK && (p->made || p->kept.count))
        figure_kept(p);
    pages_text_finish(&t);
    return status;
}

/* The picture, and its caption below it. */
static enum reader_status figure_put(struct reader_pages *p, int id,
                                     const struct reader_block *block)
{
    const struct reader_beside beside = beside_of(&p->setup, block);
    const double em = p->setup.size_px;
    struct page_manner manner = pages_manner(p, CONTEXT_TABLE);
    struct page_row rows[PAGE_ROWS_MAX];
    const struct pictured *picture;
    struct paragraph_text none = {0};
    double most;
    int style, figure;
    pages_beside_host(&p->setup, p->document, (int)(block - p->document->blocks), &most);
    enum reader_status status =
        pages_pictured(p, block->source, block->target, block->asked, most, &picture);
    if (status == READER_OK)
        status = pages_style(p, CONTEXT_TABLE, 0, &style);
    if (status != READER_OK || !picture)
        return status;
    const double box =
        block->bytes ? fmax(picture->width, fmin(most, caption_em * em)) : picture->width;
    struct page_beside to = {.side = beside.side == READER_SIDE_LEFT ? PAGE_SIDE_LEFT
                                                                     : PAGE_SIDE_RIGHT,
                             .width_px = box,
                             .gap_px = gap_em * em,
                             .least_px = least_em * em,
                             .rows = rows};
    to.rows_count = rows_make(picture, beside, box, rows);
    manner.align = FONT_ALIGN_CENTER;
    manner.indent_px = 0;
    manner.before_px = manner.after_px = 0.3 * em;
    if (page_beside_add(p->text, id, &to, picture->target, strlen(picture->target), style,
                        &manner, &figure) != FONT_OK ||
        page_paragraph_style(p->text, figure, 0, (int)strlen(picture->target),
                             picture->style) != FONT_OK)
        return pages_failed();
    p->insets++;
    status = pages_made_keep(p, figure, -1, &none);
    if (status == READER_OK && (p->made || p->kept.count))
        figure_kept(p);
    return status == READER_OK && block->bytes ? caption_put(p, id, block, &to, &manner)
                                               : status;
}

enum reader_status pages_besides_put(struct reader_pages *p, int id)
{
    const int block = p->block, count = p->waiting_count;
    enum reader_status status = p->setup.obstacles_count ? obstacles_put(p, id) : READER_OK;
    p->waiting_count = 0; /* notes of captions are paragraphs, too */
    for (int i = 0; i < count && status == READER_OK; i++) {
        p->block = (int)(p->waiting[i] - p->document->blocks);
        status =
            (p->waiting[i]->kind == READER_LIVE ? stage_put : figure_put)(p, id, p->waiting[i]);
    }
    p->block = block;
    return status;
}
