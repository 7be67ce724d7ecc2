/* grids.c - `lutetia bench life` and `lutetia bench heat`: a program in C/Paris beside C
 * with OpenMP written for it, and beside the memory's limit. Both first take the same steps,
 * and must agree in every bit. */
#include "grids.h"
#include <visible_text.h>

#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "copy.h"
#include "of_machine.h"
#include "paris_internal.h"

enum {
    STEPS_AGREED = 5,
    STEPS_OBSERVED = 16, /* for the row "paris observed every 16" */
    STEPS_SETTLED = 64,  /* until the machine has adapted to so many looks */
    STEPS_SMALL = 512,
    STEPS_LARGE = 16,
    CELLS_SMALL = 4000000,
    COPY_BYTES = 256 << 20
};

static const char CELL_STEP[] = "ns/cell-step";

struct grid {
    int width, height, steps_count;
    struct life_paris life;
    struct heat_paris heat;
    struct grid_openmp *openmp, *bits; /* bits: NULL: none */
};

/* The two benchmarks; cells are bytes (Life) or floats (heat). */
struct kind {
    const char *name;
    size_t cell_bytes;
    double traffic_bytes; /* for each cell and step, at least */
    void (*start)(unsigned char *cells, size_t count);
    void (*allocate)(struct grid *g);
    void (*step)(const void *grid);
    bool (*create)(struct grid *g, const unsigned char *cells);
    void (*openmp_steps)(struct grid_openmp *g, int steps_count);
    void (*openmp_read)(const struct grid *g, unsigned char *out);
    grid_field (*field)(const struct grid *g);
    struct machine_type type;
};

struct turn {
    const struct kind *kind;
    struct grid *grid;
    int steps_between; /* two looks at it */
};

/* ---- Life ---- */

static unsigned int noise(size_t index)
{
    unsigned int z = (unsigned int)index * 0x9e3779b9u + 0x7f4a7c15u;
    z = (z ^ z >> 16) * 0x85ebca6bu;
    z = (z ^ z >> 13) * 0xc2b2ae35u;
    return z ^ z >> 16;
}

static void life_start(unsigned char *cells, size_t count)
{
    for (size_t i = 0; i < count; i++)
        cells[i] = noise(i) % 3 == 0;
}

static void life_allocate(struct grid *g)
{
    life_paris_allocate(&g->life, g->width, g->height);
}

static void life_step(const void *grid)
{
    const struct grid *g = grid;
    life_paris_step(&g->life);
}

static bool life_create(struct grid *g, const unsigned char *cells)
{
    g->openmp = life_openmp_create(g->width, g->height, cells);
    if (g->width % 64 == 0)
        g->bits = life_bits_create(g->width, g->height, cells);
    return g->openmp && (g->bits || g->width % 64);
}

static void life_read(const struct grid *g, unsigned char *out)
{
    life_openmp_read(g->openmp, out);
}

static grid_field life_field(const struct grid *g)
{
    return g->life.alive;
}

/* ---- heat ---- */

static void heat_start(unsigned char *cells, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        float warmth = (float)(noise(i) >> 8) * 0x1p-24f;
        memcpy(cells + i * sizeof warmth, &warmth, sizeof warmth);
    }
}

static void heat_allocate(struct grid *g)
{
    heat_paris_allocate(&g->heat, g->width, g->height);
}

static void heat_step(const void *grid)
{
    const struct grid *g = grid;
    heat_paris_step(&g->heat);
}

static bool heat_create(struct grid *g, const unsigned char *cells)
{
    g->openmp = heat_openmp_create(g->width, g->height, (const float *)(const void *)cells);
    return g->openmp != NULL;
}

static void heat_read(const struct grid *g, unsigned char *out)
{
    heat_openmp_read(g->openmp, (float *)(void *)out);
}

static grid_field heat_field(const struct grid *g)
{
    return g->heat.heat;
}

/* ---- both ---- */

static bool paris_steps(const struct turn *t, int steps_count)
{
    return bench_machine_steps(t->kind->step, t->grid, steps_count, t->steps_between);
}

static bool paris_ready(void *context)
{
    return paris_steps(context, STEPS_SETTLED);
}

static bool paris_work(void *context)
{
    const struct turn *t = context;
    return paris_steps(t, t->grid->steps_count);
}

static bool openmp_ready(void *context)
{
    const struct turn *t = context;
    t->kind->openmp_steps(t->grid->openmp, 1);
    return true;
}

static bool openmp_work(void *context)
{
    const struct turn *t = context;
    t->kind->openmp_steps(t->grid->openmp, t->grid->steps_count);
    return true;
}

static bool bits_ready(void *context)
{
    const struct turn *t = context;
    life_bits_steps(t->grid->bits, 1);
    return true;
}

static bool bits_work(void *context)
{
    const struct turn *t = context;
    life_bits_steps(t->grid->bits, t->grid->steps_count);
    return true;
}

static bool differ(const char *what, const struct grid *g, size_t cell_bytes,
                   const unsigned char *a, const unsigned char *b)
{
    size_t i = 0, count = (size_t)g->width * (size_t)g->height * cell_bytes;
    while (i < count && a[i] == b[i])
        i++;
    if (i < count)
        bench_fail("%s differs from openmp after %d steps: row %zu, column %zu", what,
                   STEPS_AGREED, i / cell_bytes / (size_t)g->width,
                   i / cell_bytes % (size_t)g->width);
    return i < count;
}

