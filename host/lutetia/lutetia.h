/* lutetia.h - the command: one file a verb, a row each in main.c; what they share is declared here.
 *
 * Exit status: 0; 1 where something failed; 2 where the command line is wrong; 130 where it was interrupted.
 * Every failure is one line on the standard error: what was wrong, with what, and what to do. */
#ifndef LUTETIA_LUTETIA_H
#define LUTETIA_LUTETIA_H

#include <paper.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* argv[0] is the verb. */
int verb_paint(int argc, char **argv);
int verb_demo(int argc, char **argv);
int verb_info(int argc, char **argv);
int verb_bench(int argc, char **argv);
int verb_keys(int argc, char **argv);
int verb_midi(int argc, char **argv);
int verb_cc(int argc, char **argv);
int verb_leds(int argc, char **argv);
int verb_explain(int argc, char **argv);
int verb_tune(int argc, char **argv);
int verb_type(int argc, char **argv);
int verb_set(int argc, char **argv);
int verb_font(int argc, char **argv);
int verb_run(int argc, char **argv);
int verb_spring(int argc, char **argv);
int verb_voice(int argc, char **argv);

/* ---- failures ---- */

/* Prints `lutetia VERB: message` and returns EXIT_FAILED. */
int fail(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Prints the same and nothing has failed: what one should know. */
void tell(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The one place where lines go to the standard error; what comes from outside does nothing to a terminal there. */
void tell_line(const char *text);
/* At a verb's end: the status, and what was interrupted says so, once. */
int interrupt_report(const char *verb, int status, const char *untouched);
/* Says paper_error(), but not after Ctrl-C: what fails then fails because of it. */
int fail_paper(const char *verb);
int fail_usage(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* ---- Ctrl-C ---- */

/* From here on SIGINT and SIGTERM only raise a flag; a second one ends the program at once. */
void interrupt_catch(void);
bool interrupted(void);

/* ---- progress ---- */

/* A line on the standard error that is drawn over itself, with steps per second; nothing where it is no terminal. */
struct progress {
    const char *what;
    int total;
    bool shown;
    double began_s, drawn_s;
};
struct progress progress_begin(const char *what, int total);
void progress_show(struct progress *p, int done);
void progress_end(struct progress *p); /* clears the line */

/* "12 s left", "about 3 min left" */
void time_left_text(char *text, size_t room, double seconds);

double clock_s(void); /* seconds since some moment */

/* ---- the machine and the sheet ---- */

/* Makes the machine and sees that a sheet of that size fits its memory: EXIT_SUCCESS, or says why not. */
int machine_prepare(const char *verb, int width, int height);

/* How many steps are asked of the machine before it is waited for: what Ctrl-C and the progress line wait at most.
 * Always the same, so that the machine meets the same work again; few, so that it is soon compiled. */
enum { STEPS_AT_ONCE = 2 };

/* Reads the sheet and writes it as PNG. EXIT_SUCCESS, or says why not. */
int sheet_write(const char *verb, struct paper *sheet, enum paper_view view, const char *path);

/* Makes a folder if there is none. EXIT_SUCCESS, or says why not. */
int folder_make(const char *verb, const char *path);

#endif
