/* patience.c - see patience.h. */
#include "patience.h"

#include <stddef.h>

static _Thread_local struct patience present;

struct patience patience_set(struct patience patience)
{
    const struct patience before = present;
    present = patience;
    return before;
}

bool patience_over(void)
{
    return present.over && present.over(present.context);
}
