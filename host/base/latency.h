/* latency.h - asks Linux that no processor goes to sleep (PM QoS).
 *
 * A processor with nothing to do is put to sleep, and takes time to wake: some hundred
 * microseconds, in a virtual machine up to a millisecond. Linux's interface for programs that
 * cannot wait so long is a file: what is written to it is how many microseconds a processor may
 * take, of all programs that keep it open the least counts, and 0 makes processors look for
 * work in a loop. That costs power. Root may open the file, and those whom a rule of udev's
 * lets.
 *
 *     int file = latency_open (LATENCY_PATH);
 *     latency_ask (file, true);                  processors stay awake ...
 *     latency_ask (file, false);                 ... until here, or until close (file) */
#ifndef LUTETIA_BASE_LATENCY_H
#define LUTETIA_BASE_LATENCY_H

#include <stdbool.h>

#define LATENCY_PATH "/dev/cpu_dma_latency"

/* -1: it is not allowed (errno). Nothing is asked yet. */
int latency_open(const char *path);
/* awake false: they may sleep as if nobody had asked. False: it cannot be written (errno). */
bool latency_ask(int file, bool awake);

#endif
