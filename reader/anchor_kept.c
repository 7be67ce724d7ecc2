/* anchor_kept.c - anchors as bytes, to be kept in files: see reader_anchor.h.
 *
 *     a version, 15 numbers of 64 bits, the lowest byte first; the sides with the quotation; the headings, which end with a zero */
#include "anchor_internal.h"
#include "reader_internal.h"

#include <stdlib.h>
#include <string.h>

enum { VERSION = 1, NUMBERS = 15, HEAD_BYTES = 8 * (NUMBERS + 1), HEADINGS_MOST = 1 << 16 };

static void number_put(unsigned char *to, uint64_t number)
{
    for (int i = 0; i < 8; i++)
        to[i] = (unsigned char)(number >> (8 * i));
}

static uint64_t number_get(const unsigned char *from)
{
    uint64_t number = 0;
    for (int i = 0; i < 8; i++)
        number |= (uint64_t)from[i] << (8 * i);
    return number;
}

enum reader_status reader_anchor_keep(const struct reader_anchor *a, unsigned char **out,
                                      size_t *count)
{
    const size_t sides = a->left + a->quotation + a->right;
    size_t headings = strlen(a->headings);
    headings = headings < HEADINGS_MOST ? headings : HEADINGS_MOST;
    const uint64_t numbers[NUMBERS + 1] = {
        VERSION,        a->begin,        a->end,          a->bytes,
        a->digest,      a->left,         a->quotation,    a->right,
        a->before.left, a->before.apart, a->behind.right, a->behind.apart,
        a->both.left,   a->both.right,   a->both.apart,   headings};
    *count = HEAD_BYTES + sides + headings + 1;
    *out = malloc(*count);
    if (!*out)
        return reader_fail(READER_NO_MEMORY, "no memory for an anchor");
    for (int i = 0; i <= NUMBERS; i++)
        number_put(*out + 8 * i, numbers[i]);
    memcpy(*out + HEAD_BYTES, a->text, sides);
    memcpy(*out + HEAD_BYTES + sides, a->headings, headings);
    (*out)[*count - 1] = '\0';
    return READER_OK;
}

/* Whether the numbers fit together and the bytes. */
static bool numbers_hold(const uint64_t n[NUMBERS + 1], size_t count)
{
    const uint64_t side = READER_ANCHOR_SIDE_MOST;
    return n[0] == VERSION && n[1] <= n[2] && n[2] <= n[3] && n[3] < INT64_MAX &&
           n[5] <= side && n[7] <= side && n[6] == n[2] - n[1] &&
           n[6] <= READER_ANCHOR_QUOTATION_MOST && n[5] <= n[1] && n[7] <= n[3] - n[2] &&
           n[8] <= n[5] && n[12] <= n[5] && n[10] <= n[7] && n[13] <= n[7] && n[9] <= 1 &&
           n[11] <= 1 && n[14] <= 1 && n[15] <= HEADINGS_MOST &&
           count == HEAD_BYTES + n[5] + n[6] + n[7] + n[15] + 1;
}

enum reader_status reader_anchor_restore(const unsigned char *kept, size_t count,
                                         struct reader_anchor **out)
{
    uint64_t n[NUMBERS + 1];
    *out = NULL;
    for (int i = 0; i <= NUMBERS && count >= HEAD_BYTES; i++)
        n[i] = number_get(kept + 8 * i);
    if (count < HEAD_BYTES || !numbers_hold(n, count) || kept[count - 1] ||
        memchr(kept + count - 1 - n[15], 0, n[15]))
        return reader_fail(READER_BAD_ARGUMENT, "%zu bytes that are no anchor", count);
    const size_t sides = n[5] + n[6] + n[7];
    struct reader_anchor *a = calloc(1, sizeof *a);
    if (a) {
        *a = (struct reader_anchor){.begin = n[1],
                                    .end = n[2],
                                    .bytes = n[3],
                                    .digest = n[4],
                                    .left = n[5],
                                    .quotation = n[6],
                                    .right = n[7],
                                    .before = {.left = n[8], .apart = n[9]},
                                    .behind = {.right = n[10], .apart = n[11]},
                                    .both = {n[12], n[13], n[14]},
                                    .text = malloc(sides + 1),
                                    .headings = strdup((const char *)kept + count - 1 - n[15])};
    }
    if (!a || !a->text || !a->headings) {
        reader_anchor_destroy(a);
        return reader_fail(READER_NO_MEMORY, "no memory for an anchor");
    }
    memcpy(a->text, kept + HEAD_BYTES, sides);
    a->text[sides] = '\0';
    *out = a;
    return READER_OK;
}
