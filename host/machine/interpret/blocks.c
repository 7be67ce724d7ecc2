/* blocks.c - a program's steps, block after block: see blocks.h.
 *
 * A block is a part of a row, or, where rows are short, several whole rows with their halos:
 * these are one after the other in memory, so that a single processor of each row or all of
 * them make no difference to a step.
 *
 *     long rows     | ---block--- | ---block--- | --b-- |     and after the row its halos
 *     short rows    halo row halo pad halo row halo pad       one block; halos anew where something was moved */
#include "interpret/blocks.h"

#include <stdlib.h>
#include <string.h>

#include "interpret/generate.h"
#include "interpret/lanes.h"
#include "interpret/windows.h"
#include "values/values.h"

/* Lanes of a block: from column x of a row on, or whole rows. */
struct block {
    uint64_t row;
    int rows; /* whole ones; 0: a part of one */
    int x, lanes;
};

struct run {
    const struct byte_code *p;
    const struct vpset *set;
    struct device_buffer *const *buffers;
    struct blocks_registers *room; /* of this thread */
    uint8_t ahead;                 /* which arrays are fetched before their block's turn */
};

void blocks_room_free(struct blocks_room *room)
{
    for (int i = 0; i < CREW_MOST; i++) {
        free(room->of[i].memory);
        free(room->of[i].at);
    }
    *room = (struct blocks_room){0};
}

static bool room_ready(struct blocks_registers *room, const struct byte_code *p)
{
    if (!room->memory || room->bytes < p->registers_bytes) {
        /* Twice as much as before, at least: a page that is written for the first time costs
         * more than a step. */
        size_t bytes = p->registers_bytes / PAGE_BYTES * PAGE_BYTES + PAGE_BYTES;
        bytes = bytes < 2 * room->bytes ? 2 * room->bytes : bytes;
        bytes = bytes < REGISTERS_LEAST_BYTES ? REGISTERS_LEAST_BYTES : bytes;
        free(room->memory);
        room->memory = aligned_alloc(LINE_BYTES, bytes);
        room->bytes = room->memory ? bytes : 0;
        if (!room->memory)
            return false;
        memset(room->memory, 0, bytes);
    }
    if (room->at_count < p->places_count) {
        void **at = realloc(room->at, (size_t)p->places_count * sizeof *at);
        if (!at)
            return false;
        room->at = at;
        room->at_count = p->places_count;
    }
    return true;
}

static void fill(void *to, struct machine_scalar x, int bytes, int lanes)
{
    const uint64_t raw[2] = {x.lo, x.hi};
    lanes_table()->fill(to, raw, (size_t)bytes, (size_t)lanes);
}

/* Places that are the same for all blocks. */
static void places_begin(const struct run *r, struct machine_value *const *nodes, int lanes)
{
    for (int i = 0; i < r->p->places_count; i++) {
        const struct place *place = &r->p->places[i];
        void *at = (char *)r->room->memory + place->offset;
        if (place->kind == PLACE_CROSSED)
            *(uint32_t *)at = (uint32_t)nodes[place->bits]->imm.lo / BLOCK_LANES * BLOCK_LANES;
        if (place->kind == PLACE_ARRAY || place->kind == PLACE_MOVED ||
            place->kind == PLACE_CROSSED)
            continue;
        if (place->kind == PLACE_NUMBER)
            fill(at, nodes[place->node]->imm, place->bytes, lanes);
        else if (place->kind == PLACE_WHOLE)
            at = r->buffers[place->node]->host;
        else if (place->kind == PLACE_DRAW)
            memcpy(at, (uint64_t[2]){nodes[place->node]->imm.lo, nodes[place->node]->imm.hi},
                   16);
        r->room->at[i] = at;
    }
}

/* ---- neighbours ---- */

