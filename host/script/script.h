/* script.h - scripts of papers, inks and time: the Lua library, run by whoever has a use for it (the command, a window, a page).
 *
 *     struct script_config config = script_config_default("marsh.lua");
 *     struct script_host host = {.context = &mine, .print = print, .error = complain};
 *     if (script_run(&config, &host) != SCRIPT_OK)
 *         ...                               // complain() has been told why
 *
 * docs/scripts.md is the library's reference. A script is one Lua state, and all that it makes goes with it. What it takes is
 * counted, Lua's memory with the rest, and whatever takes long looks at the clock and asks the host whether to stop. Unless it is
 * trusted a script reaches no file but pictures, drawings and saved papers in the folders given, no process, and nothing of the
 * interpreter's inside.
 *
 * Whom a script meets is the host, a struct of functions; any may be NULL. They are called by the thread that runs the script,
 * where nothing else is said. Nothing is kept from run to run.
 *
 * Threads: a machine at a time belongs to a thread, as cm/paris.h says; scripts run where the machine is. */
#ifndef LUTETIA_SCRIPT_H
#define LUTETIA_SCRIPT_H

#include <sheet.h>
#include <state.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SCRIPT_WORDS_MAX = 64 };

/* What is run, and what it may take. */
struct script_config {
    const char *path;       /* the script's file */
    const char *in_folder;  /* of pictures, drawings and papers that it reads */
    const char *out_folder; /* of those that it writes */
    bool trusted;           /* no sandbox: all of Lua's library, names of files as they come */
    double timeout_s;       /* 0: any */
    double
        grace_s; /* from when the script should have stopped to overdue(); 30 times that while papers are at work */
    int papers_max;           /* most that are open at a time; 0: any */
    size_t memory_bytes;      /* most that papers, masks and Lua take together */
    uint64_t seed;            /* of papers and of math.random */
    const char *const *words; /* key=value, for param(); of the same key the last one counts */
    int words_count;          /* up to SCRIPT_WORDS_MAX */
    struct paper_state *resumed; /* papers that were saved by the same script; NULL: none */
};

/* Files where the program is, 600 s and 3 of grace, 4 GiB, seed 1990. */
struct script_config script_config_default(const char *path);

/* Work that takes many steps. `total` is what is known of now. */
struct script_progress {
    bool again; /* computed again for a paper's past; else the script's own steps */
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
    /* What the script prints, a call a line, its end in it. */
    void (*print)(void *context, const char *text, size_t length);
    /* Why it failed: a line, "marsh.lua:12: ...", without an end; and what one should know besides. */
    void (*error)(void *context, const char *text);
    void (*note)(void *context, const char *text);
    /* Whether to stop, asked often. */
    bool (*interrupted)(void *context);
    /* After each step, and with NULL when that work is over. */
    void (*progress)(void *context, const struct script_progress *progress);
    /* A paper, numbered from 1 in the order in which they are made, as it is made and after each of its steps. NULL, or why the
     * script must stop: the host's text, that lasts until the next call. */
    const char *(*step)(void *context, int paper, struct paper_sheet *sheet);
    void (*film)(void *context, const struct script_camera *camera);
    /* The script has ended, as the status says, and its papers are still open: they may be saved. Returns the run's status. */
    enum script_status (*finish)(void *context, const struct paper_state_sheet *papers,
                                 int count, enum script_status status);
    /* The script should have stopped seconds ago and does not: only the process's end helps. Called by a thread of its own, as
     * interrupted() is then, too; where there is no such function that thread is not there. */
    void (*overdue)(void *context);
};

/* Runs it. What it says goes to the host. */
enum script_status script_run(const struct script_config *config,
                              const struct script_host *host);

#endif
