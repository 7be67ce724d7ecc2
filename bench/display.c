/* display.c - `lutetia bench display`: what 60 pictures a second on the frame buffer take from
 * a program that computes.
 *
 * The program is the thesis's diffusion on 1024x512 fibers. Turns of a fifteenth of a second
 * alternate, since what else the computer does changes within seconds. In the first the program
 * computes its steps alone; in the second it also computes and looks at a picture each 1/60 s;
 * in the third it shows that picture. Turns are compared with those just before, so that other
 * load affects all alike; TURNS_EACH of each are one counted run. The pictures go where
 * LUTETIA_DISPLAY says; if it says nothing, to /dev/null, which leaves the program's own part.
 * The rows say which it was:
 *
 *     lutetia bench display                              "no window"
 *     LUTETIA_DISPLAY=window lutetia bench display       "window"
 *     lutetia display --close lutetia bench display      "lutetia display"
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cm/cmfb.h>

#include "bench.h"
#include "listing.h"
#include "machine_rows.h"
#include "of_machine.h"
#include "paris_internal.h"

enum { WIDTH = 1024, HEIGHT = 512, PICTURES_PER_S = 60, UNSEEN = 100000, TURNS_EACH = 10 };

struct shown_program {
    struct listing listing;
    unsigned int bits;
    CM_field_id_t scaled, channels[3];
    CMFB_display_id_t display;
};

/* What a turn took. */
struct turn {
    double wall_s, processor_s;
    int steps, pictures;
};

static void step(const void *listing)
{
    listing_step(listing);
}

static void picture_compute(const struct shown_program *p)
{
    for (int i = 0; i < (p->bits == 8 ? 1 : 3); i++) {
        CM_f_multiply_constant_3_1L(p->scaled, p->listing.pigment[i], 255.0, 23, 8);
        CM_u_f_truncate_2_2L(p->channels[i], p->scaled, 8, 23, 8);
    }
}

/* Where nobody looks, the machine leaves a picture uncomputed. Errors: false. */
static bool picture_look(const struct shown_program *p)
{
    struct machine_rows rows[3];
    return bench_machine_said(machine_fields_look(paris_machine(), p->channels,
                                                  p->bits == 8 ? 1 : 3, MACHINE_UINT(8), rows));
}

static void picture_show(const struct shown_program *p)
{
    if (p->bits == 8)
        CMFB_write_news_always(p->display, 0, p->channels[0], 0, 0);
    else
        CMFB_write_rgb_news_always(p->display, 0, p->channels[0], p->channels[1],
                                   p->channels[2], 0, 0);
}

enum turn_kind { ALONE, COMPUTED, SHOWN, TURN_KINDS };

/* A turn of so many seconds. Errors: false. */
static bool turn_take(const struct shown_program *p, double seconds, enum turn_kind kind,
                      struct turn *t)
{
    const double began = bench_now_s(), processor = bench_process_s();
    double now = began, due = began + 0.5 / PICTURES_PER_S;
    *t = (struct turn){.steps = 0};
    do {
        if (!bench_machine_steps(step, &p->listing, 1, 1))
            return false;
        t->steps++;
        now = bench_now_s();
        if (kind != ALONE && now >= due) {
            picture_compute(p);
            if (kind == SHOWN)
                picture_show(p);
            else if (!picture_look(p))
                return false;
            if (!bench_machine_finished())
                return false;
            t->pictures++;
            due = due + 2.0 / PICTURES_PER_S < now ? now : due + 1.0 / PICTURES_PER_S;
        }
    } while (bench_now_s() < began + seconds);
    t->wall_s = bench_now_s() - began;
    t->processor_s = bench_process_s() - processor;
    return true;
}

/* One of each. Errors: false. */
static bool turns_take(const struct shown_program *p, double seconds, struct turn t[TURN_KINDS])
{
    bool ok = true;
    for (enum turn_kind kind = ALONE; ok && kind < TURN_KINDS; kind++)
        ok = turn_take(p, seconds, kind, &t[kind]);
    return ok;
}

static void program_begin(struct shown_program *p, unsigned int bits)
{
    *p = (struct shown_program){.listing = {.width = WIDTH,
                                            .height = HEIGHT,
                                            .gravity = 1.1,
                                            .molecular_weight = {0.9, 0.7, 0.5}},
                                .bits = bits};
    listing_allocate(&p->listing);
    CM_initialize_random_generator(7);
    CM_f_random_1L(p->listing.water, 23, 8);
    CM_f_random_1L(p->listing.absorbency, 23, 8);
    CM_f_multiply_constant_2_1L(p->listing.absorbency, 0.2, 23, 8);
    p->scaled = CM_allocate_heap_field(32);
    for (int i = 0; i < 3; i++) {
        CM_f_random_1L(p->listing.pigment[i], 23, 8);
        p->channels[i] = CM_allocate_heap_field(8);
    }
    p->display = CMFB_attach_display("bench display");
    CMFB_initialize_display(p->display, bits, WIDTH, HEIGHT);
}

