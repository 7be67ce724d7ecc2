/* server_socket.h - where clients come in. */
#ifndef LUTETIA_MIDI_SERVER_SOCKET_H
#define LUTETIA_MIDI_SERVER_SOCKET_H

#include <midi_status.h>

#include <stdbool.h>

/* Listens at a path of mode 0600. A socket that a dead server left is taken away; *lock is held while ours lives.
 * Errors: REFUSED: a server listens there, or what is there is not ours to replace; IO_FAILED. */
enum midi_status socket_listen_unix(const char *path, int *file, int *lock);
enum midi_status socket_listen_tcp(int port, int *file);
/* The next one that has come; -1: none. *ours: its user is this one, or root (of TCP nothing is known: true). */
int socket_accept(int listening, bool tcp, bool *ours);
/* Removes the path and lets the lock go. */
void socket_leave(const char *path, int file, int lock);

#endif
