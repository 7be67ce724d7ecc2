/* diffusion.c - `lutetia bench diffusion`: the thesis's step through the machine, beside
 * hand-written code that gives the same bits, peers, and the memory's limit.
 *
 * For each size all contenders first take the same few steps, and must agree in every bit
 * (the relaxed ones nearly). Then they are timed in turn. The slow contenders, the listing
 * in eager mode and numpy, come last and less often; eager mode has a machine of its own. */
#include "bench.h"
#include <visible_text.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "bare_launch.h"
#include "copy.h"
#include "harness.h"
#include "listing.h"
#include "of_machine.h"
#include "opencl.h"
#include "paris_internal.h"
#include "peer.h"
#include "peers.h"
#include "rolling.h"
#include "scene.h"

enum {
    REPEAT_SLOW = 3,
    STEPS_AGREED = 4,      /* all */
    STEPS_UNOBSERVED = 16, /* steps of the listing without a look, then compared again */
    STEPS_SETTLED =
        128, /* steps of the listing until the machine has adapted to so many looks */
    FRONT_END_SIDE = 256,
    FRONT_END_STEPS = 200,
    SMALL_SIDE = 128,
    SMALL_STEPS = 100, /* between two looks at it */
    SMALL_LOOKS_SETTLED = 24,
    SMALL_REPEATS = 5, /* times as many runs: each takes milliseconds */
    COPY_BYTES = 256 << 20
};
static const double FIBERS_SMALL = 4e6; /* mostly in the last-level cache */
/* On larger sheets Halide, numpy and the relaxed kernels are left out: they would take most
 * of the time and, with --thorough, the memory. */
static const double FIBERS_PEERS = 8e6, FIBERS_PEERS_THOROUGH = 32e6;

/* Bytes for each fiber and axis: water and pigments both ways, absorbency one way. */
static const double COMPULSORY_BYTES = 2 * (2 * DIFFUSION_FIELDS_COUNT + 1) * sizeof(float);

static const char FIBER_STEP[] = "ns/fiber-step";

/* ---- the contenders ---- */

struct sheet {
    struct diffusion_scene scene;
    struct listing listing;
    struct diffusion_hand *hand; /* NULL, as rolling: not for this device */
    struct diffusion_openmp *openmp;
    struct diffusion_openmp_rolling *openmp_rolling;
    struct diffusion_rolling *rolling[4];             /* by kind */
    struct bench_peer *halide, *halide_tiled, *numpy; /* NULL: not here */
};

/* A contender: takes steps, and reads the fields. `which` selects a variant of a family. */
struct runner {
    const char *what;
    bool (*steps)(struct sheet *s, int which, int steps_count);
    bool (*read)(struct sheet *s, int which, int field, float *out);
    int which;
    int steps_count; /* in a counted run */
    bool relaxed;
    struct sheet *sheet;
};

static void listing_take(const void *listing)
{
    listing_step(listing);
}

/* which: steps between two looks. */
static bool listing_steps(struct sheet *s, int which, int steps_count)
{
    return bench_machine_steps(listing_take, &s->listing, steps_count, which);
}

static bool hand_steps(struct sheet *s, int which, int steps_count)
{
    (void)which;
    return diffusion_hand_steps(s->hand, steps_count);
}

static bool hand_read(struct sheet *s, int which, int field, float *out)
{
    (void)which;
    return diffusion_hand_read(s->hand, field, out);
}

static bool rolling_steps(struct sheet *s, int which, int steps_count)
{
    return diffusion_rolling_steps(s->rolling[which], steps_count);
}

static bool rolling_field(struct sheet *s, int which, int field, float *out)
{
    return diffusion_rolling_read(s->rolling[which], field, out);
}

static bool openmp_steps(struct sheet *s, int which, int steps_count)
{
    if (which)
        return diffusion_openmp_rolling_steps(s->openmp_rolling, steps_count);
    diffusion_openmp_steps(s->openmp, steps_count);
    return true;
}

static bool openmp_read(struct sheet *s, int which, int field, float *out)
{
    if (which)
        diffusion_openmp_rolling_read(s->openmp_rolling, field, out);
    else
        diffusion_openmp_read(s->openmp, field, out);
    return true;
}

