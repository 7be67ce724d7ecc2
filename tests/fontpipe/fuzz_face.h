/* fuzz_face.h - bytes as a font's file, and all that anyone would do with it. */
#ifndef LUTETIA_FUZZ_FACE_H
#define LUTETIA_FUZZ_FACE_H

#include <stddef.h>
#include <stdint.h>

/* How many glyphs had ink; -1: the file was refused. Ends the process where a promise of the headers is broken. */
int fuzz_face(const uint8_t *bytes, size_t count);

#endif
