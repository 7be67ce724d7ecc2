/* forks.c - see forks.h.
 *
 * The lock is never held while something is waited for: a thread of the driver may fork, too
 * (to link a kernel), and comes by here. */
#include "forks.h"

#include <pthread.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/parts.h"
#include "base/process.h"
#include "device/device.h"
#include "machine_inside.h"
#include "plans/background.h"
#include "sequencers/sequencers.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct machine *machines; /* by made_before */

/* The next machine of this thread after that one (NULL: the first) that can wait. */
static struct machine *next_of_thread(const struct machine *after)
{
    pthread_mutex_lock(&lock);
    struct machine *m = after ? after->made_before : machines;
    while (m && (!pthread_equal(m->owner, pthread_self()) || m->inside))
        m = m->made_before;
    pthread_mutex_unlock(&lock);
    return m;
}

static void before_fork(void)
{
    for (struct machine *m = next_of_thread(NULL); m; m = next_of_thread(m))
        if (device_is_ours(m->device)) {
            device_settle(m);
            background_rest(m);
            for (int i = 0; m->sequencers && i < m->sequencers->machines_count; i++)
                background_rest(m->sequencers->machines[i]);
        }
}

static void in_child_of(struct machine *m)
{
    m->watch = NULL;
    m->settings.near = m->settings.near ? m->settings.near : 1;
}

/* Other threads are gone, whatever they were doing. Children tell nothing about their parent's
 * machines. */
static void in_child(void)
{
    pthread_mutex_init(&lock, NULL);
    for (struct machine *m = machines; m; m = m->made_before) {
        in_child_of(m);
        for (int i = 0; m->sequencers && i < m->sequencers->machines_count; i++)
            in_child_of(m->sequencers->machines[i]);
    }
}

/* The kernel's call: fork() waits for locks of malloc and stdio, and from glibc 2.41 on for
 * abort()'s, which a process that was aborted holds. */
pid_t machine_fork_bare(void)
{
    before_fork();
#ifdef SYS_fork
    const pid_t child = (pid_t)syscall(SYS_fork);
#else
    const pid_t child = (pid_t)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
#endif
    if (child == 0) {
        process_forked();
        in_child();
    }
    return child;
}

static void begin(void)
{
    pthread_atfork(before_fork, NULL, in_child);
}

void forks_machine_made(struct machine *m)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, begin);
    pthread_mutex_lock(&lock);
    m->made_before = machines;
    machines = m;
    pthread_mutex_unlock(&lock);
}

void forks_machine_gone(struct machine *m)
{
    pthread_mutex_lock(&lock);
    struct machine **at = &machines;
    while (*at && *at != m)
        at = &(*at)->made_before;
    if (*at)
        *at = m->made_before;
    pthread_mutex_unlock(&lock);
}
