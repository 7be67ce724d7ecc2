/* resident.h - what this process takes of the machine's memory. */
#ifndef LUTETIA_RESIDENT_H
#define LUTETIA_RESIDENT_H

#include <stdbool.h>

/* Bytes of this process that are in memory, those of libraries' files too. 0 where the system
 * does not tell. Takes some microseconds. Threads: any. */
double resident_bytes(void);

/* The system's limit: from now on this process gets at most that much writable memory more than
 * it has. What asks for more is refused. */
void resident_limit(double more_bytes);

#endif
