/* diffusion.c - `lutetia bench diffusion`: the thesis's step through the machine, beside
 * hand-written code that gives the same bits and beside the memory's limit.
 *
 * For each size: the listing (fused, the sheet computed after every step), the hand-written
 * kernels and plain C with OpenMP first take the same few steps, and must agree in every bit;
 * then they are timed in turns. The listing in eager mode comes last, on a machine of its own.
 */
#include "bench.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "listing.h"
#include "paris_internal.h"
#include "scene.h"

enum {
    SIZES_MAX = 16,
    SIDE_MIN = 16,
    SIDE_MAX = 8192,
    REPEAT_MIN = 10,
    REPEAT_EAGER = 3,
    STEPS_AGREED = 5,
    FRONT_END_SIDE = 256,
    FRONT_END_STEPS = 200,
    COPY_BYTES = 256 << 20
};
/* Read and written for each fiber and axis: water and pigments both ways, absorbency one way.
 */
static const double COMPULSORY_BYTES = 2 * (2 * DIFFUSION_FIELDS_COUNT + 1) * sizeof(float);

static const char FIBER_STEP[] = "ns/fiber-step";

struct options {
    int sizes[SIZES_MAX][2], sizes_count; /* width, height */
    int repeat_count;
    const char *json_path; /* NULL: none */
};

/* ---- the contenders ---- */

struct sheet {
    struct diffusion_scene scene;
    int steps_count; /* in a counted run */
    struct listing listing;
    struct diffusion_hand *hand;
    struct diffusion_openmp *openmp;
};

static bool machine_said(enum machine_status status)
{
    return status == MACHINE_OK ||
           bench_fail("the machine: %s", machine_error(paris_machine()));
}

static bool listing_run(struct sheet *s, int steps_count)
{
    bool ok = true;
    for (int i = 0; ok && i < steps_count; i++) {
        listing_step(&s->listing);
        ok = machine_said(machine_flush(paris_machine()));
    }
    return ok && machine_said(machine_finish(paris_machine()));
}

static bool listing_ready(void *context)
{
    return listing_run(context, 1);
}

static bool listing_work(void *context)
{
    return listing_run(context, ((struct sheet *)context)->steps_count);
}

static bool listing_once(void *context)
{
    return listing_run(context, 1);
}

static bool hand_ready(void *context)
{
    return diffusion_hand_steps(((struct sheet *)context)->hand, 1);
}

static bool hand_work(void *context)
{
    struct sheet *s = context;
    return diffusion_hand_steps(s->hand, s->steps_count);
}

static bool openmp_ready(void *context)
{
    diffusion_openmp_steps(((struct sheet *)context)->openmp, 1);
    return true;
}

static bool openmp_work(void *context)
{
    struct sheet *s = context;
    diffusion_openmp_steps(s->openmp, s->steps_count);
    return true;
}

/* Makes the machine anew and puts the scene on it. */
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
    bool ok =
        machine_said(machine_field_upload(m, l->absorbency, MACHINE_F32, s->scene.absorbency));
    for (int i = 0; ok && i < DIFFUSION_FIELDS_COUNT; i++)
        ok = machine_said(machine_field_upload(m, fields[i], MACHINE_F32, s->scene.field[i]));
    return ok;
}

static bool listing_read(const struct sheet *s, int field, float *out)
{
    CM_field_id_t id = field == DIFFUSION_WATER ? s->listing.water
                                                : s->listing.pigment[field - DIFFUSION_PIGMENT];
    return machine_said(machine_field_download(paris_machine(), id, MACHINE_F32, out));
}

/* ---- agreement ---- */

/* False where a bit differs, or reading failed. yardstick: what OpenMP has. */
static bool agree(const struct diffusion_scene *scene, const char *what, int field,
                  const float *yardstick, const float *mine)
{
    size_t count = (size_t)scene->width * (size_t)scene->height;
    if (!memcmp(yardstick, mine, count * sizeof *mine))
        return true;
    size_t k = 0;
    while (!memcmp(yardstick + k, mine + k, sizeof *mine))
        k++;
    return bench_fail("%s differs from openmp after %d steps: field %d, row %zu, column %zu: "
                      "%a, openmp has %a",
                      what, STEPS_AGREED, field, k / (size_t)scene->width,
                      k % (size_t)scene->width, (double)mine[k], (double)yardstick[k]);
}

