/* voice_poster.c - see voice_poster.h. */
#include "voice_poster.h"

#include "lutetia.h"
#include "poster.h"
#include "type_common.h"

#include <math.h>
#include <stdlib.h>

struct voice_poster {
    const struct voice_poster_def *def;
    struct voice_type *type;
    const struct voice_line *lines;
    double margin_px, above_px; /* above: from a line's top to its baseline */
};

static void poster_paper(void *of, struct font_picture *picture)
{
    const struct voice_poster *p = of;
    voice_type_paper(p->type, picture);
}

static int poster_draw(void *of, int line, double top_px, struct font_picture *picture)
{
    const struct voice_poster *p = of;
    const double x =
        voice_type_to_left(p->type) ? picture->width_px - p->margin_px : p->margin_px;
    return voice_type_line(p->type, p->def->second_px, &p->lines[line], x, top_px + p->above_px,
                           picture) == FONT_OK
               ? EXIT_SUCCESS
               : fail_font("voice");
}

/* One line where it is not too long, else lines of a page's width. */
int voice_poster_write(struct voice_type *type, const struct voice_poster_def *def)
{
    struct voice_line *lines = NULL;
    int status = EXIT_SUCCESS, count = 0;
    enum font_status made =
        voice_type_lines(type, def->second_px,
                         def->line_px > 0 ? def->line_px : POSTER_LINE_MOST_PX, &lines, &count);
    if (made == FONT_OK && count > 1 && def->line_px == 0) {
        free(lines);
        made = voice_type_lines(type, def->second_px, POSTER_LINE_PX, &lines, &count);
    }
    struct voice_poster of = {def, type, lines, ceil(0.25 * def->size_px),
                              1.1 * def->size_px + def->rise_px};
    struct poster poster = {.verb = "voice",
                            .path = def->path,
                            .lines = count,
                            .margin_px = of.margin_px,
                            .pitch_px = 1.7 * def->size_px + def->rise_px,
                            .of = &of,
                            .paper = poster_paper,
                            .draw = poster_draw};
    for (int i = 0; i < count; i++)
        poster.width_px = fmax(poster.width_px, lines[i].width_px);
    status = made == FONT_OK ? poster_write(&poster) : fail_font("voice");
    free(lines);
    return status;
}
