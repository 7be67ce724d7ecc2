/* run.h - `lutetia run`: runs a script, with its film, its saved state and its reports. */
#ifndef LUTETIA_RUN_H
#define LUTETIA_RUN_H

#include "film.h"
#include "lutetia.h"

#include <script.h>

struct run {
    struct script_config config;
    const char *words[SCRIPT_WORDS_MAX]; /* the config's */
    bool quiet;
    const char *save; /* --save; NULL: none */
    struct film film;
    /* Receives the steps of a run that is one of several, and has no progress line of its
     * own; NULL: none. */
    void (*report)(const struct run *run, long done, long total);
    int report_to; /* for report() */
    /* its own */
    struct progress line;
    bool line_begun, line_again;
};

/* One run of the script: EXIT_SUCCESS, EXIT_FAILED or EXIT_INTERRUPTED. */
int run_script(struct run *run);

/* Prints what the script prints on the standard output. */
void run_print(const struct run *run, const char *text, size_t length);

#endif