/* The listing in the machine's present mode, and the hand-written kernels if there are any
 * here. */
static bool all_agree(struct sheet *s, const char *listing_name)
{
    size_t bytes = (size_t)s->scene.width * (size_t)s->scene.height * sizeof(float);
    float *yardstick = malloc(bytes), *mine = malloc(bytes);
    bool ok = (yardstick && mine) || bench_fail("no memory for two fields of %zu bytes", bytes);
    for (int i = 0; ok && i < DIFFUSION_FIELDS_COUNT; i++) {
        diffusion_openmp_read(s->openmp, i, yardstick);
        ok = listing_read(s, i, mine) && agree(&s->scene, listing_name, i, yardstick, mine);
        if (ok && s->hand)
            ok = diffusion_hand_read(s->hand, i, mine) &&
                 agree(&s->scene, "hand per axis", i, yardstick, mine);
    }
    free(yardstick);
    free(mine);
    return ok;
}

/* ---- one size ---- */

static bool size_measure(struct bench_report *r, const struct options *o, int width, int height,
                         struct bench_sample gigabytes_a_second)
{
    struct sheet s = {0};
    char size[32];
    double fibers = (double)width * height;
    snprintf(size, sizeof size, "%dx%d", width, height);
    s.steps_count = fibers < 4e6 ? 16 : 3;

    fprintf(stderr, "diffusion: %s ...\n", size);
    bool ok = diffusion_scene_init(&s.scene, width, height) &&
              (s.openmp = diffusion_openmp_create(&s.scene)) != NULL &&
              (s.hand = diffusion_hand_create(&s.scene, NULL, DIFFUSION_SHAPE_BEST)) != NULL &&
              listing_start(&s, false);
    if (!ok)
        goto cleanup;
    diffusion_openmp_steps(s.openmp, STEPS_AGREED);
    ok = diffusion_hand_steps(s.hand, STEPS_AGREED) && listing_run(&s, STEPS_AGREED) &&
         all_agree(&s, "listing");
    if (!ok)
        goto cleanup;

    struct bench_contender contenders[] = {
        {.what = "listing", .ready = listing_ready, .work = listing_work, .context = &s},
        {.what = "hand per axis", .ready = hand_ready, .work = hand_work, .context = &s},
        {.what = "openmp", .ready = openmp_ready, .work = openmp_work, .context = &s},
    };
    const int contenders_count = sizeof contenders / sizeof *contenders;
    ok = bench_measure_in_turns(contenders, contenders_count, o->repeat_count);
    if (!ok)
        goto cleanup;
    for (int i = 0; i < contenders_count; i++)
        bench_report_add(r, contenders[i].what, size, contenders[i].seconds,
                         1e9 / fibers / s.steps_count, FIBER_STEP);

    /* Eager: from the start again, for the agreement. */
    diffusion_hand_destroy(s.hand);
    s.hand = NULL;
    diffusion_openmp_destroy(s.openmp);
    struct bench_sample eager;
    ok = (s.openmp = diffusion_openmp_create(&s.scene)) != NULL && listing_start(&s, true);
    if (!ok)
        goto cleanup;
    diffusion_openmp_steps(s.openmp, STEPS_AGREED);
    ok = listing_run(&s, STEPS_AGREED) && all_agree(&s, "listing eager") &&
         bench_measure(listing_once, &s, REPEAT_EAGER, &eager);
    if (!ok)
        goto cleanup;
    bench_report_add(r, "listing eager", size, eager, 1e9 / fibers, FIBER_STEP);
    bench_report_add(r, "traffic bound", size,
                     (struct bench_sample){COMPULSORY_BYTES / gigabytes_a_second.median,
                                           COMPULSORY_BYTES / gigabytes_a_second.min},
                     1, FIBER_STEP);
cleanup:
    diffusion_hand_destroy(s.hand);
    diffusion_openmp_destroy(s.openmp);
    diffusion_scene_finish(&s.scene);
    return ok;
}

/* What the program's own thread does in a step seen before: its calls, and handing over the work. The
 * device's threads may run on the same cores meanwhile: processor time, not time by the clock. */
