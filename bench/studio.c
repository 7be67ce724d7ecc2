/* studio.c - `lutetia bench studio`: what a hand waits for.
 *
 * The window itself is played recorded input (docs/studio.md), and measures: the empty window,
 * the window while the paper is as busy as it can be, from a pointer's report to the picture
 * that shows its paint, a quick stroke, undo. This is the program as its users run it: kernels
 * are compiled beside it when they pay. Without a display (`xvfb-run ./run bench studio` has
 * one) or GTK the window's rows are missing.
 *
 * Then the paper alone: studio_paper.h. */
#include "studio_paper.h"

#include "bench.h"
#include "output_file.h"
#include "paris_internal.h"
#include "program.h"
#include "user_folder.h"

#include <visible_text.h>

#include <errno.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SIDE = 1024, WET = 300, SIDE_QUICK = 128, PLACE_BYTES = 600 };
#define REPORTS_S 0.005 /* between two reports of a pen */

extern char **environ;

/* ---- what is played ---- */

/* Strokes back and forth over what is wet, so many fibers a second, from `at` on; when they
 * have ended. */
static double strokes_play(FILE *out, double at_s, double seconds, double fibers_per_s)
{
    const double half = WET / 2.0 - 20, stroke_s = 1.2, gap_s = 0.15, end_s = at_s + seconds;
    for (int row = 0; at_s < end_s; row++, at_s += stroke_s + gap_s) {
        const double y = -half + 2 * half * (row % 8) / 7;
        for (double t = 0; t <= stroke_s; t += REPORTS_S) {
            double along = fibers_per_s * t;
            const int turns = (int)(along / (2 * half));
            along -= turns * 2 * half;
            const double x = turns % 2 ? half - along : along - half;
            const char *word = t == 0 ? "down" : t + REPORTS_S > stroke_s ? "up" : "move";
            fprintf(out, "%.4f %s %.2f %.2f 0.6\n", at_s + t, word, x, y + 3 * turns);
        }
    }
    return at_s;
}

static double undos_play(FILE *out, double at_s, int count)
{
    for (int i = 0; i < count; i++) {
        fprintf(out, "%.4f measure none\n", at_s);
        at_s = strokes_play(out, at_s, 1, 250) + 1;
        fprintf(out, "%.4f measure undo-%d\n%.4f undo\n", at_s, i, at_s);
        at_s += 1.5;
    }
    return at_s;
}

enum { UNDOS = 7 };

static bool input_write(const char *path)
{
    struct output_file file;
    const double seconds = bench_many(8, 1);
    if (!output_file_open(&file, path))
        return bench_fail("%s: cannot write: %s", path, file.why);
    FILE *out = file.stream;
    const int side = bench_many(SIDE, SIDE_QUICK), wet = bench_many(WET, SIDE_QUICK / 2) / 2;
    double t = 1;
    fprintf(out, "0 set paused on\n0 view 1 %d %d 0 0\n0 set pigment_2 0.3\n", side / 2,
            side / 2);
    fprintf(out, "%.4f measure empty\n", t);
    t += seconds / 2;
    fprintf(out, "%.4f measure none\n%.4f set drying 0\n%.4f set tool wash\n", t, t, t);
    fprintf(out, "%.4f down %d %d 0.5\n%.4f up %d %d 0.5\n", t, -wet, -wet, t + 0.1, wet, wet);
    fprintf(out, "%.4f set tool brush\n%.4f set paused off\n", t + 0.2, t + 0.2);
    t = strokes_play(out, t + 1, seconds, 600); /* its kernels are made */
    fprintf(out, "%.4f measure none\n%.4f set pace 400\n", t, t);
    fprintf(out, "%.4f measure busy\n", t + 0.5);
    t += 0.5 + seconds / 2;
    fprintf(out, "%.4f measure none\n%.4f set pace 60\n%.4f measure hand\n", t, t, t + 0.5);
    t = strokes_play(out, t + 0.5, seconds, 600) + 0.5;
    fprintf(out, "%.4f measure quick\n", t);
    t = strokes_play(out, t, seconds, 3000) + 0.5;
    fprintf(out, "%.4f measure none\n%.4f set paused on\n", t, t);
    t = undos_play(out, t, bench_many(UNDOS, 1));
    fprintf(out, "%.4f measure none\n%.4f close\n", t, t + 0.2);
    return output_file_commit(&file) || bench_fail("%s: cannot write: %s", path, file.why);
}

/* ---- what it says ---- */

struct measured {
    char name[32];
    double seconds, processor_s, median_s, p99_s, longest_s;
    unsigned pictures, shown;
    long steps;
};

static void row(struct bench_report *r, const char *what, const char *of_case, double value,
                const char *unit)
{
    bench_report_add(r, what, of_case, (struct bench_sample){value, value}, 1, unit);
}

