/* watchdog.c - a hook cannot stop Lua's loops in C (a pattern that backtracks for years), nor a
 * trusted script's finalizers. A thread beside the script notices that the script should have
 * stopped long ago, and tells the host.
 *
 *          deadline, or the host says stop
 *     ------------|--------------------------|------------------------------------|
 *       runs      | the hook stops it        | overdue(), unless papers are at work | overdue()
 */
#include "script_internal.h"

#include <resident.h>

#include <time.h>

#define LOOK_S 0.004 /* a process takes some 4 MB in that time */
/* the factor of the grace period while papers are at work that would be lost: kernels may have
 * to be compiled */
#define PATIENCE 30
#define OVERFULL_MORE_BYTES                                                                    \
    ((double)(8 << 20)) /* what is over is told; so much more is ended */

/* Whether the script should have stopped, and since when this is known. */
static bool overdue(struct script *script, double *since_s)
{
    struct script_watchdog *w = &script->watchdog;
    double now = script_clock_s();
    if (!script_due(script)) {
        *since_s = 0;
        return false;
    }
    if (*since_s == 0)
        *since_s = now;
    if (*since_s < w->grace_from_s)
        *since_s = w->grace_from_s;
    const struct script_config *config = script->config;
    const bool saved = config->patient || (config->keeps && script_interrupted(script));
    const double grace_s = config->grace_s * (atomic_load(&w->at_work) && saved ? PATIENCE : 1);
    return now - *since_s > grace_s;
}

static void *watch(void *context)
{
    struct script *script = context;
    struct script_watchdog *w = &script->watchdog;
    double since_s = 0;
    pthread_mutex_lock(&w->lock);
    while (!w->over) {
        struct timespec until;
        if (w->paused) {
            pthread_cond_wait(&w->changed, &w->lock);
            continue;
        }
        clock_gettime(CLOCK_MONOTONIC, &until);
        until.tv_nsec += (long)(LOOK_S * 1e9);
        until.tv_sec += until.tv_nsec / 1000000000;
        until.tv_nsec %= 1000000000;
        pthread_cond_timedwait(&w->changed, &w->lock, &until);
        if (w->over || w->paused)
            continue;
        const double more = script_overfull_bytes(script);
        if (more > 0)
            atomic_store(&w->overfull, true);
        if (more > OVERFULL_MORE_BYTES && script->host->overfull)
            script->host->overfull(script->host->context);
        if (overdue(script, &since_s))
            script->host->overdue(script->host->context);
    }
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

bool script_watchdog_start(struct script *script)
{
    struct script_watchdog *w = &script->watchdog;
    if (!script->host->overdue)
        return true;
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, &attributes);
    pthread_condattr_destroy(&attributes);
    w->running = pthread_create(&w->thread, NULL, watch, script) == 0;
    if (!w->running) {
        pthread_cond_destroy(&w->changed);
        pthread_mutex_destroy(&w->lock);
    }
    return w->running;
}

void script_watchdog_end(struct script *script)
{
    struct script_watchdog *w = &script->watchdog;
    if (!w->running)
        return;
    pthread_mutex_lock(&w->lock);
    w->over = true;
    pthread_cond_signal(&w->changed);
    pthread_mutex_unlock(&w->lock);
    pthread_join(w->thread, NULL);
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->lock);
    w->running = false;
}

void script_watchdog_pause(struct script *script, bool paused)
{
    struct script_watchdog *w = &script->watchdog;
    if (!w->running)
        return;
    pthread_mutex_lock(&w->lock);
    w->paused = paused;
    pthread_cond_signal(&w->changed);
    w->grace_from_s = script_clock_s();
    pthread_mutex_unlock(&w->lock);
}

void script_at_work(struct script *script, bool at_work)
{
    atomic_store(&script->watchdog.at_work, at_work);
}
