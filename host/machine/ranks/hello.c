/* hello.c - ranks meet, and see whether they are alike: see ranks.h.
 *
 * What differs would be wrong bits later, or a wait without an end; now it is a line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <visible_text.h>

#include "base/settings.h"
#include "ranks/faults.h"
#include "ranks/mpi.h"
#include "ranks/processes.h"

enum { SETTINGS_BYTES = 4096, ORDER = 0x01020304 };

struct hello {
    uint32_t order, bytes; /* first: of this structure */
    char version[32], name[RANKS_NAME_BYTES], settings[SETTINGS_BYTES];
};

struct welcome {
    struct faults_door door;
    uint32_t good;
    char names[RANKS_MOST][RANKS_NAME_BYTES];
};

static void hello_fill(struct hello *h)
{
    memset(h, 0, sizeof *h);
    h->order = ORDER;
    h->bytes = sizeof *h;
    snprintf(h->version, sizeof h->version, "%s", LUTETIA_VERSION);
    if (gethostname(h->name, sizeof h->name - 1) != 0)
        snprintf(h->name, sizeof h->name, "localhost");
    settings_text(h->settings, sizeof h->settings);
}

/* The line of a variable; NULL: it is not set. */
static const char *line_of(const char *settings, const char *line, size_t name)
{
    while (*settings && strncmp(settings, line, name) != 0)
        settings += strcspn(settings, "\n") + 1;
    return *settings ? settings : NULL;
}

/* Says which variable differs first of those that a has. */
static bool differs(const struct hello *a, int of_a, const struct hello *b, int of_b)
{
    for (const char *line = a->settings; *line;) {
        const size_t name = strcspn(line, "=") + 1, length = strcspn(line, "\n");
        const char *other = line_of(b->settings, line, name);
        if (!other || strncmp(other, line, length + 1) != 0) {
            visible_say("ranks differ in their settings: rank %d (on %s) has %.*s, rank %d (on "
                        "%s) %s%.*s",
                        of_a, a->name, (int)length, line, of_b, b->name,
                        other ? "" : "does not set it", other ? (int)strcspn(other, "\n") : 0,
                        other ? other : "");
            return true;
        }
        line += length + 1;
    }
    return false;
}

static bool alike(const struct hello *first, const struct hello *h, int rank)
{
    if (h->order != first->order || h->bytes != first->bytes) {
        visible_say(
            "rank %d is of another kind of computer, or of another Lutetia, than rank 0", rank);
        return false;
    }
    if (strcmp(h->version, first->version) != 0) {
        visible_say("ranks differ: rank 0 (on %s) is Lutetia %s, rank %d (on %s) %s",
                    first->name, first->version, rank, h->name, h->version);
        return false;
    }
    return !differs(first, 0, h, rank) && !differs(h, rank, first, 0);
}

static int on_node(const struct welcome *w, int mine, int count)
{
    int alike_names = 0;
    for (int i = 0; i < count; i++)
        alike_names += strcmp(w->names[i], w->names[mine]) == 0;
    return alike_names;
}

static void say_to(int rank, const void *what, size_t bytes)
{
    struct mpi_request sent;
    mpi_send(rank, MPI_TAG_DATA, what, bytes, &sent);
    mpi_wait(&sent, 1);
}

static void hear_from(int rank, void *what, size_t bytes)
{
    struct mpi_request got;
    mpi_take(rank, MPI_TAG_DATA, what, bytes, &got);
    mpi_wait(&got, 1);
}

static bool welcome_all(const struct hello *first, int count)
{
    struct welcome w = {.good = true};
    struct hello h;
    memcpy(w.names[0], first->name, sizeof w.names[0]);
    for (int i = 1; i < count; i++) {
        hear_from(i, &h, sizeof h);
        if (w.good)
            w.good = alike(first, &h, i);
        h.name[sizeof h.name - 1] = 0;
        memcpy(w.names[i], h.name, sizeof w.names[i]);
    }
    faults_open(&w.door);
    for (int i = 1; i < count; i++)
        say_to(i, &w, sizeof w);
    if (!w.good)
        return false;
    processes_are(count, 0, on_node(&w, 0, count));
    if (!faults_meet(&w.door, w.names))
        visible_say("some ranks cannot be reached by TCP: if one ends, others may wait for it");
    return true;
}

static bool be_welcome(const struct hello *mine, int count)
{
    struct welcome w;
    const int rank = mpi_rank();
    say_to(0, mine, sizeof *mine);
    hear_from(0, &w, sizeof w);
    if (!w.good)
        return false;
    processes_are(count, rank, on_node(&w, rank, count));
    faults_join(&w.door, w.names[0], strcmp(w.names[0], w.names[rank]) == 0);
    return true;
}

bool ranks_join(const struct ranks_starter *starter)
{
    char why[200];
    struct hello mine;
    if (!mpi_begin(why, sizeof why)) {
        if (starter->mine == 0)
            visible_say("%s is %d, but %s: the program cannot be one of several processes",
                        starter->name, starter->count, why);
        return false;
    }
    const int count = mpi_size();
    if (count == 1 || count > RANKS_MOST) {
        if (count == 1 ? starter->mine == 0 : mpi_rank() == 0)
            visible_say(count == 1
                            ? "%s is %d, but MPI knows of one process alone: was another MPI's "
                              "mpirun called, or srun without PMIx (--mpi=pmix)?"
                            : "%s is %d, and there may be 64 ranks at most",
                        starter->name, starter->count);
        mpi_finish();
        return false;
    }
    hello_fill(&mine);
    if (mpi_rank() ? be_welcome(&mine, count) : welcome_all(&mine, count)) {
        if (ranks_on_node() > (int)sysconf(_SC_NPROCESSORS_ONLN))
            mpi_is_crowded();
        return true;
    }
    mpi_finish();
    return false;
}
