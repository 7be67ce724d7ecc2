/* flow.c - what all flows between fibers share: how much room a fiber has, and what goes through a face in whole grains. */
#include "model/model.h"

void sheet_room_make(struct paper_sheet *p, CM_field_id_t room)
{
    CM_field_id_t fields[3];
    bool surface = sheet_has(p, PAPER_PART_SURFACE);
    f_copy(room, surface ? p->surface_water : p->page.water);
    for (int i = 0; i < p->config.pigments_count; i++)
        for (int j = sheet_pigment_fields(p, i, fields) - 1; j >= 0; j--)
            f_add(room, room, fields[j]);
    f_from(room, SHEET_LOAD_MAX * p->unit, room);
    f_times(room, room, 2 / (SHEET_LOAD_MAX * p->unit));
    f_least(room, room, 0.0);
    f_most(room, room, 1.0);
}

/* flow = whole grains of up * q(x) - down * q(x+1). Uses t[14]. */
void sheet_flow_make(struct paper_sheet *p, CM_field_id_t flow, CM_field_id_t up,
                     CM_field_id_t down, CM_field_id_t q, unsigned axis)
{
    CM_field_id_t other = p->t[14];
    f_next(other, q, axis);
    f_mul(other, other, down);
    f_mul(flow, q, up);
    f_sub(flow, flow, other);
    f_whole(flow);
}

/* What flows up through each face of q is `flow`. Uses t[14]. */
void sheet_flow_take(struct paper_sheet *p, CM_field_id_t q, CM_field_id_t flow, unsigned axis)
{
    CM_field_id_t arriving = p->t[14];
    f_previous(arriving, flow, axis);
    f_add(q, q, arriving);
    f_sub(q, q, flow);
}
