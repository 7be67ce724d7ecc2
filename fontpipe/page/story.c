/* story.c - the text itself: styles, paragraphs, changes of them, notes, marks. See page.h. */
#include "page_internal.h"

#include <edits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum font_status no_memory(void)
{
    return font_fail(FONT_NO_MEMORY, "no memory for a text");
}

enum font_status page_text_create(struct page_text **out)
{
    struct page_text *t = calloc(1, sizeof *t);
    *out = t;
    if (!t)
        return no_memory();
    t->buffer = hb_buffer_create();
    t->last_filled = -1;
    return FONT_OK;
}

void page_text_colour(struct page_text *t)
{
    t->colour = true;
}

static void paragraph_free(struct paragraph *p)
{
    if (!p)
        return;
    set_forget(p);
    free(p->text);
    free(p->spans);
    for (int i = 0; i < p->notes_count; i++)
        beside_free(p->notes[i].beside);
    free(p->notes);
    obstacles_free(p);
    free(p->marks);
    free(p->lines);
    free(p->widths);
    free(p);
}

static void style_free(struct style *s)
{
    free(s->font);
    free(s->axes);
    free(s->features);
    free(s->language);
    free(s->filter);
    font_layout_finish(&s->shown);
    free(s);
}

void page_text_destroy(struct page_text *t)
{
    if (!t)
        return;
    for (int i = 0; i < t->ids_count; i++)
        paragraph_free(t->by_id[i]);
    for (int i = 0; i < FLOWS_MAX; i++)
        free(t->flows[i].paragraphs);
    for (int i = 0; i < t->pages_count; i++) {
        free(t->pages[i].pieces);
        free(t->pages[i].slots);
    }
    for (int i = 0; i < t->styles_count; i++)
        style_free(t->styles[i]);
    for (int i = 0; i < t->faces_count; i++) {
        font_shaper_destroy(t->faces[i].shaper);
        font_face_close(t->faces[i].face);
        free(t->faces[i].name);
    }
    running_finish(t);
    templates_finish(t);
    free(t->styles);
    free(t->faces);
    widths_finish(t);
    free(t->by_id);
    free(t->marks_of);
    free(t->pages);
    hb_buffer_destroy(t->buffer);
    free(t);
}

/* ---- styles ---- */

struct page_style page_style_default(void)
{
    return (struct page_style){.font = "DejaVuSerif", .size_px = 16};
}

struct page_manner page_manner_default(void)
{
    return (struct page_manner){
        .align = FONT_ALIGN_START, .tolerance = 200, .orphans = 2, .widows = 2};
}

static bool text_copy(const char *from, char **to)
{
    *to = from ? strdup(from) : NULL;
    return !from || *to;
}

/* The face and its shaper, opened if no style has it yet. */
static enum font_status face_share(struct page_text *t, const struct page_style *look,
                                   struct font_shaper **shaper, struct font_face **face)
{
    char *name;
    if (asprintf(&name, "%s\n%s\n%s", look->font, look->axes ? look->axes : "",
                 look->filter ? look->filter : "") < 0)
        return no_memory();
    for (int i = 0; i < t->faces_count; i++)
        if (strcmp(t->faces[i].name, name) == 0) {
            *shaper = t->faces[i].shaper;
            *face = t->faces[i].face;
            free(name);
            return FONT_OK;
        }
    if (!array_reserve(&t->faces, &t->faces_capacity, t->faces_count + 1, sizeof *t->faces)) {
        free(name);
        return no_memory();
    }
    struct shared_face *s = &t->faces[t->faces_count];
    *s = (struct shared_face){.name = name};
    enum font_status status = font_edits_open(look->font, 0, t->colour, &s->face);
    if (status == FONT_OK)
        status = font_face_axes_set(s->face, look->axes);
    if (status == FONT_OK)
        status = style_filter_set(look, s->face);
    if (status == FONT_OK)
        status = font_shaper_create(s->face, &s->shaper);
    if (status == FONT_OK && t->colour)
        font_shaper_colour(s->shaper);
    if (status != FONT_OK) {
        font_shaper_destroy(s->shaper);
        font_face_close(s->face);
        free(s->name);
        return status;
    }
    t->faces_count++;
    *shaper = s->shaper;
    *face = s->face;
    return FONT_OK;
}

