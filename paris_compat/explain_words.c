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

const char *explain_tier(enum machine_tier tier)
{
    static const char *const names[MACHINE_TIERS] = {
        [MACHINE_TIER_INTERPRETED] = "interpreted",
        [MACHINE_TIER_QUICK] = "quick kernels",
        [MACHINE_TIER_OPTIMISED] = "optimised kernels",
        [MACHINE_TIER_BOXED] = "best kernels",
    };
    return names[tier];
}

const char *explain_plan_why(enum machine_plan_why why)
{
    static const char *const names[MACHINE_PLAN_WHYS] = {
        [MACHINE_PLAN_SHORT] = "interpreted: done before a kernel would begin",
        [MACHINE_PLAN_NOT_WORTH] =
            "interpreted: kernels would have saved less than a compiler takes",
        [MACHINE_PLAN_COMPILING] = "interpreted: kernels are being compiled",
        [MACHINE_PLAN_SHARED] = "kernels that take the numbers as arguments",
        [MACHINE_PLAN_OWN] = "kernels of its own",
    };
    return names[why];
}

const char *explain_number(enum machine_number number)
{
    static const char *const names[MACHINE_NUMBERS] = {
        [MACHINE_NUMBER_POSITION] = "bit positions",
        [MACHINE_NUMBER_WIDTH] = "widths in bits",
        [MACHINE_NUMBER_DISTANCE] = "distances",
        [MACHINE_NUMBER_VPSET] = "VP sets",
    };
    return names[number];
}
