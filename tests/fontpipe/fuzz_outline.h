/* fuzz_outline.h - bytes as an outline, a map, a filter and a place: from there to gray, by every path. */
#ifndef LUTETIA_TESTS_FONTPIPE_FUZZ_OUTLINE_H
#define LUTETIA_TESTS_FONTPIPE_FUZZ_OUTLINE_H

#include <stddef.h>
#include <stdint.h>

/* Returns 1 if there was ink, 0 if there was none or something was refused. Aborts where what must hold does not. */
int fuzz_outline(const uint8_t *bytes, size_t count);

#endif
