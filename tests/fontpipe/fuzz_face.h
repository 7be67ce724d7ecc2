/* fuzz_face.h - takes bytes as a font file and calls everything that programs call with a
 * font. */
#ifndef LUTETIA_FUZZ_FACE_H
#define LUTETIA_FUZZ_FACE_H

#include <stddef.h>
#include <stdint.h>

/* Returns how many glyphs had ink; -1: the file was refused. Aborts where a promise of the
 * headers is broken. */
int fuzz_face(const uint8_t *bytes, size_t count);

#endif
