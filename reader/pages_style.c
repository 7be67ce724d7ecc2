/* pages_style.c - fonts, styles, paragraphs and their notes: see pages_internal.h. */
#include "pages_internal.h"

#include <family.h>
#include <outline.h>

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

/* How high an x is, of the em; half an em where there is none. */
static double x_height(struct font_face *face)
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

static enum reader_status face_get(struct reader_pages *p, int i)
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
    enum reader_status status = face_get(p, 0);
    if (status == READER_OK)
        status = face_get(p, READER_CODE);
    if (status != READER_OK)
        return status;
    p->mono_scale = fmin(1.2, x_height(p->faces[0]) / x_height(p->faces[READER_CODE]));
    return READER_OK;
}

/* Before the first formula. Without a font that anybody asked for formulas stand as they are
 * written. */
static enum reader_status math_open(struct reader_pages *p)
{
    const char *name = p->setup.math ? p->setup.math : font_face_first(font_math_fonts);
    if (p->math || p->math_missing)
        return READER_OK;
    if (font_face_open(name, 0, &p->math_face) == FONT_OK &&
        font_math_create(p->math_face, &p->math) == FONT_OK) {
        p->math_scale = x_height(p->faces[0]) / x_height(p->math_face);
        return READER_OK;
    }
    p->math_missing = true;
    return p->setup.math ? pages_failed() : READER_OK;
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

static unsigned face_of(unsigned look)
{
    return look & (READER_SLANTED | READER_HEAVY | READER_CODE);
}

static double size_of(const struct reader_pages *p, enum context context, unsigned look)
{
    return pages_size(p, context) * (look & READER_CODE ? p->mono_scale : 1);
}

enum reader_status pages_style(struct reader_pages *p, enum context context, unsigned look,
                               int *style)
{
    struct page_style made = page_style_default();
    if (context == CONTEXT_HEAD_3)
        look |= READER_HEAVY;
    int *kept = look & READER_NOTE        ? &p->raised[context]
                : context == CONTEXT_CODE ? &p->code_styles[p->code_steps][look & (LOOKS - 1)]
                                          : &p->styles[context][look & (LOOKS - 1)];
    *style = *kept - 1;
    if (*kept)
        return READER_OK;
    made.font = p->fonts[face_of(look)];
    made.size_px = size_of(p, context, look);
    made.language = p->setup.language;
    made.features = look & READER_CODE ? "-liga,-clig" : NULL;
    if (look & READER_NOTE) {
        made.raise_px = 0.35 * made.size_px;
        made.size_px *= 0.65;
    }
    made.inked = (look & (READER_LINK | READER_STRUCK)) != 0;
    const double *ink = look & READER_STRUCK ? p->setup.ink_struck : p->setup.ink_link;
    made.ink = font_ink_plain(ink[0], ink[1], ink[2], 1);
    if (page_style_add(p->text, &made, style) != FONT_OK)
        return pages_failed();
    *kept = *style + 1;
    return READER_OK;
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
    if (!p->made || !grid->texts)
        return NULL;
    return p->wide < 0 ? &grid->text[0] : &grid->wide[p->wide];
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
    t->spans[t->spans_count++] = (struct line_span){begin, end, note, look, -1};
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
    }
    return true;
}

void pages_text_finish(struct paragraph_text *t)
{
    free(t->text);
    free(t->spans);
    *t = (struct paragraph_text){0};
}

/* ---- formulas ---- */

/* A formula's layout; one that is too large is none, and *set is false. Owns: the caller
 * finishes *out. */
