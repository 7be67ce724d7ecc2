/* paint_frames.c - `lutetia paint --frames`: the names of the pictures on the way. */
#include "verb_paint.h"

#include <stdio.h>

int paint_frames_path(const struct paint *paint, int step, char *path)
{
    int length = snprintf(path, PAINT_PATH_MAX, "%s/frame-%06d.png", paint->frames_dir, step);
    if (length < 0 || length >= PAINT_PATH_MAX)
        return fail("paint", "--frames: the folder's name is too long");
    return EXIT_SUCCESS;
}
