/* model.c - `lutetia bench model`: see model.h.
 *
 * The programs need different plans: values that are cheap or expensive to compute again at
 * a neighbour, wide and narrow values, neighbours across rows, along rows, or both, and
 * chains of neighbours. They begin with random values: the engine folds what is the same
 * everywhere, and would have nothing to measure.
 */
#include "model.h"
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>

#include <cm/paris.h>

#include "bench.h"
#include "grids.h"
#include "listing.h"
#include "of_machine.h"
#include "paris_internal.h"

enum {
    STEPS = 16,
    STEPS_WARM = 3,
    ROUNDS_MOST = 64,
    SIGNIFICAND = 23,
    EXPONENT = 8,
    FLOAT = 32
};

struct program {
    struct listing listing;
    struct life_paris life;
    struct heat_paris heat;
    CM_field_id_t a, b, c;
};

/* ---- the programs ---- */

static void listing_begin(struct program *p, int width, int height)
{
    p->listing = (struct listing){
        .width = width, .height = height, .gravity = 1.1, .molecular_weight = {0.9, 0.7, 0.5}};
    listing_allocate(&p->listing);
    const CM_field_id_t floats[] = {p->listing.water, p->listing.absorbency,
                                    p->listing.pigment[0], p->listing.pigment[1],
                                    p->listing.pigment[2]};
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        CM_f_random_1L(floats[i], SIGNIFICAND, EXPONENT);
}

static void listing_go(const void *p)
{
    listing_step(&((const struct program *)p)->listing);
}

static void life_begin(struct program *p, int width, int height)
{
    life_paris_allocate(&p->life, width, height);
    CM_u_random_1L(p->life.alive, 1, 2);
}

static void life_go(const void *p)
{
    life_paris_step(&((const struct program *)p)->life);
}

static void heat_begin(struct program *p, int width, int height)
{
    heat_paris_allocate(&p->heat, width, height);
    CM_f_random_1L(p->heat.heat, SIGNIFICAND, EXPONENT);
}

static void heat_go(const void *p)
{
    heat_paris_step(&((const struct program *)p)->heat);
}

static void floats_begin(struct program *p, int width, int height)
{
    unsigned int dimensions[2] = {(unsigned int)height, (unsigned int)width};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    CM_set_context();
    p->a = CM_allocate_heap_field(FLOAT);
    p->b = CM_allocate_heap_field(FLOAT);
    p->c = CM_allocate_heap_field(FLOAT);
    CM_f_random_1L(p->a, SIGNIFICAND, EXPONENT);
}

/* The mean of three neighbours, along both axes: cheap to compute again. */
static void mean_along(const struct program *p, unsigned int axis)
{
    CM_get_from_news_1L(p->b, p->a, axis, CM_upward, FLOAT);
    CM_get_from_news_1L(p->c, p->a, axis, CM_downward, FLOAT);
    CM_f_add_2_1L(p->a, p->b, SIGNIFICAND, EXPONENT);
    CM_f_add_2_1L(p->a, p->c, SIGNIFICAND, EXPONENT);
    CM_f_multiply_constant_2_1L(p->a, 1.0 / 3, SIGNIFICAND, EXPONENT);
}

static void blur_go(const void *of)
{
    mean_along(of, 0);
    mean_along(of, 1);
}

/* Four means, one after the other, along rows only. */
static void chain_go(const void *of)
{
    for (int i = 0; i < 4; i++)
        mean_along(of, 1);
}

/* A quotient and a root, which are expensive, read by the neighbours on all sides. */
static void dear_go(const void *of)
{
    const struct program *p = of;
    CM_f_multiply_3_1L(p->b, p->a, p->a, SIGNIFICAND, EXPONENT);
    CM_f_add_constant_2_1L(p->b, 1.0, SIGNIFICAND, EXPONENT);
    CM_f_sqrt_1_1L(p->b, SIGNIFICAND, EXPONENT);
    CM_f_divide_2_1L(p->a, p->b, SIGNIFICAND, EXPONENT);
    blur_go(of);
}

static const struct {
    const char *name;
    void (*begin)(struct program *p, int width, int height);
    void (*step)(const void *p);
} programs[] = {{"listing", listing_begin, listing_go}, {"life", life_begin, life_go},
                {"heat", heat_begin, heat_go},          {"blur", floats_begin, blur_go},
                {"chain", floats_begin, chain_go},      {"dear", floats_begin, dear_go}};

int model_programs_count(void)
{
    return sizeof programs / sizeof *programs;
}

const char *model_program_name(int program)
{
    return programs[program].name;
}

/* ---- measured ---- */

static const char *const strips_said[MODEL_FORMS] = {"0", "1", ""};

static bool machine_begin_form(enum model_form form)
{
    struct machine_config config = machine_config_default();
    setenv("LUTETIA_STRIPS", strips_said[form], 1);
    return paris_reset(&config) || bench_fail("%s", paris_error());
}

