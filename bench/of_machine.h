/* of_machine.h - the machine on which benchmarks of C/Paris programs run.
 *
 *     int status = bench_machine_start(&report, &options, true, argc, argv);
 *     if (status >= 0)
 *         return status;
 *     ... bench_machine_said(machine_flush(paris_machine())) ...
 */
#ifndef LUTETIA_BENCH_OF_MACHINE_H
#define LUTETIA_BENCH_OF_MACHINE_H

#include "machine.h"
#include "options.h"

/* bench_options_parse(), and the report begins with the machine's device. settled: the final
 * kernels of a long run are used from the first step on. Returns -1 to go on; else the exit
 * status, and the error has been printed. */
int bench_machine_start(struct bench_report *r, struct bench_options *o, bool settled, int argc,
                        char **argv);
/* Errors: false, with the machine's message. */
bool bench_machine_said(enum machine_status status);
/* Takes steps, submits the work after each `between` steps and after the last, and waits.
 * Errors: false. */
bool bench_machine_steps(void (*step)(const void *of), const void *of, int steps_count,
                         int between);
/* Waits until everything has been computed. Errors: false. */
bool bench_machine_finished(void);

#endif
