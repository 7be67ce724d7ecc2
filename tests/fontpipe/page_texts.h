/* page_texts.h - random texts in ten scripts, for tests of pages. */
#ifndef LUTETIA_TEST_PAGE_TEXTS_H
#define LUTETIA_TEST_PAGE_TEXTS_H

#include "support.h"

#include <breaks.h>
#include <page.h>

/* So many of the words are used; the first few need no other font than the styles', of which
 * some are large. */
enum { PAGE_WORDS_NEAR = 8 };
extern uint32_t page_words_used;
/* So many words, with spaces between. Returns how many bytes. */
size_t page_random_text(uint32_t *seed, char *out, int count);

/* A text with four styles: 0..3. */
enum { PAGE_STYLES = 4 };
struct page_text *page_text_begin(void);
struct page_manner page_random_manner(uint32_t *seed);

#endif
