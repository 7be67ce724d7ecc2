/* device_link.c - the beat of an Ableton Link session as a MIDI clock: the bytes of a program
 * of ours, lutetia-link, which is a peer of the session. */
#include "device_kinds.h"

#include <midi_internal.h>
#include <midi_time.h>
#include <program.h>

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { READ_BYTES = 256 };

struct peer {
    struct server_watch watch; /* of its output */
};

static void here(void)
{
}

static void peer_ready(struct server_watch *w, uint32_t events)
{
    struct server_device *d = w->owner;
    uint8_t bytes[READ_BYTES];
    (void)events;
    const ssize_t got = read(w->file, bytes, sizeof bytes);
    if (got > 0) {
        device_input(d, midi_now_ns(), bytes, (size_t)got);
        device_read_end(d);
    } else if (got == 0) {
        device_down(d, "lutetia-link has ended");
    } else if (errno != EAGAIN && errno != EINTR) {
        device_down(d, strerror(errno));
    }
}

/* Runs the program with its output in `to`. It is nobody's child: it ends when nobody reads,
 * and leaves nothing to wait for. */
static bool peer_run(const char *path, const char *tempo, int to)
{
    int status;
    const pid_t pid = fork();
    if (pid == 0) {
        if (fork() == 0 && dup2(to, STDOUT_FILENO) >= 0)
            execl(path, path, tempo, (char *)NULL);
        _exit(0);
    }
    return pid > 0 && waitpid(pid, &status, 0) == pid;
}

static void peer_close(struct server_device *d)
{
    struct peer *p = d->own;
    if (!p)
        return;
    loop_unwatch(d->loop, &p->watch);
    close(p->watch.file);
    free(p);
    d->own = NULL;
}

static enum midi_status peer_open(struct server_device *d)
{
    char path[PATH_MAX], *end = NULL;
    const char *tempo = *d->argument ? d->argument : "120";
    int ends[2];
    const double number = strtod(tempo, &end);
    if (*end || !(number >= 20 && number <= 999))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "link:%s: the tempo must be 20..999 quarter notes a minute", tempo);
    if (!program_find(path, here, LUTETIA_LIBEXECDIR "/lutetia/lutetia-link",
                      "midi/link/lutetia-link"))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "link: this build has no Ableton Link; it needs ableton-link-dev, "
                         "libasio-dev and a compiler of C++ when Lutetia is built");
    struct peer *p = calloc(1, sizeof *p);
    if (!p || pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) {
        free(p);
        return midi_fail(MIDI_NO_MEMORY, "link: no pipe to its program");
    }
    p->watch = (struct server_watch){ends[0], peer_ready, d};
    d->own = p;
    const bool runs = peer_run(path, tempo, ends[1]);
    close(ends[1]);
    return runs && loop_watch(d->loop, &p->watch, EPOLLIN)
               ? MIDI_OK
               : midi_fail(MIDI_NO_DEVICE, "%s: %s", path, strerror(errno));
}

static size_t peer_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    (void)d;
    (void)bytes;
    return count;
}

const struct device_kind device_kind_link = {
    .name = "link",
    .argument = "[TEMPO]",
    .help = "the beat of an Ableton Link session, as a clock; TEMPO (120) where it is alone",
    .hears = true,
    .retry_ms = 1000,
    .stays = true,
    .open = peer_open,
    .close = peer_close,
    .write = peer_write,
};
