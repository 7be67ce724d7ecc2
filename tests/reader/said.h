/* said.h - a document's blocks in words, for tests.
 *
 *     blocks_are("# A *b*\n", "h1 A *b*\n"); */
#ifndef LUTETIA_TEST_READER_SAID_H
#define LUTETIA_TEST_READER_SAID_H

#include <reader_document.h>

/* The caller destroys it. */
struct reader_document *read_all(const char *text, size_t bytes);
/* What it becomes, references and all: a line for each block, and its notes behind. */
void blocks_are(const char *markdown, const char *expected);

#endif
