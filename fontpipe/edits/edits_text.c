/* edits_text.c - a folder's files as text, sums of bytes, and rectangles: see
 * edits_internal.h. */
#include "edits_internal.h"

#include <array.h>
#include <input_file.h>
#include <sha256.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool edits_file_is_plain(const char *file)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                "0123456789._-";
    return file[0] && file[0] != '.' && file[0] != '-' &&
           strlen(file) < FONT_EDITS_FILE_BYTES && !file[strspn(file, plain)];
}

char *edits_path(const char *folder, const char *file)
{
    size_t bytes = strlen(folder) + strlen(file) + 2;
    char *path = malloc(bytes);
    if (path)
        snprintf(path, bytes, "%s/%s", folder, file);
    return path;
}

enum font_status edits_file_read(const char *folder, const char *file, char **bytes,
                                 size_t *count)
{
    const char *why;
    char *path = edits_path(folder, file);
    *bytes = NULL;
    if (!path)
        return font_fail(FONT_NO_MEMORY, "no memory for %.60s", file);
    *bytes = input_file_read_no_link(path, EDITS_BYTES_MAX, count, &why);
    const enum font_status status =
        *bytes            ? FONT_OK
        : errno == EFBIG  ? font_fail(FONT_BAD_FILE, "%s: a file of edits has up to %d bytes",
                                      path, EDITS_BYTES_MAX)
        : errno == ENOMEM ? font_fail(FONT_NO_MEMORY, "no memory for %s", path)
                          : font_fail(FONT_BAD_FILE, "%s: %s", path, why);
    free(path);
    return status;
}

void edits_sum(const void *bytes, size_t count, int digits, char *room)
{
    struct sha256 sum;
    uint8_t digest[SHA256_BYTES];
    sha256_begin(&sum);
    sha256_add(&sum, bytes, count);
    sha256_end(&sum, digest);
    for (int i = 0; i < digits / 2; i++)
        snprintf(room + 2 * i, 3, "%02x", digest[i]);
}

bool edits_number(const char **at, int least, int most, int *value)
{
    char *end;
    const char *from = *at + strspn(*at, " \t");
    if (*from != '-' && (*from < '0' || *from > '9'))
        return false;
    long number = strtol(from, &end, 10);
    if (end == from || !memchr(" \t\r\n", *end, 5) || number < least || number > most)
        return false;
    *value = (int)number;
    *at = end + strspn(end, " \t\r");
    return true;
}

bool edits_size(const char **at, double least, double most, double *value)
{
    char *end;
    const char *from = *at + strspn(*at, " \t");
    if (!strchr("0123456789.", *from) || !*from)
        return false;
    double number = strtod(from, &end);
    if (end == from || !memchr(" \t\r\n", *end, 5) || !(number >= least && number <= most))
        return false;
    *value = number;
    *at = end + strspn(end, " \t\r");
    return true;
}

enum font_status edits_rectangles_read(const char *path, const char *text, double em_units,
                                       double advance, struct font_rectangles *out)
{
    enum { MANY = 200000 };
    int line = 0;
    *out = (struct font_rectangles){0};
    for (const char *at = text; *at; at += *at == '\n') {
        struct font_rectangle q = {0, 0, 0, 0};
        const char *from = at + strspn(at, " \t\r");
        at = from;
        line++;
        if (!*at || *at == '\n')
            continue;
        bool good;
        if (!out->em_px) {
            good = strncmp(at, "em ", 3) == 0 &&
                   (at += 3, edits_number(&at, 1, FONT_MASTER_EM_MAX, &out->em_px));
        } else {
            good = edits_number(&at, -EDITS_FAR, EDITS_FAR, &q.x0) &&
                   edits_number(&at, -EDITS_FAR, EDITS_FAR, &q.y0) &&
                   edits_number(&at, q.x0, EDITS_FAR, &q.x1) &&
                   edits_number(&at, q.y0, EDITS_FAR, &q.y1);
            if (good && out->count == MANY)
                return font_fail(FONT_TOO_LARGE, "%s: more than %d rectangles", path, MANY);
            if (good &&
                !array_reserve(&out->items, &out->capacity, out->count + 1, sizeof *out->items))
                return font_fail(FONT_NO_MEMORY, "no memory for %s", path);
            if (good)
                out->items[out->count++] = q;
        }
        if (!good || (*at && *at != '\n'))
            return font_fail(FONT_BAD_FILE,
                             "%s:%d: the first line is like 'em 860', the others x0 y0 x1 y1 "
                             "in its pixels",
                             path, line);
    }
    if (!out->em_px)
        return font_fail(FONT_BAD_FILE, "%s:1: the first line is like 'em 860'", path);
    out->advance_px = advance * out->em_px / em_units;
    return FONT_OK;
}