static enum font_status features_read(struct style *s)
{
    enum { MAX = sizeof s->hb_features / sizeof *s->hb_features };
    for (const char *at = s->features; at && *at;) {
        const char *end = strchr(at, ',');
        int length = end ? (int)(end - at) : (int)strlen(at);
        if (s->features_count == MAX ||
            !font_feature_read(at, length, &s->hb_features[s->features_count++]))
            return font_fail(FONT_BAD_ARGUMENT,
                             "there is no feature '%.*s'; they are like kern=0, -liga, ss01",
                             length > 40 ? 40 : length, at);
        at = end ? end + 1 : NULL;
    }
    return FONT_OK;
}

static enum font_status look_check(const struct page_style *look)
{
    if (!look->font || !*look->font)
        return font_fail(FONT_BAD_ARGUMENT, "a style needs a font");
    if (!(look->size_px >= 0.1 && look->size_px <= FONT_SIDE_MAX))
        return font_fail(FONT_BAD_ARGUMENT, "a size must be 0.1..%d pixels (got %g)",
                         FONT_SIDE_MAX, look->size_px);
    if (!(fabs(look->raise_px) <= 1e5 && fabs(look->spacing_px) <= 1e5))
        return font_fail(FONT_BAD_ARGUMENT,
                         "letters are raised and spaced by at most 1e5 pixels (got %g, %g)",
                         look->raise_px, look->spacing_px);
    return look->inked ? font_ink_check(&look->ink) : FONT_OK;
}

enum font_status page_style_add(struct page_text *t, const struct page_style *look, int *out)
{
    struct font_face *face = NULL;
    struct font_face_info info;
    *out = -1;
    enum font_status status = look_check(look);
    if (status != FONT_OK)
        return status;
    if (t->styles_count == INT16_MAX ||
        !array_reserve(&t->styles, &t->styles_capacity, t->styles_count + 1, sizeof *t->styles))
        return no_memory();
    struct style *s = calloc(1, sizeof *s);
    if (!s)
        return no_memory();
    s->look = *look;
    if (!text_copy(look->font, &s->font) || !text_copy(look->axes, &s->axes) ||
        !text_copy(look->features, &s->features) || !text_copy(look->language, &s->language) ||
        !text_copy(look->filter, &s->filter))
        status = no_memory();
    s->look.font = s->font; /* ours, for as long as the style is */
    s->look.axes = s->axes;
    s->look.features = s->features;
    s->look.language = s->language;
    s->look.filter = s->filter;
    if (status == FONT_OK)
        status = features_read(s);
    if (status == FONT_OK)
        status = face_share(t, look, &s->shaper, &face);
    if (status != FONT_OK) {
        style_free(s);
        return status;
    }
    font_face_describe(face, &info);
    double scale = look->size_px / info.units_per_em;
    s->ascent_px = info.ascender * scale;
    s->descent_px = -info.descender * scale;
    s->leading_px = info.line_height * scale;
    s->hb_language =
        s->language ? hb_language_from_string(s->language, -1) : hb_language_get_default();
    *out = t->styles_count;
    t->styles[t->styles_count++] = s;
    return FONT_OK;
}

/* ---- paragraphs ---- */

struct paragraph *story_paragraph(const struct page_text *t, int id)
{
    return id >= 0 && id < t->ids_count ? t->by_id[id] : NULL;
}

static enum font_status no_paragraph(int id)
{
    return font_fail(FONT_BAD_ARGUMENT, "there is no paragraph %d", id);
}

