/* shrink.c - makes a failing program small. It removes runs of instructions, first halves of
 * the program, at last single instructions. It then simplifies the rest (a smaller sheet, no
 * offsets, round constants, shorter lengths), and begins again until nothing helps. The order
 * of tries is fixed, so the same failure shrinks to the same program. */
#include <string.h>

#include "program.h"

enum { RUNS_MAX = 4000 };

struct shrinker {
    struct program *p, candidate;
    program_fails fails;
    void *context;
    int runs;
};

/* Keeps the candidate if it still fails. */
static bool try_candidate(struct shrinker *s)
{
    if (s->runs >= RUNS_MAX)
        return false;
    program_normalise(&s->candidate);
    s->runs++;
    if (!s->fails(s->context, &s->candidate))
        return false;
    *s->p = s->candidate;
    return true;
}

static bool remove_runs(struct shrinker *s)
{
    bool better = false;

    for (int length = s->p->count / 2; length > 0; length /= 2)
        for (int at = s->p->count - length; at >= 0;) {
            s->candidate = *s->p;
            memmove(&s->candidate.code[at], &s->candidate.code[at + length],
                    (size_t)(s->candidate.count - at - length) * sizeof s->candidate.code[0]);
            s->candidate.count -= length;
            if (try_candidate(s)) {
                better = true;
                if (at > s->p->count - length)
                    at = s->p->count - length;
            } else {
                at -= length;
            }
        }
    return better;
}

static bool remove_sets(struct shrinker *s)
{
    s->candidate = *s->p;
    if (s->candidate.sets_count == 1)
        return false;
    s->candidate.sets_count--;
    return try_candidate(s);
}

static bool plainer_geometry(struct shrinker *s)
{
    bool better = false;

    for (int set = 0; set < s->p->sets_count; set++)
        for (int axis = 0; axis < s->p->sets[set].rank; axis++) {
            while (s->p->sets[set].lengths[axis] > 1) {
                s->candidate = *s->p;
                s->candidate.sets[set].lengths[axis] /= 2;
                if (!try_candidate(s)) {
                    s->candidate = *s->p;
                    s->candidate.sets[set].lengths[axis]--;
                    if (!try_candidate(s))
                        break;
                }
                better = true;
            }
            if (s->p->sets[set].lengths[axis] == 1 && s->p->sets[set].rank > 1) {
                struct geometry *g;

                s->candidate = *s->p;
                g = &s->candidate.sets[set];
                memmove(&g->lengths[axis], &g->lengths[axis + 1],
                        (size_t)(g->rank - axis - 1) * sizeof g->lengths[0]);
                g->rank--;
                if (try_candidate(s)) {
                    better = true;
                    axis--;
                }
            }
        }
    return better;
}

/* Tries way number `way` to simplify an instruction; false: there are no more ways. *applies:
 * it changed something. */
static bool make_plainer(struct instruction *in, int way, bool *applies)
{
    struct instruction before = *in;
    struct operand *const operands[] = {&in->d, &in->a, &in->b};

    if (way < 3)
        operands[way]->offset = 0;
    else if (way < 6)
        operands[way - 3]->bits = (uint8_t)(operands[way - 3]->bits > 64 ? 64 : 32);
    else if (way < 9)
        operands[way - 6]->bits = 8;
    else if (way == 9)
        in->constant = 0;
    else if (way == 10)
        in->constant = 1;
    else if (way == 11)
        in->real = 1.0;
    else if (way == 12)
        in->real = 0.0;
    else if (way == 13)
        in->where = 0;
    else if (way == 14)
        in->b = in->a;
    else if (way == 15)
        in->a = in->d;
    else
        return false;
    /* never back up: lengths only shrink */
    for (int k = 0; k < 3; k++)
        if (operands[k]->bits > (k == 0   ? before.d
                                 : k == 1 ? before.a
                                          : before.b)
                                    .bits &&
            way < 9)
            *in = before;
    *applies = memcmp(&before, in, sizeof before) != 0 &&
               !(way == 10 && before.constant == 0) && !(way == 12 && before.real == 1.0);
    return true;
}

static bool plainer_instructions(struct shrinker *s)
{
    bool better = false, applies;

    for (int n = 0; n < s->p->count; n++)
        for (int way = 0;; way++) {
            int count = s->p->count;

            s->candidate = *s->p;
            if (!make_plainer(&s->candidate.code[n], way, &applies))
                break;
            if (!applies)
                continue;
            program_normalise(&s->candidate);
            /* where normalising dropped an instruction, nothing is tried: removals are
             * remove_runs()'s work */
            if (s->candidate.count == count &&
                memcmp(&s->candidate, s->p, sizeof s->candidate) != 0)
                better |= try_candidate(s);
        }
    return better;
}

int program_shrink(struct program *p, program_fails fails, void *context)
{
    struct shrinker s = {.p = p, .fails = fails, .context = context};
    bool better = true;

    program_normalise(p);
    for (int round = 0; better && round < 12; round++) {
        better = remove_runs(&s);
        better |= remove_sets(&s);
        better |= plainer_geometry(&s);
        better |= plainer_instructions(&s);
    }
    return s.runs;
}
