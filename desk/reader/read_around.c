/* read_around.c - ink that text flows around: chosen strokes become such ink, or ordinary ink
 * again. */
#include "read_desk.h"

#include <math.h>

/* ---- of which paragraph ---- */

/* A paragraph, and the two edges from which ink is counted. */
struct host {
    int block;
    double x[READER_AROUND_RIGHT + 1], y;
};

static bool host_at(struct read_desk *d, double x, double y, struct host *host)
{
    size_t byte;
    bool inside;
    if (!reader_view_hit(d->view, x, y, &byte, &inside))
        return false;
    const struct reader_document *doc = d->document;
    const struct reader_block *block = reader_document_block(doc, byte);
    if (!block || block < doc->blocks || block >= doc->blocks + doc->blocks_count ||
        !reader_around_has(block))
        return false;
    host->block = (int)(block - doc->blocks);
    return reader_view_begins(d->view, host->block, READER_AROUND_LEFT,
                              &host->x[READER_AROUND_LEFT], &host->y) &&
           reader_view_begins(d->view, host->block, READER_AROUND_RIGHT,
                              &host->x[READER_AROUND_RIGHT], &host->y);
}

/* The first one that lines up with the box, from above. */
static bool host_find(struct read_desk *d, const struct reader_box *box, struct host *host)
{
    const double line = d->setup.leading * d->size_px;
    for (double y = box->y; y < box->y + box->height + line; y += line)
        if (host_at(d, box->x + box->width / 2, y, host))
            return true;
    return false;
}

/* ---- made so ---- */

struct placed {
    int index;
    double x, y; /* of the window */
};

/* Where all that is chosen is; false: some of it is not in the window. */
static bool places_find(struct read_desk *d, struct placed *to)
{
    for (guint i = 0; i < d->chosen->len; i++) {
        to[i].index = g_array_index(d->chosen, int, i);
        if (!read_text_origin(d, reader_remarks_get(d->remarks, to[i].index), &to[i].x,
                              &to[i].y))
            return false;
    }
    return true;
}

/* Its first word, or letter. */
static struct read_range words_of(struct read_desk *d, int block)
{
    const struct reader_block *b = &d->document->blocks[block];
    struct read_range word = read_text_word(d, b->at);
    if (word.begin >= word.end)
        word = (struct read_range){
            b->at, b->at + (size_t)(g_utf8_next_char(d->document->plain + b->at) -
                                    (d->document->plain + b->at))};
    return word;
}

/* A stroke as it is, on other words: the one that there was is erased. -1: it cannot be. */
static int stroke_again(struct read_desk *d, int index, struct read_range words)
{
    const struct reader_remark r = *reader_remarks_get(d->remarks, index);
    read_remarks_erase(d, index);
    return read_remarks_add(d,
                            &(struct reader_remark){.kind = READER_REMARK_INK,
                                                    .rgba = r.rgba,
                                                    .width = r.width,
                                                    .made_s = r.made_s,
                                                    .points = r.points,
                                                    .points_count = r.points_count},
                            words.begin, words.end);
}

static void strokes_move(struct read_desk *d, const struct placed *from, int count,
                         const struct host *host, enum reader_around side)
{
    struct reader_arranged *to = g_new(struct reader_arranged, (gsize)count);
    const struct read_range words = words_of(d, host->block);
    int made = 0;
    g_array_set_size(d->chosen, 0);
    for (int i = 0; i < count; i++) {
        const struct reader_arranged before =
            reader_remarks_arranged(d->remarks, from[i].index);
        const int index = stroke_again(d, from[i].index, words);
        if (index < 0)
            continue;
        to[made++] = (struct reader_arranged){.index = index,
                                              .x = (from[i].x - host->x[side]) / d->size_px,
                                              .y = (from[i].y - host->y) / d->size_px,
                                              .scale_x = before.scale_x,
                                              .scale_y = before.scale_y,
                                              .hangs = index,
                                              .group = -1,
                                              .around = side};
    }
    for (int i = 0; i < made; i++) {
        to[i].hangs = to[0].index;
        to[i].group = count > 1 ? to[0].index : -1;
        g_array_append_val(d->chosen, to[i].index);
    }
    if (made)
        read_remarks_arrange(d, to, made);
    g_free(to);
}

/* What is chosen, around which text flows from where it is now. kept: nothing is done where it
 * has its paragraph already. */
static void around_make(struct read_desk *d, bool kept)
{
    const int count = read_chosen_count(d);
    struct placed *from = g_new(struct placed, (gsize)count);
    struct reader_box box;
    struct host host;
    if (!read_chosen_box(d, &box) || !places_find(d, from)) {
        d->say(d, _("Ink that text is to flow around must be in the window, all of it."));
    } else if (!host_find(d, &box, &host)) {
        d->say(d, _("Text flows around ink beside paragraphs, not beside headings, tables and "
                    "code."));
    } else {
        const enum reader_around side =
            2 * box.x + box.width < host.x[READER_AROUND_LEFT] + host.x[READER_AROUND_RIGHT]
                ? READER_AROUND_LEFT
                : READER_AROUND_RIGHT;
        const struct reader_remark *r = reader_remarks_get(d->remarks, from[0].index);
        if (!kept || reader_around_block(d->document, r) != host.block)
            strokes_move(d, from, count, &host, side);
    }
    g_free(from);
}

/* On the words that they hang on, where they are. */
static void around_end(struct read_desk *d)
{
    const int count = read_chosen_count(d);
    struct placed *from = g_new(struct placed, (gsize)count);
    struct reader_arranged *to = g_new(struct reader_arranged, (gsize)count);
    bool good = places_find(d, from);
    for (int i = 0; i < count && good; i++) {
        struct reader_box word;
        const struct reader_remark *r = reader_remarks_get(d->remarks, from[i].index);
        good = reader_view_boxes(d->view, r->begin, r->begin + 1, &word, 1) > 0;
        to[i] = reader_remarks_arranged(d->remarks, from[i].index);
        to[i].x = (from[i].x - word.x) / d->size_px;
        to[i].y = (from[i].y - word.y) / d->size_px;
        to[i].around = READER_AROUND_NOT;
    }
    if (good)
        read_remarks_arrange(d, to, count);
    else
        d->say(d, _("Ink that text is to flow around must be in the window, all of it."));
    g_free(from);
    g_free(to);
}

static int around_count(struct read_desk *d)
{
    int count = 0;
    for (int i = read_chosen_count(d) - 1; i >= 0; i--)
        count += reader_remarks_get(d->remarks, g_array_index(d->chosen, int, i))->around !=
                 READER_AROUND_NOT;
    return count;
}

void read_around_toggle(struct read_desk *d)
{
    const int count = read_chosen_count(d);
    if (!count)
        return;
    read_remarks_group(d, true);
    if (around_count(d) == count)
        around_end(d);
    else
        around_make(d, false);
    read_remarks_group(d, false);
}

void read_around_lay(struct read_desk *d, const struct read_lay *lay)
{
    read_remarks_group(d, true);
    read_chosen_lay(d, lay);
    if (around_count(d) > 0 && around_count(d) == read_chosen_count(d))
        around_make(d, true);
    read_remarks_group(d, false);
}
