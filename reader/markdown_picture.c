/* markdown_picture.c - pictures of Markdown: alone in their paragraphs, and among letters. See
 * markdown_internal.h. */
#include "markdown_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool picture_may_be_shown(const char *target)
{
    const size_t bytes = target ? strlen(target) : 0;
    return bytes > 4 && strcasecmp(target + bytes - 4, ".png") == 0 &&
           !memchr(target, ':', bytes) && !strstr(target, READER_MASK_SIGN);
}

cmark_node *picture_of(const struct walk *w, cmark_node *paragraph)
{
    cmark_node *child = cmark.node_first_child(paragraph);
    size_t bytes;
    bool open = false; /* a label's tag */
    while (child && !w->b.in_note) {
        const bool html = walk_is_html(child),
                   begins = html && reader_tag_label(cmark.node_get_literal(child), &bytes),
                   ends = html && open && strcmp(cmark.node_get_literal(child), "</a>") == 0;
        if (!begins && !ends && cmark.node_get_type(child) != CMARK_NODE_SOFTBREAK)
            break;
        open = begins || (open && !ends);
        child = cmark.node_next(child);
    }
    return child && cmark.node_get_type(child) == CMARK_NODE_IMAGE && !cmark.node_next(child)
               ? child
               : NULL;
}

/* A caption's letters, where it has nothing but letters in it. Owns: the caller frees it; NULL:
 * it has more, or no memory. */
static char *caption_of(cmark_node *picture)
{
    char *caption = NULL;
    size_t bytes;
    bool letters = true;
    FILE *to = open_memstream(&caption, &bytes);
    cmark_iter *iter = cmark.iter_new(picture);
    cmark_event_type event;
    while (to && letters && (event = cmark.iter_next(iter)) != CMARK_EVENT_DONE) {
        cmark_node *node = cmark.iter_get_node(iter);
        const cmark_node_type type = cmark.node_get_type(node);
        const char *text = cmark.node_get_literal(node);
        const bool break_ = type == CMARK_NODE_SOFTBREAK || type == CMARK_NODE_LINEBREAK;
        letters = type != CMARK_NODE_HTML_INLINE && type != CMARK_NODE_FOOTNOTE_REFERENCE &&
                  !(text && strstr(text, READER_MASK_SIGN));
        if (event == CMARK_EVENT_ENTER && letters && (text || break_))
            fputs(break_ ? " " : text, to);
    }
    cmark.iter_free(iter);
    if (to && fclose(to) == 0 && letters)
        return caption;
    free(caption);
    return NULL;
}

/* What stands for a picture without a caption: its file's name. */
static const char *name_of(const char *target)
{
    const char *slash = strrchr(target, '/');
    return slash ? slash + 1 : target;
}

/* A picture among letters is its caption, which leads to its file. */
void picture_enter(struct walk *w, cmark_node *node)
{
    const char *target = cmark.node_get_url(node);
    char *caption = w->b.block.kind != READER_PICTURE && picture_may_be_shown(target)
                        ? caption_of(node)
                        : NULL;
    if (caption) {
        reader_image_add(&w->b, *caption ? caption : name_of(target),
                         walk_look(w) | READER_SLANTED | READER_LINK, target,
                         (struct reader_asked){0});
        w->told = node;
        free(caption);
        return;
    }
    w->slanted++;
    w->around = w->link;
    if (w->b.block.kind != READER_PICTURE &&
        !w->link) /* else to where the link around it does */
        w->link = target;
}
