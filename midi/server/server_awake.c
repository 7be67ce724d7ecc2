/* server_awake.c - see server_awake.h. */
#include "server_awake.h"

#include "latency.h"

#include <stddef.h>
#include <unistd.h>

bool awake_begin(struct server_awake *a, const char *path)
{
    *a = (struct server_awake){.path = path, .file = -1};
    if (!path)
        return true;
    const int file = latency_open(path);
    if (file < 0) {
        a->path = NULL;
        return false;
    }
    close(file);
    return true;
}

void awake_look(struct server_awake *a, uint64_t messages, uint64_t now_ns)
{
    if (!a->path)
        return;
    if (messages != a->messages) {
        a->messages = messages;
        a->until_ns = now_ns + AWAKE_MS * UINT64_C(1000000);
    }
    if (now_ns >= a->until_ns) {
        awake_end(a);
    } else if (a->file < 0) {
        a->file = latency_open(a->path);
        if (a->file < 0 || !latency_ask(a->file, true)) {
            awake_end(a);
            a->path = NULL; /* no longer allowed */
        }
    }
}

void awake_end(struct server_awake *a)
{
    if (a->file >= 0)
        close(a->file);
    a->file = -1;
}
