/* watched_text.c - see watched_text.h. */
#include "watched_text.h"

#include <input_file.h>
#include <session.h>

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const double every_s = 0.1;

struct watched_text {
    char *path;
    struct stat seen, read; /* as it was at the last look, and when it was read */
    double next_s;
    bool fresh, is_wrong;
    char words[STAGE_TEXT_BYTES + 2], wrong[300];
};

static bool same(const struct stat *a, const struct stat *b)
{
    return a->st_ino == b->st_ino && a->st_size == b->st_size &&
           a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

/* The words as they were stay where it fails. */
static enum stage_status file_read(struct watched_text *w)
{
    enum { MARGIN = 64 }; /* of line ends and blanks */
    char text[STAGE_TEXT_BYTES + MARGIN + 1];
    const char *why = NULL;
    FILE *file = input_file_open(w->path, &why);
    if (!file)
        return stage_fail(STAGE_BAD_FILE, "%.200s: cannot be read: %s", w->path, why);
    size_t count = fread(text, 1, sizeof text, file);
    const bool wrong = ferror(file);
    why = wrong ? strerror(errno) : NULL;
    fclose(file);
    if (wrong)
        return stage_fail(STAGE_BAD_FILE, "%.200s: cannot be read: %s", w->path, why);
    while (count && strchr(" \t\r\n", text[count - 1]) && text[count - 1])
        count--;
    if (count > STAGE_TEXT_BYTES || memchr(text, 0, count))
        return stage_fail(STAGE_BAD_FILE, "%.200s: must be text of %d bytes at most", w->path,
                          STAGE_TEXT_BYTES);
    w->fresh = w->fresh || strlen(w->words) != count || memcmp(w->words, text, count) != 0;
    memcpy(w->words, text, count);
    w->words[count] = '\0';
    return STAGE_OK;
}

enum stage_status watched_text_open(const char *path, struct watched_text **out)
{
    struct watched_text *w = calloc(1, sizeof *w);
    *out = NULL;
    if (!w || !(w->path = strdup(path))) {
        free(w);
        return stage_fail(STAGE_NO_MEMORY, "no memory for a text");
    }
    w->next_s = -INFINITY;
    w->fresh = true;
    (void)stat(path, &w->seen); /* where it is not there, reading it says so */
    w->read = w->seen;
    const enum stage_status status = file_read(w);
    if (status == STAGE_OK)
        *out = w;
    else
        watched_text_close(w);
    return status;
}

void watched_text_close(struct watched_text *w)
{
    if (!w)
        return;
    free(w->path);
    free(w);
}

const char *watched_text_look(struct watched_text *w, double now_s)
{
    struct stat now;
    if (now_s >= w->next_s) {
        w->next_s = now_s + every_s;
        const bool is_there = stat(w->path, &now) == 0;
        const bool still = is_there && same(&now, &w->seen);
        if (is_there)
            w->seen = now;
        if (still && !same(&now, &w->read)) {
            w->read = now;
            w->is_wrong = file_read(w) != STAGE_OK;
            if (w->is_wrong)
                snprintf(w->wrong, sizeof w->wrong, "%s", stage_error());
        }
    }
    const bool fresh = w->fresh && w->words[0];
    w->fresh = w->fresh && !w->words[0];
    return fresh ? w->words : NULL;
}

const char *watched_text_wrong(struct watched_text *w)
{
    const bool wrong = w->is_wrong;
    w->is_wrong = false;
    return wrong ? w->wrong : NULL;
}
