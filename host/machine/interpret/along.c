/* along.c - what is the same along a row: see byte_code.h.
 *
 *     number, coordinate of another axis        the same
 *     an operation on what is the same          the same: a step for one lane, of which all
 *                                               make use as it is
 *     a get from a place that is the same       likewise: the spread of a column
 *     coordinate of the last axis, index        goes up by one; so does what is the same, added
 *                                               to it: likewise
 *     a get from places that go up by one       the array itself, from the first place on: the
 *                                               spread of a row. Only where a place is none is
 *                                               it copied
 *     anything else                             differs
 *
 * Where a step for all lanes takes a register of which one lane is known, a step before it
 * repeats that lane. Blocks of several rows are left as they are. */
#include <stdlib.h>

#include "base/arrays.h"
#include "interpret/byte_code.h"
#include "values/geometry.h"

/* In the first lane alone (ONE), or in all. */
enum along { DIFFERS, GOES_UP_ONE, GOES_UP, REPEATED, ONE };

struct along_row {
    struct byte_code *p;
    const struct vpset *set;
    struct lanes_step *steps; /* the new ones */
    int count, capacity;
    uint8_t *is;    /* of each place: enum along */
    uint16_t *line; /* of a register: what stands for it, itself or a PLACE_LINE */
    uint16_t *idle; /* PLACE_LINEs that stand for nothing any more */
    int idle_count;
    int spared; /* steps for one lane */
};

static bool is_same(const struct along_row *a, int place)
{
    return a->is[place] >= REPEATED;
}

static void step_put(struct along_row *a, const struct lanes_step *s)
{
    if (a->count == a->capacity)
        a->steps = array_more(a->steps, &a->capacity, sizeof *a->steps, &a->p->failed);
    if (!a->p->failed)
        a->steps[a->count++] = *s;
}

/* All lanes of the place are there from now on. */
static void repeat(struct along_row *a, int place)
{
    const int bytes = a->p->places[place].bytes;
    const enum lanes_class c = bytes == 1   ? LANES_U8
                               : bytes == 2 ? LANES_U16
                               : bytes == 4 ? LANES_U32
                               : bytes == 8 ? LANES_U64
                                            : LANES_U128;
    const bool up = a->is[place] == GOES_UP_ONE;
    if (a->is[place] != ONE && !up)
        return;
    const struct lanes_step step = {.run = lanes_find(LANES_REPEAT, c),
                                    .op = LANES_REPEAT,
                                    .to = (uint16_t)place,
                                    .in = {(uint16_t)place, 0, 0},
                                    .detail = up};
    step_put(a, &step);
    a->is[place] = up ? GOES_UP : REPEATED;
}

static bool goes_up(const struct along_row *a, int place)
{
    return a->is[place] == GOES_UP_ONE || a->is[place] == GOES_UP;
}

static bool adds_to_columns(const struct along_row *a, const struct lanes_step *s)
{
    return s->op == MACHINE_ADD && s->type.kind == MACHINE_BITS && s->type.width == 32 &&
           ((goes_up(a, s->in[0]) && is_same(a, s->in[1])) ||
            (goes_up(a, s->in[1]) && is_same(a, s->in[0])));
}

/* What the step's result is, if that is a register. */
static enum along result_of(const struct along_row *a, const struct lanes_step *s)
{
    if (!s->run)
        return s->op == NODE_INDEX || s->axis == a->set->rank - 1 ? GOES_UP_ONE : ONE;
    bool same = s->op != LANES_CROSS && s->op != LANES_STREAM;
    for (int k = 0; k < lanes_taken(s) && same; k++)
        same = lanes_is_apart(s, k) || is_same(a, lanes_taken_place(s, k));
    return same ? ONE : adds_to_columns(a, s) ? GOES_UP_ONE : DIFFERS;
}

/* ---- lines ---- */

static int line_get(struct along_row *a, int bytes)
{
    for (int i = 0; i < a->idle_count; i++)
        if (a->p->places[a->idle[i]].bytes == bytes) {
            const int line = a->idle[i];
            a->idle[i] = a->idle[--a->idle_count];
            return line;
        }
    return byte_code_place(a->p, PLACE_LINE, bytes);
}

/* What the register stands for is itself again. */
static void line_end(struct along_row *a, int place)
{
    if (a->line[place] != place)
        a->idle[a->idle_count++] = a->line[place];
    a->line[place] = (uint16_t)place;
}

