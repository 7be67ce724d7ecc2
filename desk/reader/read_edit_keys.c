/* read_edit_keys.c - keys of the page while it is edited, where the caret goes by them, and the
 * pointer. */
#include "read_edit.h"

#include <math.h>
#include <string.h>

/* ---- along the text ---- */

static const struct reader_block *block_of(const struct read_desk *d, size_t byte)
{
    return reader_document_block(d->document, byte);
}

/* The block behind another one in the plain text, or before it; NULL: there is none. */
static const struct reader_block *block_beside(const struct read_desk *d,
                                               const struct reader_block *b, bool forward)
{
    const struct reader_document *doc = d->document;
    const bool noted = doc->note_blocks && b >= doc->note_blocks &&
                       b < doc->note_blocks + doc->note_blocks_count;
    const struct reader_block *all = noted ? doc->note_blocks : doc->blocks;
    const int count = noted ? doc->note_blocks_count : doc->blocks_count;
    const long at = b - all + (forward ? 1 : -1);
    return at >= 0 && at < count ? all + at : NULL;
}

/* The next place in a block's text where a caret can be, or a word begins or ends; -1: there is
 * none. */
static long step_within(const struct reader_block *b, long at, bool forward, bool word)
{
    const glong letters = g_utf8_strlen(b->text, b->bytes);
    PangoLogAttr *attributes = g_new0(PangoLogAttr, letters + 1);
    pango_get_log_attrs(b->text, b->bytes, -1, pango_language_get_default(), attributes,
                        (int)letters + 1);
    glong i = g_utf8_pointer_to_offset(b->text, b->text + at);
    long found = -1;
    for (i += forward ? 1 : -1; i >= 0 && i <= letters && found < 0; i += forward ? 1 : -1) {
        const bool stops = !word     ? attributes[i].is_cursor_position
                           : forward ? attributes[i].is_word_end || i == letters
                                     : attributes[i].is_word_start || i == 0;
        if (stops)
            found = g_utf8_offset_to_pointer(b->text, i) - b->text;
    }
    g_free(attributes);
    return found;
}

static size_t step(const struct read_desk *d, size_t byte, bool forward, bool word)
{
    const struct reader_block *b = block_of(d, byte);
    if (!b)
        return byte;
    const long at = (long)MIN(byte - MIN(byte, b->at), (size_t)b->bytes);
    const long found = step_within(b, at, forward, word);
    if (found >= 0)
        return b->at + (size_t)found;
    const struct reader_block *beside = block_beside(d, b, forward);
    if (!beside)
        return byte;
    return forward ? beside->at : beside->at + (size_t)beside->bytes;
}

/* ---- lines ---- */

static void line_go(struct read_desk *d, double by_px, bool select)
{
    struct read_editing *e = d->editing;
    struct reader_box box, now;
    size_t byte;
    bool before;
    read_edit_wanted(d);
    if (!read_edit_caret_box(d, &box))
        return;
    const double x = e->want_x >= 0 ? e->want_x : box.x, line = d->size_px * d->setup.leading;
    double y = box.y + box.height / 2 + by_px;
    if (y < 0 || y >= d->setup.height_px) {
        reader_view_scroll(d->view,
                           y < 0 ? floor(y - line) : ceil(y - d->setup.height_px + line));
        if (!read_edit_caret_box(d, &now))
            return;
        y += now.y - box.y;
        box = now;
    }
    /* over what stands between lines, to the next one */
    for (int tries = 0; tries<40; tries++, y += by_px> 0 ? line / 2 : -line / 2) {
        if (!reader_view_caret_at(d->view, x, y, &byte, &before))
            return;
        read_edit_caret(d, byte, before, select);
        e->want_x = x;
        if (!read_edit_caret_box(d, &now) || fabs(now.y - box.y) > 1)
            break;
    }
    read_edit_wanted(d);
}

static void edge_go(struct read_desk *d, bool end, bool all, bool select)
{
    struct reader_box box;
    size_t byte;
    bool before;
    const struct reader_document *doc = d->document;
    if (all && doc->blocks_count) {
        const struct reader_block *b = &doc->blocks[end ? doc->blocks_count - 1 : 0];
        read_edit_caret(d, end ? b->at + (size_t)b->bytes : b->at, end, select);
    } else if (read_edit_caret_box(d, &box) &&
               reader_view_caret_at(d->view, end ? 1e5 : -1e5, box.y + box.height / 2, &byte,
                                    &before)) {
        read_edit_caret(d, byte, end, select);
    }
    read_edit_wanted(d);
}

