/* seeds.c - calls the fuzzer's target with fixed random inputs, without libFuzzer.
 *
 *     fuzz_calls                     SEEDS inputs
 *     fuzz_calls FIRST COUNT         inputs from number FIRST on
 *     fuzz_calls FILE...             inputs that libFuzzer found */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cm/paris.h>

#include "fuzz_calls.h"
#include "sample.h"

enum { SEEDS = 4000, BYTES = 600 };

static void seed_run(unsigned long seed, unsigned long observing)
{
    uint8_t bytes[BYTES];
    uint64_t state = seed * SAMPLE_GOLDEN + 1;
    for (int i = 0; i < BYTES; i++)
        bytes[i] = (uint8_t)(sample_linear(&state) >> 23);
    if (bytes[0] >= 0xfe)
        bytes[0] &= 1; /* no kernels by chance: they take long */
    if (seed % observing == 0)
        bytes[0] = seed / observing % 2 ? 0xfe : 0xff;
    LLVMFuzzerTestOneInput(bytes, seed % observing ? BYTES : 120);
}

static int file_run(const char *name)
{
    static uint8_t bytes[1 << 20];
    FILE *file = fopen(name, "rb");
    if (!file) {
        perror(name);
        return 1;
    }
    size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    LLVMFuzzerTestOneInput(bytes, count);
    return 0;
}

int main(int argc, char **argv)
{
    LLVMFuzzerInitialize(NULL, NULL);
    char *end = NULL;
    unsigned long first = argc == 3 ? strtoul(argv[1], &end, 10) : 1;
    unsigned long count = end && !*end ? strtoul(argv[2], NULL, 10) : SEEDS;
    if (argc > 1 && !(end && !*end)) {
        for (int i = 1; i < argc; i++)
            if (file_run(argv[i]))
                return 1;
        return 0;
    }
    FILE *place = argc == 3 ? stderr : NULL;
    for (unsigned long seed = first; seed < first + count; seed++) {
        if (place)
            fprintf(place, "seed %lu\n", seed);
        seed_run(seed, 2000);
    }
    printf("%lu sequences of calls\n", count);
    return 0;
}
