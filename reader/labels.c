/* labels.c - what places of a document are called: labels, and headings by their words. See
 * reader_document.h. */
#include "reader_internal.h"

#include <ctype.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <text.h>
#include <wctype.h>

/* ---- names of headings ---- */

/* A letter or digit of any script. Beyond ASCII only general signs and blanks are none,
 * whatever the locale knows. */
static bool is_word(uint32_t c)
{
    if (c < 0x80)
        return isalnum((int)c) || c == '-' || c == '_';
    const bool latin_sign = c < 0xc0 && c != 0xaa && c != 0xb5 && c != 0xba;
    return !latin_sign && c != 0xd7 && c != 0xf7 && !(c >= 0x2000 && c < 0x2070) &&
           !(c >= 0x2190 && c < 0x2c00) && !(c >= 0x3000 && c < 0x3004) &&
           !(c >= 0x3008 && c < 0x3020) && !(c >= 0xfe00 && c < 0xfe10) &&
           !(c >= 0x1f000 && c < 0x20000);
}

/* As links call a heading: small letters, digits, hyphens for blanks. utf8: a locale that knows
 * small letters; 0: none does. Owns: the caller frees it; NULL: no memory. */
static char *heading_name(const struct reader_block *block, locale_t utf8)
{
    enum { GROWS = 3 }; /* a small letter may have more bytes than its capital */
    char *name = malloc(GROWS * (size_t)block->bytes + FONT_UTF8_BYTES), *to = name;
    const char *at = block->text, *const end = at + block->bytes;
    while (name && at < end) {
        uint32_t c;
        font_utf8_next(&at, end, &c);
        if (c == ' ')
            *to++ = '-';
        else if (is_word(c))
            to += font_utf8_put(utf8 ? (uint32_t)towlower_l((wint_t)c, utf8) : c, to);
    }
    if (name)
        *to = '\0';
    return name;
}

/* ---- labels within notes ---- */

static int by_note_name(const void *a, const void *b)
{
    const struct reader_note_label *x = a, *y = b;
    const int names = strcmp(x->name, y->name);
    if (names)
        return names;
    return x->source != y->source ? x->source - y->source : x->note - y->note;
}

/* NULL: there is none. */
static const struct reader_block *note_find(const struct reader_document *d, const char *label,
                                            int source)
{
    int low = 0, high = d->note_labels_count;
    while (low < high) {
        const int half = low + (high - low) / 2;
        const struct reader_note_label *l = &d->note_labels[half];
        const int names = strcmp(l->name, label);
        if (names < 0 || (names == 0 && l->source < source))
            low = half + 1;
        else
            high = half;
    }
    const struct reader_note_label *found =
        low < d->note_labels_count ? &d->note_labels[low] : NULL;
    return found && strcmp(found->name, label) == 0 &&
                   (source < 0 || found->source == source) && d->notes[found->note].blocks_count
               ? &d->note_blocks[d->notes[found->note].first_block]
               : NULL;
}

int reader_document_note(const struct reader_document *d, const struct reader_block *block)
{
    int low = 0, high = d->notes_count;
    if (block < d->note_blocks || block >= d->note_blocks + d->note_blocks_count)
        return -1;
    const int at = (int)(block - d->note_blocks);
    while (high - low > 1) {
        const int half = low + (high - low) / 2;
        if (d->notes[half].first_block <= at)
            low = half;
        else
            high = half;
    }
    while (low + 1 < d->notes_count && d->notes[low].blocks_count == 0)
        low++;
    return low < d->notes_count && at >= d->notes[low].first_block &&
                   at < d->notes[low].first_block + d->notes[low].blocks_count
               ? low
               : -1;
}

/* ---- the list ---- */

static enum reader_status label_add(struct reader_document *d, char *name, int source,
                                    int block)
{
    if (!name || !array_reserve(&d->labels, &d->labels_capacity, d->labels_count + 1,
                                sizeof *d->labels)) {
        free(name);
        return reader_fail(READER_NO_MEMORY, "no memory for a document");
    }
    d->labels[d->labels_count++] =
        (struct reader_label){.name = name, .source = source, .block = block, .first = block};
    return READER_OK;
}

static enum reader_status heading_add(struct reader_document *d, char *name, int block)
{
    enum reader_status status = label_add(d, name, d->blocks[block].source, block);
    if (status == READER_OK)
        d->labels[d->labels_count - 1].heading = true;
    return status;
}

static int by_name(const void *a, const void *b)
{
    const struct reader_label *x = a, *y = b;
    const int names = strcmp(x->name, y->name);
    if (names)
        return names;
    return x->source != y->source ? x->source - y->source : x->block - y->block;
}

