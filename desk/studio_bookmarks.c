/* studio_bookmarks.c - moments that are to be found again: a wet one, before it dries. A
 * bookmark is an air that is the air of before, and so changes nothing: it is saved, inserted,
 * undone and put into scripts like all else, and stays at its moment whatever is inserted
 * earlier.
 *
 *     operations   dip stroke step x 40 air* step x 200 dip stroke
 *                                       ^ visited: the stroke is 40 steps old */
#include "studio_session_internal.h"

#include <stdlib.h>

/* Whether the last operation before this moment is one. */
static bool bookmark_here(const struct studio_session *s)
{
    int *operations, count;
    bool here = false;
    if (studio_session_bookmarks(s, &operations, &count) == PAPER_OK)
        for (int i = 0; i < count; i++)
            here = here || operations[i] == paper_history_done(s->sheet) - 1;
    free(operations);
    return here;
}

static enum paper_status bookmark_check(const struct studio_session *s)
{
    if (s->down)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "the brush is on the paper");
    if (s->inserting >= 0)
        return studio_session_failed(PAPER_BAD_ARGUMENT,
                                     "something is being inserted; go to the present first");
    if (studio_session_deeds_done(s) == 0)
        return studio_session_failed(PAPER_BAD_ARGUMENT, "nothing has been painted yet");
    if (s->present < 0 && paper_history_undone(s->sheet) > 0)
        return studio_session_failed(
            PAPER_BAD_ARGUMENT,
            "what was undone would be lost; redo it, or let time go on first");
    return PAPER_OK;
}

enum paper_status studio_session_bookmark(struct studio_session *s)
{
    const int at = paper_history_done(s->sheet);
    const bool visits = studio_session_visits(s), here = bookmark_here(s);
    enum paper_status status = bookmark_check(s);
    if (status == PAPER_OK && here) {
        status = studio_session_present(s);
        if (status == PAPER_OK)
            status = paper_history_remove(s->sheet, at - 1, false);
    } else if (status == PAPER_OK) {
        status = studio_session_insert(s);
        if (status == PAPER_OK)
            status = paper_sheet_air(s->sheet, paper_sheet_get_air(s->sheet));
        if (visits) {
            const enum paper_status end = studio_session_present(s);
            status = status == PAPER_OK ? end : status;
        }
    }
    if (status == PAPER_OK && visits)
        studio_session_visit_to(s, here ? at - 1 : at + 1);
    return status;
}

enum paper_status studio_session_bookmark_visit(struct studio_session *s, bool later)
{
    const int done = paper_history_done(s->sheet);
    int *operations = NULL, count = 0, to = -1;
    enum paper_status status = s->down || s->inserting >= 0
                                   ? bookmark_check(s)
                                   : studio_session_bookmarks(s, &operations, &count);
    if (status != PAPER_OK)
        return status;
    for (int i = 0; i < count; i++) {
        const int moment = operations[i] + 1;
        if (later ? moment > done && to < 0 : moment < done)
            to = moment;
    }
    free(operations);
    if (to >= 0)
        studio_session_visit_to(s, to);
    else if (later)
        return studio_session_present(s);
    else
        return studio_session_failed(PAPER_BAD_ARGUMENT, "there is no earlier bookmark");
    return PAPER_OK;
}
