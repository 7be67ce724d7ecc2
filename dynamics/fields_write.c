/* fields_write.c - sets a field of one mass or spring or of all: see fields.h. */
#include "fields.h"
#include "internal.h"

#include <string.h>

/* Checks only the changed number: others may have values that could not be set, such as a
 * place far outside. */
enum dyn_status dyn_mass_write(struct dyn_network *n, int index, const struct control *field,
                               double value)
{
    enum dyn_status status = dyn_control_check(field, value);
    if (status == DYN_OK && index != DYN_ALL)
        status = dyn_mass_check(n, index);
    if (status != DYN_OK)
        return status;
    bool all = index == DYN_ALL;
    for (int i = all ? 0 : index; i < (all ? n->masses_count : index + 1); i++) {
        struct dyn_mass mass = dyn_mass_get(n, i);
        memcpy((char *)&mass + field->at, &value, sizeof value);
        dyn_mass_put(n, i, &mass);
    }
    return DYN_OK;
}

enum dyn_status dyn_spring_write(struct dyn_network *n, int index, const struct control *field,
                                 double value)
{
    enum dyn_status status = dyn_control_check(field, value);
    if (status == DYN_OK && index != DYN_ALL)
        status = dyn_spring_check(n, index);
    if (status != DYN_OK)
        return status;
    bool all = index == DYN_ALL;
    for (int i = all ? 0 : index; i < (all ? n->springs_count : index + 1); i++) {
        struct dyn_spring spring = dyn_spring_get(n, i);
        memcpy((char *)&spring + field->at, &value, sizeof value);
        dyn_spring_put(n, i, &spring);
    }
    return DYN_OK;
}
