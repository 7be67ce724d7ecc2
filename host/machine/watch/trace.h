/* trace.h - a file of what happens when, in Chrome's trace event format (a JSON array;
 * about://tracing and Perfetto show it).
 *
 *     // 0: the reason has been printed
 *     int machine = trace_open("run.json", "65536 processors on pocl");
 *     trace_event(machine, TRACE_FRONT_END, "plan", "plan", start_s, end_s, "\"nodes\":12");
 *     trace_flush();                     // everything so far is in the file
 *     trace_leave();                     // the file is complete, unless more events follow
 *     trace_close(machine);
 *
 * A process has one file, in which each machine is a process of the trace. Only whole events
 * are written, and a closing bracket behind them. So a killed program leaves a file that can be
 * loaded, up to the last flush (growing_file.h). Where the file cannot be written, a line says
 * so, and the process does not end with 0. Threads. Any.
 */
#ifndef LUTETIA_MACHINE_TRACE_H
#define LUTETIA_MACHINE_TRACE_H

#include "machine.h"

enum trace_track { TRACE_FRONT_END = 1, TRACE_DEVICE = 2, TRACE_BACKGROUND = 3 };
/* The most events that are written, about 250 MB; a line on the standard error says when
 * they are reached. */
enum { TRACE_EVENTS_MOST = 2000000 };
/* The number of the machine in the file, from 1 on; 0: no file. */
int trace_open(const char *path);
/* Sets the machine's name in the file. */
void trace_title(int machine, const char *title);
/* Announces the third track. */
void trace_background(int machine);
/* Adds a span, or with end_s < start_s a moment. category: a word. details: members of a
 * JSON object; NULL: none. */
void trace_event(int machine, enum trace_track track, const char *name, const char *category,
                 double start_s, double end_s, const char *details);
void trace_flush(void);
void trace_leave(void);
void trace_close(int machine);

#endif
