/* anchor.c - see reader_anchor.h. */
#include "anchor_internal.h"
#include "reader_internal.h"

#include <stdlib.h>
#include <string.h>

static uint64_t digest_of(const char *source, size_t bytes)
{
    uint64_t digest = 0xcbf29ce484222325u; /* FNV-1a */
    for (size_t i = 0; i < bytes; i++)
        digest = (digest ^ (unsigned char)source[i]) * 0x100000001b3u;
    return digest;
}

/* How often it is there, up to 2; *first: where. Places may overlap. */
static int count_of(const char *source, size_t bytes, const char *what, size_t length,
                    size_t *first)
{
    int count = 0;
    const char *end = source + bytes;
    for (const char *at = source;
         length && count < 2 && (at = memmem(at, (size_t)(end - at), what, length)) != NULL;
         at++)
        if (count++ == 0)
            *first = (size_t)(at - source);
    return count;
}

/* Makes sides longer, by half each time, until the row is there once. */
static struct witness witness_make(const char *source, size_t bytes, size_t begin, size_t end,
                                   bool left, bool right)
{
    struct witness w = {0};
    size_t first;
    for (size_t side = READER_ANCHOR_SIDE_LEAST;; side += side / 2) {
        side = side < READER_ANCHOR_SIDE_MOST ? side : READER_ANCHOR_SIDE_MOST;
        w.left = !left ? 0 : begin < side ? begin : side;
        w.right = !right ? 0 : bytes - end < side ? bytes - end : side;
        w.apart = count_of(source, bytes, source + begin - w.left,
                           w.left + end - begin + w.right, &first) == 1;
        bool all = (!left || w.left == begin) && (!right || w.right == bytes - end);
        if (w.apart || all || side == READER_ANCHOR_SIDE_MOST)
            return w;
    }
}

/* ---- headings ---- */

enum { LEVELS = 6 };

/* A line's level, if it is a heading with signs before it; 0. *text, *length: what it says. */
static int heading_of(const char *line, size_t bytes, const char **text, size_t *length)
{
    size_t level = 0;
    while (level < bytes && line[level] == '#')
        level++;
    if (!level || level > LEVELS || level == bytes || line[level] != ' ')
        return 0;
    while (level < bytes && line[level] == ' ')
        level++;
    *text = line + level;
    *length = bytes - level;
    while (*length && strchr(" #\r", (*text)[*length - 1]))
        --*length;
    return (int)strspn(line, "#");
}

static char *headings_make(const char *source, size_t begin)
{
    const char *texts[LEVELS + 1] = {NULL}, *end = source + begin;
    size_t lengths[LEVELS + 1] = {0}, room = 1;
    bool fenced = false;
    for (const char *line = source; line < end;) {
        const char *stop = memchr(line, '\n', (size_t)(end - line)), *text;
        size_t bytes = (size_t)((stop ? stop : end) - line), length;
        fenced ^= bytes >= 3 && (memcmp(line, "```", 3) == 0 || memcmp(line, "~~~", 3) == 0);
        int level = fenced ? 0 : heading_of(line, bytes, &text, &length);
        if (level) {
            texts[level] = text;
            lengths[level] = length;
            for (int i = level + 1; i <= LEVELS; i++)
                texts[i] = NULL;
        }
        line = stop ? stop + 1 : end;
    }
    for (int i = 1; i <= LEVELS; i++)
        room += texts[i] ? lengths[i] + 3 : 0;
    char *all = calloc(room, 1), *at = all;
    for (int i = 1; i <= LEVELS && all; i++) {
        if (!texts[i])
            continue;
        if (at > all)
            at = stpcpy(at, " / ");
        memcpy(at, texts[i], lengths[i]);
        at += lengths[i];
    }
    return all;
}

/* ---- making ---- */

enum reader_status reader_anchor_make(const char *source, size_t bytes, size_t begin,
                                      size_t end, struct reader_anchor **out)
{
    *out = NULL;
    if (begin > end || end > bytes)
        return reader_fail(READER_BAD_ARGUMENT, "a text of %zu bytes has no bytes %zu..%zu",
                           bytes, begin, end);
    if (end - begin > READER_ANCHOR_QUOTATION_MOST)
        return reader_fail(READER_TOO_LARGE, "an anchor has up to %d bytes (got %zu)",
                           READER_ANCHOR_QUOTATION_MOST, end - begin);
    struct reader_anchor *a = calloc(1, sizeof *a);
    if (!a)
        return reader_fail(READER_NO_MEMORY, "no memory for an anchor");
    *a = (struct reader_anchor){.begin = begin,
                                .end = end,
                                .bytes = bytes,
                                .digest = digest_of(source, bytes),
                                .quotation = end - begin,
                                .before = witness_make(source, bytes, begin, end, true, false),
                                .behind = witness_make(source, bytes, begin, end, false, true),
                                .both = witness_make(source, bytes, begin, end, true, true),
                                .headings = headings_make(source, begin)};
    a->left = a->before.left > a->both.left ? a->before.left : a->both.left;
    a->right = a->behind.right > a->both.right ? a->behind.right : a->both.right;
    a->text = malloc(a->left + a->quotation + a->right + 1);
    if (!a->text || !a->headings) {
        reader_anchor_destroy(a);
        return reader_fail(READER_NO_MEMORY, "no memory for an anchor");
    }
    memcpy(a->text, source + begin - a->left, a->left + a->quotation + a->right);
    a->text[a->left + a->quotation + a->right] = '\0';
    *out = a;
    return READER_OK;
}

