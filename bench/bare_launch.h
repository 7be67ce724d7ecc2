/* bare_launch.h - what a launch by hand costs the front end. */
#ifndef LUTETIA_BENCH_BARE_LAUNCH_H
#define LUTETIA_BENCH_BARE_LAUNCH_H

#include "opencl.h"

/* A nearly empty kernel with as many arguments as one of the listing's kernels. */
struct bare_launch {
    struct bench_opencl cl;
    cl_program program;
    cl_kernel kernel;
    cl_mem memory;
};

/* Errors: false, and bench_error() says why. On failure close it, too. */
bool bare_launch_open(struct bare_launch *b);
void bare_launch_close(struct bare_launch *b);
/* *seconds: the thread's time for arguments and launch; then waits for the kernel. */
bool bare_launch(struct bare_launch *b, double *seconds);

#endif
