/* device_costs.c - measures the numbers of the cost model on the machine's device.
 *
 * A program of one kernel runs at several sizes and lengths. What it takes is what
 * plan/search_cost.c predicts:
 *
 *     launch + processors * (operations + bytes)
 *
 * So a small one tells what a launch costs; the difference between many and few operations,
 * what one costs; the difference between two sizes whose arrays are in the caches, what their
 * bytes cost; and arrays that are larger than any cache, what memory's cost. Each time is the
 * least of many, as other programs only add to it.
 */
#include <math.h>
#include <stdint.h>
#include <time.h>

#include "base/clock.h"
#include "base/errors.h"
#include "base/settings.h"
#include "device/device.h"
#include "values/values.h"

enum { CHAINS = 4, SAMPLES = 15, WARM = 3, BYTES_EACH = 12 };

/* One kernel: both of its fields are read, the first is stored. */
struct work {
    struct machine *machine;
    int set;
    uint32_t fields[2];
    int links; /* of each chain of products and sums; 0: a difference alone */
    bool failed;
};

/* Products and sums of numbers between 1/2 and 1, in chains that do not wait for each other. */
static struct machine_value *chains(const struct work *w, struct machine_value *a,
                                    struct machine_value *b)
{
    struct machine *m = w->machine;
    struct machine_value *x[CHAINS];
    for (int i = 0; i < CHAINS; i++)
        x[i] = machine_binary(m, MACHINE_FMUL, i ? x[i - 1] : a, b);
    for (int link = 0; link < w->links; link++)
        for (int i = 0; i < CHAINS; i++)
            x[i] = machine_binary(m, link % 2 ? MACHINE_FMUL : MACHINE_FADD, x[i], b);
    for (int i = 1; i < CHAINS; i++)
        x[0] = machine_binary(m, MACHINE_FMAX, x[0], x[i]);
    return x[0];
}

static bool turn(const struct work *w)
{
    struct machine *m = w->machine;
    struct machine_value *a = machine_field_value(m, w->fields[0], MACHINE_F32,
                                                  MACHINE_EVERYWHERE),
                         *b = machine_field_value(m, w->fields[1], MACHINE_F32,
                                                  MACHINE_EVERYWHERE);
    struct machine_value *x =
        w->links ? chains(w, a, b) : machine_binary(m, MACHINE_FSUB, b, a);
    return machine_field_store(m, w->fields[0], x, MACHINE_EVERYWHERE) == MACHINE_OK;
}

/* A turn is a call, so that the front end only looks it up. */
static void turn_again(const struct machine_call *call)
{
    struct work *w = (struct work *)(uintptr_t)call->words[0];
    struct machine_call known = {
        .again = turn_again, .name = "cost", .words_count = 1, .words = {call->words[0]}};
    if (machine_call_foreseen(w->machine, &known))
        return;
    machine_begin(w->machine);
    if (turn(w)) {
        machine_call_performed(w->machine);
    } else {
        w->failed = true;
        machine_call_failed(w->machine);
    }
}

static bool work_begin(struct work *w, struct machine *m, int rows, int columns, int links)
{
    *w = (struct work){.machine = m, .links = links};
    w->set = machine_vpset_create(m, (int[]){rows, columns}, 2);
    if (!w->set || machine_vpset_select(m, w->set))
        return false;
    for (int i = 0; i < 2; i++) {
        w->fields[i] = machine_field_allocate(m, w->set, 32, MACHINE_HEAP);
        struct machine_value *x =
            machine_to_float(m, machine_coordinate(m, 1, 20), MACHINE_F32, false);
        x = machine_binary(m, MACHINE_FMUL, x, machine_constant_float(m, MACHINE_F32, 0x1p-21));
        x = machine_binary(m, MACHINE_FADD, x, machine_constant_float(m, MACHINE_F32, 0.5));
        if (!w->fields[i] ||
            machine_field_store(m, w->fields[i], x, MACHINE_EVERYWHERE) != MACHINE_OK)
            return false;
    }
    return machine_finish(m) == MACHINE_OK;
}

