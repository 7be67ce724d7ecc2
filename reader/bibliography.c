/* bibliography.c - a list that is labelled as one is sorted, and its entries say where they are
 * cited: see reader_document.h.
 *
 * An entry is an item of the list with all that is in it: blocks in a row. Entries change their
 * places; labels, which are kept by their blocks' numbers, follow. */
#include "builder.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <text.h>
#include <wctype.h>

static const char name[] = "bibliography";

static enum reader_status no_memory(void)
{
    return reader_fail(READER_NO_MEMORY, "no memory for a document");
}

/* ---- where it is ---- */

/* The list that a labelled block begins, or that comes before the next heading. False: there is
 * none. */
static bool list_find(const struct reader_document *d, int block, int *begin, int *end)
{
    const int source = d->blocks[block].source;
    int i = block;
    while (i < d->blocks_count && d->blocks[i].source == source &&
           !(d->blocks[i].items && d->blocks[i].marker)) {
        if (i > block && d->blocks[i].kind == READER_HEADING)
            return false;
        i++;
    }
    if (i == d->blocks_count || d->blocks[i].source != source)
        return false;
    *begin = i;
    const int depth = d->blocks[i].items;
    while (i < d->blocks_count && d->blocks[i].source == source && d->blocks[i].items >= depth)
        i++;
    *end = i;
    return true;
}

/* ---- order ---- */

/* Letters from U+00C0 to U+017F without their signs; what is none is a star. */
static const char plain_letters[] =
    "aaaaaaaceeeeiiiidnooooo*ouuuuytsaaaaaaaceeeeiiiidnooooo*ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";

_Static_assert(sizeof plain_letters == 0x180 - 0xc0 + 1, "a letter for each");

/* What an entry is sorted by: its small letters and digits, and one blank for all that is
 * between them. Owns: the caller frees it; NULL: no memory. */
static char *key_make(const struct reader_block *block, locale_t utf8)
{
    enum { GROWS = 3 };
    char *key = malloc(GROWS * (size_t)block->bytes + FONT_UTF8_BYTES + 1), *to = key;
    const char *at = block->text, *const end = at + block->bytes;
    bool apart = false;
    while (key && at < end) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        c = utf8 ? (uint32_t)towlower_l((wint_t)c, utf8) : c;
        if (c >= 0xc0 && c < 0x180 && plain_letters[c - 0xc0] != '*')
            c = (unsigned char)plain_letters[c - 0xc0];
        const bool letter = c >= 0x80 ? !(c >= 0x2000 && c < 0x2070) && c >= 0xc0
                                      : (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (letter && apart && to > key)
            *to++ = ' ';
        apart = !letter;
        if (letter)
            to += font_utf8_put(c, to);
    }
    if (key)
        *to = '\0';
    return key;
}

struct entry {
    char *key;
    int begin, end; /* its blocks */
};

static int by_key(const void *a, const void *b)
{
    const struct entry *x = a, *y = b;
    const int keys = strcmp(x->key, y->key);
    return keys ? keys : x->begin - y->begin;
}

/* The entries of a list. *count: how many were made, whose keys are the caller's to free. */
static enum reader_status entries_make(const struct reader_document *d, int begin, int end,
                                       struct entry *entries, int *count)
{
    const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", (locale_t)0);
    const int depth = d->blocks[begin].items;
    enum reader_status status = READER_OK;
    *count = 0;
    for (int i = begin; i < end && status == READER_OK; i++) {
        if (i > begin && !(d->blocks[i].marker && d->blocks[i].items == depth)) {
            entries[*count - 1].end = i + 1;
            continue;
        }
        entries[*count] = (struct entry){key_make(&d->blocks[i], utf8), i, i + 1};
        if (!entries[(*count)++].key)
            status = no_memory();
    }
    if (utf8)
        freelocale(utf8);
    return status;
}

static bool marker_number(struct reader_block *block, int number)
{
    char text[16];
    snprintf(text, sizeof text, "%d.", number);
    char *marker = strdup(text);
    if (marker) {
        free(block->marker);
        block->marker = marker;
    }
    return marker != NULL;
}

/* Blocks begin..end in the order of the entries. places: where each block comes from. */
static enum reader_status entries_place(struct reader_document *d, const struct entry *entries,
                                        int count, int begin, int end, int *places,
                                        int *entry_of)
{
    struct reader_block *sorted = malloc((size_t)(end - begin) * sizeof *sorted);
    int to = 0;
    if (!sorted)
        return no_memory();
    for (int i = 0; i < count; i++)
        for (int k = entries[i].begin; k < entries[i].end; k++) {
            sorted[to] = d->blocks[k];
            places[k - begin] = begin + to;
            entry_of[begin + to] = begin + to - (k - entries[i].begin);
            to++;
        }
    memcpy(d->blocks + begin, sorted, (size_t)(end - begin) * sizeof *sorted);
    free(sorted);
    for (int i = 0; i < d->labels_count; i++)
        if (d->labels[i].block >= begin && d->labels[i].block < end &&
            strcmp(d->labels[i].name, name) != 0) /* that of the list stays at its head */
            d->labels[i].block = places[d->labels[i].block - begin];
    for (int i = begin, number = 0; i < end; i++)
        if (entry_of[i] == i && !marker_number(&d->blocks[i], ++number))
            return no_memory();
    return READER_OK;
}

static enum reader_status list_sort(struct reader_document *d, int begin, int end,
                                    int *entry_of)
{
    const size_t room = (size_t)(end - begin);
    struct entry *entries = calloc(room, sizeof *entries);
    int *places = malloc(room * sizeof *places), count = 0;
    enum reader_status status =
        entries && places ? entries_make(d, begin, end, entries, &count) : no_memory();
    if (status == READER_OK) {
        qsort(entries, (size_t)count, sizeof *entries, by_key);
        status = entries_place(d, entries, count, begin, end, places, entry_of);
    }
    for (int i = 0; i < count; i++)
        free(entries[i].key);
    free(entries);
    free(places);
    return status;
}

enum reader_status reader_bibliography_sort(struct reader_document *d, int *entry_of)
{
    bool *done = calloc((size_t)d->sources_count + 1, sizeof *done);
    enum reader_status status = done ? READER_OK : no_memory();
    for (int i = 0; i < d->blocks_count; i++)
        entry_of[i] = -1;
    for (int i = 0; i < d->labels_count && status == READER_OK; i++) {
        const int source = d->labels[i].source;
        int begin, end;
        if (strcmp(d->labels[i].name, name) != 0 || done[source])
            continue;
        done[source] = true;
        if (list_find(d, d->labels[i].block, &begin, &end))
            status = list_sort(d, begin, end, entry_of);
    }
    free(done);
    return status;
}
