/* notes.c - what a program did with a sheet, in order: operations, and moves back and forth
 * among them.
 *
 *     notes   put   step x 20   undo 1   step x 10   blot        what the program did
 *     ops     put   step x 10   blot                             the result
 *
 * A saved run is followed by its notes. A program that is run again repeats them, including
 * operations that it undoes later, and none of them is computed. When the last note has been
 * repeated, the saved state becomes current. The note of an operation holds its kind, its steps
 * and a digest of its arguments.
 *
 * If nothing was undone or inserted, the notes follow from the operations, and are not
 * saved.
 */
#include "history/history_internal.h"

#include <array.h>

#include <stdlib.h>
#include <string.h>

static bool is_move(int what)
{
    return what >= NOTE_UNDO;
}

void notes_add(struct notes *n, struct note note)
{
    if (n->lost)
        return;
    if (!array_reserve(&n->at, &n->room, n->count + 1, sizeof *n->at)) {
        n->lost = true;
        return;
    }
    n->at[n->count++] = note;
}

void notes_free(struct notes *n)
{
    free(n->at);
    *n = (struct notes){0};
}

bool notes_derive(struct sheet_history *h)
{
    struct position end = h->now;
    notes_free(&h->notes);
    for (int i = 0; i < end.op + (end.step > 0); i++) {
        const struct event_record *op = &h->log.records[i];
        notes_add(&h->notes, (struct note){(int)op->kind, i < end.op ? op->steps : end.step,
                                           event_record_digest(op)});
    }
    return !h->notes.lost;
}

/* ---- following ---- */

void history_stray(struct sheet_history *h)
{
    struct notes *n = &h->notes;
    if (!h->following)
        return;
    if (n->steps > 0) /* what was repeated becomes what was done */
        n->at[n->repeated++].number = n->steps;
    n->count = n->repeated;
    n->steps = 0;
    h->following = h->loaded = false;
    h->diverged = true;
    checkpoint_saved_free(h);
}

bool history_foreseen(struct sheet_history *h, struct note note, int *steps)
{
    struct notes *n = &h->notes;
    if (!h->following)
        return false;
    const struct note *expected = &n->at[n->repeated];
    if (expected->what != note.what || expected->digest != note.digest ||
        (is_move(note.what) && expected->number != note.number)) {
        history_stray(h);
        return false;
    }
    if (note.what == SHEET_EVENT_STEP && ++n->steps < expected->number)
        return true;
    if (steps && note.what != SHEET_EVENT_STEP)
        *steps = (int)expected->number;
    n->steps = 0;
    n->repeated++;
    return true;
}

void history_followed(struct sheet_history *h)
{
    if (!h->following || h->notes.repeated < h->notes.count)
        return;
    h->following = false;
    h->resumed = history_time(h, h->now);
    checkpoint_saved_place(h);
    if (h->loaded) {
        h->at = h->now;
        h->work = history_work(h, h->now);
        h->loaded = false;
    }
}

void history_moved(struct sheet_history *h, enum note_move what, long number)
{
    struct note note = {(int)what, number, 0};
    if (h->tell)
        h->tell(h->tell_context, NULL, false, what, number);
    if (!history_foreseen(h, note, NULL))
        notes_add(&h->notes, note);
}

/* ---- as bytes ---- */

void notes_encode(struct event_bytes *b, const struct sheet_history *h)
{
    const struct notes *n = &h->notes;
    int count = h->following ? n->repeated + (n->steps > 0) : n->count;
    bool moved = false;
    for (int i = 0; i < count; i++)
        moved |= is_move(n->at[i].what);
    if (!moved || n->lost)
        return;
    event_put_number(b, (uint64_t)count, 4);
    for (int i = 0; i < count; i++) {
        bool part = h->following && i == n->repeated;
        event_put_number(b, (uint64_t)n->at[i].what, 1);
        event_put_number(b, (uint64_t)(part ? n->steps : n->at[i].number), 8);
        event_put_number(b, n->at[i].digest, 8);
    }
}

bool notes_decode(struct event_reader *r, const int kinds[256], struct notes *n)
{
    uint64_t count = event_get_number(r, 4);
    for (uint64_t i = 0; i < count && !r->bad; i++) {
        int what = (int)event_get_number(r, 1);
        int64_t number = (int64_t)event_get_number(r, 8);
        uint64_t digest = event_get_number(r, 8);
        if (!is_move(what))
            what = kinds[what];
        r->bad |= what < 0 || what >= NOTE_MOVES_END || number < 0 || number > INT32_MAX ||
                  (what == SHEET_EVENT_STEP && number == 0);
        if (!r->bad)
            notes_add(n, (struct note){what, (long)number, digest});
    }
    return !n->lost;
}
