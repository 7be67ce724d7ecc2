/* pages_figure.c - pictures that are paragraphs of their own, and captions: see
 * pages_internal.h. */
#include "pages_internal.h"

#include <string.h>

bool pages_caption(struct paragraph_text *t, const struct reader_block *block, bool shown)
{
    enum { TARGET_BYTES = 1000 };
    const char *target = block->target ? block->target : "";
    const bool whole = strlen(target) <= TARGET_BYTES;
    int told = whole ? (int)strlen(target) : TARGET_BYTES;
    while (!whole && told && ((unsigned char)target[told] & 0xc0) == 0x80)
        told--;
    return pages_block_add(t, block, 0, block->bytes, READER_SLANTED) &&
           (shown ||
            (pages_text_add(t, " [", 2, 0) && pages_text_add(t, target, told, READER_CODE) &&
             pages_text_add(t, whole ? "]" : "\xe2\x80\xa6]", whole ? 1 : 4, 0)));
}

enum reader_status pages_picture_add(struct reader_pages *p, const struct reader_block *block,
                                     const struct page_manner *manner, bool *done)
{
    const struct pictured *own;
    int plain;
    *done = false;
    enum reader_status status =
        pages_pictured(p, block->source, block->target, block->asked,
                       pages_column(p) - manner->left_px - manner->right_px, &own);
    if (status != READER_OK || !own)
        return status;
    status = pages_style(p, CONTEXT_TABLE, 0, &plain);
    if (status == READER_OK)
        status = pages_inset_put(p, own->target, plain, own->style, manner);
    *done = status == READER_OK;
    return status;
}
