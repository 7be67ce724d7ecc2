/* edit_block.c - one paragraph that is read alone, in place of all files: see edit_internal.h.
 *
 * It stands between blank lines, in no list and no quote, and has neither before nor afterwards
 * what other blocks could depend on: brackets, tags, formulas, fences. */
#include "builder.h"
#include "edit_internal.h"

#include <stdlib.h>
#include <string.h>

static bool is_blank_line(const char *s, size_t at, size_t bytes)
{
    while (at < bytes && (s[at] == ' ' || s[at] == '\t'))
        at++;
    return at == bytes || s[at] == '\n';
}

/* Whether the lines begin..end stand between blank ones. */
static bool stands_alone(const struct reader_bytes *source, size_t begin, size_t end)
{
    const char *s = source->text;
    size_t before = begin;
    if (begin > 0) {
        for (before--; before > 0 && s[before - 1] != '\n';)
            before--;
        if (!is_blank_line(s, before, source->bytes))
            return false;
    }
    return end >= source->bytes || (s[end] == '\n' && is_blank_line(s, end + 1, source->bytes));
}

/* Whether nothing else can depend on it, nor it on anything else. */
static bool is_plain(const char *s, size_t bytes)
{
    if (!bytes || s[0] == ' ' || s[0] == '\t')
        return false;
    for (size_t i = 0; i < bytes; i++) {
        if (strchr("[<$\r", s[i]))
            return false;
        if ((s[i] == '`' || s[i] == '~') && i + 2 < bytes && s[i + 1] == s[i] &&
            s[i + 2] == s[i])
            return false;
    }
    return true;
}

/* These lines as a document; NULL: they are not one paragraph. */
static struct reader_document *paragraph_read(const char *s, size_t bytes)
{
    struct reader_document *d;
    if (!is_plain(s, bytes) || reader_document_create(&d) != READER_OK)
        return NULL;
    const bool good = reader_document_add(d, s, bytes) == READER_OK && d->blocks_count == 1 &&
                      d->blocks[0].kind == READER_PARAGRAPH && !d->blocks[0].items &&
                      !d->blocks[0].quotes && !d->notes_count && !d->labels_count &&
                      !d->blocks[0].include && !d->blocks[0].continues;
    if (good)
        return d;
    reader_document_destroy(d);
    return NULL;
}

static int line_of(const struct reader_bytes *source, size_t at)
{
    int line = 1;
    for (const char *s = source->text, *stop = s + at;
         (s = memchr(s, '\n', (size_t)(stop - s))); s++)
        line++;
    return line;
}

/* The only block that the line is of, a paragraph of the text; -1: there is none such. */
static int block_of_line(const struct reader_document *d, int source, int line)
{
    int found = -1;
    for (int i = 0; i < d->blocks_count; i++) {
        const struct reader_block *b = &d->blocks[i];
        if (b->source != source || line < b->first_line || line > b->last_line)
            continue;
        if (found >= 0 || b->kind != READER_PARAGRAPH || b->items || b->quotes ||
            b->continues || b->include)
            return -1;
        found = i;
    }
    for (int i = 0; i < d->note_blocks_count && found >= 0; i++) {
        const struct reader_block *b = &d->note_blocks[i];
        if (b->source == source && line >= b->first_line && line <= b->last_line)
            return -1;
    }
    return found;
}

static bool is_once(const struct reader_files *files, int source)
{
    for (int i = 0; i < files->count; i++)
        if (i != source && files->whole[i] && files->whole[source] &&
            strcmp(files->whole[i], files->whole[source]) == 0)
            return false;
    return true;
}

/* ---- in place ---- */

static bool bytes_replace(char **text, size_t *bytes, size_t at, size_t removed,
                          const char *with, size_t with_bytes)
{
    const size_t now = *bytes - removed + with_bytes;
    if (now > *bytes) {
        char *more = realloc(*text, now + 1);
        if (!more)
            return false;
        *text = more;
    }
    memmove(*text + at + with_bytes, *text + at + removed, *bytes - at - removed + 1);
    if (with_bytes)
        memcpy(*text + at, with, with_bytes);
    *bytes = now;
    return true;
}

static void blocks_shift(struct reader_block *blocks, int count, int source, int line,
                         int lines, size_t at, size_t removed, size_t inserted)
{
    for (int i = 0; i < count; i++) {
        if (blocks[i].at > at)
            blocks[i].at = blocks[i].at - removed + inserted;
        if (blocks[i].source == source && blocks[i].first_line > line) {
            blocks[i].first_line += lines;
            blocks[i].last_line += lines;
        }
    }
}