/* The row that is so much further along all axes but the last. */
static uint64_t row_moved(const struct vpset *s, uint64_t row, const int32_t *further)
{
    uint64_t moved = 0, stride = 1;
    for (int a = s->rank - 2; a >= 0; a--) {
        uint64_t length = (uint64_t)s->dimensions[a], c = row % length;
        row /= length;
        if (further[a])
            c = (uint64_t)generate_wrapped((int64_t)c + further[a], s->dimensions[a]);
        moved += c * stride;
        stride *= length;
    }
    return moved;
}

static char *row_begin(const struct run *r, const struct place *place, uint64_t row)
{
    return (char *)r->buffers[place->node]->host +
           (row * r->set->pitch + (size_t)r->set->halo) * place->bytes;
}

/* lanes columns of a row from column x on, which may lie beyond its ends. */
static void columns_copy(char *to, const char *row, int64_t x, int lanes, int width, int bytes)
{
    int from = generate_wrapped(x, width);
    while (lanes > 0) {
        int part = width - from < lanes ? width - from : lanes;
        memcpy(to, row + (size_t)from * (size_t)bytes, (size_t)part * (size_t)bytes);
        to += (size_t)part * (size_t)bytes;
        lanes -= part;
        from = 0;
    }
}

/* Where a block's neighbours are: in the array itself if they are there side by side, else
 * brought together. */
static void *moved(const struct run *r, const struct place *place, const struct block *b)
{
    const struct vpset *s = r->set;
    int dx = place->further[s->rank - 1], reach = s->halo;
    uint64_t first = row_moved(s, b->row, place->further);
    char *together = (char *)r->room->memory + place->offset;
    if (dx > s->width / 2)
        dx -= s->width;
    if (dx < -(s->width / 2))
        dx += s->width;
    if (!b->rows) {
        char *row = row_begin(r, place, first);
        if (b->x + dx >= -reach && b->x + b->lanes + dx <= s->width + reach)
            return row + (ptrdiff_t)(b->x + dx) * place->bytes;
        columns_copy(together, row, (int64_t)b->x + dx, b->lanes, s->width, place->bytes);
        return together;
    }
    bool apart = dx > reach || dx < -reach;
    for (int i = 1; i < b->rows && !apart; i++)
        apart = row_moved(s, b->row + (uint64_t)i, place->further) != first + (uint64_t)i;
    if (!apart)
        return row_begin(r, place, first) + (ptrdiff_t)(dx - s->halo) * place->bytes;
    for (int i = 0; i < b->rows; i++)
        columns_copy(together + ((size_t)i * s->pitch + (size_t)s->halo) * place->bytes,
                     row_begin(r, place, row_moved(s, b->row + (uint64_t)i, place->further)),
                     dx, s->width, s->width, place->bytes);
    return together;
}

/* Another block of the row: rows are long where there are crosses (values/places.c). */
static void *crossed(const struct run *r, const struct place *place, const struct block *b)
{
    const uint32_t *bits = (const void *)((char *)r->room->memory + place->offset);
    return row_begin(r, place, b->row) + (size_t)((uint32_t)b->x ^ *bits) * place->bytes;
}

static void places_move(const struct run *r, const struct block *b)
{
    for (int i = 0; i < r->p->places_count; i++) {
        const struct place *place = &r->p->places[i];
        if (place->kind == PLACE_ARRAY)
            r->room->at[i] = row_begin(r, place, b->row) +
                             (ptrdiff_t)(b->rows ? -r->set->halo : b->x) * place->bytes;
        else if (place->kind == PLACE_MOVED)
            r->room->at[i] = moved(r, place, b);
        else if (place->kind == PLACE_CROSSED)
            r->room->at[i] = crossed(r, place, b);
        else if (place->kind == PLACE_LINE) /* until it is found */
            r->room->at[i] = (char *)r->room->memory + place->offset;
    }
}

/* ---- coordinates ---- */

static void generate(const struct run *r, const struct lanes_step *step, const struct block *b)
{
    const int lanes = step->one ? 1 : b->lanes;
    uint32_t *to = r->room->at[step->to];
    const int axis = step->op == NODE_INDEX ? -1 : step->axis;
    if (!b->rows)
        generate_row(r->set, axis, b->row, b->x, to, lanes);
    else
        generate_lanes(r->set, axis, b->row * r->set->pitch, to, lanes);
}

