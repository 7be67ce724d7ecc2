/* call_line.h - where the program's source calls the library. */
#ifndef PARIS_CALL_LINE_H
#define PARIS_CALL_LINE_H

/* The file and line of the call that is being performed, "heat.c:31"; "" where it is not known
 * (call_line.c). Cost: a few milliseconds at the first call, microseconds later: for complaints
 * only. Owns: the library; until the next call. */
const char *paris_call_line(void);

#endif
