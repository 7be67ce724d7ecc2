/* server_socket.c - see server_socket.h. */
#include "server_socket.h"

#include <midi_internal.h>

#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

/* A lock file beside the socket shows whether a server lives: the lock ends with the
 * process, even if it is killed. */
static enum midi_status lock_take(const char *path, int *lock)
{
    char name[128];
    snprintf(name, sizeof name, "%s.lock", path);
    *lock = open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (*lock < 0)
        return midi_fail(errno == EACCES ? MIDI_REFUSED : MIDI_IO_FAILED, "%s: %s", name,
                         errno == EACCES ? "it is another user's; give another --server"
                                         : strerror(errno));
    if (flock(*lock, LOCK_EX | LOCK_NB) != 0) {
        close(*lock);
        *lock = -1;
        return midi_fail(MIDI_REFUSED,
                         "%s: a MIDI server listens there already; stop it, or give another "
                         "--server",
                         path);
    }
    return MIDI_OK;
}

static enum midi_status way_clear(const char *path)
{
    struct stat about;
    if (lstat(path, &about) != 0)
        return errno == ENOENT ? MIDI_OK
                               : midi_fail(MIDI_IO_FAILED, "%s: %s", path, strerror(errno));
    if (!S_ISSOCK(about.st_mode))
        return midi_fail(MIDI_REFUSED, "%s: there is something that is no socket", path);
    if (about.st_uid != getuid() || unlink(path) != 0)
        return midi_fail(MIDI_REFUSED,
                         "%s: a socket of another user's is there; give another --server",
                         path);
    return MIDI_OK;
}

enum midi_status socket_listen_unix(const char *path, int *file, int *lock)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    *file = *lock = -1;
    if (strlen(path) >= sizeof name.sun_path)
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: a socket's path has at most %zu bytes", path,
                         sizeof name.sun_path - 1);
    memcpy(name.sun_path, path, strlen(path));
    enum midi_status status = lock_take(path, lock);
    if (status == MIDI_OK)
        status = way_clear(path);
    if (status != MIDI_OK)
        return status;
    *file = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const mode_t before = umask(0177);
    const bool bound =
        *file >= 0 && bind(*file, (const struct sockaddr *)&name, sizeof name) == 0;
    const int error = errno;
    umask(before);
    if (!bound || listen(*file, 64) != 0)
        return midi_fail(MIDI_IO_FAILED, "%s: cannot listen there: %s", path,
                         strerror(bound ? errno : error));
    return MIDI_OK;
}

enum midi_status socket_listen_tcp(int port, int *file)
{
    struct sockaddr_in name = {.sin_family = AF_INET,
                               .sin_port = htons((uint16_t)port),
                               .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int again = 1;
    *file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (*file >= 0)
        (void)setsockopt(*file, SOL_SOCKET, SO_REUSEADDR, &again, sizeof again);
    if (*file < 0 || bind(*file, (const struct sockaddr *)&name, sizeof name) != 0 ||
        listen(*file, 64) != 0)
        return midi_fail(MIDI_IO_FAILED, "127.0.0.1:%d: cannot listen there: %s", port,
                         strerror(errno));
    return MIDI_OK;
}

int socket_accept(int listening, bool tcp, bool *ours)
{
    struct ucred peer;
    socklen_t size = sizeof peer;
    const int at_once = 1;
    const int file = accept4(listening, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
    *ours = true;
    if (file >= 0 && tcp)
        (void)setsockopt(file, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    else if (file >= 0)
        *ours = getsockopt(file, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
                (peer.uid == getuid() || peer.uid == 0);
    return file;
}

void socket_leave(const char *path, int file, int lock)
{
    if (file >= 0) {
        unlink(path);
        close(file);
    }
    if (lock >= 0)
        close(lock); /* the file stays: removing it would be a race with the next server's
                      * lock */
}
