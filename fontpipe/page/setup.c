/* setup.c - see setup.h. */
#include "setup.h"

#include "emphasis.h"
#include "family.h"
#include "page_internal.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum look {
    ROMAN,
    ITALIC,
    BOLD,
    HEAD,
    SMALL_HEAD,
    NOTE,
    NOTE_ITALIC,
    NOTE_BOLD,
    RAISED,
    NOTE_RAISED,
    LOOKS
};

struct making {
    const struct page_setup *setup;
    struct page_text *text;
    int styles[LOOKS];
    char family_italic[512], family_bold[512];
    /* The paragraph that is read: its letters, the looks of them, its notes. */
    char *letters;
    int count, capacity;
    struct {
        int begin;
        enum look look;
    } * spans;
    int spans_count, spans_capacity;
    struct {
        int byte, from, end, number;
        bool margin;
    } * notes;
    int notes_count, notes_capacity, number;
    bool behind_head;
};

struct page_setup page_setup_default(void)
{
    return (struct page_setup){.font = "DejaVuSerif",
                               .size_px = 16,
                               .width_px = 600,
                               .height_px = 840,
                               .margin_px = 60,
                               .gap_px = 24,
                               .columns = 1,
                               .align = FONT_ALIGN_JUSTIFY,
                               .indent_em = 1.2,
                               .tolerance = 200};
}

#define NUMBER(name, member, least, most, whole)                                               \
    {                                                                                          \
        name, least, most, offsetof(struct page_setup, member), whole                          \
    }
const struct page_number page_numbers[] = {
    NUMBER("size", size_px, 1, 1000, false),
    NUMBER("width", width_px, 16, 16384, false),
    NUMBER("height", height_px, 16, 16384, false),
    NUMBER("margin", margin_px, 0, 8000, false),
    NUMBER("gap", gap_px, 0, 8000, false),
    NUMBER("columns", columns, 1, PAGE_FRAMES_MAX, true),
    NUMBER("notes", notes_px, 0, 8000, false),
    NUMBER("leading", leading, 0, 10, false),
    NUMBER("indent", indent_em, 0, 20, false),
    NUMBER("protrude", protrude, 0, 1, false),
    NUMBER("expand", expand, 0, 0.05, false),
    NUMBER("tolerance", tolerance, 0, 10000, false),
};
#undef NUMBER
const int page_numbers_count = sizeof page_numbers / sizeof *page_numbers;

const char *page_part_name(enum page_part part)
{
    static const char *const names[PAGE_PARTS] = {"text", "italic", "bold", "head", "note"};
    return names[part];
}

static enum font_status styles_make(struct making *m)
{
    const struct page_setup *s = m->setup;
    const char *italic = s->italic ? s->italic
                                   : page_family_face(s->font, "Italic", m->family_italic,
                                                      sizeof m->family_italic);
    const char *bold =
        s->bold ? s->bold
                : page_family_face(s->font, "Bold", m->family_bold, sizeof m->family_bold);
    const struct {
        const char *font;
        double size, raise;
        enum page_part part;
    } looks[LOOKS] = {[ROMAN] = {s->font, 1, 0, PAGE_PART_TEXT},
                      [ITALIC] = {italic, 1, 0, PAGE_PART_ITALIC},
                      [BOLD] = {bold, 1, 0, PAGE_PART_BOLD},
                      [HEAD] = {s->font, 1.6, 0, PAGE_PART_HEAD},
                      [SMALL_HEAD] = {bold, 1.1, 0, PAGE_PART_HEAD},
                      [NOTE] = {s->font, 0.8, 0, PAGE_PART_NOTE},
                      [NOTE_ITALIC] = {italic, 0.8, 0, PAGE_PART_NOTE},
                      [NOTE_BOLD] = {bold, 0.8, 0, PAGE_PART_NOTE},
                      [RAISED] = {s->font, 0.65, 0.35, PAGE_PART_TEXT},
                      [NOTE_RAISED] = {s->font, 0.55, 0.28, PAGE_PART_NOTE}};
    for (int i = 0; i < LOOKS; i++) {
        const struct page_style style = {.font = looks[i].font,
                                         .features = s->features,
                                         .language = s->language,
                                         .size_px = looks[i].size * s->size_px,
                                         .raise_px = looks[i].raise * s->size_px,
                                         .inked = s->inked,
                                         .ink = s->ink,
                                         .filter = s->filters[looks[i].part]};
        enum font_status status = page_style_add(m->text, &style, &m->styles[i]);
        if (status != FONT_OK)
            return status;
    }
    return FONT_OK;
}