static void labels_sort(struct reader_document *d)
{
    if (d->labels_count)
        qsort(d->labels, (size_t)d->labels_count, sizeof *d->labels, by_name);
}

/* The second heading of a name has -1 behind it in links, and so on. */
static enum reader_status repeated_add(struct reader_document *d)
{
    enum reader_status status = READER_OK;
    const int count = d->labels_count;
    for (int i = 1, before = 0; i < count && status == READER_OK; i++) {
        const struct reader_label label = d->labels[i], last = d->labels[i - 1];
        const bool same = last.source == label.source && strcmp(last.name, label.name) == 0;
        before = !same ? 0 : before + (last.block != label.block);
        if (!before || last.block == label.block ||
            d->blocks[label.block].kind != READER_HEADING)
            continue;
        const size_t room = strlen(label.name) + 16;
        char *name = malloc(room);
        if (name)
            snprintf(name, room, "%s-%d", label.name, before);
        status = heading_add(d, name, label.block);
    }
    labels_sort(d);
    return status;
}

static void first_find(struct reader_document *d)
{
    for (int begin = 0, end; begin < d->labels_count; begin = end) {
        int first = d->labels[begin].block;
        for (end = begin;
             end < d->labels_count && strcmp(d->labels[end].name, d->labels[begin].name) == 0;
             end++)
            first = d->labels[end].block < first ? d->labels[end].block : first;
        for (int i = begin; i < end; i++)
            d->labels[i].first = first;
    }
}

enum reader_status reader_labels_make(struct reader_document *d)
{
    const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", (locale_t)0);
    enum reader_status status = READER_OK;
    for (int i = 0; i < d->blocks_count && status == READER_OK; i++)
        if (d->blocks[i].kind == READER_HEADING)
            status = heading_add(d, heading_name(&d->blocks[i], utf8), i);
    if (utf8)
        freelocale(utf8);
    labels_sort(d);
    if (d->note_labels_count)
        qsort(d->note_labels, (size_t)d->note_labels_count, sizeof *d->note_labels,
              by_note_name);
    if (status == READER_OK)
        status = repeated_add(d);
    first_find(d);
    return status;
}

enum reader_status reader_labels_again(struct reader_document *d)
{
    int kept = 0;
    for (int i = 0; i < d->labels_count; i++) {
        d->labels[i].first = d->labels[i].block;
        if (d->labels[i].heading)
            free(d->labels[i].name);
        else
            d->labels[kept++] = d->labels[i];
    }
    d->labels_count = kept;
    return reader_labels_make(d);
}

void reader_cited_name(int block, char to[READER_CITED_BYTES])
{
    snprintf(to, READER_CITED_BYTES, "cited %d", block); /* a blank is in no other */
}

enum reader_status reader_labels_cited(struct reader_document *d,
                                       const struct reader_citation *list, int count)
{
    bool *has = calloc((size_t)d->blocks_count + 1, sizeof *has);
    enum reader_status status =
        has ? READER_OK : reader_fail(READER_NO_MEMORY, "no memory for a document");
    for (int i = 0; i < count && status == READER_OK; i++) {
        char name[READER_CITED_BYTES];
        const int where = list[i].where;
        if (has[where])
            continue;
        has[where] = true;
        reader_cited_name(where, name);
        status = label_add(d, strdup(name), d->blocks[where].source, where);
    }
    free(has);
    labels_sort(d);
    return status;
}

const struct reader_block *reader_document_label(const struct reader_document *d,
                                                 const char *label, int source)
{
    int low = 0, high = d->referred ? d->labels_count : 0;
    while (low < high) { /* the first at or behind the name and source */
        const int half = low + (high - low) / 2, names = strcmp(d->labels[half].name, label);
        if (names < 0 || (names == 0 && d->labels[half].source < source))
            low = half + 1;
        else
            high = half;
    }
    const struct reader_label *found =
        d->referred && low < d->labels_count ? &d->labels[low] : NULL;
    if (!found || strcmp(found->name, label) != 0 || (source >= 0 && found->source != source))
        return d->referred ? note_find(d, label, source) : NULL;
    return &d->blocks[source < 0 ? found->first : found->block];
}

const struct reader_block *reader_place_find(const struct reader_document *d,
                                             const struct reader_files *files,
                                             const char *target, int source)
{
    const char *mark = strchr(target, '#');
    if (!mark || !mark[1])
        return NULL;
    if (mark != target) {
        const int other =
            strchr(target, ':') || *target == '/'
                ? -1
                : reader_files_source(files, source, target, (size_t)(mark - target));
        return other < 0 ? NULL : reader_document_label(d, mark + 1, other);
    }
    const struct reader_block *own = reader_document_label(d, mark + 1, source);
    return own ? own : reader_document_label(d, mark + 1, -1);
}
