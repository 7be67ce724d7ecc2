/* field_bytes.c - see field_bytes.h. A field of 8, 16, 32 or 64 bits whose values have as many
 * bytes goes as it is; another goes in pieces of 64 bits at most, which are put beside each
 * other. */
#include "field_bytes.h"

#include <stdlib.h>
#include <string.h>

static bool goes_whole(unsigned int bits, size_t value_bytes)
{
    return (bits == 8 || bits == 16 || bits == 32 || bits == 64) && bits == 8 * value_bytes;
}

bool field_bytes_begin(struct field_bytes *b, struct machine *m, CM_field_id_t field,
                       unsigned int bits, size_t value_bytes, const struct machine_type *type,
                       bool is_signed)
{
    const int set = machine_vpset_current(m);
    const int columns = machine_vpset_length(m, set, machine_vpset_rank(m, set) - 1);
    const uint64_t row = (uint64_t)columns * value_bytes;
    *b = (struct field_bytes){.m = m,
                              .field = field,
                              .bits = bits,
                              .is_signed = is_signed,
                              .value_bytes = value_bytes,
                              .rows = machine_vpset_count(m, set) / (uint64_t)columns,
                              .band = row < FIELD_BYTES_BAND ? FIELD_BYTES_BAND / row : 1,
                              .columns = columns};
    if (b->band > b->rows)
        b->band = b->rows;
    if (goes_whole(bits, value_bytes))
        b->whole = type ? *type : MACHINE_UINT((int)bits);
    else
        b->piece = malloc(b->band * (uint64_t)columns * sizeof(uint64_t));
    b->bytes = malloc(b->band * row);
    if (b->bytes && (b->piece || b->whole.width))
        return true;
    paris_fail_memory("not enough memory for a band of %llu bytes",
                      (unsigned long long)(b->band * row));
    field_bytes_end(b);
    return false;
}

void field_bytes_end(struct field_bytes *b)
{
    free(b->bytes);
    free(b->piece);
    b->bytes = b->piece = NULL;
}

uint64_t field_bytes_all(const struct field_bytes *b)
{
    return b->rows * (uint64_t)b->columns * b->value_bytes;
}

bool field_bytes_next(struct field_bytes *b)
{
    b->row += b->rows_now;
    b->rows_now = b->rows - b->row < b->band ? b->rows - b->row : b->band;
    b->count = (size_t)(b->rows_now * (uint64_t)b->columns * b->value_bytes);
    return b->rows_now > 0;
}

static struct machine_block block_now(const struct field_bytes *b)
{
    return (struct machine_block){b->row, b->rows_now, 0, b->columns};
}

static bool good(enum machine_status status)
{
    if (status != MACHINE_OK)
        paris_fail_machine();
    return status == MACHINE_OK;
}

/* A piece of each value: bits from `at` on. */
struct part {
    unsigned int at, bits;
    size_t element_bytes;
};

static struct part part_of(const struct field_bytes *b, unsigned int at)
{
    const unsigned int left = b->bits - at;
    const unsigned int bits = left < FIELD_BYTES_PIECE ? left : FIELD_BYTES_PIECE;
    return (struct part){at, bits, machine_element_bytes(MACHINE_UINT((int)bits))};
}

static void part_spread(const struct field_bytes *b, struct part p)
{
    const size_t first = p.at / 8, room = b->value_bytes - first;
    const bool last = p.at + p.bits == b->bits;
    const uint64_t count = b->rows_now * (uint64_t)b->columns;
    for (uint64_t i = 0; i < count; i++) {
        uint8_t *value = b->bytes + i * b->value_bytes + first;
        uint64_t x = 0;
        memcpy(&x, b->piece + i * p.element_bytes,
               p.element_bytes); /* both are little-endian */
        const bool negative = last && b->is_signed && (x >> (p.bits - 1) & 1);
        if (negative && p.bits < 64)
            x |= ~0ull << p.bits;
        memcpy(value, &x, room < 8 ? room : 8);
        if (last && room > 8)
            memset(value + 8, negative ? 255 : 0, room - 8);
    }
}

static void part_gather(const struct field_bytes *b, struct part p)
{
    const size_t first = p.at / 8, room = b->value_bytes - first;
    const uint64_t mask = p.bits < 64 ? (1ull << p.bits) - 1 : ~0ull;
    const uint64_t count = b->rows_now * (uint64_t)b->columns;
    for (uint64_t i = 0; i < count; i++) {
        uint64_t x = 0;
        memcpy(&x, b->bytes + i * b->value_bytes + first, room < 8 ? room : 8);
        x &= mask;
        memcpy(b->piece + i * p.element_bytes, &x, p.element_bytes);
    }
}

bool field_bytes_get(struct field_bytes *b)
{
    const struct machine_block of = block_now(b);
    if (b->whole.width)
        return good(machine_block_download(b->m, b->field, b->whole, &of, b->bytes,
                                           (size_t)b->columns * b->value_bytes));
    for (unsigned int at = 0; at < b->bits; at += FIELD_BYTES_PIECE) {
        const struct part p = part_of(b, at);
        if (!good(machine_block_download(b->m, b->field + at, MACHINE_UINT((int)p.bits), &of,
                                         b->piece, (size_t)b->columns * p.element_bytes)))
            return false;
        part_spread(b, p);
    }
    return true;
}

bool field_bytes_put(struct field_bytes *b)
{
    const struct machine_block of = block_now(b);
    if (b->whole.width)
        return good(machine_block_upload(b->m, b->field, b->whole, &of, b->bytes,
                                         (size_t)b->columns * b->value_bytes));
    for (unsigned int at = 0; at < b->bits; at += FIELD_BYTES_PIECE) {
        const struct part p = part_of(b, at);
        part_gather(b, p);
        if (!good(machine_block_upload(b->m, b->field + at, MACHINE_UINT((int)p.bits), &of,
                                       b->piece, (size_t)b->columns * p.element_bytes)))
            return false;
    }
    return true;
}

bool field_bytes_fit(const struct field_bytes *b)
{
    if (b->bits == 8 * b->value_bytes || b->value_bytes > 8)
        return true;
    for (const uint8_t *at = b->bytes; at < b->bytes + b->count; at += b->value_bytes) {
        uint64_t x = 0;
        memcpy(&x, at, b->value_bytes);
        const unsigned int width = 8 * (unsigned int)b->value_bytes;
        const uint64_t over = x >> (b->is_signed ? b->bits - 1 : b->bits);
        const uint64_t ones = ~0ull >> (64 - width + (b->is_signed ? b->bits - 1 : b->bits));
        if (over != 0 && !(b->is_signed && over == ones))
            return false;
    }
    return true;
}
