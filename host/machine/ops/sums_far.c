/* sums_far.c - see sums_far.h. */
#include "ops/sums_far.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "ranks/ranks.h"

/* near_sums()'s arguments; the arrays by their numbers (0: none). */
struct question {
    struct vpset set;
    struct near_sum what;
    uint32_t numbers, context;
    uint64_t run, runs;
};

void sums_far_ask(int rank, const struct vpset *s, const struct near_sum *what, size_t run,
                  size_t runs)
{
    struct question q;
    memset(&q, 0, sizeof q); /* its gaps, too, are sent */
    q.set = *s;
    q.what = *what;
    q.what.numbers = q.what.context = NULL;
    q.numbers = what->numbers->far;
    q.context = what->context ? what->context->far : 0;
    q.run = run;
    q.runs = runs;
    ranks_command(rank, (struct ranks_command){RANKS_REDUCE, sizeof q, {0}}, &q);
}

void sums_far_take(int rank, struct machine_scalar *sums, size_t runs)
{
    ranks_reply_take(rank, sums, runs * sizeof *sums);
}

bool sums_far_answer(struct machine *m, const struct far_table *arrays, const void *question,
                     size_t bytes)
{
    struct question q;
    if (bytes != sizeof q)
        return false;
    memcpy(&q, question, sizeof q);
    q.what.numbers = far_table_of(arrays, q.numbers);
    q.what.context = q.context ? far_table_of(arrays, q.context) : NULL;
    if (!q.what.numbers || (q.context && !q.what.context) || !q.runs)
        return false;
    struct machine_scalar *sums = calloc(q.runs, sizeof *sums);
    NEEDS_MEMORY(sums);
    const bool good = near_sums(m, &q.set, &q.what, q.run, sums);
    if (good)
        ranks_reply(sums, q.runs * sizeof *sums);
    free(sums);
    return good;
}
