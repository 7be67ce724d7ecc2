/* fuzz_calls.h - what libFuzzer calls, and seeds.c. */
#ifndef LUTETIA_FUZZ_CALLS_H
#define LUTETIA_FUZZ_CALLS_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
/* Makes the calls that the bytes say; aborts where one is told of wrongly. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

#endif
