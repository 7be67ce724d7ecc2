/* trace.h - a file of what happens when, in Chrome's trace event format (a JSON array; about://tracing and
 * Perfetto show it).
 *
 *     int machine = trace_open("run.json", "65536 processors on pocl");      // 0: it has been said why not
 *     trace_event(machine, TRACE_FRONT_END, "plan", "plan", start_s, end_s, "\"nodes\":12");
 *     trace_flush();                     // what has been said so far is in the file
 *     trace_leave();                     // it is whole, unless more is said
 *     trace_close(machine);
 *
 * A process has one file: its machines are the processes of the trace. Whole events are written, and the
 * format lets the closing bracket be missing, so that a program that is killed leaves a file that can be
 * loaded, up to the last flush. Threads. Any. */
#ifndef LUTETIA_MACHINE_TRACE_H
#define LUTETIA_MACHINE_TRACE_H

#include "machine.h"

enum trace_track { TRACE_FRONT_END = 1, TRACE_DEVICE = 2, TRACE_BACKGROUND = 3 };
/* More events than this are not kept, and that is said: about 250 MB. */
enum { TRACE_EVENTS_MOST = 2000000 };
/* The number of the machine in the file, from 1 on; 0: there is none. */
int trace_open(const char *path);
/* What the machine is called in the file. */
void trace_title(int machine, const char *title);
/* The third track has something on it. */
void trace_background(int machine);
/* A span, or with end_s < start_s a moment. category: a word. details: members of a JSON object; NULL: none. */
void trace_event(int machine, enum trace_track track, const char *name, const char *category,
                 double start_s, double end_s, const char *details);
void trace_flush(void);
void trace_leave(void);
void trace_close(int machine);

#endif