static enum font_status manner_check(const struct page_manner *m)
{
    const double lengths[] = {m->leading_px, m->indent_px, m->left_px,
                              m->right_px,   m->before_px, m->after_px};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
        if (!(fabs(lengths[i]) <= 1e6))
            return font_fail(FONT_BAD_ARGUMENT,
                             "a paragraph's lengths are within 1e6 pixels (got %g)",
                             lengths[i]);
    if (m->leading_px < 0 || m->before_px < 0 || m->after_px < 0)
        return font_fail(FONT_BAD_ARGUMENT,
                         "lines and paragraphs follow downwards: no distance is "
                         "below 0");
    if (!(m->protrude >= 0 && m->protrude <= 1 && m->expand >= 0 && m->expand <= 0.05))
        return font_fail(
            FONT_BAD_ARGUMENT,
            "signs protrude by 0..1 and letters are expanded by 0..0.05 (got %g, %g)",
            m->protrude, m->expand);
    if (!(m->tolerance >= 0 && m->tolerance <= BREAK_INFINITE) || m->orphans < 0 ||
        m->orphans > 100 || m->widows < 0 || m->widows > 100 || m->tabs_count < 0 ||
        m->tabs_count > PAGE_TABS_MAX || (unsigned)m->align > FONT_ALIGN_JUSTIFY)
        return font_fail(FONT_BAD_ARGUMENT,
                         "a paragraph's tolerance is 0..%d, its orphans and widows 0..100, its "
                         "tabs at most %d (got %g; %d, %d; %d)",
                         BREAK_INFINITE, PAGE_TABS_MAX, m->tolerance, m->orphans, m->widows,
                         m->tabs_count);
    for (int i = 0; i < m->tabs_count; i++)
        if (!(m->tabs[i].x_px >= 0 && m->tabs[i].x_px <= 1e6))
            return font_fail(FONT_BAD_ARGUMENT, "a tab is at 0..1e6 pixels (got %g)",
                             m->tabs[i].x_px);
    if (m->begins_page < 0 || m->begins_page > TEMPLATES_MAX ||
        !(m->page_depth_px >= 0 && m->page_depth_px <= 1e6))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a page begins by template 1..%d, and its frames are at most 0..1e6 "
                         "pixels deep (got %d, %g)",
                         TEMPLATES_MAX, m->begins_page, m->page_depth_px);
    return FONT_OK;
}

static enum font_status paragraph_make(struct page_text *t, const char *utf8, size_t bytes,
                                       int style, const struct page_manner *manner,
                                       struct paragraph **out)
{
    *out = NULL;
    enum font_status status = manner_check(manner);
    if (status != FONT_OK)
        return status;
    if (style < 0 || style >= t->styles_count)
        return font_fail(FONT_BAD_ARGUMENT, "there is no style %d", style);
    if (bytes > LETTERS_MAX)
        return font_fail(FONT_TOO_LARGE, "a paragraph is at most %d bytes (got %zu)",
                         LETTERS_MAX, bytes);
    struct paragraph *p = calloc(1, sizeof *p);
    if (!p)
        return no_memory();
    *p = (struct paragraph){.bytes = (int)bytes,
                            .manner = *manner,
                            .style = style,
                            .flow = -1,
                            .first_page = -1,
                            .owner = -1};
    p->text = malloc(bytes + 1);
    if (!p->text || !array_reserve(&p->spans, &p->spans_capacity, 1, sizeof *p->spans) ||
        !array_reserve(&t->by_id, &t->ids_capacity, t->ids_count + 1, sizeof *t->by_id)) {
        paragraph_free(p);
        return no_memory();
    }
    memcpy(p->text, utf8, bytes);
    p->text[bytes] = '\0';
    p->spans[p->spans_count++] = (struct span){0, style};
    p->id = t->ids_count;
    t->by_id[t->ids_count++] = p;
    *out = p;
    return FONT_OK;
}

enum font_status page_paragraph_add(struct page_text *t, int flow, int at, const char *utf8,
                                    size_t bytes, int style, const struct page_manner *manner,
                                    int *id)
{
    *id = -1;
    if (flow < 0 || flow >= FLOWS_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "flows are 0..%d (got %d)", FLOWS_MAX - 1, flow);
    struct flow *f = &t->flows[flow];
    at = at < 0 ? f->count : at;
    if (at > f->count)
        return font_fail(FONT_BAD_ARGUMENT, "flow %d has %d paragraphs (got %d)", flow,
                         f->count, at);
    if (!array_reserve(&f->paragraphs, &f->capacity, f->count + 1, sizeof *f->paragraphs))
        return no_memory();
    struct paragraph *p;
    enum font_status status = paragraph_make(t, utf8, bytes, style, manner, &p);
    if (status != FONT_OK)
        return status;
    flow_moved(t, flow, at);
    memmove(f->paragraphs + at + 1, f->paragraphs + at,
            (size_t)(f->count - at) * sizeof *f->paragraphs);
    f->paragraphs[at] = p;
    f->count++;
    for (int i = at; i < f->count; i++)
        f->paragraphs[i]->at = i;
    p->flow = flow;
    p->vertical = templates_vertical(t, flow);
    *id = p->id;
    return FONT_OK;
}

static void paragraph_gone(struct page_text *t, struct paragraph *p)
{
    for (int i = 0; i < p->marks_count; i++)
        t->marks_of[p->marks[i].id] = -1;
    t->stats.lines_overfull -= p->overfull;
    t->besides_count -= p->beside + p->obstacles_count;
    t->by_id[p->id] = NULL;
    paragraph_free(p);
}

