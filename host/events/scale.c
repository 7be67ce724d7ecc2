/* scale.c - see scale.h. */
#include "scale.h"

#include <math.h>

static double number_scale(const struct member *m, double value,
                           const struct event_scaling *scaling)
{
    double length = scaling->length, pace = scaling->pace;
    switch (m->scaling) {
    case SCALE_NOT:
        return value;
    case SCALE_LENGTH:
        value *= length;
        break;
    case SCALE_RATE:
        value /= pace;
        break;
    case SCALE_SPREAD:
        value *= length * length / pace;
        break;
    case SCALE_PULL:
        value *= length / pace;
        break;
    case SCALE_PACE:
        value *= pace;
        break;
    }
    return m->least < m->most ? fmin(m->most, fmax(m->least, value)) : value;
}

bool members_scale(const struct members *members, void *of, const struct event_scaling *scaling)
{
    for (const struct member *m = members->first; m < members->first + members->count; m++) {
        void *start = (char *)of + m->offset;
        if (m->kind == MEMBER_DOUBLE)
            for (int i = 0; i < m->count; i++)
                ((double *)start)[i] = number_scale(m, ((double *)start)[i], scaling);
        else if (m->kind == MEMBER_INT)
            for (int i = 0; i < m->count; i++)
                ((int *)start)[i] = (int)lround(number_scale(m, ((int *)start)[i], scaling));
        else if (m->form && m->form->scale && !m->form->scale(start, of, scaling))
            return false;
    }
    return true;
}