static enum reader_status formula_layout(struct reader_pages *p, const struct paragraph_text *t,
                                         const struct line_span *s, enum context context,
                                         bool display, double most_px, bool *set,
                                         struct font_layout *out)
{
    const char *tex = t->text + s->begin;
    int bytes = s->end - s->begin, unknown;
    enum reader_status opened = math_open(p);
    *set = false;
    if (opened != READER_OK || !p->math)
        return opened;
    struct font_math_options options = {.size_px = pages_size(p, context) * p->math_scale,
                                        .display = display};
    if (bytes >= 2 && tex[0] == '$' && tex[bytes - 1] == '$') {
        tex++;
        bytes -= 2;
    }
    enum font_status status = font_math_layout(p->math, tex, (size_t)bytes, &options, out);
    if (status == FONT_OK && display && out->width_px > most_px) {
        options.size_px *= fmax(0.3, most_px / out->width_px);
        font_layout_finish(out);
        status = font_math_layout(p->math, tex, (size_t)bytes, &options, out);
    }
    *set = status == FONT_OK;
    if (status != FONT_OK)
        return status == FONT_TOO_LARGE ? READER_OK : pages_failed();
    const char *first = font_math_unknown(p->math, &unknown);
    if (unknown && !p->unknown_count)
        snprintf(p->unknown, sizeof p->unknown, "%s", first);
    p->unknown_count += unknown;
    return READER_OK;
}

static enum reader_status formula_style(struct reader_pages *p, const struct paragraph_text *t,
                                        const struct line_span *s, enum context context,
                                        bool display, double most_px, int *style)
{
    struct font_layout shown = {0};
    struct page_style look = page_style_default();
    bool set;
    enum reader_status status =
        formula_layout(p, t, s, context, display, most_px, &set, &shown);
    if (status != READER_OK)
        return status;
    if (!set)
        return pages_style(p, context, READER_CODE, style);
    look.font = p->fonts[0];
    look.size_px = pages_size(p, context);
    enum font_status made = page_inset_add(p->text, &look, &shown, style);
    p->insets++;
    font_layout_finish(&shown);
    return made == FONT_OK ? READER_OK : pages_failed();
}

enum reader_status pages_width(struct reader_pages *p, const struct paragraph_text *t,
                               enum context context, double *width)
{
    enum reader_status status = READER_OK;
    *width = 0;
    for (int i = 0; i < t->spans_count && status == READER_OK; i++) {
        const struct line_span *s = &t->spans[i];
        const int face = (int)face_of(s->look);
        struct font_layout l = {0};
        bool set = true;
        if (s->look & READER_FORMULA)
            status = formula_layout(p, t, s, context, false, 0, &set, &l);
        else
            status = face_get(p, face);
        if (status == READER_OK && !(s->look & READER_FORMULA) &&
            font_shaper_layout(p->shapers[face], t->text + s->begin,
                               (size_t)(s->end - s->begin), size_of(p, context, s->look), NULL,
                               &l) != FONT_OK)
            status = pages_failed();
        if (status == READER_OK)
            *width += l.width_px * (s->look & READER_NOTE ? 0.65 : 1);
        font_layout_finish(&l);
    }
    return status;
}

enum reader_status pages_styles_apply(struct reader_pages *p, int id,
                                      const struct paragraph_text *t, enum context context,
                                      bool display, double most_px)
{
    enum reader_status status = READER_OK;
    int style;
    for (int i = 0; i < t->spans_count && status == READER_OK; i++) {
        const struct line_span *s = &t->spans[i];
        status = s->look & READER_FORMULA
                     ? formula_style(p, t, s, context, display, most_px, &style)
                     : pages_style(p, context, s->look, &style);
        if (status == READER_OK &&
            page_paragraph_style(p->text, id, s->begin, s->end, style) != FONT_OK)
            status = pages_failed();
    }
    return status;
}

/* ---- notes ---- */

/* All blocks of a note as one paragraph, its number before it. */
static bool note_text(const struct reader_pages *p, int note, struct paragraph_text *t)
{
    const struct reader_document *d = p->document;
    const struct reader_note *n = &d->notes[note];
    char number[16];
    int length = snprintf(number, sizeof number, "%d", note + 1);
    bool good = pages_text_add(t, number, length, READER_NOTE) && pages_text_add(t, " ", 1, 0);
    for (int i = 0; good && i < n->blocks_count; i++) {
        const struct reader_block *block = &d->note_blocks[n->first_block + i];
        const char *marker = block->marker;
        good = (i == 0 || pages_text_add(t, "\n", 1, 0)) &&
               (!marker || (pages_text_add(t, marker, (int)strlen(marker), 0) &&
                            pages_text_add(t, " ", 1, 0))) &&
               pages_block_add(t, block, 0, block->bytes, 0);
    }
    for (int k = 0; good && k < t->bytes; k++)
        if (t->text[k] == '\t')
            t->text[k] = ' ';
    return good;
}

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

