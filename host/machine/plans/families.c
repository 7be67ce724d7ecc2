/* families.c - see families.h. */
#include "plans/families.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "codegen/spell.h"
#include "codegen/text.h"
#include "plans/plans.h"

/* ---- what is alike, and what may differ ---- */

/* Which kind of number the node's detail is; MACHINE_NUMBERS: it is none, and belongs to what
 * the node does. */
static enum machine_number detail_is(const struct machine_value *v)
{
    return v->op == NODE_SHIFT && !v->buffer     ? MACHINE_NUMBER_DISTANCE
           : v->op == NODE_EXTRACT && !v->buffer ? MACHINE_NUMBER_POSITION
                                                 : MACHINE_NUMBERS;
}

/* All widths that are held alike, in kernels and in memory, have the same letters. */
static uint32_t held_as(struct machine_type t)
{
    const char *kind = memory_kind(t);
    return (uint32_t)spell_letter(t) | (uint32_t)kind[0] << 8 | (uint32_t)kind[1] << 16 |
           (t.width == 32 || t.width == 64 || t.width == 128 ? 1u << 24 : 0);
}

/* A VP set's number among those of the plan, and its axes. */
static uint32_t set_is(const struct machine *m, uint16_t set, uint16_t *sets, int *count)
{
    int i = 0;
    while (i < *count && sets[i] != set)
        i++;
    if (i == *count && i < MACHINE_AXES_MAX)
        sets[(*count)++] = set;
    return (uint32_t)i | (uint32_t)m->values->sets[set].rank << 8;
}

static uint64_t mixed(uint64_t h, uint64_t word)
{
    h = (h ^ word) * UINT64_C(0x9e3779b97f4a7c15);
    return h ^ h >> 29;
}

static uint64_t hash_of(const struct machine *m, const struct reach *r, const struct targets *t)
{
    uint16_t sets[MACHINE_AXES_MAX];
    int sets_count = 0;
    uint64_t h = 1;
    for (int i = 0; i < r->count; i++) {
        const struct machine_value *v = r->nodes[i];
        uint32_t op = (uint32_t)(v->buffer ? NODE_BUFFER : v->op);
        h = mixed(h, (uint64_t)held_as(v->type) << 32 | op | (uint64_t)v->axis << 16 |
                         (uint64_t)v->maybe_nan << 24);
        h = mixed(h, (uint64_t)v->type.s | (uint64_t)v->type.e << 8 |
                         (uint64_t)set_is(m, v->set, sets, &sets_count) << 32);
        if (detail_is(v) == MACHINE_NUMBERS && !v->buffer)
            h = mixed(h, (uint32_t)v->detail);
        for (int k = 0; !v->buffer && k < node_ops[v->op].inputs; k++)
            h = mixed(h, v->in[k]->local);
    }
    for (int i = 0; i < t->count; i++)
        h = mixed(h, t->values[i]->local | UINT64_C(1) << 40);
    return h;
}

/* Two numbers of each node: its width, and its detail or VP set. */
static int32_t number_of(const struct machine_value *v, int k, enum machine_number *what)
{
    if (k == 0) {
        *what = MACHINE_NUMBER_WIDTH;
        return v->type.width;
    }
    *what = detail_is(v);
    if (*what != MACHINE_NUMBERS)
        return v->detail;
    *what = MACHINE_NUMBER_VPSET;
    return v->set;
}

uint64_t plan_alike(const struct machine *m, const struct reach *r, const struct targets *t)
{
    uint64_t h = hash_of(m, r, t);
    for (int i = 0; i < 2 * r->count; i++) {
        enum machine_number what;
        const int32_t number = number_of(r->nodes[i / 2], i % 2, &what);
        h = mixed(h, what == MACHINE_NUMBER_VPSET ? 0 : (uint32_t)number);
    }
    return h;
}

/* Compares with the first one's numbers. */
static void compare(struct plan_family *f, const struct reach *r)
{
    bool other = false;
    for (int i = 0; i < f->numbers_count; i++) {
        enum machine_number what;
        int32_t number = number_of(r->nodes[i / 2], i % 2, &what);
        if (number == f->numbers[i])
            continue;
        struct machine_explained_range *range = &f->said.differ[what];
        int32_t first = range->differs ? range->least : f->numbers[i],
                last = range->differs ? range->most : f->numbers[i];
        first = f->numbers[i] < first ? f->numbers[i] : first;
        last = f->numbers[i] > last ? f->numbers[i] : last;
        *range = (struct machine_explained_range){true, number < first ? number : first,
                                                  number > last ? number : last};
        other = other || what != MACHINE_NUMBER_VPSET;
    }
    f->differ += other;
}

/* ---- families ---- */

/* "ADD, EXTRACT": what its first plan stores. */
static void name(char *out, size_t size, const struct targets *t)
{
    enum { SHOWN = 3 };
    size_t length = 0;
    for (int i = 0; i < t->count && i < SHOWN; i++)
        length += (size_t)snprintf(out + length, size - length, "%s%s", i ? ", " : "",
                                   node_ops[t->values[i]->op].name);
    if (t->count > SHOWN)
        snprintf(out + length, size - length, ", %d more", t->count - SHOWN);
}

static struct plan_family *family_make(uint64_t hash, const struct reach *r,
                                       const struct targets *t)
{
    struct plan_family *f = calloc(1, sizeof *f);
    int32_t *numbers = malloc(2 * (size_t)r->count * sizeof *numbers);
    if (!f || !numbers) {
        free(f);
        free(numbers);
        return NULL;
    }
    f->hash = hash;
    f->numbers = numbers;
    f->numbers_count = 2 * r->count;
    for (int i = 0; i < f->numbers_count; i++) {
        enum machine_number what;
        numbers[i] = number_of(r->nodes[i / 2], i % 2, &what);
    }
    f->said.nodes = r->count;
    name(f->said.name, sizeof f->said.name, t);
    return f;
}

struct plan_family *family_join(struct machine *m, const struct reach *r,
                                const struct targets *t)
{
    struct plans *p = m->plans;
    uint64_t hash = hash_of(m, r, t);
    if (!p->families)
        p->families = calloc(FAMILY_BUCKETS, sizeof *p->families);
    if (!p->families)
        return NULL;
    struct plan_family **bucket = &p->families[hash % FAMILY_BUCKETS], *f = *bucket;
    while (f && (f->hash != hash || f->numbers_count != 2 * r->count))
        f = f->next;
    if (f) {
        compare(f, r);
    } else if ((f = family_make(hash, r, t))) {
        f->next = *bucket;
        *bucket = f;
        p->families_count++;
    }
    if (f)
        f->made++;
    return f;
}

static void family_free(struct plan_family *f)
{
    free(f->numbers);
    free(f);
}

void families_sweep(struct machine *m)
{
    for (int i = 0; m->plans->families && i < FAMILY_BUCKETS; i++)
        for (struct plan_family **at = &m->plans->families[i], *f; (f = *at);) {
            if (f->kept) {
                at = &f->next;
                continue;
            }
            *at = f->next;
            m->plans->families_count--;
            family_free(f);
        }
}

void families_finish(struct machine *m)
{
    for (int i = 0; m->plans->families && i < FAMILY_BUCKETS; i++)
        for (struct plan_family *f = m->plans->families[i], *next; f; f = next) {
            next = f->next;
            family_free(f);
        }
    free(m->plans->families);
}
