/* numbers.h - numbers in a kernel's text that could be arguments of the kernel: bit positions,
 * widths, distances.
 *
 * Text is made with such numbers between marks. Then it becomes one of two:
 *
 *     made       (v0 >> <int 5>) & <uint 0xff>           void k(..., uint a0<parameters>)
 *     written    (v0 >> 5) & 0xff                        void k(..., uint a0)
 *     lifted     (v0 >> n0) & n1                         void k(..., uint a0, int n0, uint n1)
 *
 * Written text is as fast as can be. Lifted text is the same for all plans that differ in these
 * numbers only. What has no mark is written: two texts are the same only if all of that is. */
#ifndef LUTETIA_MACHINE_NUMBERS_H
#define LUTETIA_MACHINE_NUMBERS_H

#include <inttypes.h>

#include "codegen/codegen.h"

/* Formats of marked numbers: a letter for the type, the number as C writes it. */
#define NUMBER_INT "\1i%d\2"
#define NUMBER_UINT "\1u0x%xu\2"
#define NUMBER_ULONG "\1l%" PRIu64 "UL\2"
/* Where a kernel's declaration has room for parameters. */
#define NUMBER_PARAMETERS "\3"

/* Makes the text written. */
void numbers_write(char *text);
/* The same text lifted, and its arguments with those for the numbers at the end. NULL: it has
 * no numbers, or too many, or no room for parameters; or there is no memory. */
char *numbers_lift(const struct kernel_text *k, struct kernel_argument **arguments,
                   int *arguments_count);

#endif
