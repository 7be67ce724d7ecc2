/* help_sheet.c - see help_sheet.h. All lengths are multiples of the text's size. */
#include "help_sheet.h"

#include <math.h>

enum { COLUMNS_MAX = 3 };
static const double column_texts = 38, name_texts = 15.5, line_texts = 1.6, margin_texts = 1.5;

/* As few columns as make it fit, else as many as there is room for, in a smaller text if there
 * is none for one. */
static void sheet_fit(struct help_sheet *s, int count, int width_px, int height_px,
                      double text_px)
{
    const double least = 0.5 * text_px;
    s->text_px = fmax(least, fmin(text_px, width_px / (column_texts + 2 * margin_texts)));
    s->line_px = line_texts * s->text_px;
    const double edge = 2 * margin_texts * s->text_px;
    const int room = (int)fmax(1, floor((width_px - edge) / (column_texts * s->text_px)));
    const int rows = (int)fmax(1, floor((height_px - 2 * edge) / s->line_px));
    s->columns = (int)fmin(fmin(room, COLUMNS_MAX), ceil((double)count / rows));
    const int high = (count + s->columns - 1) / s->columns;
    const double whole = high * s->line_px + edge;
    s->most_px = fmax(0, whole - (height_px - edge));
    s->box =
        (struct font_box){edge / 2, edge / 2, edge / 2 + s->columns * column_texts * s->text_px,
                          edge / 2 + fmin(whole, height_px - edge)};
}

void help_sheet_draw(struct help_sheet *s, const struct help_row *rows, int count,
                     struct stage_panel *panel, const struct stage_theme *theme, int width_px,
                     int height_px, double px, struct stage_draw_list *list)
{
    const struct stage_color *colors = theme->colors;
    if (!s->shown || count < 1)
        return;
    sheet_fit(s, count, width_px, height_px, px * theme->sizes[STAGE_SIZE_PANEL_TEXT_SIZE]);
    s->scrolled_px = fmax(0, fmin(s->scrolled_px, s->most_px));
    const struct font_box *b = &s->box;
    const double text = s->text_px, margin = margin_texts * text;
    const int high = (count + s->columns - 1) / s->columns;
    stage_draw_box(list, b->x0, b->y0, b->x1, b->y1, text / 2, 0, colors[STAGE_COLOR_PANEL]);
    for (int i = 0; i < count; i++) {
        const double x = b->x0 + margin / 2 + i / high * column_texts * text,
                     y = b->y0 + margin + (i % high + 0.7) * s->line_px - s->scrolled_px;
        if (y < b->y0 + text || y > b->y1 - 0.4 * text)
            continue;
        stage_panel_text(panel, list, rows[i].name, x, y, text, false,
                         colors[STAGE_COLOR_PANEL_VALUE]);
        stage_panel_text(panel, list, rows[i].does, x + name_texts * text, y, text, false,
                         colors[STAGE_COLOR_PANEL_TEXT]);
    }
    if (s->most_px > 0) { /* which part is seen */
        const double all = b->y1 - b->y0 - 2 * text, part = all / (all + s->most_px),
                     top = b->y0 + text + s->scrolled_px / s->most_px * (1 - part) * all;
        stage_draw_line(list, b->x1 - text / 2, top, b->x1 - text / 2, top + part * all,
                        text / 4, colors[STAGE_COLOR_SLIDER]);
    }
}

bool help_sheet_input(struct help_sheet *s, const struct input_event *e)
{
    const double page = s->box.y1 - s->box.y0 - 3 * s->line_px;
    double by = 0;
    if (!s->shown)
        return false;
    if (e->kind == INPUT_SCROLL)
        by = -3 * s->line_px * e->scroll_y;
    else if (e->kind != INPUT_KEY_DOWN && e->kind != INPUT_KEY_REPEAT)
        return false;
    else if (e->key == INPUT_KEY_DOWN_ARROW || e->key == INPUT_KEY_UP_ARROW)
        by = e->key == INPUT_KEY_DOWN_ARROW ? s->line_px : -s->line_px;
    else if (e->key == INPUT_KEY_PAGE_DOWN || e->key == INPUT_KEY_PAGE_UP)
        by = e->key == INPUT_KEY_PAGE_DOWN ? page : -page;
    else
        return false;
    s->scrolled_px = fmax(0, fmin(s->scrolled_px + by, s->most_px));
    return true;
}
