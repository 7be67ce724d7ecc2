/* explain_json.c - the report as a JSON object. */
#include "explain.h"

void explain_json_text(FILE *out, const char *s)
{
    fputc('"', out);
    for (; *s; s++) {
        unsigned char c = (unsigned char)*s;
        if (c == '"' || c == '\\')
            fputc('\\', out);
        fputc(c < 0x20 || c >= 0x7f ? '?' : c, out);
    }
    fputc('"', out);
}

/* second: the name of these rows' bytes; NULL: they have none. */
static void rows(FILE *out, const char *name, const struct machine_explained_row *r, int count,
                 const char *second, bool times)
{
    fprintf(out, ",\n \"%s\": [", name);
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s\n  {\"name\": ", i ? "," : "");
        explain_json_text(out, r[i].name);
        fprintf(out, ", \"count\": %llu", (unsigned long long)r[i].count);
        if (second)
            fprintf(out, ", \"%s\": %llu", second, (unsigned long long)r[i].bytes);
        if (times)
            fprintf(out, ", \"time_s\": %.9g", r[i].time_s);
        fprintf(out, "}");
    }
    fprintf(out, "]");
}

static void stores(FILE *out, const struct machine_explained_kernel *k)
{
    fprintf(out, ",\n   \"stores\": [");
    for (int i = 0; i < k->stores_count; i++) {
        const struct machine_explained_store *s = &k->stores[i];
        fprintf(out, "%s{\"where\": ", i ? ", " : "");
        explain_json_text(out, s->where);
        fprintf(out, ", \"operation\": ");
        explain_json_text(out, s->operation);
        fprintf(out, ", \"type\": \"%s%d\", \"in_ring\": %s, \"why\": \"%s\"}",
                s->type.kind == MACHINE_FLOAT ? "f" : "u", s->type.width,
                s->in_ring ? "true" : "false", explain_why(s->why));
    }
    fprintf(out, "]");
}

/* Ways that were considered, with what they cost by the model. */
static void plan(FILE *out, const struct machine_explained_kernel *k)
{
    const char *before = "";
    fprintf(out,
            ", \"predicted_s\": %.9g,\n   \"plan\": {\"chosen\": \"%s\", \"forced\": %s, "
            "\"costs_s\": {",
            k->predicted_s, explain_way(k->plan.chosen), k->plan.forced ? "true" : "false");
    for (int i = 0; i < MACHINE_PLAN_WAYS; i++)
        if (k->plan.cost_s[i] > 0) {
            fprintf(out, "%s\"%s\": %.9g", before, explain_way((enum machine_plan_way)i),
                    k->plan.cost_s[i]);
            before = ", ";
        }
    fprintf(out, "}}");
}

static void kernel(FILE *out, const struct machine_explained_kernel *k)
{
    const char *by;
    double bound_s = explain_bound_s(k, &by);
    fprintf(out, "{\"name\": ");
    explain_json_text(out, k->name);
    fprintf(out,
            ", \"generated\": %s, \"runs\": %llu, \"runs_timed\": %llu, \"time_s\": %.9g, ",
            k->generated ? "true" : "false", (unsigned long long)k->runs,
            (unsigned long long)k->runs_timed, k->time_s);
    fprintf(out, "\"bytes\": %llu, \"copy_s\": %.9g, \"operations_s\": %.9g, ",
            (unsigned long long)k->bytes, k->copy_s, k->operations_s);
    fprintf(out, "\"bound_s\": %.9g, \"bound_by\": \"%s\"", bound_s, by);
    if (k->generated) {
        fprintf(out,
                ",\n   \"vp_set\": %d, \"processors\": %llu, \"operations\": %d, "
                "\"operations_cost\": %d, \"arrays_read\": %d, \"arrays_written\": %d, ",
                k->vpset, (unsigned long long)k->processors, k->operations, k->operations_cost,
                k->arrays_read, k->arrays_written);
        fprintf(out,
                "\"bytes_read\": %d, \"bytes_written\": %d, \"shifts_computed\": %d, "
                "\"stages\": %d, \"rings\": %d, \"tile\": [%d, %d], \"split\": %s, \"made\": "
                "\"%s\"",
                k->bytes_read, k->bytes_written, k->shifts_computed, k->stages, k->rings,
                k->tile_width, k->tile_height, k->split ? "true" : "false", k->made);
        plan(out, k);
        stores(out, k);
    }
    fprintf(out, "}");
}

