/* of_machine.c - see of_machine.h. */
#include "of_machine.h"

#include <stdio.h>
#include <stdlib.h>

#include "paris_internal.h"

int bench_machine_start(struct bench_report *r, struct bench_options *o, bool settled, int argc,
                        char **argv)
{
    static char device[256];
    int status = bench_options_parse(o, argc, argv);
    if (status >= 0)
        return status;
    setenv("LUTETIA_BACKGROUND", "0", 0); /* after the warm-up no kernel is compiled */
    if (bench_quick) {
        setenv("LUTETIA_INTERPRET", "1",
               1); /* what is only tried compiles no kernels that do not pay */
    } else {
        setenv("LUTETIA_INTERPRET", "0", 0); /* kernels are not waited for until they pay */
        if (settled)
            setenv("LUTETIA_BOX_AFTER", "0", 0);
    }
    snprintf(device, sizeof device, "%s", machine_device_name(paris_machine()));
    bench_report_init(r, o->name, bench_threads_count(), device);
    return -1;
}

bool bench_machine_said(enum machine_status status)
{
    return status == MACHINE_OK ||
           bench_fail("the machine: %s", machine_error(paris_machine()));
}

bool bench_machine_finished(void)
{
    return bench_machine_said(machine_finish(paris_machine()));
}

bool bench_machine_steps(void (*step)(const void *of), const void *of, int steps_count,
                         int between)
{
    bool ok = true;
    for (int i = 1; ok && i <= steps_count; i++) {
        step(of);
        if (i % between == 0 || i == steps_count)
            ok = bench_machine_said(machine_flush(paris_machine()));
    }
    return ok && bench_machine_finished();
}
