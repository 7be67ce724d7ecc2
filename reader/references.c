/* references.c - references to headings, figures and formulas have their names: see
 * reader_document_refer() in reader_document.h.
 *
 * A reference is a link to a label of the document, in whose words the sign # stands alone. A
 * block that has some is written anew, span by span. */
#include "builder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    NAME_BYTES = 200,      /* of a name in a reference: a longer title is cut */
    CITED_MOST = 1000,     /* links back from one entry */
    NAMES_BYTES = 16 << 20 /* of all of them: references behind that stay as they are */
};

struct refer {
    struct reader_document *document;
    const struct reader_files *files; /* NULL: none is known */
    const int *above; /* for each block: the heading that it stands under; -1: none */
    const struct reader_citation *cited; /* of the entry that is written anew */
    int cited_count;
    size_t added;
    enum reader_status status;
    /* The block that is written anew. */
    struct reader_block to;
    int text_capacity, spans_capacity;
};

/* ---- finding ---- */

/* What may stand beside a sign that stands alone. */
static bool is_apart(char c)
{
    return strchr(" ()[].,;:!?'\"/-", c) || (unsigned char)c == 0xa0;
}

/* Where the sign stands alone in these letters; -1: nowhere. */
static int sign_find(const char *text, int bytes)
{
    for (int i = 0; i < bytes; i++)
        if (text[i] == '#' && (i == 0 || is_apart(text[i - 1])) &&
            (i + 1 == bytes || is_apart(text[i + 1])))
            return i;
    return -1;
}

static int reference_sign(const struct reader_block *block, const struct reader_span *span)
{
    const unsigned others = READER_CODE | READER_NOTE | READER_FORMULA | READER_IMAGE;
    const char *mark = span->target ? strchr(span->target, '#') : NULL;
    if (!(span->look & READER_LINK) || (span->look & others) || !mark || !mark[1])
        return -1;
    return sign_find(block->text + span->begin, span->end - span->begin);
}

/* ---- writing ---- */

static void no_memory(struct refer *r)
{
    if (r->status == READER_OK)
        r->status = reader_fail(READER_NO_MEMORY, "no memory for a document");
}

/* Letters of a span of their own. */
static void text_put(struct refer *r, const char *text, int bytes,
                     const struct reader_span *like)
{
    struct reader_block *to = &r->to;
    if (bytes <= 0 || r->status != READER_OK)
        return;
    char *target = like->target ? strdup(like->target) : NULL;
    if ((like->target && !target) ||
        !array_reserve(&to->text, &r->text_capacity, to->bytes + bytes + 1, 1) ||
        !array_reserve(&to->spans, &r->spans_capacity, to->spans_count + 1,
                       sizeof *to->spans)) {
        free(target);
        no_memory(r);
        return;
    }
    to->spans[to->spans_count++] = (struct reader_span){.begin = to->bytes,
                                                        .end = to->bytes + bytes,
                                                        .look = like->look,
                                                        .note = like->note,
                                                        .asked = like->asked,
                                                        .target = target};
    memcpy(to->text + to->bytes, text, (size_t)bytes);
    to->bytes += bytes;
    to->text[to->bytes] = '\0';
}

/* The same of letters from elsewhere, in one line. */
static void line_put(struct refer *r, const char *text, int bytes,
                     const struct reader_span *like)
{
    const int begin = r->to.bytes;
    text_put(r, text, bytes, like);
    for (int i = begin; i < r->to.bytes; i++)
        if ((unsigned char)r->to.text[i] < 0x20 || r->to.text[i] == 0x7f)
            r->to.text[i] = ' ';
}

static void words_put(struct refer *r, const char *words, const struct reader_span *like)
{
    line_put(r, words, (int)strlen(words), like);
}

/* A heading's words as they look there, as long as there is room. */
static void title_put(struct refer *r, const struct reader_block *heading,
                      const struct reader_span *like)
{
    int room = NAME_BYTES;
    for (int i = 0; i < heading->spans_count && room >= 0; i++) {
        const struct reader_span *s = &heading->spans[i];
        const unsigned looks = s->look & (READER_SLANTED | READER_HEAVY | READER_FORMULA);
        struct reader_span as = *like;
        int bytes = s->end - s->begin;
        if (s->look & READER_NOTE)
            continue;
        const bool cut = bytes > room;
        if (cut && !(looks & READER_FORMULA))
            for (bytes = room;
                 bytes > 0 && ((unsigned char)heading->text[s->begin + bytes] & 0xc0) == 0x80;)
                bytes--;
        as.look |= looks;
        if (looks & READER_FORMULA) {
            as.look &= ~(unsigned)READER_LINK;
            as.target = NULL;
        }
        if (!cut || !(looks & READER_FORMULA))
            line_put(r, heading->text + s->begin, bytes, &as);
        if (cut)
            words_put(r, "\xe2\x80\xa6", like);
        room = cut ? -1 : room - bytes;
    }
}

