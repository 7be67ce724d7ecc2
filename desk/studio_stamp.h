/* studio_stamp.h - a picture that a hand puts on the sheet: as paint, as water, as masking
 * fluid, or in its own colours.
 *
 *     struct studio_stamp stamp;
 *     struct studio_printed printed;
 *     if (studio_stamp_read("leaf.png", &stamp) != PAPER_OK)
 *         die(studio_session_error());
 *     if (studio_stamp_place(&stamp, &settings, 120, 80, &config, &printed) == PAPER_OK)
 *         paper_sheet_put(sheet, &printed.screen, printed.x, printed.y, amount);
 *     studio_printed_free(&printed);
 *     studio_stamp_free(&stamp);
 *
 * Its middle lies at the place, its longer side is as long as the setting says, and it is
 * turned about its middle. Dark places take paint, light ones none; the other way round if it
 * is a negative. A fiber gets the mean, in linear light, of what lies on it.
 *
 * Errors: a status, and the text where studio_session_error() finds it. Threads: any. */
#ifndef LUTETIA_STUDIO_STAMP_H
#define LUTETIA_STUDIO_STAMP_H

#include "studio_settings.h"

#include <techniques.h>

struct studio_stamp { /* zeros: none */
    int width, height;
    uint8_t *rgb;
    char *path;
};
/* Reads any PNG. Errors: BAD_FILE (it is none; it is too large), NO_MEMORY; *out is then
 * zeros. */
enum paper_status studio_stamp_read(const char *path, struct studio_stamp *out);
void studio_stamp_free(struct studio_stamp *stamp);

/* The part of it that lies on the sheet. */
struct studio_printed {
    struct paper_screen screen; /* gray NULL: none of it does */
    int x, y;
    uint8_t *rgb;   /* of STUDIO_STAMP_COLOURS: display values, else NULL */
    uint8_t *cover; /* of the same: how much of a fiber the picture covers */
};
/* config NULL: wherever it is, for a stencil under the pointer. Errors: NO_MEMORY. Owns:
 * studio_printed_free(). */
enum paper_status studio_stamp_place(const struct studio_stamp *stamp,
                                     const struct studio_settings *settings, double x, double y,
                                     const struct paper_sheet_config *config,
                                     struct studio_printed *out);
void studio_printed_free(struct studio_printed *printed);

/* The amounts of the sheet's pigments that look most like it, with so much water; for
 * paper_sheet_print(). Shape: print->amount[] point into *planes. Owns: the caller frees
 * *planes. Errors: NO_MEMORY, and those of paper_separate(). */
enum paper_status studio_printed_separate(const struct studio_printed *printed,
                                          const struct paper_sheet_config *config, double water,
                                          struct paper_print *print, float **planes);

#endif
