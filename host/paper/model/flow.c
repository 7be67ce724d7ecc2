/* flow.c - what all flows between fibers share: how much room a fiber has, and what goes through a face in whole grains. */
#include "model/model.h"

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

/* flow = whole grains of up * q(x) - down * q(x+1). Uses t[14]. */
void sheet_flow_make(struct paper_sheet *p, CM_field_id_t flow, CM_field_id_t up,
                     CM_field_id_t down, CM_field_id_t q, unsigned axis)
{
    CM_field_id_t other = p->t[14];
    kit_f_next(other, q, axis);
    kit_f_mul(other, other, down);
    kit_f_mul(flow, q, up);
    kit_f_sub(flow, flow, other);
    kit_f_whole(flow);
}

/* What flows up through each face of q is `flow`. Uses t[14]. */
void sheet_flow_take(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t flow, unsigned axis)
{
    CM_field_id_t arriving = p->t[14];
    kit_f_previous(arriving, flow, axis);
    kit_f_add(q, q, arriving);
    kit_f_sub(q, q, flow);
}
