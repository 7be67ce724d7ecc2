/* plain.c - a document's plain text, and what is found in it: see reader_document.h. */
#include "reader_internal.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <text.h>
#include <wctype.h>

/* ---- making ---- */

/* What stands before and behind a block's text. */
static const char *before_of(const struct reader_block *block)
{
    static const char *const signs[] = {"# ", "## ", "### ", "#### ", "##### ", "###### "};
    switch (block->kind) {
    case READER_HEADING:
        return signs[block->level < 1 ? 0 : block->level > 6 ? 5 : block->level - 1];
    case READER_CODE_BLOCK:
    case READER_LIVE:
    case READER_HTML:
        return "```\n";
    case READER_PARAGRAPH:
    case READER_MATH:
    case READER_RULE:
    case READER_ROW:
    case READER_PICTURE:
        break;
    }
    return "";
}

/* next: the block behind it; NULL: none. Where its length has cut a paragraph, there are
 * blanks, if there were any, so that the text does not depend on where that is. */
static const char *behind_of(const struct reader_block *block, const struct reader_block *next)
{
    if (next && reader_block_is_cut_off(next))
        return next->unspaced ? "" : "  ";
    return before_of(block)[0] == '`' ? "\n```\n\n" : "\n\n";
}

static const struct reader_block *next_of(const struct reader_block *blocks, int count, int i)
{
    return i + 1 < count ? &blocks[i + 1] : NULL;
}

static size_t bytes_of(const struct reader_block *blocks, int count)
{
    size_t bytes = 0;
    for (int i = 0; i < count; i++)
        bytes += strlen(before_of(&blocks[i])) + (size_t)blocks[i].bytes +
                 strlen(behind_of(&blocks[i], next_of(blocks, count, i)));
    return bytes;
}

static char *blocks_write(struct reader_block *blocks, int count, const char *begin, char *at)
{
    for (int i = 0; i < count; i++) {
        at = stpcpy(at, before_of(&blocks[i]));
        blocks[i].at = (size_t)(at - begin);
        if (blocks[i].bytes)
            memcpy(at, blocks[i].text, (size_t)blocks[i].bytes);
        at = stpcpy(at + blocks[i].bytes, behind_of(&blocks[i], next_of(blocks, count, i)));
    }
    return at;
}

enum reader_status reader_document_plain(struct reader_document *d)
{
    const size_t bytes =
        bytes_of(d->blocks, d->blocks_count) + bytes_of(d->note_blocks, d->note_blocks_count);
    char *text = bytes < INT_MAX ? malloc(bytes + 1) : NULL;
    if (!text)
        return bytes < INT_MAX ? reader_fail(READER_NO_MEMORY, "no memory for a document")
                               : reader_fail(READER_TOO_LARGE,
                                             "a document of %zu bytes is too large", bytes);
    free(d->plain);
    char *at = blocks_write(d->blocks, d->blocks_count, text, text);
    at = blocks_write(d->note_blocks, d->note_blocks_count, text, at);
    *at = '\0';
    d->plain = text;
    d->plain_bytes = (size_t)(at - text);
    return READER_OK;
}

/* ---- finding blocks and spans ---- */

/* The last block that begins at or before the byte, or the first. */
static const struct reader_block *block_among(const struct reader_block *blocks, int count,
                                              size_t byte)
{
    int low = 0, high = count;
    while (high - low > 1) {
        int half = (low + high) / 2;
        if (blocks[half].at <= byte)
            low = half;
        else
            high = half;
    }
    return count ? &blocks[low] : NULL;
}

const struct reader_block *reader_document_block(const struct reader_document *d, size_t byte)
{
    const bool noted = d->note_blocks_count && d->note_blocks[0].at <= byte;
    return noted || !d->blocks_count ? block_among(d->note_blocks, d->note_blocks_count, byte)
                                     : block_among(d->blocks, d->blocks_count, byte);
}

const struct reader_span *reader_document_span(const struct reader_document *d, size_t byte)
{
    const struct reader_block *block = reader_document_block(d, byte);
    if (!block || byte < block->at || byte - block->at >= (size_t)block->bytes)
        return NULL;
    const int at = (int)(byte - block->at);
    for (int i = 0; i < block->spans_count; i++)
        if (at >= block->spans[i].begin && at < block->spans[i].end)
            return &block->spans[i];
    return NULL;
}

/* ---- searching ---- */

static bool is_blank(uint32_t c)
{
    return c == ' ' || c == '\n' || c == '\t' || c == 0xa0;
}

/* The next letter, whatever its case; all blanks in a row are one. */
static uint32_t letter_next(const char **at, const char *end)
{
    uint32_t c;
    font_utf8_next(at, end, &c);
    if (!is_blank(c))
        return (uint32_t)towlower((wint_t)c);
    for (const char *next = *at; next < end; *at = next) {
        uint32_t more;
        font_utf8_next(&next, end, &more);
        if (!is_blank(more))
            break;
    }
    return ' ';
}

/* Where the text at `at` has all of what is looked for; its end, or NULL. */
static const char *match_at(const char *at, const char *end, const char *what, size_t bytes)
{
    const char *const stop = what + bytes;
    while (what < stop) {
        if (at >= end || letter_next(&at, end) != letter_next(&what, stop))
            return NULL;
    }
    return at;
}

bool reader_document_search(const struct reader_document *d, const char *utf8, size_t from,
                            bool forward, size_t *begin, size_t *end)
{
    const size_t bytes = strlen(utf8);
    const char *const stop = d->plain + d->plain_bytes;
    if (!bytes || !d->plain)
        return false;
    for (size_t at = from < d->plain_bytes ? from : d->plain_bytes;; at += forward) {
        if (forward ? at >= d->plain_bytes : at-- == 0)
            return false;
        const bool begins = ((unsigned char)d->plain[at] & 0xc0) != 0x80;
        const char *found = begins ? match_at(d->plain + at, stop, utf8, bytes) : NULL;
        if (found) {
            *begin = at;
            *end = (size_t)(found - d->plain);
            return true;
        }
    }
}
