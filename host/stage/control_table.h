/* control_table.h - tables of controls (host/base/control.h) whose errors are the stage's.
 *
 *     static const struct control rows[] = {
 *         {"gravity", "em/s2", -100, 100, 9.81, CONTROL_CENTRED, NULL, "pulls masses down",
 *          gravity_read, gravity_write, 0},
 *     };
 *     const struct control *row = stage_control_find(rows, 1, "gravity");
 *     if (row && stage_control_parse(row, "3.7", &value) == STAGE_OK)
 *         status = stage_control_write(row, actor, value);
 *
 * Everything adjustable is in such a table. A row's write returns an enum stage_status.
 */
#ifndef LUTETIA_STAGE_CONTROL_TABLE_H
#define LUTETIA_STAGE_CONTROL_TABLE_H

#include "stage_status.h"

#include <control.h>

/* NULL: there is no control of that name, and stage_error() lists the names. */
const struct control *stage_control_find(const struct control *rows, int count,
                                         const char *name);

/* Errors: BAD_ARGUMENT outside of the range, or not whole where it must be. */
enum stage_status stage_control_check(const struct control *row, double value);
/* Errors: BAD_ARGUMENT outside of the range (a switch: 0 or 1, a choice: whole), and the
 * actor's errors; nothing changes. */
enum stage_status stage_control_write(const struct control *row, void *actor, double value);
/* Errors: BAD_ARGUMENT. */
enum stage_status stage_control_parse(const struct control *row, const char *text,
                                      double *value);

#endif
