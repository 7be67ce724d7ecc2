/* flow.c - what all flows between fibers share: how much room a fiber has, and what goes
 * through a face in whole grains. */
#include "model/model.h"

#define FLOWS_FROM 4.0 /* grains; model/film.c */

void sheet_room_make(struct paper_sheet *p, CM_field_id_t room)
{
    CM_field_id_t fields[3];
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    kit_f_copy(room, surface ? p->surface_water : p->page.water);
    for (int i = 0; i < p->config.pigments_count; i++)
        for (int j = sheet_pigment_fields(p, i, fields) - 1; j >= 0; j--)
            kit_f_add(room, room, fields[j]);
    kit_f_from(room, SHEET_LOAD_MAX * p->unit, room);
    kit_f_times(room, room, 2 / (SHEET_LOAD_MAX * p->unit));
    kit_f_least(room, room, 0.0);
    kit_f_most(room, room, 1.0);
}

/* ---- through the faces of an axis ---- */

void sheet_flow_make(struct paper_sheet *p, CM_field_id_t flow, CM_field_id_t up,
                     CM_field_id_t down, CM_field_id_t q, unsigned axis)
{
    CM_field_id_t other = p->t[14];
    kit_f_next(other, q, axis);
    kit_f_mul(other, other, down);
    kit_f_mul(flow, q, up);
    kit_f_sub(flow, flow, other);
    sheet_flow_round(flow);
}

/* What flows up through each face of q is `flow`. Uses t[14]. */
void sheet_flow_take(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t flow, unsigned axis)
{
    CM_field_id_t arriving = p->t[14];
    kit_f_previous(arriving, flow, axis);
    kit_f_add(q, q, arriving);
    kit_f_sub(q, q, flow);
}

/* ---- where water flows ---- */

void sheet_faces_below(struct sheet_faces *faces)
{
    for (unsigned axis = 0; axis < 2; axis++) {
        kit_f_previous(faces->out_below[axis], faces->out[axis], axis);
        kit_f_previous(faces->in_below[axis], faces->in[axis], axis);
    }
}

/* What comes in through the faces below is computed again from the amounts on both sides, as in
 * step.c: a stored flow would take longer. */
void sheet_flow_through(struct paper_sheet *p, CM_field_id_t q, const struct sheet_faces *faces,
                        const double weight[2])
{
    CM_field_id_t free = p->t[8], other = p->t[9], flow = p->t[10],
                  sum[2] = {p->t[11], p->t[12]}, out = p->t[13], in = p->t[14];
    kit_f_plus(free, q, -FLOWS_FROM);
    kit_f_least(free, free, 0.0);
    for (unsigned axis = 0; axis < 2; axis++) {
        const double w = weight ? weight[axis == KIT_AXIS_X ? 0 : 1] : 1;
        kit_f_times(out, faces->out_below[axis], w);
        kit_f_times(in, faces->in_below[axis], w);
        kit_f_previous(other, free, axis);
        sheet_flow_sum(flow, out, other, in, free, p->t[15]);
        kit_f_times(out, faces->out[axis], w);
        kit_f_times(in, faces->in[axis], w);
        kit_f_next(other, free, axis);
        sheet_flow_sum(other, out, free, in, other, p->t[15]);
        kit_f_sub(sum[axis], flow, other);
    }
    kit_f_add(sum[0], sum[0], sum[1]);
    kit_f_add(q, q, sum[0]);
}