static bool measure_once(int program, int width, int height, enum model_form form, double *wall,
                         double *processor, struct model_result *result)
{
    static struct program p;
    struct machine_stats before, after;
    double scale = 1e9 / ((double)width * height * STEPS);
    if (!machine_begin_form(form))
        return false;
    programs[program].begin(&p, width, height);
    if (!bench_machine_steps(programs[program].step, &p, STEPS_WARM, 1))
        return false;
    machine_stats_get(paris_machine(), &before);
    double wall_s = bench_now_s(), processor_s = bench_process_s();
    if (!bench_machine_steps(programs[program].step, &p, STEPS, 1))
        return false;
    *wall = (bench_now_s() - wall_s) * scale;
    *processor = (bench_process_s() - processor_s) * scale / bench_threads_count();
    machine_stats_get(paris_machine(), &after);
    result->predicted = (after.predicted_s - before.predicted_s) * scale;
    result->in_strips = after.kernels_in_strips > before.kernels_in_strips ||
                        after.kernels_in_tiles > before.kernels_in_tiles;
    return true;
}

bool model_measure(int program, int width, int height, int rounds,
                   struct model_result results[MODEL_FORMS])
{
    static const char *const forced[][2] = {
        {"LUTETIA_TURNS", "1"}, {"LUTETIA_BOX_AFTER", "0"}, {"LUTETIA_OPTIMISE_AFTER", "0"}};
    double wall[MODEL_FORMS][ROUNDS_MOST], processor[MODEL_FORMS][ROUNDS_MOST];
    bool good = true;
    for (size_t i = 0; i < sizeof forced / sizeof *forced; i++)
        setenv(forced[i][0], forced[i][1], 1);
    rounds = rounds < ROUNDS_MOST ? rounds : ROUNDS_MOST;
    for (int i = 0; good && i < rounds; i++)
        for (int form = 0; good && form < MODEL_FORMS; form++)
            good = measure_once(program, width, height, (enum model_form)form, &wall[form][i],
                                &processor[form][i], &results[form]);
    for (size_t i = 0; i < sizeof forced / sizeof *forced; i++)
        unsetenv(forced[i][0]);
    unsetenv("LUTETIA_STRIPS");
    for (int form = 0; good && form < MODEL_FORMS; form++) {
        results[form].wall = bench_sample_of(wall[form], rounds);
        results[form].processor = bench_sample_of(processor[form], rounds);
    }
    return good;
}

/* The numbers that predictions are made of: as they are, and as they are measured. */
static bool costs_report(struct bench_report *r)
{
    double ns[MACHINE_COSTS];
    if (!machine_begin_form(MODEL_CHOSEN))
        return false;
    struct machine *m = paris_machine();
    const struct machine_tuning tuning = machine_tuning_get(m);
    if (machine_costs_measure(m, ns) != MACHINE_OK)
        return bench_fail("%s", machine_error(m));
    for (int i = 0; i < MACHINE_COSTS; i++) {
        const char *name = machine_cost_name((enum machine_cost)i);
        struct bench_sample is = {tuning.cost_ns[i], tuning.cost_ns[i]},
                            measured = {ns[i], ns[i]};
        bench_report_add(r, "cost", name, is, 1, "ns");
        if (ns[i] > 0)
            bench_report_add(r, "cost, measured", name, measured, 1, "ns");
    }
    return true;
}

int bench_model_main(int argc, char **argv)
{
    static const char *const names[MODEL_FORMS] = {"rows", "strips", "chosen"};
    static const char unit[] = "ns/cell-step";
    static struct bench_report report;
    struct bench_options options = {.name = "model",
                                    .sizes = {{256, 256}, {1024, 1024}, {2048, 2048}},
                                    .sizes_count = 3,
                                    .size_least = 64,
                                    .size_most = 8192,
                                    .repeat_least = 3,
                                    .repeat_count = 7};
    int status = bench_machine_start(&report, &options, true, argc, argv);
    if (status >= 0)
        return status;
    visible_say("model: costs ...");
    bool ok = costs_report(&report);
    for (int i = 0; ok && i < options.sizes_count; i++)
        for (int p = 0; ok && p < bench_many(model_programs_count(), 1); p++) {
            struct model_result results[MODEL_FORMS];
            int width = options.sizes[i][0], height = options.sizes[i][1];
            char of_case[32], what[32];
            snprintf(of_case, sizeof of_case, "%s %dx%d", programs[p].name, width, height);
            visible_say("model: %s ...", of_case);
            ok = model_measure(p, width, height, options.repeat_count, results);
            for (int form = 0; ok && form < MODEL_FORMS; form++) {
                struct bench_sample predicted = {results[form].predicted,
                                                 results[form].predicted};
                bench_report_add(&report, names[form], of_case, results[form].wall, 1, unit);
                snprintf(what, sizeof what, "%s, predicted", names[form]);
                bench_report_add(&report, what, of_case, predicted, 1, unit);
            }
        }
    return bench_options_finish(&options, &report, "chosen", ok);
}
