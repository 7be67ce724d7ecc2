/* pipewire_reader.h - a PipeWire daemon of the test's own, and a program that reads the video
 * of a node and links itself to it, as a mixer does. */
#ifndef LUTETIA_TEST_PIPEWIRE_READER_H
#define LUTETIA_TEST_PIPEWIRE_READER_H

#include <display.h>

#include <stdbool.h>
#include <sys/types.h>

/* Starts the daemon in a private folder, which XDG_RUNTIME_DIR names from then on. -1: there is
 * no daemon on this machine. */
pid_t pipewire_daemon_start(char *folder, size_t room);
void pipewire_daemon_end(pid_t daemon, const char *folder);

struct pipewire_reader;
/* Links to the node of that name; is_slow: keeps each picture for a second. NULL: the daemon
 * cannot be reached. */
struct pipewire_reader *pipewire_reader_open(const char *node, bool is_slow);
void pipewire_reader_close(struct pipewire_reader *reader);
/* The newest picture that has come since the last call, with 4 channels, red first. False:
 * none has. */
bool pipewire_reader_next(struct pipewire_reader *reader, struct display_image *image);
/* What was negotiated: the rate, and whether there is alpha. */
double pipewire_reader_fps(const struct pipewire_reader *reader);
bool pipewire_reader_alpha(const struct pipewire_reader *reader);

#endif
