/* tag.h - tags of HTML that documents have, and what they mean. What is not known here, or not
 * written as a tag is, stays as it is written. */
#ifndef LUTETIA_READER_TAG_H
#define LUTETIA_READER_TAG_H

#include "reader_document.h"

enum tag_kind {
    TAG_UNKNOWN,
    TAG_COMMENT,
    TAG_BREAK,
    TAG_RULE,
    TAG_PARAGRAPH,
    TAG_DIVISION,
    TAG_CENTER,
    TAG_HEADING, /* level */
    TAG_QUOTE,
    TAG_DETAILS,
    TAG_SUMMARY,
    TAG_LIST, /* level: 1: its items have numbers */
    TAG_ITEM,
    TAG_TABLE,
    TAG_ROW,
    TAG_CELL, /* level: 1: of a head */
    TAG_PICTURE,
    TAG_LINK,
    TAG_LOOK, /* look: of letters between it and its end */
    TAG_PLAIN /* it says nothing that is seen */
};

struct tag {
    enum tag_kind kind;
    bool closing;
    int level;
    unsigned look;
    const char *at; /* in the text */
    int bytes;
};

/* The tag, or comment, that a text begins with; false: it begins with none, or it does not end.
 * A tag that is not known is one, too. */
bool tag_read(const char *text, struct tag *out);
/* Whether it stands apart from letters, as a paragraph does. */
bool tag_is_block(const struct tag *tag);
/* What a tag says of that name, without entities; "" where it says nothing. Owns: the caller
 * frees it. NULL: it does not say it, or no memory. */
char *tag_attribute(const struct tag *tag, const char *name);
/* Letters in place of their names (&amp;) and numbers. */
void tag_entities(char *text);
/* Where its `align` puts what is in it. */
enum reader_align tag_align(const struct tag *tag);
/* What its `width` and `height` say. */
struct reader_asked tag_asked(const struct tag *tag);

#endif
