/* spring_controls.c - see spring_controls.h. */
#include "spring_controls.h"
#include "internal.h"

#include <string.h>

#define AT(member) .at = offsetof(struct dyn_world, member)
#define FAR_AWAY 1e5 /* limit of the sides' places: well within the edges of the plane */

const struct control dyn_controls[] = {
    {"gravity", "units/s2", -100, 100, 9.81, CONTROL_CENTRED, NULL, "pulls masses down",
     AT(gravity)},
    {"wind_x", "units/s", -100, 100, 0, CONTROL_CENTRED, NULL,
     "what drag drags along: the air's speed to the right", AT(wind_x)},
    {"wind_y", "units/s", -100, 100, 0, CONTROL_CENTRED, NULL, "the air's speed upwards",
     AT(wind_y)},
    {"drag", "kg/s", 0, 1000, 0.02, CONTROL_LOGARITHMIC, NULL,
     "viscous damping: how strongly the air slows masses down", AT(drag)},
    {"stiffness", "", 0, 1000, 1, CONTROL_LOGARITHMIC, NULL, "of all springs' constants",
     AT(stiffness)},
    {"damping", "", 0, 1000, 1, CONTROL_LOGARITHMIC, NULL, "of all springs' damping",
     AT(damping)},
    {"rest", "", 0.01, 10, 1, CONTROL_LOGARITHMIC, NULL, "of all springs' rest lengths",
     AT(rest)},
    {"mass", "", 0.001, 1000, 1, CONTROL_LOGARITHMIC, NULL, "of all masses", AT(mass)},
    {"breaking", "", 0.001, 1000, 1, CONTROL_LOGARITHMIC, NULL,
     "of all springs' breaking strains; those that never break never do", AT(breaking)},
    {"restitution", "", 0, 1, 0.6, CONTROL_LINEAR, NULL,
     "how much of its speed a mass has after a bounce", AT(restitution)},
    {"friction", "", 0, 10, 0.3, CONTROL_CENTRED, NULL,
     "Coulomb's: how much of a bounce's change of speed is taken from the speed along the "
     "floor",
     AT(friction)},
    {"floor_on", "", 0, 1, 1, CONTROL_SWITCH, NULL, "there is a floor", AT(floor_on)},
    {"floor", "units", -FAR_AWAY, FAR_AWAY, 0, CONTROL_LINEAR, NULL, "how high the floor is",
     AT(floor)},
    {"ceiling_on", "", 0, 1, 0, CONTROL_SWITCH, NULL, "there is a ceiling", AT(ceiling_on)},
    {"ceiling", "units", -FAR_AWAY, FAR_AWAY, 10, CONTROL_LINEAR, NULL,
     "how high the ceiling is", AT(ceiling)},
    {"left_on", "", 0, 1, 0, CONTROL_SWITCH, NULL, "there is a wall on the left", AT(left_on)},
    {"left", "units", -FAR_AWAY, FAR_AWAY, -10, CONTROL_LINEAR, NULL, "where the left wall is",
     AT(left)},
    {"right_on", "", 0, 1, 0, CONTROL_SWITCH, NULL, "there is a wall on the right",
     AT(right_on)},
    {"right", "units", -FAR_AWAY, FAR_AWAY, 10, CONTROL_LINEAR, NULL, "where the right wall is",
     AT(right)},
    {"speed_limit", "units/s", 1, DYN_SPEED_MAX, 1000, CONTROL_LOGARITHMIC, NULL,
     "no mass is faster along an axis", AT(speed_limit)},
    {"clank_speed", "units/s", 0, 1000, 0.2, CONTROL_LOGARITHMIC, NULL,
     "bounces that leave a mass slower are not heard", AT(clank_speed)},
    {"safety", "", 0.05, 0.95, 0.5, CONTROL_LINEAR, NULL,
     "the longest part of a step, of what would just be stable", AT(safety)},
    {"integrator", "", 0, 2, DYN_SYMPLECTIC, CONTROL_CHOICE, "symplectic verlet thesis",
     "how steps are made", AT(integrator)},
};

const int dyn_controls_count = sizeof dyn_controls / sizeof *dyn_controls;

struct dyn_world dyn_world_usual(void)
{
    struct dyn_world world = {0};
    for (int i = 0; i < dyn_controls_count; i++)
        memcpy((char *)&world + dyn_controls[i].at, &dyn_controls[i].usual, sizeof(double));
    return world;
}

const struct control *dyn_control_find(const char *name)
{
    char names[400];
    const struct control *row =
        control_find(dyn_controls, dyn_controls_count, name, names, sizeof names);
    if (!row)
        dyn_fail(DYN_BAD_ARGUMENT, "there is no control '%.40s'; there are %s", name, names);
    return row;
}

enum dyn_status dyn_control_check(const struct control *c, double value)
{
    struct error_text why;
    return control_check(c, value, &why) ? DYN_OK : dyn_fail(DYN_BAD_ARGUMENT, "%s", why.text);
}

enum dyn_status dyn_control_write(const struct control *c, void *of, double value)
{
    const enum dyn_status status = dyn_control_check(c, value);
    return status == DYN_OK ? (enum dyn_status)control_put(c, of, value) : status;
}

enum dyn_status dyn_control_parse(const struct control *c, const char *text, double *value)
{
    struct error_text why;
    return control_parse(c, text, value, &why) ? DYN_OK
                                               : dyn_fail(DYN_BAD_ARGUMENT, "%s", why.text);
}

enum dyn_status dyn_controls_check(const struct control *controls, int count, const void *of)
{
    for (int i = 0; i < count; i++) {
        enum dyn_status status =
            dyn_control_check(&controls[i], control_read(&controls[i], of));
        if (status != DYN_OK)
            return status;
    }
    return DYN_OK;
}
