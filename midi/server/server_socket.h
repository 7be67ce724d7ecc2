/* server_socket.h - the sockets for clients. */
#ifndef LUTETIA_MIDI_SERVER_SOCKET_H
#define LUTETIA_MIDI_SERVER_SOCKET_H

#include <midi_status.h>

#include <stdbool.h>

/* Listens at a path with mode 0600. Replaces the socket of a dead server; *lock is held
 * while ours lives. Errors: REFUSED: a server listens there, or the existing file may not be
 * replaced; IO_FAILED. */
enum midi_status socket_listen_unix(const char *path, int *file, int *lock);
enum midi_status socket_listen_tcp(int port, int *file);
/* Accepts the next client; -1: none. *ours: its user is this one, or root (for TCP the user
 * is unknown: true). */
int socket_accept(int listening, bool tcp, bool *ours);
/* Removes the path and releases the lock. */
void socket_leave(const char *path, int file, int lock);

#endif
