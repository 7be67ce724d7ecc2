/* network_write.c - see network_file.h. */
#include "internal.h"
#include "network_file.h"

#include <number_text.h>
#include <output_file.h>
#include <string.h>

/* Prints name=value for fields that differ from the usual value. */
static void fields_print(FILE *to, const struct control *fields, int count, const void *of)
{
    for (int i = 0; i < count; i++) {
        double value = control_read(&fields[i], of);
        if (memcmp(&value, &fields[i].usual, sizeof value) == 0) /* -0 is not 0 */
            continue;
        fprintf(to, " %s=", fields[i].name);
        number_text_print(to, value);
    }
}

static void world_print(FILE *to, const struct dyn_world *world)
{
    for (int i = 0; i < dyn_controls_count; i++) {
        const struct control *c = &dyn_controls[i];
        double value = control_read(c, world);
        if (value == c->usual)
            continue;
        fprintf(to, "control %s ", c->name);
        number_text_print(to, value);
        fputc('\n', to);
    }
}

static void mass_print(FILE *to, const struct dyn_mass *mass)
{
    static const char *const holds[] = {"", " stuck", " held", " stuck held"};
    fputs("mass", to);
    fields_print(to, dyn_mass_fields, dyn_mass_fields_count, mass);
    fprintf(to, "%s\n", holds[mass->hold]);
}

static void spring_print(FILE *to, const struct dyn_spring *spring)
{
    fprintf(to, "spring %d %d", spring->end[0], spring->end[1]);
    fields_print(to, dyn_spring_fields, dyn_spring_fields_count, spring);
    if (spring->rest_length == dyn_spring_field_find("rest_length")->usual)
        fprintf(to, " rest_length=%g", spring->rest_length); /* the default is the distance
                                                              * of the ends */
    fputs(spring->broken ? " broken\n" : "\n", to);
}

static void pull_print(FILE *to, const struct dyn_pull *pull)
{
    const double values[] = {pull->x, pull->y, pull->constant, pull->damping};
    fprintf(to, "pull %d", pull->mass);
    for (int i = 0; i < 4; i++) {
        fputc(' ', to);
        number_text_print(to, values[i]);
    }
    fputc('\n', to);
}

static enum dyn_status look(const struct dyn_network *n)
{
    if (!(n->time_s >= -DYN_TIME_MAX && n->time_s <= DYN_TIME_MAX))
        return dyn_fail(DYN_BAD_ARGUMENT, "a network's time cannot be %g s", n->time_s);
    for (int i = 0; i < n->masses_count; i++) {
        struct dyn_mass mass = dyn_mass_get(n, i);
        if (dyn_controls_check(dyn_mass_fields, dyn_mass_fields_count, &mass) != DYN_OK)
            return dyn_fail(DYN_BAD_ARGUMENT, "mass %d: %s", i, dyn_error());
    }
    return DYN_OK;
}

enum dyn_status dyn_network_print(const struct dyn_network *n, FILE *to)
{
    struct number_text_locale locale;
    enum dyn_status status = look(n);
    if (status != DYN_OK)
        return status;
    if (!number_text_begin(&locale))
        return dyn_fail(DYN_NO_MEMORY, "no memory for a locale");
    fputs("springs 1\ntime_s ", to);
    number_text_print(to, n->time_s);
    fputc('\n', to);
    world_print(to, &n->world);
    for (int i = 0; i < n->masses_count; i++) {
        struct dyn_mass mass = dyn_mass_get(n, i);
        mass_print(to, &mass);
    }
    for (int i = 0; i < n->springs_count; i++) {
        struct dyn_spring spring = dyn_spring_get(n, i);
        spring_print(to, &spring);
    }
    for (int i = 0; i < n->pulls_count; i++)
        pull_print(to, &n->pulls[i]);
    fputs("end\n", to);
    number_text_end(&locale);
    return DYN_OK;
}

enum dyn_status dyn_network_write(const struct dyn_network *n, const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return dyn_fail(DYN_BAD_FILE, "%s: cannot write: %s", path, out.why);
    enum dyn_status status = dyn_network_print(n, out.stream);
    if (status != DYN_OK) {
        output_file_abandon(&out);
        return status;
    }
    if (!output_file_commit(&out))
        return dyn_fail(DYN_BAD_FILE, "%s: cannot write: %s", path, out.why);
    return DYN_OK;
}
