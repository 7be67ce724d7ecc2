/* run_sweep.h - a script run for many values, one after the other or several at a time. */
#ifndef LUTETIA_RUN_SWEEP_H
#define LUTETIA_RUN_SWEEP_H

#include "run.h"

/* Runs the script for every combination of "KEY=a,b,c;OTHER=1..5;THIRD=0..1/5", each in a
 * folder of its own. With `jobs` above 1, that many run at a time, each in its own process;
 * their output is printed in the order of the combinations. Runs that fail do not stop the
 * others. */
int sweep_all(struct run *run, const char *text, int jobs);

#endif
