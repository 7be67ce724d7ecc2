/* fields.c - see fields.h. */
#include "fields.h"
#include "internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define MASS(member) .at = offsetof(struct dyn_mass, member)
#define SPRING(member) .at = offsetof(struct dyn_spring, member)

const struct control dyn_mass_fields[] = {
    {"x", "units", -1e6, 1e6, 0, CONTROL_LINEAR, NULL, "where it is", MASS(x)},
    {"y", "units", -1e6, 1e6, 0, CONTROL_LINEAR, NULL, "where it is, upwards", MASS(y)},
    {"vx", "units/s", -DYN_SPEED_MAX, DYN_SPEED_MAX, 0, CONTROL_LINEAR, NULL,
     "how fast it goes", MASS(vx)},
    {"vy", "units/s", -DYN_SPEED_MAX, DYN_SPEED_MAX, 0, CONTROL_LINEAR, NULL,
     "how fast it goes, upwards", MASS(vy)},
    {"mass", "kg", 1e-6, 1e6, 1, CONTROL_LOGARITHMIC, NULL, "what it weighs", MASS(mass)},
    {"drag", "kg/s", 0, 1e6, 0, CONTROL_LOGARITHMIC, NULL,
     "the air's drag on it, beside the world's", MASS(drag)},
    {"gravity", "", -10, 10, 1, CONTROL_LINEAR, NULL,
     "how much of the world's gravity it feels", MASS(gravity)},
    {"restitution", "", 0, 10, 1, CONTROL_LINEAR, NULL,
     "of the world's; their product counts to 1", MASS(restitution)},
    {"friction", "", 0, 100, 1, CONTROL_LINEAR, NULL, "of the world's", MASS(friction)},
};
const int dyn_mass_fields_count = sizeof dyn_mass_fields / sizeof *dyn_mass_fields;

const struct control dyn_spring_fields[] = {
    {"constant", "kg/s2", 0, 1e9, 100, CONTROL_LOGARITHMIC, NULL, "how strong it is",
     SPRING(constant)},
    {"rest_length", "units", 0, 1e7, 1, CONTROL_LOGARITHMIC, NULL, "how long it would be",
     SPRING(rest_length)},
    {"damping", "kg/s", 0, 1e7, 0, CONTROL_LOGARITHMIC, NULL,
     "how it resists changes of its length", SPRING(damping)},
    {"breaking_strain", "", 0, INFINITY, INFINITY, CONTROL_LOGARITHMIC, NULL,
     "by which part of its rest length it can be longer", SPRING(breaking_strain)},
};
const int dyn_spring_fields_count = sizeof dyn_spring_fields / sizeof *dyn_spring_fields;

static const struct control *field_find(const struct control *fields, int count, const char *of,
                                        const char *name)
{
    char names[200];
    const struct control *row = control_find(fields, count, name, names, sizeof names);
    if (!row)
        dyn_fail(DYN_BAD_ARGUMENT, "a %s has no '%.40s'; it has %s", of, name, names);
    return row;
}

const struct control *dyn_mass_field_find(const char *name)
{
    return field_find(dyn_mass_fields, dyn_mass_fields_count, "mass", name);
}

const struct control *dyn_spring_field_find(const char *name)
{
    return field_find(dyn_spring_fields, dyn_spring_fields_count, "spring", name);
}

enum dyn_status dyn_mass_check(const struct dyn_network *n, int mass)
{
    if (mass < 0 || mass >= n->masses_count)
        return dyn_fail(DYN_BAD_ARGUMENT, "there is no mass %d (of %d)", mass, n->masses_count);
    return DYN_OK;
}

enum dyn_status dyn_spring_check(const struct dyn_network *n, int spring)
{
    if (spring < 0 || spring >= n->springs_count)
        return dyn_fail(DYN_BAD_ARGUMENT, "there is no spring %d (of %d)", spring,
                        n->springs_count);
    return DYN_OK;
}