/* ---- lines ---- */

/* A line of an array from the first place on, if all lanes are there. */
static bool line_found(const struct run *r, const struct lanes_step *s, int lanes)
{
    void **at = r->room->at;
    const struct place *line = &r->p->places[s->to];
    if (line->kind != PLACE_LINE)
        return false;
    const uint32_t from = *(const uint32_t *)at[s->in[0]],
                   count = *(const uint32_t *)at[s->in[2]];
    const bool there = from < count && count - from >= (uint32_t)lanes;
    at[s->to] = there ? (char *)at[s->in[1]] + (size_t)from * line->bytes
                      : (char *)r->room->memory + line->offset;
    return there;
}

/* ---- blocks ---- */

/* The same lines of an array for the next block: a block's part is too short for the processor
 * to see where a stream goes on. (A call of a function that does nothing else would be left
 * out.) */
static inline __attribute__((always_inline)) void fetch(const struct run *r, int place,
                                                        int lanes, bool written)
{
    const int bytes = lanes * r->p->places[place].bytes;
    const char *next = (const char *)r->room->at[place] + bytes;
    for (int i = 0; i < bytes; i += LINE_BYTES)
        if (written)
            __builtin_prefetch(next + i, 1, 2);
        else
            __builtin_prefetch(next + i, 0, 2);
}

static inline __attribute__((always_inline)) void
fetch_ahead(const struct run *r, const struct lanes_step *s, int lanes)
{
    const int ahead = s->ahead & r->ahead;
    for (int k = 0; k < 3; k++)
        if (ahead >> k & 1)
            fetch(r, s->in[k], lanes, false);
    if (ahead & AHEAD_TO)
        fetch(r, s->to, lanes, true);
    for (int k = 0; ahead & AHEAD_LIST && k < s->detail; k++)
        if (r->p->places[s->list[2 * k + 1]].kind == PLACE_ARRAY)
            fetch(r, s->list[2 * k + 1], lanes, false);
}

static inline __attribute__((always_inline)) void
step_run(const struct run *r, const struct lanes_step *s, const struct block *b)
{
    if (s->run)
        s->run(s, r->room->at, s->one ? 1 : b->lanes);
    else
        generate(r, s, b);
}

static void block_run(const struct run *r, const struct block *b)
{
    const bool goes_on = !b->rows && b->x + b->lanes < r->set->width;
    struct window w = {0, b->lanes};
    int guarded = -1; /* steps up to there are for the window */
    places_move(r, b);
    for (int i = 0; i < r->p->steps_count; i++) {
        const struct lanes_step *s = &r->p->steps[i];
        if (s->op == LANES_GUARD) {
            w = window_of(&r->p->guards[s->in[0]], r->room->at, b->lanes);
            if (w.from == w.end)
                i += s->detail;
            else if (b->lanes - (w.end - w.from) >= WINDOW_LANES)
                guarded = i + s->detail;
            continue;
        }
        if (s->op == LANES_FETCH && s->in_a_row && line_found(r, s, b->lanes))
            continue;
        if (i > guarded || !s->run)
            step_run(r, s, b);
        else
            window_step(r->p, s, r->room->at, w, b->lanes);
        if (s->ahead & r->ahead && goes_on)
            fetch_ahead(r, s, b->lanes);
    }
}

/* The other end of each row, on both sides. */
static void halos_make(const struct run *r, uint64_t row, uint64_t rows)
{
    const struct vpset *s = r->set;
    for (int i = 0; i < r->p->arguments_count && s->halo; i++) {
        const struct kernel_argument *a = &r->p->arguments[i];
        if (a->kind != ARGUMENT_OUTPUT)
            continue;
        const struct device_buffer *buffer = r->buffers[a->node];
        size_t element = (buffer->bytes) / (s->pitch * s->rows + 16),
               width = (size_t)s->width * element, halo = (size_t)s->halo * element;
        for (uint64_t k = row; k < row + rows; k++) {
            char *begin = (char *)buffer->host + k * s->pitch * element + halo;
            memcpy(begin - halo, begin + width - halo, halo);
            memcpy(begin + width, begin, halo);
        }
    }
}

