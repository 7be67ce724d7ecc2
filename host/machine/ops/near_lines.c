/* near_lines.c - see near_lines.h: the loops of near_loops.h over all lines, shared out. */
#include "ops/near_lines.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "interpret/lanes.h"
#include "ops/near_loops.h"

/* The other end of the row whose column 0 is at that element, on both sides. */
static void row_repeat(const struct lines *l, char *out, size_t bytes, size_t column)
{
    char *row = out + column * bytes;
    size_t width = (size_t)l->width * bytes, halo = (size_t)l->halo * bytes;
    memcpy(row - halo, row + width - halo, halo);
    memcpy(row + width, row, halo);
}

/* All rows of the lines that lie in rows from there on. */
static void rows_repeat(const struct lines *l, char *out, size_t bytes, size_t row)
{
    if (!l->halo)
        return;
    if (l->along)
        row_repeat(l, out, bytes, l->step > 0 ? row : row - (size_t)(l->length - 1));
    for (int k = 0; k < l->length && !l->along; k++)
        row_repeat(l, out, bytes, row + (size_t)(k * l->step));
}

size_t near_lines_row(const struct lines *l, size_t row)
{
    return l->base + row % l->inner * l->inner_stride + row / l->inner * l->outer_stride;
}

void near_lines_repeat(const struct lines *l, void *out, size_t bytes)
{
    for (size_t row = 0; row < l->inner * l->outer; row++)
        rows_repeat(l, out, bytes, near_lines_row(l, row));
}

/* What the parts share. A piece is a group of lines, or of one line a chunk. */
struct share {
    const struct lines *l;
    const struct line_scan *j;
    const struct loops *loops;
    int run, parts;
    size_t pieces, groups; /* groups: of lines, in a row of them */
    struct chunk *chunks;  /* NULL: whole lines */
    int chunk;             /* elements of a chunk */
    size_t row;
    bool writes; /* chunks, the last time */
};

static struct stretch stretch_of(const struct share *s, size_t at, int begin, int end)
{
    ptrdiff_t step = (ptrdiff_t)s->l->step;
    return (struct stretch){
        .j = s->j, .at = at + (size_t)(begin * step), .step = step, .begin = begin, .end = end};
}

static void group_scan(const struct share *s, size_t piece)
{
    const struct lines *l = s->l;
    size_t row = piece / s->groups, line = row * (size_t)l->columns;
    int lanes = s->loops->many ? LOOPS_LANES : 1, column = (int)(piece % s->groups) * lanes;
    for (int n, end = column + lanes < l->columns ? column + lanes : l->columns; column < end;
         column += n) {
        const struct stretch one =
            stretch_of(s, near_lines_row(l, row) + (size_t)column, 0, l->length);
        n = end - column == LOOPS_LANES && lanes == LOOPS_LANES ? LOOPS_LANES : 1;
        (n > 1 ? s->loops->many : s->loops->one)(&one, s->run, line + (size_t)column);
    }
}

static void part_scan(void *of, int part, int worker)
{
    const struct share *s = of;
    size_t first = s->pieces * (size_t)part / (size_t)s->parts,
           end = s->pieces * (size_t)(part + 1) / (size_t)s->parts;
    (void)worker;
    for (size_t i = first; i < end; i++) {
        if (!s->chunks) {
            group_scan(s, i);
            continue;
        }
        int begin = (int)i * s->chunk, left = s->l->length - begin;
        const struct stretch one =
            stretch_of(s, s->row, begin, begin + (left < s->chunk ? left : s->chunk));
        if (!s->writes && s->loops->sums && i + LOOPS_RUNS <= end &&
            left >= LOOPS_RUNS * s->chunk) {
            s->loops->sums(&one, &s->chunks[i]);
            i += LOOPS_RUNS - 1;
        } else {
            (s->writes ? s->loops->scan : s->loops->sum)(&one, &s->chunks[i]);
        }
    }
    if (s->j->streams)
        lanes_table()->settle();
}

/* Lines along rows, one after the other, each in chunks. False: no memory, or one chunk is
 * all. */
static bool chunks_scan(struct crew *crew, struct share *s)
{
    const struct lines *l = s->l;
    s->chunk = s->j->element->kind == 1 ? s->run : (l->length - 1) / s->parts + 1;
    s->pieces = (size_t)((l->length - 1) / s->chunk + 1);
    s->chunks = s->pieces > 1 ? malloc(s->pieces * sizeof *s->chunks) : NULL;
    if (!s->chunks)
        return false;
    for (size_t row = 0; row < l->inner * l->outer; row++) {
        s->row = near_lines_row(l, row);
        s->writes = false;
        crew_run(crew, s->parts, part_scan, s);
        s->loops->join(s->j, s->chunks, (int)s->pieces);
        s->writes = true;
        crew_run(crew, s->parts, part_scan, s);
    }
    free(s->chunks);
    s->chunks = NULL;
    return true;
}

void near_lines_scan(struct crew *crew, int parts, const struct lines *l,
                     const struct line_scan *j, int run)
{
    size_t rows = l->inner * l->outer;
    struct share s = {
        .l = l, .j = j, .loops = near_loops_of(j->element), .run = run, .parts = parts};
    size_t lanes = s.loops->many ? LOOPS_LANES : 1;
    s.groups = ((size_t)l->columns + lanes - 1) / lanes;
    bool few = l->along && rows < (size_t)parts && !j->sums;
    if (!few || !chunks_scan(crew, &s)) {
        s.pieces = rows * s.groups;
        crew_run(crew, parts, part_scan, &s);
    }
    if (!j->sums)
        near_lines_repeat(l, j->out->host, j->element->bytes);
}

/* ---- lines filled ---- */

struct filling {
    const struct lines *l;
    size_t bytes;
    const char *from;
    char *to;
    struct origin origin;
    int parts;
};

/* Of each line a part. */
static void part_fill(void *of, int part, int worker)
{
    const struct filling *f = of;
    const struct lines *l = f->l;
    size_t bytes = f->bytes, first = (size_t)l->length * (size_t)part / (size_t)f->parts,
           end = (size_t)l->length * (size_t)(part + 1) / (size_t)f->parts;
    (void)worker;
    for (size_t row = 0; row < l->inner * l->outer; row++) {
        const char *element = f->from + (f->origin.base + row % l->inner * f->origin.inner +
                                         row / l->inner * f->origin.outer) *
                                            bytes;
        char *to = f->to + near_lines_row(l, row) * bytes;
        ptrdiff_t step = (ptrdiff_t)l->step * (ptrdiff_t)bytes;
        if (l->along && l->step > 0)
            array_fill(to + first * bytes, element, bytes, end - first);
        for (size_t k = first; k < end && !(l->along && l->step > 0); k++)
            memcpy(to + (ptrdiff_t)k * step, element, (size_t)l->columns * bytes);
    }
}

void near_lines_fill(struct crew *crew, int parts, const struct lines *l, size_t bytes,
                     const struct device_buffer *from, struct origin origin,
                     struct device_buffer *out)
{
    struct filling f = {.l = l,
                        .bytes = bytes,
                        .from = from->host,
                        .to = out->host,
                        .origin = origin,
                        .parts = parts};
    crew_run(crew, parts, part_fill, &f);
    near_lines_repeat(l, out->host, bytes);
}
