/* run.h - `lutetia run`: runs a script, with its film, its saved state and its reports. */
#ifndef LUTETIA_RUN_H
#define LUTETIA_RUN_H

#include "film.h"
#include "lutetia.h"

#include <script.h>

/* The files of a run: the first ones' and the last one's paths, without those that were written
 * again. */
enum { WRITTEN_NAMED = 3 };
struct written {
    char first[WRITTEN_NAMED][PATH_MAX], last[PATH_MAX];
    int named; /* of `first` */
    bool more; /* than those, and the last one is `last` */
};

struct run {
    struct script_config config;
    const char *words[SCRIPT_WORDS_MAX]; /* the config's */
    bool quiet;
    const char *save; /* --save; NULL: none */
    bool alone; /* it is no run of a sweep: after Ctrl-C without --save its papers are kept
                       * beside its pictures, and its end says which files there are */
    struct film film;
    /* Receives the steps of a run that is one of several, and has no progress line of its
     * own; NULL: none. */
    void (*report)(const struct run *run, long done, long total);
    int report_to; /* for report() */
    /* its own */
    struct progress line;
    bool line_begun, line_again;
    struct written written;
};

/* One run of the script: EXIT_SUCCESS, EXIT_FAILED or EXIT_INTERRUPTED. */
int run_script(struct run *run);

/* Prints what the script prints on the standard output. */
void run_print(const struct run *run, const char *text, size_t length);

#endif
