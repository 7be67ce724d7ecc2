/* The same memory seen from another VP set: see machine_alias_make(). */
#include "paris_state.h"

CM_field_id_t CM_make_field_alias(CM_field_id_t field)
{
    struct machine *m = paris_begin("CM_make_field_alias");
    if (!paris_check_field_anywhere(field, 0, "field"))
        return CM_no_field;
    uint32_t alias = machine_alias_make(m, field, machine_vpset_current(m));
    if (alias == MACHINE_NO_FIELD)
        paris_fail_machine();
    paris_the.pristine = false;
    return alias;
}

void CM_remove_field_alias(CM_field_id_t alias)
{
    struct machine *m = paris_begin("CM_remove_field_alias");
    if (machine_alias_remove(m, alias) != MACHINE_OK)
        paris_fail_machine();
}

void CM_change_field_alias(CM_field_id_t alias, CM_field_id_t field)
{
    struct machine *m = paris_begin("CM_change_field_alias");
    if (paris_check_field_anywhere(field, 0, "field") &&
        machine_alias_change(m, alias, field) != MACHINE_OK)
        paris_fail_machine();
}

int CM_is_field_an_alias(CM_field_id_t field)
{
    return machine_is_alias(paris_machine(), field);
}
