/* builder.c - see builder.h. */
#include "builder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void reader_builder_fail(struct reader_builder *b)
{
    if (b->status == READER_OK)
        b->status = reader_fail(READER_NO_MEMORY, "no memory for a document");
}

void reader_block_finish(struct reader_block *block)
{
    for (int i = 0; i < block->spans_count; i++)
        free(block->spans[i].target);
    free(block->marker);
    free(block->text);
    free(block->spans);
    free(block->info);
    free(block->target);
    free(block->include);
    *block = (struct reader_block){0};
}

static bool is_sign(const char *at)
{
    return strncmp(at, READER_MASK_SIGN, strlen(READER_MASK_SIGN)) == 0;
}

/* How many letters stand for a formula behind the sign: its line ends stay. */
static int masked_letters(const struct reader_builder *b, const struct reader_formula *f)
{
    int n = 0;
    for (int k = f->begin + 2; k < f->end; k++)
        n += b->source[k] != '\n' && b->source[k] != '\r';
    return n;
}

/* Where the formula is whose sign such a letter follows ('\0': its letters are on the next
 * line), from the next on; those before it no text has shown. The count of all where there is
 * none. */
static int formula_find(const struct reader_builder *b, char letter)
{
    bool told = letter >= 'a' && letter <= 'z';
    int at = b->formula;
    for (int i = 0; told && i < 26 && at < b->mask->formulas_count; i++, at++)
        if (reader_mask_letter(at) == letter)
            break;
    return at;
}

/* Where a link leads to: what looks like formulas there is what is written. Owns: the caller
 * frees it; NULL: no memory. */
static char *target_copy(const struct reader_builder *b, const char *target)
{
    char *copy = strdup(target);
    for (char *at = copy; at && (at = strstr(at, READER_MASK_SIGN)) != NULL;) {
        int i = formula_find(b, at[strlen(READER_MASK_SIGN)]);
        const struct reader_formula *f =
            i < b->mask->formulas_count ? &b->mask->formulas[i] : NULL;
        size_t n = f ? (size_t)(f->end - f->begin) : 0;
        if (!f || strlen(at) < n || (int)n - 2 != masked_letters(b, f))
            break;
        memcpy(at, b->source + f->begin, n);
        at += n;
    }
    return copy;
}

/* ---- letters ---- */

static void byte_add(struct reader_builder *b, char c)
{
    struct reader_block *block = &b->block;
    if (b->status != READER_OK ||
        !array_reserve(&block->text, &b->text_capacity, block->bytes + 2, 1)) {
        reader_builder_fail(b);
        return;
    }
    block->text[block->bytes++] = c;
    block->text[block->bytes] = '\0';
}

/* Bytes to come look so. A formula is a span of its own. */
static void look_begin(struct reader_builder *b, unsigned look, int note, const char *target)
{
    struct reader_block *block = &b->block;
    struct reader_span *last =
        block->spans_count ? &block->spans[block->spans_count - 1] : NULL;
    const unsigned alone = READER_FORMULA | READER_NOTE | READER_IMAGE;
    if (last && last->look == look && !(look & alone) &&
        (target ? last->target && strcmp(last->target, target) == 0 : !last->target))
        return;
    b->targets_bytes += target ? strlen(target) : 0;
    if (b->status == READER_OK && b->targets_bytes > READER_TARGETS_BYTES)
        b->status = reader_fail(READER_TOO_LARGE,
                                "line %d: a document's links have up to %d MB of addresses: "
                                "shorten them",
                                block->first_line, READER_TARGETS_BYTES >> 20);
    char *copy = target && b->status == READER_OK ? target_copy(b, target) : NULL;
    if (b->status != READER_OK || (target && !copy) ||
        !array_reserve(&block->spans, &b->spans_capacity, block->spans_count + 1,
                       sizeof *block->spans)) {
        free(copy);
        reader_builder_fail(b);
        return;
    }
    block->spans[block->spans_count++] = (struct reader_span){
        .begin = block->bytes, .end = block->bytes, .look = look, .note = note, .target = copy};
}

