/* fuzz_outline.h - takes bytes as an outline, a map, a filter and a place, and draws them in
 * gray by every path of code. */
#ifndef LUTETIA_TESTS_FONTPIPE_FUZZ_OUTLINE_H
#define LUTETIA_TESTS_FONTPIPE_FUZZ_OUTLINE_H

#include <stddef.h>
#include <stdint.h>

/* Returns 1 if there was ink, 0 if there was none or the input was refused. Aborts if an
 * invariant fails. */
int fuzz_outline(const uint8_t *bytes, size_t count);

#endif