/* Of a number that has digits before its sign; 0: it is a bullet. */
static int digits_of(const char *marker)
{
    return marker ? (int)strspn(marker, "0123456789") : 0;
}

/* Whether the sign stands alone in its own words, which are no link's. */
static bool has_sign(const struct reader_block *block)
{
    for (int i = 0; i < block->spans_count; i++)
        if (!(block->spans[i].look & READER_LINK) &&
            sign_find(block->text + block->spans[i].begin,
                      block->spans[i].end - block->spans[i].begin) >= 0)
            return true;
    return false;
}

/* Whether the paragraph is the caption of a table that follows: it has a place for a number. */
static bool is_caption(const struct reader_document *d, int i)
{
    const struct reader_block *block = &d->blocks[i];
    return block->kind == READER_PARAGRAPH && i + 1 < d->blocks_count &&
           block[1].kind == READER_ROW && block[1].source == block->source && has_sign(block);
}

/* Of a figure, a formula, a table (its first row, or the caption over it); -1: it has none. */
static int numbered_of(const struct reader_document *d, int i)
{
    const struct reader_block *block = &d->blocks[i];
    if (block->kind == READER_PICTURE || block->kind == READER_MATH || is_caption(d, i))
        return i;
    const bool first = block->kind == READER_ROW && (i == 0 || block[-1].kind != READER_ROW ||
                                                     block[-1].table != block->table);
    if (!first)
        return -1;
    return i > 0 && is_caption(d, i - 1) ? i - 1 : i;
}

/* What its number is of; NULL: a formula. */
static const char *kind_of(const struct reader_block *block)
{
    return block->kind == READER_PICTURE                                  ? "Figure"
           : block->kind == READER_ROW || block->kind == READER_PARAGRAPH ? "Table"
                                                                          : NULL;
}

/* What a place is called: a number, or the title of the heading that it stands under. alone:
 * it is said what the number is of. */
static void name_put(struct refer *r, const struct reader_block *block, bool alone,
                     const struct reader_span *like)
{
    const struct reader_document *d = r->document;
    const int note = reader_document_note(d, block);
    if (block->kind == READER_ROW && block > d->blocks && block[-1].kind == READER_PARAGRAPH &&
        block[-1].number) /* its caption has it */
        block--;
    const int number = note >= 0 ? note + 1 : block->number,
              above = note >= 0 ? -1 : r->above[block - d->blocks],
              digits = digits_of(block->marker);
    const char *kind = note >= 0 ? "Note" : kind_of(block);
    char words[40];
    if (number) {
        if (!alone)
            snprintf(words, sizeof words, "%d", number);
        else if (kind)
            snprintf(words, sizeof words, "%s %d", kind, number);
        else
            snprintf(words, sizeof words, "(%d)", number);
        words_put(r, words, like);
    } else if (digits) {
        line_put(r, block->marker, digits, like);
    } else if (above >= 0) {
        title_put(r, &r->document->blocks[above], like);
    } else {
        words_put(r, strchr(like->target, '#') + 1, like); /* the label */
    }
}

/* ---- references ---- */

static void lost_add(struct refer *r, const struct reader_block *block, const char *label)
{
    struct reader_document *d = r->document;
    d->lost_all++;
    if (d->lost_count == READER_LOST_MAX)
        return;
    struct reader_lost *lost = &d->lost[d->lost_count++];
    *lost = (struct reader_lost){.source = block->source, .line = block->first_line};
    size_t bytes = strnlen(label, sizeof lost->label - 1);
    while (bytes > 0 && ((unsigned char)label[bytes] & 0xc0) == 0x80) /* no part of a letter */
        bytes--;
    memcpy(lost->label, label, bytes);
}

/* As it is written in Markdown: nothing has that label. */
static void written_put(struct refer *r, const struct reader_block *from,
                        const struct reader_span *span)
{
    struct reader_span plain = *span;
    plain.look &= ~(unsigned)READER_LINK;
    plain.target = NULL;
    words_put(r, "[", &plain);
    text_put(r, from->text + span->begin, span->end - span->begin, &plain);
    words_put(r, "](", &plain);
    words_put(r, span->target, &plain);
    words_put(r, ")", &plain);
}