static double processor_s(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t)
               ? INFINITY
               : (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What a turn takes, in nanoseconds; negative: failed. On a CPU that other programs use, too,
 * the time of the process on all units tells more than the clock; it is no measure of many
 * small launches, which leave units idle. */
static double turn_ns(struct machine *m, int rows, int columns, int links, int turns)
{
    struct work w;
    double best = INFINITY;
    bool good = work_begin(&w, m, rows, columns, links);
    const struct machine_call call = {.words = {(uintptr_t)&w}};
    for (int sample = -WARM; good && sample < SAMPLES; sample++) {
        double start = clock_s(), processor = processor_s();
        for (int i = 0; good && i < turns; i++) {
            turn_again(&call);
            good = !w.failed && machine_flush(m) == MACHINE_OK;
        }
        good = good && machine_finish(m) == MACHINE_OK;
        double s = clock_s() - start;
        if (m->device->is_cpu && rows > 1)
            s = fmin(s, (processor_s() - processor) / m->device->units);
        if (sample >= 0)
            best = fmin(best, 1e9 * s / turns);
    }
    machine_calls_forget(m); /* they name w */
    for (int i = 0; i < 2; i++)
        if (w.fields[i])
            machine_field_deallocate(m, w.fields[i]);
    if (w.set)
        machine_vpset_destroy(m, w.set);
    return good ? best : -1;
}

/* All works, with the machine's settings as a long run has them. */
static bool costs_measure(struct machine *m, double ns[MACHINE_COSTS])
{
    enum { COLUMNS = 1024, NEAR_ROWS = 32, FAR_ROWS = 8192, FEW = 20, MANY = 60 };
    bool cpu = m->device->is_cpu;
    const int rows = cpu ? 256 : 4096;
    const double processors = (double)rows * COLUMNS, near = (double)NEAR_ROWS * COLUMNS;
    double launch = turn_ns(m, 1, 64, 0, 200), few = turn_ns(m, rows, COLUMNS, FEW, 4),
           many = turn_ns(m, rows, COLUMNS, MANY, 4), far = turn_ns(m, FAR_ROWS, COLUMNS, 0, 1),
           one = turn_ns(m, NEAR_ROWS, COLUMNS, 0, 100),
           three = turn_ns(m, 3 * NEAR_ROWS, COLUMNS, 0, 100);
    if (launch < 0 || few < 0 || many < 0 || far < 0 || one < 0 || three < 0)
        return false;
    ns[MACHINE_COST_LAUNCH] = launch;
    ns[MACHINE_COST_OP] =
        (many - few) / (processors * CHAINS * (MANY - FEW)) * m->device->shape.vector;
    ns[MACHINE_COST_BYTE] = (far - launch) / ((double)FAR_ROWS * COLUMNS * BYTES_EACH);
    /* A GPU's near memory is local memory, which arrays are not in. */
    ns[MACHINE_COST_NEAR_BYTE] = cpu ? (three - one) / (2 * near * BYTES_EACH) : 0;
    for (int i = 0; i < MACHINE_COSTS; i++)
        if (!machine_cost_allows((enum machine_cost)i, ns[i]))
            ns[i] = 0;
    return true;
}

enum machine_status machine_costs_measure(struct machine *m, double ns[MACHINE_COSTS])
{
    const struct settings before = m->settings;
    const int set = machine_vpset_current(m), turns = m->device->shape.turns;
    enum machine_status status = machine_finish(m);
    for (int i = 0; i < MACHINE_COSTS; i++)
        ns[i] = 0;
    m->settings.interpret = m->settings.optimise_after = m->settings.box_after = 0;
    m->device->shape.turns = 1;
    if (!status && !costs_measure(m, ns))
        status = m->status ? m->status : MACHINE_NO_MEMORY;
    m->settings = before;
    m->device->shape.turns = turns;
    if (set)
        machine_vpset_select(m, set);
    return status;
}
