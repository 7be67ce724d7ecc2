/* plain_screen.c - the only function of type that sheets call: the one that frees a screen. */
#include <paper.h>

#include <stdlib.h>

void paper_screen_destroy(struct paper_screen *screen)
{
    free(screen->gray);
    *screen = (struct paper_screen){0};
}
