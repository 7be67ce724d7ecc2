/* plain_screen.c - what sheets need of type: nothing but giving screens back. */
#include <paper.h>

#include <stdlib.h>

void paper_screen_destroy(struct paper_screen *screen)
{
    free(screen->gray);
    *screen = (struct paper_screen){0};
}
