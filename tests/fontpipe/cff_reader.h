/* cff_reader.h - the outlines of a CFF table, for tests alone: Type 2 charstrings in doubles.
 * It trusts the table. */
#ifndef LUTETIA_TEST_CFF_READER_H
#define LUTETIA_TEST_CFF_READER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct cff_reader {
    void *context;
    /* x0, y0, x1, y1; and a cubic's four points. Contours come closed. */
    void (*line)(void *context, const double *points);
    void (*cubic)(void *context, const double *points);
};

/* False: it is no glyph that this reads (a font with CIDs, a matrix, an accented character made
 * of others). */
bool cff_glyph_read(struct cff_reader *reader, const uint8_t *table, size_t bytes,
                    uint32_t glyph);

#endif
