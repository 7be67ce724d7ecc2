/* springs_axes.c - the axes of a variable font as controls: letters are drawn as the axes are,
 * in the boxes that they have. A letter's axes may be led by its strain. */
#include "springs_internal.h"

#include <math.h>
#include <stdlib.h>

static const struct stage_lead leads[] = {
    {"strain", "how far a letter's strain moves that axis: full_strain, as far as it goes"}};

static double axis_read(void *actor, int index)
{
    return *stage_axes_setting(&((struct springs *)actor)->set.axes, index);
}

static unsigned axis_write(void *actor, int index, double value)
{
    struct springs *s = actor;
    return stage_axes_write(&s->axes, &s->set.axes, index, value);
}

int springs_axes_find(struct springs *s, struct font_face *face, struct control *rows)
{
    stage_axes_find(&s->axes, &s->set.axes, face, leads, 1, NULL);
    return stage_axes_rows(&s->axes, rows, axis_read, axis_write);
}

enum stage_status springs_strains_make(struct springs_text *t, int masses_count)
{
    t->owners = calloc((size_t)masses_count + 1, sizeof *t->owners);
    t->strains = calloc((size_t)t->letters_count + 1, sizeof *t->strains);
    if (!t->owners || !t->strains)
        return stage_fail(STAGE_NO_MEMORY, "no memory for letters");
    t->owners_count = masses_count;
    for (int i = 0; i < t->letters_count; i++)
        for (int k = 0; k < 4; k++) {
            int *owner = &t->owners[t->letters[i].masses[k]];
            if (!*owner) /* marks come after their letters */
                *owner = 1 + i;
        }
    return STAGE_OK;
}

static int owner_of(const struct springs_text *t, int mass)
{
    return mass < t->owners_count ? t->owners[mass] - 1 : -1;
}

bool springs_strains_find(const struct springs *s)
{
    const struct springs_text *t = s->text;
    if (!stage_axes_led(&s->axes, &s->set.axes))
        return false;
    for (int i = 0; i < t->letters_count; i++)
        t->strains[i] = (struct springs_strain){0};
    for (int i = 0; i < dyn_springs_count(s->network); i++) {
        const struct dyn_spring spring = dyn_spring_get(s->network, i);
        const int owner = owner_of(t, spring.end[0]);
        if (spring.broken || owner < 0 || owner != owner_of(t, spring.end[1]))
            continue;
        t->strains[owner].sum += dyn_spring_strain(s->network, i);
        t->strains[owner].count++;
    }
    return true;
}

void springs_letter_lead(const struct springs *s, struct stage_springs_letter *letter)
{
    const int owner = owner_of(s->text, letter->masses[0]);
    const struct springs_strain *strain = owner < 0 ? NULL : &s->text->strains[owner];
    if (!strain || !strain->count || letter->letter.face != s->axes.face)
        return;
    const double part = strain->sum / strain->count / s->set.full_strain;
    stage_axes_of(&s->axes, &s->set.axes, &part, &letter->letter.axes);
}
