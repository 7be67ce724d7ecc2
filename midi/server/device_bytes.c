/* device_bytes.c - devices with a stream of bytes: a MIDI port's file, a serial line, a
 * pseudo-terminal of ours. */
#include "device_kinds.h"
#include "serial_speed.h"

#include <midi_internal.h>
#include <midi_time.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

enum { READ_BYTES = 1024 };

struct stream {
    struct server_watch watch;
    char linked[128]; /* the pseudo-terminal's other end, where that has its link */
};

static void stream_ready(struct server_watch *w, uint32_t events)
{
    struct server_device *d = w->owner;
    uint8_t bytes[READ_BYTES];
    if (events & EPOLLOUT)
        device_write_out(d);
    if (!d->up || !(events & (EPOLLIN | EPOLLHUP | EPOLLERR)))
        return;
    const ssize_t got = read(w->file, bytes, sizeof bytes);
    if (got > 0) {
        device_input(d, midi_now_ns(), bytes, (size_t)got);
        device_read_end(d);
    } else if (got == 0) {
        device_down(d, "unplugged");
    } else if (errno != EAGAIN && errno != EINTR) {
        device_down(d, errno == EIO ? "unplugged" : strerror(errno));
    }
}

static size_t stream_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    const struct stream *s = d->own;
    const ssize_t written = write(s->watch.file, bytes, count);
    if (written < 0 && errno != EAGAIN && errno != EINTR) {
        device_down(d, errno == EIO ? "unplugged" : strerror(errno));
        return 0;
    }
    return written > 0 ? (size_t)written : 0;
}

static void stream_more(struct server_device *d, bool wanted)
{
    struct stream *s = d->own;
    loop_change(d->loop, &s->watch, (d->hears ? EPOLLIN : 0u) | (wanted ? EPOLLOUT : 0u));
}

static void stream_close(struct server_device *d)
{
    struct stream *s = d->own;
    if (!s)
        return;
    loop_unwatch(d->loop, &s->watch);
    if (s->watch.file >= 0)
        close(s->watch.file);
    free(s);
    d->own = NULL;
}

static enum midi_status stream_create(struct server_device *d, int file)
{
    struct stream *s = calloc(1, sizeof *s);
    if (!s) {
        close(file);
        return midi_fail(MIDI_NO_MEMORY, "no memory");
    }
    s->watch = (struct server_watch){file, stream_ready, d};
    d->own = s;
    return MIDI_OK;
}

static enum midi_status watch_begin(struct server_device *d)
{
    struct stream *s = d->own;
    if (!loop_watch(d->loop, &s->watch, d->hears ? EPOLLIN : 0u)) {
        const int error = errno;
        close(s->watch.file);
        s->watch.file = -1;
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: not a stream of MIDI bytes (%s)", d->argument,
                         strerror(error));
    }
    return MIDI_OK;
}

/* Raw mode: no echo, no lines, no signals, all eight bits. */
static bool terminal_raw(int file)
{
    struct termios t;
    if (tcgetattr(file, &t) != 0)
        return false;
    cfmakeraw(&t);
    t.c_cflag |= CLOCAL | CREAD;
    t.c_cc[VMIN] = 1;
    t.c_cc[VTIME] = 0;
    return tcsetattr(file, TCSANOW, &t) == 0;
}

static enum midi_status path_open(struct server_device *d, const char *path)
{
    static const int ways[3] = {O_RDWR, O_RDONLY, O_WRONLY};
    struct stat about;
    int file = -1;
    for (int i = 0; i < 3 && file < 0; i++) {
        file = open(path, ways[i] | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
        d->hears = ways[i] != O_WRONLY;
        d->plays = ways[i] != O_RDONLY;
        if (file < 0 && errno != EACCES && errno != EPERM)
            break;
    }
    if (file < 0)
        return midi_fail(MIDI_NO_DEVICE, "%s: %s", path, strerror(errno));
    if (fstat(file, &about) == 0 && (S_ISREG(about.st_mode) || S_ISDIR(about.st_mode))) {
        close(file);
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "%s: a file, no device; a MIDI file is played by file:%s", path, path);
    }
    if (isatty(file) && !terminal_raw(file)) {
        close(file);
        return midi_fail(MIDI_NO_DEVICE, "%s: %s", path, strerror(errno));
    }
    return stream_create(d, file);
}

static enum midi_status raw_open(struct server_device *d)
{
    enum midi_status status = path_open(d, d->argument);
    return status == MIDI_OK ? watch_begin(d) : status;
}