static void reference_put(struct refer *r, const struct reader_block *from,
                          const struct reader_span *span, int sign)
{
    const char *text = from->text + span->begin;
    const int bytes = span->end - span->begin, bytes_before = r->to.bytes,
              spans_before = r->to.spans_count;
    const struct reader_block *place =
        reader_place_find(r->document, r->files, span->target, from->source);
    const char *mark = strchr(span->target, '#');
    const bool elsewhere = !place && mark != span->target &&
                           reader_files_source(r->files, from->source, span->target,
                                               (size_t)(mark - span->target)) < 0;
    if (elsewhere) { /* in a file that is none of the document's */
        text_put(r, text, bytes, span);
    } else if (place) {
        text_put(r, text, sign, span);
        name_put(r, place, bytes == 1, span);
        text_put(r, text + sign + 1, bytes - sign - 1, span);
    } else {
        lost_add(r, from, span->target + 1);
        written_put(r, from, span);
    }
    r->added +=
        (size_t)(r->to.bytes - bytes_before) +
        (size_t)(r->to.spans_count - spans_before) * (sizeof *span + strlen(span->target));
}

/* ---- captions ---- */

/* Its number is where the sign stands in the caption, or before it. */
static void caption_write(struct refer *r, const struct reader_block *from)
{
    const struct reader_span plain = {.note = -1, .look = READER_SLANTED};
    bool put = has_sign(from);
    char number[16], before[40];
    snprintf(number, sizeof number, "%d", from->number);
    snprintf(before, sizeof before, from->bytes ? "Figure %d: " : "Figure %d", from->number);
    if (!put)
        words_put(r, before, &plain);
    for (int i = 0; i < from->spans_count; i++) {
        const struct reader_span *s = &from->spans[i];
        const char *text = from->text + s->begin;
        const int bytes = s->end - s->begin,
                  sign = put && !(s->look & READER_LINK) ? sign_find(text, bytes) : -1;
        text_put(r, text, sign < 0 ? bytes : sign, s);
        if (sign < 0)
            continue;
        words_put(r, number, s);
        text_put(r, text + sign + 1, bytes - sign - 1, s);
        put = false;
    }
}

/* ---- blocks ---- */

/* So that a document does not become much larger by its references. */
static bool has_room(const struct refer *r, const struct reader_span *span)
{
    return r->added < NAMES_BYTES && r->to.bytes < 2 * READER_PASSAGE_BYTES &&
           strnlen(span->target, NAME_BYTES + 1) <= NAME_BYTES;
}

static void references_write(struct refer *r, const struct reader_block *from)
{
    for (int i = 0; i < from->spans_count; i++) {
        const struct reader_span *s = &from->spans[i];
        const int sign = reference_sign(from, s);
        if (sign >= 0 && has_room(r, s))
            reference_put(r, from, s, sign);
        else
            text_put(r, from->text + s->begin, s->end - s->begin, s);
    }
}

/* The block's text as it is written by the function. */
static void block_write(struct refer *r, struct reader_block *block,
                        void (*write)(struct refer *r, const struct reader_block *from))
{
    r->to = (struct reader_block){0};
    r->text_capacity = r->spans_capacity = 0;
    write(r, block);
    if (r->status == READER_OK && r->to.text) {
        const struct reader_block before = *block;
        block->text = r->to.text;
        block->bytes = r->to.bytes;
        block->spans = r->to.spans;
        block->spans_count = r->to.spans_count;
        r->to = (struct reader_block){
            .text = before.text, .spans = before.spans, .spans_count = before.spans_count};
    }
    reader_block_finish(&r->to);
}

static void block_refer(struct refer *r, struct reader_block *block)
{
    bool refers = false;
    if (block->number && (block->kind == READER_PICTURE || block->kind == READER_PARAGRAPH))
        block_write(r, block, caption_write);
    if (block->kind == READER_HEADING) /* a title leads nowhere by another one */
        return;
    for (int i = 0; i < block->spans_count && !refers; i++)
        refers = reference_sign(block, &block->spans[i]) >= 0;
    r->document->references = r->document->references || refers;
    if (refers && r->status == READER_OK)
        block_write(r, block, references_write);
}

