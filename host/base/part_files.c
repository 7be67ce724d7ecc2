/* part_files.c - see part_files.h. A handler may run at any moment and on any thread, so that a
 * name has a place of its own that is never freed, and counts once its flag is set. */
#include "part_files.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

enum { NAMES_MOST = 64, NAME_BYTES = 256 };

static struct noted {
    atomic_bool here;
    int folder;
    pid_t owner;
    char name[NAME_BYTES];
} names[NAMES_MOST];

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int names_count;
static bool for_good; /* part_files_catch() was called */

/* Those whose default action ends the process and that are no timer's or debugger's. */
static const int deadly[] = {SIGHUP,  SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGALRM, SIGILL,
                             SIGABRT, SIGBUS, SIGFPE,  SIGSEGV, SIGSYS,  SIGXCPU, SIGXFSZ};
enum { DEADLY_COUNT = sizeof deadly / sizeof *deadly };

void part_files_die(int signal_number)
{
    const int error = errno;
    const pid_t self = getpid();
    for (int i = 0; i < NAMES_MOST; i++)
        if (atomic_load(&names[i].here) && names[i].owner == self)
            unlinkat(names[i].folder, names[i].name, 0);
    struct sigaction usual = {.sa_handler = SIG_DFL};
    sigset_t this_one;
    sigaction(signal_number, &usual, NULL);
    sigemptyset(&this_one);
    sigaddset(&this_one, signal_number);
    raise(signal_number);
    pthread_sigmask(SIG_UNBLOCK, &this_one, NULL);
    errno = error;
}

/* Installs the handler where the default action is, or puts the default action back where the
 * handler still is. */
static void catch_all(bool on)
{
    struct sigaction ours = {.sa_handler = part_files_die, .sa_flags = SA_ONSTACK | SA_RESTART},
                     usual = {.sa_handler = SIG_DFL}, now;
    for (int i = 0; i < DEADLY_COUNT; i++)
        if (sigaction(deadly[i], NULL, &now) == 0 && !(now.sa_flags & SA_SIGINFO) &&
            now.sa_handler == (on ? SIG_DFL : part_files_die))
            sigaction(deadly[i], on ? &ours : &usual, NULL);
}

void part_files_catch(void)
{
    pthread_mutex_lock(&lock);
    for_good = true;
    catch_all(true);
    pthread_mutex_unlock(&lock);
}

/* A forked child begins with none of its parent's names. */
static void parents_forget(pid_t self)
{
    for (int i = 0; i < NAMES_MOST; i++)
        if (atomic_load(&names[i].here) && names[i].owner != self) {
            atomic_store(&names[i].here, false);
            names_count--;
        }
}

int part_file_note(int folder, const char *name)
{
    const pid_t self = getpid();
    int number = 0;
    if (strlen(name) >= NAME_BYTES)
        return 0;
    pthread_mutex_lock(&lock);
    parents_forget(self);
    for (int i = 0; i < NAMES_MOST && !number; i++)
        if (!atomic_load(&names[i].here))
            number = i + 1;
    if (number) {
        struct noted *n = &names[number - 1];
        n->folder = folder;
        n->owner = self;
        strcpy(n->name, name);
        atomic_store(&n->here, true);
        if (names_count++ == 0)
            catch_all(true);
    }
    pthread_mutex_unlock(&lock);
    return number;
}

void part_file_forget(int number)
{
    if (!number)
        return;
    pthread_mutex_lock(&lock);
    struct noted *n = &names[number - 1];
    if (atomic_load(&n->here) && n->owner == getpid()) {
        atomic_store(&n->here, false);
        if (--names_count == 0 && !for_good)
            catch_all(false);
    }
    pthread_mutex_unlock(&lock);
}
