/* recording.c - see recording.h. */
#include "recording.h"

#include <exit_status.h>
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "paris_state.h"

bool paris_recording_wanted(const struct paris_recording *r)
{
    const char *name = getenv(r->variable);
    return name && *name && !r->failed;
}

static void fail(struct paris_recording *r, const char *what)
{
    r->failed = true; /* so that an error handler is called once */
    exit_status_fail();
    paris_fail("%s: cannot %s %.200s: %s", r->variable, what, getenv(r->variable), r->file.why);
}

void paris_recording_finish(struct paris_recording *r)
{
    if (!growing_file_close(&r->file)) {
        visible_say("%s: cannot write to the recording: %s", r->variable, r->file.why);
        exit_status_fail();
    }
}

static bool file_open(struct paris_recording *r)
{
    if (r->file.is_open)
        return true;
    if (strcmp(getenv(r->variable), "window") == 0) {
        r->failed = true; /* set while opening: an error handler may not return */
        const int pipe = paris_viewer_open(r);
        r->failed = pipe < 0;
        if (r->failed)
            return false;
        growing_file_of_pipe(&r->file, pipe);
    } else if (!growing_file_open(&r->file, getenv(r->variable))) {
        fail(r, "open");
        return false;
    } else if (r->room_wanted) {
        char variable[64];
        snprintf(variable, sizeof variable, "%s_ROOM", r->variable);
        picture_room_find(&r->room, getenv(variable), getenv(r->variable));
    }
    atexit(r->finish);
    clock_gettime(CLOCK_MONOTONIC, &r->began);
    return true;
}

uint64_t paris_recording_us(struct paris_recording *r)
{
    struct timespec now;
    if (!file_open(r))
        return 0;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)(now.tv_sec - r->began.tv_sec) * 1000000 + (uint64_t)(now.tv_nsec / 1000) -
           (uint64_t)(r->began.tv_nsec / 1000);
}

/* The first piece, and the line before it: a file that holds the line only is never seen. */
static bool first_append(struct paris_recording *r, const void *piece, size_t bytes)
{
    const size_t line = strlen(r->line);
    char *both = malloc(line + bytes);
    if (!both)
        return growing_file_append(&r->file, r->line, line, NULL, 0) &&
               growing_file_append(&r->file, piece, bytes, NULL, 0);
    memcpy(both, r->line, line);
    memcpy(both + line, piece, bytes);
    const bool good = growing_file_append(&r->file, both, line + bytes, NULL, 0);
    free(both);
    return good;
}

void paris_recording_add(struct paris_recording *r, const void *piece, size_t bytes)
{
    if (!file_open(r))
        return;
    /* one write, so that a piece is complete or missing */
    if (r->begun ? growing_file_append(&r->file, piece, bytes, NULL, 0)
                 : first_append(r, piece, bytes))
        r->begun = true;
    else
        fail(r, "write to");
}
