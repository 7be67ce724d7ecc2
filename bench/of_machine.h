/* of_machine.h - what the benchmarks of C/Paris programs have in common: the machine that they run on.
 *
 *     int status = bench_machine_start(&report, &options, true, argc, argv);
 *     if (status >= 0)
 *         return status;
 *     ... bench_machine_said(machine_flush(paris_machine())) ... */
#ifndef LUTETIA_BENCH_OF_MACHINE_H
#define LUTETIA_BENCH_OF_MACHINE_H

#include "machine.h"
#include "options.h"

/* bench_options_parse(), and the report begins with the machine's device. settled: kernels are from the first step on
 * what a long run settles to. -1: go on; else the exit status, and why has been printed. */
int bench_machine_start(struct bench_report *r, struct bench_options *o, bool settled, int argc,
                        char **argv);
/* Errors: false, with what the machine says. */
bool bench_machine_said(enum machine_status status);
/* Takes steps, hands over what they are after each `between` and after the last, and waits. Errors: false. */
bool bench_machine_steps(void (*step)(const void *of), const void *of, int steps_count,
                         int between);
/* All that was asked for has been computed. Errors: false. */
bool bench_machine_finished(void);

#endif
