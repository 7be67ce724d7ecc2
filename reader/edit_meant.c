/* edit_meant.c - whether what is read is what was meant, and what has moved: see
 * edit_internal.h. */
#include "edit_internal.h"

#include <stdlib.h>
#include <string.h>

/* ---- the same text ---- */

/* A text in two or three pieces, letter by letter; all blanks and line ends in a row are one:
 * a blank, a line's end, or a paragraph's. */
struct reading {
    const char *piece[3], *end[3];
    int at;
    bool begun;
};

enum { READ_END = -1, READ_PARAGRAPH = -2 };

static int byte_next(struct reading *r)
{
    while (r->at < 3 && r->piece[r->at] == r->end[r->at])
        r->at++;
    return r->at < 3 ? (unsigned char)*r->piece[r->at]++ : READ_END;
}

static int byte_look(struct reading *r)
{
    while (r->at < 3 && r->piece[r->at] == r->end[r->at])
        r->at++;
    return r->at < 3 ? (unsigned char)*r->piece[r->at] : READ_END;
}

static int letter_next(struct reading *r)
{
    int lines = 0;
    bool blank = false;
    for (int c; (c = byte_look(r)) == ' ' || c == '\n'; blank = true) {
        lines += c == '\n';
        byte_next(r);
    }
    const int next = byte_look(r);
    if (blank && r->begun && next != READ_END)
        return lines > 1 ? READ_PARAGRAPH : lines ? '\n' : ' ';
    r->begun = true;
    return byte_next(r);
}

static bool readings_same(struct reading *a, struct reading *b)
{
    for (;;) {
        const int one = letter_next(a), other = letter_next(b);
        if (one != other)
            return false;
        if (one == READ_END)
            return true;
    }
}

bool edit_meant_text(const char *before, size_t before_bytes, const struct edit_meant *meant,
                     const char *now, size_t now_bytes)
{
    struct reading a = {.piece = {before, meant->text, before + meant->end},
                        .end = {before + meant->begin, meant->text + meant->bytes,
                                before + before_bytes}},
                   b = {.piece = {now, NULL, NULL}, .end = {now + now_bytes, NULL, NULL}};
    return readings_same(&a, &b);
}

static bool has_link(const struct reader_block *block)
{
    for (int i = 0; i < block->spans_count; i++)
        if (block->spans[i].look & READER_LINK)
            return true;
    return false;
}

static bool same_text(const struct reader_block *a, const struct reader_block *b)
{
    return a->kind == b->kind && a->bytes == b->bytes &&
           memcmp(a->text, b->text, (size_t)a->bytes) == 0;
}

/* A heading's words may stand in references, too: only its own are compared, and blocks without
 * links. */
static bool heading_meant(const struct reader_document *before, const struct edit_meant *meant,
                          const struct reader_document *now)
{
    const struct reader_block *heading = reader_document_block(before, meant->begin);
    if (before->blocks_count != now->blocks_count ||
        before->note_blocks_count != now->note_blocks_count || !heading ||
        heading->kind != READER_HEADING || meant->begin < heading->at ||
        meant->end > heading->at + (size_t)heading->bytes)
        return false;
    for (int i = 0; i < before->blocks_count; i++) {
        const struct reader_block *a = &before->blocks[i], *b = &now->blocks[i];
        const struct edit_meant own = {.begin = meant->begin - heading->at,
                                       .end = meant->end - heading->at,
                                       .text = meant->text,
                                       .bytes = meant->bytes};
        if (a == heading ? b->kind != a->kind || b->level != a->level ||
                               !edit_meant_text(a->text, (size_t)a->bytes, &own, b->text,
                                                (size_t)b->bytes)
                         : !same_text(a, b) && !(has_link(a) && has_link(b)))
            return false;
    }
    return true;
}

/* Headings and code have signs in the plain text, which letters may look like: no block becomes
 * one, and where there are as many blocks, each is of its kind still. */