static enum font_status template_make(const struct making *m)
{
    const struct page_setup *s = m->setup;
    struct page_template t = {.width_px = s->width_px, .height_px = s->height_px};
    if (s->columns < 1 || s->columns > PAGE_FRAMES_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a page has 1..%d columns (got %d)",
                         PAGE_FRAMES_MAX, s->columns);
    if (s->shapes_count > PAGE_SHAPES_MAX)
        return font_fail(FONT_BAD_ARGUMENT, "a page has at most %d shapes (got %d)",
                         PAGE_SHAPES_MAX, s->shapes_count);
    double width = s->width_px - 2 * s->margin_px, height = s->height_px - 2 * s->margin_px;
    double beside = s->vertical ? s->height_px : s->width_px; /* the page along its lines */
    double between = (s->columns - 1) * s->gap_px;
    if (s->vertical) /* columns lie above each other */
        height = (height - s->notes_px - between) / s->columns;
    else
        width = (width - s->notes_px - between) / s->columns;
    if (!(width >= s->size_px && height >= s->size_px))
        return font_fail(FONT_BAD_ARGUMENT,
                         "columns of %.0fx%.0f pixels are too small for letters of %g", width,
                         height, s->size_px);
    for (int i = 0; i < s->columns; i++)
        t.frames[t.frames_count++] = (struct page_frame){
            .x = s->margin_px + (s->vertical ? 0 : i * (width + s->gap_px)),
            .y = s->margin_px + (s->vertical ? i * (height + s->gap_px) : 0),
            .width = width,
            .height = height,
            .vertical = s->vertical,
            .margin_x = beside - s->margin_px - s->notes_px + s->gap_px / 2,
            .margin_width = s->notes_px > 0 ? fmax(0, s->notes_px - s->gap_px / 2) : 0,
            .foot_gap_px = 0.6 * s->size_px,
            .grid_px = s->grid ? s->leading > 0 ? s->leading * s->size_px
                                                : m->text->styles[m->styles[ROMAN]]->leading_px
                               : 0};
    for (int i = 0; i < s->shapes_count; i++)
        t.shapes[t.shapes_count++] = s->shapes[i];
    return page_templates_set(m->text, &t, 1);
}

/* In the middle of the margins. */
static enum font_status running_make(const struct making *m)
{
    const struct page_setup *s = m->setup;
    struct page_running lines[2];
    int count = 0;
    double middle = s->margin_px / 2, half = 0.25 * s->size_px; /* of a letter's height */
    if (!s->folios && !s->head)
        return FONT_OK;
    if (s->margin_px < s->size_px)
        return font_fail(FONT_BAD_ARGUMENT,
                         "page numbers and running heads need a margin of %g pixels (got %g)",
                         s->size_px, s->margin_px);
    const struct page_running line = {.style = m->styles[NOTE],
                                      .x0 = s->margin_px,
                                      .x1 = s->width_px - s->margin_px,
                                      .align = FONT_ALIGN_CENTER};
    if (s->folios) {
        lines[count] = line;
        lines[count].text = "%p";
        lines[count++].y = s->height_px - middle + half;
    }
    if (s->head) {
        lines[count] = line;
        lines[count].text = s->head;
        lines[count].not_opening = true;
        lines[count++].y = middle + half;
    }
    return page_running_set(m->text, lines, count);
}

/* ---- reading ---- */

static bool letter_add(struct making *m, char c)
{
    if (!array_reserve(&m->letters, &m->capacity, m->count + 1, 1))
        return false;
    m->letters[m->count++] = c;
    return true;
}

static bool look_set(struct making *m, enum look look)
{
    if (!array_reserve(&m->spans, &m->spans_capacity, m->spans_count + 1, sizeof *m->spans))
        return false;
    m->spans[m->spans_count].begin = m->count;
    m->spans[m->spans_count++].look = look;
    return true;
}

static bool number_add(struct making *m, int number, enum look raised, enum look back)
{
    char digits[16];
    snprintf(digits, sizeof digits, "%d", number);
    bool ok = look_set(m, raised);
    for (const char *d = digits; ok && *d; d++)
        ok = letter_add(m, *d);
    return ok && look_set(m, back);
}

/* The end of a note that begins at `at`: its closing bracket, or the text's end. */
static int note_end(const char *s, int at, int end)
{
    int depth = 1;
    for (; at < end; at++) {
        if (s[at] == '\\')
            at++;
        else if (s[at] == '[')
            depth++;
        else if (s[at] == ']' && --depth == 0)
            break;
    }
    return at < end ? at : end;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\n' || c == '\t';
}

