/* paper.c - `lutetia bench paper`: steps of a sheet with six pigments and all parts, and of the
 * thesis's model, as programs in C/Paris, beside the same rules in C with OpenMP. They first
 * take the same steps, and must agree in every bit. */
#include <stdlib.h>
#include <string.h>
#include <visible_text.h>

#include "bench.h"
#include "copy.h"
#include "of_machine.h"
#include "paper_scene.h"
#include "paper_wet.h"
#include "paris_internal.h"

enum {
    PIGMENTS = 6,
    STEPS_AGREED = 5,
    STEPS_SMALL = 8, /* of a turn */
    STEPS_LARGE = 4,
    FIBERS_SMALL = 2000000,
    FRAMES = 8,
    WORD_LEAST = 512 * 512,
    WORD_MOST = 4096,
    COPY_BYTES = 256 << 20,
    /* Arrays that a step must at least access: each amount is read and written, also the
     * dried water and the wet area; the paper is read. */
    ARRAYS_CHANGED = 2 + 3 * PIGMENTS + 2,
    ARRAYS_READ = 5,
    FLOW_CHANGED = 3, /* where water flows: the wet part, speeds; read: sizing, ease, swirl */
    FLOW_READ = 4,
    THESIS_CHANGED = 4,
    THESIS_READ = 1
};

struct turn {
    struct paper_scene *scene;
    int steps_count;
    bool each; /* looked at after each step */
    uint16_t *rgb;
};

static bool paper_said(enum paper_status status)
{
    return status == PAPER_OK || bench_fail("the paper: %s", paper_error());
}

static bool sheet_steps(const struct turn *t, int steps_count)
{
    bool ok = true;
    for (int i = 1; ok && i <= steps_count; i++)
        ok =
            paper_said(paper_sheet_step(t->scene->sheet)) &&
            (!(t->each || i == steps_count) || paper_said(paper_sheet_finish(t->scene->sheet)));
    return ok;
}

static bool sheet_ready(void *context)
{
    return sheet_steps(context, 1);
}

static bool sheet_work(void *context)
{
    const struct turn *t = context;
    return sheet_steps(t, t->steps_count);
}

static void openmp_steps(const struct paper_scene *s, int steps_count)
{
    if (s->thesis)
        diffusion_openmp_steps(s->thesis, steps_count);
    else
        paper_openmp_steps(s->peer, steps_count);
}

static bool openmp_ready(void *context)
{
    const struct turn *t = context;
    openmp_steps(t->scene, 1);
    return true;
}

static bool openmp_work(void *context)
{
    const struct turn *t = context;
    openmp_steps(t->scene, t->steps_count);
    return true;
}

/* A step, its picture, and that read. */
static bool shown_work(void *context)
{
    const struct turn *t = context;
    const struct paper_sheet_view view = {.show = PAPER_SHOW_COLOR};
    bool ok = true;
    for (int i = 0; ok && i < t->steps_count; i++)
        ok = paper_said(paper_sheet_step(t->scene->sheet)) &&
             paper_said(paper_sheet_view(t->scene->sheet, &view, t->rgb));
    return ok;
}

/* Adds a row with the number of runs in a second. */
static void rate_add(struct bench_report *r, const char *what, const char *of_case,
                     struct bench_sample seconds, int count, const char *unit)
{
    struct bench_sample rate = {count / seconds.median, count / seconds.min};
    bench_report_add(r, what, of_case, rate, 1, unit);
}

