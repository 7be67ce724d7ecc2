/* oracle_random.h - the machine's random numbers, as machine_random() in machine.h defines
 * them. */
#ifndef LUTETIA_TESTS_RANDOM_ORACLE_RANDOM_H
#define LUTETIA_TESTS_RANDOM_ORACLE_RANDOM_H

#include "oracle_number.h"

/* Random number `draw` (from 0) after seeding, for the processor with this row-major index.
 * limit 0: all bits are random. */
wide oracle_random(uint64_t seed, uint64_t draw, uint64_t index, int bits, uint64_t limit);

#endif
