/* markdown_walk.c - what the files of the walk share: see markdown_internal.h. */
#include "markdown_internal.h"

#include <string.h>

unsigned walk_look(const struct walk *w)
{
    const struct html_tags *h = &w->html;
    return (w->slanted || h->slanted ? (unsigned)READER_SLANTED : 0) |
           (w->heavy || h->heavy ? (unsigned)READER_HEAVY : 0) |
           (w->struck || h->struck ? (unsigned)READER_STRUCK : 0) |
           (h->code ? (unsigned)READER_CODE : 0) | (h->raised ? (unsigned)READER_RAISED : 0) |
           (h->lowered ? (unsigned)READER_LOWERED : 0) |
           (walk_link(w) ? (unsigned)READER_LINK : 0);
}

const char *walk_link(const struct walk *w)
{
    return w->link ? w->link : w->html.link;
}

void walk_block_open(struct walk *w, enum reader_kind kind, cmark_node *node)
{
    reader_block_open(&w->b, kind, cmark.node_get_start_line(node),
                      cmark.node_get_end_line(node));
}

char *walk_copy(struct walk *w, const char *text)
{
    char *copy = text && *text ? strdup(text) : NULL;
    if (text && *text && !copy)
        reader_builder_fail(&w->b);
    return copy;
}

/* The last line's end of what was read as it is. */
void walk_line_end_drop(struct reader_block *block)
{
    if (!block->bytes || block->text[block->bytes - 1] != '\n')
        return;
    block->text[--block->bytes] = '\0';
    block->spans[block->spans_count - 1].end = block->bytes;
}

bool walk_is_html(cmark_node *node)
{
    return cmark.node_get_type(node) == CMARK_NODE_HTML_INLINE;
}

void walk_ends_add(struct walk *w)
{
    struct reader_builder *b = &w->b;
    for (; w->ends; w->ends--)
        if (b->block.bytes)
            reader_text_add(b, b->block.kind == READER_ROW ? " " : "\n", w->ends_look,
                            walk_link(w));
}
