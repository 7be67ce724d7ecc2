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

/* Opens /dev/null in place of a closed standard input, output or error. Otherwise the next
 * file opened would get that descriptor, and prints would be written into it. Call first in
 * main(). */
void streams_fill(void);

/* Opens /dev/null, with O_RDONLY, O_WRONLY or O_RDWR; negative: errno says why. */
int streams_nowhere(int mode);

/* Flushes the standard output. False if something printed was not written (a full disk, a
 * closed pipe). */
bool streams_end(void);

#endif
