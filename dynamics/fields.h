/* fields.h - the parameters of masses and springs, as tables; changed for one or for all.
 *
 *     dyn_mass_write(network, 3, dyn_mass_field_find("mass"), 2.5);
 *     dyn_spring_write(network, DYN_ALL, dyn_spring_field_find("constant"), 400);
 */
#ifndef LUTETIA_DYN_FIELDS_H
#define LUTETIA_DYN_FIELDS_H

#include "network.h"

enum { DYN_ALL = -1 };

extern const struct control dyn_mass_fields[]; /* a row for each number of struct dyn_mass */
extern const int dyn_mass_fields_count;
extern const struct control
    dyn_spring_fields[]; /* a row for each number of struct dyn_spring */
extern const int dyn_spring_fields_count;

/* NULL: there is no field of that name, and dyn_error() lists the names. */
const struct control *dyn_mass_field_find(const char *name);
const struct control *dyn_spring_field_find(const char *name);

/* index: one, or DYN_ALL. Errors: BAD_ARGUMENT (the value or the index is invalid); nothing
 * changes. */
enum dyn_status dyn_mass_write(struct dyn_network *n, int index, const struct control *field,
                               double value);
enum dyn_status dyn_spring_write(struct dyn_network *n, int index, const struct control *field,
                                 double value);

#endif