static void family(FILE *out, const struct machine_explained_family *f)
{
    const char *before = "";
    fprintf(out, "{\"name\": ");
    explain_json_text(out, f->name);
    fprintf(out, ", \"values\": %d, \"plans\": %llu, \"runs\": {", f->nodes,
            (unsigned long long)f->plans);
    for (int i = 0; i < MACHINE_TIERS; i++)
        fprintf(out, "%s\"%s\": %llu", i ? ", " : "", explain_tier((enum machine_tier)i),
                (unsigned long long)f->runs[i]);
    fprintf(out, "}, \"why\": {");
    for (int i = 0; i < MACHINE_PLAN_WHYS; i++)
        fprintf(out, "%s\"%s\": %llu", i ? ", " : "",
                explain_plan_why((enum machine_plan_why)i), (unsigned long long)f->why[i]);
    fprintf(out, "}, \"differ\": {");
    for (int i = 0; i < MACHINE_NUMBERS; i++)
        if (f->differ[i].differs) {
            fprintf(out, "%s\"%s\": [%d, %d]", before, explain_number((enum machine_number)i),
                    f->differ[i].least, f->differ[i].most);
            before = ", ";
        }
    fprintf(out, "}}");
}

void explain_json(FILE *out, const struct machine_explained *x)
{
    fprintf(out, "{\"device\": ");
    explain_json_text(out, x->device);
    fprintf(out, ", \"costs_from\": ");
    explain_json_text(out, x->costs_from);
    fprintf(out, ", \"processors\": %d, \"stores\": %llu,\n", x->processors_count,
            (unsigned long long)x->stores);
    fprintf(out, " \"calls_recorded\": %llu, \"calls_foreseen\": %llu",
            (unsigned long long)x->calls_recorded, (unsigned long long)x->calls_foreseen);
    rows(out, "calls", x->calls, x->calls_count, "foreseen", true);
    fprintf(out,
            ",\n \"values_computed\": %llu, \"values_stored\": %llu, \"values_vanished\": %llu",
            (unsigned long long)x->values_computed, (unsigned long long)x->values_stored,
            (unsigned long long)x->values_vanished);
    rows(out, "vanished", x->vanished, x->vanished_count, NULL, false);
    rows(out, "vanished_because", x->reasons, x->reasons_count, NULL, false);
    rows(out, "evaluated_because", x->evaluations, x->evaluations_count, NULL, false);
    fprintf(out, ",\n \"plans_built\": %llu, \"plans_improved\": %llu, \"kernels_gone\": %llu",
            (unsigned long long)x->plans_built, (unsigned long long)x->plans_improved,
            (unsigned long long)x->kernels_gone);
    fprintf(out, ",\n \"families\": [");
    for (int i = 0; i < x->families_count; i++) {
        fprintf(out, "%s\n  ", i ? "," : "");
        family(out, &x->families[i]);
    }
    fprintf(out, "]");
    rows(out, "phases", x->phases, x->phases_count, NULL, true);
    rows(out, "waits", x->transfers, x->transfers_count, "bytes", true);
    fprintf(out, ",\n \"copy_bytes\": %llu, \"copy_bytes_per_s\": %.9g,\n \"kernels\": [",
            (unsigned long long)x->copy_bytes, x->copy_bytes_per_s);
    for (int i = 0; i < x->kernels_count; i++) {
        fprintf(out, "%s\n  ", i ? "," : "");
        kernel(out, &x->kernels[i]);
    }
    fprintf(out, "]}");
}