enum font_status page_paragraph_remove(struct page_text *t, int id)
{
    struct paragraph *p = story_paragraph(t, id);
    if (!p)
        return no_paragraph(id);
    if (p->flow < 0) { /* a note */
        struct paragraph *owner = t->by_id[p->owner];
        flow_changed(t, owner);
        int kept = 0;
        for (int i = 0; i < owner->notes_count; i++)
            if (owner->notes[i].paragraph != p)
                owner->notes[kept++] = owner->notes[i];
            else
                beside_free(owner->notes[i].beside);
        owner->notes_count = kept;
        paragraph_gone(t, p);
        return FONT_OK;
    }
    struct flow *f = &t->flows[p->flow];
    flow_moved(t, p->flow, p->at);
    memmove(f->paragraphs + p->at, f->paragraphs + p->at + 1,
            (size_t)(f->count - p->at - 1) * sizeof *f->paragraphs);
    f->count--;
    for (int i = p->at; i < f->count; i++)
        f->paragraphs[i]->at = i;
    for (int i = 0; i < p->notes_count; i++)
        paragraph_gone(t, p->notes[i].paragraph);
    paragraph_gone(t, p);
    return FONT_OK;
}

/* It is to be set anew. */
static void paragraph_changed(struct page_text *t, struct paragraph *p)
{
    flow_changed(t, p);
    set_forget(p);
}

enum font_status page_paragraph_manner(struct page_text *t, int id, const struct page_manner *m)
{
    struct paragraph *p = story_paragraph(t, id);
    enum font_status status = p ? manner_check(m) : no_paragraph(id);
    if (status != FONT_OK)
        return status;
    p->manner = *m;
    paragraph_changed(t, p);
    return FONT_OK;
}

static bool is_boundary(const struct paragraph *p, int byte)
{
    return byte >= 0 && byte <= p->bytes &&
           (byte == p->bytes || ((unsigned char)p->text[byte] & 0xc0) != 0x80);
}

