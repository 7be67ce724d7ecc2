/* control_table.c - see control_table.h. */
#include "control_table.h"

const struct control *stage_control_find(const struct control *rows, int count,
                                         const char *name)
{
    char known[700];
    const struct control *row = control_find(rows, count, name, known, sizeof known);
    if (!row)
        stage_fail(STAGE_BAD_ARGUMENT, "there is no control '%.60s'; there are %s", name,
                   known);
    return row;
}

enum stage_status stage_control_check(const struct control *row, double value)
{
    struct error_text why;
    return control_check(row, value, &why) ? STAGE_OK
                                           : stage_fail(STAGE_BAD_ARGUMENT, "%s", why.text);
}

enum stage_status stage_control_write(const struct control *row, void *actor, double value)
{
    const enum stage_status status = stage_control_check(row, value);
    return status == STAGE_OK ? (enum stage_status)control_put(row, actor, value) : status;
}

enum stage_status stage_control_parse(const struct control *row, const char *text,
                                      double *value)
{
    struct error_text why;
    return control_parse(row, text, value, &why)
               ? STAGE_OK
               : stage_fail(STAGE_BAD_ARGUMENT, "%s", why.text);
}