static struct bench_peer *peer_of(const struct sheet *s, int which)
{
    return which == 0 ? s->numpy : which == 1 ? s->halide : s->halide_tiled;
}

static bool peer_steps(struct sheet *s, int which, int steps_count)
{
    return bench_peer_steps(peer_of(s, which), steps_count);
}

static bool peer_read(struct sheet *s, int which, int field, float *out)
{
    return bench_peer_read(peer_of(s, which), field, out);
}

/* Creates a new machine and puts the scene on it. */
static bool listing_start(struct sheet *s, bool eager)
{
    struct machine_config config = machine_config_default();
    config.eager = eager;
    if (!paris_reset(&config))
        return bench_fail("%s", paris_error());
    struct listing *l = &s->listing;
    *l = (struct listing){.width = s->scene.width,
                          .height = s->scene.height,
                          .gravity = (double)s->scene.gravity};
    for (int i = 0; i < 3; i++)
        l->molecular_weight[i] = (double)s->scene.molecular_weight[i];
    listing_allocate(l);
    struct machine *m = paris_machine();
    const CM_field_id_t fields[DIFFUSION_FIELDS_COUNT] = {l->water, l->pigment[0],
                                                          l->pigment[1], l->pigment[2]};
    bool ok = bench_machine_said(
        machine_field_upload(m, l->absorbency, MACHINE_F32, s->scene.absorbency));
    for (int i = 0; ok && i < DIFFUSION_FIELDS_COUNT; i++)
        ok = bench_machine_said(
            machine_field_upload(m, fields[i], MACHINE_F32, s->scene.field[i]));
    return ok;
}

static bool listing_read(struct sheet *s, int which, int field, float *out)
{
    (void)which;
    CM_field_id_t id = field == DIFFUSION_WATER ? s->listing.water
                                                : s->listing.pigment[field - DIFFUSION_PIGMENT];
    return bench_machine_said(machine_field_download(paris_machine(), id, MACHINE_F32, out));
}

/* A peer that is not installed has no rows. */
static bool peer_start(const struct sheet *s, struct bench_peer **peer, const char *what,
                       const char *package, const char *script, const char *argument)
{
    bool missing;
    *peer = bench_peer_start(&s->scene, script, argument, &missing);
    if (!*peer && missing)
        visible_say("diffusion: no %s here (%s), no such row", what, package);
    return *peer || missing;
}

static bool peers_start(struct sheet *s)
{
    bool ok = peer_start(s, &s->halide, "Halide", "python3-halide, python3-numpy",
                         kernel_halide_peer_py, "1") &&
              peer_start(s, &s->numpy, "numpy", "python3-numpy", kernel_numpy_peer_py, NULL);
    if (ok && s->halide)
        ok = peer_start(s, &s->halide_tiled, "Halide", "python3-halide", kernel_halide_peer_py,
                        "4");
    return ok;
}

/* A relaxed variant uses the tiling of the exact variant before it. */
static bool sheet_start(struct sheet *s, int width, int height, bool thorough)
{
    const bool all =
        (double)width * height <= (thorough ? FIBERS_PEERS_THOROUGH : FIBERS_PEERS);
    bool by_hand;
    if (!diffusion_scene_init(&s->scene, width, height) ||
        !(s->openmp = diffusion_openmp_create(&s->scene)) ||
        !(s->openmp_rolling = diffusion_openmp_rolling_create(&s->scene, NULL)) ||
        !bench_opencl_is_cpu(NULL, &by_hand) ||
        (by_hand && !(s->hand = diffusion_hand_create(&s->scene, NULL, DIFFUSION_SHAPE_BEST))))
        return false;
    if (!by_hand)
        visible_say("diffusion: the hand-written kernels are for CPUs' vectors, no such rows");
    for (int kind = 0; by_hand && kind < 4; kind++) {
        const bool relaxed =
            kind == DIFFUSION_SINGLE_PASS_RELAXED || kind == DIFFUSION_TIME_TILED_RELAXED;
        if (relaxed && !all)
            continue;
        s->rolling[kind] = diffusion_rolling_create(
            &s->scene, NULL, (enum diffusion_rolling_kind)kind,
            relaxed ? diffusion_rolling_tiling(s->rolling[kind - 1]) : NULL);
        if (!s->rolling[kind])
            return false;
    }
    if (!all)
        visible_say(
            "diffusion: the sheet is too large for Halide, numpy and the relaxed kernels, "
            "no such rows%s",
            thorough || (double)width * height > FIBERS_PEERS_THOROUGH
                ? ""
                : " (--thorough has them)");
    return listing_start(s, false) && (!all || peers_start(s));
}

