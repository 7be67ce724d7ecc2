/* code_places.c - the places and arguments of byte code: see byte_code.h. */
#include <stdlib.h>

#include "base/arrays.h"
#include "interpret/byte_code.h"

int byte_code_place_add(struct byte_code *p, struct place place)
{
    if (p->places_count == p->places_capacity)
        p->places = array_more(p->places, &p->places_capacity, sizeof *p->places, &p->failed);
    if (p->failed) {
        free(place.further);
        return 0;
    }
    p->places[p->places_count] = place;
    return p->places_count++;
}

size_t byte_code_room(struct byte_code *p, enum lanes_class c)
{
    size_t at = p->registers_bytes;
    p->registers_bytes += BLOCK_LANES * lanes_bytes(c) + 64;
    return at;
}

int byte_code_place(struct byte_code *p, enum place_kind kind, int bytes)
{
    const size_t at = p->registers_bytes;
    p->registers_bytes += (size_t)(BLOCK_LANES * bytes) + 64;
    return byte_code_place_add(
        p, (struct place){
               .kind = (uint8_t)kind, .bytes = (uint8_t)bytes, .node = -1, .offset = at});
}

void byte_code_argument_add(struct byte_code *p, int kind, int node)
{
    for (int i = 0; i < p->arguments_count; i++)
        if (p->arguments[i].kind == kind && p->arguments[i].node == node)
            return;
    if (p->arguments_count == p->arguments_capacity)
        p->arguments =
            array_more(p->arguments, &p->arguments_capacity, sizeof *p->arguments, &p->failed);
    if (!p->failed)
        p->arguments[p->arguments_count++] =
            (struct kernel_argument){.kind = (uint8_t)kind, .node = node};
}
