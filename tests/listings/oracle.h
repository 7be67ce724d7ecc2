/* oracle.h - the thesis's listings as plain C loops, one double loop for each Paris
 * instruction.
 *
 * Knows nothing of the machine. It has arrays, float arithmetic without contraction, and the
 * listings' own order of operations. Values are returned as bits, so that tests compare bits.
 */
#ifndef LUTETIA_TESTS_LISTINGS_ORACLE_H
#define LUTETIA_TESTS_LISTINGS_ORACLE_H

#include <stdint.h>

/* One plane for each field, in the order of enum page_field. */
enum { ORACLE_PLANES = 17 };

struct oracle {
    int width, height;
    float *real[11];                    /* water .. outflow */
    uint32_t *image;                    /* 24 bits */
    uint8_t *saved;                     /* Page->context */
    uint8_t *old_context;               /* Page->old_context_store */
    uint8_t *context, *test, *overflow; /* the flags */
    float gravity, molecular_weight[3];
};

void oracle_init(struct oracle *o, int width, int height);
void oracle_finish(struct oracle *o);

/* One call of disperse_pigment_and_water(Page). */
void oracle_disperse(struct oracle *o);
/* Read_image_from_disk_and_screen_ink_on_paper() with these bytes of the file. */
void oracle_screen(struct oracle *o, const uint8_t *gray, int width, int height, int x_off,
                   int y_off, float cyan, float magenta, float yellow, float water);

/* The bits of fiber n in the field that page.h gives this number. */
uint32_t oracle_word(const struct oracle *o, int page_field, int n);

#endif