static void takes_lines(const struct along_row *a, struct lanes_step *s)
{
    for (int k = 0; k < lanes_taken(s); k++) {
        uint16_t *place = s->list && k ? &s->list[k - 1] : &s->in[k];
        *place = a->line[*place];
    }
}

/* A step that changes what is in its place has it in a register. */
static void copied_back(struct along_row *a, int place)
{
    static const uint8_t classes[] = {
        [1] = LANES_U8, [2] = LANES_U16, [4] = LANES_U32, [8] = LANES_U64, [16] = LANES_U128};
    const int line = a->line[place];
    if (line == place)
        return;
    const struct lanes_step step = {
        .run = lanes_find(LANES_COPY, (enum lanes_class)classes[a->p->places[place].bytes]),
        .op = LANES_COPY,
        .to = (uint16_t)place,
        .in = {(uint16_t)line, 0, 0}};
    step_put(a, &step);
    line_end(a, place);
}

/* What the array has there is not copied. */
static void gives_line(struct along_row *a, struct lanes_step *s)
{
    const int place = s->to;
    if (a->p->places[place].kind != PLACE_REGISTER)
        return;
    line_end(a, place);
    if (!s->in_a_row)
        return;
    s->to = a->line[place] = (uint16_t)line_get(a, a->p->places[place].bytes);
    a->is[s->to] = DIFFERS;
}

/* ---- steps ---- */

static void step_look(struct along_row *a, struct lanes_step s)
{
    if (s.run && lanes_taken(&s) && s.in[0] == s.to && !s.list)
        copied_back(a, s.to);
    takes_lines(a, &s);
    const enum along result =
        a->p->places[s.to].kind == PLACE_REGISTER ? result_of(a, &s) : DIFFERS;
    s.one = result != DIFFERS;
    s.in_a_row = !s.one && s.op == LANES_FETCH && goes_up(a, s.in[0]);
    for (int k = 0; k < 2 && s.op == LANES_PRODUCT_SUM && !s.one; k++)
        s.axis |= (uint8_t)((a->is[s.in[k]] == ONE) << k);
    for (int k = 0; k < lanes_taken(&s) && !s.one; k++)
        if (!lanes_is_apart(&s, k) && !(s.in_a_row && k == 0))
            repeat(a, lanes_taken_place(&s, k));
    a->spared += s.one;
    a->p->lines = a->p->lines || (s.op == LANES_FETCH && (s.one || s.in_a_row));
    a->is[s.to] = (uint8_t)result;
    gives_line(a, &s);
    step_put(a, &s);
}

void byte_code_along(struct byte_code *p, const struct vpset *set)
{
    struct along_row a = {.p = p, .set = set};
    bool any = false;
    for (int i = 0; i < p->steps_count; i++)
        any = any || p->steps[i].op == LANES_FETCH ||
              (!p->steps[i].run && p->steps[i].op == NODE_COORDINATE &&
               p->steps[i].axis != set->rank - 1);
    if (!any || set->pitch <= BLOCK_LANES)
        return;
    const size_t most =
        (size_t)(p->places_count + p->steps_count); /* each step may get a line */
    a.is = calloc(most, sizeof *a.is);
    a.line = malloc(most * sizeof *a.line);
    a.idle = malloc(most * sizeof *a.idle);
    p->failed = p->failed || !a.is || !a.line || !a.idle || most > UINT16_MAX;
    for (size_t i = 0; i < most && !p->failed; i++) {
        const bool number = i < (size_t)p->places_count && p->places[i].kind == PLACE_NUMBER;
        a.is[i] = number ? REPEATED : DIFFERS;
        a.line[i] = (uint16_t)i;
    }
    for (int i = 0; i < p->steps_count && !p->failed; i++)
        step_look(&a, p->steps[i]);
    free(a.is);
    free(a.line);
    free(a.idle);
    if (p->failed) {
        free(a.steps);
        return;
    }
    p->lane_s *= 1 - (double)a.spared / (double)a.count;
    free(p->steps);
    p->steps = a.steps;
    p->steps_count = a.count;
    p->steps_capacity = a.capacity;
}

void byte_code_free(struct byte_code *p)
{
    if (!p)
        return;
    for (int i = 0; i < p->places_count; i++)
        free(p->places[i].further);
    for (int i = 0; i < p->steps_count; i++)
        free(p->steps[i].list);
    free(p->places);
    free(p->steps);
    free(p->guards);
    free(p->arguments);
    free(p);
}
