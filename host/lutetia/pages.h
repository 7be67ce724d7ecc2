/* pages.h - what there is to say about each verb: the words of its --help and of its manual
 * page, a row each. A sentence that is missing from a manual page is missing here, or in the
 * rows of options beside a verb's code. */
#ifndef LUTETIA_PAGES_H
#define LUTETIA_PAGES_H

#include <stddef.h>

enum { PAGE_VALUES_MAX = 10, PAGE_EXAMPLES_MAX = 8 };

/* The words that an option takes: what a shell offers. One of words ("full, thesis"), list and
 * fill (which writes such a text). */
struct page_value {
    const char *option; /* NULL ends the list */
    const char *words;
    const char *const *(*list)(void);
    void (*fill)(char *text, size_t room);
    const char *suffix; /* what follows the word: "=" of an amount; NULL: nothing */
};

struct page_example {
    const char *command; /* NULL ends the list */
    const char *does;
};

struct page {
    const char *verb;
    const char *usages; /* a line each, without "lutetia VERB" */
    const char *about;  /* paragraphs, a line each */
    const char *notes;  /* paragraphs that follow the options; NULL: none */
    struct page_value values[PAGE_VALUES_MAX + 1];
    struct page_example examples[PAGE_EXAMPLES_MAX + 1];
    const char *files; /* "FILE: what it is", a line each; NULL: none */
    const char *see;   /* other pages, "lutetia-type(1), paris(7)" */
};

extern const struct page pages_of_pictures[],
    pages_of_machines[]; /* ended by a row without a verb */

/* Every verb has one. */
const struct page *page_of(const char *verb);

#endif
