/* create.c - creates a machine with all its layers, and destroys it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "device/code_pages.h"
#include "forks.h"
#include "machine_told.h"
#include "measure/copies.h"
#include "memory/memory.h"
#include "plans/background.h"
#include "plans/plans.h"
#include "run/at_once_when.h"
#include "run/evaluate.h"
#include "run/replay.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "with_ranks.h"

struct machine_config machine_config_default(void)
{
    return (struct machine_config){.device = NULL, .processors_count = 0, .eager = -1};
}

static enum machine_status processors_choose(struct machine *m, int wanted, int *out)
{
    long count = wanted;
    if (count == 0 && m->settings.processors != SETTING_FREE)
        count = (long)m->settings.processors;
    if (count == 0)
        count = 65536;
    if (count < 1 || count > (1L << 30) || (count & (count - 1)))
        return machine_fail(
            m, MACHINE_BAD_ARGUMENT,
            "the number of processors must be a power of two from 1 to 2^30 (is %ld)", count);
    *out = (int)count;
    return MACHINE_OK;
}

/* What a machine holds above its device. */
struct content {
    struct values values;
    struct plans plans;
    struct memory memory;
    struct run run;
};

/* A machine and all its layers, allocated in one piece. */
struct machine_layers {
    struct machine machine; /* first: the whole is freed by this address */
    struct device device;
    struct content content;
};

static void layers_join(struct machine_layers *l)
{
    l->machine.values = &l->content.values;
    l->machine.plans = &l->content.plans;
    l->machine.memory = &l->content.memory;
    l->machine.run = &l->content.run;
}

/* Written here: pages of calloc()'s may be given only when the program's first calls look at
 * them, which takes them some microseconds. */
static struct machine_layers *layers_allocate(void)
{
    const size_t bytes =
        (sizeof(struct machine_layers) + LINE_BYTES - 1) / LINE_BYTES * LINE_BYTES;
    struct machine_layers *l = aligned_alloc(LINE_BYTES, bytes);
    if (l)
        memset(l, 0, sizeof *l);
    return l;
}

/* Tells the observers which device it is. */
static void be_watched(struct machine *m)
{
    char title[400];
    struct device_buffer *scratch = device_buffer_get(m, 64);
    snprintf(title, sizeof title, "%d processors on %s", m->values->processors_count,
             m->device->name);
    watch_ready(m, m->device->queue, scratch ? device_mem(scratch) : NULL, title);
    if (scratch)
        device_buffer_unref(m, scratch);
    machine_error_clear(m); /* commands without times: later commands must do */
    struct watch_sums *sums = watch_explain(m);
    if (sums)
        copies_ready(m, sums);
}

/* The content of a machine that has done nothing yet; it was zero. */
static void content_begin(struct machine *m, int processors)
{
    m->values->processors_count = processors;
    m->values->processors_log2 = __builtin_ctzl((unsigned long)processors);
    m->values->sets_count = 1;
    m->memory->next_base = 64;
    m->values->epoch = 1;
    m->values->random_seed = 1;
    evaluate_init(m);
}

static enum machine_status content_tables(struct machine *m)
{
    return graph_init(m) && record_init(m)
               ? MACHINE_OK
               : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an empty machine");
}

static void sequencers_destroy(struct machine *m)
{
    struct sequencers *q = m->sequencers;
    if (!q)
        return;
    m->sequencers = NULL;
    if (q->far)
        ranks_machines_destroy(m);
    for (int i = 0; i < q->machines_count; i++) {
        struct machine *s = q->machines[i];
        background_finish(s);
        plans_finish(s);
        if (s->device != m->device)
            device_sub_close(s, m, i);
        free(s->values->sets);
        free(s);
    }
    free(q->cuts);
    free(q);
}

/* One sequencer's machine: all share the front end's device, or each has its own. NULL: error
 * set. */
static struct machine *sequencer_create(struct machine *m, int which, bool apart)
{
    struct machine_layers *layers = layers_allocate();
    if (!layers) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for blocks");
        return NULL;
    }
    struct machine *s = &layers->machine;
    s->device = apart ? &layers->device : m->device;
    s->settings = m->settings;
    s->owner = m->owner;
    s->watch = m->watch;
    s->front = m;
    layers_join(layers);
    content_begin(s, m->values->processors_count);
    if (apart && device_sub_open(s, m, which)) {
        device_sub_close(s, m, which);
        free(layers);
        return NULL;
    }
    return s;
}

/* One block for all: nobody, and functions are called directly. */
static enum machine_status sequencers_create(struct machine *m)
{
    if (m->settings.blocks < 2)
        return MACHINE_OK;
    struct sequencers *q = calloc(1, sizeof *q);
    if (!q)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for blocks");
    m->sequencers = q;
    q->count = (int)m->settings.blocks;
    q->far = ranks_are_of(m);
    if (q->far && ranks_machines_make(m, &q->far_near))
        return m->status;
    const bool apart = device_subs_count(m->device) == q->count;
    const int wanted = apart ? q->count : 1;
    while (q->machines_count < wanted &&
           (q->machines[q->machines_count] = sequencer_create(m, q->machines_count, apart)))
        q->machines_count++;
    return q->machines_count == wanted ? MACHINE_OK : m->status;
}