static void sheet_finish(struct sheet *s)
{
    for (int kind = 0; kind < 4; kind++)
        diffusion_rolling_destroy(s->rolling[kind]);
    diffusion_hand_destroy(s->hand);
    diffusion_openmp_destroy(s->openmp);
    diffusion_openmp_rolling_destroy(s->openmp_rolling);
    bench_peer_stop(s->halide);
    bench_peer_stop(s->halide_tiled);
    bench_peer_stop(s->numpy);
    diffusion_scene_finish(&s->scene);
}

enum { RUNNERS_MAX = 16 };

/* Lists the available contenders. Runs of time-tiled ones are whole numbers of passes. */
static int runners_list(struct sheet *s, struct runner *list)
{
    const bool small = (double)s->scene.width * s->scene.height < FIBERS_SMALL;
    const int few = small ? 16 : 3;
    int openmp_tiled = diffusion_openmp_rolling_tiling(s->openmp_rolling)->steps_count;
    int tiled =
        s->hand ? diffusion_rolling_tiling(s->rolling[DIFFUSION_TIME_TILED])->steps_count : 0;
    const struct runner all[] = {
        {"listing", listing_steps, listing_read, 1, few, false, s},
        {"listing observed every 16", listing_steps, listing_read, 16, 16, false, s},
        {"hand per axis", hand_steps, hand_read, 0, few, false, s},
        {"hand single pass", rolling_steps, rolling_field, DIFFUSION_SINGLE_PASS, few, false,
         s},
        {"hand single pass relaxed", rolling_steps, rolling_field,
         DIFFUSION_SINGLE_PASS_RELAXED, few, true, s},
        {"hand time-tiled", rolling_steps, rolling_field, DIFFUSION_TIME_TILED,
         tiled * (1 + small), false, s},
        {"hand time-tiled relaxed", rolling_steps, rolling_field, DIFFUSION_TIME_TILED_RELAXED,
         tiled * (1 + small), true, s},
        {"openmp", openmp_steps, openmp_read, 0, few, false, s},
        {"openmp time-tiled", openmp_steps, openmp_read, 1, openmp_tiled * (1 + small), false,
         s},
        {"halide", peer_steps, peer_read, 1, few, false, s},
        {"halide 4 at a time", peer_steps, peer_read, 2, small ? 16 : 4, false, s},
    };
    int count = 0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if ((all[i].steps != peer_steps || peer_of(s, all[i].which)) &&
            (all[i].steps != hand_steps || s->hand) &&
            (all[i].steps != rolling_steps || s->rolling[all[i].which]))
            list[count++] = all[i];
    return count;
}

/* ---- agreement ---- */

/* False if a bit differs, or reading failed. yardstick: OpenMP's result. */
static bool agree(const struct diffusion_scene *scene, const struct runner *r, int field,
                  const float *yardstick, const float *mine, int steps_count)
{
    size_t count = (size_t)scene->width * (size_t)scene->height, k = 0;
    if (!r->relaxed && !memcmp(yardstick, mine, count * sizeof *mine))
        return true;
    while (k < count && (r->relaxed ? fabsf(yardstick[k] - mine[k]) <= 1e-5f
                                    : !memcmp(yardstick + k, mine + k, sizeof *mine)))
        k++;
    return k == count ||
           bench_fail("%s differs from openmp after %d steps: field %d, row %zu, column %zu: "
                      "%a, openmp has %a",
                      r->what, steps_count, field, k / (size_t)scene->width,
                      k % (size_t)scene->width, (double)mine[k], (double)yardstick[k]);
}

