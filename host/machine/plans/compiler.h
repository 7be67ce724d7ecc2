/* compiler.h - the protocol between background.c and lutetia-compiler (compiler.c), a process
 * that belongs to the machine.
 *
 *     machine                              compiler, by its standard input, a socket; its
 *                                          argument: the machine's process
 *        <-------------------------------- COMPILER_READY, once
 *     struct compiler_request, strings -->
 *        <-------------------------------- COMPILER_DONE: the driver has it on disk; COMPILER_FAILED
 *
 * Both must be of the same build; the first byte is the version.
 */
#ifndef LUTETIA_MACHINE_COMPILER_H
#define LUTETIA_MACHINE_COMPILER_H

#include <stdint.h>

enum {
    COMPILER_READY = 'A',
    COMPILER_DONE = 'y',
    COMPILER_FAILED = 'n'
}; /* READY: the version */

enum compiler_string {
    COMPILER_PLATFORM,
    COMPILER_DEVICE,
    COMPILER_OPTIONS,
    COMPILER_NAME,      /* of the kernel */
    COMPILER_ARGUMENTS, /* a letter each: m memory, 4 and 8 a number of so many bytes */
    COMPILER_TEXT,
    COMPILER_STRINGS
};

/* Then the strings, each with the 0 at its end. */
struct compiler_request {
    uint32_t bytes[COMPILER_STRINGS];
    uint32_t dimensions;
    uint32_t group;  /* work-items of a work-group, along its first dimension */
    uint64_t widest; /* the most work-items of a start: drivers compile other code for few */
};

/* With this as the third number, which is the columns or rows of a work-item, and 0 or 1 as
 * the others, our kernels compute nothing. Times the most items that are asked for it is an
 * int. */
enum { COMPILER_NOTHING = -1024, COMPILER_WIDEST = 1 << 20 };

#endif
