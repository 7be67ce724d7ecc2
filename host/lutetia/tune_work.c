/* tune_work.c - see tune_work.h. */
#include "tune_work.h"
#include "lutetia.h"

#include <stdio.h>
#include <stdlib.h>

/* Fields of STENCIL: water, absorbency, pigment; the others have two. */
enum { FIELDS = 3 };

struct tune_work {
    enum tune_kind kind;
    struct machine *machine;
    int height;
    uint32_t fields[FIELDS]; /* of floats */
    bool failed;
};

/* TRAFFIC's arrays are larger than any cache. A turn of the other kinds takes some hundred
 * microseconds. */
static const struct kind {
    const char *name;
    int height, width, turns;
    bool apart; /* evaluate after each turn */
    bool (*turn)(struct machine *m, const uint32_t *fields);
} kinds[TUNE_KINDS];

static char error[1100];

const char *tune_work_error(void)
{
    return error;
}

const char *tune_kind_name(enum tune_kind kind)
{
    return kinds[kind].name;
}

/* ---- turns ---- */

static struct machine_value *number(struct machine *m, double x)
{
    return machine_constant_float(m, MACHINE_F32, x);
}

static struct machine_value *field(struct machine *m, uint32_t id)
{
    return machine_field_value(m, id, MACHINE_F32, MACHINE_EVERYWHERE);
}

/* Iterates x' = 3.5 x (1 - x), which stays between 0 and 1. */
static bool arithmetic_turn(struct machine *m, const uint32_t *fields)
{
    struct machine_value *x = field(m, fields[0]), *y = field(m, fields[1]);
    for (int i = 0; i < 12; i++) {
        struct machine_value *rest = machine_binary(m, MACHINE_FSUB, number(m, 1), x);
        rest = machine_binary(m, MACHINE_FMUL, rest, number(m, 3.5));
        x = machine_binary(m, MACHINE_FMUL, x, rest);
        x = machine_binary(m, MACHINE_FMAX, x, y);
    }
    return machine_field_store(m, fields[0], x, MACHINE_EVERYWHERE) == MACHINE_OK;
}

static bool traffic_turn(struct machine *m, const uint32_t *fields)
{
    struct machine_value *x =
        machine_binary(m, MACHINE_FSUB, field(m, fields[1]), field(m, fields[0]));
    return machine_field_store(m, fields[0], x, MACHINE_EVERYWHERE) == MACHINE_OK;
}

/* The flow across the face towards the lower neighbour is added here and subtracted there.
 * wet: NULL, or a factor of the flow. */
static bool spread(struct machine *m, uint32_t substance, uint32_t absorbency,
                   struct machine_value *wet, int axis)
{
    struct machine_value *x = field(m, substance), *in;
    in = machine_binary(m, MACHINE_FSUB, machine_shift(m, x, axis, -1), x);
    in = machine_binary(m, MACHINE_FMUL, in, field(m, absorbency));
    if (wet)
        in = machine_binary(m, MACHINE_FMUL, in, wet);
    struct machine_value *out = machine_shift(m, in, axis, 1);
    x = machine_binary(m, MACHINE_FSUB, machine_binary(m, MACHINE_FADD, x, in), out);
    x = machine_binary(m, MACHINE_FMIN, x, number(m, 1));
    x = machine_binary(m, MACHINE_FMAX, x, number(m, 0));
    return machine_field_store(m, substance, x, MACHINE_EVERYWHERE) == MACHINE_OK;
}

static bool stencil_turn(struct machine *m, const uint32_t *fields)
{
    for (int axis = 0; axis < 2; axis++)
        if (!spread(m, fields[0], fields[1], NULL, axis) ||
            !spread(m, fields[2], fields[1], field(m, fields[0]), axis))
            return false;
    return true;
}

static const struct kind kinds[TUNE_KINDS] = {
    [TUNE_ARITHMETIC] = {"arithmetic", 1024, 1024, 8, true, arithmetic_turn},
    [TUNE_TRAFFIC] = {"traffic", 3072, 2048, 4, true, traffic_turn},
    [TUNE_STENCIL] = {"stencil", 512, 2048, 32, false, stencil_turn},
};

