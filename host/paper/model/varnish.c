/* varnish.c - clear gloss on the paper. Under it less light is scattered at the fibers, so
 * colours are deeper; where it begins and ends it shines or is in shade, with light from the
 * upper left. */
#include "model/model.h"
#include "techniques.h"

#define DEEPENING 0.4
#define DULLING 0.05 /* of all light: some is caught under the gloss */
#define SHINE 0.35
#define SHADE 0.25

enum paper_status sheet_varnish_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    return sheet_place_check(&((const struct paper_varnish *)arguments)->place);
}

enum paper_status sheet_varnish(struct paper_sheet *p, const void *arguments)
{
    const struct paper_varnish *v = arguments;
    sheet_change_place(p, &v->place);
    CM_set_context();
    CM_field_id_t share = p->t[1];
    enum paper_status status = sheet_share_make(p, &v->place, share);
    if (status != PAPER_OK)
        return status;
    kit_f_times(share, share, v->amount);
    kit_f_max(p->varnish, p->varnish, share);
    p->varnished = true;
    return sheet_leave(p);
}

/* slope += the varnish of the next fiber, or slope -= the varnish of the previous one. Beyond
 * the edge it is as thick as at the edge. */
static void beside(struct paper_sheet *p, CM_field_id_t slope, CM_field_id_t other,
                   unsigned axis, bool next)
{
    if (next)
        kit_f_next(other, p->varnish, axis);
    else
        kit_f_previous(other, p->varnish, axis);
    if (!p->config.torus) {
        sheet_end_narrow(p, axis, next);
        kit_f_copy(other, p->varnish);
        CM_set_context();
    }
    if (next)
        kit_f_add(slope, slope, other);
    else
        kit_f_sub(slope, slope, other);
}

void sheet_varnish_shine(struct paper_sheet *p, const CM_field_id_t color[3])
{
    CM_field_id_t slope = p->t[0], other = p->t[1], part = p->t[2];
    kit_f_set(slope, 0.0);
    for (unsigned axis = 0; axis < 2; axis++) {
        beside(p, slope, other, axis, true);
        beside(p, slope, other, axis, false);
    }
    kit_f_most(slope, slope, 1.0);
    kit_f_least(slope, slope, -1.0);
    for (int i = 0; i < 3; i++) {
        /* c (1 - v (dulling + deepening (1 - c))) */
        kit_f_from(part, 1.0, color[i]);
        kit_f_times(part, part, -DEEPENING);
        kit_f_plus(part, part, -DULLING);
        kit_f_mul(part, part, p->varnish);
        kit_f_plus(part, part, 1.0);
        kit_f_mul(color[i], color[i], part);
        /* rising away from the light's side it shines, falling it is in shade */
        kit_f_least(part, slope, 0.0);
        kit_f_times(part, part, SHINE);
        kit_f_from(other, 1.0, color[i]);
        kit_f_mul(part, part, other);
        kit_f_add(color[i], color[i], part);
        kit_f_most(part, slope, 0.0);
        kit_f_times(part, part, SHADE);
        kit_f_mul(part, part, color[i]);
        kit_f_add(color[i], color[i], part);
    }
}
