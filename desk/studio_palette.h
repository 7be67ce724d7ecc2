/* studio_palette.h - what is in the wells of the dish, as a file of text.
 *
 *     # a palette of lutetia studio
 *     1: water 0.8, french ultramarine 0.6
 *     2: water 1.2, quinacridone rose 0.4, french ultramarine 0.15
 *
 * A line for each well, its number first; amounts by the pigments' names, 0..2; what is not
 * named is not in it. So a palette can be used on sheets with other pigments: those which a
 * sheet does not have are left out, and told.
 *
 * Errors: false, and `why` says in some words what is wrong. Threads: any. */
#ifndef LUTETIA_STUDIO_PALETTE_H
#define LUTETIA_STUDIO_PALETTE_H

#include <sheet.h>

#include <stdbool.h>

enum { STUDIO_WELLS = 8, STUDIO_PALETTE_TEXT = 1000, STUDIO_PALETTE_BYTES = 65536 };

struct studio_palette {
    bool filled[STUDIO_WELLS];                           /* the file has it */
    double amount[STUDIO_WELLS][1 + PAPER_PIGMENTS_MAX]; /* water, then the sheet's pigments */
    char missing[STUDIO_PALETTE_TEXT]; /* pigments that the sheet does not have, ", " between */
};

/* Of a text that ends with 0. */
bool studio_palette_parse(const char *text, const struct paper_sheet_config *config,
                          struct studio_palette *out, char *why, size_t room);
bool studio_palette_read(const char *path, const struct paper_sheet_config *config,
                         struct studio_palette *out, char *why, size_t room);
/* All wells, also those that are not filled. The same amounts are read again, to the bit. */
bool studio_palette_write(const char *path, const struct paper_sheet_config *config,
                          const struct studio_palette *palette, char *why, size_t room);

#endif
