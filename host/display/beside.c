/* beside.c - see beside.h. */
#include "beside.h"
#include "display_internal.h"

#include <input_file.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The path of a PNG that may be read. Owns: the caller frees it; NULL: there is none. */
static char *path_of(const char *file, const char *target)
{
    const double bytes_max = 512e6;
    const char *slash = strrchr(file, '/');
    const size_t n = strlen(target);
    char *path;
    if (n < 5 || strcmp(target + n - 4, ".png") != 0 || target[0] == '/' ||
        strstr(target, "..") || strchr(target, ':'))
        return NULL;
    if (asprintf(&path, "%.*s%s", slash ? (int)(slash + 1 - file) : 0, file, target) < 0)
        return NULL;
    if (display_png_bytes(path, 4) <= bytes_max)
        return path;
    free(path);
    return NULL;
}

bool display_beside_read(const char *file, const char *target, struct display_image *out)
{
    char *path = path_of(file, target);
    const bool found = path && display_png_read_rgb(path, out) == DISPLAY_OK;
    free(path);
    return found;
}

bool display_beside_read_alpha(const char *file, const char *target, struct display_image *out,
                               uint8_t **alpha)
{
    char *path = path_of(file, target);
    *alpha = NULL;
    const bool found = path && display_png_read_rgb_alpha(path, out, alpha) == DISPLAY_OK;
    const size_t all = found ? (size_t)out->width_px * (size_t)out->height_px : 0;
    size_t opaque = 0;
    while (opaque < all && (*alpha)[opaque] == UINT8_MAX)
        opaque++;
    if (opaque == all) {
        free(*alpha);
        *alpha = NULL;
    }
    free(path);
    return found;
}

bool display_beside_copy(const char *file, const char *target, FILE *to)
{
    struct display_image image = {0};
    const char *why;
    char *path = path_of(file, target), bytes[65536];
    FILE *from = path && display_png_read_rgb(path, &image) == DISPLAY_OK
                     ? input_file_open(path, &why)
                     : NULL;
    bool good = from != NULL;
    for (size_t n; good && (n = fread(bytes, 1, sizeof bytes, from)) > 0;)
        good = fwrite(bytes, 1, n, to) == n;
    good = good && !ferror(from);
    if (from)
        fclose(from);
    display_image_destroy(&image);
    free(path);
    return good;
}