static void look_end(struct reader_builder *b)
{
    if (b->status == READER_OK)
        b->block.spans[b->block.spans_count - 1].end = b->block.bytes;
}

/* A letter that pages can show: other control characters than line ends and tabs of code are
 * blanks. */
static char shown(const struct reader_builder *b, char c)
{
    bool code = b->block.kind == READER_CODE_BLOCK || b->block.kind == READER_LIVE ||
                b->block.kind == READER_HTML;
    if ((unsigned char)c >= 0x20 && c != 0x7f)
        return c;
    return c == '\n' || (code && c == '\t') ? c : ' ';
}

/* A blank after another one, or at the beginning, is none. */
static bool blank_is_enough(const struct reader_builder *b)
{
    const struct reader_block *block = &b->block;
    char last = block->bytes ? block->text[block->bytes - 1] : ' ';
    return last == ' ' || last == '\n' || last == '\t';
}

/* A passage goes on with a paragraph of its own where it gets too long to be set at once: at a
 * blank, or soon behind where one should be. Only between letters. */
static void passage_split(struct reader_builder *b, const char *at, unsigned look,
                          const char *target)
{
    enum { BLANK_WITHIN = 1024 };
    const struct reader_block *block = &b->block;
    const bool long_enough =
        block->bytes >= READER_PASSAGE_BYTES &&
        (*at == ' ' || block->bytes >= READER_PASSAGE_BYTES + BLANK_WITHIN);
    const bool flows = block->kind == READER_PARAGRAPH || block->kind == READER_HEADING ||
                       block->kind == READER_PICTURE;
    if (!long_enough || !flows || ((unsigned char)*at & 0xc0) == 0x80 || b->status != READER_OK)
        return;
    const int first_line = block->first_line, last_line = block->last_line,
              formula = b->formula, rest = b->rest;
    const char letter = b->letter;
    const bool unspaced = *at != ' ' && !blank_is_enough(b);
    look_end(b);
    reader_block_open(b, READER_PARAGRAPH, first_line, last_line);
    b->block.continues = true;
    b->block.unspaced = unspaced;
    b->formula = formula;
    b->rest = rest;
    b->letter = letter;
    look_begin(b, look, -1, target);
}

/* ---- formulas ---- */

static const struct reader_formula *formula_next(struct reader_builder *b, char letter)
{
    int at = formula_find(b, letter);
    if (at >= b->mask->formulas_count)
        return NULL;
    b->formula = at + 1;
    b->letter = reader_mask_letter(at);
    return &b->mask->formulas[at];
}

static void source_add(struct reader_builder *b, int begin, int end, bool lines)
{
    for (int k = begin; k < end; k++)
        byte_add(b, lines                                ? shown(b, b->source[k])
                    : (unsigned char)b->source[k] < 0x20 ? ' '
                                                         : b->source[k]);
}

/* Blanks at a block's end say nothing: before a formula on its own lines, or a label's tag. */
static void blanks_drop(struct reader_block *block)
{
    while (block->bytes && block->text[block->bytes - 1] == ' ')
        block->text[--block->bytes] = '\0';
    for (int i = block->spans_count - 1; i >= 0 && block->spans[i].end > block->bytes; i--)
        block->spans[i].end =
            block->spans[i].begin < block->bytes ? block->bytes : block->spans[i].begin;
}

/* Between two blocks of what was a paragraph, a formula on its own lines. */
static void formula_display(struct reader_builder *b, const struct reader_formula *f)
{
    struct reader_block *block = &b->block;
    const int last_line = block->last_line;
    blanks_drop(block);
    int formula = b->formula, rest = b->rest;
    char letter = b->letter;
    reader_block_open(b, READER_MATH, f->line, f->line);
    look_begin(b, READER_FORMULA, -1, NULL);
    source_add(b, f->inner_begin, f->inner_end, true);
    look_end(b);
    reader_block_open(b, READER_PARAGRAPH, f->line, last_line);
    b->block.continues = true;
    b->formula = formula;
    b->rest = rest;
    b->letter = letter;
}

