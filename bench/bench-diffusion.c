/* bench-diffusion.c - the diffusion benchmark as a program of its own. */
#include "bench.h"

int main(int argc, char **argv)
{
    return bench_diffusion_main(argc, argv);
}
