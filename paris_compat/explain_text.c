/* explain_text.c - the report as text. */
#include "explain.h"

#include <string.h>

enum { CALLS_SHOWN = 40, KERNELS_SHOWN = 20, FAMILIES_SHOWN = 12, STORES_SHOWN = 12 };

static void print_calls(FILE *out, const struct machine_explained *x)
{
    fprintf(out,
            "recorded: %llu instructions; %llu more were foreseen and not recorded again\n\n",
            (unsigned long long)x->calls_recorded, (unsigned long long)x->calls_foreseen);
    fprintf(out, "    recorded   foreseen   us each  instruction\n");
    for (int i = 0; i < x->calls_count && i < CALLS_SHOWN; i++) {
        const struct machine_explained_row *r = &x->calls[i];
        char each[20] = "";
        if (r->time_s > 0)
            snprintf(each, sizeof each, "%.2f", r->time_s / (double)r->count * 1e6);
        fprintf(out, "  %10llu %10llu %9s  %s\n", (unsigned long long)r->count,
                (unsigned long long)r->bytes, each, r->name);
    }
    if (x->calls_count > CALLS_SHOWN)
        fprintf(out, "  and %d other instructions\n", x->calls_count - CALLS_SHOWN);
}

static void print_vanished(FILE *out, const struct machine_explained *x)
{
    uint64_t known = x->values_computed + x->values_vanished;
    fprintf(out,
            "\nvanished: of %llu values recorded, %llu were computed, %llu were never; %llu "
            "times one "
            "was put into memory\n\n",
            (unsigned long long)known, (unsigned long long)x->values_computed,
            (unsigned long long)x->values_vanished, (unsigned long long)x->values_stored);
    if (x->vanished_count)
        fprintf(out, "  never computed:");
    for (int i = 0; i < x->vanished_count; i++)
        fprintf(out, "%s%s %llu",
                i == 0  ? " "
                : i % 7 ? ", "
                        : ",\n      ",
                x->vanished[i].name, (unsigned long long)x->vanished[i].count);
    fprintf(out, "%s  because, so many times:\n", x->vanished_count ? "\n" : "");
    for (int i = 0; i < x->reasons_count; i++)
        if (x->reasons[i].count)
            fprintf(out, "  %10llu  %s\n", (unsigned long long)x->reasons[i].count,
                    x->reasons[i].name);
}

static void print_cuts(FILE *out, const struct machine_explained *x)
{
    fprintf(out, "\ncut: plans made: %llu, made better: %llu; evaluated because\n",
            (unsigned long long)x->plans_built, (unsigned long long)x->plans_improved);
    for (int i = 0; i < x->evaluations_count; i++)
        if (x->evaluations[i].count)
            fprintf(out, "  %10llu  %s\n", (unsigned long long)x->evaluations[i].count,
                    x->evaluations[i].name);
    uint64_t by_why[MACHINE_CUT_LATER + 1] = {0}, split = 0;
    for (int i = 0; i < x->kernels_count; i++) {
        split += x->kernels[i].split;
        for (int k = 0; k < x->kernels[i].stores_count; k++)
            if (!x->kernels[i].stores[k].in_ring)
                by_why[x->kernels[i].stores[k].why] += x->kernels[i].runs;
    }
    fprintf(out, "  values put into memory, by why\n");
    for (int i = 0; i <= MACHINE_CUT_LATER; i++)
        if (by_why[i])
            fprintf(out, "  %10llu  %s\n", (unsigned long long)by_why[i],
                    explain_why((enum machine_cut)i));
    if (x->kernels_gone)
        fprintf(out, "  %10llu  kernels had to leave memory for others\n",
                (unsigned long long)x->kernels_gone);
    if (split)
        fprintf(out, "  %10llu  kernels are parts of one that had too many arguments\n",
                (unsigned long long)split);
}

