/* script.h - scripts of papers, inks and time: the Lua library, for any host (the command, a
 * window, a page).
 *
 *     struct script_config config = script_config_default("marsh.lua");
 *     struct script_host host = {.context = &mine, .print = print, .error = complain};
 *     if (script_run(&config, &host) != SCRIPT_OK)
 *         ...                               // complain() got the reason
 *
 * docs/scripts.md is the library's reference. A script has its own Lua state, and everything it
 * makes is freed with it. All memory is counted, including Lua's. Long operations check the
 * time limit, and ask the host whether to stop. An untrusted script can use no files except
 * pictures, drawings and saved papers in the given folders, no processes, and no internals of
 * the interpreter.
 *
 * The host is a struct of functions; any may be NULL. Unless stated otherwise, they are called
 * by the thread that runs the script. No state is kept between runs.
 *
 * Threads: a machine at a time belongs to a thread, as cm/paris.h says; scripts run where
 * the machine is.
 */
#ifndef LUTETIA_SCRIPT_H
#define LUTETIA_SCRIPT_H

#include <sheet.h>
#include <state.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SCRIPT_WORDS_MAX = 64 };

/* The script, and its limits. */
struct script_config {
    const char *path;       /* the script's file */
    const char *in_folder;  /* for pictures, drawings and papers that it reads; NULL: none */
    const char *out_folder; /* for files that it writes; NULL: none */
    bool trusted;           /* no sandbox: Lua's whole library, and any file names */
    double timeout_s;       /* 0: any */
    bool patient;   /* what papers at work are doing is worth waiting for: it will be saved */
    bool keeps;     /* the same once the host says stop, but not at the end of the time */
    double grace_s; /* seconds between the time at which the script should have stopped and
                  * overdue(); 30 times that while papers are at work and it is patient */
    int papers_max; /* the most papers open at a time; 0: any number */
    size_t memory_bytes;         /* the most memory of papers, masks and Lua together */
    uint64_t seed;               /* for papers and math.random */
    const char *const *words;    /* key=value, for param(); of equal keys the last one counts */
    int words_count;             /* up to SCRIPT_WORDS_MAX */
    struct paper_state *resumed; /* papers that were saved by the same script; NULL: none */
};

/* Defaults: files in the current folder, 600 s and 1 s of grace, 4 GiB, seed 1990. */
struct script_config script_config_default(const char *path);

/* Work that takes many steps. `total` is what is known at the moment. */
struct script_progress {
    bool again; /* a paper's past is computed again; else the script's own steps */
    long done, total;
    double began_s; /* on CLOCK_MONOTONIC */
};

/* What p:film{} says: a paper, how it looks, a place in fibers. */
struct script_camera {
    int paper;
    enum paper_show show; /* COLOR or WET */
    double x, y, width, height;
};

enum script_status { SCRIPT_OK, SCRIPT_FAILED, SCRIPT_INTERRUPTED };

struct script_host {
    void *context;
    /* Receives what the script prints; each call is a line, with its end. */
    void (*print)(void *context, const char *text, size_t length);
    /* Receives the error message, "marsh.lua:12: ...", without a line end; also warnings. */
    void (*error)(void *context, const char *text);
    void (*note)(void *context, const char *text);
    /* Whether to stop; called often. */
    bool (*interrupted)(void *context);
    /* Called after each step, and with NULL when the work is over. */
    void (*progress)(void *context, const struct script_progress *progress);
    /* Called when a paper is made, and after each of its steps. Papers are numbered from 1
     * in the order in which they are made. Returns NULL, or the reason why the script must
     * stop; the host's text must stay valid until the next call. */
    const char *(*step)(void *context, int paper, struct paper_sheet *sheet);
    void (*film)(void *context, const struct script_camera *camera);
    /* A file that the script named is there: a picture, a saved paper, a network. */
    void (*wrote)(void *context, const char *path);
    /* Called when the script has ended with the status, while its papers are still open and
     * can be saved. Returns the run's status. */
    enum script_status (*finish)(void *context, const struct paper_state_sheet *papers,
                                 int count, enum script_status status);
    /* Called when the process takes more memory than the script may and does not stop taking:
     * the host should end it. Called by the separate thread; there is none if overdue is
     * NULL. */
    void (*overfull)(void *context);
    /* Called when the script should have stopped seconds ago and has not: the host should
     * end the process. Called by a separate thread, which also calls interrupted(). If
     * overdue is NULL there is no such thread. */
    void (*overdue)(void *context);
};

/* Runs the script. Output and errors go to the host. */
enum script_status script_run(const struct script_config *config,
                              const struct script_host *host);

/* Calls each() for every function that the library has for scripts: its name, and the type that
 * it belongs to ("paper", "brush"; "" for functions that stand by themselves). Threads: any. */
void script_functions_list(void (*each)(const char *type, const char *name));

#endif