/* A turn is a single call, so that the machine finds the loop. */
static void turn_again(const struct machine_call *call)
{
    struct tune_work *w = (struct tune_work *)(uintptr_t)call->words[0];
    struct machine_call known = {.again = turn_again,
                                 .name = kinds[w->kind].name,
                                 .words_count = 1,
                                 .words = {call->words[0]}};
    if (machine_call_foreseen(w->machine, &known))
        return;
    machine_begin(w->machine);
    if (kinds[w->kind].turn(w->machine, w->fields)) {
        machine_call_performed(w->machine);
    } else {
        w->failed = true;
        machine_call_failed(w->machine);
    }
}

/* ---- works ---- */

void tune_work_start(float *numbers, size_t count, uint32_t seed)
{
    uint32_t x = seed;
    for (size_t i = 0; i < count; i++) {
        x = x * 1664525u + 1013904223u;
        numbers[i] = (float)(x >> 8) / 16777216.0f;
    }
}

static bool field_fill(struct machine *m, uint32_t id, size_t count, uint32_t seed)
{
    float *numbers = malloc(count * sizeof *numbers);
    if (!numbers) {
        snprintf(error, sizeof error, "not enough memory for %zu numbers", count);
        return false;
    }
    tune_work_start(numbers, count, seed);
    bool good = machine_field_upload(m, id, MACHINE_F32, numbers) == MACHINE_OK;
    free(numbers);
    if (!good)
        snprintf(error, sizeof error, "%s", machine_error(m));
    return good;
}

size_t tune_work_count(const struct tune_work *w)
{
    return (size_t)w->height * (size_t)kinds[w->kind].width;
}

struct tune_work *tune_work_create(enum tune_kind kind, int height,
                                   const struct machine_tuning *tuning)
{
    const struct kind *k = &kinds[kind];
    struct machine_config config = machine_config_default();
    struct tune_work *w = calloc(1, sizeof *w);
    int dimensions[2] = {height ? height : k->height, k->width};
    config.tuning = tuning;
    config.eager = 0;
    if (!w) {
        snprintf(error, sizeof error, "not enough memory");
        return NULL;
    }
    w->kind = kind;
    w->height = dimensions[0];
    if (machine_create(&config, &w->machine) != MACHINE_OK) {
        snprintf(error, sizeof error, "%s",
                 w->machine ? machine_error(w->machine) : "not enough memory");
        tune_work_destroy(w);
        return NULL;
    }
    struct machine *m = w->machine;
    int set = machine_vpset_create(m, dimensions, 2);
    machine_vpset_select(m, set);
    for (uint32_t i = 0; i < FIELDS; i++) {
        w->fields[i] = machine_field_allocate(m, set, 32, MACHINE_HEAP);
        if (!w->fields[i])
            snprintf(error, sizeof error, "%s", machine_error(m));
        if (!w->fields[i] || !field_fill(m, w->fields[i], tune_work_count(w), i + 1)) {
            tune_work_destroy(w);
            return NULL;
        }
    }
    return w;
}

void tune_work_destroy(struct tune_work *w)
{
    if (!w)
        return;
    machine_destroy(w->machine);
    free(w);
}

double tune_work_run(struct tune_work *w)
{
    const struct kind *k = &kinds[w->kind];
    const struct machine_call call = {.words = {(uintptr_t)w}};
    double start = seconds_now();
    for (int i = 0; i < k->turns && !w->failed; i++) {
        turn_again(&call);
        if (k->apart && machine_flush(w->machine) != MACHINE_OK)
            w->failed = true;
    }
    if (w->failed || machine_finish(w->machine) != MACHINE_OK) {
        snprintf(error, sizeof error, "%s", machine_error(w->machine));
        return -1;
    }
    return 1e9 * (seconds_now() - start) / ((double)k->turns * (double)tune_work_count(w));
}

bool tune_work_read(struct tune_work *w, float *out)
{
    uint32_t last = w->fields[w->kind == TUNE_STENCIL ? FIELDS - 1 : 0];
    if (machine_field_download(w->machine, last, MACHINE_F32, out) == MACHINE_OK)
        return true;
    snprintf(error, sizeof error, "%s", machine_error(w->machine));
    return false;
}
