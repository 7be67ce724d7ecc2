/* half_stroke.c - while a stroke grows: what is refused meanwhile, and how it ends without
 * being an operation. */
#include "history/history_internal.h"
#include "model/model.h"

enum paper_status history_no_stroke(const struct paper_sheet *p)
{
    const bool performing = p->history && p->history->performing;
    return !sheet_growing(p) || performing
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT, "a stroke is being painted; end it first");
}

void history_stroke_drop(struct paper_sheet *p)
{
    struct sheet_history *h = p->history;
    if (h && h->painting && !sheet_growing_painted(p))
        h->at = h->painted_at;
    if (h)
        h->painting = false;
    sheet_growing_end(p, NULL);
}
