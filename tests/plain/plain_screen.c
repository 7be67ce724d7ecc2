/* plain_screen.c - functions of type that sheets call: one that frees a screen; and in place of
 * the one that sets type, which needs fonts, one that cannot. */
#include <paper.h>

#include <stdlib.h>

void paper_screen_destroy(struct paper_screen *screen)
{
    free(screen->gray);
    *screen = (struct paper_screen){0};
}

enum paper_status paper_line_screen(const struct paper_line *line, struct paper_screen *screen,
                                    uint32_t *missing)
{
    (void)line;
    (void)missing;
    *screen = (struct paper_screen){0};
    return PAPER_BAD_FONT;
}