static bool front_end_measure(struct bench_report *r)
{
    struct sheet s = {0};
    double seconds[FRONT_END_STEPS];
    bool ok = diffusion_scene_init(&s.scene, FRONT_END_SIDE, FRONT_END_SIDE) &&
              listing_start(&s, false) && listing_run(&s, STEPS_AGREED);
    for (int i = 0; ok && i < FRONT_END_STEPS; i++) {
        double start = bench_thread_s();
        listing_step(&s.listing);
        ok = machine_said(machine_flush(paris_machine()));
        seconds[i] = bench_thread_s() - start;
        ok = ok && machine_said(machine_finish(paris_machine()));
    }
    if (ok)
        bench_report_add(r, "front end", "listing", bench_sample_of(seconds, FRONT_END_STEPS),
                         1e6, "us/step");
    diffusion_scene_finish(&s.scene);
    return ok;
}

/* ---- options ---- */

static const char USAGE[] =
    "usage: lutetia bench diffusion [--sizes N,WxH,...] [--repeat N] [--json FILE]\n"
    "\n"
    "  --sizes N,WxH,...  sheets, in fibers (1024,4096)\n"
    "  --repeat N         counted runs of each, 10 or more (11)\n"
    "  --json FILE        write the rows there too\n";

static bool sizes_parse(const char *text, struct options *o)
{
    const char *at = text;
    for (o->sizes_count = 0; o->sizes_count < SIZES_MAX; at++) {
        int *size = o->sizes[o->sizes_count++];
        char *end;
        if (!bench_number_parse(at, &end, SIDE_MIN, SIDE_MAX, &size[0]))
            break;
        size[1] = size[0];
        if (*end == 'x' && !bench_number_parse(end + 1, &end, SIDE_MIN, SIDE_MAX, &size[1]))
            break;
        at = end;
        if (!*at)
            return true;
        if (*at != ',')
            break;
    }
    return bench_fail(
        "--sizes must be like 1024,640x480: at most %d sheets, sides %d..%d (got \"%s\")",
        SIZES_MAX, SIDE_MIN, SIDE_MAX, text);
}

static bool options_parse(struct options *o, int argc, char **argv)
{
    char *end;
    *o = (struct options){
        .sizes = {{1024, 1024}, {4096, 4096}}, .sizes_count = 2, .repeat_count = 11};
    for (int i = 1; i < argc; i += 2) {
        const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
        bool known =
            !strcmp(name, "--sizes") || !strcmp(name, "--repeat") || !strcmp(name, "--json");
        if (!known)
            return bench_fail("there is no option \"%s\"", name);
        if (!value)
            return bench_fail("%s needs a value", name);
        if (!strcmp(name, "--sizes")) {
            if (!sizes_parse(value, o))
                return false;
        } else if (!strcmp(name, "--repeat")) {
            if (!bench_number_parse(value, &end, REPEAT_MIN, 1000, &o->repeat_count) || *end)
                return bench_fail("--repeat must be %d..1000 (got \"%s\")", REPEAT_MIN, value);
        } else {
            o->json_path = value;
        }
    }
    return true;
}

int bench_diffusion_main(int argc, char **argv)
{
    static struct bench_report report;
    struct options options;
    struct bench_sample gigabytes_a_second;
    char device[256];

    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h")) {
            fputs(USAGE, stdout);
            return 0;
        }
    setenv("LUTETIA_BOX_AFTER", "0", 0); /* what a long run settles to, from the first step */
    if (!options_parse(&options, argc, argv)) {
        fprintf(stderr, "lutetia bench diffusion: %s\n%s", bench_error(), USAGE);
        return 2;
    }
    snprintf(device, sizeof device, "%s", machine_device_name(paris_machine()));
    bench_report_init(&report, "diffusion", bench_threads_count(), device);

    bool ok = bench_copy_bandwidth(COPY_BYTES, options.repeat_count, &gigabytes_a_second);
    for (int i = 0; ok && i < options.sizes_count; i++)
        ok = size_measure(&report, &options, options.sizes[i][0], options.sizes[i][1],
                          gigabytes_a_second);
    if (ok)
        ok = front_end_measure(&report);
    if (ok) {
        bench_report_add(&report, "copy bandwidth", "256 MB", gigabytes_a_second, 1, "GB/s");
        bench_report_print(&report, "hand per axis", stdout);
        printf("listing, listing eager, hand per axis and openmp agree in every bit after %d "
               "steps\n",
               STEPS_AGREED);
    }
    if (ok && options.json_path)
        ok = bench_report_write(&report, options.json_path);
    if (!ok)
        fprintf(stderr, "lutetia bench diffusion: %s\n", bench_error());
    return ok ? 0 : 1;
}
