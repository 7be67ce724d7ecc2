/* pages_style.c - fonts, styles, letters of paragraphs: see pages_internal.h. */
#include "pages_internal.h"

#include <family.h>
#include <outline.h>

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum reader_status pages_failed(void)
{
    return reader_fail(READER_FAILED, "%s", font_error());
}

enum reader_status pages_no_memory(void)
{
    return reader_fail(READER_NO_MEMORY, "no memory for pages");
}

/* ---- fonts ---- */

double pages_x_height(struct font_face *face)
{
    struct font_outline outline;
    struct font_face_info info;
    font_face_describe(face, &info);
    if (font_face_outline(face, font_face_glyph(face, 'x'), &outline) != FONT_OK)
        return 0.5;
    struct font_box box = font_outline_box(&outline);
    font_outline_finish(&outline);
    return box.y1 > 0 ? box.y1 / info.units_per_em : 0.5;
}

enum reader_status pages_face(struct reader_pages *p, int i)
{
    if (p->faces[i])
        return READER_OK;
    if (font_face_open(p->fonts[i], 0, &p->faces[i]) != FONT_OK ||
        font_shaper_create(p->faces[i], &p->shapers[i]) != FONT_OK)
        return pages_failed();
    return READER_OK;
}

enum reader_status pages_fonts_open(struct reader_pages *p)
{
    static const char *const kinds[] = {NULL, "Italic", "Bold", "BoldItalic"};
    for (int i = 0; i < FACES; i++) {
        char room[512];
        const char *font = i & READER_CODE ? p->setup.mono : p->setup.font;
        const char *kind = kinds[i & 3];
        p->fonts[i] = strdup(kind ? page_family_face(font, kind, room, sizeof room) : font);
        if (!p->fonts[i])
            return pages_no_memory();
    }
    enum reader_status status = pages_face(p, 0);
    if (status == READER_OK)
        status = pages_face(p, READER_CODE);
    if (status != READER_OK)
        return status;
    p->mono_scale =
        fmin(1.2, pages_x_height(p->faces[0]) / pages_x_height(p->faces[READER_CODE]));
    return READER_OK;
}

void pages_fonts_close(struct reader_pages *p)
{
    for (int i = 0; i < FACES; i++) {
        font_shaper_destroy(p->shapers[i]);
        font_face_close(p->faces[i]);
        free(p->fonts[i]);
    }
    font_math_destroy(p->math);
    font_face_close(p->math_face);
}

double reader_size_usual(enum reader_size size)
{
    static const double sizes[READER_SIZES] = {
        [READER_SIZE_HEADING_1] = 1.7, [READER_SIZE_HEADING_2] = 1.3,
        [READER_SIZE_HEADING_3] = 1,   [READER_SIZE_NOTE] = 0.82,
        [READER_SIZE_CODE] = 0.88,     [READER_SIZE_TABLE] = 0.92};
    return sizes[size];
}

double pages_code_scale(int steps)
{
    return 1 - 0.01 * PAGES_CODE_PERCENT * steps;
}

double pages_size(const struct reader_pages *p, enum context context)
{
    static const int asked[CONTEXTS] = {[CONTEXT_TEXT] = -1,
                                        [CONTEXT_HEAD_1] = READER_SIZE_HEADING_1,
                                        [CONTEXT_HEAD_2] = READER_SIZE_HEADING_2,
                                        [CONTEXT_HEAD_3] = READER_SIZE_HEADING_3,
                                        [CONTEXT_NOTE] = READER_SIZE_NOTE,
                                        [CONTEXT_CODE] = READER_SIZE_CODE,
                                        [CONTEXT_TABLE] = READER_SIZE_TABLE};
    const int size = asked[context];
    const double own = size < 0 ? 1 : p->setup.sizes[size];
    return (own > 0 ? own : reader_size_usual((enum reader_size)size)) * p->setup.size_px *
           (context == CONTEXT_CODE ? pages_code_scale(p->code_steps) : 1);
}

/* ---- styles ---- */

unsigned pages_face_of(unsigned look)
{
    return look & (READER_SLANTED | READER_HEAVY | READER_CODE);
}