/* ---- entries of a bibliography ---- */

/* The entry, and links back to where it is cited. */
static void back_write(struct refer *r, const struct reader_block *from)
{
    const struct reader_span plain = {.note = -1};
    const int count = r->cited_count < CITED_MOST ? r->cited_count : CITED_MOST;
    for (int i = 0; i < from->spans_count; i++) {
        const struct reader_span *s = &from->spans[i];
        text_put(r, from->text + s->begin, s->end - s->begin, s);
    }
    for (int i = 0; i < count && r->added < NAMES_BYTES; i++) {
        char target[1 + READER_CITED_BYTES] = "#", words[24] = "\xe2\x86\x91";
        const struct reader_span link = {.note = -1, .look = READER_LINK, .target = target};
        reader_cited_name(r->cited[i].where, target + 1);
        if (count > 1)
            snprintf(words, sizeof words, "\xe2\x86\x91%d", i + 1);
        words_put(r, " ", &plain);
        words_put(r, words, &link);
        r->added += sizeof link + sizeof words + sizeof target;
    }
}

/* At the end of the entry's last paragraph. */
static void entries_write(struct refer *r, const int *entry_of,
                          const struct reader_citation *list, int count)
{
    struct reader_document *d = r->document;
    for (int i = 0, end; i < count && r->status == READER_OK; i = end) {
        int last = -1;
        for (end = i; end < count && list[end].entry == list[i].entry;)
            end++;
        for (int b = list[i].entry; b < d->blocks_count && entry_of[b] == list[i].entry; b++)
            last = d->blocks[b].kind == READER_PARAGRAPH ? b : last;
        r->cited = &list[i];
        r->cited_count = end - i;
        if (last >= 0)
            block_write(r, &d->blocks[last], back_write);
    }
}

/* Figures, formulas and tables that have labels are counted. */
static void numbers_give(struct reader_document *d)
{
    int figures = 0, formulas = 0, tables = 0;
    for (int i = 0; i < d->labels_count; i++) {
        const int own = numbered_of(d, d->labels[i].block);
        if (own >= 0)
            d->blocks[own].number = 1;
    }
    for (int i = 0; i < d->blocks_count; i++) {
        struct reader_block *block = &d->blocks[i];
        if (block->number)
            block->number = block->kind == READER_PICTURE ? ++figures
                            : block->kind == READER_MATH  ? ++formulas
                                                          : ++tables;
    }
}

/* Labels, numbers, and what stands above each block. */
static void places_make(struct refer *r, int *above)
{
    struct reader_document *d = r->document;
    r->status = reader_labels_make(d);
    for (int i = 0, last = -1; i < d->blocks_count; i++) {
        last = d->blocks[i].kind == READER_HEADING ? i : last;
        above[i] = last;
    }
    r->above = above;
    if (r->status == READER_OK)
        numbers_give(d);
}

static void all_write(struct refer *r, const int *entry_of)
{
    struct reader_document *d = r->document;
    struct reader_citation *list = NULL;
    int count = 0;
    r->status = reader_citations_find(d, r->files, entry_of, &list, &count);
    if (r->status == READER_OK)
        r->status = reader_labels_cited(d, list, count);
    for (int i = 0; i < d->blocks_count && r->status == READER_OK; i++)
        block_refer(r, &d->blocks[i]);
    for (int i = 0; i < d->note_blocks_count && r->status == READER_OK; i++)
        block_refer(r, &d->note_blocks[i]);
    entries_write(r, entry_of, list, count);
    free(list);
}

enum reader_status reader_document_refer(struct reader_document *d)
{
    return reader_files_refer(NULL, d);
}

enum reader_status reader_files_refer(const struct reader_files *files,
                                      struct reader_document *d)
{
    struct refer r = {.document = d, .files = files};
    if (d->referred)
        return READER_OK;
    d->referred = true;
    int *above = malloc(((size_t)d->blocks_count + 1) * sizeof *above),
        *entry_of = malloc(((size_t)d->blocks_count + 1) * sizeof *entry_of);
    d->lost = calloc(READER_LOST_MAX, sizeof *d->lost);
    if (!above || !entry_of || !d->lost)
        no_memory(&r);
    if (r.status == READER_OK)
        r.status = reader_bibliography_sort(d, entry_of);
    if (r.status == READER_OK)
        places_make(&r, above);
    if (r.status == READER_OK)
        all_write(&r, entry_of);
    free(above);
    free(entry_of);
    return r.status;
}
