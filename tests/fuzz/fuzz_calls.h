/* fuzz_calls.h - the functions that libFuzzer and seeds.c call. */
#ifndef LUTETIA_FUZZ_CALLS_H
#define LUTETIA_FUZZ_CALLS_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
/* Makes the calls that the bytes describe. Aborts if a wrong call's message is not as it must
 * be. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

#endif