static void formula_put(struct reader_builder *b, unsigned look, char letter)
{
    const struct reader_formula *f = formula_next(b, letter);
    if (!f)
        return;
    b->rest = masked_letters(b, f);
    if (f->display && b->block.kind == READER_PARAGRAPH) {
        formula_display(b, f);
        return;
    }
    if (b->block.spans_count)
        passage_split(b, "$", look, NULL);
    look_begin(b, (look & ~(unsigned)READER_LINK) | READER_FORMULA, -1, NULL);
    byte_add(b, '$');
    source_add(b, f->inner_begin, f->inner_end, false);
    byte_add(b, '$');
    look_end(b);
}

void reader_text_add(struct reader_builder *b, const char *utf8, unsigned look,
                     const char *target)
{
    for (const char *at = utf8; at && *at && b->status == READER_OK;) {
        if (b->rest > 0) {
            /* of a formula that is there already: its letters, and blanks between its
                 * lines */
            b->rest -= *at == b->letter;
            at++;
            continue;
        }
        if (is_sign(at)) {
            at += strlen(READER_MASK_SIGN);
            formula_put(b, look, *at);
            continue;
        }
        if (*at == ' ' && blank_is_enough(b)) {
            at++;
            continue;
        }
        look_begin(b, look, -1, target);
        for (; *at && !is_sign(at) && b->status == READER_OK; at++) {
            passage_split(b, at, look, target);
            if (*at != ' ' || !blank_is_enough(b))
                byte_add(b, shown(b, *at));
        }
        look_end(b);
    }
}

void reader_image_add(struct reader_builder *b, const char *caption, unsigned look,
                      const char *target, struct reader_asked asked)
{
    if (b->block.spans_count)
        passage_split(b, "!", look, NULL);
    look_begin(b, look | READER_IMAGE, -1, target);
    for (const char *at = caption; *at && b->status == READER_OK; at++)
        byte_add(b, (unsigned char)*at < 0x20 || *at == 0x7f ? ' ' : *at);
    look_end(b);
    if (b->status == READER_OK)
        b->block.spans[b->block.spans_count - 1].asked = asked;
}

void reader_code_add(struct reader_builder *b, const char *utf8, unsigned look)
{
    look_begin(b, look, -1, NULL);
    for (const char *at = utf8; at && *at && b->status == READER_OK; at++) {
        const struct reader_formula *f = is_sign(at) ? formula_next(b, at[2]) : NULL;
        if (!f) {
            passage_split(b, at, look, NULL);
            byte_add(b, shown(b, *at));
            continue;
        }
        int n = masked_letters(b, f);
        source_add(b, f->begin, f->end, true);
        for (at += strlen(READER_MASK_SIGN); *at && n > 0; at++)
            n -= *at == b->letter;
        at--;
    }
    look_end(b);
}

void reader_blanks_drop(struct reader_builder *b)
{
    if (b->open && b->status == READER_OK)
        blanks_drop(&b->block);
}

void reader_cell_end(struct reader_builder *b)
{
    look_begin(b, 0, -1, NULL);
    byte_add(b, '\t');
    look_end(b);
}

void reader_number_add(struct reader_builder *b, int number)
{
    char digits[16];
    snprintf(digits, sizeof digits, "%d", number);
    if (b->block.spans_count)
        passage_split(b, " ", 0, NULL);
    look_begin(b, READER_NOTE, number - 1, NULL);
    for (const char *d = digits; *d; d++)
        byte_add(b, *d);
    look_end(b);
}

/* ---- blocks ---- */

void reader_block_open(struct reader_builder *b, enum reader_kind kind, int first_line,
                       int last_line)
{
    reader_block_close(b);
    b->block = (struct reader_block){.kind = kind,
                                     .items = b->items,
                                     .quotes = b->quotes,
                                     .align = b->align,
                                     .marker = b->marker,
                                     .source = b->document->sources_count,
                                     .first_line = first_line,
                                     .last_line = last_line};
    b->marker = NULL;
    b->text_capacity = b->spans_capacity = 0;
    b->open = true;
    b->rest = 0;
    int from = 0, to = b->mask->formulas_count; /* the first formula of the block's lines */
    while (from < to) {
        int middle = from + (to - from) / 2;
        if (b->mask->formulas[middle].line < first_line)
            from = middle + 1;
        else
            to = middle;
    }
    b->formula = from;
}