static bool note_take(struct making *m, const char *s, int *at, int end, enum look now)
{
    bool margin = s[*at + 1] == '>' && m->setup->notes_px > 0;
    int last = note_end(s, *at + 2, end);
    if (!margin && !number_add(m, ++m->number, RAISED, now))
        return false;
    if (!array_reserve(&m->notes, &m->notes_capacity, m->notes_count + 1, sizeof *m->notes))
        return false;
    m->notes[m->notes_count].byte = m->count;
    m->notes[m->notes_count].from = *at + 2;
    m->notes[m->notes_count].end = last;
    m->notes[m->notes_count].number = m->number;
    m->notes[m->notes_count++].margin = margin;
    *at = last;
    return true;
}

/* Reads s[at..end) with its signs; notes are kept for later where there may be some. */
static bool signs_read(struct making *m, const char *s, int at, int end, enum look plain,
                       enum look italic, enum look bold, bool notes)
{
    struct emphasis e = {false, false};
    bool ok = true;
    for (const int from = at; ok && at < end; at++) {
        enum look now = e.heavy ? bold : e.slanted ? italic : plain;
        if (s[at] == '\\' && at + 1 < end) {
            at++;
            ok = letter_add(m, s[at]); /* a line end, too */
        } else if (s[at] == '*' || s[at] == '_') {
            int n = emphasis_take(s, from, at, end, &e), run = emphasis_run(s, at, end);
            for (int k = 0; ok && !n && k < run; k++)
                ok = letter_add(m, s[at]);
            if (n)
                ok = look_set(m, e.heavy ? bold : e.slanted ? italic : plain);
            at += (n ? n : run) - 1;
        } else if (notes && s[at] == '[' && at + 1 < end &&
                   (s[at + 1] == '^' || s[at + 1] == '>')) {
            ok = note_take(m, s, &at, end, now);
        } else if (s[at] == '\n') {
            if (m->count && m->letters[m->count - 1] != ' ')
                ok = letter_add(m, ' ');
            while (at + 1 < end && is_blank(s[at + 1]))
                at++;
        } else {
            ok = letter_add(m, s[at]);
        }
    }
    while (m->count && m->letters[m->count - 1] == ' ')
        m->count--;
    return ok;
}

static enum font_status spans_apply(struct making *m, int id)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < m->spans_count && status == FONT_OK; i++) {
        int begin = m->spans[i].begin;
        status = font_patience_ask(i);
        if (begin < m->count && status == FONT_OK)
            status =
                page_paragraph_style(m->text, id, begin, m->count, m->styles[m->spans[i].look]);
    }
    return status;
}

static struct page_manner manner_of(const struct making *m, enum look look, bool indented)
{
    const struct page_setup *s = m->setup;
    struct page_manner manner = page_manner_default();
    double size = s->size_px * (look == HEAD ? 1.6 : look == NOTE ? 0.8 : 1);
    manner.align = look == HEAD || look == SMALL_HEAD ? FONT_ALIGN_START : s->align;
    manner.leading_px = s->leading * size;
    manner.tolerance = s->tolerance;
    manner.protrude = s->protrude;
    manner.expand = s->expand;
    manner.hyphenate = s->hyphenate && look != HEAD && look != SMALL_HEAD;
    if (look == HEAD || look == SMALL_HEAD) {
        manner.before_px = s->size_px * (look == HEAD ? 1.4 : 0.9);
        manner.after_px = s->size_px * (look == HEAD ? 0.6 : 0.3);
        manner.keep_with_next = manner.keep_together = manner.balance = true;
        manner.role = FONT_ROLE_HEADING;
        manner.level = look == HEAD ? 1 : 2;
    } else if (look == ROMAN && indented) {
        manner.indent_px = s->indent_em * size;
    }
    return manner;
}

