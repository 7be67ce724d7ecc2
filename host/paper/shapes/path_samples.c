/* path_samples.c - recorded samples of strokes, as text. */
#include "shapes/path_internal.h"

#include <array.h>
#include <input_file.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum paper_status paper_file_read(const char *file, char **bytes, size_t *count)
{
    const char *why;
    *bytes = input_file_read(file, PAPER_FILE_MAX, count, &why);
    if (*bytes)
        return PAPER_OK;
    if (errno == EFBIG)
        return paper_fail(PAPER_BAD_ARGUMENT, "%s: it has more than %d bytes", file,
                          PAPER_FILE_MAX);
    return paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot read: %s", file, why);
}

/* Reads the numbers of one line, at most 6; -1: the line contains something else. */
static int numbers_read(const char *c, const char *end, double out[6])
{
    int count = 0;
    for (;;) {
        while (c < end && strchr(" \t\r", *c))
            c++;
        if (c == end)
            return count;
        if (count > 0 && (*c == ',' || *c == ';'))
            for (c++; c < end && strchr(" \t\r", *c);)
                c++;
        if (c == end || count == 6 || !strchr("+-.0123456789", *c))
            return -1;
        char text[64], *stop;
        size_t length = strspn(c, "+-.0123456789eE");
        if (length >= sizeof text || length > (size_t)(end - c))
            return -1;
        memcpy(text, c, length);
        text[length] = '\0';
        out[count] = strtod(text, &stop);
        if (*stop || !isfinite(out[count]))
            return -1;
        count++;
        c += length;
    }
}

static enum paper_status line_fail(const char *name, int number, const char *what)
{
    return paper_fail(PAPER_BAD_ARGUMENT, "%s:%d: %s", name, number, what);
}

enum paper_status paper_samples_parse(const char *bytes, size_t count, const char *name,
                                      struct paper_stroke_sample **samples, int *samples_count)
{
    static const char wanted[] =
        "a line has time, x, y [, pressure 0..1 [, tilt x, tilt y -1.5..1.5]]";
    enum paper_status status = PAPER_OK;
    struct paper_stroke_sample *made = NULL;
    int found = 0, number = 0, room = 0;
    bool first = true; /* a line of names is still allowed */
    for (const char *c = bytes, *end = bytes + count; c < end && status == PAPER_OK; number++) {
        const char *stop = memchr(c, '\n', (size_t)(end - c));
        stop = stop ? stop : end;
        const char *begin = c;
        while (begin < stop && strchr(" \t\r", *begin))
            begin++;
        c = stop < end ? stop + 1 : end;
        if (begin == stop || *begin == '#')
            continue;
        double n[6] = {0, 0, 0, 0.5, 0, 0};
        if (memchr(begin, '\0', (size_t)(stop - begin))) {
            status = line_fail(name, number + 1, "it is no text");
            break;
        }
        int numbers = numbers_read(begin, stop, n);
        bool names = first && numbers < 0 &&
                     ((*begin >= 'a' && *begin <= 'z') || (*begin >= 'A' && *begin <= 'Z') ||
                      *begin == '"');
        first = false;
        if (names)
            continue;
        if (numbers != 3 && numbers != 4 && numbers != 6) {
            status = line_fail(name, number + 1, wanted);
            break;
        }
        if (!(n[3] >= 0 && n[3] <= 1 && fabs(n[4]) <= 1.5 && fabs(n[5]) <= 1.5 &&
              fabs(n[1]) <= 1e6 && fabs(n[2]) <= 1e6 && n[0] >= 0 && n[0] <= 1e5)) {
            status = line_fail(name, number + 1, "a number is out of its range");
            break;
        }
        if (found > 0 && !(n[0] > made[found - 1].time_s)) {
            status = line_fail(name, number + 1, "times must ascend");
            break;
        }
        if (found == PAPER_STROKE_SAMPLES_MAX) {
            status = line_fail(name, number + 1, "more than 100000 samples");
            break;
        }
        if (!array_reserve(&made, &room, found + 1, sizeof *made)) {
            status = paper_fail(PAPER_NO_MEMORY, "%s: no memory to read it", name);
            break;
        }
        made[found++] = (struct paper_stroke_sample){n[0], n[1], n[2], n[3], n[4], n[5]};
    }
    if (status == PAPER_OK && found == 0)
        status =
            paper_fail(PAPER_BAD_ARGUMENT, "%s: there are no samples in it; %s", name, wanted);
    if (status != PAPER_OK) {
        free(made);
        made = NULL;
        found = 0;
    }
    *samples = made;
    *samples_count = found;
    return status;
}

enum paper_status paper_samples_read(const char *file, struct paper_stroke_sample **samples,
                                     int *samples_count)
{
    char *bytes;
    size_t count;
    *samples = NULL;
    *samples_count = 0;
    enum paper_status status = paper_file_read(file, &bytes, &count);
    if (status == PAPER_OK)
        status = paper_samples_parse(bytes, count, file, samples, samples_count);
    free(bytes);
    return status;
}