static void content_finish(struct machine *m)
{
    m->run->calls_noted = 0; /* nothing reads the noted calls' results any more */
    m->run->flush_due = false;
    background_finish(m);
    watch_leave(m);
    record_finish(m);
    fields_finish(m);
    vpsets_finish(m);
    plans_finish(m);
    graph_finish(m);
    sequencers_destroy(m);
}

enum machine_status machine_create(const struct machine_config *config, struct machine **out)
{
    struct machine_layers *layers = layers_allocate();
    struct machine *m = layers ? &layers->machine : NULL;
    int processors = 0;
    *out = m;
    if (!m)
        return MACHINE_NO_MEMORY;
    m->device = &layers->device;
    layers_join(layers);
    enum machine_status status = settings_read(m);
    status = status ? status : ranks_settings(m, config);
    if (status)
        return status;
    m->settings.eager = config->eager < 0 ? m->settings.eager : config->eager != 0;
    const char *dump = config->dump_dir ? config->dump_dir : getenv("LUTETIA_DUMP");
    if (dump && *dump)
        m->plans->dump_dir = strdup(dump);
    if (!watch_open(m, config))
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an empty machine");
    m->owner = pthread_self();
    status = processors_choose(m, config->processors_count, &processors);
    if (status)
        return status;
    content_begin(m, processors);
    status = device_open(m, config);
    if (!status)
        forks_machine_made(m);
    /* After the driver, which takes milliseconds and all of the caches: so they are near when
     * the program begins. */
    status = status ? status : content_tables(m);
    status = status ? status : sequencers_create(m);
    if (!status && m->watch)
        be_watched(m);
    if (!status)
        code_pages_near();
    return status;
}

void machine_destroy(struct machine *m)
{
    if (!m)
        return;
    forks_machine_gone(m);
    content_finish(m);
    ranks_are_free(m);
    watch_close(m);
    device_close(m);
    free(m->plans->dump_dir);
    free(m);
}

bool machine_warms_up(const struct machine *m)
{
    return at_once_may(m) == AT_ONCE_SOMETIMES && device_is_ours(m->device) &&
           !m->settings.eager && !m->plans->dump_dir;
}

enum machine_status machine_empty(struct machine *m)
{
    struct content *c = &((struct machine_layers *)m)->content;
    const int processors = m->values->processors_count;
    char *dump_dir = m->plans->dump_dir;
    content_finish(m);
    memset(c, 0, sizeof *c);
    m->plans->dump_dir = dump_dir;
    content_begin(m, processors);
    enum machine_status status = content_tables(m);
    return status ? status : sequencers_create(m);
}

void machine_leave(struct machine *m)
{
    if (m && pthread_equal(m->owner, pthread_self())) {
        choosing_stop(m);
        background_leave(m);
        for (int i = 0; m->sequencers && i < m->sequencers->machines_count; i++) {
            choosing_stop(m->sequencers->machines[i]);
            background_leave(m->sequencers->machines[i]);
        }
        aside_end(&m->device->code);
    }
    if (m && m->device->queue && device_is_ours(m->device) && m->inside == 0 &&
        pthread_equal(m->owner, pthread_self())) {
        clFinish(m->device->queue);
        device_subs_wait(m->device);
        watch_leave(m);
    }
}

void machine_work_time(struct machine *m, bool timed)
{
    m->device->work_timed = timed;
}

/* What a sequencer has done, and its device, if that is not the front end's. */
static void stats_add(const struct machine *m, const struct machine *sequencer,
                      struct machine_stats *out)
{
    const struct plans *in_blocks = sequencer->plans;
    const struct device *d = sequencer->device;
    out->interpreted += in_blocks->interpreted;
    out->kernels_in_place += in_blocks->kernels_in_place;
    out->kernels_in_strips += in_blocks->kernels_in_strips;
    out->kernels_in_tiles += in_blocks->kernels_in_tiles;
    out->predicted_s += in_blocks->predicted_s;
    if (d == m->device)
        return;
    out->kernels_built += d->kernels_built;
    out->kernels_built_background += d->kernels_built_background;
    out->kernels_run += d->kernels_run;
    out->bytes_held += d->held_bytes;
    out->bytes_peak += d->peak_bytes;
    out->busy_s += d->busy_s;
}

void machine_stats_get(const struct machine *m, struct machine_stats *out)
{
    *out =
        (struct machine_stats){.stores = m->run->stores,
                               .values_live = m->values->live,
                               .calls_foreseen = m->run->calls_foreseen,
                               .flushes = m->run->flushes,
                               .plans_built = m->plans->built,
                               .kernels_built = m->device->kernels_built,
                               .kernels_built_background = m->device->kernels_built_background,
                               .kernels_run = m->device->kernels_run,
                               .interpreted = m->plans->interpreted,
                               .kernels_in_place = m->plans->kernels_in_place,
                               .kernels_in_strips = m->plans->kernels_in_strips,
                               .kernels_in_tiles = m->plans->kernels_in_tiles,
                               .predicted_s = m->plans->predicted_s,
                               .bytes_held = m->device->held_bytes,
                               .bytes_peak = m->device->peak_bytes,
                               .busy_s = m->device->busy_s};
    for (int i = 0; m->sequencers && i < m->sequencers->machines_count; i++)
        stats_add(m, m->sequencers->machines[i], out);
}
