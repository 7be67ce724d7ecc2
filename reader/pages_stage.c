/* pages_stage.c - the room of a script that lives: a box with nothing in it, in a line of its
 * own, over the script's text. Who shows pages draws there. See pages_internal.h. */
#include "pages_internal.h"

#include <math.h>

enum reader_status pages_stage_style(struct reader_pages *p, const struct reader_block *block,
                                     double most_px, int *style, double *width)
{
    *width = fmax(1, fmin(block->stage_width, floor(most_px)));
    const double height = round(block->stage_height * *width / block->stage_width),
                 more = p->stage_more ? p->stage_more[block - p->document->blocks] : 0;
    const struct font_layout shown = {.size_px = p->setup.size_px,
                                      .width_px = *width,
                                      .ascent_px = height + p->setup.stage_strip_px + more};
    struct page_style look = page_style_default();
    look.font = p->fonts[0];
    look.size_px = pages_size(p, CONTEXT_TABLE);
    return page_inset_add(p->text, &look, &shown, style) == FONT_OK ? READER_OK
                                                                    : pages_failed();
}

enum reader_status pages_stage_add(struct reader_pages *p, const struct reader_block *block,
                                   const struct page_manner *manner)
{
    int style, plain;
    double width;
    enum reader_status status = pages_style(p, CONTEXT_TABLE, 0, &plain);
    if (status == READER_OK)
        status = pages_stage_style(
            p, block, pages_column(p) - manner->left_px - manner->right_px, &style, &width);
    if (status == READER_OK)
        status = pages_inset_put(p, "-", plain, style, manner); /* the letter is not seen */
    return status;
}
