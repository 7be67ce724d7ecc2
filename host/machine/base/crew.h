/* crew.h - threads that share out one piece of work with the caller.
 *
 *     struct crew *crew = crew_create (2);                 the caller and one thread more
 *     crew_run (crew, 8, add_part, &sum);                  add_part (&sum, 0, worker) to
 *                                                          add_part (&sum, 7, worker), in any
 *                                                          order
 *     crew_errand (crew, fetch, &book);                    fetch (&book, true), by the way;
 *                                                          nobody waits for it
 *     crew_destroy (crew);
 *
 * Who is free takes the next part, so a thread that the system does not run costs nothing but
 * its share. But one that it stops in the middle of a part makes the caller wait: after that
 * short work is not shared out for a while. A thread looks for work for some microseconds and
 * then sleeps. No thread takes a signal. In a child after fork() there are no threads, and the
 * caller does all parts. */
#ifndef LUTETIA_MACHINE_CREW_H
#define LUTETIA_MACHINE_CREW_H

#include <stdbool.h>

enum { CREW_MOST = 16 };

struct crew;

/* worker: 0 is the caller, below CREW_MOST. */
typedef void crew_part(void *context, int part, int worker);
/* wanted: else the crew ends, and only what the context holds is let go of. */
typedef void crew_errand_work(void *context, bool wanted);

/* For so many threads, the caller among them; none begins before there is work. NULL: no
 * memory, or only one. */
struct crew *crew_create(int threads);
/* In nanoseconds. The least work that is shared out: where a thread looks for work; where all
 * sleep, and one must be woken; where one was late a short time ago, since others' programs run
 * on its processor; between two threads that are apart, and the more threads the less. The
 * least part of it. How long a word may be on its way to a thread and back; beyond, they are
 * apart. */
struct crew_costs {
    double awake, asleep, late, apart, part, trip;
};
/* How many parts to make of work that takes one thread so long, in nanoseconds; 1: it is not
 * shared out. */
int crew_parts(struct crew *crew, double work, const struct crew_costs *costs);
/* crew NULL: the caller does all. Returns when all parts are done. One caller at a time. Now
 * and then it measures how far threads are apart. */
void crew_run(struct crew *crew, int parts, crew_part *function, void *context);
/* Begins the threads, and measures how far they are apart, if one comes within a fraction of a
 * millisecond. NULL is fine. */
void crew_meet(struct crew *crew);
/* What a thread does by the way, while there is nothing to share out; nobody waits for it.
 * False: there is no thread for it, or enough of such work already. */
bool crew_errand(struct crew *crew, crew_errand_work *work, void *context);
/* How long a word was on its way to a thread and back when it was last measured, in
 * nanoseconds; 0: it never was. */
double crew_trip(const struct crew *crew);
/* How many may be at work. */
int crew_size(const struct crew *crew);
void crew_destroy(struct crew *crew);

#endif
