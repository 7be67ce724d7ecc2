/* field_bytes.h - a field's values as bytes, band by band, so that what a large set holds needs
 * little memory on the front end.
 *
 *     struct field_bytes b;
 *     if (!field_bytes_begin(&b, m, field, 24, 3))
 *         return;
 *     while (field_bytes_next(&b))
 *         if (!field_bytes_get(&b) || !write_all(b.bytes, b.count))
 *             break;
 *     field_bytes_end(&b);
 *
 * Values follow each other in row-major order. Each has value_bytes bytes, the lowest first;
 * bits of them that the field does not have are 0, or as the sign says, and are ignored on the
 * way back. Errors have been reported (paris_fail()). */
#ifndef PARIS_FIELD_BYTES_H
#define PARIS_FIELD_BYTES_H

#include "paris_state.h"

enum { FIELD_BYTES_BAND = 1 << 22, FIELD_BYTES_PIECE = 64 };

struct field_bytes {
    uint8_t *bytes; /* of the band */
    size_t count;
    /* private */
    struct machine *m;
    CM_field_id_t field;
    unsigned int bits;
    bool is_signed;
    struct machine_type whole; /* width 0: the field is taken in pieces */
    size_t value_bytes;
    uint64_t rows, band, row, rows_now;
    int columns;
    uint8_t *piece;
};

/* The current VP set's. False: no memory. type: of the whole field, if that is known; NULL:
 * bits. */
bool field_bytes_begin(struct field_bytes *b, struct machine *m, CM_field_id_t field,
                       unsigned int bits, size_t value_bytes, const struct machine_type *type,
                       bool is_signed);
/* Goes to the next band. False: there is none. */
bool field_bytes_next(struct field_bytes *b);
bool field_bytes_get(struct field_bytes *b); /* the band of the field to bytes */
bool field_bytes_put(struct field_bytes *b); /* and back, whatever the context */
/* Whether each value of the band has room in the field. */
bool field_bytes_fit(const struct field_bytes *b);
void field_bytes_end(struct field_bytes *b);

/* Bytes of all values. */
uint64_t field_bytes_all(const struct field_bytes *b);

#endif
