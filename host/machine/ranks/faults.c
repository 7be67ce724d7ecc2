/* faults.c - see faults.h. */
#include "ranks/faults.h"

#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>
#include <visible_text.h>

#include "base/clock.h"
#include "ranks/mpi.h"

/* How long rank 0 waits for the others to come; QUIET: a word that the run ends, and that
 * somebody has said why. */
enum { MEETING_S = 20, QUIET = 'q' };

struct card {
    uint8_t secret[16];
    uint32_t rank;
};

static int door_now = -1, sockets[RANKS_MOST]; /* by rank; of others the first is rank 0's */
static char names_now[RANKS_MOST][RANKS_NAME_BYTES];
static _Atomic bool over;

void faults_are_over(void)
{
    atomic_store(&over, true);
}

/* ---- threads ---- */

static void end_all(int rank)
{
    const char quiet = QUIET;
    visible_say("rank %d of %d (on %s) has ended: all others end, too", rank, ranks_count(),
                names_now[rank]);
    for (int i = 1; i < ranks_count(); i++)
        if (sockets[i] >= 0)
            (void)!write(sockets[i], &quiet, 1);
    _exit(1);
}

static void *look_at_all(void *unused)
{
    struct pollfd at[RANKS_MOST];
    (void)unused;
    for (;;) {
        const int count = ranks_count();
        for (int i = 0; i < count; i++)
            at[i] = (struct pollfd){.fd = i ? sockets[i] : -1, .events = POLLIN};
        if (poll(at, (nfds_t)count, -1) < 0)
            continue;
        if (atomic_load(&over))
            return NULL;
        for (int i = 1; i < count; i++)
            if (at[i].revents)
                end_all(i);
    }
}

static void *look_at_first(void *unused)
{
    char word = 0;
    (void)unused;
    const ssize_t got = read(sockets[0], &word, 1);
    if (atomic_load(&over))
        return NULL;
    if ((got != 1 || word != QUIET) && ranks_mine() == 1)
        visible_say("rank 0 of %d (on %s) has ended: all others end, too", ranks_count(),
                    names_now[0]);
    _exit(1);
}

/* Without signals, which are the program's. */
static bool look(void *(*at)(void *))
{
    pthread_t thread;
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    const bool begun = pthread_create(&thread, NULL, at, NULL) == 0;
    if (begun)
        pthread_detach(thread);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return begun;
}

/* ---- connections ---- */

void faults_open(struct faults_door *door)
{
    struct sockaddr_in here = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_ANY)};
    socklen_t bytes = sizeof here;
    *door = (struct faults_door){.port = 0};
    for (int i = 0; i < RANKS_MOST; i++)
        sockets[i] = -1;
    if (getrandom(door->secret, sizeof door->secret, 0) != (ssize_t)sizeof door->secret)
        return;
    door_now = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (door_now >= 0 && bind(door_now, (struct sockaddr *)&here, sizeof here) == 0 &&
        listen(door_now, RANKS_MOST) == 0 &&
        getsockname(door_now, (struct sockaddr *)&here, &bytes) == 0)
        door->port = ntohs(here.sin_port);
}

/* Takes one that comes; whoever does not know the secret is sent away. */
static int meet_one(const struct faults_door *door)
{
    struct card card;
    const struct timeval most = {.tv_sec = 1};
    const int it = accept4(door_now, NULL, NULL, SOCK_CLOEXEC);
    if (it < 0)
        return 0;
    setsockopt(it, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
    if (recv(it, &card, sizeof card, MSG_WAITALL) != (ssize_t)sizeof card ||
        memcmp(card.secret, door->secret, sizeof card.secret) != 0 || card.rank < 1 ||
        card.rank >= (uint32_t)ranks_count() || sockets[card.rank] >= 0) {
        close(it);
        return 0;
    }
    sockets[card.rank] = it;
    return 1;
}

bool faults_meet(const struct faults_door *door, const char (*names)[RANKS_NAME_BYTES])
{
    const double until = clock_s() + MEETING_S;
    int come = 1;
    memcpy(names_now, names, (size_t)ranks_count() * sizeof *names);
    while (door->port && come < ranks_count() && clock_s() < until) {
        struct pollfd at = {.fd = door_now, .events = POLLIN};
        if (poll(&at, 1, 100) > 0)
            come += meet_one(door);
    }
    if (door_now >= 0)
        close(door_now);
    door_now = -1;
    return look(look_at_all) && come == ranks_count();
}

static int connected(const struct faults_door *door, const char *name)
{
    char port[16];
    const struct addrinfo of = {.ai_family = AF_INET, .ai_socktype = SOCK_STREAM};
    struct addrinfo *all = NULL;
    int it = -1;
    snprintf(port, sizeof port, "%u", door->port);
    if (getaddrinfo(name, port, &of, &all) != 0)
        return -1;
    for (const struct addrinfo *a = all; a && it < 0; a = a->ai_next) {
        it = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (it >= 0 && connect(it, a->ai_addr, a->ai_addrlen) != 0) {
            close(it);
            it = -1;
        }
    }
    freeaddrinfo(all);
    return it;
}

void faults_join(const struct faults_door *door, const char *name, bool same_computer)
{
    struct card card = {.rank = (uint32_t)ranks_mine()};
    memcpy(card.secret, door->secret, sizeof card.secret);
    memcpy(names_now[0], name, sizeof names_now[0]);
    sockets[0] = door->port ? connected(door, same_computer ? "127.0.0.1" : name) : -1;
    if (sockets[0] >= 0 &&
        send(sockets[0], &card, sizeof card, MSG_NOSIGNAL) == (ssize_t)sizeof card)
        look(look_at_first);
}