/* OpenMP and each contender take that many more steps, after steps_before ones. */
static bool all_agree(struct sheet *s, struct runner *runners, int runners_count,
                      int steps_before, int steps_count)
{
    size_t bytes = (size_t)s->scene.width * (size_t)s->scene.height * sizeof(float);
    float *yardstick = malloc(bytes), *mine = malloc(bytes);
    bool ok = (yardstick && mine) || bench_fail("no memory for two fields of %zu bytes", bytes);
    if (ok)
        diffusion_openmp_steps(s->openmp, steps_count);
    for (int i = 0; ok && i < runners_count; i++)
        if (runners[i].steps != openmp_steps || runners[i].which)
            ok = runners[i].steps(s, runners[i].which, steps_count);
    for (int field = 0; ok && field < DIFFUSION_FIELDS_COUNT; field++) {
        diffusion_openmp_read(s->openmp, field, yardstick);
        for (int i = 0; ok && i < runners_count; i++)
            ok = runners[i].read(s, runners[i].which, field, mine) &&
                 agree(&s->scene, &runners[i], field, yardstick, mine,
                       steps_before + steps_count);
    }
    free(yardstick);
    free(mine);
    return ok;
}

/* ---- one size ---- */

static bool runner_ready(void *context)
{
    struct runner *r = context;
    /* the steps of one pipeline; else two, since steps read one copy and write another */
    return r->steps(r->sheet, r->which, r->steps == peer_steps && r->which == 2 ? 4 : 2);
}

static bool runner_work(void *context)
{
    struct runner *r = context;
    return r->steps(r->sheet, r->which, r->steps_count);
}

/* copy: NULL, or a contender that gives the rows of the memory's bandwidth. */
static bool runners_measure(struct bench_report *report, const char *size, double fibers,
                            struct runner *runners, int count, int repeat_count,
                            struct bench_copy *copy)
{
    struct bench_contender contenders[RUNNERS_MAX + 1];
    for (int i = 0; i < count; i++)
        contenders[i] =
            (struct bench_contender){.what = runners[i].what,
                                     .ready = fibers < FIBERS_SMALL ? runner_ready : NULL,
                                     .work = runner_work,
                                     .context = &runners[i]};
    contenders[count] = (struct bench_contender){.work = bench_copy_work, .context = copy};
    if (!bench_measure_in_turns(contenders, count + (copy != NULL), repeat_count))
        return false;
    for (int i = 0; i < count; i++)
        bench_report_add(report, contenders[i].what, size, contenders[i].seconds,
                         1e9 / fibers / runners[i].steps_count, FIBER_STEP);
    if (!copy)
        return true;
    struct bench_sample rate = bench_copy_rate(copy, contenders[count].seconds);
    for (int passes = 2; passes; passes--)
        bench_report_add(report, passes == 2 ? "traffic bound" : "traffic bound, one pass",
                         size,
                         (struct bench_sample){COMPULSORY_BYTES / 2 * passes / rate.median,
                                               COMPULSORY_BYTES / 2 * passes / rate.min},
                         1, FIBER_STEP);
    bench_report_add(report, "copy bandwidth", size, rate, 1, "GB/s");
    return true;
}

/* Whether the contender takes several steps at a time. */
static bool takes_many(const struct runner *r)
{
    return (r->steps == listing_steps && r->which > 1) ||
           (r->steps == rolling_steps &&
            (r->which == DIFFUSION_TIME_TILED || r->which == DIFFUSION_TIME_TILED_RELAXED)) ||
           (r->steps == openmp_steps && r->which) || (r->steps == peer_steps && r->which == 2);
}

/* Measures the contenders of single steps, and then those of many steps: the machine treats
 * a program that looks after each step differently. */
