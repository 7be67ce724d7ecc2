/* pages_stage.c - the room of a script that lives: a box with nothing in it, in a line of its
 * own, over the script's text. Who shows pages draws there. See pages_internal.h. */
#include "pages_internal.h"

#include <math.h>

enum reader_status pages_stage_add(struct reader_pages *p, const struct reader_block *block,
                                   const struct page_manner *manner)
{
    const double most = fmax(1, pages_column(p) - manner->left_px - manner->right_px),
                 width = fmin(block->stage_width, floor(most)),
                 height = round(block->stage_height * width / block->stage_width),
                 more = p->stage_more ? p->stage_more[block - p->document->blocks] : 0;
    const struct font_layout shown = {.size_px = p->setup.size_px,
                                      .width_px = width,
                                      .ascent_px = height + p->setup.stage_strip_px + more};
    struct page_style look = page_style_default();
    int style, plain;
    look.font = p->fonts[0];
    look.size_px = pages_size(p, CONTEXT_TABLE);
    enum reader_status status = pages_style(p, CONTEXT_TABLE, 0, &plain);
    if (status == READER_OK && page_inset_add(p->text, &look, &shown, &style) != FONT_OK)
        status = pages_failed();
    if (status == READER_OK)
        status = pages_inset_put(p, "-", plain, style, manner); /* the letter is not seen */
    return status;
}
