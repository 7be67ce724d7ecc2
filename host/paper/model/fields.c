/* fields.c - the fields of a sheet: allocated, emptied, and which a pigment has. */
#include "model/model.h"

#include <assert.h>
#include <stdlib.h>

int sheet_pigment_fields(const struct paper_sheet *p, int i, CM_field_id_t fields[3])
{
    int count = 0;
    if (sheet_has(p, PAPER_PART_SURFACE))
        fields[count++] = p->surface[i];
    fields[count++] = p->infused[i];
    if (sheet_has(p, PAPER_PART_FIXING))
        fields[count++] = p->fixed[i];
    return count;
}

static CM_field_id_t field_make(unsigned bits)
{
    return CM_allocate_heap_field(bits);
}

void sheet_fields_make(struct paper_sheet *p)
{
    CM_field_id_t *const floats[] = {
        &p->page.absorbency, &p->page.water,   &p->page.inflow,   &p->page.inward,
        &p->page.outward,    &p->page.scratch, &p->height,        &p->capacity,
        &p->resist,          &p->face[0],      &p->face[1],       &p->substrate[0],
        &p->substrate[1],    &p->substrate[2], &p->surface_water, &p->wet_around,
        &p->varnish,         &p->salt,         &p->brine,         &p->sizing,
        &p->current,         &p->wet_part,     &p->speed[0],      &p->speed[1],
        &p->ease[0],         &p->ease[1],      &p->swirl,         &p->grip,
        &p->relief,          &p->stained};
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        *floats[i] = field_make(KIT_FLOAT_BITS);
    for (int i = 0; i < p->config.pigments_count; i++) {
        p->surface[i] = field_make(KIT_FLOAT_BITS);
        p->infused[i] = field_make(KIT_FLOAT_BITS);
        p->fixed[i] = field_make(KIT_FLOAT_BITS);
    }
    for (int i = 0; i < SHEET_TEMPORARIES; i++)
        p->t[i] = field_make(KIT_FLOAT_BITS);
    for (int i = 0; i < SHEET_TERMS; i++)
        p->term[i] = field_make(KIT_FLOAT_BITS);
    p->shades = field_make(SHEET_SHADES_BITS);
    p->shade = field_make(SHEET_SHADE_BITS);
    p->shifted = field_make(SHEET_SHADES_BITS);
    p->barred = p->resist;
    if (p->config.deckled) {
        p->thickness = field_make(KIT_FLOAT_BITS);
        p->barred = field_make(KIT_FLOAT_BITS);
    }
    p->dried = field_make(SHEET_DRIED_BITS);
    p->mask = field_make(8);
    p->page.inner_context = field_make(1);
}

/* Fills the fields that change from step to step with zeros that come from outside the machine.
 * The machine knows that a new field is 0 until it is written, and would make other kernels for
 * the first steps. */
enum paper_status sheet_amounts_clear(struct paper_sheet *p)
{
    CM_field_id_t fields[9 + 3 * PAPER_PIGMENTS_MAX];
    int count = 0;
    fields[count++] = p->page.water;
    if (p->config.parts)
        fields[count++] = p->resist;
    if (sheet_has(p, PAPER_PART_SURFACE))
        fields[count++] = p->surface_water;
    if (sheet_has(p, PAPER_PART_SURFACE)) {
        fields[count++] = p->wet_around;
        fields[count++] = p->wet_part;
        fields[count++] = p->stained;
        fields[count++] = p->speed[0];
        fields[count++] = p->speed[1];
    }
    for (int i = 0; i < p->config.pigments_count; i++)
        count += sheet_pigment_fields(p, i, fields + count);
    assert(count <= (int)(sizeof fields / sizeof *fields));
    float *zeros =
        calloc((size_t)p->page.grid.width * (size_t)p->page.grid.height, sizeof *zeros);
    if (!zeros)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet of %dx%d", p->page.grid.width,
                          p->page.grid.height);
    for (int i = 0; i < count; i++)
        kit_grid_f_write(&p->page.grid, fields[i], zeros);
    if (p->config.parts)
        kit_grid_u_write(&p->page.grid, p->dried, SHEET_DRIED_BITS, zeros, CM_32_bit);
    free(zeros);
    return PAPER_OK;
}

void sheet_temporaries_clear(struct paper_sheet *p)
{
    for (int i = 0; i < SHEET_TEMPORARIES; i++)
        kit_f_set(p->t[i], 0.0);
}

void sheet_step_part_end(struct paper_sheet *p)
{
    if (!sheet_parted(p))
        return;
    sheet_temporaries_clear(p);
    CM_warm_boot();
}

void sheet_end_narrow(const struct paper_sheet *p, unsigned axis, bool last)
{
    const struct kit_grid *grid = &p->page.grid;
    const bool x = axis == KIT_AXIS_X;
    CM_u_eq_constant_1L(x ? grid->x_coord : grid->y_coord, (unsigned)p->ends[axis][last],
                        (unsigned)(x ? grid->x_bits : grid->y_bits));
    CM_logand_context_with_test();
}

enum paper_status sheet_leave(struct paper_sheet *p)
{
    CM_set_context();
    if (p->config.parts)
        sheet_temporaries_clear(p);
    return paper_leave(&p->page);
}
