/* beside.c - where a figure says that it stands: see reader_document.h. */
#include "reader_internal.h"

#include <stdlib.h>
#include <string.h>

/* A share as 40%; 0: it is none. */
static int percent_of(const char *word, size_t bytes)
{
    enum { LEAST = 10, MOST = 90 };
    if (bytes != 3 || word[2] != '%' || strspn(word, "0123456789") != 2)
        return 0;
    const int percent = 10 * (word[0] - '0') + word[1] - '0';
    return percent >= LEAST && percent <= MOST ? percent : 0;
}

static bool is_word(const char *at, size_t bytes, const char *word)
{
    return strlen(word) == bytes && strncmp(at, word, bytes) == 0;
}

/* False: it is no word of these, or says what another one has said. */
static bool word_take(const char *at, size_t bytes, struct reader_beside *to)
{
    static const char *const sides[] = {"", "left", "right", "full"};
    for (int i = READER_SIDE_LEFT; i <= READER_SIDE_NONE; i++)
        if (is_word(at, bytes, sides[i]) && to->side == READER_SIDE_USUAL) {
            to->side = (enum reader_side)i;
            return true;
        }
    const int percent = percent_of(at, bytes);
    if (percent && !to->percent) {
        to->percent = percent;
        return true;
    }
    const bool round = is_word(at, bytes, "round"), shape = is_word(at, bytes, "shape"),
               good = (round || shape) && !to->round && !to->shape;
    to->round = to->round || (good && round);
    to->shape = to->shape || (good && shape);
    return good;
}

bool reader_beside_read(const char *words, struct reader_beside *out)
{
    struct reader_beside read = {.side = READER_SIDE_USUAL};
    *out = read;
    for (const char *at = words ? words : ""; *(at += strspn(at, " \t\n"));) {
        const size_t bytes = strcspn(at, " \t\n");
        if (!word_take(at, bytes, &read))
            return false;
        at += bytes;
    }
    const bool more = read.percent || read.round || read.shape;
    if (read.side == READER_SIDE_USUAL || (read.side == READER_SIDE_NONE && more))
        return false;
    *out = read;
    return true;
}

bool reader_beside_same(const struct reader_beside *a, const struct reader_beside *b)
{
    return a->side == b->side && a->percent == b->percent && a->round == b->round &&
           a->shape == b->shape;
}
