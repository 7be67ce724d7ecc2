/* script_grammar.h - writes random scripts that use all functions of the library of scripts,
 * from its tables.
 *
 *     struct script_source source = {.at = bytes, .end = bytes + count};
 *     const char *text = script_by_chance(&source);
 *
 * The bytes choose; the same bytes give the same script. */
#ifndef LUTETIA_TEST_SCRIPT_GRAMMAR_H
#define LUTETIA_TEST_SCRIPT_GRAMMAR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SCRIPT_TEXT_MAX = 16384 };

struct script_source {
    const uint8_t *at, *end;
    bool trusted; /* the script has finalizers, and collects garbage when it likes */
    char text[SCRIPT_TEXT_MAX];
    size_t length;
};

/* Valid until the source is used again. */
const char *script_by_chance(struct script_source *source);

/* The first function of the library for which the grammar has no row, or NULL. */
const char *script_grammar_lacks(void);

unsigned script_byte(struct script_source *source);

#endif