/* A picture that nobody looks at. */
static void unseen_measure(struct bench_report *r, const char *of_case,
                           const struct shown_program *p)
{
    char *sink = strdup(getenv("LUTETIA_DISPLAY"));
    const int count = bench_many(UNSEEN, 100);
    unsetenv("LUTETIA_DISPLAY");
    const double began = bench_thread_s();
    for (int i = 0; i < count; i++)
        CMFB_write_news_always(p->display, 0, p->channels[0], 0, 0);
    bench_report_add(r, "showing, nobody looks", of_case,
                     (struct bench_sample){bench_thread_s() - began, bench_thread_s() - began},
                     1e9 / count, "ns");
    setenv("LUTETIA_DISPLAY", sink, 1);
    free(sink);
}

/* The processor time of a picture, beside that of the steps. */
static double picture_s(const struct turn *with, const struct turn *alone)
{
    const double step_s = alone->processor_s / alone->steps;
    return (with->processor_s - step_s * with->steps) / with->pictures;
}

enum { STEP, COMPUTE, SHOW, SHARE, SLOWER, PICTURES, MEASURED };

static void turns_judge(const struct turn t[TURN_KINDS], double out[MEASURED])
{
    const double compute_s = picture_s(&t[COMPUTED], &t[ALONE]),
                 show_s = picture_s(&t[SHOWN], &t[ALONE]) - compute_s,
                 slow =
                     t[SHOWN].wall_s / t[SHOWN].steps * t[COMPUTED].steps / t[COMPUTED].wall_s;
    out[STEP] = 1e3 * t[ALONE].wall_s / t[ALONE].steps;
    out[COMPUTE] = 1e3 * compute_s;
    out[SHOW] = 1e3 * show_s;
    out[SHARE] = 100 * PICTURES_PER_S * show_s;
    out[SLOWER] = 100 * (slow - 1);
    out[PICTURES] = t[SHOWN].pictures / t[SHOWN].wall_s;
}

/* Where the pictures go. */
static const char *sink_name(void)
{
    const char *sink = getenv("LUTETIA_DISPLAY");
    return strcmp(sink, "/dev/null") == 0      ? "no window"
           : strcmp(sink, "window") == 0       ? "window"
           : strncmp(sink, "/dev/fd/", 8) == 0 ? "lutetia display"
                                               : "to a file";
}

static bool bits_measure(struct bench_report *r, unsigned int bits, int repeat_count)
{
    static const struct {
        const char *what, *unit;
    } rows[MEASURED] = {{"a step alone, wall", "ms"},
                        {"computing a picture", "ms"},
                        {"showing it", "ms"},
                        {"60 shown, of a processor", "%"},
                        {"slower by showing, wall", "%"},
                        {"pictures", "1/s"}};
    const double seconds = bench_quick ? 0.02 : 1.0 / 15;
    repeat_count *= bench_quick ? 1 : TURNS_EACH;
    struct shown_program p;
    struct turn turns[TURN_KINDS];
    char of_case[48];
    double *values[MEASURED], one[MEASURED];
    bool ok = true;
    snprintf(of_case, sizeof of_case, "%dx%d, %u bits, %s", WIDTH, HEIGHT, bits, sink_name());
    program_begin(&p, bits);
    for (int i = 0; i < MEASURED; i++) {
        values[i] = calloc((size_t)repeat_count, sizeof **values);
        ok = ok && (values[i] || bench_fail("no memory for %d times", repeat_count));
    }
    ok = ok && turns_take(&p, 30 * seconds, turns); /* to warm up */
    for (int k = 0; ok && k < repeat_count; k++) {
        ok = turns_take(&p, seconds, turns);
        if (ok)
            turns_judge(turns, one);
        for (int i = 0; ok && i < MEASURED; i++)
            values[i][k] = one[i];
    }
    for (int i = 0; ok && i < MEASURED; i++)
        bench_report_add(r, rows[i].what, of_case, bench_sample_of(values[i], repeat_count), 1,
                         rows[i].unit);
    for (int i = 0; i < MEASURED; i++)
        free(values[i]);
    if (ok && bits == 8)
        unseen_measure(r, of_case, &p);
    CMFB_detach_display(p.display);
    return ok;
}

int bench_display_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "display", .repeat_least = 3, .repeat_count = 15};
    const char *sink = getenv("LUTETIA_DISPLAY");
    if (!sink || !*sink)
        setenv("LUTETIA_DISPLAY", "/dev/null", 1);
    const int status = bench_machine_start(&report, &options, true, argc, argv);
    if (status >= 0)
        return status;
    const bool ok = bits_measure(&report, 8, options.repeat_count) &&
                    bits_measure(&report, 24, options.repeat_count);
    return bench_options_finish(&options, &report, "computing a picture", ok);
}