/* Where a column is scrolled, a note that has no margin is a paragraph behind the one that
 * calls it, moved in. */
static enum reader_status note_put(struct reader_pages *p, bool margin, int id, int byte,
                                   const struct paragraph_text *t, struct page_manner *manner,
                                   int style, int *note_id)
{
    enum font_status status;
    if (!p->made || margin) {
        status = page_note_add(p->text, id, byte, margin ? PAGE_NOTE_MARGIN : PAGE_NOTE_FOOT,
                               t->text, (size_t)t->bytes, style, manner, note_id);
    } else {
        const double em = p->setup.size_px;
        manner->left_px = fmin(1.5 * em, pages_column(p) / 8);
        manner->before_px = manner->after_px = 0.3 * em;
        manner->role = FONT_ROLE_NOTE;
        status = page_paragraph_add(p->text, 0, p->at, t->text, (size_t)t->bytes, style, manner,
                                    note_id);
        p->at += status == FONT_OK;
    }
    return status == FONT_OK ? READER_OK : pages_failed();
}

static enum reader_status note_add(struct reader_pages *p, int note, int id, int byte,
                                   struct paragraph_text *t, int *note_id)
{
    const char *class = p->document->notes[note].class;
    bool margin = (p->made || strcmp(class, "margin") == 0) && pages_notes(p) > 0;
    struct page_manner manner = pages_manner(p, CONTEXT_NOTE);
    int style;
    if (margin)
        manner.align = FONT_ALIGN_START;
    enum reader_status status =
        note_text(p, note, t) ? pages_style(p, CONTEXT_NOTE, 0, &style) : pages_no_memory();
    if (status == READER_OK)
        status = note_put(p, margin, id, byte, t, &manner, style, note_id);
    if (status == READER_OK)
        status = pages_styles_apply(p, *note_id, t, CONTEXT_NOTE, true,
                                    margin ? pages_notes(p) : pages_column(p) - manner.left_px);
    return status;
}

/* Whether a note that is called is to be set now: once; where a column is scrolled, if it is
 * open in this passage. */
static bool note_wanted(struct reader_pages *p, int note)
{
    if (note < 0 || note >= p->document->notes_count || p->noted[note])
        return false;
    if (p->made && p->opened[note] != p->passage &&
        !(pages_notes(p) > 0 && strcmp(p->document->notes[note].class, "margin") == 0))
        return false;
    p->noted[note] = true;
    return true;
}

/* The note, and those that it calls, which stand behind it at the same place. */
static enum reader_status notes_chain(struct reader_pages *p, int note, int id, int byte)
{
    enum reader_status status = READER_OK;
    int *queue = NULL, count = 0, capacity = 0;
    if (!array_reserve(&queue, &capacity, 1, sizeof *queue))
        return pages_no_memory();
    queue[count++] = note;
    for (int k = 0; k < count && status == READER_OK; k++) {
        struct paragraph_text text = {0};
        int note_id;
        status = note_add(p, queue[k], id, byte, &text, &note_id);
        for (int s = 1; s < text.spans_count && status == READER_OK; s++) {
            int next = text.spans[s].note;
            if (!note_wanted(p, next))
                continue;
            if (!array_reserve(&queue, &capacity, count + 1, sizeof *queue))
                status = pages_no_memory();
            else
                queue[count++] = next;
        }
        if (status == READER_OK)
            status = pages_made_keep(p, note_id, queue[k], &text);
        pages_text_finish(&text);
    }
    free(queue);
    return status;
}

/* Each where it is called first. */
enum reader_status pages_notes_add(struct reader_pages *p, int id,
                                   const struct paragraph_text *t, int byte)
{
    enum reader_status status = READER_OK;
    for (int i = 0; i < t->spans_count && status == READER_OK; i++)
        if (note_wanted(p, t->spans[i].note))
            status = notes_chain(p, t->spans[i].note, id, byte >= 0 ? byte : t->spans[i].end);
    return status;
}

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
