/* studio_bookmarks.c - moments that are to be found again: a wet one, before it dries. A
 * bookmark is an operation that changes nothing but may have a name: it is saved, inserted,
 * undone and put into scripts like all else, and stays at its moment whatever is inserted
 * earlier.
 *
 *     operations   dip stroke step x 40 bookmark step x 200 dip stroke
 *                                               ^ visited: the stroke is 40 steps old */
#include "studio_session_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether the last operation before this moment is one. */
static bool bookmark_here(const struct studio_session *s)
{
    struct studio_bookmark *bookmarks;
    int count;
    bool here = false;
    if (studio_session_bookmarks(s, &bookmarks, &count) == PAPER_OK)
        for (int i = 0; i < count; i++)
            here = here || bookmarks[i].operation == paper_history_done(s->sheet) - 1;
    free(bookmarks);
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

/* One where none is. */
static enum paper_status bookmark_put(struct studio_session *s,
                                      const struct paper_bookmark *bookmark, bool visits)
{
    enum paper_status status = studio_session_insert(s);
    if (status == PAPER_OK)
        status = paper_sheet_bookmark(s->sheet, bookmark);
    if (visits) {
        const enum paper_status end = studio_session_present(s);
        status = status == PAPER_OK ? end : status;
    }
    return status;
}

/* In the place of the one before this moment; NULL: none is there any more. */
static enum paper_status bookmark_replace(struct studio_session *s, int number,
                                          const struct paper_bookmark *bookmark)
{
    studio_session_change_forget(s);
    enum paper_status status = studio_session_present(s);
    if (status == PAPER_OK && !bookmark)
        status = paper_history_remove(s->sheet, number, false);
    else if (status == PAPER_OK) {
        status = paper_history_change_begin(s->sheet, number);
        if (status == PAPER_OK) {
            status = paper_sheet_bookmark(s->sheet, bookmark);
            const enum paper_status end =
                paper_history_change_end(s->sheet, status == PAPER_OK);
            status = status == PAPER_OK ? end : status;
        }
        paper_history_mark(s->sheet);
    }
    studio_session_selection_forget(s);
    return status;
}

/* named NULL: none where one is. */
static enum paper_status bookmark_set(struct studio_session *s,
                                      const struct paper_bookmark *named)
{
    static const struct paper_bookmark nameless = {""};
    const int at = paper_history_done(s->sheet);
    const bool visits = studio_session_visits(s), here = bookmark_here(s);
    enum paper_status status = bookmark_check(s);
    if (status == PAPER_OK)
        status = here ? bookmark_replace(s, at - 1, named)
                      : bookmark_put(s, named ? named : &nameless, visits);
    if (status == PAPER_OK && visits)
        studio_session_visit_to(s, !here ? at + 1 : named ? at : at - 1);
    return status;
}

enum paper_status studio_session_bookmark(struct studio_session *s)
{
    return bookmark_set(s, NULL);
}

enum paper_status studio_session_bookmark_name(struct studio_session *s, const char *name)
{
    struct paper_bookmark bookmark;
    if (strlen(name) >= sizeof bookmark.name)
        return studio_session_failed(PAPER_BAD_ARGUMENT,
                                     "a bookmark's name has at most %zu bytes (got %zu)",
                                     sizeof bookmark.name - 1, strlen(name));
    bookmark = (struct paper_bookmark){""};
    snprintf(bookmark.name, sizeof bookmark.name, "%s", name);
    return bookmark_set(s, &bookmark);
}

enum paper_status studio_session_bookmark_visit(struct studio_session *s, bool later)
{
    const int done = paper_history_done(s->sheet);
    struct studio_bookmark *bookmarks = NULL;
    int count = 0, to = -1;
    enum paper_status status = s->down || s->inserting >= 0
                                   ? bookmark_check(s)
                                   : studio_session_bookmarks(s, &bookmarks, &count);
    if (status != PAPER_OK)
        return status;
    for (int i = 0; i < count; i++) {
        const int moment = bookmarks[i].operation + 1;
        if (later ? moment > done && to < 0 : moment < done)
            to = moment;
    }
    free(bookmarks);
    if (to >= 0)
        studio_session_visit_to(s, to);
    else if (later)
        return studio_session_present(s);
    else
        return studio_session_failed(PAPER_BAD_ARGUMENT, "there is no earlier bookmark");
    return PAPER_OK;
}
