/* renew.c - a long paragraph's letters after an edit: see page_internal.h.
 *
 * What is known of a letter depends on letters near it, up to one that cuts off all before it:
 *
 *     text      kept ........ cut | near |  edited  | near | cut ........ kept
 *     face                   a letter of a word, which is no part of a picture
 *     script                 a letter that has one of its own
 *     level                  a letter that runs as the paragraph does
 *     line ends              a letter or digit behind another and a space; Han behind Han
 *     carets                 no mark, joiner or half of a flag
 *
 * Each is found anew between its cuts; then runs are cut anew there, and glyphs are shaped anew
 * between places that are safe to break at (renew_glyphs.c). Where a text has what reaches
 * farther (embeddings, brackets beside turned letters, Thai) it is analysed as a whole, as
 * short ones are: that is as fast. */
#include "renew.h"

#include <stdlib.h>
#include <string.h>

enum { LETTERS_LEAST = 1000 }; /* fewer are analysed as a whole */

void renew_edited(struct paragraph *p, int byte, int removed)
{
    const int head = byte, tail = p->bytes - byte - removed;
    if (!p->analysed && !p->edited) {
        set_forget(p);
        return;
    }
    if (p->analysed) {
        p->bytes_before = p->bytes;
        p->head = head;
        p->tail = tail;
    }
    p->head = head < p->head ? head : p->head;
    p->tail = tail < p->tail ? tail : p->tail;
    p->edited = true;
    p->analysed = p->broken = false;
}

/* ---- letters ---- */

/* The first letter that begins at a byte or behind it. */
static int letter_from(const struct paragraph *p, int byte)
{
    int low = 0, high = p->count;
    while (low < high) {
        int half = low + (high - low) / 2;
        if (p->letters[half].byte < byte)
            low = half + 1;
        else
            high = half;
    }
    return low;
}

static int span_at(const struct paragraph *p, int byte)
{
    int low = 0, high = p->spans_count;
    while (high - low > 1) {
        int half = low + (high - low) / 2;
        if (p->spans[half].begin <= byte)
            low = half;
        else
            high = half;
    }
    return low;
}

/* Reads letters from before the edit until one begins where one began before. */
static bool fresh_read(struct renewal *r)
{
    struct paragraph *p = r->p;
    const int moved = p->bytes - p->bytes_before, behind = p->bytes - p->tail;
    r->begin = letter_from(p, p->head - FONT_UTF8_BYTES + 1);
    r->end_before = letter_from(p, behind - moved);
    const int first = r->begin < p->count ? p->letters[r->begin].byte : p->bytes_before;
    const char *at = p->text + first, *end = p->text + p->bytes;
    for (int span = span_at(p, first); at < end;) {
        const int byte = (int)(at - p->text);
        while (r->end_before < p->count && p->letters[r->end_before].byte + moved < byte)
            r->end_before++;
        if (byte >= behind && r->end_before < p->count &&
            p->letters[r->end_before].byte + moved == byte)
            break;
        if (r->fresh_count > p->count / 2 ||
            !array_reserve(&r->fresh, &r->fresh_capacity, r->fresh_count + 1, sizeof *r->fresh))
            return false;
        r->fresh[r->fresh_count++] = set_letter(r->t, p, &at, &span);
    }
    if (at >= end)
        r->end_before = p->count;
    if (r->end_before < r->begin) /* all behind it is gone */
        r->end_before = r->begin;
    r->end = r->begin + r->fresh_count;
    return true;
}

/* Letters that change how others are set: each kind's number is known. */
static void letters_count(struct paragraph *p, uint32_t c, int by)
{
    const enum font_direction direction = font_direction_of(c);
    p->letters_embedding += direction == FONT_EMBEDS ? by : 0;
    p->letters_turning += direction == FONT_RUNS_LEFT || direction == FONT_NUMBERS ? by : 0;
    p->letters_thai += c >= 0xe01 && c <= 0xe5b ? by : 0;
}

/* Puts what was read in the place of what was there. */
static bool letters_put(struct renewal *r)
{
    struct paragraph *p = r->p;
    const int moved = p->bytes - p->bytes_before, by = r->end - r->end_before;
    const int count = p->count + by, behind = p->count - r->end_before;
    if (count > p->letters_capacity) {
        const int room = count + count / 8;
        void *letters = realloc(p->letters, (size_t)room * sizeof *p->letters);
        p->letters = letters ? letters : p->letters;
        void *characters = realloc(p->characters, (size_t)room * sizeof *p->characters);
        p->characters = characters ? characters : p->characters;
        if (!letters || !characters)
            return false;
        p->letters_capacity = room;
    }
    if (by) {
        memmove(p->letters + r->end, p->letters + r->end_before,
                (size_t)behind * sizeof *p->letters);
        memmove(p->characters + r->end, p->characters + r->end_before,
                (size_t)behind * sizeof *p->characters);
    }
    for (int i = r->end; moved && i < count; i++)
        p->letters[i].byte += moved;
    if (r->fresh_count)
        memcpy(p->letters + r->begin, r->fresh, (size_t)r->fresh_count * sizeof *p->letters);
    for (int i = r->begin; i < r->end; i++) {
        p->characters[i] = p->letters[i].character;
        letters_count(p, p->characters[i], 1);
    }
    p->count = count;
    r->from = r->begin;
    r->to = r->end;
    return true;
}

