/* read_keys.c - keys of the page. */
#include "read_desk.h"

#include <math.h>

/* The nearer one of two places before or behind a byte. */
static size_t nearer(size_t best, size_t at, size_t from, bool forward)
{
    if (forward ? at <= from : at >= from)
        return best;
    return best == G_MAXSIZE || (forward ? at < best : at > best) ? at : best;
}

/* A span that one can follow, or a demonstration, before or behind a byte. */
static size_t leading_next(const struct read_desk *d, size_t from, bool forward)
{
    const struct reader_document *doc = d->document;
    size_t best = G_MAXSIZE;
    for (int i = 0; i < doc->blocks_count + doc->note_blocks_count; i++) {
        const struct reader_block *b =
            i < doc->blocks_count ? &doc->blocks[i] : &doc->note_blocks[i - doc->blocks_count];
        if (i < doc->blocks_count && read_stages_is(b))
            best = nearer(best, b->at, from, forward);
        for (int k = 0; k < b->spans_count; k++)
            if (b->spans[k].look & (READER_LINK | READER_NOTE))
                best = nearer(best, b->at + (size_t)b->spans[k].begin, from, forward);
    }
    return best;
}

/* Its line is in the window. */
static void seen_make(struct read_desk *d, size_t byte)
{
    struct reader_box box;
    const struct reader_block *block = reader_document_block(d->document, byte);
    const double line = d->size_px * d->setup.leading;
    if (read_stages_is(block) &&
        block->at == byte) { /* its text, so that its picture is, too */
        reader_view_go(d->view, byte,
                       fmin(d->setup.height_px - line,
                            block->stage_height + d->setup.stage_strip_px + 2 * line));
        return;
    }
    const int count = reader_view_boxes(d->view, byte, byte + 1, &box, 1);
    if (count < 1 || box.y < 0 || box.y + box.height > d->setup.height_px)
        reader_view_go(d->view, byte, floor(fmax(line, d->setup.height_px / 3)));
}

bool read_keys_step(struct read_desk *d, bool forward)
{
    size_t from = d->focused;
    if (from == G_MAXSIZE && reader_view_top(d->view, &from) != READER_OK)
        return false;
    const size_t next =
        leading_next(d, d->focused == G_MAXSIZE && from ? from - 1 : from, forward);
    d->focused = next;
    if (next == G_MAXSIZE) /* behind the last: the next control has the focus */
        return false;
    seen_make(d, next);
    read_page_changed(d);
    return true;
}

static bool scroll_key(struct read_desk *d, guint key, bool shift)
{
    const double line = round(d->size_px * d->setup.leading),
                 page = fmax(line, floor(d->setup.height_px - 2 * line));
    switch (key) {
    case GDK_KEY_Down:
    case GDK_KEY_j:
        read_hand_glide(d, line);
        return true;
    case GDK_KEY_Up:
    case GDK_KEY_k:
        read_hand_glide(d, -line);
        return true;
    case GDK_KEY_space:
        read_hand_glide(d, shift ? -page : page);
        return true;
    case GDK_KEY_Page_Down:
        read_hand_glide(d, page);
        return true;
    case GDK_KEY_Page_Up:
        read_hand_glide(d, -page);
        return true;
    case GDK_KEY_Home:
        reader_view_go_part(d->view, 0);
        read_page_changed(d);
        return true;
    case GDK_KEY_End:
        reader_view_go_part(d->view, 1);
        read_page_changed(d);
        return true;
    default:
        return false;
    }
}

static void tool_set(struct read_desk *d, enum read_tool tool)
{
    read_ink_release(d, d->pointer_x, d->pointer_y);   /* what is being drawn ends */
    d->tool = d->tool == tool ? READ_TOOL_READ : tool; /* the same key again: one reads */
    read_chosen_none(d);
    gtk_widget_set_cursor_from_name(d->page, d->tool == READ_TOOL_READ   ? "text"
                                             : d->tool == READ_TOOL_MOVE ? "move"
                                                                         : "crosshair");
    d->acted(d);
}

static bool tool_key(struct read_desk *d, guint key)
{
    switch (key) {
    case GDK_KEY_h:
        read_remarks_highlight(d);
        return true;
    case GDK_KEY_n:
        read_remarks_type(d);
        return true;
    case GDK_KEY_d:
        tool_set(d, READ_TOOL_PEN);
        return true;
    case GDK_KEY_e:
        tool_set(d, READ_TOOL_ERASER);
        return true;
    case GDK_KEY_E:
        tool_set(d, READ_TOOL_SPOTS);
        return true;
    case GDK_KEY_m:
        tool_set(d, READ_TOOL_MOVE);
        return true;
    case GDK_KEY_r:
    case GDK_KEY_R:
        read_ink_play(d, key == GDK_KEY_R);
        return true;
    default:
        return false;
    }
}

bool read_keys_key(struct read_desk *d, guint key, GdkModifierType state)
{
    const bool shift = state & GDK_SHIFT_MASK;
    if (!d->view || (state & (GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK)))
        return false;
    if (read_miniatures_key(d, key) || read_grid_key(d, key) || read_stages_key(d, key))
        return true;
    if (d->tool == READ_TOOL_MOVE && read_chosen_key(d, key, shift))
        return true;
    if (key == GDK_KEY_Tab && !shift && read_stages_enter(d, d->focused))
        return true;
    if (key == GDK_KEY_Tab || key == GDK_KEY_ISO_Left_Tab)
        return read_keys_step(d, key == GDK_KEY_Tab && !shift);
    if ((key == GDK_KEY_Return || key == GDK_KEY_KP_Enter) && d->focused != G_MAXSIZE)
        return read_stages_follow(d, d->focused) || read_document_follow(d, d->focused);
    if (key == GDK_KEY_slash) {
        read_search_open(d, true);
        return true;
    }
    if (key == GDK_KEY_Escape && d->selected.end > d->selected.begin) {
        d->selected = (struct read_range){0, 0};
        read_page_changed(d);
        return true;
    }
    if (key == GDK_KEY_Escape && d->tool != READ_TOOL_READ) {
        tool_set(d, d->tool);
        return true;
    }
    return tool_key(d, key) || scroll_key(d, key, shift);
}