/* Those that wait for a block have the last one. */
static void labels_give(struct reader_document *d)
{
    for (int i = d->labels_count; i > 0 && d->labels[i - 1].block < 0; i--)
        d->labels[i - 1].block = d->blocks_count - 1;
}

void reader_label_set(struct reader_builder *b, const char *name, size_t bytes)
{
    struct reader_document *d = b->document;
    char *copy = strndup(name, bytes);
    if (b->in_note && copy && d->notes_count &&
        array_reserve(&d->note_labels, &d->note_labels_capacity, d->note_labels_count + 1,
                      sizeof *d->note_labels)) {
        d->note_labels[d->note_labels_count++] = (struct reader_note_label){
            .name = copy, .source = d->sources_count, .note = d->notes_count - 1};
        return;
    }
    if (b->in_note || !copy ||
        !array_reserve(&d->labels, &d->labels_capacity, d->labels_count + 1,
                       sizeof *d->labels)) {
        free(copy);
        reader_builder_fail(b);
        return;
    }
    d->labels[d->labels_count++] = (struct reader_label){
        .name = copy, .source = d->sources_count, .block = -1, .first = -1};
}

void reader_labels_end(struct reader_builder *b)
{
    struct reader_document *d = b->document;
    if (d->blocks_count)
        labels_give(d);
    while (d->labels_count && d->labels[d->labels_count - 1].block < 0)
        free(d->labels[--d->labels_count].name);
}

/* Not in code, whose blanks are written. */
static bool ends_in_words(const struct reader_block *block)
{
    const struct reader_span *last =
        block->spans_count ? &block->spans[block->spans_count - 1] : NULL;
    return (block->kind == READER_PARAGRAPH || block->kind == READER_HEADING) && last &&
           !(last->look & READER_CODE);
}

void reader_block_close(struct reader_builder *b)
{
    struct reader_document *d = b->document;
    struct reader_block *block = &b->block;
    if (!b->open)
        return;
    b->open = false;
    if (ends_in_words(block))
        blanks_drop(block);
    b->note_bytes += b->in_note ? block->bytes : 0;
    if (b->note_bytes > READER_NOTE_BYTES && b->status == READER_OK)
        b->status =
            reader_fail(READER_TOO_LARGE, "line %d: a note has up to %d KB: make it a section",
                        block->first_line, READER_NOTE_BYTES >> 10);
    bool empty = !block->bytes && !block->marker && block->kind == READER_PARAGRAPH;
    struct reader_block **blocks = b->in_note ? &d->note_blocks : &d->blocks;
    int *count = b->in_note ? &d->note_blocks_count : &d->blocks_count;
    int *capacity = b->in_note ? &d->note_blocks_capacity : &d->blocks_capacity;
    if (!block->text && !empty) /* texts are never NULL */
        block->text = calloc(1, 1);
    if (b->status != READER_OK || empty || !block->text ||
        !array_reserve(blocks, capacity, *count + 1, sizeof **blocks)) {
        if (!empty)
            reader_builder_fail(b);
        reader_block_finish(block);
        return;
    }
    (*blocks)[(*count)++] = *block;
    if (b->in_note)
        d->notes[d->notes_count - 1].blocks_count++;
    else
        labels_give(d);
    *block = (struct reader_block){0};
}

void reader_marker_set(struct reader_builder *b, const char *marker, int line)
{
    if (b->marker) {
        reader_block_open(b, READER_PARAGRAPH, line, line);
        b->block.items = b->marker_items;
        reader_block_close(b);
    }
    b->marker_items = b->items;
    b->marker = strdup(marker);
    if (!b->marker)
        reader_builder_fail(b);
}
