/* layout.c - pages as glyphs in their places, and what is asked of pages: see page.h. */
#include "page_internal.h"

#include "../edges.h"

#include <stdlib.h>
#include <string.h>

/* A line's baseline, across the frame's lines. */
static double baseline(const struct paragraph *p, const struct slot *s)
{
    return s->v + p->rise_px;
}

struct output {
    struct page_text *t;
    const struct page_template *template;
    struct font_layout *out;
    int *inks; /* of the layout, by style; 0: not yet */
    struct font_map last;
    int last_number;
    /* What the page says, where it is asked for; the lines that are written are the paragraph's
     * bytes from `from` on, and begin at `begin`. */
    struct page_said *said;
    int said_capacity, passages_capacity, begin, from, end;
};

/* The first byte of a line, or of what follows the last. */
static int line_byte(const struct paragraph *p, int line)
{
    int letter = line < p->lines_count ? p->lines[line].begin : p->count;
    return letter < p->count ? p->letters[letter].byte : p->bytes;
}

/* Says a piece's lines. */
static bool piece_say(struct output *o, const struct piece *piece)
{
    const struct paragraph *p = piece->paragraph;
    struct page_said *said = o->said;
    o->from = line_byte(p, piece->begin);
    o->end = line_byte(p, piece->end);
    o->begin = 0;
    if (!said) {
        o->from = 0;
        o->end = p->bytes;
        return true;
    }
    int bytes = o->end - o->from, begin = (int)said->bytes;
    if (!array_reserve(&said->utf8, &o->said_capacity, begin + bytes + 2, 1) ||
        !array_reserve(&said->passages, &o->passages_capacity, said->passages_count + 1,
                       sizeof *said->passages))
        return false;
    o->begin = begin;
    memcpy(said->utf8 + begin, p->text + o->from, (size_t)bytes);
    said->bytes += (size_t)bytes;
    said->utf8[said->bytes++] = '\n';
    said->utf8[said->bytes] = '\0';
    said->passages[said->passages_count++] = (struct font_passage){
        .begin = (size_t)begin,
        .end = said->bytes,
        .role = p->flow < 0 && !p->beside ? FONT_ROLE_NOTE : p->manner.role,
        .level = p->manner.level,
        .paragraph = p->id};
    return true;
}

static int ink_of(struct output *o, int style)
{
    const struct page_style *look = &o->t->styles[style]->look;
    if (!look->inked)
        return 0;
    if (!o->inks[style])
        o->inks[style] = font_layout_ink_add(o->out, &look->ink);
    return o->inks[style];
}

/* The map of a glyph that is expanded, or lies in a vertical line; 0: none. */
static int map_of(struct output *o, bool vertical, bool upright, float scale)
{
    double s = (double)scale;
    struct font_map map = {FONT_AFFINE, {s, 0, 0, 0, 1, 0}};
    if (vertical && upright)
        map = (struct font_map){FONT_AFFINE, {1, 0, 0, 0, s, 0}};
    else if (vertical)
        map = (struct font_map){FONT_AFFINE, {0, -1, 0, s, 0, 0}};
    else if (s == 1)
        return 0;
    if (!o->last_number || memcmp(map.m, o->last.m, sizeof map.m) != 0) {
        o->last_number = font_layout_map_add(o->out, &map);
        o->last = map;
    }
    return o->last_number;
}

static bool line_put(struct output *o, const struct paragraph *p, const struct set_line *l,
                     const struct slot *slot, int line)
{
    struct font_layout *out = o->out;
    const struct page_frame *frame = &o->template->frames[slot->frame];
    double base = baseline(p, slot);
    if (!array_reserve(&out->glyphs, &out->glyphs_capacity, out->glyphs_count + l->glyphs_count,
                       sizeof *out->glyphs))
        return false;
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct set_glyph *g = &l->glyphs[i];
        const struct set_run *run = &p->runs[g->run];
        const struct style *style = o->t->styles[run->style];
        struct font_placed *to = &out->glyphs[out->glyphs_count++];
        struct font_face *face = style->shaper->faces[run->face].face;
        float scale = g->scale;
        if (run->face == 0 && !(frame->vertical && run->upright))
            face = widths_face(o->t, style, g->glyph, &scale);
        *to = (struct font_placed){
            .face = face,
            .glyph = g->glyph,
            .cluster =
                o->begin + (g->letter >= 0 ? p->letters[g->letter].byte : o->end) - o->from,
            .line = line,
            .size_px = (float)style->look.size_px,
            .ink = ink_of(o, run->style),
            .map = map_of(o, frame->vertical, run->upright, scale)};
        slot_point(o->template, slot, slot->u0 + (double)g->u, base - (double)g->v, &to->x_px,
                   &to->y_px);
        if (style->is_inset && g->letter >= 0) {
            const struct font_placed as = *to;
            out->glyphs_count--;
            if (!inset_put(style, as.x_px, as.y_px, &as, out) ||
                !array_reserve(&out->glyphs, &out->glyphs_capacity,
                               out->glyphs_count + l->glyphs_count, sizeof *out->glyphs))
                return false;
        } else if (g->glyph == 0 && g->letter >= 0) {
            font_layout_missing_add(out, p->letters[g->letter].character);
        }
    }
    return true;
}

