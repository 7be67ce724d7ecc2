/* sound_server.h - programs beside a test, and a PulseAudio of its own whose sink leads
 * nowhere. */
#ifndef TESTS_SOUND_SERVER_H
#define TESTS_SOUND_SERVER_H

#include <stdbool.h>
#include <sys/types.h>

/* Starts a program that ends with the test; output, errors: files that it writes to. */
pid_t program_begin(char *const words[], const char *output, const char *errors);
void program_end(pid_t program);

/* PulseAudio that listens at that socket. */
pid_t sound_server_begin(const char *socket);
/* Waits until it does, ten seconds at most. False: it never did, or has ended. */
bool sound_server_wait(pid_t server, const char *socket);

#endif
