/* machine.c - creation, configuration, errors. */
#include "build/background.h"
#include "watch/watch.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

_Noreturn void machine_invariant_failed(const char *what, const char *file, int line)
{
    fprintf(stderr, "lutetia: broken invariant: %s (%s:%d)\n", what, file, line);
    abort();
}

enum machine_status machine_fail(struct machine *m, enum machine_status status,
                                 const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->error, sizeof m->error, format, arguments);
    va_end(arguments);
    m->status = status;
    return status;
}

double machine_clock_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void *machine_more(void *old, int *capacity, size_t element, bool *failed)
{
    int wanted = *capacity ? *capacity * 2 : 64;
    void *new = realloc(old, (size_t)wanted * element);
    if (!new) {
        *failed = true;
        return old;
    }
    *capacity = wanted;
    return new;
}

void *machine_grown(void *old, int *capacity, size_t element)
{
    bool failed = false;
    void *new = machine_more(old, capacity, element, &failed);
    INVARIANT(!failed);
    return new;
}

void *machine_allocated(size_t count, size_t element)
{
    void *new = calloc(count ? count : 1, element);
    INVARIANT(new != NULL);
    return new;
}

uint64_t machine_words_hash(const uint32_t *words, size_t count)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++) {
        hash = (hash ^ words[i]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

struct machine_config machine_config_default(void)
{
    return (struct machine_config){.device = NULL, .processors_count = 0, .eager = -1};
}

static enum machine_status set_processors(struct machine *m, int wanted)
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
    m->values->processors_count = (int)count;
    m->values->processors_log2 = __builtin_ctzl((unsigned long)count);
    return MACHINE_OK;
}

/* A machine with all its layers, in one piece. */
struct machine_layers {
    struct machine machine; /* first: the piece is released by its address */
    struct device device;
    struct values values;
    struct plans plans;
    struct memory memory;
    struct run run;
};

enum machine_status machine_create(const struct machine_config *config, struct machine **out)
{
    struct machine_layers *layers = calloc(1, sizeof *layers);
    struct machine *m = layers ? &layers->machine : NULL;
    *out = m;
    if (!m)
        return MACHINE_NO_MEMORY;
    m->device = &layers->device;
    m->values = &layers->values;
    m->plans = &layers->plans;
    m->memory = &layers->memory;
    m->run = &layers->run;
    if (!graph_init(m))
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an empty machine");
    enum machine_status status = settings_read(m);
    if (status)
        return status;
    m->run->eager = config->eager < 0 ? m->settings.eager : config->eager != 0;
    const char *dump = config->dump_dir ? config->dump_dir : getenv("LUTETIA_DUMP");
    if (dump && *dump)
        m->plans->dump_dir = strdup(dump);
    if (!watch_open(m, config))
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an empty machine");
    m->owner = pthread_self();
    m->values->sets_count = 1;
    m->memory->next_base = 64;
    m->values->epoch = 1;
    run_init(m);
    if (!replay_init(m))
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an empty machine");
    m->values->random_seed = 1;
    status = set_processors(m, config->processors_count);
    if (status)
        return status;
    status = device_open(m, config);
    if (!status && m->watch)
        watch_ready(m);
    return status;
}

void machine_destroy(struct machine *m)
{
    if (!m)
        return;
    m->run->calls_noted = 0; /* nobody is going to look */
    m->run->flush_due = false;
    background_finish(m);
    watch_leave(m);
    replay_finish(m);
    fields_finish(m);
    vpsets_finish(m);
    plans_finish(m);
    graph_finish(m);
    watch_close(m);
    device_close(m);
    free(m->plans->dump_dir);
    free(m);
}

void machine_leave(struct machine *m)
{
    if (m && m->device->queue && m->device->inside == 0 &&
        pthread_equal(m->owner, pthread_self())) {
        clFinish(m->device->queue);
        watch_leave(m);
    }
}

enum machine_status machine_status_last(const struct machine *m)
{
    return m->status;
}

const char *machine_error(const struct machine *m)
{
    return m ? m->error : "not enough memory for a machine";
}

void machine_error_clear(struct machine *m)
{
    m->status = MACHINE_OK;
    m->error[0] = 0;
}

int machine_processors_count(const struct machine *m)
{
    return m->values->processors_count;
}

const char *machine_device_name(const struct machine *m)
{
    return m->device->name;
}

const char *machine_device_driver(const struct machine *m)
{
    return m->device->driver;
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
                               .kernels_in_place = m->plans->kernels_in_place,
                               .kernels_in_strips = m->plans->kernels_in_strips,
                               .kernels_in_tiles = m->plans->kernels_in_tiles,
                               .predicted_s = m->plans->predicted_s,
                               .bytes_held = m->device->held_bytes,
                               .busy_s = m->device->busy_s};
}
