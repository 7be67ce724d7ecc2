/* page.h - what the thesis's listings use but do not show: the page, the globals, the context
 * rectangle.
 *
 * Included by gnu89 programs (which include the listings unchanged) and by C17 tests, so it
 * keeps to C that both accept. The geometry is rows by columns: axis 0 is Y (north/south), axis
 * 1 is X (east/west).  Every field that the listings touch is a member, so that a test can
 * compare all of them, stale values in inactive fibers included.
 */
#ifndef LUTETIA_TESTS_LISTINGS_PAGE_H
#define LUTETIA_TESTS_LISTINGS_PAGE_H

#include <cm/paris.h>

#define CHANNEL_SIZE 8

struct FiberStruct {
    int width, height; /* in fibers */
    int s, e;          /* significand and exponent of every float field */
    int bits_per_pixel;

    /* floats, s + e + 1 bits */
    CM_field_id_t water, absorbency, cyan, magenta, yellow, temp1, temp2;
    CM_field_id_t inward, outward, inflow, outflow;
    /* bits_per_pixel bits; image_red is its part at 0 */
    CM_field_id_t image_field, image_red;
    /* 16 bits */
    CM_field_id_t x_coordinate, y_coordinate;
    /* 1 bit: the context that Turn_on_context saved, the one that the listing saves, and copies
     * of the flags */
    CM_field_id_t context, old_context_store, seen_context, seen_test, seen_overflow;
};

/* Numbers of fields, for tests that loop over all fields. */
enum page_field {
    PAGE_WATER,
    PAGE_ABSORBENCY,
    PAGE_CYAN,
    PAGE_MAGENTA,
    PAGE_YELLOW,
    PAGE_TEMP1,
    PAGE_TEMP2,
    PAGE_INWARD,
    PAGE_OUTWARD,
    PAGE_INFLOW,
    PAGE_OUTFLOW,
    PAGE_FLOAT_COUNT,
    PAGE_IMAGE = PAGE_FLOAT_COUNT,
    PAGE_CONTEXT,
    PAGE_OLD_CONTEXT,
    PAGE_SEEN_CONTEXT,
    PAGE_SEEN_TEST,
    PAGE_SEEN_OVERFLOW,
    PAGE_FIELD_COUNT
};

/* Makes a VP set of height by width, selects it and allocates the fields.  Defined in
 * page.c. */
void page_create(struct FiberStruct *page, int width, int height);
void page_destroy(struct FiberStruct *page);
CM_field_id_t page_field(const struct FiberStruct *page, enum page_field which);
int page_field_bits(enum page_field which);
/* Write and read whole fields whatever the context: row-major, a 32-bit word for each fiber. */
void page_write(struct FiberStruct *page, enum page_field which, const unsigned int *words);
void page_read(struct FiberStruct *page, enum page_field which, unsigned int *words);
/* Copies context, test and overflow into the seen_ fields, whatever the context. */
void page_look_at_flags(struct FiberStruct *page);

struct oracle;
/* Fails at the first word of a field or flag that differs from the oracle's; step is for the
 * message. */
void page_compare(struct FiberStruct *page, const struct oracle *o, int step);

/* The thesis's function: saves the context in `saved`, and leaves on only the active fibers in
 * x1..x2 and y1..y2, both ends included. The gnu89 programs call it without a prototype, so all
 * its arguments are ints. */
int Turn_on_context(struct FiberStruct *Page, CM_field_id_t saved, int x1, int y1, int x2,
                    int y2);

/* Globals of the listings. */
extern float gravity;
extern float molecular_weight[3];
extern int s, e, X, Y, i;

#endif
