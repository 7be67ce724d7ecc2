/* streams.h - a program's three streams, however it was started.
 *
 *     int main(int argc, char **argv)
 *     {
 *         streams_fill();
 *         int status = work(argc, argv);
 *         return streams_end() ? status : ...;
 *     } */
#ifndef LUTETIA_STREAMS_H
#define LUTETIA_STREAMS_H

#include <stdbool.h>

/* Opens /dev/null where the standard input, output or error is closed: else the next file that is opened would have its number, and
 * prints would land in it. First in main(). */
void streams_fill(void);

/* Flushes the standard output. False: something that was printed did not arrive (a full disk, a closed pipe). */
bool streams_end(void);

#endif