static bool kinds_measure(struct bench_report *report, const char *size, double fibers,
                          const struct runner *runners, int count, int repeat_count,
                          struct bench_copy *copy)
{
    for (int many = 0; many < 2; many++) {
        struct runner chosen[RUNNERS_MAX];
        int chosen_count = 0;
        for (int i = 0; i < count; i++)
            if (takes_many(&runners[i]) == (many == 1))
                chosen[chosen_count++] = runners[i];
        for (int i = 0; i < chosen_count; i++)
            if (chosen[i].steps == listing_steps &&
                !listing_steps(chosen[i].sheet, chosen[i].which, STEPS_SETTLED))
                return false;
        if (!runners_measure(report, size, fibers, chosen, chosen_count, repeat_count,
                             many ? NULL : copy))
            return false;
    }
    return true;
}

static bool agree_and_measure(struct bench_report *report, const struct bench_options *o,
                              struct sheet *s, const char *size, struct bench_copy *copy)
{
    double fibers = (double)s->scene.width * s->scene.height;
    struct runner runners[RUNNERS_MAX], unobserved[3];
    int count = runners_list(s, runners), unobserved_count = 0;
    /* the second one is the listing again */
    struct runner once[RUNNERS_MAX];
    int once_count = 0;
    for (int i = 0; i < count; i++) {
        bool tiled =
            runners[i].steps == rolling_steps && runners[i].which == DIFFUSION_TIME_TILED;
        bool listing_16 = runners[i].steps == listing_steps && runners[i].which > 1;
        if (!listing_16)
            once[once_count++] = runners[i];
        if (listing_16 || tiled || (runners[i].steps == openmp_steps && runners[i].which))
            unobserved[unobserved_count++] = runners[i];
    }
    struct runner numpy = {"numpy", peer_steps, peer_read, 0, 1, false, s};
    if (s->numpy)
        once[once_count++] = numpy;
    if (!all_agree(s, once, once_count, 0, STEPS_AGREED) ||
        !all_agree(s, unobserved, unobserved_count, STEPS_AGREED, STEPS_UNOBSERVED) ||
        !kinds_measure(report, size, fibers, runners, count, o->repeat_count, copy))
        return false;
    return !s->numpy || runners_measure(report, size, fibers, &numpy, 1, REPEAT_SLOW, NULL);
}

/* Begins again from the start, to compare results. */
static bool eager_measure(struct bench_report *report, int width, int height, const char *size)
{
    struct sheet s = {0};
    struct runner eager = {"listing eager", listing_steps, listing_read, 1, 1, false, &s};
    bool ok =
        diffusion_scene_init(&s.scene, width, height) &&
        (s.openmp = diffusion_openmp_create(&s.scene)) != NULL && listing_start(&s, true) &&
        all_agree(&s, &eager, 1, 0, STEPS_AGREED) &&
        runners_measure(report, size, (double)width * height, &eager, 1, REPEAT_SLOW, NULL);
    sheet_finish(&s);
    return ok;
}

static bool size_measure(struct bench_report *r, const struct bench_options *o, int width,
                         int height)
{
    struct sheet s = {0};
    struct bench_copy *copy = bench_copy_create(COPY_BYTES);
    char size[32];
    snprintf(size, sizeof size, "%dx%d", width, height);
    visible_say("diffusion: %s ...", size);
    bool ok = copy && sheet_start(&s, width, height, o->thorough) &&
              agree_and_measure(r, o, &s, size, copy);
    sheet_finish(&s);
    bench_copy_destroy(copy);
    return ok && eager_measure(r, width, height, size);
}