/* ---- what is known of them ---- */

static void widen(struct renewal *r, int from, int to)
{
    r->from = from < r->from ? from : r->from;
    r->to = to > r->to ? to : r->to;
}

static bool is_letter(uint32_t c)
{
    const hb_unicode_general_category_t category =
        hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
    return category >= HB_UNICODE_GENERAL_CATEGORY_LOWERCASE_LETTER &&
           category <= HB_UNICODE_GENERAL_CATEGORY_UPPERCASE_LETTER &&
           category != HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK &&
           category != HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK &&
           category != HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK;
}

static bool has_own_face(const struct paragraph *p, int i)
{
    const uint32_t c = p->characters[i];
    return c == ' ' || ((c < 0x2000 || (c >= 0x3040 && c < 0xf900)) && is_letter(c));
}

static void faces_renew(struct renewal *r)
{
    struct paragraph *p = r->p;
    int from = r->begin - 1, to = r->end;
    while (from > 0 && !has_own_face(p, from))
        from--;
    while (to < p->count && !has_own_face(p, to))
        to++;
    from = from > 0 ? from : 0;
    to += to < p->count;
    set_faces(r->t, p, from, to);
    widen(r, from, to);
}

static bool has_own_script(const struct paragraph *p, int i)
{
    const hb_script_t script =
        hb_unicode_script(hb_unicode_funcs_get_default(), p->characters[i]);
    return script != HB_SCRIPT_COMMON && script != HB_SCRIPT_INHERITED;
}

static bool scripts_renew(struct renewal *r)
{
    struct paragraph *p = r->p;
    int from = r->begin - 1, to = r->end;
    while (from > 0 && !has_own_script(p, from))
        from--;
    while (to < p->count && !has_own_script(p, to))
        to++;
    from = from > 0 ? from : 0;
    to += to < p->count;
    hb_script_t *scripts = calloc((size_t)(to - from) + 1, sizeof *scripts);
    if (!scripts)
        return false;
    font_scripts_choose(p->characters + from, to - from, scripts);
    for (int i = from; i < to; i++)
        if (p->letters[i].script != scripts[i - from]) {
            p->letters[i].script = scripts[i - from];
            widen(r, i, i + 1);
        }
    free(scripts);
    return true;
}

static bool runs_as_paragraph(const struct paragraph *p, int i)
{
    return font_direction_of(p->characters[i]) == (p->base ? FONT_RUNS_LEFT : FONT_RUNS_RIGHT);
}

/* turned: it had letters that turn; brackets: there were some among what was taken out. */
static bool levels_renew(struct renewal *r, bool turned, bool brackets)
{
    struct paragraph *p = r->p;
    int from = r->begin - 1, to = r->end, base = 0;
    if (!turned && !p->letters_turning && !p->base)
        return true; /* all are 0, as they were */
    while (from > 0 && !runs_as_paragraph(p, from))
        from--;
    while (to < p->count && !runs_as_paragraph(p, to))
        to++;
    from = from > 0 ? from : 0;
    to += to < p->count;
    for (int i = from; i < to && !brackets; i++)
        brackets = font_bracket(p->characters[i]);
    int8_t *levels = brackets ? NULL : calloc((size_t)(to - from) + 1, sizeof *levels);
    const int direction = from == 0 ? p->manner.right_to_left : p->base ? 1 : -1;
    bool good = levels &&
                font_levels_find(p->characters + from, to - from, direction, levels, &base) &&
                base == p->base;
    for (int i = from; good && i < to; i++)
        if (p->letters[i].level != levels[i - from]) {
            p->letters[i].level = levels[i - from];
            widen(r, i, i + 1);
        }
    free(levels);
    return good;
}

static bool is_of_word(uint32_t c)
{
    return is_letter(c) || (c >= '0' && c <= '9');
}

/* Whether a line may end before letter i, whatever else there is. */
static bool line_certain(const struct paragraph *p, int i)
{
    const uint32_t *c = p->characters + i;
    if (i > 0 && c[-1] >= 0x4e00 && c[-1] < 0xa000 && c[0] >= 0x4e00 && c[0] < 0xa000)
        return true;
    return i > 1 && c[-1] == ' ' && is_of_word(c[0]) && is_of_word(c[-2]);
}