static bool same_kinds(const struct reader_document *before, const struct reader_document *now)
{
    int signs = 0; /* more than there were */
    for (int i = 0; i < now->blocks_count; i++)
        signs += now->blocks[i].kind == READER_HEADING || now->blocks[i].info ||
                 now->blocks[i].kind == READER_CODE_BLOCK || now->blocks[i].kind == READER_HTML;
    for (int i = 0; i < before->blocks_count; i++)
        signs -= before->blocks[i].kind == READER_HEADING || before->blocks[i].info ||
                 before->blocks[i].kind == READER_CODE_BLOCK ||
                 before->blocks[i].kind == READER_HTML;
    if (signs > 0)
        return false;
    for (int i = 0; i < now->blocks_count && before->blocks_count == now->blocks_count; i++)
        if (before->blocks[i].kind != now->blocks[i].kind ||
            before->blocks[i].level != now->blocks[i].level)
            return false;
    return true;
}

bool edit_meant_document(const struct reader_document *before, const struct edit_meant *meant,
                         const struct reader_document *now)
{
    return meant->any ||
           (edit_meant_text(before->plain, before->plain_bytes, meant, now->plain,
                            now->plain_bytes) &&
            same_kinds(before, now)) ||
           heading_meant(before, meant, now);
}

/* ---- what has moved ---- */

bool edit_move_add(struct reader_edit_change *change, size_t at, size_t removed,
                   size_t inserted)
{
    struct reader_edit_move *more =
        realloc(change->moves, ((size_t)change->moves_count + 1) * sizeof *more);
    if (!more)
        return false;
    change->moves = more;
    more[change->moves_count++] = (struct reader_edit_move){at, removed, inserted};
    return true;
}

/* The bytes that are other: one move. */
static bool bytes_move(struct reader_edit_change *change, const char *a, size_t a_bytes,
                       const char *b, size_t b_bytes, size_t at)
{
    size_t begin = 0, end = 0;
    const size_t least = a_bytes < b_bytes ? a_bytes : b_bytes;
    if (a_bytes == b_bytes && memcmp(a, b, a_bytes) == 0)
        return true;
    while (begin < least && a[begin] == b[begin])
        begin++;
    while (end < least - begin && a[a_bytes - 1 - end] == b[b_bytes - 1 - end])
        end++;
    return edit_move_add(change, at + begin, a_bytes - begin - end, b_bytes - begin - end);
}

static bool blocks_move(struct reader_edit_change *change, const struct reader_block *a,
                        const struct reader_block *b, int count, size_t *a_end, size_t *b_end)
{
    for (int i = 0; i < count; i++) {
        const size_t a_gap = a[i].at - *a_end, b_gap = b[i].at - *b_end;
        if (a_gap != b_gap && !edit_move_add(change, *b_end, a_gap, b_gap))
            return false;
        if (!bytes_move(change, a[i].bytes ? a[i].text : "", (size_t)a[i].bytes,
                        b[i].bytes ? b[i].text : "", (size_t)b[i].bytes, b[i].at))
            return false;
        *a_end = a[i].at + (size_t)a[i].bytes;
        *b_end = b[i].at + (size_t)b[i].bytes;
    }
    return true;
}

bool edit_moves_find(const struct reader_document *before, const struct reader_document *now,
                     struct reader_edit_change *change)
{
    size_t a_end = 0, b_end = 0;
    if (before->blocks_count != now->blocks_count ||
        before->note_blocks_count != now->note_blocks_count)
        return bytes_move(change, before->plain, before->plain_bytes, now->plain,
                          now->plain_bytes, 0);
    return blocks_move(change, before->blocks, now->blocks, now->blocks_count, &a_end,
                       &b_end) &&
           blocks_move(change, before->note_blocks, now->note_blocks, now->note_blocks_count,
                       &a_end, &b_end) &&
           (before->plain_bytes - a_end == now->plain_bytes - b_end ||
            edit_move_add(change, b_end, before->plain_bytes - a_end,
                          now->plain_bytes - b_end));
}

size_t reader_edit_moved(const struct reader_edit_change *change, size_t byte)
{
    for (int i = 0; i < change->moves_count; i++) {
        const struct reader_edit_move *m = &change->moves[i];
        if (byte >= m->at + m->removed)
            byte = byte - m->removed + m->inserted;
        else if (byte > m->at)
            byte = m->at;
    }
    return byte;
}

void reader_edit_change_finish(struct reader_edit_change *change)
{
    reader_document_destroy(change->before);
    free(change->moves);
    *change = (struct reader_edit_change){.block = -1};
}