double pages_size_of(const struct reader_pages *p, enum context context, unsigned look)
{
    return pages_size(p, context) * (look & READER_CODE ? p->mono_scale : 1) *
           (look & READER_NOTE                        ? 0.65
            : look & (READER_RAISED | READER_LOWERED) ? 0.7
                                                      : 1);
}

/* Which of the styles of a context. */
static unsigned look_index(unsigned look)
{
    return (look & 31) | (look & READER_RAISED ? 32 : 0) | (look & READER_LOWERED ? 64 : 0);
}

enum reader_status pages_style(struct reader_pages *p, enum context context, unsigned look,
                               int *style)
{
    struct page_style made = page_style_default();
    if (context == CONTEXT_HEAD_3)
        look |= READER_HEAVY;
    int *kept = look & READER_NOTE        ? &p->raised[context]
                : context == CONTEXT_CODE ? &p->code_styles[p->code_steps][look_index(look)]
                                          : &p->styles[context][look_index(look)];
    *style = *kept - 1;
    if (*kept)
        return READER_OK;
    made.font = p->fonts[pages_face_of(look)];
    made.size_px = pages_size_of(p, context, look);
    made.language = p->setup.language;
    made.features = look & READER_CODE ? "-liga,-clig" : NULL;
    made.raise_px = pages_size_of(p, context, look & READER_CODE) *
                    (look & (READER_NOTE | READER_RAISED) ? 0.35
                     : look & READER_LOWERED              ? -0.15
                                                          : 0);
    made.inked = (look & (READER_LINK | READER_STRUCK)) != 0;
    const double *ink = look & READER_STRUCK ? p->setup.ink_struck : p->setup.ink_link;
    made.ink = font_ink_plain(ink[0], ink[1], ink[2], 1);
    if (page_style_add(p->text, &made, style) != FONT_OK)
        return pages_failed();
    *kept = *style + 1;
    return READER_OK;
}

/* Where the document says how lines stand. */
void pages_align(const struct reader_block *block, struct page_manner *manner)
{
    static const enum font_align aligns[] = {[READER_ALIGN_LEFT] = FONT_ALIGN_LEFT,
                                             [READER_ALIGN_CENTER] = FONT_ALIGN_CENTER,
                                             [READER_ALIGN_RIGHT] = FONT_ALIGN_RIGHT};
    if (block->align == READER_ALIGN_USUAL)
        return;
    manner->align = aligns[block->align];
    if (!block->marker)
        manner->indent_px = 0;
}

struct page_manner pages_manner(const struct reader_pages *p, enum context context)
{
    struct page_manner manner = page_manner_default();
    bool code = context == CONTEXT_CODE,
         running = context == CONTEXT_TEXT || context == CONTEXT_NOTE;
    manner.align = running ? p->setup.align : FONT_ALIGN_START;
    manner.leading_px = p->setup.leading * pages_size(p, context) *
                        (code                                  ? 0.95
                         : running || context == CONTEXT_TABLE ? 1
                                                               : 0.92);
    manner.hyphenate = p->setup.hyphenate && running;
    manner.protrude = running ? 0.6 : 0;
    return manner;
}

void pages_nest(const struct reader_pages *p, const struct reader_block *block,
                struct page_manner *manner)
{
    const double em = p->setup.size_px, most = pages_column(p) / 2;
    int items = block->items < READER_DEPTH_MAX ? block->items : READER_DEPTH_MAX;
    int quotes = block->quotes < READER_DEPTH_MAX ? block->quotes : READER_DEPTH_MAX;
    manner->left_px += fmin(most, 1.5 * em * items + 1.5 * em * quotes);
    manner->right_px += fmin(most / 2, 1.5 * em * quotes);
    if (quotes)
        manner->role = FONT_ROLE_QUOTE;
    if (items)
        manner->role = FONT_ROLE_ITEM;
}

