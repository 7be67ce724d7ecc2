/* midi_connect.c - see midi_connect.h. */
#include "midi_connect.h"
#include "midi_wire.h"

#include <midi_internal.h>

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

static enum midi_status unix_connect(const char *path, int *file)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    if (strlen(path) >= sizeof name.sun_path)
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: a socket's path has at most %zu bytes", path,
                         sizeof name.sun_path - 1);
    memcpy(name.sun_path, path, strlen(path));
    *file = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (*file < 0)
        return midi_fail(MIDI_NO_SERVER, "no socket: %s", strerror(errno));
    if (connect(*file, (const struct sockaddr *)&name, sizeof name) != 0) {
        if (errno == EACCES || errno == EPERM)
            return midi_fail(MIDI_REFUSED, "%s: the server there is another user's", path);
        return midi_fail(MIDI_NO_SERVER,
                         "no MIDI server at %s (%s); `lutetia midi serve` starts one", path,
                         strerror(errno));
    }
    struct ucred peer;
    socklen_t size = sizeof peer;
    if (getsockopt(*file, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0 ||
        (peer.uid != getuid() && peer.uid != 0))
        return midi_fail(MIDI_REFUSED, "%s: the server there is another user's", path);
    return MIDI_OK;
}

static enum midi_status tcp_connect(const char *address, const char *port_text, int *file,
                                    int *port_out)
{
    struct sockaddr_in name = {.sin_family = AF_INET};
    const bool local =
        !strncmp(address, "127.0.0.1:", 10) || !strncmp(address, "localhost:", 10);
    char *end;
    const long port = strtol(port_text, &end, 10);
    const int at_once = 1;
    if (!local || *end || port < 1 || port > 65535)
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "%s: an address is a socket's path, or 127.0.0.1:PORT", address);
    *port_out = (int)port;
    name.sin_port = htons((uint16_t)port);
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    *file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (*file < 0 || connect(*file, (const struct sockaddr *)&name, sizeof name) != 0)
        return midi_fail(MIDI_NO_SERVER, "no MIDI server at %s (%s)", address, strerror(errno));
    (void)setsockopt(*file, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    return MIDI_OK;
}

enum midi_status midi_connect(const char *address, int *file, int *port_out)
{
    char usual[108];
    const char *why;
    enum midi_status status;
    *file = -1;
    *port_out = 0;
    if (!address) {
        if (!midi_wire_usual_path(usual, &why))
            return midi_fail(MIDI_REFUSED, "%s: %s", usual, why);
        address = usual;
    }
    const char *port = strrchr(address, ':');
    if (address[0] != '/' && address[0] != '.' && port)
        status = tcp_connect(address, port + 1, file, port_out);
    else
        status = unix_connect(address, file);
    if (status != MIDI_OK && *file >= 0) {
        close(*file);
        *file = -1;
    }
    /* A read that has a timeout is interrupted by every signal, SA_RESTART or not:
     * signal(7). */
    const struct timeval day = {.tv_sec = 86400};
    if (status == MIDI_OK)
        (void)setsockopt(*file, SOL_SOCKET, SO_RCVTIMEO, &day, sizeof day);
    return status;
}
