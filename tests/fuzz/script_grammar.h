/* script_grammar.h - scripts by chance, of all that the library of scripts has, written from its tables.
 *
 *     struct script_source source = {.at = bytes, .end = bytes + count};
 *     const char *text = script_by_chance(&source);
 *
 * Bytes choose; the same bytes are the same script. */
#ifndef LUTETIA_TEST_SCRIPT_GRAMMAR_H
#define LUTETIA_TEST_SCRIPT_GRAMMAR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SCRIPT_TEXT_MAX = 16384 };

struct script_source {
    const uint8_t *at, *end;
    bool trusted; /* of the script: it has finalizers, and collects when it likes */
    char text[SCRIPT_TEXT_MAX];
    size_t length;
};

/* Valid until the source is used again. */
const char *script_by_chance(struct script_source *source);

/* The first function of the library that the grammar has no row for, or NULL. */
const char *script_grammar_lacks(void);

unsigned script_byte(struct script_source *source);

#endif
