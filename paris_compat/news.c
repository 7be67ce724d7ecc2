/* NEWS: get fetches from a neighbour, whatever its context, into active processors; send pushes
 * from active processors into a neighbour, whatever its context. */
#include "paris_state.h"

static bool piece_move(struct machine *m, const struct paris_instruction *self,
                       struct paris_operand dest, struct paris_operand source, int axis,
                       int distance)
{
    struct machine_value *v = paris_load(m, source, "source", MACHINE_EVERYWHERE);
    if (!v)
        return false;
    v = machine_shift(m, v, axis, distance);
    if (self->op == PARIS_NEWS_GET || self->scope == MACHINE_EVERYWHERE)
        return paris_store(m, dest, v, self->scope);
    struct machine_value *sender = machine_flag_value(m, MACHINE_CONTEXT, MACHINE_EVERYWHERE);
    struct machine_value *sent = sender ? machine_shift(m, sender, axis, distance) : NULL;
    struct machine_value *old = paris_load(m, dest, "dest", MACHINE_EVERYWHERE);
    if (!old)
        return false;
    return paris_store(m, dest, v && sent ? machine_select(m, sent, v, old) : NULL,
                       MACHINE_EVERYWHERE);
}

void paris_news(const struct paris_instruction *self, CM_field_id_t dest, CM_field_id_t source,
                unsigned int axis, unsigned int direction, unsigned int len)
{
    struct machine *m = paris_begin(self->name);
    if (direction > CM_downward) {
        paris_fail("direction: must be CM_upward (0) or CM_downward (1) (got %d)",
                   (int)direction);
        return;
    }
    if (len == 0 || !paris_check_axis(axis) || !paris_check_field(dest, len, "dest") ||
        !paris_check_field(source, len, "source") ||
        !paris_check_overlap(paris_b(dest, len), paris_b(source, len)))
        return;
    int distance = (direction == CM_upward) == (self->op == PARIS_NEWS_GET) ? 1 : -1;
    unsigned int step = len <= PARIS_INTEGER_MAX ? len : PARIS_PIECE;
    for (unsigned int at = 0; at < len; at += step) {
        unsigned int bits = len - at < step ? len - at : step;
        if (!piece_move(m, self, paris_b(dest + at, bits), paris_b(source + at, bits),
                        (int)axis, distance))
            return;
    }
}
