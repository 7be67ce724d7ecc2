/* pages_notes.c - the notes that paragraphs call: see pages_internal.h. */
#include "pages_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How far notes that open in place are moved in. */
static double note_left(const struct reader_pages *p)
{
    return fmin(1.5 * p->setup.size_px, pages_column(p) / 8);
}

/* A picture that is alone in its paragraph: on a line of its own, its caption below. */
static enum reader_status note_picture(struct reader_pages *p, const struct reader_block *block,
                                       double most_px, struct paragraph_text *t)
{
    const struct line_span own = {
        .image = block->target, .asked = block->asked, .source = block->source};
    const struct pictured *image = NULL;
    enum reader_status status =
        own.image ? pages_image(p, &own, CONTEXT_NOTE, most_px, &image) : READER_OK;
    if (status != READER_OK || !image)
        return status;
    if (!pages_text_add(t, "-", 1, READER_IMAGE)) /* the letter is not seen */
        return pages_no_memory();
    struct line_span *span = &t->spans[t->spans_count - 1];
    span->image = own.image;
    span->asked = own.asked;
    span->source = own.source;
    return !block->bytes || pages_text_add(t, "\n", 1, 0) ? READER_OK : pages_no_memory();
}

/* All blocks of a note as one paragraph, its number before it. */
static enum reader_status note_text(struct reader_pages *p, int note, double most_px,
                                    struct paragraph_text *t)
{
    const struct reader_document *d = p->document;
    const struct reader_note *n = &d->notes[note];
    char number[16];
    int length = snprintf(number, sizeof number, "%d", note + 1);
    bool good = pages_text_add(t, number, length, READER_NOTE) && pages_text_add(t, " ", 1, 0);
    for (int i = 0; good && i < n->blocks_count; i++) {
        const struct reader_block *block = &d->note_blocks[n->first_block + i];
        const char *marker = block->marker;
        good = (i == 0 || pages_text_add(t, "\n", 1, 0)) &&
               (!marker || (pages_text_add(t, marker, (int)strlen(marker), 0) &&
                            pages_text_add(t, " ", 1, 0)));
        const enum reader_status status = good && block->kind == READER_PICTURE
                                              ? note_picture(p, block, most_px, t)
                                              : READER_OK;
        if (status != READER_OK)
            return status;
        good = good && pages_block_add(t, block, 0, block->bytes, 0);
    }
    for (int k = 0; good && k < t->bytes; k++)
        if (t->text[k] == '\t')
            t->text[k] = ' ';
    return good ? READER_OK : pages_no_memory();
}

/* Where a column is scrolled, a note that has no margin is a paragraph behind the one that
 * calls it, moved in. */
static enum reader_status note_put(struct reader_pages *p, bool margin, int id, int byte,
                                   const struct paragraph_text *t, struct page_manner *manner,
                                   int style, int *note_id)
{
    enum font_status status;
    if (!p->made || margin) {
        status = page_note_add(p->text, id, byte, margin ? PAGE_NOTE_MARGIN : PAGE_NOTE_FOOT,
                               t->text, (size_t)t->bytes, style, manner, note_id);
    } else {
        const double em = p->setup.size_px;
        manner->left_px = note_left(p);
        manner->before_px = manner->after_px = 0.3 * em;
        manner->role = FONT_ROLE_NOTE;
        status = page_paragraph_add(p->text, 0, p->at, t->text, (size_t)t->bytes, style, manner,
                                    note_id);
        p->at += status == FONT_OK;
    }
    return status == FONT_OK ? READER_OK : pages_failed();
}

/* A note that is put there. */
struct note_place {
    int note, id, byte;
    bool margin;
    double most_px;
};

static enum reader_status piece_add(struct reader_pages *p, void *user,
                                    struct paragraph_text *piece,
                                    const struct pages_piece_place *place)
{
    const struct note_place *n = user;
    struct page_manner manner = pages_manner(p, CONTEXT_NOTE);
    int style, id;
    if (n->margin || place->picture)
        manner.align = FONT_ALIGN_START;
    enum reader_status status = pages_style(p, CONTEXT_NOTE, 0, &style);
    if (status == READER_OK)
        status = note_put(p, n->margin, n->id, n->byte, piece, &manner, style, &id);
    if (status == READER_OK)
        status = pages_styles_apply(p, id, piece, CONTEXT_NOTE, true, n->most_px);
    return status == READER_OK ? pages_made_keep(p, id, n->note, piece) : status;
}

/* All of it; t: what it says. */
static enum reader_status note_add(struct reader_pages *p, int note, int id, int byte,
                                   struct paragraph_text *t)
{
    const char *class = p->document->notes[note].class;
    const bool margin = (p->made || strcmp(class, "margin") == 0) && pages_notes(p) > 0;
    const double left = p->made && !margin ? note_left(p) : 0;
    struct note_place place = {note, id, byte, margin,
                               margin ? pages_notes(p) : pages_column(p) - left};
    enum reader_status status = note_text(p, note, place.most_px, t);
    return status == READER_OK
               ? pages_pieces(p, t, CONTEXT_NOTE, place.most_px, piece_add, &place)
               : status;
}

/* Whether a note that is called is to be set now: once; where a column is scrolled, if it is
 * open in this passage. */
static bool note_wanted(struct reader_pages *p, int note)
{
    if (note < 0 || note >= p->document->notes_count || p->noted[note])
        return false;
    if (p->made && p->opened[note] != p->passage &&
        !(pages_notes(p) > 0 && strcmp(p->document->notes[note].class, "margin") == 0))
        return false;
    p->noted[note] = true;
    return true;
}

/* The note, and those that it calls, which stand behind it at the same place. */
static enum reader_status notes_chain(struct reader_pages *p, int note, int id, int byte)
{
    enum reader_status status = READER_OK;
    int *queue = NULL, count = 0, capacity = 0;
    if (!array_reserve(&queue, &capacity, 1, sizeof *queue))
        return pages_no_memory();
    queue[count++] = note;
    for (int k = 0; k < count && status == READER_OK; k++) {
        struct paragraph_text text = {0};
        status = note_add(p, queue[k], id, byte, &text);
        for (int s = 1; s < text.spans_count && status == READER_OK; s++) {
            int next = text.spans[s].note;
            if (!note_wanted(p, next))
                continue;
            if (!array_reserve(&queue, &capacity, count + 1, sizeof *queue))
                status = pages_no_memory();
            else
                queue[count++] = next;
        }
        pages_text_finish(&text);
    }
    free(queue);
    return status;
}

/* Each where it is called first. */
enum reader_status pages_notes_add(struct reader_pages *p, int id,
                                   const struct paragraph_text *t, int byte)
{
    enum reader_status status = READER_OK;
    for (int i = 0; i < t->spans_count && status == READER_OK; i++)
        if (note_wanted(p, t->spans[i].note))
            status = notes_chain(p, t->spans[i].note, id, byte >= 0 ? byte : t->spans[i].end);
    return status;
}