void reader_anchor_destroy(struct reader_anchor *a)
{
    if (!a)
        return;
    free(a->text);
    free(a->headings);
    free(a);
}

/* ---- finding ---- */

/* Where the quotation begins, if the row is there once. */
static bool witness_find(const struct reader_anchor *a, const struct witness *w,
                         const char *source, size_t bytes, size_t *begin)
{
    size_t first = 0;
    const char *row = a->text + a->left - w->left;
    if (!w->apart ||
        count_of(source, bytes, row, w->left + a->quotation + w->right, &first) != 1)
        return false;
    *begin = first + w->left;
    return true;
}

/* Whether the quotation stands elsewhere than at `place` beside the nearest bytes of one of its
 * sides: then both places have a claim. */
static bool claimed_elsewhere(const struct reader_anchor *a, const char *source, size_t bytes,
                              size_t place)
{
    const char *quotation = a->text + a->left, *end = source + bytes;
    const size_t least = READER_ANCHOR_SIDE_LEAST;
    const size_t left = a->left < least ? a->left : least,
                 right = a->right < least ? a->right : least;
    for (const char *at = source;
         (at = memmem(at, (size_t)(end - at), quotation, a->quotation)) != NULL; at++) {
        size_t before = (size_t)(at - source), behind = bytes - before - a->quotation;
        if (before == place)
            continue;
        if ((before >= left && memcmp(at - left, quotation - left, left) == 0) ||
            (behind >= right &&
             memcmp(at + a->quotation, quotation + a->quotation, right) == 0))
            return true;
    }
    return false;
}

enum reader_found reader_anchor_find(const struct reader_anchor *a, const char *source,
                                     size_t bytes, size_t *begin, size_t *end)
{
    size_t before = 0, behind = 0;
    if (a->gone)
        return READER_ANCHOR_ORPHAN;
    if (bytes == a->bytes && digest_of(source, bytes) == a->digest) {
        *begin = a->begin;
        *end = a->end;
        return READER_ANCHOR_SAME;
    }
    bool found = witness_find(a, &a->both, source, bytes, &before);
    if (!found && a->quotation >= READER_ANCHOR_LONG) {
        bool one = witness_find(a, &a->before, source, bytes, &before) &&
                   !claimed_elsewhere(a, source, bytes, before);
        bool other = witness_find(a, &a->behind, source, bytes, &behind) &&
                     !claimed_elsewhere(a, source, bytes, behind);
        found = one || other; /* both: the same place, since else each would have a claim */
        before = one ? before : behind;
    }
    if (!found)
        return READER_ANCHOR_ORPHAN;
    *begin = before;
    *end = before + a->quotation;
    return READER_ANCHOR_MOVED;
}

/* Where a place goes: one within what is removed before what is put in, or behind it. */
static size_t place_after(size_t place, size_t at, size_t removed, size_t inserted,
                          bool stays_before)
{
    if (place < at || (place == at && stays_before))
        return place;
    if (place > at + removed || (place == at + removed && !stays_before))
        return place - removed + inserted;
    return stays_before ? at : at + inserted;
}

bool anchor_range_edit(size_t *begin, size_t *end, size_t at, size_t removed, size_t inserted)
{
    const bool empty = *begin == *end;
    if (empty ? at < *begin && at + removed > *end
              : removed && at <= *begin && at + removed >= *end)
        return false;
    *begin = place_after(*begin, at, removed, inserted, empty);
    *end = place_after(*end, at, removed, inserted, true);
    *end = *end < *begin ? *begin : *end;
    return true;
}

bool reader_anchor_edit(struct reader_anchor *a, size_t at, size_t removed, size_t inserted)
{
    if (a->gone || !anchor_range_edit(&a->begin, &a->end, at, removed, inserted)) {
        a->gone = true;
        return false;
    }
    a->bytes = a->bytes - removed + inserted;
    a->digest = 0; /* of a text that nobody has seen */
    return true;
}

void reader_anchor_place(const struct reader_anchor *a, size_t *begin, size_t *end)
{
    *begin = a->begin;
    *end = a->end;
}

const char *reader_anchor_quotation(const struct reader_anchor *a, size_t *bytes)
{
    *bytes = a->quotation;
    return a->text + a->left;
}

const char *reader_anchor_headings(const struct reader_anchor *a)
{
    return a->headings;
}