static bool size_measure(struct bench_report *r, const struct bench_options *o, bool thesis,
                         int width, int height, struct bench_copy *copy)
{
    double fibers = (double)width * (double)height;
    int steps_count = fibers < FIBERS_SMALL ? STEPS_SMALL : STEPS_LARGE;
    char of_case[32];
    struct paper_scene scene;
    struct machine_config config = machine_config_default();
    snprintf(of_case, sizeof of_case, "%s%dx%d", thesis ? "thesis " : "", width, height);
    visible_say("paper: %s ...", of_case);
    bool ok = paris_reset(&config) || bench_fail("%s", paris_error());
    if (!ok)
        return false;
    ok = thesis ? paper_scene_init_thesis(&scene, width, height)
                : paper_scene_init(&scene, width, height, PIGMENTS, false, NULL);
    struct turn run = {&scene, steps_count, false, NULL},
                each = {&scene, steps_count, true, NULL}, shown = {&scene, FRAMES, true, NULL};
    if (ok && thesis) {
        shown.rgb = malloc((size_t)(3 * fibers) * sizeof *shown.rgb);
        ok = shown.rgb != NULL || bench_fail("no memory for a picture");
    }
    if (ok)
        openmp_steps(&scene, STEPS_AGREED);
    ok = ok && sheet_steps(&run, STEPS_AGREED) && paper_scene_agrees(&scene, of_case);
    struct bench_contender contenders[] = {
        {.what = "sheet", .ready = sheet_ready, .work = sheet_work, .context = &run},
        {.what = "sheet, each looked at",
         .ready = sheet_ready,
         .work = sheet_work,
         .context = &each},
        {.what = "openmp", .ready = openmp_ready, .work = openmp_work, .context = &run},
        {.what = "copy bandwidth", .work = bench_copy_work, .context = copy},
        {.what = "sheet, shown", .work = shown_work, .context = &shown},
    };
    const int of_copy = 3, of_shown = 4, count = thesis ? 5 : 4;
    const int pigments = thesis ? 3 : PIGMENTS;
    ok = ok && bench_measure_in_turns(contenders, count, o->repeat_count);
    for (int i = 0; ok && i < of_copy; i++)
        rate_add(r, contenders[i].what, of_case, contenders[i].seconds, steps_count, "steps/s");
    for (int i = 0; ok && i < of_copy; i++)
        bench_report_add(r, contenders[i].what, of_case, contenders[i].seconds,
                         1e9 / fibers / steps_count / pigments, "ns/fiber-pigment");
    if (ok && thesis)
        rate_add(r, "sheet, shown", of_case, contenders[of_shown].seconds, FRAMES, "frames/s");
    if (ok) {
        struct bench_sample rate = bench_copy_rate(copy, contenders[of_copy].seconds);
        double bytes = sizeof(float) *
                       (thesis ? 2 * THESIS_CHANGED + THESIS_READ
                               : 2 * (ARRAYS_CHANGED + FLOW_CHANGED) + ARRAYS_READ + FLOW_READ);
        bench_report_add(r, "traffic bound", of_case, rate, 1e9 / bytes / fibers, "steps/s");
        bench_report_add(r, "copy bandwidth", of_case, rate, 1, "GB/s");
    }
    free(shown.rgb);
    paper_scene_finish(&scene);
    return ok;
}

int bench_paper_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {
        .name = "paper",
        .sizes = {{512, 512}, {1024, 1024}, {2048, 2048}},
        .sizes_count = 3,
        .size_least = 16,
        .size_most = 4096,
        .repeat_least = 5,
        .repeat_count = 11,
        .thorough_does =
            "a word on 4096x4096, a poster's time, and the memory of a large sheet, too"};
    int status = bench_machine_start(&report, &options, true, argc, argv);
    if (status >= 0)
        return status;
    struct bench_copy *copy = bench_copy_create(COPY_BYTES);
    bool ok = copy != NULL;
    for (int i = 0; ok && i < options.sizes_count; i++)
        ok = size_measure(&report, &options, false, options.sizes[i][0], options.sizes[i][1],
                          copy);
    ok = ok && size_measure(&report, &options, true, bench_many(1024, 64), bench_many(1024, 64),
                            copy);
    for (int i = 0; ok && i < options.sizes_count; i++)
        ok = options.sizes[i][0] * options.sizes[i][1] < WORD_LEAST ||
             paper_word_measure(&report, &options, options.sizes[i][0], options.sizes[i][1],
                                true);
    bench_copy_destroy(copy);
    if (ok && options.thorough)
        ok = paper_word_measure(&report, &options, WORD_MOST, WORD_MOST, false) &&
             paper_poster_measure(&report) && paper_memory_measure(&report);
    return bench_options_finish(&options, &report, "openmp", ok);
}
