/* pen_none.c - stands for pen_x11.c where Lutetia is built without XInput 2: there is no
 * pen. */
#include "pen.h"

#include <stddef.h>

struct pen *pen_open(void)
{
    return NULL;
}

void pen_close(struct pen *pen)
{
    (void)pen;
}

struct pen_state pen_now(struct pen *pen)
{
    (void)pen;
    return (struct pen_state){0};
}
