/* process.c - see process.h. */
#include "base/process.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

static _Atomic pid_t now;

static void ask(void)
{
    atomic_store(&now, getpid());
}

static void begin(void)
{
    ask();
    pthread_atfork(NULL, NULL, ask);
}

void process_forked(void)
{
    ask();
}

pid_t process_now(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, begin);
    return atomic_load(&now);
}
