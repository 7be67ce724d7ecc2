/* lutetia.h - the command: each verb has a file and a row in main.c; shared functions are
 * declared here.
 *
 * Exit status: 0; 1 where something failed; 2 where the command line is wrong; 130 where it
 * was interrupted. Every failure is one line on the standard error: what was wrong, with
 * what, and what to do.
 */
#ifndef LUTETIA_LUTETIA_H
#define LUTETIA_LUTETIA_H

#include <paper.h>

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* argv[0] is the verb. */
int verb_paint(int argc, char **argv);
int verb_demo(int argc, char **argv);
int verb_stage(int argc, char **argv);
int verb_info(int argc, char **argv);
int verb_bench(int argc, char **argv);
int verb_keys(int argc, char **argv);
int verb_midi(int argc, char **argv);
int verb_cc(int argc, char **argv);
int verb_leds(int argc, char **argv);
int verb_display(int argc, char **argv);
int verb_explain(int argc, char **argv);
int verb_debug(int argc, char **argv);
int verb_tune(int argc, char **argv);
int verb_type(int argc, char **argv);
int verb_set(int argc, char **argv);
int verb_read(int argc, char **argv);
int verb_font(int argc, char **argv);
int verb_run(int argc, char **argv);
int verb_spring(int argc, char **argv);
/* The same, whose films last so long where nothing else says how long. */
int verb_spring_lasting(int argc, char **argv, double seconds);
int verb_voice(int argc, char **argv);
int verb_studio(int argc, char **argv);

/* ---- failures ---- */

/* Prints `lutetia VERB: message` and returns EXIT_FAILED. */
int fail(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Prints a line of the same form that reports no failure. */
void tell(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Prints a line on the standard error, with control characters made visible. All lines go
 * through this function. */
void tell_line(const char *text);
/* Called at a verb's end. Returns the status; after an interruption, prints one line that
 * says so. */
int interrupt_report(const char *verb, int status, const char *untouched);
/* Prints paper_error() and returns EXIT_FAILED; after Ctrl-C, which makes calls fail, prints
 * nothing. */
int fail_paper(const char *verb);
int fail_usage(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* ---- what comes with the command ---- */

/* Where a file or folder that comes with the command is: built, from the command's folder in
 * the build, or installed, in Lutetia's folder of data. False: in neither. */
bool data_find(char path[PATH_MAX], const char *built, const char *installed);

/* ---- Ctrl-C ---- */

/* From now on SIGINT, SIGTERM and, unless it is ignored, SIGHUP only set a flag; a second one
 * ends the program at once. */
void interrupt_catch(void);
bool interrupted(void);
/* It was meant for what has ended by it: the next one counts as the first. */
void interrupt_forget(void);

/* ---- progress ---- */

/* A line on the standard error that is overwritten with the progress and steps per second;
 * nothing if it is no terminal. */
struct progress {
    const char *what;
    int total;
    bool shown;
    double began_s, drawn_s;
    struct {
        double s;
        int done;
    } mark[2]; /* progress_left(): where the pace was looked at */
};
struct progress progress_begin(const char *what, int total);
void progress_show(struct progress *p, int done);
void progress_end(struct progress *p); /* clears the line */
/* Seconds that are left, by the pace of late: the first steps wait for kernels and say nothing
 * about the rest. Negative: nobody can tell yet. `now` is that of seconds_now(). */
double progress_left(struct progress *p, int done, double now);

/* "12 s left", "about 3 min left" */
void time_left_text(char *text, size_t room, double seconds);

double seconds_now(void); /* seconds of a monotonic clock */

/* ---- the machine and the sheet ---- */

/* Creates the machine, and checks that a sheet of that size, which takes so many bytes, fits
 * its memory. EXIT_SUCCESS, or prints why not. */
int machine_prepare(const char *verb, int width, int height, double bytes);
/* Those of a sheet of paper.h. */
double page_bytes(int width, int height);

/* Steps that are submitted before waiting for the machine: the longest that Ctrl-C and the
 * progress line wait. The number is constant, so that the machine can reuse its plan, and
 * small, so that the plan compiles soon. */
enum { STEPS_AT_ONCE = 2 };

/* Writes a picture that was made, unless there was an interruption or making it ended with a
 * status, and destroys it. Returns the status. */
struct display_image;
int picture_finish(const char *verb, int status, const char *path, struct display_image *image);
/* Reads the sheet and writes it as PNG. EXIT_SUCCESS, or prints why not. */
int sheet_write(const char *verb, struct paper *sheet, enum paper_view view, const char *path);

/* Makes a folder if there is none. EXIT_SUCCESS, or prints why not. */
int folder_make(const char *verb, const char *path);

/* Looks whether a file can be written, before what it takes long to make is made; NULL: none is
 * wanted. A file that is there stays as it is. EXIT_SUCCESS, or prints why not. */
int output_check(const char *verb, const char *path);

#endif
