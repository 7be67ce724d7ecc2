#include "bench.h"
int main(int c,char**v){return bench_diffusion_main(c,v);}