/* Plans that are the same but for numbers. */
static void print_family(FILE *out, const struct machine_explained_family *f)
{
    const char *before = ": ";
    fprintf(out, "  %10llu  %s, of %d values", (unsigned long long)f->plans, f->name, f->nodes);
    for (int i = 0; i < MACHINE_TIERS; i++)
        if (f->runs[i]) {
            fprintf(out, "%s%llu run%s %s", before, (unsigned long long)f->runs[i],
                    f->runs[i] == 1 ? "" : "s", explain_tier((enum machine_tier)i));
            before = ", ";
        }
    fprintf(out, "\n");
    before = "              which differ in ";
    bool differ = false;
    for (int i = 0; i < MACHINE_NUMBERS; i++)
        if (f->differ[i].differs) {
            fprintf(out, "%s%s (%d to %d)", before, explain_number((enum machine_number)i),
                    f->differ[i].least, f->differ[i].most);
            before = ", ";
            differ = true;
        }
    fprintf(out, differ ? "\n" : "");
    for (int i = 0; i < MACHINE_PLAN_WHYS; i++)
        if (f->why[i])
            fprintf(out, "              %llu %s\n", (unsigned long long)f->why[i],
                    explain_plan_why((enum machine_plan_why)i));
}

static void print_families(FILE *out, const struct machine_explained *x)
{
    if (x->families_count)
        fprintf(out,
                "\nplans that differ only in numbers, together; those that ran most first\n");
    for (int i = 0; i < x->families_count && i < FAMILIES_SHOWN; i++)
        print_family(out, &x->families[i]);
    if (x->families_count > FAMILIES_SHOWN)
        fprintf(out, "  and %d more\n", x->families_count - FAMILIES_SHOWN);
}

static void print_stores(FILE *out, const struct machine_explained_kernel *k)
{
    for (int i = 0; i < k->stores_count && i < STORES_SHOWN; i++) {
        const struct machine_explained_store *s = &k->stores[i];
        fprintf(out, "       %s %s%s%s, %s of %d bits: %s\n",
                !s->in_ring     ? "stores"
                : k->tile_width ? "keeps tiles of"
                                : "keeps a few rows of",
                s->where, *s->where ? " = " : "", s->operation,
                s->type.kind == MACHINE_FLOAT ? "float" : "word", s->type.width,
                explain_why(s->why));
    }
    if (k->stores_count > STORES_SHOWN)
        fprintf(out, "       and %d more\n", k->stores_count - STORES_SHOWN);
}

/* What the cost model says of it, and of the plans that its plan was preferred to. */
static void print_prediction(FILE *out, const struct machine_explained_kernel *k, double mean_s)
{
    const struct machine_explained_plan *p = &k->plan;
    if (k->predicted_s > 0 && mean_s > 0)
        fprintf(out, "       predicted %.4g us, measured %.4g us (%.2f times that)\n",
                k->predicted_s * 1e6, mean_s * 1e6, mean_s / k->predicted_s);
    else if (k->predicted_s > 0)
        fprintf(out, "       predicted %.4g us\n", k->predicted_s * 1e6);
    fprintf(out, "       of a plan %s, %.4g us%s", explain_way(p->chosen),
            p->cost_s[p->chosen] * 1e6, p->forced ? ", which was asked for" : "");
    const char *before = p->forced ? "; else: " : "; preferred to: ";
    for (int i = 0; i < MACHINE_PLAN_WAYS; i++) {
        bool same = i == MACHINE_PLAN_STORED && p->cost_s[i] <= p->cost_s[MACHINE_PLAN_ROWS];
        if (i == (int)p->chosen || p->cost_s[i] <= 0 || same)
            continue;
        fprintf(out, "%s%s, %.4g us", before, explain_way((enum machine_plan_way)i),
                p->cost_s[i] * 1e6);
        before = "; ";
    }
    fprintf(out, "\n");
}

