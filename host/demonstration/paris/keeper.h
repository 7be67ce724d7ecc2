/* keeper.h - the process of a demonstration that is a program in C/Paris: it compiles the
 * program, runs it, and looks at its lights and displays for the window.
 *
 *     window  <- wire ->  keeper (paris_main.c)  -- lights, displays, what is printed --  program
 *                             build.c    compiles it, starts it, each in a jail (jail.h)
 *                             seen.c     its lights and displays as a picture
 *                             lines.c    what it prints, the last of it
 *
 * The program is compiled and runs in a private folder, which goes with it. Each latch of the
 * lights, and each change of what a display shows, is a picture: the keeper takes the next one
 * when the window asks for a picture, and until then the program's pipe is full and it waits.
 * While the window asks for none the program is stopped (SIGSTOP). */
#ifndef LUTETIA_DEMONSTRATION_KEEPER_H
#define LUTETIA_DEMONSTRATION_KEEPER_H

#include <demonstration_wire.h>
#include <display_recording.h>
#include <front_panel.h>
#include <light_recording.h>

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

/* ---- lines.c ---- */

enum { LINES_KEPT = 8, LINE_BYTES = 200 };

struct lines {
    char kept[LINES_KEPT]
             [LINE_BYTES + 1]; /* the last one is number `count` - 1, mod LINES_KEPT */
    long count;                /* of all lines */
    char now[LINE_BYTES + 1];  /* the one that has no end yet; what is too long is cut off */
    int now_bytes;
};
void lines_add(struct lines *l, const char *bytes, size_t count);
void lines_end(struct lines *l); /* what has no end, has */

/* ---- build.c ---- */

struct build {
    char folder[PATH_MAX];
    pid_t process;        /* the compiler's, the program's; 0: none */
    int printed;          /* what it prints comes here; -1 */
    int lights, displays; /* of a program; -1 */
};
/* Each is false where it was not possible; `why` says why. */
bool build_folder(struct build *b, const char *text, size_t bytes, char *why, size_t room);
bool build_compile(struct build *b, unsigned seconds, char *why, size_t room);
bool build_run(struct build *b, int memory_mb, char *why, size_t room);
/* Ends what runs, with all that it has started; its status. */
int build_end(struct build *b, bool kill_it);
void build_remove(struct build *b);

/* ---- seen.c ---- */

struct seen {
    int width_px, height_px;
    uint8_t *rgb; /* the picture */
    bool drawn;   /* it is as what follows says */
    struct front_panel *panel;
    struct light_reader lights;
    struct light_frame last;
    struct display_reader displays;
    int display; /* the one that is shown; 0: the lights */
    bool taken;  /* something to see has come since */
    uint8_t bytes[1 << 14];
    size_t held, at; /* of bytes: not fed yet */
};
bool seen_make(struct seen *s, int width_px, int height_px);
/* Takes from pipes what can be seen next. False: it is damaged; `why` says how. */
bool seen_take(struct seen *s, int lights, int displays, bool *came, const char **why);
/* The picture of that. False: no memory. */
bool seen_draw(struct seen *s);

#endif