static enum font_status notes_make(struct making *m, const char *s, int id)
{
    enum font_status status = FONT_OK;
    int notes = m->notes_count;
    for (int i = 0; i < notes && status == FONT_OK; i++) {
        struct page_manner manner = manner_of(m, NOTE, false);
        bool margin = m->notes[i].margin;
        int note;
        m->count = m->spans_count = 0;
        if (margin)
            manner.align = FONT_ALIGN_START;
        bool ok = margin ||
                  (number_add(m, m->notes[i].number, NOTE_RAISED, NOTE) && letter_add(m, ' '));
        if (!ok || !signs_read(m, s, m->notes[i].from, m->notes[i].end, NOTE, NOTE_ITALIC,
                               NOTE_BOLD, false))
            return font_fail(FONT_NO_MEMORY, "no memory for a note");
        status = page_note_add(m->text, id, m->notes[i].byte,
                               margin ? PAGE_NOTE_MARGIN : PAGE_NOTE_FOOT, m->letters,
                               (size_t)m->count, m->styles[NOTE], &manner, &note);
        if (status == FONT_OK)
            status = spans_apply(m, note);
    }
    return status;
}

/* ---- kinds of paragraphs ---- */

/* Whether a line s[at..end) is three signs and more of a kind, with blanks between: what parts
 * the text, as `* * *`. */
static bool is_rule(const char *s, int at, int end)
{
    char sign = '\0';
    int count = 0;
    for (; at < end; at++) {
        if (is_blank(s[at]))
            continue;
        if ((s[at] != '*' && s[at] != '-' && s[at] != '_') || (sign && s[at] != sign))
            return false;
        sign = s[at];
        count++;
    }
    return count >= 3;
}

/* How long the sign of a list's item is: "- ", "* ", "+ ", "12. ", "1) "; 0: it is none. */
static int item_sign(const char *s, int at, int end)
{
    int n = 0;
    while (at + n < end && n < 4 && isdigit((unsigned char)s[at + n]))
        n++;
    bool sign = n ? at + n < end && (s[at + n] == '.' || s[at + n] == ')')
                  : at < end && (s[at] == '-' || s[at] == '*' || s[at] == '+');
    return sign && at + n + 1 < end && s[at + n + 1] == ' ' ? n + 2 : 0;
}

static int line_end(const char *s, int at, int bytes)
{
    const char *end = at < bytes ? memchr(s + at, '\n', (size_t)(bytes - at)) : NULL;
    return end ? (int)(end - s) : bytes;
}

static int blanks_skip(const char *s, int at, int end)
{
    while (at < end && (s[at] == ' ' || s[at] == '\t'))
        at++;
    return at;
}

enum kind { TEXT, RULE, ITEM, QUOTE };

static enum kind kind_of(const char *s, int at, int end)
{
    at = blanks_skip(s, at, end);
    return is_rule(s, at, end)        ? RULE
           : item_sign(s, at, end)    ? ITEM
           : at < end && s[at] == '>' ? QUOTE
                                      : TEXT;
}

static struct page_manner kind_manner(const struct making *m, enum kind kind, enum look look)
{
    struct page_manner manner = manner_of(m, look, !m->behind_head && kind == TEXT);
    double em = m->setup->size_px;
    if (kind == RULE) {
        manner.role = FONT_ROLE_ARTIFACT;
        manner.align = FONT_ALIGN_CENTER;
        manner.before_px = manner.after_px = 0.6 * em;
        manner.hyphenate = false;
    } else if (kind == ITEM) {
        manner.role = FONT_ROLE_ITEM;
        manner.left_px = 1.6 * em;
        manner.indent_px = -em;
    } else if (kind == QUOTE) {
        manner.role = FONT_ROLE_QUOTE;
        manner.left_px = manner.right_px = 1.6 * em;
    }
    return manner;
}

/* Its letters; a quote's without the signs at its lines' beginnings. */
static bool kind_read(struct making *m, char *s, int begin, int end, enum kind kind,
                      enum look look)
{
    static const char rule[] = "* * *", bullet[] = "\xe2\x80\xa2\xe2\x80\x82";
    int sign = kind == ITEM ? item_sign(s, begin, end) : 0;
    bool ok = true;
    m->count = m->spans_count = m->notes_count = 0;
    if (kind == RULE) {
        for (int i = 0; ok && rule[i]; i++)
            ok = letter_add(m, rule[i]);
        return ok;
    }
    for (int i = 0; ok && sign == 2 && bullet[i]; i++)
        ok = letter_add(m, bullet[i]);
    for (int i = 0; ok && sign > 2 && i < sign; i++)
        ok = letter_add(m, s[begin + i]);
    for (int at = begin; kind == QUOTE && at < end; at = line_end(s, at, end) + 1) {
        int first = blanks_skip(s, at, end);
        for (int i = at; i <= first && i < end && s[first] == '>'; i++)
            s[i] = ' ';
    }
    begin = blanks_skip(s, begin + sign, end);
    return ok && signs_read(m, s, begin, end, look, look == ROMAN ? ITALIC : look,
                            look == ROMAN ? BOLD : look, true);
}