static enum font_status page_put(struct page_text *t, int page, struct output *o)
{
    struct set_line l = {0};
    const struct page *from = &t->pages[page];
    enum font_status status = FONT_OK;
    bool ok = true;
    int line = 0;
    for (int i = 0; ok && status == FONT_OK && i < from->pieces_count; i++) {
        const struct piece *piece = &from->pieces[i];
        ok = piece_say(o, piece);
        for (int k = piece->begin; ok && status == FONT_OK && k < piece->end; k++) {
            const struct slot *slot = &from->slots[piece->slots_begin + k - piece->begin];
            status = font_patience_ask(line);
            if (status == FONT_OK)
                status = line_set(t, piece->paragraph, &piece->paragraph->lines[k],
                                  slot->u1 - slot->u0, &l);
            ok = status != FONT_OK || line_put(o, piece->paragraph, &l, slot, line++);
        }
    }
    set_line_finish(&l);
    return status == FONT_OK && !ok ? font_fail(FONT_NO_MEMORY, "no memory for a page")
                                    : status;
}

/* Says a running line: it is nothing of the text's own. */
static bool running_say(struct output *o, const char *text, size_t bytes)
{
    struct page_said *said = o->said;
    o->begin = 0;
    if (!said)
        return true;
    int begin = (int)said->bytes;
    if (!array_reserve(&said->utf8, &o->said_capacity, begin + (int)bytes + 2, 1) ||
        !array_reserve(&said->passages, &o->passages_capacity, said->passages_count + 1,
                       sizeof *said->passages))
        return false;
    memcpy(said->utf8 + begin, text, bytes);
    said->utf8[begin + (int)bytes] = '\n';
    said->utf8[begin + (int)bytes + 1] = '\0';
    said->bytes += bytes + 1;
    o->begin = begin;
    said->passages[said->passages_count++] = (struct font_passage){.begin = (size_t)begin,
                                                                   .end = said->bytes,
                                                                   .role = FONT_ROLE_ARTIFACT,
                                                                   .paragraph = -1};
    return true;
}

static enum font_status running_put(struct output *o, const struct page_running *running,
                                    const char *text, size_t bytes)
{
    const struct style *style = o->t->styles[running->style];
    struct font_layout line, *out = o->out;
    const struct font_text_options options = {.features = style->features,
                                              .language = style->language,
                                              .letter_spacing_px = style->look.spacing_px};
    enum font_status status =
        font_shaper_layout(style->shaper, text, bytes, style->look.size_px, &options, &line);
    if (status != FONT_OK)
        return status;
    double left = running->x1 - running->x0 - line.width_px;
    double part = running->align == FONT_ALIGN_RIGHT    ? 1
                  : running->align == FONT_ALIGN_CENTER ? 0.5
                                                        : 0;
    int number = out->glyphs_count ? out->glyphs[out->glyphs_count - 1].line + 1 : 0;
    bool ok = running_say(o, text, bytes) &&
              array_reserve(&out->glyphs, &out->glyphs_capacity,
                            out->glyphs_count + line.glyphs_count, sizeof *out->glyphs);
    for (int i = 0; ok && i < line.glyphs_count; i++) {
        struct font_placed *to = &out->glyphs[out->glyphs_count++];
        *to = line.glyphs[i];
        to->x_px += running->x0 + part * left;
        to->y_px += running->y;
        to->cluster += o->begin;
        to->line += number;
        to->size_px = (float)style->look.size_px;
        to->ink = ink_of(o, running->style);
    }
    font_layout_finish(&line);
    return ok ? FONT_OK : font_fail(FONT_NO_MEMORY, "no memory for a page");
}

static enum font_status runnings_put(struct output *o, int page)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < o->t->running_count && status == FONT_OK; i++) {
        char *text;
        size_t bytes;
        if (!running_text(o->t, page, &o->t->running[i], &text, &bytes))
            status = font_fail(FONT_NO_MEMORY, "no memory for a page");
        else if (bytes)
            status = running_put(o, &o->t->running[i], text, bytes);
        free(text);
    }
    return status;
}