static bool line_ends_renew(struct renewal *r)
{
    struct paragraph *p = r->p;
    int from = r->begin - 2, to = r->end + 2;
    while (from > 0 && !(line_certain(p, from) && is_of_word(p->characters[from + 1])))
        from--;
    while (to < p->count && !line_certain(p, to))
        to++;
    from = from > 0 ? from : 0;
    to = to < p->count ? to : p->count;
    /* The text's last place is told by the library that is asked of all of it. */
    const bool plain = p->plain;
    p->plain = plain && font_breaks_plain(p->characters + from, to - from)
                   ? true
                   : font_breaks_plain(p->characters, p->count);
    to = p->plain == plain ? to : p->count;
    const int count = to - from + (to < p->count); /* with what stands behind it */
    char *breaks = calloc((size_t)count + 1, 1);
    const char *language = r->t->styles[p->style]->language;
    const bool by_icu = to == p->count && !p->plain;
    const bool good =
        breaks &&
        ((by_icu && font_breaks_by_icu(p->characters + from, count, language, breaks)) ||
         font_breaks_find(p->characters + from, count, language, breaks));
    for (int i = from; good && i < to; i++)
        if (p->letters[i].brk != (uint8_t)breaks[i - from]) {
            p->letters[i].brk = (uint8_t)breaks[i - from];
            widen(r, i, i + 1);
        }
    free(breaks);
    return good;
}

static void carets_renew(struct renewal *r)
{
    struct paragraph *p = r->p;
    int to = r->end;
    while (to < p->count && !(to > r->end && carets_apart(p->characters[to - 1])))
        to++;
    to += to < p->count;
    carets_find(r->t, p, r->begin, to);
    widen(r, r->begin, to);
}

/* ---- runs ---- */

/* Runs before letters from..to stay, and those behind, but for where they are; glyphs are not
 * told yet. */
static bool runs_renew(struct renewal *r)
{
    struct paragraph *p = r->p;
    const int by = r->end - r->end_before, n = p->runs_count, to = r->to;
    struct set_run *runs = NULL;
    int count = 0, capacity = 0;
    const int left = r->from > 0 ? renew_run_at(p->runs, n, r->from - 1) + 1 : 0;
    const int right = to < p->count ? renew_run_at(p->runs, n, to - by) : n;
    if (!array_reserve(&runs, &capacity, left + n - right + 1, sizeof *runs))
        return false;
    if (left)
        memcpy(runs, p->runs, (size_t)left * sizeof *runs);
    count = left;
    if (left)
        runs[left - 1].end = r->from;
    bool good = set_runs_cut(p, r->from, to < p->count ? to + 1 : to, &runs, &count, &capacity);
    if (good && right < n) {
        runs[count - 1].end = p->runs[right].end + by;
        good = array_reserve(&runs, &capacity, count + n - right, sizeof *runs);
    }
    for (int i = right + 1; good && i < n; i++) {
        runs[count] = p->runs[i];
        runs[count].begin += by;
        runs[count++].end += by;
    }
    r->runs_before = p->runs;
    r->runs_before_count = n;
    p->runs = runs;
    p->runs_count = count;
    p->runs_capacity = capacity;
    return good;
}

/* ---- */

static bool renew_all(struct renewal *r)
{
    struct paragraph *p = r->p;
    if (!p->counted) {
        p->letters_turning = p->letters_embedding = p->letters_thai = 0;
        for (int i = 0; i < p->count; i++)
            letters_count(p, p->characters[i], 1);
        p->plain = font_breaks_plain(p->characters, p->count);
        p->counted = true;
    }
    if (p->letters_embedding || p->letters_thai || !fresh_read(r))
        return false;
    const bool turned = p->letters_turning > 0;
    bool brackets = false;
    for (int i = r->begin; i < r->end_before; i++) {
        letters_count(p, p->characters[i], -1);
        brackets = brackets || font_bracket(p->characters[i]);
    }
    if (!letters_put(r) || !p->count || p->letters_embedding || p->letters_thai)
        return false;
    faces_renew(r);
    if (!scripts_renew(r) || !levels_renew(r, turned, brackets) || !line_ends_renew(r))
        return false;
    carets_renew(r);
    return runs_renew(r) && renew_glyphs(r);
}

static bool renew(struct page_text *t, struct paragraph *p)
{
    struct renewal r = {.t = t, .p = p};
    p->edited = false;
    if (p->vertical || p->count < LETTERS_LEAST)
        return false;
    const bool good = renew_all(&r);
    free(r.fresh);
    free(r.runs_before);
    if (good)
        set_leading(t, p);
    return good;
}

enum font_status set_analyse(struct page_text *t, struct paragraph *p)
{
    if (p->analysed)
        return FONT_OK;
    const enum font_status status = p->edited && renew(t, p) ? FONT_OK : set_all(t, p);
    p->analysed = status == FONT_OK;
    t->stats.paragraphs_analysed++;
    return status;
}
