/* fuzz_tuning.c - reads damaged copies of the file that `lutetia tune` keeps. The reader
 * returns what was written, or nothing.
 *
 *     fuzz_tuning [SEEDS]      a good file with random bytes changed, cut and moved; and files
 *                              of random bytes
 *
 * With -Dfuzz=true, fuzz_tuning_libfuzzer does the same with libFuzzer's inputs. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/tuning.h"
#include "sample.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static const struct device device = {
    .platform_name = "Platform of tests", .name = "device 1", .driver = "3.1+x"};

static const char good[] = "lutetia tuning 2\n"
                           "platform Platform of tests\n"
                           "device device 1\n"
                           "driver 3.1+x\n"
                           "vector 8\n"
                           "run 256\n"
                           "streams 0\n"
                           "turns 4\n"
                           "columns 128\n"
                           "strips_each 2\n"
                           "op_fs 64000\n"
                           "byte_fs 22000\n"
                           "near_byte_fs 0\n"
                           "launch_fs 3000000000\n"
                           "end\n";

static void must(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "fuzz_tuning: %s\n", what);
    abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    char *copy = malloc(count + 1), why[160] = "";
    struct machine_tuning tuning;
    must(copy != NULL, "no memory");
    memcpy(copy, bytes, count);
    copy[count] = 0;
    bool parsed = tuning_parse(copy, count, &device, &tuning, why, sizeof why);
    for (int k = 0; k < MACHINE_KNOBS; k++)
        must(parsed ? machine_knob_allows((enum machine_knob)k, tuning.of[k])
                    : tuning.of[k] == -1,
             "a value that may not be");
    for (int i = 0; i < MACHINE_COSTS; i++)
        must(!(tuning.cost_ns[i] < 0) && tuning.cost_ns[i] <= (parsed ? 1e9 : 0),
             "a cost that may not be");
    must(parsed || (strncmp(why, "line ", 5) == 0 && !strchr(why, '\n')),
         "no reason in a line");
    must(!parsed || (count > 100 && !memcmp(copy + count - 5, "\nend\n", 5)),
         "a file that is not whole is taken");
    free(copy);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
static size_t damaged(uint8_t *bytes, size_t count, size_t most, uint64_t *state)
{
    for (uint32_t changes = sample_linear(state) % 3 + 1; changes; changes--) {
        size_t at = sample_linear(state) % count;
        switch (sample_linear(state) % 6) {
        case 0:
            bytes[at] = (uint8_t)sample_linear(state);
            break;
        case 1:
            bytes[at] = (uint8_t) "0123456789 \n\0-+"[sample_linear(state) % 15];
            break;
        case 2:
            count = at + 1;
            break;
        case 3: /* a piece twice */
            if (count + count - at <= most) {
                memmove(bytes + at + (count - at), bytes + at, count - at);
                count += count - at;
            }
            break;
        case 4: /* a byte less */
            memmove(bytes + at, bytes + at + 1, count - at - 1);
            count -= count > 1;
            break;
        default: /* a byte more */
            if (count < most) {
                memmove(bytes + at + 1, bytes + at, count - at);
                bytes[at] = (uint8_t)('0' + sample_linear(state) % 10);
                count++;
            }
        }
    }
    return count;
}

int main(int argc, char **argv)
{
    static uint8_t bytes[TUNING_BYTES_MOST];
    unsigned long seeds = argc > 1 ? strtoul(argv[1], NULL, 10) : 200000;
    struct machine_tuning tuning;
    char why[160];
    must(tuning_parse(good, sizeof good - 1, &device, &tuning, why, sizeof why), why);
    must(tuning.of[MACHINE_VECTOR] == 8 && tuning.of[MACHINE_STRIPS_EACH] == 2, "other values");
    for (unsigned long seed = 0; seed < seeds; seed++) {
        uint64_t state = seed * SAMPLE_GOLDEN + 1;
        size_t count = sizeof good - 1;
        memcpy(bytes, good, count);
        if (seed % 8 == 0)
            for (size_t i = 0; i < count; i++)
                bytes[i] = (uint8_t)sample_linear(&state);
        else
            count = damaged(bytes, count, sizeof bytes, &state);
        LLVMFuzzerTestOneInput(bytes, count);
    }
    return 0;
}
#endif
