/* beside.c - see beside.h. */
#include "beside.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool display_beside_read(const char *file, const char *target, struct display_image *out)
{
    const double bytes_max = 512e6;
    const char *slash = strrchr(file, '/');
    const size_t n = strlen(target);
    char *path;
    if (n < 5 || strcmp(target + n - 4, ".png") != 0 || target[0] == '/' ||
        strstr(target, "..") || strchr(target, ':'))
        return false;
    if (asprintf(&path, "%.*s%s", slash ? (int)(slash + 1 - file) : 0, file, target) < 0)
        return false;
    const bool found = display_png_bytes(path, 3) <= bytes_max &&
                       display_png_read_rgb(path, out) == DISPLAY_OK;
    free(path);
    return found;
}