/* One run, shared out. A piece is a block's columns of a row, or a block of short rows. */
struct share {
    struct run run;
    struct blocks_room *room;
    struct machine_value *const *nodes;
    uint64_t pieces, along; /* along: of a row; 0: rows are short */
    int parts, lanes;
    bool begun[CREW_MOST];
};

static void long_row_run(const struct run *r, uint64_t row, int x)
{
    int lanes = r->set->width - x < BLOCK_LANES ? r->set->width - x : BLOCK_LANES;
    block_run(r, &(struct block){.row = row, .x = x, .lanes = lanes});
}

static void short_rows_run(const struct run *r, uint64_t piece)
{
    const struct vpset *s = r->set;
    uint64_t at_once = BLOCK_LANES / s->pitch, row = piece * at_once,
             rows = s->rows - row < at_once ? s->rows - row : at_once;
    block_run(r,
              &(struct block){.row = row, .rows = (int)rows, .lanes = (int)(rows * s->pitch)});
    if (r->p->moves)
        halos_make(r, row, rows);
}

static void part_run(void *of, int part, int worker)
{
    struct share *s = of;
    struct run r = s->run;
    uint64_t first = s->pieces * (uint64_t)part / (uint64_t)s->parts,
             end = s->pieces * (uint64_t)(part + 1) / (uint64_t)s->parts;
    r.room = &s->room->of[worker];
    if (!s->begun[worker])
        places_begin(&r, s->nodes, s->lanes);
    s->begun[worker] = true;
    for (uint64_t i = first; i < end; i++)
        if (!s->along) {
            short_rows_run(&r, i);
        } else {
            long_row_run(&r, i / s->along, (int)(i % s->along) * BLOCK_LANES);
            if (s->parts == 1 && i % s->along == s->along - 1)
                halos_make(&r, i / s->along, 1);
        }
    if (r.p->streams)
        lanes_table()->settle();
}

/* All arrays if they are in no cache; else results whose memory is new. */
static uint8_t arrays_to_fetch(const struct byte_code *p, struct device_buffer *const *buffers)
{
    uint8_t ahead = p->far ? AHEAD_ALL : 0;
    for (int i = 0; i < p->arguments_count; i++) {
        struct device_buffer *b = buffers[p->arguments[i].node];
        if (p->arguments[i].kind != ARGUMENT_OUTPUT || !b->fresh)
            continue;
        b->fresh = false;
        ahead |= AHEAD_TO;
    }
    return ahead;
}

bool blocks_run(struct blocks_room *room, struct crew *crew, int parts,
                const struct byte_code *p, const struct vpset *set,
                struct device_buffer *const *buffers, struct machine_value *const *nodes)
{
    struct share s = {
        .run = {.p = p, .set = set, .buffers = buffers, .ahead = arrays_to_fetch(p, buffers)},
        .room = room,
        .nodes = nodes};
    bool are_short = set->pitch <= BLOCK_LANES;
    uint64_t most = are_short ? set->pitch * set->rows : (uint64_t)set->width,
             at_once = are_short ? BLOCK_LANES / set->pitch : 1;
    s.along = are_short ? 0 : ((uint64_t)set->width + BLOCK_LANES - 1) / BLOCK_LANES;
    s.pieces = are_short ? (set->rows + at_once - 1) / at_once : set->rows * s.along;
    s.lanes = most < BLOCK_LANES ? (int)most : BLOCK_LANES;
    s.parts = (uint64_t)parts < s.pieces ? parts : (int)s.pieces;
    for (int i = 0; i < crew_size(crew) && (i == 0 || s.parts > 1); i++)
        if (!room_ready(&room->of[i], p))
            return false;
    crew_run(crew, s.parts, part_run, &s);
    if (s.parts > 1 && s.along)
        halos_make(&s.run, 0, set->rows);
    return true;
}
