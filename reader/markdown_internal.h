/* markdown_internal.h - the walk through cmark-gfm's tree: its blocks (markdown.c), pictures
 * (markdown_picture.c) and HTML (markdown_html.c). */
#ifndef LUTETIA_READER_MARKDOWN_INTERNAL_H
#define LUTETIA_READER_MARKDOWN_INTERNAL_H

#include "builder.h"
#include "cmark_library.h"
#include "tag.h"

/* A list that the walk is in: the number of its next item; -1: bullets. */
struct list {
    long next;
    bool bracket; /* 1) */
};

/* Tags of HTML that are open. */
enum { HTML_DEPTH = 32 };
struct html_open {
    enum tag_kind kind;
    int level;
    enum reader_align align; /* around it */
    long next;               /* of a list: as above */
    int depth;               /* how many items, quotes and notes it is in */
};
struct html_tags {
    int depth, line;
    int rows, cells; /* of the table that is read */
    bool in_cell;
    struct html_open open[HTML_DEPTH];
    int opened;
    int heavy, slanted, struck, code, raised, lowered; /* of letters */
    char *link;                                        /* where they lead to */
};

struct walk {
    struct reader_builder b;
    const int *lines; /* where each line of the source begins */
    int lines_count;
    int slanted, heavy, struck;
    const char *link, *around; /* where letters lead to; and those around a picture */
    struct list *lists;
    int lists_count, lists_capacity;
    int notes_before; /* of other sources */
    int ends;         /* lines that tags have ended, before the next letter */
    unsigned ends_look;
    cmark_node *table;
    cmark_node *told; /* what is in it has been read; NULL: nothing */
    int pictures;     /* the line of a paragraph that is pictures alone, by tags; else 0 */
    struct html_tags html;
};

/* markdown_walk.c */
void walk_block_open(struct walk *w, enum reader_kind kind, cmark_node *node);
/* Owns: the caller frees it; NULL: there is no text, or no memory. */
char *walk_copy(struct walk *w, const char *text);
/* How letters look now, and where they lead to. */
unsigned walk_look(const struct walk *w);
const char *walk_link(const struct walk *w);
/* Tags have ended lines before the letter that comes now; none at a text's ends. */
void walk_ends_add(struct walk *w);
void walk_line_end_drop(struct reader_block *block);
bool walk_is_html(cmark_node *node);

/* markdown_html.c */
/* A tag among letters. */
void html_inline(struct walk *w, const char *text);
/* A block of tags: what they mean, or as it is written. */
void html_block(struct walk *w, cmark_node *node);
/* Whether a paragraph is nothing but tags of pictures. */
bool html_is_pictures(cmark_node *paragraph);
/* Letters look as usual again: where a block begins. */
void html_looks_end(struct walk *w);
/* Tags that were open beyond `opened` are no longer. */
void html_close_to(struct walk *w, int opened);
/* An item, a quote or a note ends, and what is open in it. */
void html_container_end(struct walk *w);

/* markdown_picture.c */
/* The picture that is all of its paragraph, but for labels before it; else NULL. */
cmark_node *picture_of(const struct walk *w, cmark_node *paragraph);
void picture_enter(struct walk *w, cmark_node *node);
/* Whether pages may show it: a PNG of the document's folder, by its name. */
bool picture_may_be_shown(const char *target);

#endif
