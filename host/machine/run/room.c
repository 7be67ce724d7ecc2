/* room.c - memory: what waits is bounded by bytes, and gives way where memory is short.
 *
 * A value that waits holds the arrays that it will be computed from, and an evaluation of many
 * values stores some of them for their neighbours. So
 *
 *   wanted        the arrays in use are twice as many bytes as after the last evaluation; or
 *                 they are with those that may have to be stored, and that is more than an
 *                 eighth of the memory: an evaluation is due, in a loop at the end of a turn.
 *   exceeded      with what fields hold, and what will be stored besides, that would be more
 *                 than the memory: an evaluation is due at once, in the middle of a turn, too.
 *   short         few more arrays would fit: all that waits is computed at once, in pieces.
 *   in pieces     what was stored into a field or flag first is computed first, by itself. Then
 *                 memory is used as by an evaluation after each instruction (LUTETIA_EAGER=1):
 *                 an array is free as soon as no later value and no field needs it. A plan
 *                 whose arrays do not fit is not run, but computed in pieces, too; a foreseen
 *                 one is performed call by call.
 *
 * Where an array finds no memory all the same (in the middle of a scan, say), all that waits is
 * computed, and it is tried once more. */
#include "run/room.h"

#include <stdio.h>
#include <string.h>

#include "memory/memory.h"
#include "run/evaluation.h"

enum { HOLDERS = 4 }; /* fields that a message names */

bool room_make(struct machine *m)
{
    struct run *r = m->run;
    known_places_forget(m); /* they can be found again */
    if (r->evaluating || r->calls_noted || !m->values->pending ||
        (r->mode != RUN_FREE && r->mode != RUN_CATCHING_UP))
        return false;
    const struct wish all = {.what = WISH_ALL};
    const uint64_t before = m->device->held_bytes;
    r->in_pieces = true;
    enum machine_status status = evaluation_run(m, &all, RUN_LOOKED);
    return !status && m->device->held_bytes < before;
}

bool room_would_lack(const struct machine *m)
{
    /* an array for what a neighbour looks at, and as a rule another one for what is computed
     * from it and later */
    uint64_t bytes = m->device->held_bytes + 2 * (m->values->pending_kb << 10);
    for (int i = 0; i < m->memory->fields_count; i++) {
        const struct field *f = m->memory->fields[i];
        for (int k = 0; k < f->slots_count; k++) {
            const struct machine_value *v = f->slots[k].value;
            if (v->op != NODE_CONSTANT && !node_is_cheap(v))
                bytes += m->values->sets[f->vpset].count * type_bytes(v->type);
        }
    }
    return bytes > m->device->memory_bytes;
}

/* ---- the message ---- */

static uint64_t field_bytes(const struct field *f)
{
    uint64_t bytes = 0;
    for (int i = 0; i < f->slots_count; i++)
        bytes += f->slots[i].value->buffer ? f->slots[i].value->buffer->bytes : 0;
    return bytes;
}

/* The fields that hold most, the largest first. */
static void name_holders(const struct machine *m, char *out, size_t size)
{
    const struct field *told[HOLDERS] = {NULL};
    size_t length = 0;
    int fields = 0, named = 0;
    *out = '\0';
    for (int i = 0; i < m->memory->fields_count; i++)
        fields += field_bytes(m->memory->fields[i]) > 0;
    for (; named < HOLDERS && named < fields; named++) {
        const struct field *most = NULL;
        for (int i = 0; i < m->memory->fields_count; i++) {
            const struct field *f = m->memory->fields[i];
            bool known = false;
            for (int k = 0; k < named; k++)
                known = known || told[k] == f;
            if (!known && (!most || field_bytes(f) > field_bytes(most)))
                most = f;
        }
        told[named] = most;
        int more = snprintf(out + length, size - length, "%sfield %u: %.1f MB",
                            named ? ", " : "", most->base, 1e-6 * (double)field_bytes(most));
        length += more > 0 && (size_t)more < size - length ? (size_t)more : 0;
    }
    if (fields > named)
        snprintf(out + length, size - length, " and %d more", fields - named);
}

void room_init(struct machine *m)
{
    m->device->make_room = room_make;
    m->device->name_holders = name_holders;
    room_measure(m);
}