/* ---- keys ---- */

static void delete_key(struct read_desk *d, bool forward, bool word)
{
    const struct read_range range = read_edit_range(d);
    if (range.end > range.begin) {
        read_edit_delete(d, range.begin, range.end);
        return;
    }
    if (!forward && reader_edit_wait_end(d->editing->edit)) {
        read_page_changed(d);
        return;
    }
    const size_t to = step(d, d->editing->caret, forward, word);
    if (to != d->editing->caret)
        read_edit_delete(d, MIN(to, d->editing->caret), MAX(to, d->editing->caret));
}

static void side_go(struct read_desk *d, bool forward, bool word, bool select)
{
    const struct read_range range = read_edit_range(d);
    if (!select && !word && range.end > range.begin)
        read_edit_caret(d, forward ? range.end : range.begin, forward, false);
    else
        read_edit_caret(d, step(d, d->editing->caret, forward, word), forward, select);
    read_edit_wanted(d);
}

static bool way_key(struct read_desk *d, guint key, bool control, bool shift)
{
    const double line = d->size_px * d->setup.leading,
                 page = fmax(line, d->setup.height_px - 2 * line);
    switch (key) {
    case GDK_KEY_Left:
    case GDK_KEY_Right:
        side_go(d, key == GDK_KEY_Right, control, shift);
        return true;
    case GDK_KEY_Up:
    case GDK_KEY_Down:
        line_go(d, key == GDK_KEY_Up ? -line : line, shift);
        return true;
    case GDK_KEY_Page_Up:
    case GDK_KEY_Page_Down:
        line_go(d, key == GDK_KEY_Page_Up ? -page : page, shift);
        return true;
    case GDK_KEY_Home:
    case GDK_KEY_End:
        edge_go(d, key == GDK_KEY_End, control, shift);
        return true;
    default:
        return false;
    }
}

bool read_edit_key(struct read_desk *d, guint key, GdkModifierType state)
{
    const bool control = state & GDK_CONTROL_MASK, shift = state & GDK_SHIFT_MASK;
    if (!d->editing->on || !d->view || (state & (GDK_ALT_MASK | GDK_SUPER_MASK)))
        return false;
    if (way_key(d, key, control, shift))
        return true;
    switch (key) {
    case GDK_KEY_BackSpace:
    case GDK_KEY_Delete:
        delete_key(d, key == GDK_KEY_Delete, control);
        return true;
    case GDK_KEY_Return:
    case GDK_KEY_KP_Enter:
        read_edit_break(d);
        return true;
    case GDK_KEY_Escape:
        read_edit_toggle(d);
        return true;
    default:
        break;
    }
    const gunichar letter = control ? 0 : gdk_keyval_to_unicode(key);
    if (!letter || g_unichar_iscntrl(letter))
        return false;
    char text[8] = "";
    g_unichar_to_utf8(letter, text);
    read_edit_type(d, text);
    return true;
}

/* ---- the pointer ---- */

bool read_edit_press(struct read_desk *d, double x, double y, int times, bool select)
{
    size_t byte;
    bool before;
    if (!d->editing->on)
        return false;
    if (!d->view || !reader_view_caret_at(d->view, x, y, &byte, &before))
        return true;
    read_edit_caret(d, byte, before, select);
    const struct reader_block *b = block_of(d, byte);
    if (times >= 2 && b) {
        const struct read_range range =
            times == 2 ? read_text_word(d, byte)
                       : (struct read_range){b->at, b->at + (size_t)b->bytes};
        d->editing->from = range.begin;
        read_edit_caret(d, range.end, true, true);
    }
    d->dragging = times == 1;
    return true;
}

bool read_edit_drag(struct read_desk *d, double x, double y)
{
    size_t byte;
    bool before;
    if (!d->editing->on || !d->dragging)
        return false;
    if (reader_view_caret_at(d->view, x, y, &byte, &before))
        read_edit_caret(d, byte, before, true);
    if (y < 0 || y > d->setup.height_px) /* the page follows */
        reader_view_scroll(d->view, trunc(y < 0 ? y / 4 : (y - d->setup.height_px) / 4));
    return true;
}
