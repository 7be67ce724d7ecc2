/* numbers.c - see numbers.h. */
#include "ranks/numbers.h"

#include "base/arrays.h"

uint32_t numbers_get(struct numbers *n)
{
    return n->count ? n->left[--n->count] : ++n->made;
}

void numbers_leave(struct numbers *n, uint32_t number)
{
    if (n->count == n->capacity)
        n->left = array_grown(n->left, &n->capacity, sizeof *n->left);
    n->left[n->count++] = number;
}