static enum font_status paragraph_make(struct making *m, char *s, int begin, int end)
{
    enum look look = ROMAN;
    enum kind kind = kind_of(s, begin, line_end(s, begin, end));
    int id;
    begin = blanks_skip(s, begin, end);
    if (begin + 1 < end && s[begin] == '#' && (s[begin + 1] == ' ' || s[begin + 1] == '#')) {
        look = s[begin + 1] == '#' ? SMALL_HEAD : HEAD;
        while (begin < end && (s[begin] == '#' || s[begin] == ' '))
            begin++;
    }
    if (!kind_read(m, s, begin, end, kind, look) || !letter_add(m, '\0'))
        return font_fail(FONT_NO_MEMORY, "no memory for a text");
    m->count--;
    const struct page_manner manner = kind_manner(m, kind, look);
    m->behind_head = look != ROMAN || kind == RULE;
    enum font_status status = page_paragraph_add(m->text, 0, -1, m->letters, (size_t)m->count,
                                                 m->styles[look], &manner, &id);
    if (status == FONT_OK)
        status = spans_apply(m, id);
    return status == FONT_OK ? notes_make(m, s, id) : status;
}

/* Where the paragraph that begins at `at` ends: before a blank line, an item of a list, a line
 * of signs; a quote before what is none. */
static int paragraph_end(const char *s, int at, int bytes)
{
    enum kind kind = kind_of(s, at, line_end(s, at, bytes));
    int end = line_end(s, at, bytes);
    while (kind != RULE && end < bytes) {
        int next = line_end(s, end + 1, bytes);
        enum kind of = kind_of(s, end + 1, next);
        if (blanks_skip(s, end + 1, next) == next || of == RULE || of == ITEM ||
            (of == QUOTE) != (kind == QUOTE))
            break;
        end = next;
    }
    return end;
}

/* Paragraphs are what blank lines stand between. */
static enum font_status text_read(struct making *m, char *s, int bytes)
{
    enum font_status status = FONT_OK;
    m->behind_head = true;
    for (int at = 0; status == FONT_OK;) {
        while (at < bytes && is_blank(s[at]))
            at++;
        if (at == bytes)
            break;
        int end = paragraph_end(s, at, bytes);
        status = paragraph_make(m, s, at, end);
        at = end;
    }
    return status;
}

/* The text without a mark of byte order before it, its lines' ends all of one kind. Owns: the
 * caller frees it; NULL: no memory. */
static char *text_tidy(const char *utf8, size_t *bytes)
{
    char *out = malloc(*bytes + 1);
    size_t n = 0, at = *bytes >= 3 && memcmp(utf8, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    for (; out && at < *bytes; at++) {
        if (utf8[at] == '\r' && at + 1 < *bytes && utf8[at + 1] == '\n')
            continue;
        out[n++] = utf8[at] == '\r' ? '\n' : utf8[at];
    }
    if (out)
        out[n] = '\0';
    *bytes = n;
    return out;
}

enum font_status page_setup_make(const struct page_setup *setup, const char *utf8, size_t bytes,
                                 struct page_text **out)
{
    enum { BYTES_MAX = 1 << 28 };
    struct making m = {.setup = setup};
    char *mended = NULL, *tidy = NULL;
    *out = NULL;
    if (bytes > BYTES_MAX)
        return font_fail(FONT_TOO_LARGE, "a text is at most %d bytes (got %zu)", BYTES_MAX,
                         bytes);
    enum font_status status = page_text_create(&m.text);
    if (status == FONT_OK && font_utf8_damaged(utf8, bytes)) {
        status = font_utf8_mend(utf8, bytes, &mended, &bytes);
        utf8 = mended;
    }
    if (status == FONT_OK && !(tidy = text_tidy(utf8, &bytes)))
        status = font_fail(FONT_NO_MEMORY, "no memory for a text");
    if (status == FONT_OK && setup->colour)
        page_text_colour(m.text);
    if (status == FONT_OK)
        status = styles_make(&m);
    if (status == FONT_OK)
        status = template_make(&m);
    if (status == FONT_OK)
        status = running_make(&m);
    if (status == FONT_OK)
        status = text_read(&m, tidy, (int)bytes);
    free(m.letters);
    free(m.spans);
    free(m.notes);
    free(mended);
    free(tidy);
    if (status == FONT_OK)
        *out = m.text;
    else
        page_text_destroy(m.text);
    return status;
}