/* Where what is made now stands on the grid; NULL: there is none. */
static const struct reader_region *region_of(const struct reader_pages *p)
{
    const struct reader_grid *grid = &p->setup.grid;
    const struct reader_region *narrow = &grid->text[0];
    if (!grid->texts)
        return NULL;
    for (int i = 1; !p->made && i < grid->texts; i++) /* nobody knows in which it comes */
        narrow = grid->text[i].width < narrow->width ? &grid->text[i] : narrow;
    return !p->made ? narrow : p->wide < 0 ? &grid->text[0] : &grid->wide[p->wide];
}

double pages_notes(const struct reader_pages *p)
{
    const struct reader_region *region = region_of(p);
    return region ? region->notes_width : p->setup.notes_px;
}

double pages_column(const struct reader_pages *p)
{
    const struct reader_pages_setup *s = &p->setup;
    const struct reader_region *region = region_of(p);
    if (region)
        return region->width;
    return (s->width_px - 2 * s->margin_px - s->notes_px - (s->columns - 1) * s->gap_px) /
           s->columns;
}

/* ---- letters ---- */

static bool span_add(struct paragraph_text *t, int begin, int end, unsigned look, int note)
{
    if (begin == end)
        return true;
    if (!array_reserve(&t->spans, &t->spans_capacity, t->spans_count + 1, sizeof *t->spans))
        return false;
    t->spans[t->spans_count++] =
        (struct line_span){.begin = begin, .end = end, .note = note, .look = look, .at = -1};
    return true;
}

bool pages_text_add(struct paragraph_text *t, const char *text, int bytes, unsigned look)
{
    if (!array_reserve(&t->text, &t->capacity, t->bytes + bytes + 1, 1))
        return false;
    memcpy(t->text + t->bytes, text, (size_t)bytes);
    t->bytes += bytes;
    t->text[t->bytes] = '\0';
    return span_add(t, t->bytes - bytes, t->bytes, look, -1);
}

/* The first span that ends behind a byte: rows have many cells. */
static int span_behind(const struct reader_block *block, int byte)
{
    int low = 0, high = block->spans_count;
    while (low < high) {
        const int half = low + (high - low) / 2;
        if (block->spans[half].end > byte)
            high = half;
        else
            low = half + 1;
    }
    return low;
}

bool pages_block_add(struct paragraph_text *t, const struct reader_block *block, int begin,
                     int end, unsigned look)
{
    for (int i = span_behind(block, begin); i < block->spans_count; i++) {
        const struct reader_span *s = &block->spans[i];
        int from = s->begin > begin ? s->begin : begin, to = s->end < end ? s->end : end;
        if (s->begin >= end)
            break;
        if (from >= to)
            continue;
        if (!pages_text_add(t, block->text + from, to - from, s->look | look))
            return false;
        t->spans[t->spans_count - 1].note = s->look & READER_NOTE ? s->note : -1;
        t->spans[t->spans_count - 1].at = (long)block->at + from;
        t->spans[t->spans_count - 1].image = s->look & READER_IMAGE ? s->target : NULL;
        t->spans[t->spans_count - 1].asked = s->asked;
        t->spans[t->spans_count - 1].source = block->source;
    }
    return true;
}

void pages_text_finish(struct paragraph_text *t)
{
    free(t->text);
    free(t->spans);
    *t = (struct paragraph_text){0};
}

/* ---- paragraphs ---- */

enum reader_status pages_made_keep(struct reader_pages *p, int id, int note,
                                   struct paragraph_text *t)
{
    struct made_passage *made = p->made                               ? p->made
                                : p->setup.remarks || p->setup.places ? &p->kept
                                                                      : NULL;
    if (!made)
        return READER_OK;
    if (!array_reserve(&made->paragraphs, &made->capacity, made->count + 1,
                       sizeof *made->paragraphs))
        return pages_no_memory();
    made->paragraphs[made->count++] =
        (struct made_paragraph){.id = id,
                                .note = note,
                                .block = p->block,
                                .beside = note >= 0 && pages_notes(p) > 0,
                                .spans = t->spans,
                                .spans_count = t->spans_count};
    t->spans = NULL;
    t->spans_count = t->spans_capacity = 0;
    return READER_OK;
}