static bool agree(const struct kind *k, struct grid *g, unsigned char *a, unsigned char *b)
{
    const struct turn each = {k, g, 1};
    k->openmp_steps(g->openmp, STEPS_AGREED);
    k->openmp_read(g, a);
    if (!paris_steps(&each, STEPS_AGREED) ||
        !bench_machine_said(machine_field_download(paris_machine(), k->field(g), k->type, b)) ||
        differ("paris", g, k->cell_bytes, a, b))
        return false;
    if (!g->bits)
        return true;
    life_bits_steps(g->bits, STEPS_AGREED);
    life_bits_read(g->bits, b);
    return !differ("openmp, bits", g, k->cell_bytes, a, b);
}

static bool size_measure(struct bench_report *r, const struct bench_options *o,
                         const struct kind *k, int width, int height, struct bench_copy *copy)
{
    size_t count = (size_t)width * (size_t)height;
    struct grid g = {.width = width,
                     .height = height,
                     .steps_count = count < CELLS_SMALL ? STEPS_SMALL : STEPS_LARGE};
    struct machine_config config = machine_config_default();
    unsigned char *a = malloc(count * k->cell_bytes), *b = malloc(count * k->cell_bytes);
    char size[32];
    snprintf(size, sizeof size, "%dx%d", width, height);
    visible_say("%s: %s ...", k->name, size);
    bool ok = (a && b) || bench_fail("no memory for a grid of %s", size);
    if (ok) {
        k->start(a, count);
        ok = paris_reset(&config) || bench_fail("%s", paris_error());
    }
    if (ok) {
        k->allocate(&g);
        ok = k->create(&g, a) &&
             bench_machine_said(
                 machine_field_upload(paris_machine(), k->field(&g), k->type, a)) &&
             agree(k, &g, a, b);
    }
    struct turn each = {k, &g, 1}, sixteenth = {k, &g, STEPS_OBSERVED};
    struct bench_contender contenders[] = {
        {.what = "paris", .ready = paris_ready, .work = paris_work, .context = &each},
        {.what = "paris observed every 16",
         .ready = paris_ready,
         .work = paris_work,
         .context = &sixteenth},
        {.what = "openmp", .ready = openmp_ready, .work = openmp_work, .context = &each},
        {.what = "copy bandwidth", .work = bench_copy_work, .context = copy},
        {.what = "openmp, bits", .ready = bits_ready, .work = bits_work, .context = &each},
    };
    const int of_copy = 3;
    int contenders_count = g.bits ? 5 : 4;
    ok = ok && bench_measure_in_turns(contenders, contenders_count, o->repeat_count);
    for (int i = 0; ok && i < contenders_count; i++)
        if (i != of_copy)
            bench_report_add(r, contenders[i].what, size, contenders[i].seconds,
                             1e9 / (double)count / g.steps_count, CELL_STEP);
    if (ok) {
        struct bench_sample rate = bench_copy_rate(copy, contenders[of_copy].seconds);
        bench_report_add(
            r, "traffic bound", size,
            (struct bench_sample){k->traffic_bytes / rate.median, k->traffic_bytes / rate.min},
            1, CELL_STEP);
        bench_report_add(r, "copy bandwidth", size, rate, 1, "GB/s");
    }
    grid_openmp_destroy(g.openmp);
    grid_openmp_destroy(g.bits);
    free(a);
    free(b);
    return ok;
}

static int run(const struct kind *k, int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = k->name,
                                    .sizes = {{1024, 1024}, {4096, 4096}},
                                    .sizes_count = 2,
                                    .size_least = 16,
                                    .size_most = 16384,
                                    .repeat_least = 10,
                                    .repeat_count = 11};
    int status = bench_machine_start(&report, &options, true, argc, argv);
    if (status >= 0)
        return status;
    struct bench_copy *copy = bench_copy_create(COPY_BYTES);
    bool ok = copy != NULL;
    for (int i = 0; ok && i < options.sizes_count; i++)
        ok = size_measure(&report, &options, k, options.sizes[i][0], options.sizes[i][1], copy);
    bench_copy_destroy(copy);
    return bench_options_finish(&options, &report, "openmp", ok);
}

int bench_life_main(int argc, char **argv)
{
    const struct kind kind = {.name = "life",
                              .cell_bytes = 1,
                              .traffic_bytes = 2.0 / 8,
                              .start = life_start,
                              .allocate = life_allocate,
                              .step = life_step,
                              .create = life_create,
                              .openmp_steps = life_openmp_steps,
                              .openmp_read = life_read,
                              .field = life_field,
                              .type = MACHINE_UINT(1)};
    return run(&kind, argc, argv);
}

int bench_heat_main(int argc, char **argv)
{
    const struct kind kind = {.name = "heat",
                              .cell_bytes = sizeof(float),
                              .traffic_bytes = 2 * sizeof(float),
                              .start = heat_start,
                              .allocate = heat_allocate,
                              .step = heat_step,
                              .create = heat_create,
                              .openmp_steps = heat_openmp_steps,
                              .openmp_read = heat_read,
                              .field = heat_field,
                              .type = MACHINE_F32};
    return run(&kind, argc, argv);
}
