/* claims.c - see claims.h. */
#include "codegen/claims.h"

void claims_add(struct arguments *to, bool *failed)
{
    emit_argument(to, ARGUMENT_CLAIMS, 0, 0, failed);
    emit_argument(to, ARGUMENT_CLAIM, 0, 4, failed);
}

bool claims_declare(struct text *t, const struct kernel_argument *a)
{
    if (a->kind == ARGUMENT_CLAIMS)
        text_put(t, ",\n    volatile __global int *claims");
    else if (a->kind == ARGUMENT_CLAIM)
        text_put(t, ", int claim");
    return a->kind == ARGUMENT_CLAIMS || a->kind == ARGUMENT_CLAIM;
}

const char *claims_place(bool claimed)
{
    /* A kernel that is only compiled computes nothing: RUN is negative (plans/compiler.c). */
    return claimed ? "    int down = get_global_id(1), across = get_global_id(0);\n"
                     "    if (RUN > 0 && claim) {\n"
                     "        const int wide = get_global_size(0);\n"
                     "        down = claim_place(claims, claim, wide * get_global_size(1));\n"
                     "        across = wide > 1 ? down % wide : 0;\n"
                     "        down = wide > 1 ? down / wide : down;\n    }\n"
                   : "    const int down = get_global_id(1), across = get_global_id(0);\n";
}
