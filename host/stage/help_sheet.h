/* help_sheet.h - what a window's keys and hands do, as a sheet over the picture: in columns
 * where it is wide, smaller where it is narrow; what does not fit is scrolled to.
 *
 *     struct help_sheet sheet = {.shown = true};
 *     const struct help_row rows[] = {{"Space", "stop, go on"}, {"Esc", "end"}};
 *     help_sheet_draw(&sheet, rows, 2, panel, theme, width_px, height_px, px, &list);
 *     if (help_sheet_input(&sheet, &event))
 *         ...it was scrolled...
 */
#ifndef LUTETIA_STAGE_HELP_SHEET_H
#define LUTETIA_STAGE_HELP_SHEET_H

#include "panel.h"

struct help_row {
    const char *name, *does;
};

/* All zeros: not shown. */
struct help_sheet {
    bool shown;
    double scrolled_px;
    /* The last picture's: how far it can be scrolled, a line, the text's size, and the
     * sheet. */
    double most_px, line_px, text_px;
    int columns;
    struct font_box box;
};

void help_sheet_draw(struct help_sheet *sheet, const struct help_row *rows, int count,
                     struct stage_panel *panel, const struct stage_theme *theme, int width_px,
                     int height_px, double px, struct stage_draw_list *list);

/* The wheel and the keys that scroll, while the sheet is shown. True: it took the event. */
bool help_sheet_input(struct help_sheet *sheet, const struct input_event *event);

#endif
