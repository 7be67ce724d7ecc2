/* flow_rounding.c - where flows through faces become whole grains; what moves within a fiber
 * does in sheet_whole_of(). bench/paper_openmp_rounding.h does the same in plain C. Other bits
 * are a new version of the model: PAPER_MODEL_VERSION in sheet.h. */
#include "model/model.h"

void sheet_flow_round(CM_field_id_t flow)
{
    kit_f_whole(flow);
}

void sheet_flow_sum(CM_field_id_t flow, CM_field_id_t out, CM_field_id_t lower,
                    CM_field_id_t in, CM_field_id_t upper, CM_field_id_t part)
{
    kit_f_mul(part, upper, in);
    kit_f_mul(flow, lower, out);
    kit_f_add(flow, flow, part);
    kit_f_plus(flow, flow, KIT_WHOLE);
}