/* Measures a sheet that fits the caches, with a look after every hundredth step. */
static bool small_measure(struct bench_report *r, int repeat_count)
{
    struct sheet s = {0};
    struct runner runners[] = {
        {"small sheet", listing_steps, listing_read, SMALL_STEPS, SMALL_STEPS, false, &s},
        {"small sheet, openmp", openmp_steps, openmp_read, 1, SMALL_STEPS, false, &s},
        {"small sheet, hand", rolling_steps, rolling_field, DIFFUSION_TIME_TILED, SMALL_STEPS,
         false, &s},
    };
    struct bench_contender contenders[3];
    bool by_hand = false;
    bool ok = bench_opencl_is_cpu(NULL, &by_hand) &&
              diffusion_scene_init(&s.scene, SMALL_SIDE, SMALL_SIDE) &&
              (s.openmp = diffusion_openmp_create(&s.scene)) != NULL &&
              (s.openmp_rolling = diffusion_openmp_rolling_create(&s.scene, NULL)) != NULL &&
              (!by_hand || (s.rolling[DIFFUSION_TIME_TILED] = diffusion_rolling_create(
                                &s.scene, NULL, DIFFUSION_TIME_TILED, NULL)) != NULL) &&
              listing_start(&s, false) && all_agree(&s, runners, 2 + by_hand, 0, SMALL_STEPS);
    const int count = 2 + by_hand;
    for (int i = 0; ok && i < SMALL_LOOKS_SETTLED; i++)
        ok = listing_steps(&s, SMALL_STEPS, SMALL_STEPS);
    for (int i = 0; i < count; i++)
        contenders[i] = (struct bench_contender){
            .ready = runner_work, .work = runner_work, .context = &runners[i]};
    ok = ok && bench_measure_in_turns(contenders, count, SMALL_REPEATS * repeat_count);
    for (int i = 0; ok && i < count; i++)
        bench_report_add(r, runners[i].what, "128x128",
                         (struct bench_sample){SMALL_STEPS / contenders[i].seconds.median,
                                               SMALL_STEPS / contenders[i].seconds.min},
                         1, "steps/s");
    sheet_finish(&s);
    return ok;
}

/* Measures the program's own thread in a foreseen step: the calls, and submitting the work;
 * alternately, a launch by hand, for comparison. The device's threads may share the cores,
 * so processor time is measured, not elapsed time. */
static bool front_end_measure(struct bench_report *r)
{
    struct sheet s = {0};
    struct bare_launch bare = {.kernel = NULL};
    double all[FRONT_END_STEPS], launch[FRONT_END_STEPS];
    bool ok = diffusion_scene_init(&s.scene, FRONT_END_SIDE, FRONT_END_SIDE) &&
              listing_start(&s, false) && listing_steps(&s, 1, STEPS_AGREED) &&
              bare_launch_open(&bare) && bare_launch(&bare, launch);
    for (int i = 0; ok && i < FRONT_END_STEPS; i++) {
        double start = bench_thread_s();
        listing_step(&s.listing);
        ok = bench_machine_said(machine_flush(paris_machine()));
        all[i] = bench_thread_s() - start;
        ok = ok && bench_machine_finished() && bare_launch(&bare, &launch[i]);
    }
    if (ok) {
        struct bench_sample step = bench_sample_of(all, FRONT_END_STEPS),
                            driver = bench_sample_of(launch, FRONT_END_STEPS);
        struct bench_sample ours = {step.median - driver.median, step.min - driver.min};
        bench_report_add(r, "front end", "listing", step, 1e6, "us/step");
        bench_report_add(r, "front end, a bare launch", "by hand", driver, 1e6, "us/step");
        bench_report_add(r, "front end, the rest", "listing", ours, 1e6, "us/step");
    }
    bare_launch_close(&bare);
    diffusion_scene_finish(&s.scene);
    return ok;
}

int bench_diffusion_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "diffusion",
                                    .sizes = {{1024, 1024}, {4096, 4096}},
                                    .sizes_count = 2,
                                    .size_least = 16,
                                    .size_most = 8192,
                                    .repeat_least = 10,
                                    .repeat_count = 11,
                                    .thorough_does =
                                        "Halide, numpy and the relaxed kernels on large "
                                        "sheets, too (minutes)"};

    int status = bench_machine_start(&report, &options, true, argc, argv);
    if (status >= 0)
        return status;

    bool ok = true;
    for (int i = 0; ok && i < options.sizes_count; i++)
        ok = size_measure(&report, &options, options.sizes[i][0], options.sizes[i][1]);
    ok = ok && small_measure(&report, options.repeat_count) && front_end_measure(&report);
    bool by_hand = true;
    ok = ok && bench_opencl_is_cpu(NULL, &by_hand);
    status =
        bench_options_finish(&options, &report, by_hand ? "hand single pass" : "openmp", ok);
    if (ok)
        printf("all but the relaxed ones agree in every bit after %d steps, and after %d more "
               "unobserved\n",
               STEPS_AGREED, STEPS_UNOBSERVED);
    return status;
}
