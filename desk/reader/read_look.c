/* read_look.c - how the page looks: its theme, sizes, and how wide the text is in the
 * window. */
#include "read_desk.h"

#include <math.h>

enum { STAGE_STRIP_PX = 46 }; /* a button, and what is blank around it */

enum { SIZE_LEAST = 8, SIZE_MOST = 72, COLUMN_LEAST = 12, COLUMN_MOST = 80 };

/* Margins take what the widest column leaves; in a wide window there is a margin for notes. */
static void column_set(struct read_desk *d)
{
    const double em = d->size_px, width = fmax(d->setup.width_px, 4 * em), least = 1.2 * em,
                 notes = 13 * em;
    const bool wide =
        d->document && d->document->notes_count > 0 && width >= (d->column_em + 15) * em;
    const double column = fmin(d->column_em * em, width - 2 * least - (wide ? notes : 0));
    d->setup.notes_px = wide ? notes : 0;
    d->setup.gap_px = 1.6 * em;
    d->setup.margin_px = floor((width - d->setup.notes_px - fmax(column, 2 * em)) / 2);
}

void read_look_set(struct read_desk *d)
{
    d->colours = reader_colours_of(d->dark);
    d->setup.font = d->options.font ? d->options.font : d->setup.font;
    d->setup.mono = d->options.mono ? d->options.mono : d->setup.mono;
    d->setup.math = d->options.math;
    d->setup.language = d->options.language;
    d->setup.align = d->options.ragged ? FONT_ALIGN_START : FONT_ALIGN_JUSTIFY;
    d->setup.size_px = d->size_px;
    d->setup.stage_strip_px = STAGE_STRIP_PX;
    for (int i = 0; i < 3; i++) {
        d->setup.ink_link[i] = d->colours->link[i];
        d->setup.ink_struck[i] = d->colours->struck[i];
    }
    column_set(d);
}

static void look_changed(struct read_desk *d)
{
    read_look_set(d);
    if (d->view && reader_view_set(d->view, &d->setup) != READER_OK)
        d->say(d, reader_error());
    read_page_changed(d);
}

void read_look_size(struct read_desk *d, double size_px)
{
    d->size_px = CLAMP(size_px, SIZE_LEAST, SIZE_MOST);
    look_changed(d);
}

void read_look_column(struct read_desk *d, double column_em)
{
    d->column_em = CLAMP(column_em, COLUMN_LEAST, COLUMN_MOST);
    look_changed(d);
}

void read_look_theme(struct read_desk *d, bool dark)
{
    d->dark = dark;
    desk_frame_theme(dark);
    read_tiles_forget(d->tiles);
    look_changed(d);
}

void read_look_resized(struct read_desk *d, int width, int height)
{
    if (width < 1 || height < 1 ||
        (width == (int)d->setup.width_px && height == (int)d->setup.height_px))
        return;
    d->setup.width_px = width;
    d->setup.height_px = height;
    look_changed(d);
}