static enum font_status page_output(struct page_text *t, int page, struct output *o)
{
    *o->out = (struct font_layout){0};
    enum font_status status = flow_fill(t, page);
    if (status != FONT_OK)
        return status;
    o->template = flow_template(t, page);
    o->inks = calloc((size_t)t->styles_count + 1, sizeof *o->inks);
    o->out->width_px = o->template->width_px;
    o->out->size_px = t->styles_count ? t->styles[0]->look.size_px : 1;
    status = o->inks ? page_put(t, page, o) : font_fail(FONT_NO_MEMORY, "no memory for a page");
    if (status == FONT_OK)
        status = runnings_put(o, page);
    free(o->inks);
    if (status != FONT_OK)
        font_layout_finish(o->out);
    return status;
}

enum font_status page_layout(struct page_text *t, int page, struct font_layout *out)
{
    struct output o = {.t = t, .out = out};
    return page_output(t, page, &o);
}

enum font_status page_layout_said(struct page_text *t, int page, struct font_layout *out,
                                  struct page_said *said)
{
    struct output o = {.t = t, .out = out, .said = said};
    *said = (struct page_said){0};
    enum font_status status = page_output(t, page, &o);
    if (status == FONT_OK && !said->utf8 && !(said->utf8 = calloc(1, 1))) {
        font_layout_finish(out);
        status = font_fail(FONT_NO_MEMORY, "no memory for a page");
    }
    if (status != FONT_OK)
        page_said_finish(said);
    return status;
}

void page_said_finish(struct page_said *said)
{
    free(said->utf8);
    free(said->passages);
    *said = (struct page_said){0};
}

enum font_status page_count(struct page_text *t, int *count)
{
    *count = 0;
    for (;; ++*count) {
        enum font_status status = flow_fill(t, *count);
        if (status != FONT_OK)
            return status;
        if (t->pages[*count].last) {
            ++*count;
            return FONT_OK;
        }
    }
}

/* The paragraph's line that a byte is in. before: where a line ends and the next begins there,
 * the one that ends. */
int layout_line(const struct paragraph *p, int byte, bool before)
{
    int line = 0, behind = p->lines_count > 0 ? p->lines_count : 1; /* by halves */
    while (behind - line > 1) {
        int half = line + (behind - line) / 2, begins = line_byte(p, half);
        if (byte < begins || (byte == begins && before))
            behind = half;
        else
            line = half;
    }
    return line;
}

static const struct slot *slot_of(const struct page *page, const struct paragraph *p, int line)
{
    for (int i = 0; i < page->pieces_count; i++) {
        const struct piece *piece = &page->pieces[i];
        if (piece->paragraph == p && line >= piece->begin && line < piece->end)
            return &page->slots[piece->slots_begin + line - piece->begin];
    }
    return NULL;
}

enum font_status layout_find(struct page_text *t, struct page_place place, bool before,
                             int *page, int *line, struct slot *slot)
{
    const struct paragraph *p = story_paragraph(t, place.paragraph);
    if (!p || place.byte < 0 || place.byte > p->bytes)
        return font_fail(FONT_BAD_ARGUMENT, "there is no byte %d of a paragraph %d", place.byte,
                         place.paragraph);
    const struct paragraph *owner = p->flow < 0 ? t->by_id[p->owner] : p;
    int from =
        owner->first_page >= 0 && owner->first_page < t->pages_good ? owner->first_page : 0;
    for (int k = from;; k++) {
        enum font_status status = flow_fill(t, k);
        if (status != FONT_OK)
            return status;
        *line = p->broken ? layout_line(p, place.byte, before) : 0;
        const struct slot *found = p->broken ? slot_of(&t->pages[k], p, *line) : NULL;
        if (found) {
            *slot = *found;
            *page = k;
            return FONT_OK;
        }
        if (t->pages[k].last)
            return font_fail(FONT_BAD_ARGUMENT,
                             "paragraph %d stands on no page: its flow has no frame "
                             "with room for it",
                             place.paragraph);
    }
}

enum font_status page_find(struct page_text *t, struct page_place place, int *page)
{
    struct slot slot;
    int line;
    return layout_find(t, place, false, page, &line, &slot);
}

void page_stats_get(const struct page_text *t, struct page_stats *out)
{
    *out = t->stats;
    out->bytes = sizeof *t;
    for (int i = 0; i < t->ids_count; i++) {
        const struct paragraph *p = t->by_id[i];
        if (p)
            out->bytes +=
                sizeof *p + (size_t)p->bytes +
                (size_t)p->letters_capacity * (sizeof *p->letters + sizeof *p->characters) +
                (size_t)p->glyphs_capacity * sizeof *p->glyphs +
                (size_t)p->runs_capacity * sizeof *p->runs +
                (size_t)p->lines_capacity * sizeof *p->lines + lines_bytes(p);
    }
    for (int i = 0; i < t->pages_count; i++)
        out->bytes += (size_t)t->pages[i].pieces_capacity * sizeof(struct piece) +
                      (size_t)t->pages[i].slots_capacity * sizeof(struct slot);
}
