/* read_look.c - how the page looks: its theme, sizes, and how wide the text is in the
 * window. */
#include "read_desk.h"

enum { STAGE_STRIP_PX = 46 }; /* a button, and what is blank around it */

enum { SIZE_LEAST = 8, SIZE_MOST = 72, COLUMN_LEAST = 12, COLUMN_MOST = 80 };

static void grid_set(struct read_desk *d)
{
    struct reader_pages_setup *s = &d->setup;
    reader_template_grid(&d->template, s->width_px, d->size_px,
                         d->document && d->document->notes_count > 0, &s->grid);
    s->gap_px = d->template.gutter_em * d->size_px;
    s->margin_px = s->grid.text[0].x;
    s->notes_px = 0;
    for (int i = 0; i < READER_SIZES; i++)
        s->sizes[i] = d->template.sizes[i];
    s->beside = d->template.beside;
}

void read_look_set(struct read_desk *d)
{
    d->colours = &d->template.colours[d->dark];
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
    grid_set(d);
}

static void look_changed(struct read_desk *d)
{
    read_look_set(d);
    if (d->view && reader_view_set(d->view, &d->setup) != READER_OK)
        d->say(d, reader_error());
    read_page_changed(d);
    if (d->looked)
        d->looked(d);
}

void read_look_again(struct read_desk *d)
{
    look_changed(d);
}

void read_look_size(struct read_desk *d, double size_px)
{
    d->size_px = CLAMP(size_px, SIZE_LEAST, SIZE_MOST);
    look_changed(d);
}

void read_look_column(struct read_desk *d, double column_em)
{
    reader_template_text_set(&d->template, CLAMP(column_em, COLUMN_LEAST, COLUMN_MOST));
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