/* The first span that begins at the byte or behind it. */
static int span_from(const struct paragraph *p, int byte)
{
    int low = 0, high = p->spans_count;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (p->spans[middle].begin < byte)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The style of the letter at the byte. */
static int style_at(const struct paragraph *p, int byte)
{
    int behind = span_from(p, byte + 1);
    return p->spans[behind ? behind - 1 : 0].style;
}

/* Spans that are empty, and those like the one before, go, from span `first` on; those before
 * it are tidy. */
static void spans_tidy(struct paragraph *p, int first)
{
    int kept = first;
    for (int i = first; i < p->spans_count; i++) {
        if (kept && p->spans[kept - 1].begin == p->spans[i].begin)
            kept--;
        if (kept && p->spans[kept - 1].style == p->spans[i].style)
            continue;
        p->spans[kept++] = p->spans[i];
    }
    if (kept > 1 && p->spans[kept - 1].begin >= p->bytes)
        kept--;
    p->spans_count = kept;
}

enum font_status page_paragraph_style(struct page_text *t, int id, int begin, int end,
                                      int style)
{
    struct paragraph *p = story_paragraph(t, id);
    if (!p)
        return no_paragraph(id);
    if (style < 0 || style >= t->styles_count)
        return font_fail(FONT_BAD_ARGUMENT, "there is no style %d", style);
    if (begin > end || !is_boundary(p, begin) || !is_boundary(p, end))
        return font_fail(FONT_BAD_ARGUMENT, "%d..%d are no characters of paragraph %d", begin,
                         end, id);
    if (begin == end)
        return FONT_OK;
    if (!array_reserve(&p->spans, &p->spans_capacity, p->spans_count + 2, sizeof *p->spans))
        return no_memory();
    const int kept = span_from(p, begin), next = span_from(p, end + 1), n = p->spans_count;
    const struct span rest[2] = {{begin, style}, {end, style_at(p, end)}};
    memmove(p->spans + kept + 2, p->spans + next, (size_t)(n - next) * sizeof *p->spans);
    memcpy(p->spans + kept, rest, sizeof rest);
    p->spans_count = kept + 2 + n - next;
    spans_tidy(p, kept);
    paragraph_changed(t, p);
    return FONT_OK;
}

/* Where a byte is after `removed` bytes at `at` have given place to `put`. */
static int moved(int byte, int at, int removed, int put, bool after)
{
    if (byte < at || (byte == at && !after))
        return byte;
    if (byte >= at + removed)
        return byte + put - removed;
    return after ? at + put : at;
}

enum font_status page_text_replace(struct page_text *t, int id, int byte, int removed,
                                   const char *utf8, size_t bytes)
{
    struct paragraph *p = story_paragraph(t, id);
    if (!p)
        return no_paragraph(id);
    if (removed < 0 || removed > p->bytes - byte || !is_boundary(p, byte) ||
        !is_boundary(p, byte + removed))
        return font_fail(FONT_BAD_ARGUMENT, "%d bytes at %d are no characters of paragraph %d",
                         removed, byte, id);
    if (bytes > LETTERS_MAX || (size_t)p->bytes + bytes > LETTERS_MAX)
        return font_fail(FONT_TOO_LARGE, "a paragraph is at most %d bytes", LETTERS_MAX);
    int put = (int)bytes, left = p->bytes - byte - removed;
    char *text = malloc((size_t)(byte + put + left) + 1);
    if (!text)
        return no_memory();
    memcpy(text, p->text, (size_t)byte);
    memcpy(text + byte, utf8, bytes);
    memcpy(text + byte + put, p->text + byte + removed, (size_t)left + 1);
    flow_changed(t, p);
    renew_edited(p, byte, removed);
    free(p->text);
    p->text = text;
    p->bytes = byte + put + left;
    for (int i = 1; i < p->spans_count; i++) /* what is put in goes with the letter before */
        p->spans[i].begin = moved(p->spans[i].begin, byte, removed, put, true);
    spans_tidy(p, 0);
    for (int i = 0; i < p->marks_count; i++)
        p->marks[i].byte = moved(p->marks[i].byte, byte, removed, put, p->marks[i].after);
    for (int i = 0; i < p->notes_count; i++)
        p->notes[i].byte = moved(p->notes[i].byte, byte, removed, put, false);
    return FONT_OK;
}

const char *page_paragraph_text(const struct page_text *t, int id, size_t *bytes)
{
    const struct paragraph *p = story_paragraph(t, id);
    *bytes = p ? (size_t)p->bytes : 0;
    return p ? p->text : NULL;
}

int page_paragraph_at(const struct page_text *t, int flow, int at)
{
    return flow >= 0 && flow < FLOWS_MAX && at >= 0 && at < t->flows[flow].count
               ? t->flows[flow].paragraphs[at]->id
               : -1;
}

enum font_status story_note_add(struct page_text *t, int id, const struct note *note,
                                const char *utf8, size_t bytes, int style,
                                const struct page_manner *manner, int *note_id)
{
    struct paragraph *owner = story_paragraph(t, id), *p = NULL;
    enum font_status status = FONT_OK;
    *note_id = -1;
    if (!owner || owner->flow < 0)
        status = owner ? font_fail(FONT_BAD_ARGUMENT, "a note has no notes") : no_paragraph(id);
    else if (!note->beside && !is_boundary(owner, note->byte))
        status = font_fail(FONT_BAD_ARGUMENT, "byte %d is no character of paragraph %d",
                           note->byte, id);
    else if (!array_reserve(&owner->notes, &owner->notes_capacity, owner->notes_count + 1,
                            sizeof *owner->notes))
        status = no_memory();
    if (status == FONT_OK)
        status = paragraph_make(t, utf8, bytes, style, manner, &p);
    if (status != FONT_OK) {
        beside_free(note->beside);
        return status;
    }
    p->owner = id;
    p->vertical = owner->vertical;
    p->beside = note->beside != NULL;
    t->besides_count += p->beside;
    int at = owner->notes_count++; /* in the order of their places */
    for (; at > 0 && owner->notes[at - 1].byte > note->byte; at--)
        owner->notes[at] = owner->notes[at - 1];
    owner->notes[at] = *note;
    owner->notes[at].paragraph = p;
    flow_changed(t, owner);
    *note_id = p->id;
    return FONT_OK;
}

enum font_status page_note_add(struct page_text *t, int id, int byte, enum page_note kind,
                               const char *utf8, size_t bytes, int style,
                               const struct page_manner *manner, int *note_id)
{
    const struct note note = {.byte = byte, .kind = kind};
    return story_note_add(t, id, &note, utf8, bytes, style, manner, note_id);
}