static enum midi_status serial_open(struct server_device *d)
{
    char path[DEVICE_ARGUMENT_BYTES], *at;
    unsigned long speed = 38400;
    snprintf(path, sizeof path, "%s", d->argument);
    if ((at = strrchr(path, '@'))) {
        char *end;
        speed = strtoul(at + 1, &end, 10);
        if (*end || speed < 50 || speed > 4000000)
            return midi_fail(MIDI_BAD_ARGUMENT,
                             "%s: the speed must be 50..4000000 bits a second", d->argument);
        *at = '\0';
    }
    enum midi_status status = path_open(d, path);
    if (status != MIDI_OK)
        return status;
    const struct stream *s = d->own;
    if (!isatty(s->watch.file))
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: no serial line; bytes are read by raw:%s",
                         path, path);
    if (!serial_speed_set(s->watch.file, (unsigned int)speed))
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: the line has no speed of %lu bits a second",
                         path, speed);
    return watch_begin(d);
}

/* ---- a pseudo-terminal of our own ---- */

/* Whether there is a link of that name, and it leads there: whatever else has the name is not
 * ours to remove. */
static bool links_to(const char *name, const char *there, bool begins)
{
    char target[256];
    const ssize_t count = readlink(name, target, sizeof target - 1);
    target[count > 0 ? count : 0] = '\0';
    return count > 0 &&
           (begins ? strncmp(target, there, strlen(there)) : strcmp(target, there)) == 0;
}

/* The pseudo-terminal exists while the device is away, which is while nobody has the other
 * end open. */
static enum midi_status pty_create(struct server_device *d)
{
    char other[128];
    const int file = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    int slave = -1;
    if (file >= 0 && grantpt(file) == 0 && unlockpt(file) == 0 &&
        ptsname_r(file, other, sizeof other) == 0)
        slave = open(other, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (slave < 0 || !terminal_raw(slave)) {
        const int error = errno;
        if (file >= 0)
            close(file);
        if (slave >= 0)
            close(slave);
        return midi_fail(MIDI_NO_DEVICE, "no pseudo-terminal: %s", strerror(error));
    }
    close(slave); /* from now on reads report when nobody has the other end open */
    enum midi_status status = stream_create(d, file);
    if (status != MIDI_OK)
        return status;
    struct stream *s = d->own;
    if (links_to(d->argument, "/dev/pts/", true))
        unlink(d->argument); /* a link left by a killed server */
    if (symlink(other, d->argument) != 0)
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "%s: cannot be made a link to the pseudo-terminal: %s", d->argument,
                         strerror(errno));
    snprintf(s->linked, sizeof s->linked, "%s", other);
    return MIDI_OK;
}

static enum midi_status pty_open(struct server_device *d)
{
    enum midi_status status = d->own ? MIDI_OK : pty_create(d);
    if (status != MIDI_OK)
        return status;
    struct stream *s = d->own;
    struct pollfd p = {s->watch.file, POLLIN, 0};
    if (poll(&p, 1, 0) < 0 || (p.revents & POLLHUP && !(p.revents & POLLIN)))
        return midi_fail(MIDI_NO_DEVICE, "nobody has its other end open");
    return loop_watch(d->loop, &s->watch, EPOLLIN)
               ? MIDI_OK
               : midi_fail(MIDI_NO_DEVICE, "%s", strerror(errno));
}

static void pty_close(struct server_device *d)
{
    struct stream *s = d->own;
    if (s)
        loop_unwatch(d->loop, &s->watch);
}

static void pty_finish(struct server_device *d)
{
    const struct stream *s = d->own;
    if (s && *s->linked && links_to(d->argument, s->linked, false))
        unlink(d->argument);
    stream_close(d);
}

const struct device_kind device_kind_raw = {
    .name = "raw",
    .argument = "PATH",
    .help = "bytes of a file such as /dev/snd/midiC1D0",
    .open = raw_open,
    .close = stream_close,
    .write = stream_write,
    .more = stream_more,
};

const struct device_kind device_kind_serial = {
    .name = "serial",
    .argument = "PATH[@SPEED]",
    .help = "a serial line, 38400 bits a second unless another speed is given",
    .open = serial_open,
    .close = stream_close,
    .write = stream_write,
    .more = stream_more,
};

const struct device_kind device_kind_pty = {
    .name = "pty",
    .argument = "LINK",
    .help = "a pseudo-terminal of the server's own; LINK becomes a link to its other end",
    .plays = true,
    .hears = true,
    .open = pty_open,
    .close = pty_close,
    .finish = pty_finish,
    .write = stream_write,
    .more = stream_more,
};