static void print_kernel(FILE *out, const struct machine_explained_kernel *k, int number,
                         double all_s)
{
    const char *by;
    double mean_s = k->runs_timed ? k->time_s / (double)k->runs_timed : 0,
           bound_s = explain_bound_s(k, &by);
    fprintf(out, "\n  %2d.  %s\n", number, k->name);
    fprintf(out, "       %llu run%s", (unsigned long long)k->runs, k->runs == 1 ? "" : "s");
    if (mean_s > 0)
        fprintf(out, ", %.4g s in all (%.1f %%), %.4g us each", k->time_s,
                all_s > 0 ? 100 * k->time_s / all_s : 0, mean_s * 1e6);
    fprintf(out, "\n");
    if (mean_s > 0 && bound_s > 0)
        fprintf(out,
                bound_s < mean_s ? "       %s %.4g us: it runs at %.0f %% of that speed\n"
                                 : "       %s %.4g us: it takes no longer (%.0f %%)\n",
                *by == 'o' ? "its operations take, by the cost model,"
                           : "to copy as many bytes takes",
                bound_s * 1e6, 100 * bound_s / mean_s);
    if (k->generated)
        print_prediction(out, k, mean_s);
    if (!k->generated) {
        fprintf(out, "       by hand, on %.4g MB of arrays a run\n",
                1e-6 * (double)k->bytes / (double)(k->runs ? k->runs : 1));
        return;
    }
    fprintf(out,
            "       VP set %d, %llu processors; each reads %d bytes (%d array%s), writes %d "
            "(%d), %d operations (cost %d); %s\n",
            k->vpset, (unsigned long long)k->processors, k->bytes_read, k->arrays_read,
            k->arrays_read == 1 ? "" : "s", k->bytes_written, k->arrays_written, k->operations,
            k->operations_cost, k->made);
    if (k->tile_width)
        fprintf(out,
                "       in tiles of %d x %d: %d stages in one go, %d values kept in local "
                "memory, in no array\n",
                k->tile_width, k->tile_height, k->stages, k->rings);
    else if (k->stages > 1)
        fprintf(out,
                "       in strips: %d stages in one go, %d values kept for a few rows, "
                "in no array\n",
                k->stages, k->rings);
    if (k->shifts_computed)
        fprintf(out, "       neighbours' values computed again, not stored first: %d\n",
                k->shifts_computed);
    print_stores(out, k);
}

static void print_rows(FILE *out, const char *title, const struct machine_explained_row *rows,
                       int count)
{
    if (count)
        fprintf(out, "\n%s\n\n       times          ms  what\n", title);
    for (int i = 0; i < count; i++) {
        fprintf(out, "  %10llu %11.3f  %s", (unsigned long long)rows[i].count,
                1e3 * rows[i].time_s, rows[i].name);
        if (rows[i].bytes)
            fprintf(out, " (%.4g MB)", 1e-6 * (double)rows[i].bytes);
        fprintf(out, "\n");
    }
}

void explain_text(FILE *out, const struct machine_explained *x)
{
    double all_s = 0;
    fprintf(out, "a machine of %d processors on %s\n\n", x->processors_count, x->device);
    print_calls(out, x);
    print_vanished(out, x);
    print_cuts(out, x);
    print_families(out, x);
    for (int i = 0; i < x->kernels_count; i++)
        all_s += x->kernels[i].time_s;
    fprintf(out, "\nkernels, those that took most time first");
    if (x->copy_bytes_per_s > 0)
        fprintf(out, " (a copy of %.4g MB runs at %.4g GB/s here)",
                1e-6 * (double)x->copy_bytes, 1e-9 * x->copy_bytes_per_s);
    fprintf(out, "\nthe cost model's numbers: %s\n", x->costs_from);
    for (int i = 0; i < x->kernels_count && i < KERNELS_SHOWN; i++)
        print_kernel(out, &x->kernels[i], i + 1, all_s);
    if (x->kernels_count > KERNELS_SHOWN)
        fprintf(out, "\n  and %d more\n", x->kernels_count - KERNELS_SHOWN);
    print_rows(out, "the front end's time (one may be in another)", x->phases, x->phases_count);
    print_rows(out, "the front end waited for the device", x->transfers, x->transfers_count);
}
