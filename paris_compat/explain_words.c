/* explain_words.c - shared by the reports as text and as JSON. */
#include "explain.h"

double explain_bound_s(const struct machine_explained_kernel *k, const char **by)
{
    bool computes = k->operations_s > k->copy_s && k->copy_s > 0;
    *by = computes ? "operations" : "bytes";
    return computes ? k->operations_s : k->copy_s;
}

const char *explain_why(enum machine_cut why)
{
    static const char *const names[] = {
        [MACHINE_CUT_LOOKED_AT] = "looked at",
        [MACHINE_CUT_LIVE] = "content of a field or flag",
        [MACHINE_CUT_NEIGHBOURS] = "for neighbours",
        [MACHINE_CUT_LATER] = "for a later kernel",
    };
    return names[why];
}

const char *explain_way(enum machine_plan_way way)
{
    static const char *const names[MACHINE_PLAN_WAYS] = {
#define PLAN_WAY(way, name) name,
#include "plan_way.tab"
#undef PLAN_WAY
    };
    return names[way];
}
