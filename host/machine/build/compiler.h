/* compiler.h - what background.c asks of lutetia-compiler (compiler.c), a process that is the machine's.
 *
 *     machine                              compiler, by its standard input, a socket; its argument: the machine's process
 *        <-------------------------------- COMPILER_READY, once
 *     struct compiler_request, strings -->
 *        <-------------------------------- COMPILER_DONE: the driver has it on disk; COMPILER_FAILED
 *
 * Both are of one build; the first byte says so. */
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
    uint32_t group;  /* work-items of a work-group, along the first of them */
    uint64_t widest; /* the most work-items in one of them: drivers make other code for few */
};

/* With this as its third number, and 0 or 1 as the others, a kernel of ours computes nothing: it is how many columns,
 * or rows, an item does. Times the most items that are asked for it is an int. */
enum { COMPILER_NOTHING = -1024, COMPILER_WIDEST = 1 << 20 };

#endif