static void measured_add(struct bench_report *r, const struct measured *m, double *undo_s,
                         int *undos)
{
    const bool empty = strcmp(m->name, "empty") == 0, busy = strcmp(m->name, "busy") == 0;
    const bool quick = strcmp(m->name, "quick") == 0;
    if (strncmp(m->name, "undo-", 5) == 0) {
        if (m->shown > 0 && *undos < UNDOS)
            undo_s[(*undos)++] = 1e3 * m->longest_s;
        return;
    }
    const char *of_case = empty   ? "window, empty"
                          : busy  ? "window, paper busy"
                          : quick ? "window, 3000 fibers/s"
                                  : "window, 600 fibers/s";
    row(r, "pictures", of_case, m->pictures / m->seconds, "1/s");
    row(r, "processors, a picture", of_case, 1e3 * m->processor_s / fmax(1, m->pictures), "ms");
    if (!empty)
        row(r, "steps", of_case, (double)m->steps / m->seconds, "steps/s");
    if (empty || busy)
        return;
    row(r, "pointer to paint, median", of_case, 1e3 * m->median_s, "ms");
    row(r, "pointer to paint, p99", of_case, 1e3 * m->p99_s, "ms");
    row(r, "pointer to paint, longest", of_case, 1e3 * m->longest_s, "ms");
}

static bool measured_read(struct bench_report *r, FILE *in)
{
    char line[400];
    double undo_ms[UNDOS];
    int undos = 0, lines = 0;
    while (fgets(line, sizeof line, in)) {
        struct measured m;
        if (sscanf(line, "measured %31s %lf %u %lf %u %lf %lf %lf %ld", m.name, &m.seconds,
                   &m.pictures, &m.processor_s, &m.shown, &m.median_s, &m.p99_s, &m.longest_s,
                   &m.steps) != 9)
            continue;
        lines++;
        measured_add(r, &m, undo_ms, &undos);
    }
    if (undos > 0)
        bench_report_add(r, "undo of a stroke", "window", bench_sample_of(undo_ms, undos), 1,
                         "ms");
    return lines > 0 || bench_fail("the studio's window measured nothing");
}

/* ---- the window ---- */

static bool window_run(struct bench_report *r, const char *program, const char *input)
{
    char play[PLACE_BYTES + 64], name[] = "lutetia-studio", fresh[] = "fresh=1";
    char width[32], height[32], stock[] = "stock=cold press";
    char pigment_1[] = "pigment=french ultramarine", pigment_2[] = "pigment=quinacridone rose",
         pigment_3[] = "pigment=hansa yellow";
    char *words[] = {name,      fresh,     width,     height, stock,
                     pigment_1, pigment_2, pigment_3, play,   NULL};
    int ends[2], status = -1;
    pid_t child;
    posix_spawn_file_actions_t actions;
    snprintf(play, sizeof play, "play=%s", input);
    snprintf(width, sizeof width, "width=%d", bench_many(SIDE, SIDE_QUICK));
    snprintf(height, sizeof height, "height=%d", bench_many(SIDE, SIDE_QUICK));
    if (pipe(ends) != 0)
        return bench_fail("no pipe: %s", strerror(errno));
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    const int error = posix_spawn(&child, program, &actions, NULL, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    FILE *in = fdopen(ends[0], "r");
    bool ok = !error && in;
    ok = ok ? measured_read(r, in)
            : bench_fail("%s cannot be run: %s", program, strerror(error));
    if (in)
        fclose(in);
    else
        close(ends[0]);
    while (!error && waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    return ok && ((WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
                  bench_fail("the studio's window did not end well"));
}

/* True also where there can be no window; that is told. */
static bool window_measure(struct bench_report *r)
{
    char program[PATH_MAX], folder[PLACE_BYTES - 64], input[PLACE_BYTES];
    const char *x = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    if (!program_find(program, (program_code *)bench_studio_main,
                      LUTETIA_LIBEXECDIR "/lutetia/lutetia-studio", "desk/lutetia-studio")) {
        visible_say("lutetia bench studio: this lutetia was built without GTK 4; the window's "
                    "rows are missing");
        return true;
    }
    if (!(x && *x) && !(wayland && *wayland)) {
        visible_say("lutetia bench studio: no display; the window's rows are missing (with "
                    "xvfb-run before the command there is one)");
        return true;
    }
    if (!user_folder_temporary("studio", folder, sizeof folder))
        return bench_fail("%s: no folder can be made", folder);
    snprintf(input, sizeof input, "%s/hand.events", folder);
    visible_say("studio: the window ...");
    const bool ok = input_write(input) && window_run(r, program, input);
    unlink(input);
    rmdir(folder);
    return ok;
}

int bench_studio_main(int argc, char **argv)
{
    static struct bench_report report;
    static char device[256];
    struct bench_options options = {.name = "studio", .repeat_least = 3, .repeat_count = 11};
    const int status = bench_options_parse(&options, argc, argv);
    if (status >= 0)
        return status;
    if (bench_quick) /* what is only tried compiles no kernels that do not pay */
        setenv("LUTETIA_INTERPRET", "1", 1);
    bench_report_init(&report, "studio", bench_threads_count(), device);
    const bool ok = window_measure(&report) && studio_paper_measure(&report, &options);
    snprintf(device, sizeof device, "%s", machine_device_name(paris_machine()));
    return bench_options_finish(&options, &report, "512x512, 300x300 wet", ok);
}
