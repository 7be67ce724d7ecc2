/* finish.c - computes everything that is pending. */
#include "access/settle.h"
#include "device/device.h"
#include "run/evaluate.h"
#include "run/notes.h"
#include "run/replay.h"

enum machine_status machine_settle(struct machine *m, struct machine_value **values, int count)
{
    return evaluate_in_blocks(m, values, count, false);
}

enum machine_status machine_flush(struct machine *m)
{
    settle(m);
    evaluate_due(m);
    history_looked(m);
    return evaluate_values(m, NULL, 0, false);
}

enum machine_status machine_finish(struct machine *m)
{
    enum machine_status status = machine_flush(m);
    enum machine_status waited = device_settle_for(m, "waiting for the device");
    return status ? status : waited;
}