/* The document has the paragraph of another one, whose only one it is. */
static bool paragraph_take(struct reader_document *d, int block, struct reader_document *from)
{
    struct reader_block *b = &d->blocks[block], *now = &from->blocks[0];
    const size_t removed = (size_t)b->bytes, inserted = (size_t)now->bytes;
    const int line = b->first_line, lines = now->last_line - (b->last_line - line + 1);
    if (!bytes_replace(&d->plain, &d->plain_bytes, b->at, removed, now->text, inserted))
        return false;
    struct reader_block taken = *now;
    taken.source = b->source;
    taken.at = b->at;
    taken.first_line = line;
    taken.last_line = b->last_line + lines;
    *now = *b;
    *b = taken;
    blocks_shift(d->blocks, d->blocks_count, b->source, line, lines, b->at, removed, inserted);
    blocks_shift(d->note_blocks, d->note_blocks_count, b->source, line, lines, b->at, removed,
                 inserted);
    for (int i = 0; i < d->lost_count; i++)
        if (d->lost[i].source == b->source && d->lost[i].line > line)
            d->lost[i].line += lines;
    return true;
}

/* ---- trying ---- */

struct alone {
    int block;
    size_t begin, end; /* its lines */
    char *now;         /* what they become */
    size_t now_bytes;
};

static bool alone_find(const struct reader_document *d, const struct reader_files *files,
                       const struct edit_splice *splice, struct alone *out)
{
    const struct reader_bytes *source = &files->texts[splice->source];
    int begin, end;
    *out =
        (struct alone){.block = block_of_line(d, splice->source, line_of(source, splice->at))};
    if (out->block < 0 || !is_once(files, splice->source))
        return false;
    const struct reader_block *b = &d->blocks[out->block];
    edit_lines_find(source, b->first_line, b->last_line, &begin, &end);
    out->begin = (size_t)begin;
    out->end = (size_t)end;
    if (splice->at < out->begin || splice->at + splice->removed > out->end ||
        !stands_alone(source, out->begin, out->end))
        return false;
    struct reader_document *was = paragraph_read(source->text + begin, out->end - out->begin);
    const bool same = was && was->blocks[0].bytes == b->bytes &&
                      memcmp(was->blocks[0].text, b->text, (size_t)b->bytes) == 0;
    reader_document_destroy(was);
    if (!same)
        return false;
    const size_t before = splice->at - out->begin,
                 behind = out->end - splice->at - splice->removed;
    out->now_bytes = before + splice->bytes + behind;
    out->now = malloc(out->now_bytes + 1);
    if (!out->now)
        return false;
    memcpy(out->now, source->text + begin, before);
    if (splice->bytes)
        memcpy(out->now + before, splice->text, splice->bytes);
    memcpy(out->now + before + splice->bytes, source->text + splice->at + splice->removed,
           behind);
    out->now[out->now_bytes] = '\0';
    return true;
}

static bool alone_move(struct reader_edit_change *change, const struct reader_block *b,
                       const struct reader_block *now, const struct edit_meant *meant)
{
    const size_t removed = meant->end - meant->begin;
    if (!meant->any && (size_t)now->bytes + removed == (size_t)b->bytes + meant->bytes)
        return edit_move_add(change, meant->begin, removed, meant->bytes);
    int begin = 0, end = 0;
    const int least = b->bytes < now->bytes ? b->bytes : now->bytes;
    while (begin < least && b->text[begin] == now->text[begin])
        begin++;
    while (end < least - begin &&
           b->text[b->bytes - 1 - end] == now->text[now->bytes - 1 - end])
        end++;
    return edit_move_add(change, b->at + (size_t)begin, (size_t)(b->bytes - begin - end),
                         (size_t)(now->bytes - begin - end));
}

enum reader_status edit_block_try(struct reader_document *d, struct reader_files *files,
                                  const struct edit_splice *splice,
                                  const struct edit_meant *meant,
                                  struct reader_edit_change *change, bool *done)
{
    struct reader_bytes *source = &files->texts[splice->source];
    struct alone alone;
    *done = false;
    if (source->bytes - splice->removed + splice->bytes > READER_BYTES_MAX ||
        !alone_find(d, files, splice, &alone))
        return READER_OK;
    struct reader_document *now = paragraph_read(alone.now, alone.now_bytes);
    free(alone.now);
    if (!now)
        return READER_OK;
    const struct reader_block *b = &d->blocks[alone.block];
    const struct edit_meant own = {.begin = meant->begin - b->at,
                                   .end = meant->end - b->at,
                                   .text = meant->text,
                                   .bytes = meant->bytes};
    const bool within = meant->begin >= b->at && meant->end <= b->at + (size_t)b->bytes;
    bool good = true;
    if (meant->any ||
        (within && edit_meant_text(b->text, (size_t)b->bytes, &own, now->blocks[0].text,
                                   (size_t)now->blocks[0].bytes))) {
        good = alone_move(change, b, &now->blocks[0], meant) &&
               bytes_replace(&source->text, &source->bytes, splice->at, splice->removed,
                             splice->text, splice->bytes);
        if (good) {
            files->bytes += files->from[splice->source] >= 0
                                ? (double)splice->bytes - (double)splice->removed
                                : 0;
            good = paragraph_take(d, alone.block, now);
        }
        change->block = alone.block;
        *done = good;
    }
    reader_document_destroy(now);
    return good ? READER_OK : reader_fail(READER_NO_MEMORY, "no memory for an edit");
}
